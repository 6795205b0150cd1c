"""Outliers of a measured map: points that stand alone, far from all their neighbours.

The rule: a measured point is an outlier when it lies more than ``LIMIT`` robust standard deviations both from the
median of the whole map and from the median of the ``WINDOW`` x ``WINDOW`` points around it, on the same side. The
robust deviation is 1.4826 times the median of |z - median(z)|. For a Gaussian map that is the standard deviation, and
the outliers themselves hardly change it. Where it is zero (most of the map has one height) Sq is taken.

Outliers are filled and the map is searched again, until there are none. Ridges and grooves at least three points wide
stay, however high. So do summits that are wide against the window. Dust, noise beside unmeasured points and the flares
of optical instruments at steep edges go.
"""

from __future__ import annotations

import numpy as np

LIMIT = 6.0
WINDOW = 5
CHUNK = 2**18  # points whose windows are held at once
GAUSSIAN = 1.4826  # standard deviation over median deviation


def robust_deviation(heights: np.ndarray, middle: float) -> float:
    """1.4826 times the median of |z - ``middle``| [m], or Sq where that is zero. ``middle`` [m]: median of z."""
    return GAUSSIAN * float(np.median(np.abs(heights - middle))) or float(heights.std())


def outliers(heights: np.ndarray, mask: np.ndarray | None, periodic: tuple[bool, bool]) -> np.ndarray:
    """Deviations (nx, ny) by which each outlier of a filled, levelled map stands off its neighbours, negative below
    them; 0 elsewhere.

    heights : (nx, ny) [m], finite; unmeasured points (False in ``mask``) stand in the windows as they are: fill them
        first.
    """
    measured = heights if mask is None else heights[mask]
    middle = float(np.median(measured))
    deviation = robust_deviation(measured, middle)
    found = np.zeros(heights.shape)
    if deviation == 0:
        return found
    far = np.abs(heights - middle) > LIMIT * deviation
    where = np.nonzero(far if mask is None else far & mask)
    parts = [tuple(at[i : i + CHUNK] for at in where) for i in range(0, where[0].size, CHUNK)]
    around = [_median_around(heights, part, periodic) for part in parts]
    off = (heights[where] - np.concatenate([np.empty(0), *around])) / deviation
    same_side = np.sign(off) == np.sign(heights[where] - middle)
    found[where] = np.where((np.abs(off) > LIMIT) & same_side, off, 0.0)
    return found


def _median_around(heights: np.ndarray, where: tuple[np.ndarray, ...], periodic: tuple[bool, bool]) -> np.ndarray:
    """Median of the window around each of the points ``where``; mirrored at open ends."""
    reach = np.arange(WINDOW) - WINDOW // 2
    rows, columns = (_inside(at[:, None] + reach, n, closed) for at, n, closed in zip(where, heights.shape, periodic))
    return np.median(heights[rows[:, :, None], columns[:, None, :]], axis=(1, 2))


def _inside(index: np.ndarray, count: int, periodic: bool) -> np.ndarray:
    if periodic:
        return index % count
    folded = index % (2 * count)
    return np.where(folded < count, folded, 2 * count - 1 - folded)
