"""A first pressure from coarser grids."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .pcg import Found, conjugate_gradient
from .projection import with_load


def load_controlled(problem, mean_pressure: float, start=None) -> Found:
    """Conjugate gradient for a mean pressure [Pa] from ``start``, rescaled to it, or else from coarser grids."""
    load = mean_pressure * problem.gap0.size
    if start is not None and start.any():
        return conjugate_gradient(problem, rescaled(start, load, problem.hardness), load=load)

    def solve(problem, pressure):
        return conjugate_gradient(problem, pressure, load=mean_pressure * problem.gap0.size)

    return from_coarse(problem, mean_pressure, solve)


def approach_controlled(problem, approach: float, guess: float, start=None) -> Found:
    """Conjugate gradient for an approach [m] from ``start``, or from coarser grids and a uniform ``guess`` [Pa]."""
    if start is not None and start.any():
        return conjugate_gradient(problem, start.copy(), level=approach)
    return from_coarse(problem, guess, lambda problem, pressure: conjugate_gradient(problem, pressure, level=approach))


def from_coarse(problem, uniform: float, solve) -> Found:
    """``solve(problem, pressure)`` begun from a loose solution on cells twice as long, that one likewise; on a grid
    that cannot be halved from a uniform pressure. Counts convolutions in units of this grid."""
    coarse = problem.coarsened()
    if coarse is None:
        return solve(problem, np.full(problem.gap0.shape, uniform))
    begun = from_coarse(coarse, uniform, solve)
    fx, fy = (n // m for n, m in zip(problem.gap0.shape, coarse.gap0.shape))
    found = solve(problem, begun.pressure.repeat(fx, axis=0).repeat(fy, axis=1))
    return replace(found, convolutions=found.convolutions + begun.convolutions * coarse.gap0.size / problem.gap0.size)


def rescaled(pressure, load: float, hardness: float) -> np.ndarray:
    """``pressure`` times a factor, then shifted to carry ``load`` within 0..hardness: where it is elastic if
    those cells can do it, else anywhere it is loaded, else everywhere."""
    result = np.minimum(pressure * (load / pressure.sum()), hardness)
    result[pressure >= hardness] = hardness
    yielded = result >= hardness
    for movable in ((result > 0) & ~yielded, result > 0, np.ones(result.shape, bool)):
        share = load - result[~movable].sum()
        if 0 < share < hardness * np.count_nonzero(movable):
            result[movable] = with_load(result[movable], share, hardness)
            return result
    return np.full(pressure.shape, load / pressure.size)
