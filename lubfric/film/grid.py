"""Graded grids that move with the rupture point, and the elastic deflection of a half-space under a pressure that is
piecewise linear on them. A pressure may also be imposed on a film, such as that of asperities in contact.

Node positions xi are relative to the rupture point (xi = 0, the last node), so the whole grid moves with this free
boundary. The elastic kernel stays the same, because it depends on differences of positions only. The map t -> xi is
smooth and t is uniform. So doubling the cells nests the grids, and errors have a clean expansion in 1/n.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .._base import validate
from ..errors import InputError

FAR_INLET = 30.0  # distance of the inlet in units of sqrt(2 R h), beyond three half-widths
RISE_CELL, RISE_GROWTH = 0.3, 0.35  # smallest cell where the pressure rises / rise length; growth
RUPTURE_CELL, RUPTURE_GROWTH = 0.1, 0.28  # the same at the rupture point, where film and pressure spike are
CORE = 1.2  # cells spread evenly over the contact, relative to the above


@dataclass(frozen=True)
class Grid:
    """xi: node positions (n + 1); kernel: from pressure to film at the nodes; face_film (n, n + 1): from nodes to
    faces, third-order upwind; face_kernel = face_film @ kernel; weights: of the pressure integral."""

    xi: np.ndarray
    kernel: np.ndarray
    face_film: np.ndarray
    face_kernel: np.ndarray
    cells: np.ndarray
    weights: np.ndarray

    @property
    def n(self) -> int:
        """Number of cells, and of unknown pressures."""
        return self.cells.size

    def stretched(self, s: float) -> Grid:
        """The same nodes ``s`` times as far from the rupture point: ln|s x| = ln s + ln|x|."""
        shift = -4.0 / math.pi * math.log(s) * self.weights
        kernels = s * (self.kernel + shift), s * (self.face_kernel + shift)
        return Grid(s * self.xi, kernels[0], self.face_film, kernels[1], s * self.cells, s * self.weights)


def node_positions(half_width: float, film: float, n: int, distance: float | None = None) -> np.ndarray:
    """n + 1 positions from the inlet (``distance`` upstream of the rupture point) to 0.

    Cells are smallest at the rupture point and just inside the edge of the Hertz contact, where the
    pressure rises over a length that shrinks with sqrt(film)/half_width, and grow in proportion to the
    distance from them. The constants minimise the film error at 192 cells against 1536 over
    M = 0.1-1000, L = 0-20.
    """
    l = math.sqrt(2.0 * film)
    rise = l * (l / (l + half_width)) ** 0.42
    width = 2.0 * half_width + 0.7 * l - 2.0 * rise
    far = distance or 3.0 * half_width + FAR_INLET * l + 0.7 * l
    inner, outer = RISE_CELL * rise, RUPTURE_CELL * rise

    def index(x):
        return (
            np.arcsinh(RISE_GROWTH * (x + width) / inner) / RISE_GROWTH
            + np.arcsinh(RUPTURE_GROWTH * x / outer) / RUPTURE_GROWTH
            + CORE * np.arcsinh(x / scale)
        )

    def density(x):
        return (
            1.0 / np.hypot(inner, RISE_GROWTH * (x + width))
            + 1.0 / np.hypot(outer, RUPTURE_GROWTH * x)
            + CORE / np.hypot(scale, x)
        )

    scale = 2.0 * half_width + 0.7 * l
    away = np.geomspace(0.05 * outer, 2.0 * max(far, scale), 300)
    table = np.sort(np.concatenate([-width - away, [-width], away - width, -away, [0.0]]))
    t = np.linspace(index(-far), index(0.0), n + 1)
    x = np.interp(t, index(table), table)
    for _ in range(3):
        x -= (index(x) - t) / density(x)
    x[0], x[-1] = -far, 0.0
    return x


def trapezoidal(cells: np.ndarray) -> np.ndarray:
    """Weights of the nodes (n + 1,) between ``cells`` (n,), by the trapezoidal rule."""
    return 0.5 * (np.append(0.0, cells) + np.append(cells, 0.0))


def make_grid(xi: np.ndarray) -> Grid:
    """The operators on node positions ``xi``."""
    cells = np.diff(xi)
    kernel = hat_kernel(xi, xi)
    columns, values = _upwind(xi)
    n = cells.size
    face_film = np.zeros((n, n + 1))
    face_film[np.arange(n)[:, None], columns] = values
    face_kernel = (
        values[:, :1] * kernel[columns[:, 0]]
        + values[:, 1:2] * kernel[columns[:, 1]]
        + values[:, 2:] * kernel[columns[:, 2]]
    )
    return Grid(xi, kernel, face_film, face_kernel, cells, trapezoidal(cells))


def _upwind(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Nodes (i-1, i, i+1) and Lagrange weights of the face between i and i+1 (the first: 0, 1, 2)."""
    n = x.size - 1
    columns = np.maximum(np.arange(n), 1)[:, None] + np.array([-1, 0, 1])
    a, b, c = x[columns].T
    f = 0.5 * (x[1:] + x[:-1])
    weights = [
        (f - b) * (f - c) / ((a - b) * (a - c)),
        (f - a) * (f - c) / ((b - a) * (b - c)),
        (f - a) * (f - b) / ((c - a) * (c - b)),
    ]
    return columns, np.stack(weights, axis=1)


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
    x = validate.array("imposed_pressure[0]", value[0], "m", ndim=1)
    pressure = validate.array("imposed_pressure[1]", value[1], "Pa", ndim=1)
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
