"""The film beyond the last node: parabolic and isoviscous, up to infinity.

At the distance s > a from the line of centres the film is h = h_a + c (s² - a²)/2. The flow towards the contact is f +
v (s - a), with f the flow at a and v = dh/dt. Reynolds' equation in the units of `lubfric.film.problem` is dp/ds = 6 nu
(f + v (s - a) - U h)/h³, with U the speed towards the contact. So the pressure at a and the load beyond it are linear
in U, f and v. The integrals are taken by Gauss quadrature in a/s.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(24)
_POINTS, _WEIGHTS = 0.5 * (_POINTS + 1.0), 0.5 * _WEIGHTS


@dataclass(frozen=True)
class Tail:
    """A quantity (value), and its derivatives by the flow f, the squeeze rate v and the film h_a."""

    value: float
    by_flow: float
    by_rate: float
    by_film: float


def outside(
    a: float, film: float, curvature: float, nu: float, speed: float, flow: float, rate: float
) -> tuple[Tail, Tail]:
    """The pressure at a and the load beyond a."""
    s, h, weight = _nodes(a, film, curvature)
    d = s - a

    def moment(power, lever):
        return float(np.sum(weight * d**lever / h**power))

    def tail(lever):
        two, three, lifted = moment(2, lever), moment(3, lever), moment(3, lever + 1)
        by_film = -2.0 * speed * three + 3.0 * (flow * moment(4, lever) + rate * moment(4, lever + 1))
        return Tail(
            6.0 * nu * (speed * two - flow * three - rate * lifted),
            -6.0 * nu * three,
            -6.0 * nu * lifted,
            6.0 * nu * by_film,
        )

    return tail(0), tail(1)


def outside_shear(
    a: float, film: float, curvature: float, nu: float, speed: float, flow: float, rate: float
) -> tuple[float, float]:
    """(∫ ds/h, ∫ (h/2) dp/ds ds) beyond a, of the same film."""
    s, h, weight = _nodes(a, film, curvature)
    return float(np.sum(weight / h)), 3.0 * nu * float(np.sum(weight * (flow + rate * (s - a) - speed * h) / h**2))


def _nodes(a: float, film: float, curvature: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points s beyond a, the film there, and the weights ds."""
    s = a / _POINTS
    return s, film + 0.5 * curvature * (s * s - a * a), _WEIGHTS * s * s / a
