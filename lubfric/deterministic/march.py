"""Implicit Euler steps in time towards the steady state, for starts from which Newton's method does not converge."""

from __future__ import annotations

from dataclasses import dataclass

from .newton import Found, newton
from .problem import Problem
from .state import Past, State, look, mass

FIRST = 3.0  # times dx/U: the first step in time
SHRINK, GROW = 0.4, 1.7
LEAST, LAST = 1e-3, 1e4  # times dx/U: shorter, the march has failed; longer, it has arrived
INNER, LOOSE = 6, 1e-2  # Newton steps in a step in time, and how well they solve it


@dataclass(frozen=True)
class March:
    """The final state and the work: LU factorisations, GMRES iterations, steps in time."""

    state: State
    factorisations: int
    krylov: int
    steps: int


def march(problem: Problem, state: State, *, most: int) -> March:
    """Let the film settle from ``state`` in time steps that grow as long as they converge; at most ``most``
    factorisations."""
    unit = problem.spacing[0] / problem.speed
    step, factorisations, krylov, steps = FIRST * unit, 0, 0, 0
    at = look(problem, state)
    while factorisations < most:
        past = Past(mass(at.state, at.balance), step)
        found = newton(problem, at.state, tolerance=LOOSE, most=INNER, past=past)
        factorisations, krylov, steps = factorisations + found.factorisations, krylov + found.krylov, steps + 1
        if _solved(found):
            at = look(problem, found.look.state)
            step *= GROW
        else:
            step *= SHRINK
        if not LEAST * unit <= step <= LAST * unit:
            return March(at.state, factorisations, krylov, steps)
    return March(at.state, factorisations, krylov, steps)


def _solved(found: Found) -> bool:
    return found.residual <= LOOSE
