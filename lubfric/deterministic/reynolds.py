"""Mass balance of every cell, and its sparse derivatives by p and h."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix

from .faces import CouetteFlow, PressureFlow, couette_flow, pressure_flow
from .inlet import Inlet, inlet
from .problem import Problem
from .rheology import CellFluid, cell_fluid


@dataclass(frozen=True)
class Balance:
    """Outflow minus inflow of each cell, ``residual`` [m/s] (nx, ny), and its parts.

    film: the gap for the flow, at least the floor [m].
    """

    residual: np.ndarray
    film: np.ndarray
    fluid: CellFluid
    along: PressureFlow
    across: PressureFlow
    couette: CouetteFlow
    inlet: Inlet


def balance(problem: Problem, pressure, gap, fill=1.0) -> Balance:
    """Steady mass balance of the cells at pressure [Pa], gap [m] and filled part [-] (nx, ny)."""
    dx, dy = problem.spacing
    film = np.maximum(gap, problem.floor)
    fluid = cell_fluid(problem.lubricant, np.maximum(pressure, 0.0))
    along = pressure_flow(problem, fluid, pressure, film, 0)
    across = pressure_flow(problem, fluid, pressure, film, 1)
    couette = couette_flow(problem, fluid.density * film, fill)
    upstream = inlet(problem, pressure[0], first_film(problem, film))
    residual = couette.flow.copy()
    residual[1:] -= couette.flow[:-1]
    residual[0] -= upstream.flow
    residual[:-1] += along.flow
    residual[1:] -= along.flow
    residual /= dx
    residual += (across.flow - np.roll(across.flow, 1, axis=1)) / dy
    return Balance(residual, film, fluid, along, across, couette, upstream)


def first_film(problem: Problem, film) -> np.ndarray:
    """Film [m] (ny,) at the first face: that of the first cell, continued up the parabola by half a cell."""
    x, dx = problem.x[0], problem.spacing[0]
    return film[0] - x * dx / (2 * problem.radius) + dx**2 / (8 * problem.radius)


def derivatives(problem: Problem, at: Balance, pressure, open_=None) -> tuple[csr_matrix, csr_matrix, csr_matrix]:
    """d residual/dp [m/(s Pa)], /dh [1/s] and /dfill [m/s], sparse (n, n) over all n = nx ny cells in C order; by h of
    ``open_`` cells (bool) (nx, ny) only (None: of all)."""
    dx, dy = problem.spacing
    shape = at.film.shape
    stencil_p, stencil_h, stencil_fill = _Stencil(shape), _Stencil(shape), _Stencil(shape)
    for stencil, along, across in (
        (stencil_p, at.along.by_p, at.across.by_p),
        (stencil_h, at.along.by_h, at.across.by_h),
    ):
        stencil.add(0, along[0] / dx, here=slice(None, -1))
        stencil.add("E", along[1] / dx, here=slice(None, -1))
        stencil.add("W", -along[0] / dx, here=slice(1, None))
        stencil.add(0, -along[1] / dx, here=slice(1, None))
        stencil.add(0, across[0] / dy)
        stencil.add("N", across[1] / dy)
        stencil.add("S", -np.roll(across[0], 1, axis=1) / dy)
        stencil.add(0, -np.roll(across[1], 1, axis=1) / dy)
    own, before = at.couette.by_own / dx, at.couette.by_before / dx
    for stencil, factor in ((stencil_h, at.fluid.density), (stencil_p, at.fluid.density_slope * at.film)):
        stencil.add(0, own * factor)
        stencil.add("W", before[1:] * factor[:-1], here=slice(1, None))
        stencil.add("W", -own[:-1] * factor[:-1], here=slice(1, None))
        stencil.add("WW", -before[1:-1] * factor[:-2], here=slice(2, None))
    stencil_fill.add(0, at.couette.by_fill / dx)
    stencil_fill.add("W", -at.couette.by_fill[:-1] / dx, here=slice(1, None))
    stencil_p.add(0, -at.inlet.by_pressure / dx, here=slice(0, 1))
    stencil_h.add(0, -at.inlet.by_film / dx, here=slice(0, 1))
    return stencil_p.matrix(), stencil_h.matrix(open_), stencil_fill.matrix()


class _Stencil:
    """Coefficients of a cell's own value, of its neighbours up and down stream (W, WW; E) and across (S, N)."""

    NAMES = ("WW", "W", "S", 0, "N", "E")

    def __init__(self, shape):
        self.shape = shape
        self.data = {name: np.zeros(shape) for name in self.NAMES}

    def add(self, name, values, here=slice(None)):
        self.data[name][here] += values

    def matrix(self, columns=None) -> csr_matrix:
        """The sparse matrix, without the entries in closed ``columns`` (nx, ny)."""
        (nx, ny), n = self.shape, self.shape[0] * self.shape[1]
        own = np.arange(n).reshape(nx, ny)
        where = {
            "WW": own - 2 * ny,
            "W": own - ny,
            "E": own + ny,
            0: own,
            "N": np.roll(own, -1, axis=1),
            "S": np.roll(own, 1, axis=1),
        }
        rows, cols, data = [], [], []
        for name in self.NAMES:
            inside = (where[name] >= 0) & (where[name] < n) & (self.data[name] != 0)
            rows.append(own[inside])
            cols.append(where[name][inside])
            data.append(self.data[name][inside])
        column, entries = np.concatenate(cols), np.concatenate(data)
        if columns is not None:
            entries = entries * columns.ravel()[column]
        return csr_matrix((entries, (np.concatenate(rows), column)), shape=(n, n))
