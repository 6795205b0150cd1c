"""A contact patch on coarser and shorter grids."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..contact.problem import COARSEST
from ..patch.cylinder import CylinderPatch, strip_weight

LEAST_ROUGHNESS = 0.9  # of Sq, kept by the averages over the largest cells
MARGIN = 0.1  # of the length in contact, kept free on each side
MARGIN_CELLS = 4
TOUCH = 1e-3  # of Sq: an overlap that is none


def coarsened(patch: CylinderPatch, half_width: float | None) -> CylinderPatch | None:
    """The patch on cells twice as long and wide (an axis of too few or odd cells is kept), its heights averaged.

    half_width [m] of the area A (None: all of the patch), which has to stay wider than a cell. None where neither axis
    can be halved.
    """
    operator = patch.operator
    wide = half_width is not None and 2 * patch.spacing[0] > half_width
    factors = tuple(
        2 if kept % 2 == 0 and padded % 4 == 0 and kept >= 2 * COARSEST and not fixed else 1
        for kept, padded, fixed in zip(operator.shape, operator.padded, (wide, False))
    )
    if factors == (1, 1):
        return None
    (nx, ny), (fx, fy) = operator.shape, factors
    heights = patch.heights.reshape(nx // fx, fx, ny // fy, fy).mean(axis=(1, 3))
    x = patch.x.reshape(-1, fx).mean(axis=1)
    coarse = operator.coarsened(factors)
    return replace(
        patch,
        heights=heights,
        spacing=coarse.spacing,
        x=x,
        operator=coarse,
        region_weight=_weight(x, coarse.spacing[0], half_width),
    )


def grids(model) -> list:
    """The patch of ``model``, from the coarsest grid that still holds its roughness to its own; two, if it can be halved."""
    patches, kept = [model.patch], LEAST_ROUGHNESS * model.surface.sq
    half_width = model.scene.bodies.half_width if model.scene.contact.region == "hertz" else None
    while isinstance(patches[0], CylinderPatch):
        coarse = coarsened(patches[0], half_width)
        if coarse is None or len(patches) > 1 and coarse.heights.std() < kept:
            break
        patches.insert(0, coarse)
    return patches


def in_contact(patch: CylinderPatch, pressure: np.ndarray) -> tuple[float, float]:
    """Ends [m] of the part of x where contact may be on a finer grid: touched columns and area A, and a margin."""
    used = np.flatnonzero(pressure.any(axis=1) | (patch.region_weight > 0))
    low, high = patch.x[used[0]], patch.x[used[-1]]
    margin = MARGIN * (high - low) + MARGIN_CELLS * patch.spacing[0]
    return float(low - margin), float(high + margin)


def cut(patch: CylinderPatch, ends: tuple[float, float]) -> CylinderPatch:
    """The columns of ``patch`` between ``ends`` [m], a whole number of fours; the patch itself where all are needed."""
    first, last = np.searchsorted(patch.x, ends)
    count = min(4 * -(-max(int(last - first), COARSEST) // 4), patch.x.size)
    if count > 0.9 * patch.x.size:
        return patch
    first = int(min(max(0, first), patch.x.size - count))
    keep = slice(first, first + count)
    return replace(
        patch,
        heights=patch.heights[keep],
        x=patch.x[keep],
        region_weight=patch.region_weight[keep],
        operator=patch.operator.shortened(count),
    )


def holds(patch: CylinderPatch, whole: CylinderPatch, under: np.ndarray, contact) -> bool:
    """No cell of ``whole`` outside its part ``patch`` is touched: one convolution of the contact found on the part.

    under [m] (nx,): what ``whole`` is pressed under (the film, up to a constant).
    """
    if contact is None or patch is whole:
        return True
    first = int(np.searchsorted(whole.x, patch.x[0] - 0.5 * patch.spacing[0]))
    pressure = np.zeros(whole.heights.shape)
    pressure[first : first + patch.x.size] = contact.pressure
    gap = whole.operator.apply(pressure) + under[:, None] - whole.heights - contact.approach
    gap[first : first + patch.x.size] = 0.0
    return bool(gap.min() >= -TOUCH * whole.heights.std())


def _weight(x, step, half_width) -> np.ndarray:
    return np.ones(x.size) if half_width is None else strip_weight(x, step, half_width)
