"""Nine points that stand for |k|: the inverse of the half-space, up to E'/4, near enough for a search direction.

The Fourier series of |k| over the waves that the grid resolves, cut after the nearest neighbours. As those nine numbers
are always a multiple of the identity less an outer product of three and three, two passes of three points do.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

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
    """Applies the nine points, times ``factor``, to single-precision values on some ``cells`` of a grid (None: all),
    zero on the others; periodic axes close."""

    def __init__(self, shape, spacing, boundary, cells, factor: float):
        self.shape, self.boundary = shape, boundary
        self.padded = np.zeros((shape[0] + 2, shape[1] + 2), np.float32)
        self.coefficients = tuple(np.float32(factor * c) for c in nearest_coefficients(shape, spacing))
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
        # flat index of the lower left point
        self.corner: Any = None if cells is None else cells + 2 * (cells // shape[1])
        self.sparse = thin or cells is not None and cells.size < SPARSE * size

    def __call__(self, values: np.ndarray) -> np.ndarray:
        """The nine-point sums at the cells."""
        padded, width = self.padded, self.padded.shape[1]
        if self.corner is None:
            padded[1:-1, 1:-1] = values.reshape(self.shape)
        else:
            padded.ravel()[width + 1 :][self.corner] = values
        if self.boundary[0] == "periodic":
            padded[0], padded[-1] = padded[-2], padded[1]
        if self.boundary[1] == "periodic":
            padded[:, 0], padded[:, -1] = padded[:, -2], padded[:, 1]
        return self._gathered(values) if self.sparse else self._swept(values)

    def _gathered(self, values) -> np.ndarray:
        flat, width = self.padded.ravel(), self.padded.shape[1]
        own, along_x, along_y, across = self.coefficients
        total = own * values
        for coefficient, offsets in (
            (along_x, (1, 2 * width + 1)),
            (along_y, (width, width + 2)),
            (across, (0, 2, 2 * width, 2 * width + 2)),
        ):
            part = flat[offsets[0] :].take(self.corner)
            for offset in offsets[1:]:
                part += flat[offset:].take(self.corner)
            part *= coefficient
            total += part
        return total

    def _swept(self, values) -> np.ndarray:
        flat, width = self.padded.ravel(), self.padded.shape[1]
        own, along_x, along_y, across = self.coefficients
        rows = flat[:-2] + flat[2:]
        rows *= across / along_x
        rows += flat[1:-1]
        total = rows[: -2 * width] + rows[2 * width :]
        total *= across / along_y
        total += rows[width:-width]
        if self.corner is None:
            total = np.append(total, np.zeros(2, np.float32)).reshape(self.shape[0], width)[:, :-2].ravel()
        else:
            total = total.take(self.corner)
        outer = along_x * along_y / across
        total *= outer
        total += (own - outer) * values
        return total
