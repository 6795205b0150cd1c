"""Newton's method for one implicit step; every Newton step decides anew which nodes are cavitated."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..errors import CONVERGED, DIVERGED, ITERATION_LIMIT
from ..film import Problem, step_length
from .bdf import Memory
from .film_grid import FixedGrid
from .film_squeeze import Conditions, Spring, StepTerms, evaluate, jacobian

SMALLEST_STAGE = 0.01  # of the logarithm of a change of the load


@dataclass(frozen=True)
class StepSolution:
    """The unknowns z with their `StepTerms`, the cavitated nodes (n + 1,), held at P = 0, and the residuals of
    `measure`."""

    z: np.ndarray
    terms: StepTerms
    cavitated: np.ndarray
    status: str
    residuals: dict[str, float]
    history: tuple[float, ...]
    payload: Any = None

    @property
    def film(self) -> np.ndarray:
        """rho H, which the next step remembers."""
        return self.terms.rho[0] * self.terms.H


def solve_step(
    grid: FixedGrid,
    problem: Problem,
    now: Conditions,
    memory: Memory,
    z: np.ndarray,
    *,
    spring: Spring | None = None,
    tolerance: float = 1e-7,
    max_steps: int = 25,
) -> StepSolution:
    """Solve the complementarity equations of `squeeze` from z until max(residuals) <= tolerance.

    A node counts as cavitated when the pressure that its own equation asks for, P - r/(dr/dP), is negative. This
    primal-dual active set is a semismooth Newton method. If it fails, the load is changed in stages from the load of z
    to the one asked for. (With a spring that is not needed.)
    """
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        solution = _iterate(grid, problem, now, memory, spring, z, tolerance, max_steps)
        if solution.status != CONVERGED and spring is None and grid.weights @ z[:-1] > 0.0:
            solution = _in_stages(grid, problem, now, memory, z, tolerance, max_steps)
    return solution


def _in_stages(grid, problem, now, memory, z, tolerance, max_steps) -> StepSolution:
    first = float(grid.weights @ z[:-1])
    done, stage = 0.0, 0.25
    history: tuple[float, ...] = ()
    while True:
        goal = min(1.0, done + stage)
        load = first * (now.load / first) ** goal
        solution = _iterate(grid, problem, replace(now, load=load), memory, None, z, tolerance, max_steps)
        history += solution.history
        if solution.status == CONVERGED:
            done, stage, z = goal, 1.5 * stage, solution.z
        else:
            stage *= 0.4
        if done == 1.0 or stage < SMALLEST_STAGE:
            return replace(solution, history=history)


def _iterate(grid, problem, now, memory, spring, z, tolerance, max_steps) -> StepSolution:
    history, status = [], ITERATION_LIMIT
    cavitated = z[:-1] <= 0.0
    for step in range(max_steps + 1):
        t = evaluate(grid, problem, now, memory, spring, z)
        residuals = measure(grid, now, memory, t)
        history.append(max(residuals.values()))
        if history[-1] <= tolerance:
            return StepSolution(z, t, t.P <= 0.0, CONVERGED, residuals, tuple(history))
        if not np.isfinite(history[-1]):
            status = DIVERGED
            break
        if step == max_steps:
            break
        J = jacobian(grid, now, memory, spring, t)
        cavitated = t.P - t.r / np.diagonal(J)[:-1] < 0.0
        delta = _solve(J, t, cavitated)
        if delta is None:
            status = DIVERGED
            break
        loss = float(np.max(-(grid.kernel @ delta[:-1] + delta[-1]) / t.H))
        z = z + step_length(delta[:-1] * t.log_slope, loss) * delta
        z[:-1][cavitated & (z[:-1] < 1e-14 * t.P.max())] = 0.0
    return StepSolution(z, t, cavitated, status, residuals, tuple(history))


def measure(grid: FixedGrid, now: Conditions, memory: Memory, t: StepTerms) -> dict[str, float]:
    """Relative residuals: of the mass in the pressurised control volumes (relative to what they contain, per step or
    per passage of their film), of tension in the cavitated ones and of lubricant created there, of the load, and of the
    pressure at the ends."""
    scale = t.H * (memory.rate * grid.weights + abs(now.speed)) + 1e-300
    top = max(float(t.P.max()), 1e-300)
    mass = t.r[1:-1] / scale[1:-1]
    wet = t.P[1:-1] > 0.0
    ends = np.minimum(t.P, t.r)[[0, -1]] / top
    load = max(abs(now.load), 1e-300)
    return {
        "mass": float(np.max(np.abs(mass[wet]), initial=0.0)),
        "cavitation": max(float(np.max(-mass[~wet], initial=0.0)), -float(t.P.min()) / top),
        "ends": float(np.max(np.abs(ends))),
        "load": abs(t.balance) / load,
    }


def _solve(J: np.ndarray, t: StepTerms, cavitated: np.ndarray) -> np.ndarray | None:
    from scipy.linalg.lapack import dgesv

    delta = np.zeros(t.P.size + 1)
    delta[:-1][cavitated] = -t.P[cavitated]
    free = np.append(np.flatnonzero(~cavitated), t.P.size)
    right = -np.append(t.r, t.balance)[free]
    moved = cavitated & (t.P != 0.0)
    if moved.any():
        right -= J[np.ix_(free, np.flatnonzero(moved))] @ delta[:-1][moved]
    _, _, solution, info = dgesv(np.asfortranarray(J[np.ix_(free, free)]), right, overwrite_a=1, overwrite_b=1)
    if info != 0:
        return None
    delta[free] = solution
    return delta
