"""The grid of a half-space contact under a cylinder: coarser cells, fewer columns, and the pressure of another grid."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Self

import numpy as np

from .._base import FieldsOnly
from .hertz_strip import strip_weight
from .operator import HalfSpace
from .problem import COARSEST
from .rough_contract import ContactState, Grid, RoughContact

MARGIN = 0.1  # of the length in contact, kept free on each side
MARGIN_CELLS = 4
LEAST_CUT = 0.9  # of the columns: a part that keeps more is not worth it
TOUCH = 1e-3  # of Sq: an overlap that is none
SUMMITS = 32  # the highest, of which is told what averages take from them


@dataclass(frozen=True)
class HalfSpaceGrid(FieldsOnly, RoughContact):
    """A rough surface under a cylinder on its grid: free along x, periodic along y.

    heights [m] (nx, ny) around their mean; x [m] (nx,) cell centres around the line of contact; weight (nx,): part of
    each column inside the area A of Eq. (8), |x| <= half_width [m] (None: all). lost [m]: by how much its highest
    summits are lower than on the grid that it was coarsened from.
    """

    heights: np.ndarray
    spacing: tuple[float, float]
    x: np.ndarray
    weight: np.ndarray
    half_width: float | None
    operator: HalfSpace
    lost: float = field(default=0.0, kw_only=True)

    @property
    def grid(self) -> Grid:
        return Grid(self.heights.shape, self.spacing)

    @cached_property
    def sq(self) -> float:
        return float(self.heights.std())

    @cached_property
    def profiles(self) -> tuple[np.ndarray, np.ndarray]:
        """Mean and highest of the heights [m] at every x, (nx,) each."""
        return self.heights.mean(axis=1), self.heights.max(axis=1)

    def coarsened(self) -> Self | None:
        """On cells twice as long and wide, with averaged heights. An axis with too few cells, or an odd number, is
        kept, and the area A stays wider than a cell. None if neither axis can be halved. Made once."""
        return self._coarser

    @cached_property
    def _coarser(self) -> Self | None:
        operator, half_width = self.operator, self.half_width
        wide = half_width is not None and 2 * self.spacing[0] > half_width
        factors = tuple(
            2 if kept % 2 == 0 and padded % 4 == 0 and kept >= 2 * COARSEST and not fixed else 1
            for kept, padded, fixed in zip(operator.shape, operator.padded, (wide, False))
        )
        if factors == (1, 1):
            return None
        (nx, ny), (fx, fy) = operator.shape, factors
        blocks = self.heights.reshape(nx // fx, fx, ny // fy, fy)
        heights = blocks.mean(axis=(1, 3))
        lost = self.lost + _lost(heights, blocks.max(axis=(1, 3)))
        x = self.x.reshape(-1, fx).mean(axis=1)
        coarse = operator.coarsened(factors)
        weight = np.ones(x.size) if half_width is None else strip_weight(x, coarse.spacing[0], half_width)
        return replace(self, heights=heights, spacing=coarse.spacing, x=x, operator=coarse, weight=weight, lost=lost)

    def thinned(self, every: int) -> Self | None:
        """Every ``every``-th cell; None if their number or the area A does not allow it."""
        operator, half_width = self.operator, self.half_width
        wide = half_width is not None and every * self.spacing[0] > half_width
        if wide or any(kept % every or padded % (2 * every) for kept, padded in zip(operator.shape, operator.padded)):
            return None
        coarse, x = operator.coarsened((every, every)), self.x[::every]
        weight = np.ones(x.size) if half_width is None else strip_weight(x, coarse.spacing[0], half_width)
        heights = self.heights[::every, ::every]
        return replace(self, heights=heights, spacing=coarse.spacing, x=x, operator=coarse, weight=weight)

    def cut(self, state: ContactState, found_on: RoughContact) -> Self:
        """The columns where contact is possible: those that touch, those of the area A, and a margin. All columns if
        the mean over the whole patch counts."""
        if self.half_width is None or state.pressure is None:
            return self
        used = np.flatnonzero(state.pressure.any(axis=1) | (found_on.weight > 0))
        low, high = found_on.x[used[0]], found_on.x[used[-1]]
        margin = MARGIN * (high - low) + MARGIN_CELLS * _step(found_on)
        return self.between(float(low - margin), float(high + margin))

    def between(self, low: float, high: float) -> Self:
        """The columns from ``low`` to ``high`` [m], a multiple of four; the whole grid if nearly all are needed."""
        first, last = np.searchsorted(self.x, (low, high))
        count = min(4 * -(-max(int(last - first), COARSEST) // 4), self.x.size)
        if count > LEAST_CUT * self.x.size:
            return self
        first = int(min(max(0, first), self.x.size - count))
        keep = slice(first, first + count)
        return replace(
            self,
            heights=self.heights[keep],
            x=self.x[keep],
            weight=self.weight[keep],
            operator=self.operator.shortened(count),
        )

    def holds(self, part: RoughContact, shape: np.ndarray, state: ContactState) -> bool:
        """Whether no cell outside the part touches, by one convolution of the contact found on it."""
        if state.fields is None or part is self:
            return True
        first = int(np.searchsorted(self.x, part.x[0] - 0.5 * _step(part)))
        pressure = np.zeros(self.heights.shape)
        pressure[first : first + part.x.size] = state.fields.pressure
        gap = self.operator.apply(pressure) + shape[:, None] - self.heights - state.fields.approach
        gap[first : first + part.x.size] = 0.0
        return bool(gap.min() >= -TOUCH * self.sq)

    def pressure_of(self, state: ContactState | None) -> np.ndarray | None:
        """The pressure of ``state``, if any, on these cells, taken from the nearest of its own."""
        if state is None or state.pressure is None:
            return None
        pressure, shape = state.pressure, self.heights.shape
        if pressure.shape == shape and np.array_equal(state.x, self.x):
            return pressure
        step = state.x[1] - state.x[0]
        row = np.rint((self.x - state.x[0]) / step).astype(int)
        column = np.arange(shape[1]) * pressure.shape[1] // shape[1]
        inside = (row >= 0) & (row < state.x.size)
        moved = np.where(inside[:, None], pressure[np.clip(row, 0, state.x.size - 1)][:, column], 0.0)
        return moved if moved.any() else None


def _step(contact: RoughContact) -> float:
    """Length [m] of a cell along x."""
    return contact.x[1] - contact.x[0] if contact.grid is None else contact.grid.spacing[0]


def _lost(heights, highest) -> float:
    """Mean height [m] that the highest local maxima of ``heights``, averages over cells, have lost against the
    ``highest`` height in their cells."""
    from scipy.ndimage import maximum_filter

    summits = np.flatnonzero(heights == maximum_filter(heights, size=3, mode="wrap"))
    tops = summits[np.argsort(heights.ravel()[summits])[-SUMMITS:]]
    return float(np.mean((highest - heights).ravel()[tops]))
