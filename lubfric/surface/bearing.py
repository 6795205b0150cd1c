"""The material ratio (Abbott-Firestone) curve of a height map, and the parameters Sk, Spk, Svk read from it.

Sources: ISO 25178-2:2021, functional parameters of stratified surfaces; the construction is that of ISO 13565-2:1996
and ISO 21920-2:2021 for profiles. The standards apply the parameters to an S-shaped curve, after filters that take form
and long waves away (`Surface.level`, `Surface.filtered`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

CENTRAL = 0.40  # share of the material ratio, from which the equivalent line is taken (ISO 13565-2, Sec. 4.2)


@dataclass(frozen=True, kw_only=True)
class Bearing:
    """The parameters of a material ratio curve, by the equivalent straight line of its flattest 40 %.

    Attributes
    ----------
    sk : core height Sk [m], the fall of the equivalent line from 0 to 100 % of the material ratio
    spk : reduced peak height Spk [m], the height of the triangle over Smr1 with the area of the peaks
    svk : reduced dale height Svk [m], the depth of the triangle over 1 - Smr2 with the area of the dales
    smr1, smr2 : material ratios [-] at which the core begins and ends
    upper, lower : heights [m] at which the equivalent line has 0 and 100 %, as the heights are given
    """

    sk: float
    spk: float
    svk: float
    smr1: float
    smr2: float
    upper: float = 0.0
    lower: float = 0.0


def material_ratio(heights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the material ratio curve: the share of the ``heights`` that is higher [-], and the height [m] about the
    mean, highest first."""
    falling = np.sort(heights, axis=None)[::-1] - np.mean(heights)
    return (np.arange(falling.size) + 0.5) / falling.size, falling


def bearing(heights: np.ndarray) -> Bearing:
    """Return Sk, Spk, Svk, Smr1 and Smr2 of ``heights`` [m], an array of any shape.

    The secant over 40 % of the material ratio that falls least (the first of equal ones) marks the part of the curve
    through which the equivalent line goes, by least squares of the heights. The line meets 0 and 100 % at two heights;
    Sk is their difference. The areas of the curve above the upper and below the lower height become triangles of the
    same area. A map of equal heights has zeros.
    """
    mean = float(np.mean(heights))
    ratio, heights = material_ratio(heights)
    count = heights.size
    width = min(max(round(CENTRAL * count), 1), count - 1)
    if count < 2 or heights[0] == heights[-1]:
        return Bearing(sk=0.0, spk=0.0, svk=0.0, smr1=0.0, smr2=1.0, upper=mean, lower=mean)
    first = int(np.argmin(heights[:-width] - heights[width:]))
    part = slice(first, first + width + 1)
    slope, intercept = np.polynomial.polynomial.polyfit(ratio[part], heights[part], 1)[::-1]
    upper = intercept
    lower = intercept + slope
    peaks = np.maximum(heights - upper, 0.0)
    dales = np.maximum(lower - heights, 0.0)
    smr1 = np.count_nonzero(peaks) / count
    smr2 = 1.0 - np.count_nonzero(dales) / count
    return Bearing(
        sk=float(upper - lower),
        spk=float(2.0 * peaks.mean() / smr1) if smr1 > 0 else 0.0,
        svk=float(2.0 * dales.mean() / (1.0 - smr2)) if smr2 < 1 else 0.0,
        smr1=smr1,
        smr2=smr2,
        upper=float(upper) + mean,
        lower=float(lower) + mean,
    )
