"""How well a shape-preserving cubic interpolation meets each node when that node is left out.

The cubic is that of F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304, doi:10.1137/0905021, as
in `scipy.interpolate.PchipInterpolator`. A slope depends on the neighbours alone. So leaving out one node changes one
piece, and all of these pieces are found at once.
"""

from __future__ import annotations

import numpy as np


def left_out(x, y) -> np.ndarray:
    """Error |y - cubic without that node| at the inner nodes (n - 2,) of ``x`` (n,), ascending, and ``y`` (n,)."""
    if x.size < 3:
        return np.zeros(0)
    step, rate = np.diff(x), np.diff(y) / np.diff(x)
    wide, mean = x[2:] - x[:-2], (y[2:] - y[:-2]) / (x[2:] - x[:-2])
    left, right = mean.copy(), mean.copy()
    if x.size > 3:
        left[1:] = _slope(step[:-2], rate[:-2], wide[1:], mean[1:])
        right[:-1] = _slope(wide[:-1], mean[:-1], step[2:], rate[2:])
        left[0] = _end_slope(wide[0], mean[0], step[2], rate[2])
        right[-1] = _end_slope(wide[-1], mean[-1], step[-3], rate[-3])
    t = step[:-1] / wide
    found = y[:-2] + (y[2:] - y[:-2]) * t**2 * (3 - 2 * t) + wide * t * (1 - t) * (left * (1 - t) - right * t)
    return np.abs(found - y[1:-1])


def _slope(step, rate, next_step, next_rate) -> np.ndarray:
    """Slope between two pieces: the weighted harmonic mean of their ``rate``, zero where y turns."""
    weight, next_weight = 2 * next_step + step, next_step + 2 * step
    same = rate * next_rate > 0
    safe, next_safe = np.where(same, rate, 1.0), np.where(same, next_rate, 1.0)
    return np.where(same, (weight + next_weight) / (weight / safe + next_weight / next_safe), 0.0)


def _end_slope(step: float, rate: float, next_step: float, next_rate: float) -> float:
    """Slope at an end, where a piece has one neighbour: from three points, as far as the shape allows."""
    slope = ((2 * step + next_step) * rate - step * next_rate) / (step + next_step)
    if np.sign(slope) != np.sign(rate):
        return 0.0
    turns = np.sign(rate) != np.sign(next_rate)
    return 3 * rate if turns and abs(slope) > 3 * abs(rate) else slope
