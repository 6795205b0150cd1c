"""Estimated steps of runs in time: by the changes of their histories, against the steps of runs."""

import numpy as np
import pytest
from scene_text import paper_scene

import lubfric
from lubfric.output import estimate_scene
from lubfric.scene import Harmonic, Table, Transient

PATCH = paper_scene(numerics={"sampling": "patch"})
TIMES = np.linspace(0.0, 1.0, 61)
SAMPLED_WAVE = Table(times=tuple(TIMES), values=tuple(0.3 + 0.2 * np.sin(2 * np.pi * TIMES)))  # corners take steps, too


def estimated(plan, scene=PATCH):
    prepared = lubfric.prepare(scene.with_(transient=plan))
    return estimate_scene(prepared.scene, prepared.sample, prepared.surface).run


def test_every_further_cycle_takes_as_many_steps():
    """The same reversal again and again, as a sine and as a table that is repeated."""
    wave = Harmonic(amplitude=0.03, frequency=100.0)
    zigzag = Table(times=(0.0, 0.005, 0.01), values=(-0.03, 0.03, -0.03), repeat=True)
    for speed in (wave, zigzag):
        one, two, four = (estimated(Transient(0.01 * n, outputs=2, speed=speed)).steps for n in (1, 2, 4))
        assert four - two == pytest.approx(2 * (two - one), rel=0.02) and two - one > 30


def test_more_changes_take_more_steps():
    steady = estimated(Transient(0.01, outputs=2)).steps
    swing = estimated(Transient(0.2, outputs=2, speed=Harmonic(mean=0.03, amplitude=0.01, frequency=5.0))).steps
    reversing = Harmonic(amplitude=0.03, frequency=5.0)
    reversal = estimated(Transient(0.2, outputs=2, speed=reversing)).steps
    loaded = Transient(0.2, outputs=2, speed=reversing, load=Harmonic(mean=2.0, amplitude=1.5, frequency=5.0))
    assert steady < swing < reversal < estimated(loaded).steps
    assert estimated(Transient(0.01, outputs=5000)).steps == pytest.approx(5000)


def test_the_part_of_the_steps_follows_the_reversals():
    """Most steps of a run that reverses at its middle fall there."""
    run = estimated(Transient(0.01, outputs=2, speed=Harmonic(amplitude=0.03, frequency=50.0, phase=np.pi / 2)))
    parts = [run.part(time) for time in np.linspace(0.0, 0.01, 11)]
    assert np.all(np.diff(parts) >= 0) and parts[-1] == 1.0
    assert parts[0] == 0.0 and parts[8] - parts[2] > 0.6 * (1.0 - run.part(run.times[1]))  # of those after the start
    np.testing.assert_allclose([run.part(time) for time in run.times_of_parts(8)], np.arange(1, 9) / 8)
    (to_reversal, after) = run.seconds_between([0.005, 0.01])
    assert run.start_seconds + to_reversal + after == pytest.approx(run.seconds)
    assert to_reversal / after == pytest.approx(parts[5] / (1 - parts[5])) and run.start_seconds > 0


@pytest.mark.parametrize(
    "plan",
    [
        Transient(0.02, outputs=4, speed=Harmonic(amplitude=0.03, frequency=50.0, phase=1.5)),
        Transient(1.0, outputs=20, speed=SAMPLED_WAVE),
        pytest.param(
            Transient(0.01, outputs=4, load=Harmonic(mean=2.5, amplitude=2.0, frequency=200.0)), marks=pytest.mark.slow
        ),
    ],
)
def test_a_run_takes_about_the_estimated_steps(plan):
    scene = PATCH.with_(motion={"entrainment_speed": 0.03})
    steps = lubfric.transient(scene.with_(transient=plan)).steps[-1]
    assert steps / 3 < estimated(plan, scene).steps < 3 * steps


def test_a_starved_contact_needs_the_strips_of_its_smallest_film():
    """A starved piston ring: where its film flows it is 3.3 Sq thick, at its thinnest 2.7, where summits still meet it.
    The run takes all 61 strips there are, at the fastest of its speeds."""
    ring = lubfric.load_scene("paper").with_(
        bodies={"radius": 0.03, "width": 0.27, "load": 180.0, "e_prime": 155e9},
        lubricant={"viscosity": 4.5e-3, "pressure_viscosity_coefficient": 1.4e-8, "inlet_length": 3e-4},
        motion={"entrainment_speed": 2.6, "slide_roll_ratio": 2},
        surface={"sq": 3.1e-7, "correlation_length": 2e-5, "acf": "gaussian"},
        contact={"shape": (128, 128), "spacing": 5e-6},
    )
    plan = Transient(0.03, outputs=2, speed=Harmonic(amplitude=2.6, frequency=16.7))
    widest = estimated(plan, ring).widest
    assert widest.speed == pytest.approx(2.6) and 61 / 5 < widest.strips <= 61


def test_a_plateau_honed_ring_needs_the_strips_of_its_grooves():
    """The run takes 18 strips, because grooves are long and the plateaus alone touch; 2 were estimated, and a tenth of
    the time."""
    ring = lubfric.load_scene("paper").with_(
        bodies={"radius": 0.02, "width": 0.2576, "load": 1950.0, "e_prime": 155e9, "hardness": 2.4e9},
        lubricant={"viscosity": 4.6e-3, "pressure_viscosity_coefficient": 1.4e-8, "inlet_length": 3e-4},
        motion={"entrainment_speed": 6.75, "slide_roll_ratio": 2},
        surface={"sq": None, "sk": 6e-7, "spk": 1.5e-7, "svk": 1.5e-6, "correlation_length": 1.5e-5},
        contact={"shape": (256, 256), "spacing": 3e-6},
        numerics={"sampling_tolerance": 0.05},
    )
    plan = Transient(1e-3, outputs=2, speed=Harmonic(amplitude=6.75, frequency=50.0, phase=2.0944))
    assert 18 / 3 < estimated(plan, ring).widest.strips < 3 * 18


def test_a_run_by_load_sharing_is_estimated_with_the_strips_of_load_sharing():
    """By "auto", whose last model takes one strip of moving roughness, a sixth of the cells of the run was
    estimated."""
    plan = Transient(0.01, outputs=4, speed=Harmonic(mean=0.03, amplitude=0.01, frequency=100.0))
    by_auto = lubfric.load_scene("paper").with_(motion={"entrainment_speed": 0.03, "slide_roll_ratio": 0.1})
    (run, alone) = (estimated(plan, by_auto.with_(numerics={"model": model})) for model in ("auto", "paper"))
    assert run.widest.strips == alone.widest.strips >= lubfric.prepare(by_auto).sample.first_strips > 1
    assert run.seconds == pytest.approx(alone.seconds)


def test_a_run_is_estimated_without_the_ends_of_input_ranges_which_its_start_does_not_solve():
    plan = Transient(0.01, outputs=4, speed=Harmonic(mean=0.03, amplitude=0.01, frequency=100.0))
    with_range = PATCH.with_(bodies={"hardness": [6e9, 5e9, 7e9]})
    assert estimated(plan, with_range).start_seconds == estimated(plan).start_seconds > 0
