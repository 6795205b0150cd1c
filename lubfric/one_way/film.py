"""The film in a given rough gap: Reynolds' equation, linear in the reduced pressure, with rupture.

With Q = ∫ dp eta0/eta the pressure flow is -h³/(12 eta0) grad Q, whatever the viscosity law. Either a cell is full and
Q >= 0, or Q = 0 and the part θ of it is filled, 0 <= θ <= 1, so that mass is conserved (Jakobsson-Floberg-Olsson).
Every cell has one unknown, Q or θ, found by active sets. The density is constant, and there is no shear thinning.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.sparse import csc_matrix, diags, identity, kron
from scipy.sparse.linalg import SuperLU, splu

from ..deterministic import RUPTURE, Inlet, Problem, couette_flow, first_film, gmres, inlet
from ..errors import STAGNATED, ConvergenceError, Report
from ..oil import Lubricant

SETS = 400  # of active cells tried
SETTLED = 3e-4  # change of ∫ Q from set to set, relative
RIGHT = 3e-4  # of what `LOST` bounds: with that f was met to be .6 % off at most, which serves on the way to a balance
LOST = 1e-2  # flow beyond what fills the gap, of that which enters; and ∫ Q where it pulls, of the whole
NO_PIVOTS = {
    "diag_pivot_thresh": 0.0,
    "panel_size": 1,
    "options": {"SymmetricMode": True},
}  # narrow panels: half faster
ACCURATE, FEW = 1e-6, 14  # residual of iterations by kept factors over the right side, and how many of them
LONGER = 8  # cells, at most, by which a film that begins too late is made longer at once


@dataclass(frozen=True)
class Kept:
    """What the film of one gap leaves for the film of the next: where it has ruptured (bool) (nx, ny), and the factors
    and unknowns of its last linear system, if that was on the same cells (None: not kept)."""

    ruptured: np.ndarray
    factors: SuperLU | None = None
    unknown: np.ndarray | None = None


@dataclass(frozen=True)
class GapFilm:
    """The film of a gap: Q [Pa] and filled part [-] (nx, ny); what flows in from upstream; what the next film can start
    from; and the number of active sets that were tried."""

    reduced: np.ndarray
    fill: np.ndarray
    inlet: Inlet
    kept: Kept
    sets: int

    @property
    def ruptured(self) -> np.ndarray:
        """Where the film has ruptured (bool) (nx, ny)."""
        return self.kept.ruptured


def gap_film(problem: Problem, gap, near: Kept | None = None, right: float = 0.0) -> GapFilm:
    """The film of ``gap`` > 0 [m] (nx, ny) at the viscosity of ambient pressure, as Q requires. ``near``: from a
    neighbouring gap, to start from.

    Stops when no cell changes between full and ruptured. It also stops when two flows are at most `LOST` (what does not
    fit into ruptured cells, and what full cells would suck in) and ∫ Q has changed by at most `SETTLED`; that last test
    is left out where both flows are at most ``right``. Raises `ConvergenceError` after `SETS` sets.
    """
    problem = problem.with_lubricant(Lubricant(problem.lubricant.viscosity, viscosity_law="constant"))
    system = _system(problem, gap)
    carried, entering = math.inf, float(system.entering.sum())
    kept = Kept(_outlet(problem, gap)) if near is None else near
    for count in range(1, SETS + 1):
        unknown, kept = system.solve(kept)
        out = kept.ruptured
        new = np.where(out, unknown <= 1, unknown < 0)
        Q, fill = np.where(out, 0.0, np.maximum(unknown, 0.0)), np.where(out, np.clip(unknown, 0.0, 1.0), 1.0)
        before, carried = carried, float(Q.sum())
        lost = float((np.where(out, np.abs(unknown - fill), 0.0) * system.carried).sum()) / entering
        wrong = max(lost, float((Q - np.where(out, 0.0, unknown)).sum()) / carried)
        settled = wrong <= right or wrong <= LOST and abs(carried - before) <= SETTLED * carried
        if settled or np.array_equal(new, out):
            first = np.maximum(first_film(problem, gap), problem.floor)
            return GapFilm(Q, fill, inlet(problem, Q[0], first), kept, count)
        kept = Kept(_longer(new, np.where(out, unknown, 0.0)))
    report = Report("film in a given gap", STAGNATED, SETS, wrong, LOST)
    raise ConvergenceError(report.message, report)


def _longer(ruptured, fill) -> np.ndarray:
    """``ruptured`` without the cells upstream of those that would be overfilled: one cell upstream where ``fill`` is
    above 2, two above 4, and so on."""
    found = ruptured.copy()
    for cells in range(1, LONGER + 1):
        found[:-cells] &= fill[cells:] <= 2.0**cells
    return found


def _outlet(problem: Problem, gap) -> np.ndarray:
    """The cells behind the place where a smooth film as thick as the mean gap at x = 0 would rupture."""
    middle = float(gap[np.argmin(np.abs(problem.x))].mean())
    return np.repeat((problem.x > RUPTURE * math.sqrt(2 * problem.radius * middle))[:, None], gap.shape[1], axis=1)


@dataclass(frozen=True)
class _System:
    """The equations outflow = 0 of all cells [m/s]. Columns of the matrix for Q and for θ: of the cell itself, of the
    cells behind and before it along x, and of those beside it (5, nx, ny); carried: by the Couette flow of a full cell;
    entering: from upstream."""

    by_reduced: np.ndarray
    by_fill: np.ndarray
    carried: np.ndarray
    entering: np.ndarray

    def solve(self, start: Kept) -> tuple[np.ndarray, Kept]:
        """θ where the film has ruptured, Q elsewhere, and what to keep. The factors of ``start`` are used if they lead
        there in `FEW` iterations."""
        out = start.ruptured
        order, matrix, rows = self._linear(out)
        size, factors = float(np.linalg.norm(rows)), start.factors
        if factors is not None and start.unknown is not None:
            guess = start.unknown.ravel()[order]
            rest = rows - matrix @ guess
            accuracy = ACCURATE * size / max(float(np.linalg.norm(rest)), 1e-300)
            if accuracy >= 1:
                return start.unknown, start
            change, _, left = gmres(matrix.__matmul__, factors.solve, rest, accuracy, FEW, 1)
            if left <= accuracy:
                return _put(guess + change, order, factors, out)
        # columns add up to nothing or more and only their diagonal is positive: no pivoting is needed
        factors = splu(matrix, permc_spec="NATURAL", **NO_PIVOTS)
        return _put(factors.solve(rows), order, factors, out)

    def _linear(self, out) -> tuple[np.ndarray, csc_matrix, np.ndarray]:
        """Order of elimination, and in that order the matrix and the right side with the film ruptured where
        ``out``."""
        (nx, ny), order = out.shape, _order(*out.shape)
        index, starts, source = _structure(nx, ny)
        columns = np.where(out, self.by_fill, self.by_reduced)
        narrow = ny < 3  # the cells beside a cell are one, or the cell itself
        matrix = csc_matrix((columns.ravel()[source], index, starts), shape=(out.size,) * 2, copy=narrow)
        if narrow:
            matrix.sum_duplicates()
        full = np.where(out, 0.0, self.carried)
        rows = self.entering - full
        rows[1:] += full[:-1]
        return order, matrix, rows.ravel()[order]


def _put(values, order, factors: SuperLU, out) -> tuple[np.ndarray, Kept]:
    """The unknowns ``values``, given in the ``order`` of elimination, on their cells, and what to keep."""
    unknown = np.empty(out.size)
    unknown[order] = values
    unknown = unknown.reshape(out.shape)
    return unknown, Kept(out, factors, unknown)


@lru_cache(maxsize=8)
def _order(nx: int, ny: int) -> np.ndarray:
    """Numbers of the cells in the order of elimination: minimum degree for cells that depend on their four neighbours,
    found once for a grid. It fills in a third less than nested dissection with cuts two cells wide, as the
    deterministic film needs them."""
    along = diags([1.0, 1.0], [-1, 1], shape=(nx, nx))
    across = (
        diags([1.0, 1.0, 1.0, 1.0], [-1, 1, ny - 1, 1 - ny], shape=(ny, ny)) if ny > 2 else diags([1.0], shape=(ny, ny))
    )
    grid = kron(along, identity(ny)) + kron(identity(nx), across)
    laplacian = (5.0 * identity(nx * ny) - grid).tocsc()
    return np.argsort(splu(laplacian, permc_spec="MMD_AT_PLUS_A", **NO_PIVOTS).perm_c)


@lru_cache(maxsize=8)
def _structure(nx: int, ny: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Row indices and starts of the columns (CSC) in the order of elimination, and where their values stand in the
    columns of `_System`."""
    number = np.arange(nx * ny).reshape(nx, ny)
    place = np.empty(nx * ny, dtype=np.intp)
    place[_order(nx, ny)] = number.ravel()
    outside = np.full((1, ny), -1)
    behind, before = np.vstack([number[1:], outside]), np.vstack([outside, number[:-1]])
    rows = np.stack([number, behind, before, np.roll(number, -1, axis=1), np.roll(number, 1, axis=1)]).ravel()
    source = np.flatnonzero(rows >= 0)
    row, column = place[rows[source]], place[np.tile(number.ravel(), 5)[source]]
    sort = np.lexsort((row, column))
    starts = np.searchsorted(column[sort], np.arange(nx * ny + 1))
    return row[sort].astype(np.int32), starts.astype(np.int32), source[sort]


def _system(problem: Problem, gap) -> _System:
    dx, dy = problem.spacing
    viscous = 12 * problem.lubricant.viscosity
    along = np.zeros((gap.shape[0] + 1, gap.shape[1]))  # through the faces before and behind every cell
    along[1:-1] = (0.5 * (gap[1:] + gap[:-1])) ** 3 / (viscous * dx**2)
    across = (0.5 * (gap + np.roll(gap, -1, axis=1))) ** 3 / (viscous * dy**2)
    beside = np.roll(across, 1, axis=1)
    upstream = inlet(problem, np.zeros(gap.shape[1]), np.maximum(first_film(problem, gap), problem.floor))
    diagonal = across + beside + along[1:] + along[:-1]
    diagonal[0] -= upstream.by_pressure / dx
    carried = couette_flow(problem, gap).flow / dx
    entering = np.zeros_like(gap)
    entering[0] = upstream.flow / dx
    nothing = np.zeros_like(gap)
    return _System(
        np.stack([diagonal, -along[1:], -along[:-1], -across, -beside]),
        np.stack([carried, -carried, nothing, nothing, nothing]),
        carried,
        entering,
    )
