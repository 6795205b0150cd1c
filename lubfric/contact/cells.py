"""The cells of a patch that a search may load, taken from its fields and put back."""

from __future__ import annotations

import numpy as np

from .strip_kernel import rounded

DENSE = 0.6  # share of the cells from which all are taken: their numbers take more memory than they save


class Cells:
    """Cells ``index`` (flat; None: all) of the ``rows`` of a patch (``whole``: its shape).

    ``operator``: their deflection under pressure on them, in single precision.
    """

    def __init__(self, operator, index, rows: slice, whole: tuple[int, int]):
        self.operator, self.index, self.rows, self.whole, self.shape = operator, index, rows, whole, operator.shape
        self._field = np.zeros(self.shape if index is not None else (0, 0), np.float32)

    @staticmethod
    def flagged(operator, flags) -> Cells:
        """Cells whose ``flags`` are set, or all if that is most of them. With a free axis x beside a periodic y, only
        the rows that contain some."""
        whole, rows = flags.shape, slice(None)
        if operator.boundary == ("free", "periodic"):
            touched = np.flatnonzero(flags.any(axis=1))
            count = rounded(int(touched[-1] - touched[0]) + 1, whole[0])
            first = min(int(touched[0]), whole[0] - count)
            operator, rows = operator.window(count), slice(first, first + count)
        flags = flags[rows]
        many = np.count_nonzero(flags) > DENSE * flags.size
        return Cells(operator, None if many else np.flatnonzero(flags), rows, whole)

    def narrowed(self, kept) -> Cells:
        """Those of these cells whose positions are ``kept``."""
        index = kept if self.index is None else self.index.take(kept)
        return Cells(self.operator, index, self.rows, self.whole)

    def gather(self, field) -> np.ndarray:
        """Values of a field of the rows, one axis."""
        flat = field.ravel()
        return flat if self.index is None else flat.take(self.index)

    def field(self, values) -> np.ndarray:
        """Field of the rows in single precision with these values, zero elsewhere; valid until the next call."""
        if self.index is None:
            return values.reshape(self.shape)
        self._field.ravel()[self.index] = values
        return self._field

    def take(self, field, dtype=float, factor: float = 1.0) -> np.ndarray:
        """Copy of the values from a field of the whole patch, times ``factor``, in ``dtype``."""
        flat = field[self.rows].ravel()
        values = flat.copy() if self.index is None else flat.take(self.index)
        if factor != 1.0:
            values *= factor
        return values.astype(dtype, copy=False)

    def spread(self, values) -> np.ndarray:
        """Field of the whole patch with these values, zero elsewhere."""
        if values.size == self.whole[0] * self.whole[1]:
            return values.reshape(self.whole)
        field = np.zeros(self.whole)
        if self.index is None:
            field[self.rows] = values.reshape(self.shape)
        else:
            field[self.rows].ravel()[self.index] = values
        return field
