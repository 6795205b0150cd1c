"""March in time: variable-step BDF2 with a local error estimate, started by two backward Euler half steps.

BDF2 differentiates the parabola through the new value and the two before it; seen from one step it is
backward Euler with another memory: y' = rate (y - memory) (`lubfric.ehl.transient.squeeze.Memory`). Its
local error is d³y/dt³ τ²(τ+τ')²/(6(2τ+τ')), with the third derivative from the divided difference of four
values (τ' is the step before τ). A start, and every jump of a history, takes one step as two halves and as a
whole; their difference is the error.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ...report import CONVERGED
from .squeeze import Memory

SAFETY, SHRINK, GROWTH = 0.85, 0.2, 2.0  # of the step; BDF2 is stable for growth below 2.41
FAILED = 0.25  # step after a solve that failed


@dataclass(frozen=True)
class Level:
    """The state at one time [s]: film rho H (n + 1) and unknowns z, in the units of the problem."""

    time: float
    film: np.ndarray
    z: np.ndarray


@dataclass(frozen=True)
class March:
    """Up to three levels, oldest first, since the last jump, and the next step [s]. ``payload``: what the
    solver of a step left beside its unknowns."""

    levels: tuple[Level, ...]
    step: float
    payload: object = None

    @property
    def time(self) -> float:
        """Time reached [s]."""
        return self.levels[-1].time


@dataclass(frozen=True)
class Advance:
    """One accepted step: the march after it, its solution, error estimate [of the tolerance], solves
    rejected."""

    march: March
    solution: object
    error: float
    rejected: int


def advance(
    march: March, until: float, solve: Callable, error_of: Callable, tolerance: float, shortest: float
) -> Advance | None:
    """One step towards ``until`` [s], the step halved so that none is left tiny. None: even the shortest
    failed.

    ``solve(time, memory, z, payload)`` returns an object with status, z, film, payload; the memory's rate is
    in 1/s. ``error_of(solution, difference)``: relative size of a difference of films."""
    rejected, step = 0, march.step
    while step >= shortest:
        left = until - march.time
        planned = left if step >= left * (1 - 1e-9) else min(step, 0.5 * left)
        attempt = _bdf2 if len(march.levels) > 1 else _pair
        found = attempt(march, march.time + planned if planned < left else until, solve, error_of)
        if found is None:
            step, rejected = FAILED * planned, rejected + 1
            continue
        after, solution, error, order = found
        factor = SAFETY * (tolerance / max(error, 1e-30)) ** (1 / (order + 1))
        if error <= tolerance:
            after = replace(after, step=planned * min(max(factor, SHRINK), GROWTH))
            return Advance(after, solution, error / tolerance, rejected)
        step, rejected = planned * min(max(factor, SHRINK), 0.9), rejected + 1
    return None


def restarted(march: March, step: float) -> March:
    """The same state without its past, for a jump."""
    return replace(march, levels=march.levels[-1:], step=step)


def _solved(solve, time, memory, z, payload):
    solution = solve(time, memory, z, payload)
    return solution if solution.status == CONVERGED else None


def _pair(march: March, end: float, solve, error_of):
    start = march.levels[-1]
    step = end - start.time
    whole = _solved(solve, end, Memory(1.0 / step, start.film), start.z, march.payload)
    first = whole and _solved(solve, start.time + 0.5 * step, Memory(2.0 / step, start.film), start.z, march.payload)
    second = first and _solved(solve, end, Memory(2.0 / step, first.film), first.z, first.payload)
    if second is None:
        return None
    error = error_of(second, whole.film - second.film)
    levels = (start, Level(start.time + 0.5 * step, first.film, first.z), Level(end, second.film, second.z))
    return March(levels, step, second.payload), second, error, 1


def _bdf2(march: March, end: float, solve, error_of):
    old, last = march.levels[-2:]
    step, before = end - last.time, last.time - old.time
    ratio = step / before
    weight = ratio**2 / (1.0 + 2.0 * ratio)
    memory = Memory((1.0 + 2.0 * ratio) / ((1.0 + ratio) * step), last.film + weight * (last.film - old.film))
    guess = last.z + ratio * (last.z - old.z)
    guess[:-1] = np.where(last.z[:-1] > 0.0, np.maximum(guess[:-1], 0.2 * last.z[:-1]), 0.0)
    solution = _solved(solve, end, memory, guess, march.payload) or _solved(solve, end, memory, last.z, march.payload)
    if solution is None:
        return None
    levels = (*march.levels[-2:], Level(end, solution.film, solution.z))
    if len(march.levels) < 3:
        return March(levels, step, solution.payload), solution, 0.0, 2
    curve = _divided(
        [march.levels[-3].time, old.time, last.time, end],
        [march.levels[-3].film, old.film, last.film, solution.film],
    )
    error = error_of(solution, curve * step**2 * (step + before) ** 2 / (2.0 * step + before))
    return March(levels, step, solution.payload), solution, error, 2


def _divided(times, values):
    """Highest divided difference."""
    values = list(values)
    for k in range(1, len(times)):
        values = [(b - a) / (times[i + k] - times[i]) for i, (a, b) in enumerate(zip(values, values[1:]))]
    return values[0]
