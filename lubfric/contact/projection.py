"""Nearest admissible pressure with a given load."""

from __future__ import annotations

import numpy as np


def with_load(pressure, load: float, hardness: float) -> np.ndarray:
    """``clip(pressure + s, 0, hardness)`` with the shift s at which the sum is ``load`` (0 <= load <= hardness size).

    Newton's method on the piecewise linear sum; where nothing can move, s jumps to the next cell that can.
    """
    shift = 0.0
    for _ in range(200):
        result = np.clip(pressure + shift, 0.0, hardness)
        missing = load - result.sum()
        movable = np.count_nonzero((result > 0) & (result < hardness))
        if abs(missing) <= 1e-15 * load:
            break
        if movable:
            shift += missing / movable
        elif missing > 0 and (result < hardness).any():
            shift = -pressure[result < hardness].max() + missing / result.size
        elif missing < 0 and (result > 0).any():
            shift = hardness - pressure[result > 0].min() + missing / result.size
        else:
            break
    return result
