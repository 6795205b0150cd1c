"""A plan written as a study file is read back to the same points, by their keys: hashes of all that they depend on."""

import numpy as np
import pytest
from scipy.stats import qmc

import lubfric
from lubfric.studies import load_study, plan_study

PAPER = lubfric.load_scene("paper")
WARM = PAPER.with_(lubricant={"grade": "ISO VG 46", "viscosity_index": 95, "temperature": "60 °C"})
GEAR = {
    "position [mm]": [-2, 0, 2],
    "radius [mm]": [4, 5, 4.5],
    "load [N]": [3, 5, 4],
    "u1 [m/s]": [0.20, 0.15, 0.10],
    "u2 [m/s]": [0.10, 0.15, 0.20],
    "duration [s]": [1, 2, 1],
}
HEATED = {"temperature [°C]": [40, 80], "speed [m/s]": [0.1, 0.2], "R1 [mm]": [1, 2], "R2 [mm]": [3, 4]}
BOX = [lubfric.Between("1 N", "10 N"), lubfric.Between(0.01, 1, "log")]
LOAD_AND_RADIUS = ("bodies.load", "bodies.radius")

PLANS = {
    "speeds of two surfaces": plan_study(PAPER, points=GEAR),
    "temperatures": plan_study(WARM, points=HEATED),
    "points of two models": plan_study(PAPER, {"numerics.model": ["paper", "quick"]}, points=GEAR),
    "keys together": plan_study(
        PAPER, {LOAD_AND_RADIUS: [(3.0, 2e-3), (5.5, 3e-3)], "lubricant.viscosity": [0.1, 0.3]}, [0.1, 0.2]
    ),
    "sections and words": plan_study(
        PAPER, {"surface": [{"sq": "0.1 um"}, {"sq": 2e-7}], "numerics.model": ["paper", "auto"]}, "auto"
    ),
    "a sample": plan_study(PAPER, {("bodies.load", "lubricant.viscosity"): lubfric.sample(BOX, 4)}),
}


@pytest.mark.parametrize("plan", PLANS.values(), ids=PLANS)
def test_it_is_read_back_to_the_same_points(plan, tmp_path):
    (tmp_path / "resolved.toml").write_text(plan.scene.to_toml(tmp_path))
    (tmp_path / "study.toml").write_text(plan.to_toml("resolved.toml"), encoding="utf-8")
    read = load_study(tmp_path / "study.toml")
    assert read.keys == plan.keys and read.dims == plan.dims
    assert read.speeds == plan.speeds and read.point_speeds == plan.point_speeds


def test_what_a_file_cannot_hold_is_refused():
    plan = plan_study(PAPER, {"surface": [PAPER.surface]}, [0.1])
    with pytest.raises(lubfric.InputError, match=r"surface: a section of a scene as an object.*a dict of its keys"):
        plan.to_toml("resolved.toml")


def test_a_sample_with_speeds_has_operating_points(tmp_path):
    """The points of the sequence itself, within the ranges: speeds by their logarithm."""
    (tmp_path / "study.toml").write_text(
        'scene = "paper"\n[sample]\ncount = 4\nseed = 3\nbodies.load = { low = "3 N", high = "5 N" }\n'
        'speed = { low = "10 mm/s", high = "1 m/s", scale = "log" }\n'
    )
    plan = load_study(tmp_path / "study.toml")
    shares = qmc.Sobol(2, seed=3).random(4)
    assert plan.point_speeds == pytest.approx(0.01 * 100 ** shares[:, 1])
    np.testing.assert_allclose(plan.coords["bodies.load"][1], 3 + 2 * shares[:, 0])
    assert plan.points == 4 and plan.drawn == (
        "4 sets of values drawn as a scrambled Sobol sequence with the seed 3; "
        "bodies.load of a uniform distribution from 3 N to 5 N; "
        "speed of a uniform distribution of its logarithm from 10 mm/s to 1 m/s"
    )
    with (tmp_path / "study.toml").open("a") as file:
        file.write("[[points]]\nspeed = 0.1\n")
    with pytest.raises(lubfric.InputError, match=r"\[sample\] of study.toml has speeds, and points has them too"):
        load_study(tmp_path / "study.toml")
    with pytest.raises(
        lubfric.InputError, match="'speed' is the axis of a curve; .* a column speed of operating points"
    ):
        plan_study(PAPER, {"speed": [0.1]})


def test_normal_values_and_entrainment_speeds_are_sampled(tmp_path):
    """As `lubfric.sample` draws them; a deviation of temperatures is a difference. Values that a key cannot have are
    refused before any point is solved."""
    scene = PAPER.with_(lubricant={"grade": "ISO VG 68", "viscosity_index": 95, "temperature_celsius": 60})
    (tmp_path / "scene.toml").write_text(scene.to_toml())
    head = 'scene = "scene.toml"\n[sample]\ncount = 64\nseed = 3\n'
    load = "bodies.load = { mean = 5.0, standard_deviation = 2.0"
    others = (
        'motion.entrainment_speed = { low = "10 mm/s", high = "1 m/s", scale = "log" }\n'
        'lubricant.temperature_celsius = { mean = "60 °C", standard_deviation = "4 K" }\n'
    )
    (tmp_path / "study.toml").write_text(head + load + ", low = 1.0 }\n" + others, encoding="utf-8")
    plan = load_study(tmp_path / "study.toml")
    ranges = {
        "bodies.load": lubfric.studies.Normal(mean=5.0, standard_deviation=2.0, low=1.0),
        "lubricant.temperature_celsius": lubfric.studies.Normal(mean=60.0, standard_deviation=4.0),
        "speed": lubfric.Between(0.01, 1.0, "log"),
    }
    drawn = dict(zip(ranges, zip(*lubfric.sample(ranges.values(), 64, seed=3))))
    assert plan.point_speeds == drawn["speed"]
    assert plan.drawn.partition("; ")[2] == (
        "bodies.load of a normal distribution with the mean 5 N and the standard deviation 2 N, cut off from 1 N; "
        "motion.entrainment_speed of a uniform distribution of its logarithm from 10 mm/s to 1 m/s; "
        "lubricant.temperature_celsius of a normal distribution with the mean 60 °C and the standard deviation 4 K"
    )
    for key in ("bodies.load", "lubricant.temperature_celsius"):
        np.testing.assert_allclose(plan.coords[key][1], drawn[key])
    (tmp_path / "again.toml").write_text(plan.to_toml("scene.toml"), encoding="utf-8")
    again = load_study(tmp_path / "again.toml")
    assert again.drawn == plan.drawn and again.keys == plan.keys and again.point_speeds == plan.point_speeds
    (tmp_path / "again.toml").write_text('drawn = "by hand"\n' + head + load + " }\n", encoding="utf-8")
    with pytest.raises(lubfric.InputError, match=r"drawn.* and \[sample\]"):
        load_study(tmp_path / "again.toml")
    (tmp_path / "study.toml").write_text(head + load.replace("2.0", "4.0") + " }\n", encoding="utf-8")
    with pytest.raises(lubfric.InputError, match=r"\[sample\] bodies.load: .*give low and high in \[sample\]"):
        load_study(tmp_path / "study.toml")


def test_a_built_in_scene_is_not_sought_as_a_file_of_a_study():
    with pytest.raises(lubfric.InputError, match=r"^paper is a scene, not a study.*--points"):
        load_study("paper")
