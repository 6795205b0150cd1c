"""Dry contact against Hertz, and Johnson, Greenwood and Higginson; the study `contact_grid` has spheres and waves of
one direction."""

import numpy as np
import pytest

from lubfric import solve_contact
from lubfric.film import hertz

E_PRIME = 231e9
CYLINDER = ("free", "periodic")


def cylinder(cells_across, load=917.0, radius=2e-3, columns=4):
    """Solved Hertz line contact with so many cells across its width, in a box of twice that width."""
    b = hertz.line_half_width(load, radius, E_PRIME)
    dx = 2 * b / cells_across
    nx = 2 * cells_across
    x = (np.arange(nx) - 0.5 * (nx - 1)) * dx
    gap0 = np.repeat((x**2 / (2 * radius))[:, None], columns, axis=1)
    return x, solve_contact(gap0, dx, E_PRIME, mean_pressure=load / (nx * dx), boundary=CYLINDER, tolerance=1e-9)


def test_hertz_line():
    """Peak and half-width within 0.5 % at 100 cells across; half-width from the slope of p^2 against x^2."""
    load = 917.0
    radius = 2e-3
    x, result = cylinder(100)
    p = result.pressure[:, 0]
    assert np.ptp(result.pressure, axis=1).max() < 1e-5 * p.max()
    assert p.max() == pytest.approx(hertz.line_peak_pressure(load, radius, E_PRIME), rel=5e-3)
    b = hertz.line_half_width(load, radius, E_PRIME)
    dx = x[1] - x[0]
    assert np.count_nonzero(p) * dx / 2 == pytest.approx(b, rel=5e-3)
    line = np.polyfit(x[p > 0.3 * p.max()] ** 2, p[p > 0.3 * p.max()] ** 2, 1)
    assert np.sqrt(-line[1] / line[0]) == pytest.approx(b, rel=5e-3)
    outside = np.abs(x) > 1.1 * b
    exact = hertz.line_gap(x[outside], load, radius, E_PRIME)
    assert result.gap[outside, 0] == pytest.approx(exact, rel=0.02)


JGH = {
    0.01: (0.03660, 0.81829),
    0.1: (0.19120, 0.38475),
    0.3: (0.51498, 0.12488),
    0.5: (0.70510, 0.04508),
    0.7: (0.84032, 0.01113),
    0.9: (0.95107, 0.00065),
}


@pytest.mark.parametrize("share", JGH)
def test_square_waviness(share):
    """Area and mean gap of K. L. Johnson, J. A. Greenwood, J. G. Higginson (1985), computed on 512 x 512."""
    n = 256
    length = 1e-4
    height = 1e-7
    x = 2 * np.pi * np.arange(n) / n
    gap0 = -height * np.cos(x)[:, None] * np.cos(x)
    full = np.pi * E_PRIME * height / (np.sqrt(2) * length)  # closes the waves
    result = solve_contact(gap0, length / n, E_PRIME, mean_pressure=share * full, tolerance=1e-8)
    area, gap = JGH[share]
    assert result.contact_area_fraction == pytest.approx(area, rel=0.02)
    assert result.mean_gap / height == pytest.approx(gap, abs=1e-3)


def test_full_contact_is_linear():
    """Pressed flat, the pressure is the mean plus E' |k|/4 times the height of each wave."""
    n = 64
    length = 1e-4
    height = 1e-7
    x = 2 * np.pi * np.arange(n) / n
    gap0 = -height * np.cos(x)[:, None] * np.cos(2 * x)
    k = 2 * np.pi / length * np.sqrt(5)
    ripple = E_PRIME * k / 4 * height
    result = solve_contact(gap0, length / n, E_PRIME, mean_pressure=1.5 * ripple)
    assert result.contact_area_fraction == 1
    assert result.pressure == pytest.approx(1.5 * ripple - E_PRIME * k / 4 * gap0, rel=1e-6)
