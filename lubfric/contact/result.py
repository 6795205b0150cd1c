"""What a dry contact solve returns, and the residuals by which any pressure is judged, whatever method found it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .._base import Shown
from ..errors import Report


@dataclass(frozen=True, repr=False)
class ContactResult(Shown):
    """Fields and means of one dry contact. Arrays are (nx, ny); means are over the whole array.

    Attributes
    ----------
    pressure : 0 <= p <= hardness [Pa]
    displacement : u = K p [m], up to the constant of the half-space operator
    gap : gap0 - approach + displacement [m]; >= 0, except where the pressure is at the hardness and the bodies overlap
    approach : rigid motion towards each other [m]
    mean_pressure : load per area [Pa]
    mean_gap : volume between the bodies per area [m]; overlapping cells count as zero
    contact_area_fraction : share of the cells with p > 0 [-]
    plastic_area_fraction : share of the cells with p = hardness [-]
    report : how the solve ended

    Notes
    -----
    The residuals of the report are computed from the returned pressure alone, in double precision, after the iteration
    has ended. L is the length of `length_scale`:

    - complementarity: ``Σ p m / (L Σ p)``, with the misfit m = |gap|, or max(gap, 0) where p = H
    - penetration: ``max(-gap)/L`` over cells with p < H
    - load: ``|mean p - mean_pressure|/mean_pressure``, or volume: ``|mean max(gap, 0) - mean_gap|/min(L, mean_gap)``
    """

    pressure: np.ndarray
    gap: np.ndarray
    displacement: np.ndarray
    approach: float
    mean_pressure: float
    mean_gap: float
    contact_area_fraction: float
    plastic_area_fraction: float
    report: Report

    def _facts(self) -> dict[str, str]:
        nx, ny = self.pressure.shape
        return {
            "": f"{nx} x {ny} cells",
            "mean pressure": f"{self.mean_pressure:.4g} Pa",
            "mean gap": f"{self.mean_gap:.4g} m",
            "contact area": f"{100 * self.contact_area_fraction:.3g} %",
            "status": self.report.status,
        }


def dot(a, b) -> float:
    """Sum of products, on this thread alone: BLAS threads would fight those of the transforms."""
    return float(np.einsum("i,i", a.ravel(), b.ravel()))


def length_scale(pressure, displacement, gap0, operator, roughness: float | None = None) -> float:
    """Length L [m] in which gap residuals are measured.

    ``max(min(Σ p u / Σ p, max(d, r)), min(d, r))`` with the ``roughness`` r (None: rms of gap0) and the deflection
    ``d = (4/pi) p_mean a/E'`` of the shortest ripple that the grid resolves (a: the finer spacing) under the mean
    pressure. The load-weighted elastic deflection Σ p u / Σ p is twice the elastic energy per load. It is the
    indentation of one touching cell, about the approach of a Hertz contact, and about the roughness height when most of
    it is flattened. Two bounds are needed. At most max(d, r): without periodicity the deflection includes the bulk,
    which deforms under the whole load however smooth the surface. At least min(d, r): in full contact hardly any
    deflection is left to compare with. L is proportional to the lengths, and does not change with E' and p together. It
    is never below 1e-9 d, where rounding begins (flat on flat). Infinite without load.
    """
    total = float(pressure.sum())
    if total <= 0:
        return math.inf
    ripple = 4 / math.pi * total / pressure.size * min(operator.spacing) / operator.e_prime
    smaller, larger = sorted((ripple, float(gap0.std()) if roughness is None else roughness))
    loaded = np.flatnonzero(pressure > 0)
    work = dot(pressure.ravel()[loaded], displacement.ravel()[loaded])
    return float(max(min(work / total, larger), smaller, 1e-9 * ripple))


def contact_residuals(pressure, gap, scale: float, hardness: float) -> dict[str, float]:
    """Complementarity and penetration residuals, dimensionless; see `ContactResult` for formulas."""
    loaded, gap = np.flatnonzero(pressure > 0), gap.ravel()
    carried, apart = pressure.ravel()[loaded], np.abs(gap[loaded])
    yielded = carried >= hardness
    if yielded.any():
        apart[yielded] = np.maximum(gap[loaded[yielded]], 0.0)
        gap = gap.copy()
        gap[loaded[yielded]] = 0.0
    lowest = float(gap.min())
    if not loaded.size:
        return {"complementarity": 0.0, "penetration": math.inf if lowest < 0 else 0.0}
    return {"complementarity": dot(carried, apart) / (carried.sum() * scale), "penetration": max(0.0, -lowest) / scale}


def zero_level(height, yielded, elastic=None, otherwise: float = 0.0) -> float:
    """The approach [m] at which the mean gap over the ``elastic`` cells is zero, from the ``height`` of the gap.

    If no cell is elastic, it is halfway between the highest ``yielded`` cell and the lowest other one; if no cell is
    loaded at all, ``otherwise``. elastic, yielded: flags.
    """
    count = 0 if elastic is None else np.count_nonzero(elastic)
    if count:
        return dot(height, elastic.astype(height.dtype)) / count
    if not yielded.any():
        return otherwise
    highest = float(height[yielded].max())
    return 0.5 * (highest + (highest if yielded.all() else float(height[~yielded].min())))
