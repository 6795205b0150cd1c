"""Correlation lengths known to a range only: as given, written, read, in f and its interval."""

import csv
import math
from pathlib import Path

import pytest
from scene_text import paper_scene

import lubfric
from lubfric.estimate import QuickFriction, estimated_work_of_point, roughness_to_quote, scenes_at_ends

LENGTH = "correlation_length"
PATCH = {"shape": (32, 24), "spacing": 90e-6 / 32}
SMALL = paper_scene(contact=PATCH, numerics={"model": "quick", "sampling": "patch"}, surface={LENGTH: 8e-6})
PAIRS = Path(__file__).parents[2] / "verification/campaigns/calibration/tables/pairs.csv"


def interval(length, scene=SMALL):
    """The interval of f, without the sampling error of the patch."""
    return lubfric.friction(scene.with_(surface={LENGTH: length}), 0.01).uncertainty.interval_without_sampling


@pytest.mark.parametrize(
    "given, value, ends",
    [
        (["20 µm", "10 µm", "40 µm"], 2e-5, (1e-5, 4e-5)),
        (
            [["20 µm", "100 µm"], ["10 µm", "50 µm"], ["40 µm", "100 µm"]],
            (2e-5, 1e-4),
            ((1e-5, 5e-5), (4e-5, 1e-4)),
        ),
    ],
)
def test_a_range_of_a_length_or_of_a_pair_is_kept(tmp_path, given, value, ends):
    """Of both bodies, written and read back; another length has none."""
    counterface = {"sq": 1e-7, LENGTH: given}
    scene = SMALL.with_(surface={LENGTH: given}, counterface=counterface)
    assert scene.surface.correlation_length == value
    assert scene.ranges == tuple((f"{body}.{LENGTH}", *ends) for body in ("counterface", "surface"))
    (tmp_path / "scene.toml").write_text(scene.to_toml())
    assert lubfric.load_scene(tmp_path / "scene.toml") == scene
    assert scene.with_(bodies={"load": 6.0}).ranges == scene.ranges
    assert scene.with_(surface={LENGTH: value}, counterface=None).ranges == ()
    stated = " ".join(roughness_to_quote(scene))
    assert stated.count(" (range 10 to 40 µm)") + stated.count(" (range 10 and 50 µm to 40 and 100 µm)") == 2


def test_two_lengths_are_those_along_both_axes_as_before():
    scene = SMALL.with_(surface={LENGTH: [10e-6, 8e-6]})
    assert scene.surface.correlation_length == (10e-6, 8e-6) and scene.ranges == ()


@pytest.mark.parametrize(
    "given",
    [[[2e-5, 1e-5], [1e-5, 1e-5]], [2e-5, [1e-5, 1e-5], 3e-5], [2e-5, 1e-5, 1.5e-5], [2e-5] * 3, [1e-5] * 4]
    + [[[1e-5, 1e-5], [2e-5, 1e-5], [3e-5, 3e-5]], [1e-5, 0.0, 2e-5], [[1e-5], [1e-5], [2e-5]]],
)
def test_what_is_no_range_of_lengths_is_refused(given):
    with pytest.raises(lubfric.InputError, match="surface.correlation_length"):
        SMALL.with_(surface={LENGTH: given})


def test_the_ends_are_those_of_scenes_with_these_lengths(monkeypatch):
    """With the same seed, each solved by itself: without the error of the change, and with it around them."""
    scene = SMALL.with_(surface={LENGTH: [8e-6, 6e-6, 12e-6]})
    known = lubfric.friction(scene, 0.01).uncertainty
    monkeypatch.setattr(QuickFriction, "error_of_change", lambda *args: 0.0)
    exact = lubfric.friction(scene, 0.01).uncertainty
    (f, *ends) = (
        lubfric.friction(SMALL.with_(surface={LENGTH: length}), 0.01).coefficient for length in (8e-6, 6e-6, 12e-6)
    )
    changes = sorted(end / f - 1 for end in ends)
    assert [-exact.input_sides.towards, exact.input_sides.away] == pytest.approx(changes, rel=1e-9)
    assert max(map(abs, changes)) > 0.05
    assert known.input_sides.towards > -changes[0] and known.input_sides.away > changes[1]
    assert f"range of {LENGTH}: f " in known.text and known.inputs_in_interval == (f"surface.{LENGTH}",)


def test_a_range_without_width_changes_nothing_and_a_wider_one_widens_the_interval():
    ends = [8e-6, [8e-6, 8e-6 * (1 - 1e-12), 8e-6], [8e-6, 7e-6, 10e-6], [8e-6, 6e-6, 14e-6]]
    (plain, narrow, wide, wider) = map(interval, ends)
    assert narrow == pytest.approx(plain, rel=1e-6)
    for inner, outer in ((plain, wide), (wide, wider)):
        assert outer[0] < inner[0] and outer[1] > inner[1]


def test_both_bodies_have_their_ends_together():
    """They are made alike; other ranges have no part in these scenes."""
    lengths = {LENGTH: [8e-6, 6e-6, 9e-6]}
    both = SMALL.with_(surface=lengths, counterface={"sq": 7e-8} | lengths, bodies={"hardness": [5e9, 6e9]})
    plain = both.with_(surface={LENGTH: 8e-6}, counterface={LENGTH: 8e-6}, bodies={"hardness": 5.5e9})
    ends = [plain.with_(surface={LENGTH: end}, counterface={LENGTH: end}) for end in (6e-6, 9e-6)]
    assert scenes_at_ends(both) == ends


def test_a_patch_that_is_too_coarse_for_an_end_and_a_given_map_say_so():
    ranged = SMALL.with_(surface={LENGTH: [8e-6, 1e-6, 12e-6]})
    known = lubfric.friction(ranged, 0.01).uncertainty
    assert math.isnan(known.inputs) and f"range of {LENGTH}: not in the interval" in known.text
    surface = lubfric.generate_surface(
        PATCH["shape"], PATCH["spacing"], sq=1e-7, correlation_length=8e-6, acf="gaussian", seed=1
    )
    known = lubfric.friction(lubfric.prepare(ranged, surface), 0.01).uncertainty
    assert "the map was given by the caller" in known.text


def test_the_error_of_a_change_holds_that_from_deterministic_solves():
    """Of pairs of contacts at rest and rolling, with 0.5 to 2 times the length on the same map: the quick model against
    the deterministic one, whose change of ln f differs by the difference of both errors."""
    with PAIRS.open() as file:
        rows = [row for row in csv.DictReader(file) if row["key"] == "length" and not row["failure"]]
    held = []
    for row in rows:
        (error, width, other, other_width) = (
            float(row[f"quick_{name}"]) for name in ("error", "half_width", "other_error", "other_half_width")
        )
        (here, there) = (QuickFriction(coefficient=0.1, by_model=each, by_sample=0.0) for each in (width, other_width))
        held.append(abs(other - error) <= here.error_of_change(there, 1.0))
    assert len(held) > 25 and sum(held) / len(held) > 0.95


def test_the_estimate_of_time_has_the_ends():
    """Roughness at rest: the work is that of the cells along the strip, so half the length takes twice the time and
    twice the length half of it; f at the value itself is the answer."""
    prepared = lubfric.prepare(SMALL.with_(contact={"shape": (64, 48), "spacing": 90e-6 / 64}))
    ranged = prepared.scene.with_(surface={LENGTH: [8e-6, 4e-6, 16e-6]})
    (plain, with_ends) = (
        estimated_work_of_point(scene, prepared.sample, prepared.surface, 0.01).seconds
        for scene in (prepared.scene, ranged)
    )
    assert with_ends == pytest.approx(3.5 * plain)
