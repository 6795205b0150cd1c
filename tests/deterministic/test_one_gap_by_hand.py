"""The mass balance of one gap on cells that are longer along one axis, against derivatives written out; its laws of
thinning; and what mirroring the roughness must not change."""

import math

import numpy as np
import pytest

import lubfric
from lubfric.contact import half_space
from lubfric.deterministic import Problem
from lubfric.deterministic.flow import balance
from lubfric.deterministic.rheology import thinning
from lubfric.film import LineContact
from lubfric.oil import Lubricant

ETA, U, RADIUS, DX, DY = 0.1, 0.4, 2e-3, 4e-6, 9e-6
SHAPE = (40, 24)
WATER = Lubricant(ETA, viscosity_law="constant")


def problem(lubricant=WATER):
    x = (np.arange(SHAPE[0]) - 30) * DX
    contact = LineContact(900.0, RADIUS, 231e9, U, lubricant)
    return Problem(contact, 2 * U, x, np.zeros(SHAPE), half_space(SHAPE, (DX, DY), 231e9, ("free", "periodic")), 0.09)


@pytest.mark.parametrize("axis, waves", [(0, 2), (1, 2), (1, 3)])
def test_a_wave_of_pressure_drives_its_flow_along_its_own_axis(axis, waves):
    """In an even gap: div(-h³/(12 eta) grad p), with the difference of neighbours for the derivative."""
    h, step = 2e-7, (DX, DY)[axis]
    places = np.arange(SHAPE[axis])
    line = 1e7 * (2 + np.sin(2 * np.pi * waves * places / SHAPE[axis]))
    p = np.broadcast_to(line[:, None] if axis == 0 else line[None, :], SHAPE)
    found = balance(problem(), p, np.full(SHAPE, h)).residual[2:-1]
    second = (np.roll(line, -1) - 2 * line + np.roll(line, 1)) / step**2
    expected = -(h**3) / (12 * ETA) * (second[2:-1, None] if axis == 0 else second[None, :])
    np.testing.assert_allclose(
        found, np.broadcast_to(expected, found.shape), rtol=1e-8, atol=1e-8 * abs(expected).max()
    )


def test_a_wedge_takes_in_what_it_is_dragged():
    """U dh/dx without pressure, for a gap that falls in a straight line; across the motion a slope drags nothing."""
    x = np.arange(SHAPE[0]) * DX
    h = 4e-7 - 1e-3 * np.broadcast_to(x[:, None], SHAPE)
    np.testing.assert_allclose(balance(problem(), np.zeros(SHAPE), h).residual[3:], -U * 1e-3, rtol=1e-9)
    across = np.broadcast_to(3e-7 + 1e-8 * np.arange(SHAPE[1])[None, :], SHAPE)
    np.testing.assert_allclose(balance(problem(), np.zeros(SHAPE), across).residual[3:], 0.0, atol=1e-12)


def test_the_narrowest_place_limits_the_flow():
    """Between two cells with h linear the mean of 1/h³ is (h1 + h2)/(2 h1² h2²)."""
    p, h = np.full(SHAPE, 1e7), np.full(SHAPE, 4e-7)
    p[:, 5], h[:, 5] = 3e7, 1e-7
    flow = balance(problem(), p, h).across.flow
    mean = (1e-7 + 4e-7) / (2 * 1e-14 * 16e-14)
    np.testing.assert_allclose(flow[:, 5], 2e7 / DY / (12 * ETA * mean), rtol=1e-9)
    np.testing.assert_allclose(flow[:, 4], -2e7 / DY / (12 * ETA * mean), rtol=1e-9)


@pytest.mark.parametrize("s", [0.3, 3.0, 40.0])
def test_sliding_thins_by_eyrings_law_and_by_the_limit(s):
    """Conry et al. (1987): the tangent √(1 + s²) along the sliding, the secant s/asinh(s) across; a limit adds s."""
    oil, tau = Lubricant(ETA, 1e-8, eyring_stress=5e6), np.array([s * 5e6])
    along, across = (float(thinning(oil, tau, None, way)[0][0]) for way in (True, False))
    assert along == pytest.approx(math.sqrt(1 + s * s)) and across == pytest.approx(s / math.asinh(s))
    limited = Lubricant(ETA, 1e-8, limiting_stress_coefficient=0.05)
    assert float(thinning(limited, tau, np.array([2e7]), True)[0][0]) == pytest.approx(1 + s * 5e6 / 2e7)


SCENE = lubfric.load_scene("paper").with_(
    contact={"shape": (40, 24), "spacing": (2.2e-6, 3.1e-6)},
    surface={"acf": "gaussian", "correlation_length": 12e-6},
    numerics={"model": "deterministic", "grid": "given", "accept": True, "sampling": "patch"},
)


@pytest.fixture(scope="module")
def solved():
    prepared = lubfric.prepare(SCENE)
    return prepared.surface, lubfric.friction(prepared, 0.01, fields=True)


def test_pressure_and_spots_add_up_to_the_load(solved):
    _, point = solved
    found, f_b = point.deterministic.result, SCENE.bodies.boundary_friction_coefficient
    cell = found.spacing[0] / found.pressure.shape[1]
    assert found.boundary == pytest.approx(f_b * found.pressure[found.spots].sum() * cell, rel=1e-12)
    assert found.pressure.sum() * cell + found.inlet_load == pytest.approx(found.load, rel=1e-3)


def test_no_film_beyond_its_range_rubs_more_than_a_spot():
    """A Newtonian film above 50 MPa is taken at the stress of the boundary film, where its own would be larger."""
    smooth = SCENE.with_(surface={"sq": 2e-8}, bodies={"load": 30.0})
    found = lubfric.friction(smooth, 0.1, fields=True).deterministic.result
    f_b = SCENE.bodies.boundary_friction_coefficient
    own = lubfric.oil.viscosity(SCENE.lubricant, found.pressure) * 0.2 / found.gap
    capped = (found.gap > 2e-8) & (found.pressure > 50e6) & (own > f_b * found.pressure)
    assert capped.any()
    np.testing.assert_allclose(found.shear[capped], f_b * found.pressure[capped], rtol=1e-12)


def test_a_surface_turned_over_along_the_line_slides_the_same(solved):
    surface, point = solved
    mirrored = lubfric.Surface(surface.heights[:, ::-1], surface.spacing, periodic_axes=surface.periodic_axes)
    other = lubfric.friction(lubfric.prepare(SCENE, mirrored), 0.01, fields=True)
    assert other.coefficient == pytest.approx(point.coefficient, rel=2e-4)
    np.testing.assert_allclose(other.gap[:, ::-1], point.gap, rtol=0.02, atol=1e-10)
