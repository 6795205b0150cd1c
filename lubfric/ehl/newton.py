"""Newton's method on one grid, with the two limits that keep the step physical."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..report import CONVERGED, DIVERGED, ITERATION_LIMIT
from .grid import Grid
from .problem import Problem
from .reynolds import Terms, jacobian, residual

VISCOSITY_STEP = 3.0     # largest change of ln(eta) in one step
FILM_STEP = 0.7          # largest share of the film (or flux) that one step may remove


@dataclass(frozen=True)
class Solution:
    """Unknowns ``z`` on ``grid`` with their `Terms`; ``error``: largest residual."""

    grid: Grid
    z: np.ndarray
    terms: Terms
    status: str
    error: float
    history: tuple[float, ...]


def newton(grid: Grid, problem: Problem, z: np.ndarray, tolerance: float, max_steps: int) -> Solution:
    """Solve the discrete equations to max|residual| <= ``tolerance``."""
    from scipy.linalg.lapack import dgesv

    history = []
    for step in range(max_steps + 1):
        R, terms = residual(grid, problem, z)
        error = float(np.max(np.abs(R)))
        history.append(error)
        if not np.isfinite(error):
            return Solution(grid, z, terms, DIVERGED, error, tuple(history))
        if error <= tolerance:
            return Solution(grid, z, terms, CONVERGED, error, tuple(history))
        if step == max_steps:
            break
        _, _, delta, info = dgesv(jacobian(grid, problem, terms), -R, overwrite_a=1, overwrite_b=1)
        if info != 0 or not np.all(np.isfinite(delta)):
            return Solution(grid, z, terms, DIVERGED, error, tuple(history))
        z = z + _step_length(grid, terms, delta) * delta
    return Solution(grid, z, terms, ITERATION_LIMIT, error, tuple(history))


def _step_length(grid: Grid, terms: Terms, delta: np.ndarray) -> float:
    n = grid.n
    dP = delta[:n]
    change = np.max(np.abs(dP * terms.slope[:n]))
    length = 1.0 if change <= VISCOSITY_STEP else VISCOSITY_STEP / change
    dH = grid.kernel[:, :n] @ dP + (delta[n] + terms.X * delta[n + 2])
    shrink = max(float(np.max(-dH / terms.H)), -delta[n + 1] / terms.q)
    return length if shrink * length <= FILM_STEP else FILM_STEP / shrink
