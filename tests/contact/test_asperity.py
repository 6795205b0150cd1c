"""The independent-asperity model: Hertz for one, additivity for many, invariances, limits, bad input."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lubfric import ConvergenceError, InputError, generate_surface
from lubfric.contact import asperity_contact, separation_for_load
from lubfric.contact.asperity import DEFINITIONS
from verification.fem.exact_contact import Sphere

E_PRIME = 231e9
RADIUS = 30e-6
STEP = 50e-9
ROUGH = generate_surface((128, 128), 1e-6, sq=100e-9, correlation_length=8e-6, acf="gaussian", seed=2)


def paraboloids(pitch, count=1, radius=RADIUS, height=500e-9, step=STEP):
    """``count`` x ``count`` equal paraboloids on a plane, one in the middle of each pitch."""
    n = round(pitch / step)
    x = (np.arange(n) - n // 2) * step
    one = np.maximum(height - (x[:, None] ** 2 + x[None, :] ** 2) / (2 * radius), 0.0)
    return np.tile(one, (count, count))


def rough_contact(definition, separation, heights=ROUGH.heights, **changes):
    return asperity_contact(heights, ROUGH.spacing, E_PRIME, separation=separation, definition=definition, **changes)


def pressed(delta):
    """The paraboloid pressed in by ``delta`` [m]."""
    return Sphere(E_PRIME, RADIUS, math.sqrt(RADIUS * delta))


@pytest.mark.parametrize("definition, tolerance", [("summits", 1e-10), ("patches", 0.01)])
def test_one_paraboloid_is_hertz(definition, tolerance):
    delta = 60e-9
    result = asperity_contact(paraboloids(14e-6), STEP, E_PRIME, separation=440e-9, definition=definition)
    assert result.contacts == 1 and tuple(result.index[0]) == (140, 140)
    assert result.radii[0] == pytest.approx(RADIUS, rel=tolerance)
    assert result.load == pytest.approx(pressed(delta).load, rel=tolerance)
    assert result.contact_area == pytest.approx(math.pi * RADIUS * delta, rel=tolerance)
    assert result.mean_pressure == pytest.approx(result.load / (14e-6) ** 2)


@pytest.mark.parametrize("definition", DEFINITIONS)
@settings(max_examples=15)
@given(st.integers(0, 127), st.integers(0, 127), st.booleans(), st.booleans(), st.floats(-1e-6, 1e-6))
def test_shift_mirror_exchange_and_datum_do_not_matter(definition, i, j, flip, swap, datum):
    moved = np.roll(ROUGH.heights, (i, j), (0, 1))
    moved = moved[::-1] if flip else moved
    moved = moved.T if swap else moved
    a = rough_contact(definition, 120e-9)
    b = rough_contact(definition, 120e-9 + datum, moved + datum)
    assert b.contacts == a.contacts
    assert np.allclose(np.sort(b.forces), np.sort(a.forces), rtol=1e-6)


@pytest.mark.parametrize("definition", DEFINITIONS)
def test_a_separation_that_varies_in_space(definition):
    """Lifting surface and flat together changes nothing for patches; one number equals a constant array."""
    flat = np.full(ROUGH.shape, 100e-9)
    assert rough_contact(definition, flat).load == rough_contact(definition, 100e-9).load
    bump = 1e-7 * np.sin(2 * np.pi * np.arange(128) / 128)[:, None] * np.ones(128)
    lifted = rough_contact("patches", flat + bump, ROUGH.heights + bump)
    assert lifted.load == pytest.approx(rough_contact("patches", flat).load, rel=1e-9)


def test_hardness_cuts_the_hertz_pressure_off():
    """Against quadrature of min(p, P_u) over the contact; far below the hardness nothing changes."""
    from scipy import integrate

    hardness = 2e9
    delta = 60e-9
    result = asperity_contact(paraboloids(14e-6), STEP, E_PRIME, separation=440e-9, hardness=hardness)
    a = pressed(delta).contact_radius
    peak = pressed(delta).peak
    assert peak > 1.5 * hardness
    cut = integrate.quad(
        lambda r: r * min(peak * math.sqrt(1 - (r / a) ** 2), hardness),
        0,
        a,
        points=[a * math.sqrt(1 - (hardness / peak) ** 2)],
    )[0]
    assert result.load == pytest.approx(2 * math.pi * cut, rel=1e-8)
    assert 0 < result.plastic_area_fraction < result.contact_area_fraction
    for definition in DEFINITIONS:
        capped = rough_contact(definition, 1e-7, hardness=1e9)
        elastic = rough_contact(definition, 1e-7)
        assert capped.load < elastic.load and capped.load <= 1e9 * capped.contact_area
        assert rough_contact(definition, 1e-7, hardness=1e15).load == elastic.load


def test_open_edges_have_no_summits_and_do_not_join_patches():
    heights = np.zeros((9, 9))
    heights[0, 4] = heights[8, 4] = heights[4, 0] = 1e-7
    assert asperity_contact(heights, 1e-6, E_PRIME, separation=5e-8, periodic=False).contacts == 0
    assert [_patch_count(heights, p) for p in (False, (True, False), (False, True), True)] == [3, 2, 3, 2]
    corners = np.zeros((9, 9))
    corners[0, 0] = corners[8, 8] = corners[0, 8] = 1e-7
    assert [_patch_count(corners, p) for p in (False, (True, False), (False, True), True)] == [3, 2, 2, 1]


def _patch_count(heights, periodic):
    return asperity_contact(heights, 1e-6, E_PRIME, separation=5e-8, definition="patches", periodic=periodic).contacts


@pytest.mark.parametrize("definition, pressure", [*zip(["summits"] * 2 + ["patches"] * 2, [1e6, 2e8, 1e6, 2e7])])
def test_separation_for_load_is_the_inverse(definition, pressure):
    result = separation_for_load(
        ROUGH.heights, ROUGH.spacing, E_PRIME, mean_pressure=pressure, definition=definition, tolerance=0.02
    )
    assert result.report.converged and result.mean_pressure == pytest.approx(pressure, rel=0.02)
    assert rough_contact(definition, result.separation).load == result.load
    if definition == "summits":
        exact = separation_for_load(ROUGH.heights, ROUGH.spacing, E_PRIME, mean_pressure=pressure, tolerance=1e-10)
        assert exact.mean_pressure == pytest.approx(pressure, rel=1e-10)


def test_patches_cannot_carry_every_load():
    """They grow together: the load has a largest value, and asking for more says so."""
    too_much = {"mean_pressure": 50e9, "definition": "patches"}
    with pytest.raises(ConvergenceError, match="cannot carry") as error:
        separation_for_load(ROUGH.heights, ROUGH.spacing, E_PRIME, **too_much)
    assert not error.value.report.converged and 0 < error.value.result.mean_pressure < 50e9
    quiet = separation_for_load(ROUGH.heights, ROUGH.spacing, E_PRIME, **too_much, raise_on_failure=False)
    assert quiet.report.residual == pytest.approx(1 - quiet.mean_pressure / 50e9)


def test_a_jump_over_the_load_is_not_called_converged():
    """When the flat reaches the four neighbours of a top cell the load jumps by sqrt(5)."""
    heights = paraboloids(6e-6, step=500e-9)
    below, above = (
        asperity_contact(
            heights, 500e-9, E_PRIME, definition="patches", separation=500e-9 - (500e-9) ** 2 / (2 * RADIUS) + shift
        ).mean_pressure
        for shift in (1e-15, -1e-15)
    )
    assert above / below == pytest.approx(math.sqrt(5), rel=1e-5)
    with pytest.raises(ConvergenceError) as error:
        separation_for_load(heights, 500e-9, E_PRIME, mean_pressure=1.5 * below, definition="patches")
    assert error.value.report.status == "stagnated" and error.value.report.residual > 0.3


@pytest.mark.parametrize(
    "changes",
    [{"heights": np.zeros(5)}, {"spacing": 0}, {"e_prime": -1}, {"definition": "summit"}, {"hardness": 0}]
    + [{"separation": value} for value in (math.nan, np.zeros(3), "low")],
)
def test_contact_refuses(changes):
    given = {"heights": ROUGH.heights, "spacing": 1e-6, "e_prime": E_PRIME, "separation": 1e-7} | changes
    with pytest.raises(InputError):
        asperity_contact(given.pop("heights"), given.pop("spacing"), given.pop("e_prime"), **given)


@pytest.mark.parametrize("changes", [{"mean_pressure": 0}, {"mean_pressure": math.inf}, {"tolerance": 0}])
def test_inverse_refuses(changes):
    with pytest.raises(InputError):
        separation_for_load(ROUGH.heights, 1e-6, E_PRIME, **{"mean_pressure": 1e6} | changes)
    with pytest.raises(InputError, match="equal"):
        separation_for_load(np.zeros((4, 4)), 1e-6, E_PRIME, mean_pressure=1e6)
