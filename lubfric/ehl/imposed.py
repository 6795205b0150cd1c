"""A line pressure that deflects the film without being carried by it, such as that of asperities in contact."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..errors import InputError
from ..validate import array


@dataclass(frozen=True)
class LinePressure:
    """Piecewise linear pressure [Pa] between the nodes ``x`` [m], ascending; zero outside, where it may jump."""

    x: np.ndarray
    pressure: np.ndarray

    @property
    def load(self) -> float:
        """Of it all [N/m]."""
        return float(np.sum(0.5 * (self.pressure[1:] + self.pressure[:-1]) * np.diff(self.x)))

    def mirrored(self) -> LinePressure:
        """The same seen from the other side."""
        return LinePressure(-self.x[::-1], self.pressure[::-1])


def line_pressure(value) -> LinePressure | None:
    """``value`` = (x [m], pressure [Pa]) checked, without the nodes far from any pressure; None where that is zero."""
    if value is None:
        return None
    if isinstance(value, LinePressure):
        value = value.x, value.pressure
    if not isinstance(value, (tuple, list)) or len(value) != 2:
        raise InputError(f"imposed_pressure = {type(value).__name__}; allowed: None or a pair (x [m], pressure [Pa])")
    x = array("imposed_pressure[0]", value[0], "m", ndim=1)
    pressure = array("imposed_pressure[1]", value[1], "Pa", ndim=1)
    if x.size != pressure.size or x.size < 2 or not np.all(np.diff(x) > 0.0):
        raise InputError(f"imposed_pressure has {x.size} positions and {pressure.size} pressures; allowed: as many of "
                         "each, at least 2, the positions [m] ascending")
    if pressure.min() < 0.0:
        raise InputError(f"imposed_pressure falls to {pressure.min():.4g} Pa; allowed: 0 and above")
    loaded = np.flatnonzero(pressure)
    if loaded.size == 0:
        return None
    used = slice(max(loaded[0] - 1, 0), loaded[-1] + 2)
    return LinePressure(x[used], pressure[used])


def line_deflection(points: np.ndarray, nodes: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """-(4/pi) ∫ p(x') ln|x - x'| dx' of a piecewise linear p and its derivative by x, exact, at ``points`` (n,).

    p'' is a spike at every kink and a double one at each of the two jumps at the ends; with G(s) = s²/2 ln|s| - 3/4 s²,
    G'' = ln|s|, the integral is the sum of G times the kinks and of G' times the jumps. Beside a jump the derivative
    is infinite: points on an end node with a pressure there get that of their neighbourhood's finite part.
    """
    slope = np.diff(values) / np.diff(nodes)
    kinks = np.diff(slope, prepend=0.0, append=0.0)
    s = points[:, None] - nodes[None, :]
    log = np.log(np.where(s == 0.0, 1.0, np.abs(s)))
    first = s * (log - 1.0)
    value = (s * s * (0.5 * log - 0.75)) @ kinks + values[0] * first[:, 0] - values[-1] * first[:, -1]
    derivative = first @ kinks + values[0] * log[:, 0] - values[-1] * log[:, -1]
    return -4.0 / math.pi * value, -4.0 / math.pi * derivative
