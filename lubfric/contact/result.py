"""What a dry contact solve returns."""

from __future__ import annotations

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
    has ended. L is the length of `lubfric.contact.residual.length_scale`:

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
