"""One step in time: variable-step BDF2 with a local error estimate, started by two backward Euler half steps.

BDF2 differentiates the parabola through the new value and the two before it. For one step this is backward Euler with
another memory: y' = rate (y - memory) (`Memory`). Its local error is d³y/dt³ τ²(τ+τ')²/(6(2τ+τ')), with the third
derivative from the divided difference of four values (τ' is the step before τ). A start, and every jump of a history,
takes one step as two halves and as a whole; the difference is the error.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from ..errors import CONVERGED

SAFETY, SHRINK, GROWTH = 0.85, 0.2, 2.0  # of the step; BDF2 is stable for growth below 2.41
FAILED = 0.25  # step after a solve that failed
LEAST_LEFT = 0.2  # of an unknown that is positive: what extrapolation leaves of it


@dataclass(frozen=True)
class Memory:
    """What an implicit step needs of the past: y' = rate (y - film), in 1/s; rate = 0: steady."""

    rate: float
    film: np.ndarray


class Solved(Protocol):
    """One solved step: ``film`` is the y that the next step remembers, ``z`` the unknowns, ``payload`` whatever else
    the next solve starts from. The run continues only from a ``status`` of "converged"."""

    @property
    def status(self) -> str: ...
    @property
    def film(self) -> np.ndarray: ...
    @property
    def z(self) -> np.ndarray: ...
    @property
    def payload(self) -> Any: ...


class Solver(Protocol):
    """The equations of one implicit step. The last of its unknowns z may have any sign; the others are 0 or positive,
    and keep that when the start of a step is extrapolated."""

    def solve(self, time: float, memory: Memory, z: np.ndarray, payload: Any, /) -> Solved:
        """The state at ``time`` [s] with this memory, from the unknowns ``z``."""
        ...

    def error_of(self, solution: Any, difference: np.ndarray, /) -> float:
        """Relative size of a difference of films, compared with the tolerance of a step."""
        ...


@dataclass(frozen=True)
class Level:
    """The state at one time [s]: the film that is differentiated (n + 1) and the unknowns z."""

    time: float
    film: np.ndarray
    z: np.ndarray


@dataclass(frozen=True)
class Progress:
    """How far a run has come. It can continue from any progress.

    ``levels``: up to three, oldest first, since the last jump; ``step``: the next [s]; ``payload``: what the solver
    returned beside its unknowns. ``steps`` taken and ``rejected``; ``worst``: largest local error so far, over the
    tolerance. Of the last step its ``solution``, its ``error``, and whether it ended at an output time.
    """

    levels: tuple[Level, ...]
    step: float
    payload: Any = None
    steps: int = 0
    rejected: int = 0
    worst: float = 0.0
    solution: Any = None
    error: float = 0.0
    at_output: bool = False

    @property
    def time(self) -> float:
        """Reached [s]."""
        return self.levels[-1].time


def started(first: Solved, step: float) -> Progress:
    """The progress at t = 0 with the state ``first`` and the first ``step`` [s]."""
    return Progress((Level(0.0, first.film, first.z),), step, first.payload)


def advance(now: Progress, until: float, solver: Solver, tolerance: float, shortest: float) -> Progress | None:
    """One step towards ``until`` [s]. It is halved if it would leave a tiny last step. If its solve fails, or its error
    is above ``tolerance``, it is repeated with a shorter step. None: even the shortest step [s] failed."""
    rejected, step = now.rejected, now.step
    while step >= shortest:
        left = until - now.time
        planned = left if step >= left * (1 - 1e-9) else min(step, 0.5 * left)
        attempt = _bdf2 if len(now.levels) > 1 else _pair
        found = attempt(now, now.time + planned if planned < left else until, solver)
        if found is None:
            step, rejected = FAILED * planned, rejected + 1
            continue
        levels, solution, error, order = found
        factor = SAFETY * (tolerance / max(error, 1e-30)) ** (1 / (order + 1))
        if error <= tolerance:
            return Progress(
                levels,
                planned * min(max(factor, SHRINK), GROWTH),
                solution.payload,
                now.steps + 1,
                rejected,
                max(now.worst, error / tolerance),
                solution,
                error / tolerance,
            )
        step, rejected = planned * min(max(factor, SHRINK), 0.9), rejected + 1
    return None


Attempt = tuple[tuple[Level, ...], Solved, float, int]  # levels after the step, its solution, error, order


def _solved(solver: Solver, time: float, memory: Memory, z: np.ndarray, payload: Any) -> Solved | None:
    solution = solver.solve(time, memory, z, payload)
    return solution if solution.status == CONVERGED else None


def _pair(now: Progress, end: float, solver: Solver) -> Attempt | None:
    start = now.levels[-1]
    step = end - start.time
    middle = start.time + 0.5 * step
    whole = _solved(solver, end, Memory(1.0 / step, start.film), start.z, now.payload)
    first = whole and _solved(solver, middle, Memory(2.0 / step, start.film), start.z, now.payload)
    second = first and _solved(solver, end, Memory(2.0 / step, first.film), first.z, first.payload)
    if whole is None or first is None or second is None:
        return None
    levels = (start, Level(middle, first.film, first.z), Level(end, second.film, second.z))
    return levels, second, solver.error_of(second, whole.film - second.film), 1


def _bdf2(now: Progress, end: float, solver: Solver) -> Attempt | None:
    old, last = now.levels[-2:]
    step, before = end - last.time, last.time - old.time
    ratio = step / before
    weight = ratio**2 / (1.0 + 2.0 * ratio)
    memory = Memory((1.0 + 2.0 * ratio) / ((1.0 + ratio) * step), last.film + weight * (last.film - old.film))
    solution = _solved(solver, end, memory, _extrapolated(old, last, ratio), now.payload)
    solution = solution or _solved(solver, end, memory, last.z, now.payload)
    if solution is None:
        return None
    levels = (*now.levels[-2:], Level(end, solution.film, solution.z))
    if len(now.levels) < 3:
        return levels, solution, 0.0, 2
    curve = _divided(
        [now.levels[-3].time, old.time, last.time, end], [now.levels[-3].film, old.film, last.film, solution.film]
    )
    error = solver.error_of(solution, curve * step**2 * (step + before) ** 2 / (2.0 * step + before))
    return levels, solution, error, 2


def _extrapolated(old: Level, last: Level, ratio: float) -> np.ndarray:
    """Unknowns on the line through two levels. Zeros stay zero, and positive ones keep at least `LEAST_LEFT` of their
    value."""
    guess = last.z + ratio * (last.z - old.z)
    guess[:-1] = np.where(last.z[:-1] > 0.0, np.maximum(guess[:-1], LEAST_LEFT * last.z[:-1]), 0.0)
    return guess


def _divided(times: list[float], values: list[np.ndarray]) -> np.ndarray:
    """Highest divided difference."""
    values = list(values)
    for k in range(1, len(times)):
        values = [(b - a) / (times[i + k] - times[i]) for i, (a, b) in enumerate(zip(values, values[1:]))]
    return values[0]
