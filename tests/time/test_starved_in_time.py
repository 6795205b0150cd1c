"""A starved inlet in runs in time: the steady film, a jump of the speed, motion backwards, and the friction of a
scene."""

from functools import cache

import numpy as np
import pytest

import lubfric
from lubfric import InputError
from lubfric.scene import Harmonic, Table
from lubfric.time import solve_transient_ehl

LINE = {
    "load_per_width": 1e5,
    "radius": 0.01,
    "e_prime": 230e9,
    "entrainment_speed": 1.0,
    "viscosity": 0.05,
    "pressure_viscosity_coefficient": 18e-9,
}
HALF_WIDTH = np.sqrt(8 * 1e5 * 0.01 / (np.pi * 230e9))
STARVED = 1.25 * HALF_WIDTH


def steady(**changed):
    return lubfric.solve_ehl(**LINE | {"inlet_length": STARVED} | changed)


def test_at_constant_speed_it_is_the_steady_starved_film():
    result = solve_transient_ehl(**LINE, inlet_length=STARVED, times=[0.0, 1e-3])
    expected = steady()
    flooded = lubfric.solve_ehl(**LINE)
    assert expected.min_film < 0.85 * flooded.min_film
    np.testing.assert_allclose(result.min_film, expected.min_film, rtol=0.01)
    np.testing.assert_allclose(result.central_film, expected.central_film, rtol=0.01)
    upstream = result.x <= -STARVED * (1 - 1e-6)
    assert upstream.sum() > 20 and not result.pressure[:, upstream].any()
    assert result.load[-1] == pytest.approx(1e5, rel=1e-6)


def test_after_a_jump_of_the_speed_it_ends_in_the_other_steady_film():
    slower = Table(times=(0.0, 0.0, 1.0), values=(1.0, 0.5, 0.5))
    result = solve_transient_ehl(**LINE | {"entrainment_speed": slower}, inlet_length=STARVED, times=[0.0, 4e-3])
    films = [steady(entrainment_speed=speed).min_film for speed in (1.0, 0.5)]
    np.testing.assert_allclose(result.min_film, films, rtol=0.01)


def test_far_upstream_it_is_flooded():
    result = solve_transient_ehl(**LINE, inlet_length=30 * HALF_WIDTH, times=[0.0, 1e-4])
    assert result.min_film[-1] == pytest.approx(lubfric.solve_ehl(**LINE).min_film, rel=0.01)


def test_backwards_it_is_the_mirror_image():
    forwards = solve_transient_ehl(**LINE, inlet_length=STARVED, times=[1e-4])
    backwards = solve_transient_ehl(**LINE | {"entrainment_speed": -1.0}, inlet_length=STARVED, times=[1e-4])
    np.testing.assert_allclose(backwards.pressure[0][::-1], forwards.pressure[0], rtol=1e-5, atol=1e3)


SCENE = lubfric.load_scene("paper").with_(
    motion={"entrainment_speed": 0.1, "speeds": ()},
    surface={"sq": 2e-8, "correlation_length": 4e-6},
    contact={"shape": (32, 16), "spacing": 1.5e-6},
    lubricant={"inlet_length": 1e-5},
    numerics={"model": "paper", "sampling": "patch", "grid": "given", "tolerance": 0.03, "accept": True},
)


def test_a_run_of_a_starved_scene_has_its_steady_friction():
    run = lubfric.transient(SCENE.with_(transient=lubfric.Transient(1e-4)))
    steady_f = lubfric.friction(SCENE).coefficient
    flooded = lubfric.friction(SCENE.with_(lubricant={"inlet_length": None})).coefficient
    assert abs(steady_f / flooded - 1) > 0.05
    np.testing.assert_allclose(run.coefficient, steady_f, rtol=0.03)


FULL_FILM = SCENE.with_(
    motion={"entrainment_speed": 1.0, "slide_roll_ratio": 2.0},
    transient=lubfric.Transient(
        2e-3,
        outputs=40,
        speed=Harmonic(mean=1.0, amplitude=0.5, frequency=400.0, phase=-np.pi / 2),
        sliding=Harmonic(mean=2.0),
    ),
)


@pytest.mark.parametrize("inlet", [1e-5, None])
def test_friction_of_a_smooth_course_is_smooth(inlet):
    """Speed, load and film follow a sine. So does f, wherever the film ruptures on the grid: its third differences,
    four times the size of what zigzags from output to output, stay within the stated error of the sum of the shear."""
    run = lubfric.transient(FULL_FILM.with_(lubricant={"inlet_length": inlet}))
    assert not run.contact_load.any()
    f = run.coefficient
    assert np.ptp(f) > 0.1 * f.mean()
    zigzag = np.abs(f[:-3] - 3 * f[1:-2] + 3 * f[2:-1] - f[3:]) / 4
    assert np.all(zigzag <= run.shear_error[1:-2] * f[1:-2])
    assert run.shear_error.max() < 0.01


@cache
def run_and_answer(speed):
    """The run in time at one speed, and the steady answer there."""
    scene = SCENE.with_(motion={"entrainment_speed": speed})
    return lubfric.transient(scene.with_(transient=lubfric.Transient(1e-4))), lubfric.friction(scene)


@pytest.mark.parametrize("speed", [0.005, pytest.param(3.0, marks=pytest.mark.slow)])
def test_a_starved_run_has_the_model_form_error_of_its_steady_answer(speed):
    """Thick films have the 3.2/Λ² of their shear, thin ones the exchange of film and asperities."""
    run, answer = run_and_answer(speed)
    assert answer.uncertainty.model > 0.001
    np.testing.assert_allclose(run.uncertainty.model_sides[-1], answer.uncertainty.model_sides, rtol=0.1)


def test_lambda_has_one_definition_at_rest_and_in_time():
    """That of steady motion by Moes' formula; the solved film over Sq has its own name."""
    for speed in (0.005, 3.0):
        run, point = run_and_answer(speed)
        assert run.full_load_film[-1] == pytest.approx(point.full_load_film, rel=1e-6)
        np.testing.assert_allclose(run.lambda_ratio, run.full_load_film / 2e-8, rtol=0.05)
        np.testing.assert_allclose(run.film_to_roughness_ratio, run.central_film / 2e-8, rtol=0.05)


def test_what_a_run_does_not_take():
    with pytest.raises(InputError, match="inlet_film.*the length at which full_load_film"):
        SCENE.with_(lubricant={"inlet_length": None, "inlet_film": 1e-7}, transient=lubfric.Transient(1e-4))
    in_time = SCENE.with_(transient=lubfric.Transient(1e-4), numerics={"model": "deterministic"})
    with pytest.raises(InputError, match="inlet_length"):
        lubfric.transient(in_time)


@pytest.mark.parametrize("speed", [1.4, pytest.param(4.2, marks=pytest.mark.slow)])
def test_the_deterministic_answer_of_a_starved_ring_lies_in_the_interval(speed):
    """Thick films (lambda ratios 5 and 10 of the solved film), which the deterministic model solves on the
    roughness."""
    ring = lubfric.load_scene("paper").with_(
        bodies={"radius": 0.05, "width": 0.25, "load": 94.0},
        lubricant={"viscosity": 0.0075, "inlet_length": 7.5e-4, "eyring_stress": 5e6},
        motion={"entrainment_speed": speed, "slide_roll_ratio": 2.0, "speeds": ()},
        surface={"sq": 4e-7, "correlation_length": 2e-5, "acf": "gaussian"},
        contact={"shape": (128, 128), "spacing": 5e-6},
        numerics={"heat": "off", "accept": True},
    )
    run = lubfric.transient(ring.with_(transient=lubfric.Transient(1e-4, outputs=1)))
    solved = lubfric.friction(ring.with_(numerics={"model": "deterministic"}))
    low, high = run.uncertainty.interval[-1]
    assert low < solved.uncertainty.interval[1] and solved.uncertainty.interval[0] < high
    assert (high - low) / run.coefficient[-1] < 0.3


def test_an_error_of_next_to_no_friction_is_no_warning():
    """At the reversal f is that of squeeze, some 1e-5; its relative error is large, and means nothing."""
    wave = Harmonic(amplitude=0.5, frequency=50.0)
    scene = SCENE.with_(
        motion={"slide_roll_ratio": 2.0},
        numerics={"tolerance": 4e-3, "film_tolerance": 5e-3},
        transient=lubfric.Transient(0.02, 4, speed=wave),
    )
    run = lubfric.transient(scene)
    still = np.abs(run.coefficient) < 1e-3
    assert still.any() and np.any(run.shear_error[still] > 4e-3)
    for index in np.flatnonzero(still):
        assert not any("shear stress" in violation.what for violation in run.violations[index])
