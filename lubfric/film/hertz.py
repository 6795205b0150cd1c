"""Frictionless elastic contact of smooth bodies: line and point (Hertz 1882).

Everywhere ``2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2`` and ``1/R = 1/R1 + 1/R2``. Valid while the
contact is small beside R, so that each body is a half-space, and stresses are elastic.
Source: K. L. Johnson, Contact Mechanics, 1985, Sec. 4.2, doi:10.1017/CBO9781139171731.
"""

from __future__ import annotations

import numpy as np

from .._base import validate


def composite_modulus(young_1, poisson_1, young_2, poisson_2) -> float:
    """E' [Pa] of two bodies with Young's moduli [Pa] and Poisson ratios [-]:
    ``2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2``.

    Raises `InputError` unless E > 0 and -1 <= nu <= 0.5. A rigid body has ``young = math.inf``.
    """
    compliance = 0.0
    for i, (e, nu) in enumerate(((young_1, poisson_1), (young_2, poisson_2)), start=1):
        nu = validate.number(f"poisson_{i}", nu, "(-)", minimum=-1.0, maximum=0.5)
        if e != np.inf:
            compliance += (1 - nu**2) / validate.positive(f"young_{i}", e, "Pa")
    return 2 / validate.positive("compliance of the two bodies (1 - nu^2)/E", compliance, "1/Pa")


def line_half_width(load_per_width, radius, e_prime):
    """b [m] = sqrt(8 w R / (pi E')); w [N/m], R [m], E' [Pa]."""
    return np.sqrt(8 * load_per_width * radius / (np.pi * e_prime))


def line_peak_pressure(load_per_width, radius, e_prime):
    """p_h [Pa] = 2 w / (pi b)."""
    return 2 * load_per_width / (np.pi * line_half_width(load_per_width, radius, e_prime))


def line_mean_pressure(load_per_width, radius, e_prime):
    """w / (2 b) [Pa], pi/4 of the peak."""
    return load_per_width / (2 * line_half_width(load_per_width, radius, e_prime))


def line_pressure(x, load_per_width, radius, e_prime):
    """p(x) [Pa] = p_h sqrt(1 - x^2/b^2) inside, 0 outside; x [m] from the centre line."""
    ratio = np.asarray(x) / line_half_width(load_per_width, radius, e_prime)
    return line_peak_pressure(load_per_width, radius, e_prime) * np.sqrt(np.maximum(1 - ratio**2, 0))


def line_gap(x, load_per_width, radius, e_prime):
    """Gap [m] of the loaded contact, 0 inside; with X = |x|/b >= 1,
    ``g = b^2/(2R) [X sqrt(X^2-1) - ln(X + sqrt(X^2-1))]``."""
    b = line_half_width(load_per_width, radius, e_prime)
    big = np.maximum(np.abs(np.asarray(x)) / b, 1.0)
    return b**2 / (2 * radius) * (big * np.sqrt(big**2 - 1) - np.arccosh(big))


def point_radius(load, radius, e_prime):
    """a [m] = (3 F R / (2 E'))^(1/3); F [N], R [m], E' [Pa]."""
    return np.cbrt(1.5 * load * radius / e_prime)


def point_peak_pressure(load, radius, e_prime):
    """p_0 [Pa] = 3 F / (2 pi a^2)."""
    return 1.5 * load / (np.pi * point_radius(load, radius, e_prime) ** 2)


def point_mean_pressure(load, radius, e_prime):
    """F / (pi a^2) [Pa], two thirds of the peak."""
    return load / (np.pi * point_radius(load, radius, e_prime) ** 2)


def point_approach(load, radius, e_prime):
    """delta [m] = a^2/R, the approach of distant points."""
    return point_radius(load, radius, e_prime) ** 2 / radius


def point_load(approach, radius, e_prime):
    """F [N] = (2/3) E' sqrt(R) delta^1.5 for delta >= 0 [m]; 0 for a gap (delta < 0)."""
    return 2 / 3 * e_prime * np.sqrt(radius) * np.maximum(approach, 0.0) ** 1.5


def point_pressure(r, load, radius, e_prime):
    """p(r) [Pa] = p_0 sqrt(1 - r^2/a^2) inside, 0 outside; r [m] from the centre."""
    ratio = np.asarray(r) / point_radius(load, radius, e_prime)
    return point_peak_pressure(load, radius, e_prime) * np.sqrt(np.maximum(1 - ratio**2, 0))
