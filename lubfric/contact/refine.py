"""Rounds of search and check: single precision on the cells that may touch, then double precision everywhere.

Only the check ends the loop: a `look` at the whole patch in double precision, whatever the search found. There is no
proof that conjugate directions converge when they are kept while the set changes. So rounds that gain nothing end the
solve as stagnated.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..errors import CONVERGED, ITERATION_LIMIT, STAGNATED
from .careful import CarefulDescent
from .cells import Cells
from .descent import FIRST_PACE, REACH, Descent
from .looked import State, look
from .projection import rescaled

MARGIN = 0.8  # of the tolerance, aimed at by the search
FALL = 8e-6  # of the residual within a round: as far as single precision goes
RIGID = 1e-2  # of the roughness: deflection of a yielded cell below which conjugate steps are exact and careful
WASTED = 4  # rounds without halving the residual


@dataclass(frozen=True)
class Found:
    """The end of the rounds (``state``): how they ended, their cost, and the pace with which a next search should
    begin."""

    state: State
    status: str
    iterations: int
    convolutions: float
    history: tuple[float, ...]
    pace: float
    solver: str = "preconditioned conjugate gradient, candidates in single precision"
    notes: tuple[str, ...] = ()

    @property
    def pressure(self) -> np.ndarray:
        """[Pa] (nx, ny)"""
        return self.state.pressure


def refine(problem, pressure, *, load=None, level=None, pace=FIRST_PACE) -> Found:
    """Solve from ``pressure`` [Pa] for a total ``load`` [Pa cells] or an approach ``level`` [m]."""
    operator, fast = problem.operator, problem.operator.single
    state, exact = look(problem, fast, pressure, level), False
    best, wasted, iterations, convolutions = math.inf, 0, 0, 1.0
    history: list[float] = []
    while True:
        status = _status(problem, state.residual, exact, iterations, wasted)
        if status:
            return Found(state, status, iterations, convolutions, (*history, state.residual), pace)
        goal = max(MARGIN * problem.tolerance, FALL * min(state.residual, 1.0))
        if state.residual > goal and iterations < problem.max_iterations:
            cells = Cells.flagged(fast, (state.pressure > 0) | (state.gap < REACH * state.overlap))
            state = state.light()
            kind = CarefulDescent if wasted > 0 or _rigid(problem) else Descent
            descent = kind(problem, cells, state, load, pace)
            pressure = state.pressure
            del state
            descent.run(goal, problem.max_iterations - iterations)
            found = descent.found(pressure)
            iterations, pace = iterations + descent.iterations, pace if wasted else descent.pace
            history += descent.history[:-1]
            convolutions += descent.convolutions
            del descent, cells
            pressure = _admissible(found, pressure, load, problem.hardness)
            del found
        else:
            pressure = state.pressure
            del state
        state, exact = look(problem, operator, pressure, level), True
        convolutions += 1
        best, wasted = (state.residual, 0) if state.residual < 0.5 * best else (best, wasted + 1)


def _admissible(found, begun, load, hardness) -> np.ndarray:
    """``found``, which may be overwritten, made to carry the load. If single precision has lost the load, the pressure
    with which the search had ``begun`` is used."""
    total = found.sum()
    if not np.isfinite(total) or load is not None and total <= 0:
        return begun
    if load is None or hardness < np.inf:
        return found if load is None else rescaled(found, load, hardness)
    found *= load / total
    return found


def _rigid(problem) -> bool:
    """Whether cells yield before they deform noticeably. Then only the set of yielded cells is to be found."""
    bent = problem.hardness * min(problem.operator.spacing) / problem.operator.e_prime
    return bent < RIGID * problem.roughness


def _status(problem, residual, exact, iterations, wasted) -> str | None:
    """How the solve has ended, or None."""
    if not exact:
        return None
    if residual <= problem.tolerance:
        return CONVERGED
    if iterations >= problem.max_iterations:
        return ITERATION_LIMIT
    return STAGNATED if wasted > WASTED else None


def approximate(problem, pressure, *, load=None, level=None, pace=FIRST_PACE) -> Found:
    """One round, in single precision throughout: a start for a finer grid."""
    fast = problem.operator.single
    state = look(problem, fast, pressure, level)
    if not state.residual:
        return Found(state, "", 0, 1.0, (), pace)
    cells = Cells.flagged(fast, (state.pressure > 0) | (state.gap < REACH * state.overlap))
    state = state.light()
    descent = (CarefulDescent if _rigid(problem) else Descent)(problem, cells, state, load, pace)
    descent.run(MARGIN * problem.tolerance, problem.max_iterations)
    found = _admissible(descent.found(pressure), pressure, load, problem.hardness)
    state = State(
        found, np.empty((0, 0)), np.empty((0, 0)), state.approach, state.scale, {"search": descent.history[-1]}
    )
    return Found(state, "", descent.iterations, 1.0 + descent.convolutions, (), descent.pace)
