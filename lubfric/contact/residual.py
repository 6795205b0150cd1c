"""Independent check of a contact solution: nothing here knows which method found the pressure."""

from __future__ import annotations

import math

import numpy as np


def length_scale(pressure, displacement, operator) -> float:
    """Length [m] that gap residuals are measured in: ``max(Σ p u / Σ p, (4/pi) p_mean d/E')``.

    The first is the load-weighted elastic deflection (twice the elastic energy per load): the
    indentation of one touching cell, about the approach of a Hertz contact, about the roughness
    height when most of it is pressed flat. The second, the deflection of the shortest ripple that the
    grid resolves (d: the finer spacing) under the mean pressure, takes over where hardly any
    deflection is left to measure by, as in full contact. Both scale with the lengths, and not with E'
    and p together. Infinite without load.
    """
    return deflection_scale(np.vdot(pressure, displacement), pressure.sum(), operator)


def deflection_scale(energy: float, total: float, operator) -> float:
    """`length_scale` from Σ p u [Pa m] and Σ p [Pa]."""
    if total <= 0:
        return math.inf
    ripple = 4 / math.pi * total / math.prod(operator.shape) * min(operator.spacing) / operator.e_prime
    return float(max(energy / total, ripple))


def contact_residuals(pressure, gap, scale: float, hardness: float, mean_pressure: float) -> dict[str, float]:
    """Complementarity, penetration and load residuals, dimensionless; see `solve_contact` for formulas."""
    saturated = pressure >= hardness
    overlap = np.where(saturated, 0.0, -gap).max()
    misfit = np.where(saturated, np.maximum(gap, 0.0), np.abs(gap))
    total = pressure.sum()
    if total == 0:
        return {"complementarity": 0.0, "penetration": math.inf if overlap > 0 else 0.0, "load": 0.0}
    return {"complementarity": float(np.vdot(pressure, misfit) / (total * scale)),
            "penetration": max(0.0, float(overlap) / scale),
            "load": float(abs(total / pressure.size - mean_pressure) / mean_pressure)}
