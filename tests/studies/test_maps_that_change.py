"""A map file that is replaced between planning and solving, or between `prepare` and a curve, poisons no store."""

import os

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter
from small_study import SCENE

import lubfric


def heights(seed):
    z = gaussian_filter(np.random.default_rng(seed).normal(size=(48, 48)), 2.5, mode="wrap")
    return z / z.std() * (0.5 + seed) * 5e-8


@pytest.fixture
def scene(tmp_path):
    np.save(tmp_path / "map.npy", heights(1))
    rough = {"file": str(tmp_path / "map.npy"), "spacing": 1.1e-6, "sq": None, "correlation_length": None}
    return SCENE.with_(surface=rough, contact={"shape": None, "spacing": None}, numerics={"model": "paper"})


def replace_map(tmp_path, seed):
    np.save(tmp_path / "new.npy", heights(seed))
    os.replace(tmp_path / "new.npy", tmp_path / "map.npy")


def test_a_map_replaced_between_plan_and_study_is_no_answer_and_leaves_no_record(scene, tmp_path):
    store = tmp_path / "store"
    first = lubfric.friction(scene, 0.01).coefficient
    plan = lubfric.plan_study(scene, speeds=[0.01])
    replace_map(tmp_path, 2)
    result = lubfric.study(plan, store=store)
    assert np.isnan(result["coefficient"]).all() and "has changed since the study was planned" in result.failures[0]
    replace_map(tmp_path, 1)
    again = lubfric.study(plan, store=store)  # nothing wrong was kept
    assert again["coefficient"][0] == first
    replace_map(tmp_path, 2)
    other = lubfric.friction(scene, 0.01).coefficient
    assert other != first and lubfric.study(scene, speeds=[0.01], store=store)["coefficient"][0] == other
    assert lubfric.study(plan, store=store)["coefficient"][0] == first  # of the plan, from the store


def test_a_map_replaced_between_prepare_and_a_curve_is_kept_as_what_was_solved(scene, tmp_path):
    store = tmp_path / "store"
    prepared = lubfric.prepare(scene)
    replace_map(tmp_path, 2)
    of_first = lubfric.stribeck(prepared, [0.01], store=store).coefficient[0]
    of_second = lubfric.stribeck(scene, [0.01], store=store).coefficient[0]
    assert of_second == lubfric.friction(scene, 0.01).coefficient != of_first
    replace_map(tmp_path, 1)
    assert lubfric.stribeck(scene, [0.01], store=store).coefficient[0] == of_first


def test_a_map_that_is_gone_is_solved_when_it_is_back(scene, tmp_path):
    plan = lubfric.plan_study(scene, speeds=[0.01])
    os.rename(tmp_path / "map.npy", tmp_path / "away.npy")
    result = lubfric.study(plan, store=tmp_path / "store")
    assert result.failed == 1 and "no such file" in result.failures[0]
    os.rename(tmp_path / "away.npy", tmp_path / "map.npy")
    assert lubfric.study(plan, store=tmp_path / "store").failed == 0


def test_the_same_heights_in_another_file_are_the_same_points(scene, tmp_path, monkeypatch):
    first = lubfric.study(scene, speeds=[0.01], store=tmp_path / "store")
    np.save(tmp_path / "copy.npy", heights(1))
    moved = scene.with_(surface={"file": str(tmp_path / "copy.npy")})
    monkeypatch.setattr("lubfric.studies.points.outcome_of", None)
    again = lubfric.study(moved, speeds=[0.01], store=tmp_path / "store")
    assert again["coefficient"][0] == first["coefficient"][0]
