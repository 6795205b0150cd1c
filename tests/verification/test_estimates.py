"""Estimated times against the counted work of quick runs of every kind, within a wide factor; no clock is asked."""

import math
from functools import partial

import numpy as np
import pytest

import lubfric
from lubfric._base import limited_work
from lubfric.output import estimate_scene
from lubfric.running_in import estimated_run_in
from lubfric.scene import Harmonic, Transient
from lubfric.studies import estimated_fit, estimated_study
from verification.campaigns.estimates.jobs import KINDS, drawn
from verification.campaigns.estimates.table import TABLE, estimate_again, ratios, rows, table
from verification.pace import PAIR, paced

PAPER = lubfric.load_scene("paper").with_(numerics={"model": "paper"})
# A run takes 1 to 3 times its counted work in processor time: maps, fields and Python are not counted.
FACTOR = 8.0


def of_scene(scene, speeds=(), ratios=()):
    prepared = lubfric.prepare(scene)
    return estimate_scene(scene, prepared.sample, prepared.surface, speeds, ratios).seconds


ROLLING = PAPER.with_(motion={"slide_roll_ratio": 0.1}, numerics={"model": "quick", "accept": True})
PATCH = PAPER.with_(bodies={"hardness": 2e9}, contact={"shape": (96, 96), "spacing": 0.9e-6})
IN_TIME = PAPER.with_(
    motion={"entrainment_speed": 0.03},
    transient=Transient(duration=4e-3, outputs=8, speed=Harmonic(mean=0.03, amplitude=0.01, frequency=250.0)),
)
AXES = {"bodies.load": [4.0, 5.0]}
MEASURED = lubfric.Measured(x=[0.01, 0.03, 0.1, 0.3], coefficient=[0.09, 0.05, 0.03, 0.03])
FITTED = {"bodies.boundary_friction_coefficient": (0.05, 0.15)}
RUNS = {
    "point": (partial(of_scene, PAPER, [0.03]), lambda: lubfric.friction(PAPER, 0.03)),
    "deterministic": (
        partial(of_scene, PAPER.with_(numerics={"model": "deterministic"}), [0.03]),
        lambda: lubfric.friction(PAPER.with_(numerics={"model": "deterministic"}), 0.03),
    ),
    "rolling": (partial(of_scene, ROLLING, [0.03]), lambda: lubfric.friction(ROLLING, 0.03)),
    "speeds": (partial(of_scene, PAPER, [0.01, 0.1]), lambda: lubfric.stribeck(PAPER, [0.01, 0.1])),
    "ratios": (
        partial(of_scene, ROLLING.with_(motion={"entrainment_speed": 0.03}), ratios=[0.1, 0.5]),
        lambda: lubfric.traction(ROLLING, [0.1, 0.5], speed=0.03),
    ),
    "study": (
        lambda: estimated_study(lubfric.plan_study(PAPER, AXES, [0.01, 0.1])),
        lambda: lubfric.study(PAPER, AXES, [0.01, 0.1]),
    ),
    "fit": (
        lambda: estimated_fit(PATCH, MEASURED, FITTED, starts=0),
        lambda: lubfric.fit(PATCH, MEASURED, FITTED, starts=0),
    ),
    "in time": (partial(of_scene, IN_TIME), lambda: lubfric.transient(IN_TIME)),
    "run-in": (partial(estimated_run_in, PATCH), lambda: lubfric.run_in(PATCH)),
}


LONG = ("deterministic", "ratios", "rolling", "in time", "fit")


@pytest.mark.parametrize("name", [pytest.param(name, marks=[pytest.mark.slow] * (name in LONG)) for name in RUNS])
def test_the_estimate_is_near_the_counted_work(name):
    estimate, run = RUNS[name]
    seconds = estimate()
    with limited_work(math.inf) as meter:
        run()
    assert meter.spent / 2 <= seconds <= FACTOR * meter.spent, (seconds, meter.spent)


def test_random_runs_are_the_same_every_time_and_of_every_kind():
    kinds = [drawn(seed).kind for seed in (1, 2, 5)]
    assert kinds == [KINDS[seed] for seed in (1, 2, 5)]
    again = drawn(1)
    assert again.scene == drawn(1).scene and again.estimate() == drawn(1).estimate()


def test_the_table_of_runs_holds_what_the_words_promise():
    """At least four of five runs of the table are within a factor of 3, half of the patches at rest within 2, and its
    summary has every kind once."""
    apart = np.concatenate([np.abs(np.log(values)) for values in ratios().values()])
    assert apart.size >= 30 and np.mean(apart <= math.log(3)) >= 0.8
    assert np.mean(np.abs(np.log(ratios()["patch rest deterministic"])) <= math.log(2)) >= 0.5
    assert [row[0] for row in table().rows] == ["all", *ratios()]


def test_estimates_that_were_measured_stay_those_of_their_runs(tmp_path):
    """They have the pace of the core in them, as the times of the runs have."""
    file = tmp_path / "table.csv"
    lines = TABLE.read_text().splitlines()
    (measured,) = (line for line in lines if line.startswith("20009,"))
    other = next(line for line in lines if line.startswith("10059,"))
    file.write_text("\n".join([lines[0], measured, other.replace(other.split(",")[6], "77.0")]) + "\n")
    estimate_again(file)
    assert file.read_text().splitlines()[1] == measured
    assert [row["estimate"] != "77.0" for row in rows(file)] == [True, True]


def estimate_and_taken(seed):
    (row,) = (row for row in rows() if row["seed"] == str(seed))
    return drawn(seed, int(row["draw"])).estimate(), float(row["seconds"])


@pytest.mark.parametrize("seed", [10011, 10035, 10059])
def test_moving_roughness_on_few_cells_is_estimated_within_three_of_what_it_took(seed):
    """On 300 to 500 cells the calls of a Newton step take several times as long as its counted work."""
    estimate, taken = estimate_and_taken(seed)
    assert taken / 3 <= estimate <= 3 * taken


def test_a_piece_that_is_not_smooth_is_estimated_with_the_shortest_cells_that_it_needs():
    """Roughness at rest with an exponential autocorrelation takes 32 s of counted work."""
    estimate, taken = estimate_and_taken(99)
    assert taken / 2 <= estimate <= 2 * taken


@pytest.mark.parametrize("length", [4e-6, 8e-6])
def test_a_light_contact_on_an_exponential_surface_is_estimated_without_shorter_cells(length):
    """Between bodies that flatten by a twentieth of Sq no shorter cells follow: Python adds to the counted work of .1
    s."""
    scene = PAPER.with_(surface={"acf": "exponential", "correlation_length": length}, numerics={"accept": True})
    with limited_work(math.inf) as meter:
        lubfric.friction(scene, 0.005)
    assert meter.spent <= of_scene(scene, [0.005]) <= 4 * meter.spent


def test_a_film_far_above_the_summits_is_estimated_and_solved_without_a_contact():
    """Under a light load, and between bodies of 10 MPa, whose contact took 30 s."""
    for bodies, speed in (({"load": 1.0}, 1.0), ({"e_prime": 1e7}, 0.03)):
        scene = lubfric.load_scene("paper").with_(bodies=bodies, numerics={"accept": True})
        with limited_work(math.inf) as meter:
            result = lubfric.friction(scene, speed)
        assert result.contact_load == 0 and meter.spent < 0.1 and of_scene(scene, [speed]) < 0.1


def test_the_ends_of_input_ranges_are_estimated_as_films_that_are_solved():
    """One film without ranges, and with two of them also four ends, what they begin with, and what they are compared
    with."""
    scenes = [PAPER, PAPER.with_(lubricant={"eyring_stress": "mineral", "limiting_stress_coefficient": "mineral"})]
    works = []
    for scene in scenes:
        prepared = lubfric.prepare(scene)
        with limited_work(math.inf) as meter:
            lubfric.friction(prepared, 1.0)
        works.append(meter.spent)
    (without, with_ends) = (of_scene(scene, [1.0]) for scene in scenes)
    assert with_ends / without == pytest.approx(works[1] / works[0], rel=0.4) and works[1] > 4 * works[0]


@pytest.mark.slow
@pytest.mark.parametrize(
    "keys", [{"lubricant": {"inlet_film": 120e-9}}, {"bodies": {"e_prime": 5e9}}], ids=["starved", "soft"]
)
def test_a_starved_and_a_soft_contact_are_estimated_within_three(keys):
    """A thin film between light bodies takes few steps, however little arrives; a thick one between soft bodies too."""
    scene = lubfric.load_scene("paper").with_(**keys, numerics={"accept": True})
    with limited_work(math.inf) as meter:
        lubfric.friction(scene, 0.03)
    assert meter.spent / 3 <= of_scene(scene, [0.03]) <= 3 * meter.spent


def test_auto_is_estimated_without_the_model_that_it_passes_over():
    """Below a tolerance of .1 the quick model waits: what "auto" solves at rest is what "deterministic" solves."""
    scenes = [PAPER.with_(numerics={"model": model}) for model in ("auto", "deterministic")]
    (by_auto, by_name) = (of_scene(scene, [0.03]) for scene in scenes)
    loose = of_scene(scenes[0].with_(numerics={"model_tolerance": 0.2}), [0.03])
    assert by_auto == pytest.approx(by_name) and loose != pytest.approx(by_auto)


@pytest.mark.slow
@pytest.mark.parametrize("speed", [3.0, 0.3])
def test_a_heavy_roller_at_rest_is_estimated_within_two(speed):
    """A film of 2.3 and of 0.46 Sq at 1 GPa; all of the short strip is solved on shorter cells."""
    scene = lubfric.load_scene("paper").with_(
        bodies={"radius": 6e-3, "width": 10e-3, "load": 1600.0, "material": "steel", "hardness": None},
        lubricant={"viscosity": 0.02, "pressure_viscosity_coefficient": 18e-9, "eyring_stress": 5e6},
        surface={"sq": 150e-9, "correlation_length": 10e-6, "acf": "gaussian"},
        contact={"shape": (256, 64), "spacing": 2e-6},
    )
    scene = scene.with_(bodies={"boundary_friction_coefficient": 0.12}, lubricant={"limiting_stress_coefficient": 0.06})
    with limited_work(math.inf) as meter:
        lubfric.friction(scene, speed)
    taken = 0.64 * meter.spent  # processor seconds: .5 to .86 of the counted work at rest were measured
    assert taken / 2 <= of_scene(scene, [speed]) <= 2 * taken


def test_seconds_on_a_slower_core_are_those_on_the_stated_one(monkeypatch):
    """A core that takes three times as long before the run and five times after it: a quarter of its seconds by the
    clock."""
    pairs = iter([3 * PAIR, 5 * PAIR])
    moments = iter([100.0, 108.0])
    monkeypatch.setattr("verification.pace._pair", lambda: next(pairs))
    assert paced(lambda: "answer", clock=lambda: next(moments)) == ("answer", pytest.approx(2.0))


def test_passes_until_nothing_yields_are_estimated_by_the_hardness():
    """Soft asperities take more passes than hard ones: the ratio of both estimates is within two of that of the counted
    work."""
    estimates, work = [], []
    for hardness in (6e8, 2e9):
        scene = PATCH.with_(bodies={"hardness": hardness}, contact={"shape": (48, 48)})
        with limited_work(math.inf) as meter:
            lubfric.run_in(scene)
        estimates.append(estimated_run_in(scene))
        work.append(meter.spent)
    assert 0.5 < estimates[0] / estimates[1] / (work[0] / work[1]) < 2.0


def test_strips_on_long_cells_are_as_many_as_their_scatter_needs():
    """Four strips under a film of 2.4 Sq, and two under one of 0.85 Sq: both are estimated within two of the counted
    work."""
    for seed in (305, 321):
        job = drawn(seed, 0)
        with limited_work(math.inf) as meter:
            job.run()
        assert meter.spent / 2 <= job.estimate() <= 2 * meter.spent


def test_the_quick_model_on_a_patch_has_an_estimate():
    """The patch has no sampling error, and its strip is all there is: the time is positive and finite."""
    assert 0 < of_scene(PATCH.with_(numerics={"model": "quick", "sampling": "patch"}), [0.03]) < math.inf


def test_the_estimate_of_moving_roughness_counts_all_of_a_patch():
    """All of a patch passes, however long: four times the length takes some four times the time."""
    times = [
        of_scene(
            ROLLING.with_(contact={"shape": (columns, 96), "spacing": 0.9e-6}, numerics={"sampling": "patch"}), [0.03]
        )
        for columns in (384, 1536)
    ]
    assert 3.0 < times[1] / times[0] < 5.0


@pytest.mark.slow
def test_a_patch_on_all_lengths_of_its_cells_is_estimated_within_three():
    """With numerics.grid = "given" its cells are shortened down to its own, whatever f changes by."""
    patch = PAPER.with_(
        contact={"shape": (192, 192), "spacing": 0.45e-6},
        numerics={"sampling": "patch", "model": "deterministic", "grid": "given"},
    )
    for speed in (0.01, 0.1):
        with limited_work(math.inf) as meter:
            lubfric.friction(patch, speed)
        assert meter.spent / 3 <= of_scene(patch, [speed]) <= 3 * meter.spent


@pytest.mark.slow
def test_an_exponential_surface_under_a_wide_contact_is_estimated_within_three():
    """Bodies that flatten by 13 Sq: the dry contacts take some twice as many iterations, on ever shorter cells."""
    job = drawn(1490, 0)
    with limited_work(math.inf) as meter:
        job.run()
    assert meter.spent / 3 <= job.estimate() <= 3 * meter.spent
