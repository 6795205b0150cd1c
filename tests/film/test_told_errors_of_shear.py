"""The errors that the sums of the film's shear tell: as large as the sums are off, by closed forms; and the stress
above what oils carry."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

import lubfric
from lubfric.film import rigid_cylinder, shear_force
from lubfric.film.shear import rolling_error, spike_error
from lubfric.oil import Lubricant

R, ETA, U, B = 2e-3, 0.36, 1.0, 6e-3
OIL = Lubricant(ETA, 1e-13, "barus")


@pytest.fixture(scope="module")
def film():
    return lubfric.solve_ehl(
        load_per_width=100.0,
        radius=R,
        e_prime=231e12,
        entrainment_speed=U,
        viscosity=ETA,
        pressure_viscosity_coefficient=1e-13,
        viscosity_law="barus",
    )


def force(film, **options):
    given = {"slide_roll_ratio": 2.0, "width": B, "contact_fraction": lambda x: np.zeros(x.size - 1)}
    return shear_force(film, OIL, **given | options)


@pytest.mark.parametrize("steps", [40, 80, 161])
def test_a_sum_of_rolling_tells_how_far_it_is_off(steps):
    """∫ (h/2) dp of h = 1 + x² and p = exp(-x²): the error told is the error made, or somewhat more."""
    x = np.linspace(-3.0, 2.0, steps)
    h, p = 1 + x**2, np.exp(-(x**2))
    exact = quad(lambda t: 0.5 * (1 + t * t) * -2 * t * np.exp(-t * t), -3, 2, epsabs=1e-13)[0]
    off = abs(np.sum(0.25 * (h[1:] + h[:-1]) * np.diff(p)) - exact)
    assert off * 0.9 < rolling_error(p, h, 1.0) < 2 * off


@pytest.mark.parametrize("width", [0.9, 1.1])
def test_a_spike_between_the_nodes_is_seldom_worse_than_told(width):
    """Spikes anywhere between nodes one apart: nine of ten sums are off by no more than is told, which is no less than
    half a per cent of a narrow spike where the nodes see it worst."""
    x, area = np.arange(41.0), width * np.sqrt(np.pi)
    spikes = [np.exp(-(((x - at) / width) ** 2)) for at in np.linspace(20.0, 22.0, 41)]
    off = np.array([abs(np.sum(0.5 * (tau[1:] + tau[:-1])) - area) for tau in spikes])
    told = np.array([spike_error(x, tau) for tau in spikes])
    assert np.mean(off <= told) > 0.9
    assert told.max() > 0.08 * np.exp(-(np.pi**2) * width**2 / 4) * area


def test_the_sum_of_the_sliding_shear_is_as_sure_as_it_tells(film):
    """On every fourth node: against the closed form of the rigid cylinder."""
    exact = B * rigid_cylinder.couette_friction(film.min_film, radius=R, speed_difference=2 * U, viscosity=ETA)
    keep = np.unique(np.append(np.flatnonzero(film.x >= film.rupture)[0], np.arange(0, film.x.size, 4)))
    coarse = replace(film, x=film.x[keep], pressure=film.pressure[keep], film_thickness=film.film_thickness[keep])
    found = force(coarse)
    off = abs(found.couette - exact)
    assert off > 1e-4 * exact and off < found.quadrature < 20 * off


def test_stress_above_what_oils_carry_is_told_with_its_force(film):
    """5 MPa + 0.12 p, typed; the film is so thick that it takes a thousandfold sliding."""
    found = force(film, slide_roll_ratio=1e3)
    x, p, tau = film.x, film.pressure, ETA * 1e3 * U / film.film_thickness
    above = np.maximum(tau - 5e6 - 0.12 * p, 0.0)
    full = x[:-1] < film.rupture
    expected = B * np.sum((0.5 * (above[1:] + above[:-1]) * np.diff(x))[full])
    assert found.excess == pytest.approx(expected, rel=1e-3) and expected > 0
    assert found.stress_ratio == pytest.approx(np.max(tau / (5e6 + 0.12 * p)), rel=1e-3)
    assert force(film, slide_roll_ratio=1e-3).excess == 0
