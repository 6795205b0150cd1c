"""Shear force of the film against the closed forms of the rigid isoviscous cylinder; the errors that it tells."""

from dataclasses import replace

import numpy as np
import pytest
import rigid_cylinder as rigid
from scipy.integrate import quad

import lubfric
from lubfric.contact import ContactState
from lubfric.film import rolling_error, shear_force, spike_error
from lubfric.oil import Lubricant

R = 2e-3
ETA = 0.36
U = 1.0
B = 6e-3
OIL = Lubricant(ETA, 1e-13, viscosity_law="barus")


def film(speed=U, tolerance=1e-4):
    oil = {"viscosity": ETA, "pressure_viscosity_coefficient": 1e-13, "viscosity_law": "barus"}
    line = {"load_per_width": 100.0, "radius": R, "e_prime": 231e12, "entrainment_speed": speed}
    return lubfric.solve_ehl(**line, **oil, tolerance=tolerance)


def evenly(share):
    return lambda x: np.full(x.size - 1, share)


def force(result, slide_roll_ratio=2.0, contact_fraction=evenly(0.0), lubricant=OIL, **kw):
    return shear_force(
        result, lubricant, width=B, slide_roll_ratio=slide_roll_ratio, contact_fraction=contact_fraction, **kw
    )


def test_rigid_isoviscous_friction():
    result = film()
    parts = force(result)
    exact = rigid.couette_friction(result.min_film, radius=R, speed_difference=2 * U, viscosity=ETA)
    assert parts.couette == pytest.approx(B * exact, rel=1e-3)
    exact = rigid.rolling_friction(result.min_film, radius=R, entrainment_speed=U, viscosity=ETA)
    assert parts.rolling == pytest.approx(B * exact, rel=1e-3)
    assert parts.total == parts.couette + parts.rolling


def test_the_side_the_shear_is_taken_on():
    """On the slower surface the pressure gradient pulls the other way; without sliding only it remains."""
    result = film()
    fast, slow, rolling = (force(result, s) for s in (2.0, -2.0, 0.0))
    assert slow.couette == pytest.approx(fast.couette) and slow.rolling == -fast.rolling
    assert rolling.couette == 0 and rolling.rolling == fast.rolling
    # whole force on the slower, inclined body: its shear and the horizontal part of the pressure, ∫ h dp = 2 rolling
    assert slow.total + 2 * fast.rolling == pytest.approx(fast.total)


def test_reversed_motion_gives_the_same_force():
    a = force(film())
    b = force(film(-U))
    assert b.couette == pytest.approx(a.couette) and b.rolling == pytest.approx(a.rolling)


def test_asperity_contacts_carry_no_shear():
    result = film()
    full = force(result)
    half = force(result, contact_fraction=evenly(0.5))
    inlet_share = half.couette / full.couette - 0.5  # only the far inlet is left whole
    assert 0 <= inlet_share < 0.15
    one_sided = force(result, contact_fraction=lambda x: np.where(x[1:] < 0, 0.0, 1.0))
    other = force(result, contact_fraction=lambda x: np.where(x[1:] < 0, 1.0, 0.0))
    tail = force(result, contact_fraction=evenly(1.0))
    assert one_sided.couette + other.couette == pytest.approx(full.couette + tail.couette)


def test_streamers_add_shear_behind_the_rupture():
    result = film()
    dry = force(result)
    wet = force(result, cavitated="striated")
    assert 0.02 < wet.couette / dry.couette - 1 < 0.5 and wet.rolling == dry.rolling


def test_the_share_in_contact_is_that_of_each_cell_of_the_film():
    """Whatever the nodes, no contact is lost or counted twice; a cell within one column has the share of that
    column."""
    x = np.linspace(-1.5, 1.5, 4)
    closure = ContactState(
        mean_gap=1.0,
        mean_film=1.0,
        x=x,
        contact_fraction=np.array([0.1, 0.9, 0.2, 0.4]),
        real_contact_area_fraction=0.4,
        plastic_area_fraction=0.0,
    )
    nodes = np.array([-3.0, -1.7, -0.4, -0.2, 0.7, 5.0])
    share = closure.touching(nodes)
    assert share @ np.diff(nodes) == pytest.approx(closure.contact_fraction.sum())
    assert share[2] == pytest.approx(0.9)
    np.testing.assert_allclose(closure.touching(nodes[::-1]), share[::-1])


def test_couette_of_a_heated_film_does_not_depend_on_where_its_nodes_begin():
    """A parabolic gap without pressure, whose own heat takes a fifth of its viscosity: the part upstream of the first
    node is as thin as that between the nodes."""
    from types import SimpleNamespace

    radius = 0.03
    sliding = 2.0
    result = []
    oil = Lubricant(0.1, 1e-8)
    how = {"slide_roll_ratio": 0.5, "width": 0.01, "contact_fraction": lambda at: np.zeros(at.size - 1)}
    how["heated"] = lambda x, p, h: 0.8 * 0.1 * sliding / h
    for first in (-4e-3, -1e-3):
        x = np.linspace(first, 0.0, 4001)
        film = {"x": x, "pressure": np.zeros(x.size), "film_thickness": 2e-6 + x**2 / (2 * radius), "rolling": None}
        film |= {"entrainment_speed": 4.0, "radius": radius, "rupture": 0.0, "flow_film": 2e-6, "inlet": None}
        result.append(shear_force(SimpleNamespace(**film), oil, **how).couette)
    exact = 0.01 * 0.8 * 0.1 * sliding * np.sqrt(2 * radius / 2e-6) * np.pi / 2  # B eta U ∫ dx/h from -∞ to 0
    np.testing.assert_allclose(result, exact, rtol=1e-4)


# the errors that the sums tell: as large as the sums are off, by closed forms


@pytest.mark.parametrize("steps", [40, 80, 161])
def test_a_sum_of_rolling_tells_how_far_it_is_off(steps):
    """∫ (h/2) dp of h = 1 + x² and p = exp(-x²): the error told is the error made, or somewhat more."""
    x = np.linspace(-3.0, 2.0, steps)
    h = 1 + x**2
    p = np.exp(-(x**2))
    exact = quad(lambda t: 0.5 * (1 + t * t) * -2 * t * np.exp(-t * t), -3, 2, epsabs=1e-13)[0]
    off = abs(np.sum(0.25 * (h[1:] + h[:-1]) * np.diff(p)) - exact)
    assert off * 0.9 < rolling_error(p, h, 1.0) < 2 * off


@pytest.mark.parametrize("width", [0.9, 1.1])
def test_a_spike_between_the_nodes_is_seldom_worse_than_stated(width):
    """Spikes anywhere between nodes one apart: nine of ten sums are off by no more than is told, which is no less than
    half a per cent of a narrow spike where the nodes see it worst."""
    x = np.arange(41.0)
    area = width * np.sqrt(np.pi)
    spikes = [np.exp(-(((x - at) / width) ** 2)) for at in np.linspace(20.0, 22.0, 41)]
    off = np.array([abs(np.sum(0.5 * (tau[1:] + tau[:-1])) - area) for tau in spikes])
    stated = np.array([spike_error(x, tau) for tau in spikes])
    assert np.mean(off <= stated) > 0.9
    assert stated.max() > 0.08 * np.exp(-(np.pi**2) * width**2 / 4) * area


def test_the_sum_of_the_sliding_shear_is_as_sure_as_it_tells():
    """On every fourth node: against the closed form of the rigid cylinder."""
    result = film()
    exact = B * rigid.couette_friction(result.min_film, radius=R, speed_difference=2 * U, viscosity=ETA)
    keep = np.unique(np.append(np.flatnonzero(result.x >= result.rupture)[0], np.arange(0, result.x.size, 4)))
    fields = {name: getattr(result, name)[keep] for name in ("x", "pressure", "film_thickness")}
    coarse = replace(result, **fields)
    solution = force(coarse)
    off = abs(solution.couette - exact)
    assert off > 1e-4 * exact and off < solution.quadrature < 20 * off


def test_stress_above_what_oils_carry_is_reported_with_its_force():
    """5 MPa + 0.12 p, typed; the film is so thick that it takes a thousandfold sliding."""
    result = film()
    solution = force(result, slide_roll_ratio=1e3)
    x = result.x
    p = result.pressure
    tau = ETA * 1e3 * U / result.film_thickness
    above = np.maximum(tau - 5e6 - 0.12 * p, 0.0)
    full = x[:-1] < result.rupture
    expected = B * np.sum((0.5 * (above[1:] + above[:-1]) * np.diff(x))[full])
    assert solution.excess == pytest.approx(expected, rel=1e-3) and expected > 0
    assert solution.stress_ratio == pytest.approx(np.max(tau / (5e6 + 0.12 * p)), rel=1e-3)
    assert force(result, slide_roll_ratio=1e-3).excess == 0
