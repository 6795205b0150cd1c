"""A deterministic point on finer and finer grids, each started from the last, with an estimate of the error that is
left."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from .problem import Problem
from .result import DeterministicResult
from .solve import Start, solve_point
from .transfer import SHARP, refined_start, state_on

RATIO = (0.25, 0.75)  # between which the change from grid to grid is taken to fall
UNKNOWN_RATIO = 0.5  # from two grids: between first and second order


@dataclass(frozen=True)
class Refined:
    """The solution on every grid, the coarsest first; ``error``: estimated relative error of the coefficient on the
    last grid (None with one grid)."""

    results: tuple[DeterministicResult, ...]
    error: float | None

    @property
    def result(self) -> DeterministicResult:
        """The result on the finest grid."""
        return self.results[-1]


def solve_refined(
    lay: Callable[[tuple[int, int]], Problem],
    grids: tuple[tuple[int, int], ...],
    *,
    tolerance: float,
    least: int = 2,
    start: Refined | None = None,
    precision: float = 1e-5,
) -> Refined:
    """Solve ``lay(shape)``, the map on each of ``grids``, coarsest first, until the estimate is <= ``tolerance``; on at
    least ``least`` of them.

    The estimate is the geometric series of the changes c0, c1 of f on the last grids, c1 q/(1 - q) with q = c1/c0 kept
    within 1/4 and 3/4 (1/2 from two grids), over f. ``start``: the result of a neighbouring speed. A grid starts from
    it or from the next coarser grid, and if both fail from the dry contact. ``precision``: of `solve_point`. Raises
    `ConvergenceError`.
    """
    results: list = []
    error, coarser = None, None
    for level, shape in enumerate(grids):
        problem = lay(shape)
        neighbour = start.results[level] if start is not None and level < len(start.results) else None
        coarse = (coarser, results[-1]) if results else None
        result = solve_point(problem, starts=_starts(problem, neighbour, coarse), tolerance=precision)
        results.append(result)
        coarser = problem
        error = estimate([r.coefficient for r in results])
        if len(results) >= least and error is not None and error <= tolerance:
            break
    return Refined(tuple(results), error)


def _starts(problem: Problem, neighbour, coarse) -> list[Start]:
    """The neighbouring speed and the coarser grid as starts, as far as they exist; the coarser grid first if the film
    carries."""
    starts: list[Start] = []
    if neighbour is not None:
        starts.append(Start(partial(state_on, problem, neighbour), neighbour.speed))
    if coarse is not None:
        starts.append(Start(partial(refined_start, coarse[0], problem, coarse[1]), problem.speed))
        if coarse[1].split.spots < SHARP * coarse[1].load:
            starts.reverse()
    return starts


def estimate(values) -> float | None:
    """Relative error of the last of ``values``, found on grids each twice as fine as the one before; None for one
    value."""
    if len(values) < 2:
        return None
    change = abs(values[-1] - values[-2])
    before = abs(values[-2] - values[-3]) if len(values) > 2 else 0.0
    ratio = UNKNOWN_RATIO if before == 0 else min(max(change / before, RATIO[0]), RATIO[1])
    return change * ratio / (1 - ratio) / abs(values[-1]) if change else 0.0
