"""Independent check of a contact solution; it does not know which method found the pressure."""

from __future__ import annotations

import math

import numpy as np

from .fields import parts


def dot(a, b) -> float:
    """Sum of products, on this thread alone: BLAS threads would fight those of the transforms."""
    return float(np.einsum("i,i", a.ravel(), b.ravel()))


def length_scale(pressure, displacement, gap0, operator) -> float:
    """Length L [m] in which gap residuals are measured.

    ``max(min(Σ p u / Σ p, max(d, r)), min(d, r))`` with the roughness r (rms gap0) and the deflection
    ``d = (4/pi) p_mean a/E'`` of the shortest ripple that the grid resolves (a: the finer spacing) under the mean
    pressure. The load-weighted elastic deflection Σ p u / Σ p is twice the elastic energy per load. It is the
    indentation of one touching cell, about the approach of a Hertz contact, and about the roughness height when most of
    it is flattened. Two bounds are needed. At most max(d, r): without periodicity the deflection includes the bulk,
    which deforms under the whole load however smooth the surface. At least min(d, r): in full contact hardly any
    deflection is left to compare with. L is proportional to the lengths, and does not change with E' and p together. It
    is never below 1e-9 d, where rounding begins (flat on flat). Infinite without load.
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
    total = misfit = lowest = 0.0
    for p, g in blocks(pressure, gap):
        apart = np.abs(g)
        if hardness < np.inf:
            yielded = p >= hardness
            apart[yielded] = np.maximum(g[yielded], 0.0)
            g = np.where(yielded, 0.0, g)
        total += float(p.sum())
        misfit += dot(p, apart)
        lowest = min(lowest, float(g.min()))
    if total == 0:
        return {"complementarity": 0.0, "penetration": math.inf if lowest < 0 else 0.0, "load": 0.0}
    return {
        "complementarity": misfit / (total * scale),
        "penetration": max(0.0, -lowest) / scale,
        "load": float(abs(total / pressure.size - mean_pressure) / mean_pressure),
    }


def blocks(*fields):
    """The fields part by part, each part of one axis and small enough to stay in the cache."""
    flat = [field.ravel() for field in fields]
    return zip(*([values[part] for part in parts(values.size)] for values in flat))


def volume(gap) -> float:
    """Mean of the gap [m] where it is open, over all cells: overlap counts zero."""
    return sum(float(np.maximum(g, 0.0).sum()) for (g,) in blocks(gap)) / gap.size


def spread(field) -> float:
    """Standard deviation of a field."""
    mean, squares = float(field.mean()), 0.0
    for (values,) in blocks(field):
        apart = values - mean
        squares += dot(apart, apart)
    return math.sqrt(squares / field.size)
