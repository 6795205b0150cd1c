"""Implicit Euler steps in time towards the steady state, for starts from which Newton's method does not converge."""

from __future__ import annotations

from dataclasses import dataclass

from .newton import newton
from .problem import Problem
from .state import Past, State, look, mass, residuals, settled

FIRST = 3.0  # times dx/U: the first step in time
SHRINK, GROW, EASY = 0.5, (2.0, 1.5), 5  # the first growth after so many Newton steps and fewer
LEAST, LAST = 1e-3, 1e5  # times dx/U: shorter, the march has failed; longer, it has arrived
INNER = 8  # Newton steps in a step in time
LOOSE, PART = 0.1, 0.3  # how well they solve it: at most, and of the imbalance that is left to settle
SETTLED = 1e-5  # of that imbalance: the march has arrived


@dataclass(frozen=True)
class March:
    """The final state and the work: LU factorisations, GMRES iterations, steps in time."""

    state: State
    factorisations: int
    krylov: int
    steps: int


def march(problem: Problem, state: State, *, most: int) -> March:
    """Let the film settle from ``state`` in time steps that grow while they are solved; at most ``most``
    factorisations.

    Each step is solved to a part of the steady imbalance of mass that it begins with: the way there need not be exact.
    Behind closed furrows it is long, because valleys fill by what leaks in.
    """
    unit = problem.spacing[0] / problem.speed
    step, factorisations, krylov, steps = FIRST * unit, 0, 0, 0
    at = look(problem, state)
    while factorisations < most and LEAST * unit <= step <= LAST * unit:
        left = residuals(problem, settled(problem, look(problem, at.state)))["mass"]
        if left <= SETTLED:
            break
        goal = max(SETTLED, min(LOOSE, PART * left))
        past = Past(mass(at.state, at.balance), step)
        found = newton(problem, at.state, tolerance=goal, most=min(INNER, most - factorisations), past=past)
        factorisations, krylov, steps = factorisations + found.factorisations, krylov + found.krylov, steps + 1
        if found.residual <= goal:
            at = look(problem, found.look.state)
            step *= GROW[found.factorisations > EASY]
        else:
            step *= SHRINK
    return March(at.state, factorisations, krylov, steps)
