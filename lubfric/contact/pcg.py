"""The loop around `Descent`: when to recompute, restart, stop.

Keeping directions while the set changes has no convergence proof, so a residual that stalls switches
restarts on, and one that still stalls ends the solve as stagnated. The gap is recomputed in double
precision whenever the residual has fallen a thousandfold and before the loop may end as converged.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..report import CONVERGED, ITERATION_LIMIT, STAGNATED
from .descent import Descent

REFRESH = 1e-3  # fall of the residual between recomputations
MARGIN = 0.9  # of the tolerance: leaves room for the final check
PATIENCE = 40  # iterations without a better residual


@dataclass(frozen=True)
class Found:
    """Pressure [Pa] and approach [m] as an iteration left them, and what they cost."""

    pressure: np.ndarray
    approach: float
    status: str
    solver: str
    iterations: int
    convolutions: int
    history: tuple[float, ...]
    notes: tuple[str, ...] = ()


def conjugate_gradient(problem, pressure, *, load=None, level=None) -> Found:
    """Solve from ``pressure`` [Pa] (overwritten) for a total ``load`` [Pa cells] or an approach ``level`` [m]."""
    state = Descent(problem, pressure, load=load, level=level)
    fresh, moving, restarting = True, False, False
    best = refreshed = np.inf
    waiting, iteration, history, previous = 0, 0, [], None
    while True:
        work = state.working_set()
        done = work.residual <= MARGIN * problem.tolerance
        if not fresh and (done or work.residual < REFRESH * refreshed):
            state.recompute()
            fresh, refreshed = True, work.residual
            continue
        history.append(work.residual)
        refreshed = min(refreshed, max(history))
        if done or iteration == problem.max_iterations:
            status = CONVERGED if done else ITERATION_LIMIT
            break
        best, waiting = (work.residual, 0) if work.residual < 0.9 * best else (best, waiting + 1)
        if waiting > PATIENCE * (1 + 3 * restarting):
            if restarting:
                status = STAGNATED
                break
            restarting, waiting = True, 0
        iteration += 1
        changed = restarting and not np.array_equal(work.cells, previous)
        d, slope = state.search(work, restart=changed or not moving)
        moving, previous = state.advance(work, d, slope), work.cells
        fresh = not moving
    return Found(
        state.pressure,
        float(state.approach),
        status,
        "preconditioned conjugate gradient",
        iteration,
        state.convolutions,
        tuple(history),
    )
