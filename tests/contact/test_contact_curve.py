"""What is read off a contact curve, beside the contact solved where it is read."""

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

import lubfric
from lubfric.contact import contact_curve

E_PRIME = 231e9
HEAVIEST = 2e8


@pytest.fixture(scope="module")
def surface():
    """So small that its summits come into contact one by one."""
    return lubfric.generate_surface((36, 36), 1e-6, sq=1e-7, correlation_length=3e-6, seed=8)


def test_the_stated_error_holds_where_the_contact_is_solved(surface):
    curve = contact_curve(surface.heights, surface.spacing, E_PRIME, heaviest=HEAVIEST, accuracy=3e-3)
    gap0 = surface.heights.max() - surface.heights
    pressures = HEAVIEST * np.exp(-np.linspace(0.3, 8.0, 12))
    off = []
    stated = []
    for pressure in pressures:
        solved = lubfric.solve_contact(gap0, surface.spacing, E_PRIME, mean_pressure=pressure, tolerance=1e-7)
        off.append(abs(curve.at(pressure)[0] - solved.mean_gap))
        stated.append(curve.errors_at(pressure)[0])
    assert np.mean(np.array(off) <= stated) >= 0.75 and np.all(np.array(off) <= 4 * np.array(stated))
    lightest = curve.mean_pressure[-1]
    below = curve.mean_pressure[-1] / 2
    solved = lubfric.solve_contact(gap0, surface.spacing, E_PRIME, mean_pressure=below, tolerance=1e-7)
    assert abs(curve.at(below)[0] - solved.mean_gap) <= curve.errors_at(below)[0] <= 3e-3 * curve.touching_gap
    assert lightest < 1e-2 * HEAVIEST and curve.errors_at(0.0)[0] == curve.errors_at(below)[0]


def test_the_stated_error_is_that_of_cubics_without_one_of_the_nodes_around(surface):
    """By the cubics of scipy, of a curve of many nodes and of one of three, which has lines."""
    for heaviest, accuracy in ((HEAVIEST, 3e-3), (0.04 * HEAVIEST, 0.5)):
        curve = contact_curve(surface.heights, surface.spacing, E_PRIME, heaviest=heaviest, accuracy=accuracy)
        x = -np.log(curve.mean_pressure)
        gap = curve.mean_gap
        inner = range(1, x.size - 1)
        cubics = {i: PchipInterpolator(np.delete(x, i), np.delete(gap, i)) for i in inner}
        error = {i: abs(float(cubics[i](x[i])) - gap[i]) for i in inner}
        expected = [max(error.get(j, 0.0) for j in range(i - 1, i + 3)) for i in range(x.size - 1)]
        np.testing.assert_allclose(curve.gap_error, expected, rtol=1e-6, atol=1e-12 * gap[-1])


def test_it_is_part_of_the_numerical_error_of_f():
    """A flat contact whose friction nearly cancels: within what it states of one solved a hundred times tighter."""
    scene = lubfric.load_scene("flat").with_(
        bodies={"radius": 0.026, "width": 1e-2, "load": 16.7, "boundary_friction_coefficient": 0.095},
        lubricant={"viscosity": 5.4e-3, "pressure_viscosity_coefficient": 9.5e-9, "eyring_stress": 5e6},
        motion={"entrainment_speed": 0.63, "slide_roll_ratio": -0.93},
        surface={"sq": 1.1e-7, "correlation_length": 1.27e-5, "seed": 1837620616},
        contact={"shape": (36, 36), "spacing": 2e-4 / 36},
        numerics={"tolerance": 0.01},
    )
    result = lubfric.friction(scene)
    right = lubfric.friction(scene.with_(numerics={"tolerance": 1e-4}))
    assert 0 < result.contact_load < 0.1 * 16.7
    assert abs(result.coefficient - right.coefficient) < result.uncertainty.numerical * abs(right.coefficient)
    without = result.errors.contact_load
    assert without > right.errors.contact_load


def test_the_area_between_nodes_is_within_what_is_stated_and_what_the_film_feels():
    """A small map, whose summits touch a few at a time: the area read against that of the contact solved there."""
    surface = lubfric.generate_surface((28, 28), 7.14e-6, sq=23e-9, correlation_length=16e-6, acf="gaussian", seed=1)
    curve = contact_curve(surface.heights, 7.14e-6, 231e9, heaviest=2e8, hardness=8e9)
    stated = []
    result = []
    for pressure in np.geomspace(2e6, 1.2e8, 24):
        solved = lubfric.solve_contact(-surface.heights, 7.14e-6, 231e9, mean_pressure=pressure, hardness=8e9)
        result.append(abs(curve.at(pressure)[1] - solved.contact_area_fraction) / (1 - solved.contact_area_fraction))
        stated.append(curve.errors_at(pressure)[1] / (1 - solved.contact_area_fraction))
    assert np.all(np.array(result) <= 1.3 * np.array(stated))
    assert max(result) < 3 * 3e-3
    assert curve.errors_at(curve.mean_pressure[-1] / 2)[1] == curve.contact_area_fraction[-1]
