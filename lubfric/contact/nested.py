"""A first pressure from coarser grids."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .descent import with_load
from .pcg import Found, conjugate_gradient


def load_controlled(problem, mean_pressure: float, start=None) -> Found:
    """Conjugate gradient from ``start``, rescaled to the load, or else from coarser grids."""
    load = mean_pressure * problem.gap0.size
    if start is not None and start.any():
        return conjugate_gradient(problem, rescaled(start, load, problem.hardness), load=load)
    pressure, convolutions = first_pressure(problem, mean_pressure)
    found = conjugate_gradient(problem, pressure, load=load)
    return replace(found, convolutions=found.convolutions + convolutions) if convolutions else found


def rescaled(pressure, load: float, hardness: float) -> np.ndarray:
    """``pressure`` times a factor, then shifted within 0..hardness where it is loaded, to carry ``load``."""
    result = pressure * (load / pressure.sum())
    loaded = result > 0
    if np.count_nonzero(loaded) * hardness <= load:
        return with_load(result, load, hardness)
    result[loaded] = with_load(result[loaded], load, hardness)
    return result


def first_pressure(problem, mean_pressure: float) -> tuple[np.ndarray, float]:
    """Pressure [Pa] prolonged from a loose solution on a grid of half the resolution, itself begun on a
    coarser one; uniform where a grid cannot be halved. And the convolutions spent, in units of this grid."""
    coarse = problem.coarsened()
    if coarse is None:
        return np.full(problem.gap0.shape, mean_pressure), 0.0
    pressure, spent = first_pressure(coarse, mean_pressure)
    found = conjugate_gradient(coarse, pressure, load=mean_pressure * coarse.gap0.size)
    factor = [n // m for n, m in zip(problem.gap0.shape, coarse.gap0.shape)]
    fine = found.pressure.repeat(factor[0], axis=0).repeat(factor[1], axis=1)
    return fine, (found.convolutions + spent) * coarse.gap0.size / problem.gap0.size
