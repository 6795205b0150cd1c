"""The cells of a patch that a search may load, gathered from its fields and scattered back."""

from __future__ import annotations

import numpy as np

DENSE = 0.8  # share of the cells from which all are taken: gathering costs more than it saves


class Cells:
    """``index``: flat, within the part of the patch with ``shape`` that ``operator`` (single precision) is for; None: all
    its cells."""

    def __init__(self, operator, index):
        self.operator, self.shape, self.index = operator, operator.shape, index
        self._field = None if index is None else np.zeros(self.shape, np.float32)

    @staticmethod
    def flagged(operator, flags) -> Cells:
        """Cells whose ``flags`` are set, or all where that is most of them."""
        many = np.count_nonzero(flags) > DENSE * flags.size
        return Cells(operator, None if many else np.flatnonzero(flags))

    def narrowed(self, kept) -> Cells:
        """Only those of these cells with positions ``kept``."""
        return Cells(self.operator, kept if self.index is None else self.index.take(kept))

    def gather(self, field) -> np.ndarray:
        """Values of a field of the part, one axis."""
        flat = field.ravel()
        return flat if self.index is None else flat.take(self.index)

    def field(self, values) -> np.ndarray:
        """Field of the part in single precision with these values, zero elsewhere; valid until the next call."""
        if self.index is None:
            return values.reshape(self.shape)
        self._field.ravel()[self.index] = values
        return self._field

    def take(self, field, dtype=float, factor: float = 1.0) -> np.ndarray:
        """Copy of the values of a field of the whole patch, times ``factor``, in ``dtype``."""
        flat = field.ravel()
        values = flat.copy() if self.index is None else flat.take(self.index)
        values *= factor
        return values.astype(dtype, copy=False)

    def spread(self, values) -> np.ndarray:
        """Field of the whole patch with these values, zero elsewhere."""
        if self.index is None:
            return values.reshape(self.shape)
        field = np.zeros(self.shape)
        field.ravel()[self.index] = values
        return field
