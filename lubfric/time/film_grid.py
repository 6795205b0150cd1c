"""A graded grid that does not move, and is the same on both sides of the line of centres.

Flow may reverse, and the film may rupture on either side, on both or on none. So the grid cannot follow a rupture
point. Cells are smallest at the edges of the Hertz contact on both sides, over the complete range of edges that
changing loads give. They grow in proportion to the distance from there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .._base import FloatArray
from ..film import UPWIND, face_weights, hat_kernel, trapezoidal

# Choices between work and error: the error of the steady start is measured in every run (`film_setting.NODE_FACTORS`).
# Half and twice this value change f by up to .1 % and the work by up to 13 % (constants.csv).
EDGE_CELL = 0.16  # smallest cell over the length of the pressure rise
EDGE_GROWTH = 0.3  # growth of the cells with the distance from the edge [-]
EVEN_CELLS_WEIGHT_IN_TIME = 12.0  # cells spread evenly over the contact, which fronts of the film travel through
FAR_REACH = 40.0  # reach of the grid beyond three half-widths, in sqrt(2 R h)


@dataclass(frozen=True, kw_only=True)
class FixedGrid:
    """The grid with its operators.

    Attributes
    ----------
    x : (n + 1,) nodes
    cells : (n,) lengths of the cells
    weights : (n + 1,) of the integral of pressure; also the lengths of the control volumes
    kernel : from pressure to film at the nodes
    forward, backward, centred : interpolations to the faces, see `Faces`
    """

    x: np.ndarray
    cells: np.ndarray
    weights: np.ndarray
    kernel: np.ndarray
    forward: Faces
    backward: Faces
    centred: Faces

    @property
    def n(self) -> int:
        """Number of cells."""
        return self.cells.size

    def upwind(self, speed: float) -> Faces:
        """Return the interpolation that takes its nodes against the flow."""
        return self.forward if speed >= 0.0 else self.backward


@dataclass(frozen=True)
class Faces:
    """Lagrange interpolation from nodes to the faces between them.

    Face i uses the nodes ``columns[i]`` with the weights ``values[i]``. ``kernel`` (n, n + 1): from pressure to film at
    the faces.
    """

    columns: np.ndarray
    values: np.ndarray
    kernel: np.ndarray

    def __call__(self, nodal: np.ndarray) -> np.ndarray:
        return np.einsum("fk,fk->f", self.values, nodal[self.columns])


def make_fixed_grid(x: np.ndarray) -> FixedGrid:
    """Return the grid and its operators on increasing nodes ``x``."""
    cells = np.diff(x)
    kernel = hat_kernel(x, x)

    def faces(stencil: tuple[int, ...]) -> Faces:
        columns, values = face_weights(x, stencil)
        return Faces(columns, values, np.einsum("fk,fkj->fj", values, kernel[columns]))

    return FixedGrid(
        x=x,
        cells=cells,
        weights=trapezoidal(cells),
        kernel=kernel,
        forward=faces(UPWIND),
        backward=faces((0, 1, 2)),
        centred=faces((-1, 0, 1, 2)),
    )


def symmetric_nodes(
    resolution: float, edges: tuple[float, float], films: tuple[float, float], reach: float = 0.0
) -> np.ndarray:
    """Return nodes symmetric about 0; their number is ``resolution`` times what the ranges demand.

    ``edges`` are the smallest and the largest Hertz half-width, ``films`` the smallest and the largest film, all in the
    units x and h = x²/R. The cells resolve the rise of the smallest film's pressure at every edge. The domain reaches
    beyond three half-widths by ``FAR_REACH`` sqrt(2 h) of the largest film, and at least to ``reach``.
    """
    inner, outer = edges
    small, large = (math.sqrt(2.0 * h) for h in films)
    rise = small * (small / (small + outer)) ** 0.42
    far = max(3.0 * outer + FAR_REACH * large, reach)
    fine = EDGE_CELL * rise
    low = max(0.0, inner - 0.5 * rise)
    high = outer + 0.5 * rise
    scale = high + small

    def density(x: FloatArray) -> FloatArray:
        away = np.maximum(low - x, 0.0) + np.maximum(x - high, 0.0)
        return 1.0 / np.hypot(fine, EDGE_GROWTH * away) + EVEN_CELLS_WEIGHT_IN_TIME / np.hypot(scale, x)

    away = np.concatenate([[0.0], np.geomspace(1e-3 * fine, far + high, 3000)])
    table = np.unique(np.clip(np.concatenate([low - away, high + away, np.linspace(low, high, 400)]), 0.0, far))
    index = np.concatenate([[0.0], np.cumsum(0.5 * (density(table[1:]) + density(table[:-1])) * np.diff(table))])
    half = np.interp(np.linspace(0.0, index[-1], math.ceil(resolution * index[-1]) + 1), index, table)
    half[-1] = far
    return np.concatenate([-half[:0:-1], half])
