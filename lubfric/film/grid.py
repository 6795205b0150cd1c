"""Graded grids that move with the rupture point, and the elastic deflection of a half-space under a pressure that is
piecewise linear on them.

Node positions xi are relative to the rupture point (xi = 0, the last node), so the complete grid moves with this free
boundary. The elastic kernel stays the same, because it depends on differences of positions only. The map t -> xi is
smooth and t is uniform. So doubling the cells nests the grids, and errors have a clean expansion in 1/n.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .._base import FloatArray

# Distance of the inlet over sqrt(2 R h) [-], beyond three half-widths. A choice: further costs cells, nearer thins the
# film (`EHLResult` estimates by how much). Half and twice this value change f by less than .01 %, its interval by up to
# 32 % and the work by up to 2 % (constants.csv).
FAR_INLET = 30.0
# Smallest cell where the pressure rises over the length of the rise [-]. The five sizes and growths of cells were
# chosen for the least error of the film at 192 cells against 1536 (`node_positions`). Half and twice this value change
# f by less than .01 %, its interval by up to 3.8 % and the work by up to 1 % (constants.csv).
RISE_CELL = 0.3
# Growth of the cells with the distance from there [-]; chosen so. Half and twice this value change f by less than .01
# %, its interval by up to 22 % and the work by up to 1 % less (constants.csv).
RISE_GROWTH = 0.35
# Smallest cell at the rupture point, where film and pressure spike are, over the length there [-]; chosen so. Half and
# twice this value change f by less than .01 %, its interval by up to 44 % and the work by less than 1 %
# (constants.csv).
RUPTURE_CELL = 0.1
# Growth of the cells with the distance from the rupture point [-]; chosen so. Half and twice this value change f by
# less than .01 %, its interval by up to 36 % and the work by up to 1 % (constants.csv).
RUPTURE_GROWTH = 0.28
# Nodes of a face in third-order upwind interpolation. By definition of that scheme.
UPWIND = (-1, 0, 1)
# Cells spread evenly over the contact, relative to the others [-]; chosen so. Half and twice this value change f by
# less than .01 %, its interval by up to 3.1 % and the work by less than 1 % (constants.csv).
EVEN_CELLS_WEIGHT = 1.2


@dataclass(frozen=True, kw_only=True)
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
        """Return the number of cells, and of unknown pressures."""
        return self.cells.size

    def stretched(self, s: float) -> Grid:
        """Return the same nodes ``s`` times as far from the rupture point: ln|s x| = ln s + ln|x|."""
        shift = -4.0 / math.pi * math.log(s) * self.weights
        kernels = s * (self.kernel + shift), s * (self.face_kernel + shift)
        return Grid(
            xi=s * self.xi,
            kernel=kernels[0],
            face_film=self.face_film,
            face_kernel=kernels[1],
            cells=s * self.cells,
            weights=s * self.weights,
        )


def node_positions(half_width: float, film: float, n: int, distance: float | None = None) -> np.ndarray:
    """Return n + 1 positions from the inlet (``distance`` upstream of the rupture point) to 0.

    Cells are smallest at the rupture point and just inside the edge of the Hertz contact, where the
    pressure rises over a length that shrinks with sqrt(film)/half_width, and grow in proportion to the
    distance from them. The constants minimise the film error at 192 cells against 1536 over
    M = 0.1-1000, L = 0-20.
    """
    l = math.sqrt(2.0 * film)
    rise = l * (l / (l + half_width)) ** 0.42
    width = 2.0 * half_width + 0.7 * l - 2.0 * rise
    far = distance or 3.0 * half_width + FAR_INLET * l + 0.7 * l
    inner = RISE_CELL * rise
    outer = RUPTURE_CELL * rise

    def index(x: float | FloatArray) -> float | FloatArray:
        return (
            np.arcsinh(RISE_GROWTH * (x + width) / inner) / RISE_GROWTH
            + np.arcsinh(RUPTURE_GROWTH * x / outer) / RUPTURE_GROWTH
            + EVEN_CELLS_WEIGHT * np.arcsinh(x / scale)
        )

    def density(x: FloatArray) -> FloatArray:
        return (
            1.0 / np.hypot(inner, RISE_GROWTH * (x + width))
            + 1.0 / np.hypot(outer, RUPTURE_GROWTH * x)
            + EVEN_CELLS_WEIGHT / np.hypot(scale, x)
        )

    scale = 2.0 * half_width + 0.7 * l
    away = np.geomspace(0.05 * outer, 2.0 * max(far, scale), 300)
    table = np.sort(np.concatenate([-width - away, [-width], away - width, -away, [0.0]]))
    t = np.linspace(index(-far), index(0.0), n + 1)
    x = np.interp(t, index(table), table)
    for _ in range(3):
        x -= (index(x) - t) / density(x)
    x[0] = -far
    x[-1] = 0.0
    return x


def trapezoidal(cells: np.ndarray) -> np.ndarray:
    """Return the weights of the nodes (n + 1,) between ``cells`` (n,), by the trapezoidal rule."""
    return 0.5 * (np.append(0.0, cells) + np.append(cells, 0.0))


def make_grid(xi: np.ndarray) -> Grid:
    """Return the operators on node positions ``xi``."""
    cells = np.diff(xi)
    kernel = hat_kernel(xi, xi)
    columns, values = face_weights(xi, UPWIND)
    n = cells.size
    face_film = np.zeros((n, n + 1))
    face_film[np.arange(n)[:, None], columns] = values
    face_kernel = (
        values[:, :1] * kernel[columns[:, 0]]
        + values[:, 1:2] * kernel[columns[:, 1]]
        + values[:, 2:] * kernel[columns[:, 2]]
    )
    return Grid(
        xi=xi, kernel=kernel, face_film=face_film, face_kernel=face_kernel, cells=cells, weights=trapezoidal(cells)
    )


def face_weights(x: np.ndarray, stencil: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Return the nodes (n, k) around the faces between the nodes ``x`` (n + 1,), and their Lagrange weights there.
    ``stencil``: their distances from the node before a face, moved inwards at the ends."""
    n = x.size - 1
    first = np.clip(np.arange(n) + stencil[0], 0, n + 1 - len(stencil))
    columns = first[:, None] + np.arange(len(stencil))
    face = 0.5 * (x[1:] + x[:-1])
    nodes = x[columns].T
    weights = []
    for k, own in enumerate(nodes):
        others = [node for m, node in enumerate(nodes) if m != k]
        weights.append(np.prod([face - node for node in others], axis=0) / np.prod([own - o for o in others], axis=0))
    return columns, np.stack(weights, axis=1)


def hat_kernel(points: np.ndarray, nodes: np.ndarray) -> np.ndarray:
    """Return the matrix K (points, nodes) of -(4/pi) ∫ phi_j(x') ln|x_i - x'| dx', exact.

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
