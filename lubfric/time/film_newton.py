"""Newton's method for one implicit step; every Newton step decides anew which nodes are cavitated."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..errors import CONVERGED, DIVERGED, ITERATION_LIMIT
from ..film import step_length
from .film_equations import StepEquations, StepTerms
from .march import Step

SMALLEST_STAGE = 0.01  # of the logarithm of a change of the load


@dataclass(frozen=True, kw_only=True)
class FilmStep(Step):
    """A step of the film, with its terms at z. It remembers rho H."""

    terms: StepTerms


def solve_step(equations: StepEquations, z: np.ndarray, *, tolerance: float = 1e-7, max_steps: int = 25) -> FilmStep:
    """Solve the complementarity equations from z until ``equations.residual`` <= tolerance.

    A node counts as cavitated when the pressure that its own equation asks for, P - r/(dr/dP), is negative. This
    primal-dual active set is a semismooth Newton method. If it fails, the load is changed in stages from the load of z
    to the one asked for. (With a spring that is not needed.)
    """
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        found = _iterated(equations, z, tolerance, max_steps)
        first = float(equations.grid.weights @ z[:-1])
        if found.status == CONVERGED or equations.spring is not None or not first > 0.0:
            return found
        done, stage = 0.0, 0.25
        while done < 1.0 and stage >= SMALLEST_STAGE:
            goal = min(1.0, done + stage)
            now = replace(equations.now, load=first * (equations.now.load / first) ** goal)
            found = _iterated(replace(equations, now=now), z, tolerance, max_steps)
            if found.status == CONVERGED:
                done, stage, z = goal, 1.5 * stage, found.z
            else:
                stage *= 0.4
    return found


def _iterated(equations: StepEquations, z: np.ndarray, tolerance: float, max_steps: int) -> FilmStep:
    for step in range(max_steps + 1):
        t = equations.evaluate(z)
        residual, status = equations.residual(t), ITERATION_LIMIT
        if residual <= tolerance:
            status = CONVERGED
        elif not np.isfinite(residual):
            status = DIVERGED
        if status != ITERATION_LIMIT or step == max_steps:
            break
        J = equations.jacobian(t)
        cavitated = t.P - t.r / np.diagonal(J)[:-1] < 0.0
        delta = _newton(J, t, cavitated)
        if delta is None:
            status = DIVERGED
            break
        loss = float(np.max(-(equations.grid.kernel @ delta[:-1] + delta[-1]) / t.H))
        z = z + step_length(delta[:-1] * t.log_slope, loss) * delta
        z[:-1][cavitated & (z[:-1] < 1e-14 * t.P.max())] = 0.0
    return FilmStep(status=status, film=t.rho[0] * t.H, z=z, terms=t)


def _newton(J: np.ndarray, t: StepTerms, cavitated: np.ndarray) -> np.ndarray | None:
    """Newton's step with P = 0 at the cavitated nodes; None: the matrix is singular."""
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
