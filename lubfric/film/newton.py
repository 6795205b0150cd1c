"""Newton's method on one grid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import CONVERGED, DIVERGED, ITERATION_LIMIT
from .grid import Grid
from .problem import Problem
from .reynolds import Terms, linearise, residual

VISCOSITY_STEP = 3.0  # largest change of ln(eta) in one step
FILM_STEP = 0.7  # largest share of the film (or the flux) that one step may remove


@dataclass(frozen=True)
class Solution:
    """Unknowns ``z`` on ``grid`` with their `Terms`; ``error``: largest residual or film defect."""

    grid: Grid
    z: np.ndarray
    terms: Terms
    status: str
    error: float
    history: tuple[float, ...]


def step_length(log_viscosity_change: np.ndarray, film_loss: float) -> float:
    """The part of a step to take, 0 to 1. It follows from two effects of the whole step: the change of ln(eta) at the
    nodes, and ``film_loss``, the largest fraction of the film (or flux) that it removes."""
    change = float(np.max(np.abs(log_viscosity_change)))
    length = 1.0 if change <= VISCOSITY_STEP else VISCOSITY_STEP / change
    return length if film_loss * length <= FILM_STEP else FILM_STEP / film_loss


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def newton(grid: Grid, problem: Problem, z: np.ndarray, H: np.ndarray, tolerance: float, max_steps: int) -> Solution:
    """Solve the equations from unknowns z and film H > 0 to max(|residual|, |defect|/H) <= ``tolerance``.

    A step that overflows ends the iteration as "diverged".
    """
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
