"""Newton's method on one grid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import CONVERGED, DIVERGED, ITERATION_LIMIT
from .grid import Grid
from .limiter import step_length
from .problem import Problem
from .reynolds import Terms, linearise, residual


@dataclass(frozen=True)
class Solution:
    """Unknowns ``z`` on ``grid`` with their `Terms`; ``error``: largest residual or film defect."""

    grid: Grid
    z: np.ndarray
    terms: Terms
    status: str
    error: float
    history: tuple[float, ...]


def newton(grid: Grid, problem: Problem, z: np.ndarray, H: np.ndarray, tolerance: float, max_steps: int) -> Solution:
    """Solve the equations from unknowns z and film H > 0 to max(|residual|, |defect|/H) <= ``tolerance``.

    A step that overflows ends the iteration as "diverged"."""
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        return _iterate(grid, problem, z, H, tolerance, max_steps)


def _iterate(grid, problem, z, H, tolerance, max_steps) -> Solution:
    from scipy.linalg.lapack import dgesv

    history = []
    status = ITERATION_LIMIT
    for step in range(max_steps + 1):
        R, terms = residual(grid, problem, z, H)
        error = max(float(np.max(np.abs(R))), float(np.max(np.abs(terms.defect) / H)))
        history.append(error)
        if error <= tolerance:
            status = CONVERGED
        if status == CONVERGED or not np.isfinite(error) or step == max_steps:
            break
        J, shift = linearise(grid, problem, terms)
        _, _, delta, info = dgesv(J, -(R + shift), overwrite_a=1, overwrite_b=1)
        if info != 0:
            break
        dH = terms.defect + grid.kernel[:, :-1] @ delta[:-3] + (delta[-3] + terms.by_rupture * delta[-1])
        loss = max(float(np.max(-dH / terms.H)), -delta[-2] / terms.q)
        length = step_length(delta[:-3] * terms.slope[:-1], loss)
        z = z + length * delta
        H = H + length * dH
    if status != CONVERGED and step < max_steps:
        status = DIVERGED
    return Solution(grid, z, terms, status, error, tuple(history))
