"""Shear of an exponential fluid between isothermal walls that move past one another: exact.

``eta = eta_w exp(-beta (T - T_w))`` across a film of thickness h with conductivity k, sheared by ``dU``: with
``Na = beta eta_w dU²/k`` (the Nahme or Brinkman number) the stress is constant across the film and
``tau/(eta_w dU/h) = asinh(√(Na/8))/√((Na/8)(1 + Na/8))``, 1 - Na/12 at first.
R. Nahme, Ingenieur-Archiv 11 (1940) 191-209, doi:10.1007/BF02086920.
"""

from __future__ import annotations

import math

import numpy as np


def nahme_number(viscosity, sliding, temperature_coefficient, conductivity):
    """Na [-] = beta eta dU²/k from eta at the walls [Pa s], dU [m/s], beta [1/K], k [W/(m K)]."""
    return temperature_coefficient * viscosity * np.square(sliding) / conductivity


def stress_ratio(nahme):
    """tau over the isothermal stress [-], 0 < tau <= 1."""
    a = np.asarray(nahme, dtype=float) / 8
    with np.errstate(divide="ignore", invalid="ignore"):
        exact = np.arcsinh(np.sqrt(a)) / np.sqrt(a * (1 + a))
    return np.where(a < 1e-8, 1 - 2 * a / 3, exact)


def largest_rise(nahme, temperature_coefficient):
    """Rise of the temperature in the middle of the film [K]: ln(1 + Na/8)/beta."""
    return np.log1p(np.asarray(nahme) / 8) / temperature_coefficient


def profile(across, nahme, temperature_coefficient):
    """Rise [K] at ``across`` (0 to 1 from wall to wall)."""
    s = math.asinh(math.sqrt(nahme / 8))
    return (math.log1p(nahme / 8) - 2 * np.log(np.cosh(s * (2 * np.asarray(across) - 1)))) / temperature_coefficient
