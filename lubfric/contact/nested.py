"""A start for the pressure from coarser grids."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .descent import FIRST_PACE
from .projection import rescaled, shifted
from .refine import Found, approximate, refine

HEAVIER = 2.0  # times the load of a start: beyond it new spots matter more than what the old ones bear


def load_controlled(problem, mean_pressure: float, start=None) -> Found:
    """Solve for a mean pressure [Pa]: from ``start``, made to carry it, or else from coarser grids."""
    load = mean_pressure * problem.gap0.size
    if start is not None and start.any():
        made_for = shifted if load <= HEAVIER * start.sum() else rescaled
        return refine(problem, made_for(start, load, problem.hardness), load=load)
    return _from_coarse(problem, mean_pressure, refine, mean_pressure=mean_pressure)


def approach_controlled(problem, approach: float, guess: float, start=None) -> Found:
    """Solve for an approach [m] from ``start``, or from coarser grids and a uniform ``guess`` [Pa]."""
    if start is not None and start.any():
        return refine(problem, start.copy(), level=approach)
    return _from_coarse(problem, guess, refine, level=approach)


def _from_coarse(problem, uniform: float, solve, *, mean_pressure=None, level=None) -> Found:
    """Solve from a loose solution on cells twice as long, which is made in the same way. A grid that cannot be halved
    starts from a uniform pressure. Convolutions are counted in units of this grid."""
    coarse = problem.coarsened()
    load = None if mean_pressure is None else mean_pressure * problem.gap0.size
    if coarse is None:
        return solve(problem, np.full(problem.gap0.shape, uniform), load=load, level=level, pace=FIRST_PACE)
    begun = _from_coarse(coarse, uniform, approximate, mean_pressure=mean_pressure, level=level)
    fx, fy = (n // m for n, m in zip(problem.gap0.shape, coarse.gap0.shape))
    start = begun.pressure.repeat(fx, axis=0).repeat(fy, axis=1)
    found = solve(problem, start, load=load, level=level, pace=begun.pace)
    return replace(found, convolutions=found.convolutions + begun.convolutions * coarse.gap0.size / problem.gap0.size)
