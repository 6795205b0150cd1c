"""Where a sampled quantity bends."""

from __future__ import annotations

import math

import numpy as np

BEND = 0.01  # of the value, by which a straight line may miss it
LEAST = 1e-4  # of the largest value: what is smaller than it may be missed by as much as it may


def corners(times: np.ndarray, values: np.ndarray) -> list[float]:
    """Times [s] at which a line of straight pieces has to have a corner to follow ``values`` within 1 %.

    Every piece begins at a row. It is as long as one straight line from there stays within `BEND` of the values of all
    rows (the cone of such lines gets narrower with every row). A jump, which is a time given twice, begins a new piece.
    So a smooth wave has some twenty corners a period, however finely it is sampled, and a pulse keeps all of its own.
    """
    allowed = BEND * np.maximum(np.abs(values), LEAST * np.abs(values).max())
    t, v, miss = times.tolist(), values.tolist(), allowed.tolist()
    found, start, low, high = [], 0, -math.inf, math.inf
    for j in range(1, len(t)):
        if t[j] > t[j - 1] and not low <= (v[j] - v[start]) / (t[j] - t[start]) <= high:
            start, low, high = j - 1, -math.inf, math.inf
            found.append(t[start])
        if t[j] == t[j - 1]:
            start, low, high = j, -math.inf, math.inf
            continue
        run = t[j] - t[start]
        low = max(low, (v[j] - miss[j] - v[start]) / run)
        high = min(high, (v[j] + miss[j] - v[start]) / run)
    return found
