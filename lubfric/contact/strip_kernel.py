"""Deflection under a loaded strip of the free axis, with every wave along the periodic axis computed only as far as it
reaches.

A wave k along y decays like exp(-k x). So for all but the longest waves, a padded length far below twice the patch is
enough for no image to reach the patch. Waves of similar reach are transformed together.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import fft

NEGLIGIBLE = {np.dtype(np.float32): 1e-8, np.dtype(np.float64): 1e-16}  # of the coefficient under the cell itself
WORTH = 2e4  # values that a transform of their own is worth
ROUND = 8  # rows: strips of nearly the same width share their transforms


@dataclass(frozen=True)
class Group:
    """Waves ``columns`` of the spectrum, which reach at most ``reach`` rows, transformed over ``length`` rows."""

    columns: slice
    reach: int
    length: int
    symbol: np.ndarray


@dataclass(frozen=True)
class Strip:
    """The deflection of ``rows`` of a patch under pressure on ``shape`` = (some neighbouring rows, all columns)."""

    shape: tuple[int, int]
    rows: int
    groups: tuple[Group, ...]
    workers: int | None = None

    def apply(self, pressure: np.ndarray, first: int = 0) -> np.ndarray:
        """Deflection [m] (rows, ny) under ``pressure`` [Pa] on the rows from ``first`` on."""
        count, ny = self.shape
        spectrum = fft.rfft(pressure, axis=1, workers=self.workers)
        total = np.zeros((self.rows, spectrum.shape[1]), spectrum.dtype)
        for group in self.groups:
            part = fft.fft(spectrum[:, group.columns], n=group.length, axis=0, workers=self.workers)
            half = group.length // 2 + 1
            part[:half] *= group.symbol
            part[half:] *= group.symbol[(group.length - 1) // 2 : 0 : -1]
            part = fft.ifft(part, axis=0, workers=self.workers, overwrite_x=True)
            before = min(first, group.reach)
            after = min(self.rows, first + count + group.reach) - first
            total[first : first + after, group.columns] = part[:after]
            if before:
                total[first - before : first, group.columns] = part[-before:]
        return fft.irfft(total, n=ny, axis=1, workers=self.workers, overwrite_x=True)


def strip(kernel, ny: int, count: int, rows: int, farthest: int, dtype, workers=None) -> Strip:
    """`Strip` of ``count`` rows that deflect ``rows``, at most ``farthest`` rows apart.

    ``kernel`` [m/Pa]: lags along the free axis, waves along the periodic one.
    """
    reaches, groups, begin = _reaches(kernel, NEGLIGIBLE[np.dtype(dtype)], farthest), [], 0
    beyond = 0 if rows == count else 1
    while begin < reaches.size:
        reach = int(reaches[begin])
        short = np.flatnonzero(reaches[begin:] <= reach // 2)
        few = not short.size or short[0] * count < WORTH or (reaches.size - begin - short[0]) * count < WORTH
        end = reaches.size if few else begin + int(short[0])
        length = fft.next_fast_len(min(count + (1 + beyond) * reach, 2 * farthest + 1))
        even = np.zeros((length, end - begin))
        lags = min(reach, farthest, (length - 1) // 2)
        even[: lags + 1] = kernel[: lags + 1, begin:end]
        even[length - lags :] = kernel[lags:0:-1, begin:end]
        symbol = np.ascontiguousarray(fft.rfft(even, axis=0).real).astype(dtype)
        groups.append(Group(slice(begin, end), reach, length, symbol))
        begin = end
    return Strip((count, ny), rows, tuple(groups), workers)


def _reaches(kernel, negligible: float, farthest: int) -> np.ndarray:
    """Number of rows beyond which a wave and all shorter ones do not deflect; it never rises from wave to wave."""
    felt = np.abs(kernel[: farthest + 1]) > negligible * np.abs(kernel[0])
    last = felt.shape[0] - 1 - np.argmax(felt[::-1], axis=0)
    return np.maximum.accumulate(last[::-1])[::-1]


def rounded(count: int, most: int) -> int:
    """``count`` rows rounded up."""
    return min(ROUND * -(-count // ROUND), most)
