"""Ertel-Grubin inlet: the film that enters a heavily loaded line contact.

Upstream of the Hertz contact the surfaces keep their dry shape, moved apart by the film h*; the
reduced pressure (1 - exp(-alpha p))/alpha must reach 1/alpha at its edge (Barus). With
``X = -x/b = cosh t``, ``G(X) = (X sqrt(X^2-1) - ln(X + sqrt(X^2-1)))/2`` and ``F = h* R/b^2``:
``6 L (8 M/pi)^(-3/2) J(F) = 1``, ``J = integral of G/(F + G)^3 dX over X > 1``. Valid for alpha p_h >> 1 and
F << 1 (Hertz shape undisturbed). Sources: A. M. Ertel 1939 / A. N. Grubin, TsNIITMASh 30 (1949);
C. J. Hooke 1977 for the regime numbers.
"""

from __future__ import annotations

import math

import numpy as np

from .._base import validate
from .formulas import ELASTIC_PIEZOVISCOUS

SERIES_BELOW = 0.05
LARGEST_ANGLE = 25.0


def _inlet_integral(film_over_contact: float) -> float:
    """J(F); the trapezoidal rule in ln t converges exponentially (both ends decay like powers)."""
    t = np.cbrt(film_over_contact) * np.exp(np.arange(-8.0, 60.0, 0.02))
    t = t[t < LARGEST_ANGLE]
    series = t**3 / 3 * (1 + t**2 / 5 + 2 * t**4 / 105 + t**6 / 945)
    gap = np.where(t < SERIES_BELOW, series, 0.25 * np.sinh(2 * t) - 0.5 * t)
    return 0.02 * float(np.sum(gap / (film_over_contact + gap) ** 3 * np.sinh(t) * t))


def inlet_constant(film_over_contact: float) -> float:
    """c in ``H = c M^(-1/8) L^(3/4)`` for F = h* R/b^2 > 0 (Moes units); tends to 1.311 for F -> 0."""
    film = validate.positive("film_over_contact", film_over_contact, "(-)")
    return film * (8 / math.pi) ** (-1 / 8) * (6 * _inlet_integral(film)) ** 0.75


def flow_film(m: float, l: float) -> float:
    """H, the film where dp/dx = 0 in Moes units, from the inlet equation at M > 0, L > 0."""
    from scipy.optimize import brentq

    validate.positive("m", m, "(-)")
    validate.positive("l", l, "(-)")
    scale = 8 * m / math.pi

    def excess(log_film):
        return math.log(6 * l * _inlet_integral(math.exp(log_film)) / scale**1.5)

    start = math.log(ELASTIC_PIEZOVISCOUS * m**-0.125 * l**0.75 / scale)
    low, high = start - 1.0, start + 1.0
    while excess(high) > 0:
        high += 1.0
    while excess(low) < 0:
        low -= 1.0
    return scale * math.exp(brentq(excess, low, high, xtol=1e-12))
