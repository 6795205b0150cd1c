"""A half-space contact on coarser and shorter grids."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..contact.problem import COARSEST
from .contract import ContactState, RoughContact
from .strip import strip_weight

if TYPE_CHECKING:
    from .half_space import HalfSpaceContact

LEAST_ROUGHNESS = 0.9  # of Sq, kept by the averages over the largest cells
MARGIN = 0.1  # of the length in contact, kept free on each side
MARGIN_CELLS = 4
TOUCH = 1e-3  # of Sq: an overlap that is none


def coarser_grids(contact: RoughContact, sq: float) -> list[RoughContact]:
    """``contact`` from the coarsest grid that still holds its roughness ``sq`` [m] to its own; two, if it can be halved."""
    contacts = [contact]
    while (coarse := contacts[0].coarsened()) is not None:
        if len(contacts) > 1 and coarse.sq < LEAST_ROUGHNESS * sq:
            break
        contacts.insert(0, coarse)
    return contacts


def coarsened(contact: HalfSpaceContact) -> HalfSpaceContact | None:
    """On cells twice as long and wide (an axis of too few or odd cells is kept), the heights averaged; the area A stays
    wider than a cell. None where neither axis can be halved."""
    operator, half_width = contact.operator, contact.half_width
    wide = half_width is not None and 2 * contact.spacing[0] > half_width
    factors = tuple(
        2 if kept % 2 == 0 and padded % 4 == 0 and kept >= 2 * COARSEST and not fixed else 1
        for kept, padded, fixed in zip(operator.shape, operator.padded, (wide, False))
    )
    if factors == (1, 1):
        return None
    (nx, ny), (fx, fy) = operator.shape, factors
    heights = contact.heights.reshape(nx // fx, fx, ny // fy, fy).mean(axis=(1, 3))
    x = contact.x.reshape(-1, fx).mean(axis=1)
    coarse = operator.coarsened(factors)
    weight = np.ones(x.size) if half_width is None else strip_weight(x, coarse.spacing[0], half_width)
    return replace(contact, heights=heights, spacing=coarse.spacing, x=x, operator=coarse, weight=weight)


def in_contact(contact: HalfSpaceContact, pressure: np.ndarray) -> tuple[float, float]:
    """Ends [m] of the part of x where contact may be on a finer grid: touched columns and area A, and a margin."""
    used = np.flatnonzero(pressure.any(axis=1) | (contact.weight > 0))
    low, high = contact.x[used[0]], contact.x[used[-1]]
    margin = MARGIN * (high - low) + MARGIN_CELLS * contact.spacing[0]
    return float(low - margin), float(high + margin)


def cut(contact: HalfSpaceContact, ends: tuple[float, float]) -> HalfSpaceContact:
    """The columns of ``contact`` between ``ends`` [m], a whole number of fours; itself where all are needed."""
    first, last = np.searchsorted(contact.x, ends)
    count = min(4 * -(-max(int(last - first), COARSEST) // 4), contact.x.size)
    if count > 0.9 * contact.x.size:
        return contact
    first = int(min(max(0, first), contact.x.size - count))
    keep = slice(first, first + count)
    return replace(
        contact,
        heights=contact.heights[keep],
        x=contact.x[keep],
        weight=contact.weight[keep],
        operator=contact.operator.shortened(count),
    )


def holds(whole: HalfSpaceContact, part: HalfSpaceContact, shape: np.ndarray, state: ContactState) -> bool:
    """No cell of ``whole`` outside its part is touched: one convolution of the contact found on the part."""
    if state.fields is None or part is whole:
        return True
    first = int(np.searchsorted(whole.x, part.x[0] - 0.5 * part.spacing[0]))
    pressure = np.zeros(whole.heights.shape)
    pressure[first : first + part.x.size] = state.fields.pressure
    gap = whole.operator.apply(pressure) + shape[:, None] - whole.heights - state.fields.approach
    gap[first : first + part.x.size] = 0.0
    return bool(gap.min() >= -TOUCH * whole.heights.std())


def carried_over(start: ContactState, contact: HalfSpaceContact) -> np.ndarray | None:
    """The pressure of ``start``, if any, on the cells of ``contact``: the nearest ones of its own."""
    pressure, shape = start.pressure, contact.heights.shape
    if pressure is None or pressure.shape == shape and np.array_equal(start.x, contact.x):
        return pressure
    step = start.x[1] - start.x[0]
    row = np.rint((contact.x - start.x[0]) / step).astype(int)
    column = np.arange(shape[1]) * pressure.shape[1] // shape[1]
    inside = (row >= 0) & (row < start.x.size)
    moved = np.where(inside[:, None], pressure[np.clip(row, 0, start.x.size - 1)][:, column], 0.0)
    return moved if moved.any() else None
