"""Bad input of every kind is refused in words; a sample of what ``python -m verification stability`` runs in full."""

import dataclasses

import numpy as np
import pytest

import lubfric
from verification.campaigns import hostile
from verification.campaigns.hostile import scenes, soak
from verification.campaigns.hostile.case import ACCEPTED, GOOD, RAW, REFUSED, HostileCase, judge
from verification.campaigns.hostile.soak_judge import verdict
from verification.campaigns.hostile.soak_scenes import random_scene


def test_the_scene_that_is_damaged_is_a_good_one(tmp_path):
    """Else every damage would be refused for the wrong reason."""
    result = scenes.case("good", scenes.text_of(scenes.GOOD)).run(tmp_path)
    assert 0 < result.coefficient < 0.1 and result.report.converged


@pytest.mark.parametrize("group", hostile.COUNTS)
def test_a_sample_of_bad_inputs_is_refused(group):
    result = hostile.outcomes((group, 0.12))
    assert len(result) > 20
    assert [words for ended, words in result if ended not in GOOD] == []


@pytest.mark.parametrize(
    "run, verdict",
    [
        (lambda folder: 0.1, ACCEPTED),
        (lambda folder: 1 / 0, RAW),
        (lambda folder: np.float64(1) / 0, RAW),
        (lambda folder: validated("load"), REFUSED),
    ],
)
def test_the_judge_tells_them_apart(tmp_path, run, verdict):
    assert judge(HostileCase("call", "a call", run), tmp_path)[0] == verdict


def validated(name):
    raise lubfric.InputError(f"{name} = -1 N is out of range")


@pytest.mark.slow
def test_a_sample_of_the_soak_is_answered_right():
    """Random scenes, each balance solved again by the independent judge."""
    row = soak.chunk(7, range(2, 10))
    assert all(c.passed for c in soak.summarized([row]) if hasattr(c, "passed"))
    ended = [one["ended"] for one in row["scenes"]]
    assert ended.count(soak.ANSWERED) >= 6 and sum(one["ratio"] is not None for one in row["scenes"]) >= 6


def test_the_judge_of_the_soak_sees_a_wrong_answer():
    """f, the loads, and both by the answer to another speed."""
    scene = random_scene(np.random.default_rng((1, 105)))
    prepared = lubfric.prepare(scene)
    result = lubfric.friction(prepared)
    assert max(verdict(prepared, result).values()) < 1
    assert 0.05 < result.contact_load / scene.bodies.load < 0.95
    of_spoilt = verdict(prepared, dataclasses.replace(result, coefficient=1.03 * result.coefficient))
    assert of_spoilt["friction sum"] > 1 and of_spoilt["friction"] > 1
    of_moved = verdict(prepared, dataclasses.replace(result, contact_load=0.95 * result.contact_load))
    assert of_moved["load"] > 1 and of_moved["contact share"] > 1
    thinner = lubfric.friction(prepared, 0.7 * result.speed)
    assert verdict(prepared, dataclasses.replace(thinner, speed=result.speed))["contact share"] > 1


@pytest.mark.parametrize(
    "seed, k", [(2, 5202), *(pytest.param(*one, marks=pytest.mark.slow) for one in ((2, 5988), (11, 4291))), (1, 755)]
)
def test_scenes_that_the_soak_found_wrong_are_answered_right(seed, k):
    """Forces of film and contact that cancel, summed beside the contacts of one line only; a light contact whose
    further lines were closed too loosely; five short lines of one film; bodies that deflect far more than the gap."""
    prepared = lubfric.prepare(random_scene(np.random.default_rng((seed, k)), any_material=k % 2 == 1))
    assert verdict(prepared, lubfric.friction(prepared))["friction"] < 0.6
