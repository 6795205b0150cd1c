"""A starved inlet in runs in time: the steady film, a jump of the speed, motion backwards, and the friction of a scene."""

import numpy as np
import pytest

import lubfric
from lubfric import InputError
from lubfric.scene import Table
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
    found = solve_transient_ehl(**LINE, inlet_length=STARVED, times=[0.0, 1e-3])
    expected = steady()
    flooded = lubfric.solve_ehl(**LINE)
    assert expected.min_film < 0.85 * flooded.min_film
    np.testing.assert_allclose(found.min_film, expected.min_film, rtol=0.01)
    np.testing.assert_allclose(found.central_film, expected.central_film, rtol=0.01)
    upstream = found.x <= -STARVED * (1 - 1e-6)
    assert np.abs(found.pressure[-1][upstream]).max() <= 1e-12 * found.pressure.max()
    assert found.load[-1] == pytest.approx(1e5, rel=1e-6)


def test_after_a_jump_of_the_speed_it_ends_in_the_other_steady_film():
    slower = Table(times=(0.0, 0.0, 1.0), values=(1.0, 0.5, 0.5))
    found = solve_transient_ehl(**LINE | {"entrainment_speed": slower}, inlet_length=STARVED, times=[0.0, 4e-3])
    films = [steady(entrainment_speed=speed).min_film for speed in (1.0, 0.5)]
    np.testing.assert_allclose(found.min_film, films, rtol=0.01)


def test_far_upstream_it_is_flooded():
    found = solve_transient_ehl(**LINE, inlet_length=30 * HALF_WIDTH, times=[0.0, 1e-4])
    assert found.min_film[-1] == pytest.approx(lubfric.solve_ehl(**LINE).min_film, rel=0.01)


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


def test_what_a_run_does_not_take():
    with pytest.raises(InputError, match="inlet_film"):
        SCENE.with_(lubricant={"inlet_length": None, "inlet_film": 1e-7}, transient=lubfric.Transient(1e-4))
    in_time = SCENE.with_(transient=lubfric.Transient(1e-4), numerics={"model": "deterministic"})
    with pytest.raises(InputError, match="inlet_length"):
        lubfric.transient(in_time)
