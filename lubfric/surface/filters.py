"""The areal Gaussian filter of ISO 16610-61, as S-filter (keeps what is longer) and L-filter (keeps what is shorter).

The weights are exp(-pi (r/(a L))^2) with a = sqrt(ln 2/pi). So a wave as long as the nesting index L keeps half of its
height. The filter is isotropic, so it works on one axis after the other. At open ends and beside unmeasured points the
remaining weights are scaled to sum to one (regression of order zero). A periodic axis wraps around.
"""

from __future__ import annotations

import math

import numpy as np

from .._base import validate
from ..errors import InputError

ALPHA = math.sqrt(math.log(2) / math.pi)
LEAST_CELLS = 5  # of a nesting index: fewer do not resolve the weights
REACH = 6.0  # standard deviations of the weights that are summed


def checked_index(name: str, index: float, size: tuple[float, float], spacing: tuple[float, float]) -> float:
    """A nesting index [m], checked: the grid resolves it, and the map is longer."""
    return validate.number(name, index, "m", minimum=LEAST_CELLS * max(spacing), maximum=min(size))


def gaussian_mean(
    heights: np.ndarray,
    mask: np.ndarray | None,
    spacing: tuple[float, float],
    periodic: tuple[bool, bool],
    index: float,
) -> np.ndarray:
    """The waviness (nx, ny) [m]: the weighted mean around each point, of the measured points (True in ``mask``) only.

    ``index`` [m]: nesting index (cutoff). A point that has no measured one in reach keeps its height.
    """
    weight = np.ones(heights.shape) if mask is None else mask.astype(float)
    total = np.where(weight > 0, heights, 0.0)
    for axis in range(2):
        cells = index / spacing[axis]
        total, weight = (_along(a, axis, cells, periodic[axis]) for a in (total, weight))
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(weight > np.finfo(float).tiny, total / weight, heights)


def _along(values: np.ndarray, axis: int, cells: float, periodic: bool) -> np.ndarray:
    from scipy.ndimage import gaussian_filter1d

    deviation = ALPHA * cells / math.sqrt(2 * math.pi)
    return gaussian_filter1d(values, deviation, axis=axis, mode="wrap" if periodic else "constant", truncate=REACH)


def checked_indices(surface, s: float | None, l: float | None) -> tuple[float | None, float | None]:
    """Both nesting indices [m], checked: that of the S-filter is below that of the L-filter."""
    if s is not None:
        s = checked_index("s_filter", s, surface.size, surface.spacing)
    if l is not None:
        l = checked_index("l_filter", l, surface.size, surface.spacing)
    if s is not None and l is not None and s >= l:
        raise InputError(f"s_filter = {s:g} m and l_filter = {l:g} m leave no wave; give an s_filter below l_filter")
    return s, l
