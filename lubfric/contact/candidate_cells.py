"""The cells of a patch that a search may load, and a stencil on them for its directions.

The stencil has nine points for |k|, the inverse of the half-space up to E'/4: exact enough for a search direction.

It is the Fourier series of |k| over the waves that the grid resolves, cut after the nearest neighbours.

The series is too stiff for waves much longer than a cell: unlike |k| it does not fall to zero with k. So asperity
contacts of many cells, as smooth surfaces have them, would converge more slowly than with |k| itself. The difference
is smooth: a transform of cells four times as long, a sixteenth of the cells, contains it, and takes it off.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from .._base import BoolArray, FloatArray, IntArray
from .operator import HalfSpace, filtered, wavenumber

# Share of the cells [-] from which all are taken: their numbers take more memory than they save. Halved and doubled by
# `python -m verification.campaigns.benchmarks.contact_constants`.
DENSE = 0.6
# Rows: windows of nearly the same width share their operator. A choice: a larger value costs cells, a smaller one costs
# operators.
ROUND = 8
# Points along each axis of the quarter of the Brillouin zone over which |k| is averaged. A choice, made once for an
# operator. Half and twice this value change f by less than .01 % and the work by less than 1 % (constants.csv).
BRILLOUIN_POINTS = 64
# Cells that stay in the cache from one pass to the next. Halved and doubled by `python -m
# verification.campaigns.benchmarks.contact_constants`.
CACHED_CELLS = 16384
# Cells, each way, that are one for long waves. Halved and doubled by `python -m
# verification.campaigns.benchmarks.contact_constants`.
FACTOR = 4
# Cells along an axis below which long waves cost more than they save. Halved and doubled by `python -m
# verification.campaigns.benchmarks.contact_constants`.
LEAST_AVERAGED_CELLS = 64


class CandidateCells:
    """Cells ``index`` (flat; None: all) of the ``rows`` of a patch (``whole``: its shape).

    ``deflection``: of the rows under pressure on them, both (n, ny) in single precision.
    """

    def __init__(self, deflection: Callable[..., Any], index: IntArray | None, rows: slice, whole: tuple[int, int]):
        self.deflection = deflection
        self.index = index
        self.rows = rows
        self.whole = whole
        self.shape = len(range(*rows.indices(whole[0]))), whole[1]
        self._field = np.zeros(self.shape if index is not None else (0, 0), np.float32)

    @staticmethod
    def flagged(operator: HalfSpace, flags: BoolArray) -> CandidateCells:
        """Return the cells whose ``flags`` are set, or all if that is most of them. With a free axis x and a periodic
        y, only the rows that contain some."""
        shape = flags.shape
        rows = slice(None)
        deflection = operator.apply
        if operator.boundary == ("free", "periodic"):
            touched = np.flatnonzero(flags.any(axis=1))
            count = min(ROUND * -(-int(touched[-1] - touched[0] + 1) // ROUND), shape[0])
            first = min(int(touched[0]), shape[0] - count)
            deflection = operator.window(count)
            rows = slice(first, first + count)
        flags = flags[rows]
        many = np.count_nonzero(flags) > DENSE * flags.size
        return CandidateCells(deflection, None if many else np.flatnonzero(flags), rows, shape)

    def gather(self, field: FloatArray) -> np.ndarray:
        """Return the values of a field of the rows, one axis."""
        return field.ravel() if self.index is None else field.ravel().take(self.index)

    def field(self, values: FloatArray) -> np.ndarray:
        """Return the field of the rows in single precision with these values, zero elsewhere; valid until the next
        call."""
        if self.index is None:
            return values.reshape(self.shape)
        self._field.ravel()[self.index] = values
        return self._field

    def take(self, field: FloatArray, dtype: type = float, factor: float = 1.0) -> np.ndarray:
        """Return a copy of the values from a field of the complete patch, times ``factor``, in ``dtype``."""
        return (factor * self.gather(field[self.rows])).astype(dtype, copy=False)

    def spread(self, values: FloatArray) -> np.ndarray:
        """Return the field of the complete patch with these values, zero elsewhere."""
        field = np.zeros(self.whole)
        field[self.rows].ravel()[slice(None) if self.index is None else self.index] = values
        return field


@lru_cache(maxsize=16)
def nearest_coefficients(shape: tuple[int, int], spacing: tuple[float, float]) -> tuple[float, float, float, float]:
    """Return the mean of |k| [1/m] times 1, cos(kx dx), cos(ky dy) and the product of the two; an axis of one cell has
    no waves."""
    turns = [(np.arange(BRILLOUIN_POINTS) + 0.5) * (np.pi / BRILLOUIN_POINTS) if n > 1 else np.zeros(1) for n in shape]
    x = turns[0][:, None]
    y = turns[1]
    k = np.hypot(x / spacing[0], y / spacing[1])
    along_x = np.cos(x) if shape[0] > 1 else np.zeros_like(x)
    along_y = np.cos(y) if shape[1] > 1 else np.zeros_like(y)
    same_cell, x_part, y_part, both = (float((k * wave).mean()) for wave in (1.0, along_x, along_y, along_x * along_y))
    return same_cell, x_part, y_part, both


def stencil(
    cells: CandidateCells, spacing: tuple[float, float], boundary: tuple[str, str], factor: float
) -> Callable[[np.ndarray], np.ndarray]:
    """Return the function that gives, from single-precision values on the ``cells``, the sums there of the nine points,
    less long waves, times ``factor``. The values of the other cells are zero; periodic axes wrap around."""
    shape = cells.shape
    padded = np.zeros((shape[0] + 2, shape[1] + 2), np.float32)
    inner = padded[1:-1, 1:-1]
    nearest = nearest_coefficients(shape, spacing)
    coefficients = tuple(np.float32(factor * c) for c in nearest)
    long_waves = min(shape) >= LEAST_AVERAGED_CELLS
    if long_waves:  # the series less |k|, on cells FACTOR times as long; free axes are padded to twice their length
        coarse = tuple((2 if kind == "free" else 1) * -(-n // FACTOR) for n, kind in zip(shape, boundary))
        excess = _series(nearest, coarse) - wavenumber(coarse, tuple(FACTOR * d for d in spacing))
        excess = (factor / FACTOR**2 * np.maximum(excess, 0.0)).astype(np.float32)
        row, column = (np.arange(n, dtype=np.int32) // FACTOR for n in shape)
        owner = cells.gather(row[:, None] * (column[-1] + 1) + column)  # of each cell: the one for long waves

    def sums(values: np.ndarray) -> np.ndarray:
        inner[:] = cells.field(values)
        if boundary[0] == "periodic":
            padded[0] = padded[-2]
            padded[-1] = padded[1]
        if boundary[1] == "periodic":
            padded[:, 0] = padded[:, -2]
            padded[:, -1] = padded[:, 1]
        nearest_sums = cells.gather(_swept(padded, coefficients))
        return (
            nearest_sums - filtered(_summed(inner), excess, coarse, None).ravel().take(owner)
            if long_waves
            else nearest_sums
        )

    return sums


def _swept(padded: FloatArray, coefficients: Sequence[np.float32]) -> np.ndarray:
    """Return the sums for all cells, some rows at a time, within the cache."""
    same_cell, along_x, along_y, across = coefficients
    sums = np.empty((padded.shape[0] - 2, padded.shape[1] - 2), np.float32)
    rows = max(1, CACHED_CELLS // padded.shape[1])
    for begin in range(0, sums.shape[0], rows):
        points = padded[begin : begin + rows + 2]
        total = sums[begin : begin + rows]
        beside = points[:, :-2] + points[:, 2:]
        np.multiply(points[1:-1, 1:-1], same_cell, out=total)
        total += along_y * beside[1:-1]
        beside *= across
        beside += along_x * points[:, 1:-1]
        total += beside[:-2]
        total += beside[2:]
    return sums


def _series(nearest: tuple[float, float, float, float], shape: tuple[int, ...]) -> np.ndarray:
    """Return the cut series at the waves of a grid of ``shape`` cells, each FACTOR cells long."""
    same_cell, along_x, along_y, across = nearest
    x, y = (np.cos(2 * np.pi * np.fft.rfftfreq(n, FACTOR)) for n in shape)
    return same_cell + 2 * along_x * x[:, None] + 2 * along_y * y + 4 * across * x[:, None] * y


def _summed(field: FloatArray) -> np.ndarray:
    """Return the sums over FACTOR x FACTOR cells; the last ones of an axis may have fewer."""
    for axis in (0, 1):
        field = np.moveaxis(field, axis, 0)
        total = field[::FACTOR].copy()
        for k in range(1, FACTOR):
            part = field[k::FACTOR]
            total[: part.shape[0]] += part
        field = np.moveaxis(total, 0, axis)
    return np.ascontiguousarray(field)
