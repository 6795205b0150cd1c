"""The cells of a patch that a search may load, and pressures on them that carry a given load."""

from __future__ import annotations

import numpy as np

DENSE = 0.6  # share of the cells from which all are taken: their numbers take more memory than they save
ROUND = 8  # rows: windows of nearly the same width share their operator
NEWTON = 12  # steps before every other one halves the bracket


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
            count = min(ROUND * -(-int(touched[-1] - touched[0] + 1) // ROUND), whole[0])
            first = min(int(touched[0]), whole[0] - count)
            operator, rows = operator.window(count), slice(first, first + count)
        flags = flags[rows]
        many = np.count_nonzero(flags) > DENSE * flags.size
        return Cells(operator, None if many else np.flatnonzero(flags), rows, whole)

    def gather(self, field) -> np.ndarray:
        """Values of a field of the rows, one axis."""
        return field.ravel() if self.index is None else field.ravel().take(self.index)

    def field(self, values) -> np.ndarray:
        """Field of the rows in single precision with these values, zero elsewhere; valid until the next call."""
        if self.index is None:
            return values.reshape(self.shape)
        self._field.ravel()[self.index] = values
        return self._field

    def take(self, field, dtype=float, factor: float = 1.0) -> np.ndarray:
        """Copy of the values from a field of the whole patch, times ``factor``, in ``dtype``."""
        return (factor * self.gather(field[self.rows])).astype(dtype, copy=False)

    def spread(self, values) -> np.ndarray:
        """Field of the whole patch with these values, zero elsewhere."""
        field = np.zeros(self.whole)
        field[self.rows].ravel()[slice(None) if self.index is None else self.index] = values
        return field


def with_load(pressure, load: float, hardness: float) -> np.ndarray:
    """``clip(pressure + s, 0, hardness)`` with the shift s at which the sum is ``load``.

    This is the Euclidean projection, for 0 <= load <= hardness size. Newton's method works on the piecewise linear sum,
    inside a shrinking bracket, so it is exact once the right piece is found. What remains is the rounding error of a
    pressure far above the load. A last factor removes it; cells at the hardness stay there.
    """
    upper = min(hardness, load) - pressure.min()
    lower, shift = -pressure.max(), 0.0
    for attempt in range(200):
        result = np.clip(pressure + shift, 0.0, hardness)
        missing = load - result.sum()
        if abs(missing) <= 4e-16 * load:
            break
        lower, upper = (shift, upper) if missing > 0 else (lower, shift)
        movable = np.count_nonzero((result > 0) & (result < hardness))
        newton = shift + missing / movable if movable else np.nan
        if newton == shift:
            break
        halve = attempt > NEWTON and attempt % 2 or not lower <= newton <= upper
        shift = 0.5 * (lower + upper) if halve else newton
    if not result.any() and load > 0:  # a load below the rounding of the highest pressure: one cell bears it
        result[np.argmax(pressure)] = min(load, hardness)
    elastic = result < hardness
    carried = result[elastic].sum()
    if carried > 0:
        result[elastic] *= (load - (result.sum() - carried)) / carried
        np.clip(result, 0.0, hardness, out=result)
    return result


def rescaled(pressure, load: float, hardness: float) -> np.ndarray:
    """``pressure`` times a factor, yielded cells left as they are, and then `shifted` to carry ``load``."""
    loaded = np.flatnonzero(pressure > 0)
    values = pressure.ravel()[loaded]
    factor = np.where(values < hardness, load / values.sum(), 1.0)
    return _placed(pressure.shape, loaded, np.minimum(values * factor, hardness), load, hardness)


def shifted(pressure, load: float, hardness: float) -> np.ndarray:
    """``pressure`` with its elastic cells shifted by the same amount, within 0..hardness, so that it carries ``load``.
    If those cells cannot do it, all loaded cells are shifted, else all cells.

    This is a start for another load. Spots of contact grow and shrink at their edges, and their pressure changes as
    under a flat punch. That is nearer to an even change than to one in proportion.
    """
    loaded = np.flatnonzero(pressure > 0)
    return _placed(pressure.shape, loaded, pressure.ravel()[loaded], load, hardness)


def _placed(shape, loaded, values, load: float, hardness: float) -> np.ndarray:
    """The field of ``shape`` with these ``values``, `shifted`, on its cells ``loaded``."""
    field, elastic = np.zeros(shape), values < hardness
    for movable in (elastic, np.ones_like(elastic)):
        share = load - values[~movable].sum()
        if 0 < share <= hardness * np.count_nonzero(movable):
            values[movable] = with_load(values[movable], share, hardness)
            field.ravel()[loaded] = values
            return field
    if 0 < load <= hardness * field.size:
        field.ravel()[loaded] = values
        return with_load(field, load, hardness)
    return np.full(shape, load / field.size)
