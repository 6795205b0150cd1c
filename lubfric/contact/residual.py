"""Independent check of a contact solution: nothing here knows which method found the pressure."""

from __future__ import annotations

import math

import numpy as np


def dot(a, b) -> float:
    """Sum of products, on this thread alone: BLAS threads would fight those of the transforms."""
    return float(np.einsum("i,i", a.ravel(), b.ravel()))


def length_scale(pressure, displacement, gap0, operator) -> float:
    """Length L [m] that gap residuals are measured in.

    ``max(min(Σ p u / Σ p, max(d, r)), min(d, r))`` with the roughness r (rms gap0) and the deflection
    ``d = (4/pi) p_mean a/E'`` of the shortest ripple the grid resolves (a: the finer spacing) under the mean
    pressure. The load-weighted elastic deflection Σ p u / Σ p (twice the elastic energy per load) is the
    indentation of one touching cell, about the approach of a Hertz contact, about the roughness height when most
    of it is pressed flat. Without periodicity it would count the bulk, which bends under the whole load however
    smooth the surface: hence at most max(d, r). In full contact, where hardly any of it is left to measure by, at
    least min(d, r). Scales with the lengths, and not with E' and p together. Never below 1e-9 d, which is where
    rounding begins (flat on flat). Infinite without load.
    """
    return deflection_scale(dot(pressure, displacement), pressure.sum(), float(gap0.std()), operator)


def deflection_scale(energy: float, total: float, roughness: float, operator) -> float:
    """`length_scale` from Σ p u [Pa m], Σ p [Pa] and the rms of gap0 [m]."""
    if total <= 0:
        return math.inf
    ripple = 4 / math.pi * total / math.prod(operator.shape) * min(operator.spacing) / operator.e_prime
    smaller, larger = sorted((ripple, roughness))
    return float(max(min(energy / total, larger), smaller, 1e-9 * ripple))


def contact_residuals(pressure, gap, scale: float, hardness: float, mean_pressure: float) -> dict[str, float]:
    """Complementarity, penetration and load residuals, dimensionless; see `solve_contact` for formulas."""
    touching = np.flatnonzero(pressure)
    p, g = pressure.ravel()[touching], gap.ravel()[touching]
    yielded = p >= hardness
    deepest = gap
    if yielded.any():
        deepest = gap.flatten()
        deepest[touching[yielded]] = 0.0
    overlap, total = max(0.0, -float(deepest.min())), float(p.sum())
    misfit = np.where(yielded, np.maximum(g, 0.0), np.abs(g))
    if total == 0:
        return {"complementarity": 0.0, "penetration": math.inf if overlap > 0 else 0.0, "load": 0.0}
    return {
        "complementarity": dot(p, misfit) / (total * scale),
        "penetration": overlap / scale,
        "load": float(abs(total / pressure.size - mean_pressure) / mean_pressure),
    }


def volume(gap) -> float:
    """Mean of the gap [m] where it is open, over all cells: overlap counts zero."""
    return float((gap.sum() - gap[gap < 0].sum()) / gap.size)
