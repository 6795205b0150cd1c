"""The film in a given rough gap: Reynolds' equation in the reduced pressure, linear, with rupture.

With Q = ∫ dp eta0/eta the pressure flow is -h³/(12 eta0) grad Q, whatever the viscosity law. So one sparse matrix a gap
is enough. Cells in contact are walls. Either Q > 0, or Q = 0 and outflow >= 0 (Swift-Stieber), by active sets. The
density is constant and there is no shear thinning, because the gap is given and rests on neither.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu

from ..deterministic.dissection import nested_dissection
from ..deterministic.faces import couette_flow
from ..deterministic.inlet import Inlet, inlet
from ..deterministic.problem import Problem
from ..deterministic.reynolds import first_film
from ..deterministic.start import RUPTURE
from ..errors import ConvergenceError
from ..report import STAGNATED, Report

SETS = 400  # of active cells tried
FORGIVEN = 1e-6  # cells that change between sets, of all: they flip between p = 0 and next to nothing
SETTLED = 1e-4  # change of ∫ Q from set to set, relative


@dataclass(frozen=True)
class GapFilm:
    """Q [Pa] (nx, ny) of a gap; ruptured (bool); what comes from upstream; and how many sets were tried."""

    reduced: np.ndarray
    ruptured: np.ndarray
    inlet: Inlet
    sets: int


def gap_film(problem: Problem, gap, closed, ruptured=None) -> GapFilm:
    """The film of ``gap`` [m] (nx, ny) around the cells ``closed`` (bool); ``ruptured``: the set to start from.

    ``problem``: its lubricant is isoviscous. Stops when no cell changes sides, or ∫ Q by no more than `SETTLED`. Raises
    `ConvergenceError` after `SETS`.
    """
    system, right, upstream = _system(problem, gap, closed)
    free, n = ~closed.ravel(), gap.size
    order, carried = nested_dissection(*gap.shape), math.inf
    out = _outlet(problem, gap).ravel() if ruptured is None else ruptured.ravel().copy()
    for count in range(1, SETS + 1):
        active = order[(free & ~out)[order]]
        Q = np.zeros(n)
        Q[active] = _solve(system[active][:, active].tocsc(), right[active])
        flow = system @ Q - right
        new = (Q < 0) | (out & (flow >= 0))
        changed = np.count_nonzero((new != out) & free)
        out, before, carried = new, carried, float(np.maximum(Q, 0.0).sum())
        if changed <= FORGIVEN * n or abs(carried - before) <= SETTLED * carried:
            Q = np.maximum(Q, 0.0).reshape(gap.shape)
            first = np.maximum(first_film(problem, gap), problem.floor)
            return GapFilm(Q, out.reshape(gap.shape), inlet(problem, Q[0], first), count)
    report = Report("film in a given gap", STAGNATED, SETS, float(changed) / n, FORGIVEN)
    raise ConvergenceError(report.message, report)


def _outlet(problem: Problem, gap) -> np.ndarray:
    """Where a smooth film as thick as the mean gap at x = 0 would have ruptured."""
    middle = float(gap[np.argmin(np.abs(problem.x))].mean())
    return np.repeat((problem.x > RUPTURE * math.sqrt(2 * problem.radius * middle))[:, None], gap.shape[1], axis=1)


def _solve(matrix: csc_matrix, right) -> np.ndarray:
    return splu(matrix, permc_spec="NATURAL", diag_pivot_thresh=0.0, options={"SymmetricMode": True}).solve(right)


def _system(problem: Problem, gap, closed):
    """Matrix and right side of outflow = 0 in every cell [m/s], and the inlet at Q = 0."""
    (nx, ny), (dx, dy) = gap.shape, problem.spacing
    viscous = 12 * problem.lubricant.viscosity
    open_ = ~closed
    along = np.where(open_[1:] & open_[:-1], (0.5 * (gap[1:] + gap[:-1])) ** 3, 0.0) / (viscous * dx**2)
    beside = np.roll(gap, -1, axis=1)
    across = np.where(open_ & np.roll(open_, -1, axis=1), (0.5 * (gap + beside)) ** 3, 0.0) / (viscous * dy**2)
    upstream = inlet(problem, np.zeros(ny), np.maximum(first_film(problem, gap), problem.floor))
    diagonal = across + np.roll(across, 1, axis=1)
    diagonal[:-1] += along
    diagonal[1:] += along
    diagonal[0] -= upstream.by_pressure / dx
    number = np.arange(nx * ny).reshape(nx, ny)
    rows = [number, number[:-1], number[1:], number, np.roll(number, -1, axis=1)]
    columns = [number, number[1:], number[:-1], np.roll(number, -1, axis=1), number]
    data = [diagonal, -along, -along, -across, -across]
    flat = [np.concatenate([part.ravel() for part in parts]) for parts in (data, rows, columns)]
    carried = couette_flow(problem, gap).flow / dx
    carried[:-1] = np.where(open_[1:] & open_[:-1], carried[:-1], 0.0)
    right = -carried
    right[1:] += carried[:-1]
    right[0] += upstream.flow / dx
    matrix = csc_matrix((flat[0], (flat[1], flat[2])), shape=(nx * ny,) * 2).tocsr()
    return matrix, right.ravel(), upstream
