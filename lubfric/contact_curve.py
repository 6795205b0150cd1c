"""Mean gap against mean pressure of a nominally flat rough contact: one curve for every speed and lubricant."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from . import validate
from .contact import solve_contact

LIGHTEST = 1e-6        # of the heaviest pressure: below it the light-load law of one asperity is used
SPACING = 4.0          # pressure ratio between neighbouring nodes


@dataclass(frozen=True)
class ContactCurve:
    """Nodes of the curve, heaviest first: mean_pressure [Pa], mean_gap [m], area fractions [-].

    touching_gap [m]: mean gap at first contact. ``evaluations``: convolutions spent on all nodes.
    """

    mean_pressure: np.ndarray
    mean_gap: np.ndarray
    contact_area_fraction: np.ndarray
    plastic_area_fraction: np.ndarray
    touching_gap: float
    evaluations: int

    def at(self, mean_pressure: float) -> tuple[float, float, float]:
        """(mean gap, contact area fraction, plastic area fraction) at a mean pressure <= the heaviest.

        Cubic (shape-preserving) in the logarithm of the pressure between the nodes: the gap, the
        logarithm of the area, the plastic share of the area. Below the lightest node a single Hertz
        asperity: approach and area ~ p^(2/3).
        """
        from scipy.interpolate import PchipInterpolator
        pressure = validate.nonnegative("mean_pressure", mean_pressure, "Pa", maximum=float(self.mean_pressure[0]))
        gap, area, plastic = self.mean_gap, self.contact_area_fraction, self.plastic_area_fraction
        lightest = self.mean_pressure[-1]
        if pressure <= lightest:
            share = (pressure / lightest) ** (2 / 3)
            return self.touching_gap - share * (self.touching_gap - gap[-1]), share * area[-1], share * plastic[-1]
        table = np.stack([gap, np.log(area), plastic / area])[:, ::-1]
        values = PchipInterpolator(np.log(self.mean_pressure[::-1]), table, axis=1)(np.log(pressure))
        touching = float(np.exp(values[1]))
        return float(values[0]), touching, float(values[2]) * touching

    def pressure_at(self, mean_gap: float) -> float:
        """Mean pressure [Pa] at a mean gap [m]: 0 above first touch, the heaviest below the curve's least gap."""
        from scipy.optimize import brentq
        if mean_gap >= self.touching_gap:
            return 0.0
        if mean_gap <= self.mean_gap[0]:
            return float(self.mean_pressure[0])
        if mean_gap >= self.mean_gap[-1]:
            share = (self.touching_gap - mean_gap) / (self.touching_gap - self.mean_gap[-1])
            return float(share**1.5 * self.mean_pressure[-1])
        ends = np.log(self.mean_pressure[[-1, 0]]) + [1e-14, -1e-14]
        return float(np.exp(brentq(lambda log_pressure: self.at(np.exp(log_pressure))[0] - mean_gap, *ends,
                                   xtol=1e-12, rtol=1e-14)))


def contact_curve(heights, spacing, e_prime, *, heaviest, hardness=None, tolerance=1e-4, operator=None) -> ContactCurve:
    """Solve the periodic contact of ``heights`` [m] from the pressure ``heaviest`` [Pa] down.

    Each node starts from its heavier neighbour. Raises what `lubfric.solve_contact` raises.
    """
    validate.positive("heaviest", heaviest, "Pa")
    gap0 = np.max(heights) - heights
    count = 1 + int(np.ceil(np.log(1 / LIGHTEST) / np.log(SPACING)))
    pressures = heaviest * np.geomspace(1.0, LIGHTEST, count)
    nodes, start = [], None
    for pressure in pressures:
        start = solve_contact(gap0, spacing, e_prime, mean_pressure=pressure, hardness=hardness,
                              tolerance=tolerance, operator=operator, start=start)
        nodes.append((start.mean_gap, start.contact_area_fraction, start.plastic_area_fraction,
                      start.report.evaluations))
    gap, area, plastic, work = np.array(nodes).T
    return ContactCurve(pressures, gap, area, plastic, float(gap0.mean()), int(work.sum()))
