"""What a dry contact solve returns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..report import Report
from ..show import Shown


@dataclass(frozen=True, repr=False)
class ContactResult(Shown):
    """Fields and means of one contact; arrays (nx, ny), means over the whole array.

    pressure [Pa]: 0 <= p <= hardness. displacement [m]: u = K p, in the gauge of the half-space
    operator. approach [m] and gap [m]: ``gap = gap0 - approach + displacement``, >= 0 except where
    the pressure has reached the hardness and the bodies overlap. mean_pressure [Pa]: load per area.
    mean_gap [m]: volume between the bodies per area, overlapping cells counted as zero.
    contact_area_fraction: cells with p > 0. plastic_area_fraction: cells with p = hardness.
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
