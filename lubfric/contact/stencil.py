"""A stencil of nine points for |k|, the inverse of the half-space up to E'/4: exact enough for a search direction.

It is the Fourier series of |k| over the waves that the grid resolves, cut after the nearest neighbours.

The series is too stiff for waves much longer than a cell: unlike |k| it does not fall to zero with k. So spots of many
cells, as smooth surfaces have them, would converge more slowly than with |k| itself. The difference is smooth: a
transform of cells four times as long, a sixteenth of the cells, contains it, and takes it off.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from .transforms import filtered, wavenumber

POINTS = 64  # along each axis of the quarter of the Brillouin zone that is averaged over
BLOCK = 16384  # cells that stay in the cache from one pass to the next
FACTOR = 4  # cells, each way, that are one for long waves
LEAST = 64  # cells along an axis: on shorter ones long waves cost more than they save


@lru_cache(maxsize=16)
def nearest_coefficients(shape, spacing) -> tuple[float, float, float, float]:
    """Mean of |k| [1/m] times 1, cos(kx dx), cos(ky dy) and the product of the two; an axis of one cell has no
    waves."""
    turns = [(np.arange(POINTS) + 0.5) * (np.pi / POINTS) if n > 1 else np.zeros(1) for n in shape]
    x, y = turns[0][:, None], turns[1]
    k = np.hypot(x / spacing[0], y / spacing[1])
    along_x, along_y = np.cos(x) * (shape[0] > 1), np.cos(y) * (shape[1] > 1)
    own, x_part, y_part, both = (float((k * wave).mean()) for wave in (1.0, along_x, along_y, along_x * along_y))
    return own, x_part, y_part, both


class Stencil:
    """Applies the nine points, less long waves, times ``factor``, to single-precision values on some ``cells`` of a
    grid (flat numbers; None: all). The values of the others are zero; periodic axes wrap around."""

    def __init__(self, shape, spacing, boundary, cells, factor: float):
        self.shape, self.boundary = shape, boundary
        self.padded = np.zeros((shape[0] + 2, shape[1] + 2), np.float32)
        nearest = nearest_coefficients(shape, spacing)
        self.coefficients = tuple(np.float32(factor * c) for c in nearest)
        self.long_waves = None  # the series less |k|, on cells FACTOR times as long
        if min(shape) >= LEAST:
            self.coarse = tuple(
                (2 if kind == "free" else 1) * -(-n // FACTOR) for n, kind in zip(shape, boundary)
            )  # free axes are padded to twice their length
            missed = _series(nearest, self.coarse) - wavenumber(self.coarse, tuple(FACTOR * d for d in spacing))
            self.long_waves = (factor / FACTOR**2 * np.maximum(missed, 0.0)).astype(np.float32)
        self.cells = cells
        if cells is not None:
            row, column = np.divmod(cells, shape[1])
            self.points = (row + 1) * (shape[1] + 2) + column + 1  # their flat numbers in ``padded``
            self.owner = row // FACTOR * -(-shape[1] // FACTOR) + column // FACTOR  # of the cell for long waves

    def apply(self, values: np.ndarray, sums: np.ndarray) -> None:
        """Write the sums at the cells into ``sums``."""
        padded, cells = self.padded, self.cells
        inner = padded[1:-1, 1:-1]
        if cells is None:
            inner[:] = values.reshape(self.shape)
        else:
            padded.ravel()[self.points] = values
        if self.boundary[0] == "periodic":
            padded[0], padded[-1] = padded[-2], padded[1]
        if self.boundary[1] == "periodic":
            padded[:, 0], padded[:, -1] = padded[:, -2], padded[:, 1]
        if cells is None:
            self._sweep(sums.reshape(self.shape))
        else:
            self._sweep(whole := np.empty(self.shape, np.float32))
            whole.ravel().take(cells, out=sums, mode="clip")
        if self.long_waves is not None:
            found = filtered(_summed(inner), self.long_waves, self.coarse, None)
            if cells is None:
                whole = found.repeat(FACTOR, axis=1)[:, : inner.shape[1]].repeat(FACTOR, axis=0)[: inner.shape[0]]
                sums -= whole.ravel()
            else:
                sums -= found.ravel().take(self.owner)

    def _sweep(self, sums) -> None:
        """The sums for all cells, some rows at a time, within the cache."""
        own, along_x, along_y, across = self.coefficients
        rows = max(1, BLOCK // self.padded.shape[1])
        for begin in range(0, self.shape[0], rows):
            points, total = self.padded[begin : begin + rows + 2], sums[begin : begin + rows]
            beside = points[:, :-2] + points[:, 2:]
            np.multiply(points[1:-1, 1:-1], own, out=total)
            total += along_y * beside[1:-1]
            beside *= across
            beside += along_x * points[:, 1:-1]
            total += beside[:-2]
            total += beside[2:]


def _series(nearest, shape) -> np.ndarray:
    """The cut series at the waves of a grid of ``shape`` cells, each FACTOR cells long."""
    own, along_x, along_y, across = nearest
    x, y = (np.cos(2 * np.pi * np.fft.rfftfreq(n, FACTOR)) for n in shape)
    return own + 2 * along_x * x[:, None] + 2 * along_y * y + 4 * across * x[:, None] * y


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
