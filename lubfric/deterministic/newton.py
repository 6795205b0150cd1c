"""Newton's method with active sets and a line search, steady or for one implicit step in time."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from .linear import System
from .problem import Problem
from .state import TOUCHING, Look, Past, State, load_error, look, residuals, settled

KEEP, BELOW = 0.2, 3.0  # of h that a step must leave, and floors it may go below that
SHORTEST = 0.1  # step, whatever the gap says
HALVINGS, GROWTH, SURGE = 10, 1.05, 2.0
PATIENCE, PROGRESS = 20, 0.95  # steps in which the residual has to fall to that part of what it was


@dataclass(frozen=True)
class Found:
    """The end of Newton's method: state, residuals, their history, and the work (LU factorisations, GMRES
    iterations)."""

    look: Look
    residuals: dict[str, float]
    history: tuple[float, ...]
    factorisations: int
    krylov: int

    @property
    def residual(self) -> float:
        """The largest."""
        return max(self.residuals.values())


def newton(problem: Problem, state: State, *, tolerance, most, past: Past | None = None) -> Found:
    """At most ``most`` steps from ``state``, until the largest of `residuals` is <= ``tolerance``.

    Before every step each cell gets the equation that its state asks for (`settled`). A step leaves every cell at least
    a fifth of its gap, and is halved while the mass residual of the fluid cells grows. The method gives up when a
    number is not finite, or when for `PATIENCE` steps neither the residual has fallen nor the residual that the whole
    step would have led to. (The latter falls first, while a heavily loaded film finds its shape in short steps.)
    """
    history: list[float] = []
    promised: list[float] = []
    krylov = 0
    at = look(problem, state, past)
    for count in range(most + 1):
        at = settled(problem, at, past)
        found = residuals(problem, at)
        worst = max(found.values())
        history.append(worst)
        best = Found(at, found, tuple(history), count, krylov)
        if not math.isfinite(worst) or worst <= tolerance or count == most:
            return best
        if _stalled(history) and _stalled(promised):
            return best
        try:
            step = System(problem, at, past).solve()
        except RuntimeError:  # the LU is singular
            return best
        krylov += step.iterations
        if not np.all(np.isfinite(step.gap)):
            return best
        at, whole = _advanced(problem, at, step, past)
        promised.append(whole)
    raise AssertionError("the last step returns")


def _stalled(history) -> bool:
    if len(history) <= PATIENCE:
        return False
    return not min(history[-PATIENCE:]) <= PROGRESS * min(history[:-PATIENCE])


def _advanced(problem: Problem, at: Look, step, past) -> tuple[Look, float]:
    """The state after the longest part of ``step`` that is accepted, and the merit of the longest part that was
    tried."""
    length = _longest(problem, at, step)
    before = _merit(problem, at, at.state.kind != TOUCHING)
    merits: list[float] = []
    for _ in range(HALVINGS):
        new = _moved(problem, at, step, length, past)
        merits.append(_merit(problem, new, at.state.kind != TOUCHING))
        if merits[-1] <= (GROWTH if length > SHORTEST else SURGE) * before:
            break
        length /= 2
    return new, merits[0]


def _longest(problem: Problem, at: Look, step) -> float:
    lost = -step.gap - BELOW * problem.floor
    falling = (lost > 0) & (at.gap > problem.floor)
    if not falling.any():
        return 1.0
    return float(max(SHORTEST, min(1.0, ((1 - KEEP) * at.gap[falling] / lost[falling]).min())))


def _moved(problem: Problem, at: Look, step, length: float, past) -> Look:
    state = at.state
    moved = replace(
        state,
        pressure=state.pressure + length * step.pressure,
        fill=state.fill + length * step.fill,
        dent=state.dent + length * step.dent,
        approach=state.approach + length * step.approach,
    )
    return look(problem, moved, past)


def _merit(problem: Problem, at: Look, apart) -> float:
    """Σ |r| over the cells that were ``apart``, and the load error, both relative."""
    value = float(np.abs(at.residual[apart]).sum())
    flow = float(np.mean(np.abs(at.balance.inlet.flow))) * apart.shape[1] / problem.spacing[0]
    merit = value / flow + abs(load_error(problem, at)) / problem.load
    return merit if math.isfinite(merit) else math.inf
