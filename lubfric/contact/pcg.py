"""Load-controlled contact by a Fourier-preconditioned conjugate gradient on a working set."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..halfspace.operator import filtered, wavenumber
from ..report import CONVERGED, ITERATION_LIMIT
from .residual import contact_residuals, length_scale


@dataclass(frozen=True)
class Found:
    """Pressure and approach as the iteration left them, and what they cost."""

    pressure: np.ndarray
    approach: float
    status: str
    solver: str
    iterations: int
    convolutions: int
    history: list[float]
    notes: tuple[str, ...] = ()


def load_controlled(problem, mean_pressure: float, start=None) -> Found:
    """Minimise the elastic energy under the load; see the module."""
    op, hardness, gap0 = problem.operator, problem.hardness, problem.gap0
    load = mean_pressure * gap0.size
    symbol = wavenumber(op.shape, op.spacing)
    p = np.full_like(gap0, mean_pressure)
    if start is not None and start.any():
        p = with_load(start, np.ones(p.shape, bool), load, hardness)
    u, convolutions, history, d = op.apply(p), 1, [], None
    for iteration in range(problem.max_iterations + 1):
        inside = (p > 0) & (p < hardness)
        r = gap0 + u
        approach = contact_level(r, p, inside, hardness)
        r -= approach
        residuals = contact_residuals(p, r, length_scale(p, u, op), hardness, mean_pressure)
        history.append(max(residuals.values()))
        if history[-1] <= 0.9 * problem.tolerance or iteration == problem.max_iterations:
            break
        working = inside | ((p == 0) & (r < 0)) | ((p >= hardness) & (r > 0))
        r = balanced(r, working)
        z = balanced(filtered(r, symbol, op.shape, op.workers), working)
        rz = np.vdot(r, z)
        if d is None:
            d = -z
        else:
            d = balanced(max(0.0, (rz - np.vdot(r_old, z)) / rz_old) * d - z, working)
        r_old, rz_old = r, rz
        kd = op.apply(d)
        convolutions += 2
        step = -np.vdot(r, d) / np.vdot(d, kd)
        p = p + step * d
        if p.min() >= 0 and p.max() <= hardness:
            u = u + step * kd
        else:
            p = with_load(p, working, load, hardness)
            u = op.apply(p)
            convolutions += 1
    status = CONVERGED if history[-1] <= problem.tolerance else ITERATION_LIMIT
    return Found(p, approach, status, "preconditioned conjugate gradient", iteration, convolutions, history)


def balanced(field, working):
    """``field`` on the working set with its mean there removed, zero elsewhere."""
    field = np.where(working, field, 0.0)
    return np.where(working, field - field.sum() / max(1, np.count_nonzero(working)), 0.0)


def contact_level(height, pressure, inside, hardness) -> float:
    """Approach at which the mean gap over elastic contact cells is zero; without any, the level that
    parts yielded cells (below) from free ones (above)."""
    if inside.any():
        return float(height[inside].mean())
    free = pressure == 0
    highest = height[~free].max()
    return float(0.5 * (highest + max(highest, height[free].min()))) if free.any() else float(highest)


def with_load(pressure, working, load: float, hardness: float):
    """``clip(pressure + s, 0, hardness)`` on the working set, s such that the total is ``load``."""
    inner = pressure[working]
    rest = load - (pressure.sum() - inner.sum())
    shift = 0.0
    for _ in range(100):
        trial = np.clip(inner + shift, 0.0, hardness)
        missing = rest - trial.sum()
        movable = np.count_nonzero((trial > 0) & (trial < hardness))
        if abs(missing) <= 1e-15 * load or movable == 0:
            break
        shift += missing / movable
    result = pressure.copy()
    result[working] = trial
    return result
