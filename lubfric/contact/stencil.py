"""A stencil of nine points for |k|, the inverse of the half-space up to E'/4: exact enough for a search direction. It
is too stiff for long waves, which are corrected (`lubfric.contact.long_waves`).

It is the Fourier series of |k| over the waves that the grid resolves, cut after the nearest neighbours. Those nine
numbers are always a multiple of the identity less an outer product of three and three. So two passes of three points
are enough. They run over values that are scaled by the middle of that product.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from .fields import BLOCK
from .long_waves import LongWaves, worth

POINTS = 64  # along each axis of the quarter of the Brillouin zone that is averaged over
SPARSE = 0.15  # share of the cells below which their neighbours are gathered one by one


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
    grid (None: all). The values of the others are zero; periodic axes wrap around."""

    def __init__(self, shape, spacing, boundary, cells, factor: float):
        self.shape, self.boundary = shape, boundary
        self.padded = np.zeros((shape[0] + 2, shape[1] + 2), np.float32)
        own, along_x, along_y, across = nearest = nearest_coefficients(shape, spacing)
        middle = factor * along_x * along_y / across if across else 1.0  # of the outer product
        self.middle = np.float32(middle)
        self.coefficients = tuple(np.float32(factor * c / middle) for c in nearest)
        self.long_waves = LongWaves(shape, spacing, boundary, nearest, factor / middle) if worth(shape) else None
        self.take_on(cells)

    def on(self, cells) -> Stencil:
        """The same on other cells."""
        self.padded.fill(0)
        self.take_on(cells)
        return self

    def take_on(self, cells) -> None:
        shape = self.shape
        thin, size = 1 in shape, shape[0] * shape[1]
        cells = np.arange(size) if thin and cells is None else cells
        row: Any = None if cells is None else cells // shape[1]
        self.corner: Any = None if cells is None else cells + 2 * row  # flat index of the lower left point
        if self.long_waves is not None:
            self.long_waves.take_on(cells, row, shape[1])
        self.sparse = thin or cells is not None and cells.size < SPARSE * size

    def __call__(self, values: np.ndarray) -> np.ndarray:
        """The sums at the cells."""
        sums = np.empty_like(values)
        self.apply(values, sums)
        return sums

    def apply(self, values: np.ndarray, sums: np.ndarray) -> None:
        """Write the sums at the cells into ``sums``."""
        padded, width = self.padded, self.padded.shape[1]
        if self.corner is None:
            np.multiply(values.reshape(self.shape), self.middle, out=padded[1:-1, 1:-1])
        else:
            padded.ravel()[width + 1 :][self.corner] = values * self.middle
        if self.boundary[0] == "periodic":
            padded[0], padded[-1] = padded[-2], padded[1]
        if self.boundary[1] == "periodic":
            padded[:, 0], padded[:, -1] = padded[:, -2], padded[:, 1]
        if self.sparse:
            self._gathered(values, sums)
        else:
            self._swept(sums)
        if self.long_waves is not None:
            self.long_waves.take_off(padded[1:-1, 1:-1], sums)

    def _gathered(self, values, sums) -> None:
        flat, width = self.padded.ravel(), self.padded.shape[1]
        own, along_x, along_y, across = self.coefficients
        np.multiply(values, own * self.middle, out=sums)
        for coefficient, offsets in (
            (along_x, (1, 2 * width + 1)),
            (along_y, (width, width + 2)),
            (across, (0, 2, 2 * width, 2 * width + 2)),
        ):
            part = flat[offsets[0] :].take(self.corner)
            for offset in offsets[1:]:
                part += flat[offset:].take(self.corner)
            part *= coefficient
            sums += part

    def _swept(self, sums) -> None:
        """The sums for all cells, some rows at a time, within the cache."""
        flat, (nx, ny), width = self.padded.ravel(), self.shape, self.padded.shape[1]
        own, along_x, along_y, _ = self.coefficients
        rows = max(1, BLOCK // width)
        triples, nines = np.empty((rows + 2) * width, np.float32), np.empty(rows * width, np.float32)
        first = 0
        for begin in range(0, nx, rows):
            end = min(begin + rows, nx)
            points, size = flat[begin * width : (end + 2) * width], (end - begin) * width
            triple, nine = triples[: points.size - 2], nines[: size - 2]
            np.add(points[:-2], points[2:], out=triple)
            triple *= along_y
            triple += points[1:-1]
            np.add(triple[: -2 * width], triple[2 * width :], out=nine)
            nine *= along_x
            nine += triple[width:-width]
            alone = np.multiply(points[width + 1 : width + 1 + nine.size], own - 1, out=triple[: nine.size])
            if self.corner is None:
                left, right = (values[:size].reshape(-1, width)[:, :-2] for values in (nines, triples))
                np.add(left, right, out=sums.reshape(nx, ny)[begin:end])
            else:
                nine += alone
                last = first + int(np.searchsorted(self.corner[first:], end * width))
                nine.take(self.corner[first:last] - begin * width, out=sums[first:last], mode="clip")
                first = last
