"""A correction to the stencil of nine points, which is too stiff for waves much longer than a cell.

The stencil is the series of |k|, cut after the nearest neighbours. Unlike |k| it does not fall to zero with k. So spots
of many cells, as smooth surfaces have them, would converge more slowly than with |k| itself. The difference is smooth:
a transform of cells four times as long, a sixteenth of the cells, contains it.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .operator import filtered, wavenumber

FACTOR = 4  # cells, each way, that are one here
LEAST = 64  # cells along an axis: on shorter ones it costs more than it saves


def worth(shape) -> bool:
    """Whether a grid is long enough along both axes."""
    return min(shape) >= LEAST


class LongWaves:
    """The nine-point series less |k|, times ``factor``, on a grid whose series has these ``coefficients``. A free axis
    is padded to twice its length."""

    def __init__(self, shape, spacing, boundary, coefficients, factor: float):
        self.shape = tuple(-(-n // FACTOR) for n in shape)
        self.padded = tuple(n if kind == "periodic" else 2 * n for n, kind in zip(self.shape, boundary))
        coarse = tuple(FACTOR * d for d in spacing)
        own, along_x, along_y, across = coefficients
        x, y = (np.cos(2 * np.pi * np.fft.rfftfreq(n, FACTOR)) for n in self.padded)
        series = own + 2 * along_x * x[:, None] + 2 * along_y * y + 4 * across * x[:, None] * y
        missed = np.maximum(series - wavenumber(self.padded, coarse), 0.0)
        self.symbol = (factor / FACTOR**2 * missed).astype(np.float32)
        self.owner: Any = None

    def take_on(self, cells, row, count: int) -> None:
        """Prepare for the ``cells`` (flat; None: all), which are in these ``row`` of ``count`` cells."""
        self.owner = None if cells is None else row // FACTOR * self.shape[1] + (cells - row * count) // FACTOR

    def take_off(self, field, sums) -> None:
        """Subtract the long-wave part of ``field`` (nx, ny) from ``sums`` at the cells."""
        found = filtered(_summed(field), self.symbol, self.padded, None)
        if self.owner is not None:
            sums -= found.ravel().take(self.owner)
            return
        wide, whole = found.repeat(FACTOR, axis=1)[:, : field.shape[1]], sums.reshape(field.shape)
        rows = len(whole) // FACTOR
        together = whole[: FACTOR * rows].reshape(rows, FACTOR, -1)  # the rows of a coarse one
        together -= wide[:rows, None]
        whole[FACTOR * rows :] -= wide[rows:]


def _summed(field) -> np.ndarray:
    """Sums over FACTOR x FACTOR cells; the last ones of an axis may have fewer."""
    for axis in (0, 1):
        field = np.moveaxis(field, axis, 0)
        total = field[::FACTOR].copy()
        for k in range(1, FACTOR):
            part = field[k::FACTOR]
            total[: part.shape[0]] += part
        field = np.moveaxis(total, 0, axis)
    return np.ascontiguousarray(field)
