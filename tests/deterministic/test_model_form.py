"""The estimate of the model's error: its bounds, and that every steady result carries it."""

import math

import numpy as np
import pytest
from lubfric.sampling.model_form import LEAST, MOST, load_sharing_error, one_way_error

import lubfric

SCENE = lubfric.load_scene("paper").with_(
    contact={"shape": (48, 48), "spacing": 90e-6 / 48}, numerics={"sampling": "patch"}
)


def test_it_is_largest_about_lift_off():
    shares = np.linspace(0.01, 1, 50)
    errors = [load_sharing_error(2.0, s) for s in shares]
    assert max(errors) == MOST and np.all(np.diff(errors) <= 0) and errors[-2] < LEAST + 0.02
    assert load_sharing_error(math.nan, 1.0) == 0.0 and load_sharing_error(math.inf, 0.0) == 0.0
    films = [load_sharing_error(ratio, 0.0) for ratio in (1.0, 3.0, 5.0, 12.0, 50.0)]
    assert films[0] == MOST and np.all(np.diff(films) <= 0) and films[-1] < 0.002
    assert one_way_error(0.2, 0.0) > one_way_error(0.0, 0.0) > one_way_error(0.9, 0.0) > 0
    left_out = [one_way_error(0.9, u) for u in (0.0, 1e-3, 7e-3, 0.1)]
    assert np.all(np.diff(left_out) > 0) and left_out[-1] < one_way_error(0.86, 0.1) == one_way_error(0.2, 0.0)
    boundary = [one_way_error(s, 0.1) for s in (0.95, 0.99, 0.999, 1.0)]
    assert boundary == pytest.approx([0.055, 0.015, 0.006, 0.0])


@pytest.mark.parametrize("closure", ["load", "one-way"])
def test_a_result_carries_it(closure):
    point = lubfric.friction(SCENE.with_(numerics={"closure": closure}), 0.01)
    share = point.contact_load / SCENE.bodies.load
    if closure == "one-way":
        expected = one_way_error(share, point.one_way[-1].left_out)
    else:
        expected = load_sharing_error(math.nan, share)
    assert point.uncertainty.model_form == pytest.approx(expected)


def test_the_deterministic_film_lies_within_a_few_of_it():
    shared = lubfric.friction(SCENE, 0.003)
    whole = lubfric.friction(SCENE.with_(numerics={"model": "deterministic", "grid": "given"}), 0.003)
    assert math.isnan(whole.uncertainty.model_form)
    assert abs(shared.coefficient / whole.coefficient - 1) < 3 * shared.uncertainty.model_form


@pytest.mark.parametrize("load, speed", [(27.5, 0.001), (110.0, 0.003), (110.0, 0.001)])
def test_a_heavy_boundary_contact_lies_within_what_one_way_tells(load, speed):
    """The film presses the bodies apart by a part of the gap that alone would tell some 10 %. It carries one percent
    of the load."""
    fluid = {"density_law": "dowson-higginson", "limiting_stress_coefficient": 0.09, "limiting_stress_offset": 2e6}
    scene = SCENE.with_(bodies={"load": load}, lubricant=fluid, numerics={"grid": "given"})
    one = lubfric.friction(scene.with_(numerics={"closure": "one-way"}), speed)
    whole = lubfric.friction(scene.with_(numerics={"model": "deterministic"}), speed)
    told = one.uncertainty.model_form
    assert abs(one.coefficient / whole.coefficient - 1) < told < 0.04
    assert one.one_way[-1].left_out > 0.001


def test_what_the_one_way_closure_leaves_out_is_the_deflection_by_its_film():
    """Summed over cells by the line load and the strip of each column where nothing changes across: the waves run along
    y = const, so the deflection is that of a plane, found here by Flamant's logarithm between cells."""
    waves = lubfric.Surface(
        np.repeat(2e-8 * np.cos(2 * np.pi * np.arange(128) / 16)[:, None], 4, axis=1),
        (1e-6, 1e-6),
        periodic_axes=(True, True),
    )
    scene = SCENE.with_(numerics={"closure": "one-way", "grid": "given"})
    one = lubfric.friction(lubfric.prepare(scene, surface=waves), 0.02).one_way[-1]
    p, dx, e_prime = one.film_pressure.mean(axis=1), one.x[1] - one.x[0], scene.bodies.e_prime
    ends = (one.x[:, None] - one.x[None, :]) + np.array([-0.5, 0.5])[:, None, None] * dx
    whole = np.diff(ends * np.log(np.abs(ends)), axis=0)[0]
    u = -4 / (np.pi * e_prime) * whole @ p
    strip = np.abs(one.x) <= scene.bodies.half_width
    assert one.left_out == pytest.approx(u[strip].std() / one.gap[strip].mean(), rel=0.02)
