"""One strip of a rough surface on one grid: what a sample of strips is made of."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..scene import Scene, check_resolved_gap
from ..surface import Surface
from .point import problem_of, refined_start
from .problem import Problem
from .result import DeterministicResult
from .solve import solve_point

TOLERANCE = 1e-3  # of the residuals: f moves by some .1 %
HEAVIER = 1.03  # times the load: the second solve, for the slope
# counted work [s of a usual core] a cell: a Newton step, its factorisation over log2 of the cells, a step of GMRES
STEP, FACTORISATION, KRYLOV = 2.4e-6, 2.0e-7, 2.5e-7


@dataclass(frozen=True)
class Strip:
    """A strip that is solved: its ``problem`` and ``result``, and the counted ``work`` of both solves (`work_of`).

    slope: dF/dw [-] of friction and load at one h0, from a second solve at a load 3 % larger; NaN without that.
    """

    problem: Problem
    result: DeterministicResult
    slope: float
    work: float

    @property
    def deviations(self) -> np.ndarray:
        """F_i - slope (w_i - w) - F [N/m] of every column i along y (ny,), with a mean of 0: what places deviate by if
        the load is balanced."""
        friction, load = self.result.friction_at, self.result.load_at
        return friction - friction.mean() - self.slope * (load - load.mean())


def solve_strip(
    scene: Scene,
    surface: Surface,
    speed: float,
    *,
    factors: tuple[int, int] = (1, 1),
    start: Strip | None = None,
    slope: bool = False,
    tolerance: float = TOLERANCE,
) -> Strip:
    """Solve ``surface``, a strip that is periodic along y, under the bodies of ``scene`` at ``speed`` [m/s], not 0.

    The cells are those of the map, or ``factors`` (fx, fy) times as long: they take every fx-th and fy-th height where
    it stands, so that strips of different factors are the same strip. ``start``: the same strip at another speed, on
    these cells or on longer ones. Without it, strip and speed alone decide the result. ``slope``: solve it a second
    time, for `Strip.slope`. ``tolerance``: of the residuals (`lubfric.deterministic.state.residuals`).

    Raises `InputError` and `ConvergenceError`.
    """
    check_resolved_gap(scene)
    problem = problem_of(scene, surface, speed, factors)
    near = None if start is None else refined_start(start.problem, problem, start.result)
    result = solve_point(problem, start=near, tolerance=tolerance)
    work, rise = work_of(result), math.nan
    if slope:
        heavier = problem.at_load(HEAVIER * problem.load)
        second = solve_point(heavier, start=result.state, tolerance=tolerance)
        work += work_of(second)
        rise = (second.coefficient * second.load - result.coefficient * result.load) / (second.load - result.load)
    return Strip(problem, result, rise, work)


def work_of(result: DeterministicResult) -> float:
    """Counted work of a solve in seconds of a usual core: from its cells and steps alone, never from a clock."""
    return work_of_steps(result.pressure.size, result.report.iterations, result.report.evaluations)


def work_of_steps(cells: float, steps: float, krylov: float = 0) -> float:
    """The same of so many ``steps`` of Newton's method, with ``krylov`` iterations of GMRES in all."""
    return cells * (steps * (STEP + FACTORISATION * math.log2(cells)) + krylov * KRYLOV)
