"""Outliers of a measured map: points that stand alone, as no neighbour of theirs does.

The rule: a measured point is an outlier when it lies more than ``LIMIT`` robust standard deviations of the whole map from
the median of the ``WINDOW`` x ``WINDOW`` points around it. The robust deviation is 1.4826 times the median of
|z - median(z)|, which is the standard deviation of a Gaussian map and hardly feels the outliers themselves; where it is zero
(most of the map is one height) it is Sq. What is found is filled and the map searched again, until nothing is. Ridges and
grooves at least three points wide stay, however high, and so do summits that are wide against the window; dust, noise beside
unmeasured points and the flares of optical instruments at steep edges go.
"""

from __future__ import annotations

import numpy as np

LIMIT = 6.0
WINDOW = 5
GAUSSIAN = 1.4826  # standard deviation over median deviation


def robust_deviation(heights: np.ndarray) -> float:
    """1.4826 times the median of |z - median(z)| [m]."""
    return GAUSSIAN * float(np.median(np.abs(heights - np.median(heights))))


def prominence(heights: np.ndarray, mask: np.ndarray | None, periodic: tuple[bool, bool]) -> np.ndarray:
    """Height [m] of each point above the median around it, 0 where unmeasured.

    heights : (nx, ny) [m], finite; unmeasured points (False in ``mask``) stand in the windows as they are: fill them first.
    """
    from scipy.ndimage import median_filter

    half = WINDOW // 2
    padded = heights
    for axis in range(2):
        width = [(0, 0), (0, 0)]
        width[axis] = (half, half)
        padded = np.pad(padded, width, mode="wrap" if periodic[axis] else "symmetric")
    around = median_filter(padded, WINDOW)[half:-half, half:-half]
    above = heights - around
    return above if mask is None else np.where(mask, above, 0.0)


def outliers(heights: np.ndarray, mask: np.ndarray | None, periodic: tuple[bool, bool]) -> np.ndarray:
    """True (nx, ny) at the outliers of a filled, levelled map, above or below."""
    measured = heights if mask is None else heights[mask]
    deviation = robust_deviation(measured) or float(measured.std())
    return np.abs(prominence(heights, mask, periodic)) > LIMIT * deviation
