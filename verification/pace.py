"""Processor time on a core of a stated speed, so that a limit in seconds means the same on any machine, busy or not.

A core is as fast as it transforms a field of 816 x 816 numbers of single precision and back: in `PAIR` seconds on the
core that the limits are stated for.
"""

import time
from collections.abc import Callable

import numpy as np
from scipy import fft

from .types import T

PAIR = 8e-3  # s
CELLS = 816  # in a side of the field that is transformed
REPEATS = 15  # of the transform, of which the median counts


def paced(work: Callable[[], T], clock: Callable[[], float] = time.process_time) -> tuple[T, float]:
    """Return what ``work()`` returns, and its processor seconds on the stated core. The core is timed before and after
    it; ``clock`` returns the processor seconds until now, of this process where nothing else is given."""
    before = _pair()
    begun = clock()
    result = work()
    seconds = clock() - begun
    return result, seconds * PAIR / (0.5 * (before + _pair()))


def _pair() -> float:
    """Return the median processor seconds of a transform and back."""
    field = np.random.default_rng(0).random((CELLS, CELLS), dtype=np.float32)
    times = []
    for _ in range(REPEATS):
        begun = time.process_time()
        fft.irfft2(fft.rfft2(field), s=field.shape)
        times.append(time.process_time() - begun)
    return float(np.median(times))
