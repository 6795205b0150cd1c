"""Elastic deflection of a half-space under a piecewise linear line pressure.

The pressure may also be imposed on a film, such as that of asperities in contact.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .._base import array
from ..errors import InputError


def hat_kernel(points: np.ndarray, nodes: np.ndarray) -> np.ndarray:
    """Matrix K (points, nodes) of -(4/pi) ∫ phi_j(x') ln|x_i - x'| dx', exact.

    phi_j are the hat functions on increasing ``nodes`` (half hats at both ends). With
    G(s) = s²/2 ln|s| - 3/4 s², G'' = ln|s|, each integral is the second divided difference of
    G(x_i - x_j) over the nodes of the hat, plus a G' term at the two ends.
    """
    s = points[:, None] - nodes[None, :]
    log = np.log(np.where(s == 0.0, 1.0, np.abs(s)))
    slope = np.diff(s * s * (0.5 * log - 0.75), axis=1)
    slope /= np.diff(nodes)
    K = np.empty_like(s)
    np.subtract(slope[:, 1:], slope[:, :-1], out=K[:, 1:-1])
    K[:, 0] = slope[:, 0] + s[:, 0] * (log[:, 0] - 1.0)
    K[:, -1] = -slope[:, -1] - s[:, -1] * (log[:, -1] - 1.0)
    K *= -4.0 / math.pi
    return K


@dataclass(frozen=True)
class LinePressure:
    """Piecewise linear pressure [Pa] between the nodes ``x`` [m], ascending; zero outside, where it may jump."""

    x: np.ndarray
    pressure: np.ndarray

    @property
    def load(self) -> float:
        """Load of the whole pressure [N/m]."""
        return float(np.sum(0.5 * (self.pressure[1:] + self.pressure[:-1]) * np.diff(self.x)))

    def mirrored(self) -> LinePressure:
        """The same pressure, seen from the other side."""
        return LinePressure(-self.x[::-1], self.pressure[::-1])


def line_pressure(value) -> LinePressure | None:
    """The pressure ``value`` = (x [m], pressure [Pa]), checked, without the nodes far from any pressure. None if the
    pressure is zero."""
    if value is None:
        return None
    if isinstance(value, LinePressure):
        value = value.x, value.pressure
    if not isinstance(value, (tuple, list)) or len(value) != 2:
        raise InputError(f"imposed_pressure = {type(value).__name__}; allowed: None or a pair (x [m], pressure [Pa])")
    x = array("imposed_pressure[0]", value[0], "m", ndim=1)
    pressure = array("imposed_pressure[1]", value[1], "Pa", ndim=1)
    if x.size != pressure.size or x.size < 2 or not np.all(np.diff(x) > 0.0):
        raise InputError(
            f"imposed_pressure has {x.size} positions and {pressure.size} pressures; allowed: as many of "
            "each, at least 2, the positions [m] ascending"
        )
    if pressure.min() < 0.0:
        raise InputError(f"imposed_pressure falls to {pressure.min():.4g} Pa; allowed: 0 and above")
    loaded = np.flatnonzero(pressure)
    if loaded.size == 0:
        return None
    used = slice(max(loaded[0] - 1, 0), loaded[-1] + 2)
    return LinePressure(x[used], pressure[used])


def line_deflection(points: np.ndarray, nodes: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """-(4/pi) ∫ p(x') ln|x - x'| dx' of a piecewise linear p, and its derivative by x, exact, at ``points`` (n,).

    p'' is a spike at every kink, and a double one at each of the two jumps at the ends. Let G(s) = s²/2 ln|s| - 3/4 s²,
    so that G'' = ln|s|. The integral is the sum of G times the kinks and of G' times the jumps. Beside a jump the
    derivative is infinite. A point on an end node with a pressure gets the finite part of its neighbourhood.
    """
    slope = np.diff(values) / np.diff(nodes)
    kinks = np.diff(slope, prepend=0.0, append=0.0)
    s = points[:, None] - nodes[None, :]
    log = np.log(np.where(s == 0.0, 1.0, np.abs(s)))
    first = s * (log - 1.0)
    value = (s * s * (0.5 * log - 0.75)) @ kinks + values[0] * first[:, 0] - values[-1] * first[:, -1]
    derivative = first @ kinks + values[0] * log[:, 0] - values[-1] * log[:, -1]
    return -4.0 / math.pi * value, -4.0 / math.pi * derivative
