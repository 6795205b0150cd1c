"""The dents that the summits of a rough surface keep where a loaded cylinder passes over it without a film.

The dry contact limits the pressure at the hardness, and cells at that limit overlap the other body. Here the overlap
becomes a dent: those cells are lowered by it. After that the same contact has the same pressure and no overlap, so that
it is elastic.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np

from .cylinder import LoadedCylinder
from .half_space import BOUNDARY
from .operator import HalfSpace, half_space
from .solve import solve_contact


def operator_under(
    heights: np.ndarray, spacing: tuple[float, float], cylinder: LoadedCylinder, workers: int = 1
) -> HalfSpace:
    """Return the half-space under the cylinder, long enough along x that the cylinder touches no summit at its ends."""
    dx = spacing[0]
    rise = float(heights.max() - heights.mean()) + float(heights.std())
    reach = math.sqrt(cylinder.half_width**2 + 2 * cylinder.radius * rise)
    shape = 2 * math.ceil(reach / dx) + 1, heights.shape[1]
    return half_space(shape, spacing, cylinder.e_prime, BOUNDARY, workers=workers)


def dent_by_pass(
    heights: np.ndarray,
    cylinder: LoadedCylinder,
    centres: Iterable[int],
    operator: HalfSpace,
    *,
    periodic: bool,
    tolerance: float,
) -> tuple[np.ndarray, float]:
    """Return the heights [m] that the cylinder leaves after one pass, and the depth [m] of the deepest new dent.

    Parameters
    ----------
    heights : (nx, ny) [m], x along the motion, periodic along y
    cylinder : the `LoadedCylinder`, with a hardness
    centres : columns of the map above which the cylinder is, one after the other
    operator : from `operator_under`, for these cells
    periodic : True: the map continues along x onto itself; False: by its mirror image
    tolerance : of `lubfric.solve_contact`
    """
    count = operator.shape[0]
    dx = operator.spacing[0]
    columns_of_map = heights.shape[0]
    around = np.arange(count) - count // 2
    parabola = (around * dx)[:, None] ** 2 / (2 * cylinder.radius)
    options: dict[str, Any] = {
        "mean_pressure": cylinder.load / (cylinder.width * count * dx),
        "hardness": cylinder.hardness,
        "boundary": BOUNDARY,
        "tolerance": tolerance,
        "operator": operator,
    }
    lowered = heights.copy()
    deepest = 0.0
    pressure = None
    last = 0
    for centre in centres:
        columns = (centre + around) % (columns_of_map if periodic else 2 * columns_of_map)
        columns = np.where(columns < columns_of_map, columns, 2 * columns_of_map - 1 - columns)  # the mirror image
        here = lowered[columns]
        problem = parabola - here, operator.spacing, cylinder.e_prime
        start = None if pressure is None else _moved(pressure, centre - last)
        contact = solve_contact(*problem, **options, start=start, raise_on_failure=start is None)
        if not contact.report.converged:
            contact = solve_contact(*problem, **options)
        pressure = contact.pressure
        last = centre
        dent = np.where(pressure >= cylinder.hardness, np.maximum(-contact.gap, 0.0), 0.0)
        np.minimum.at(lowered, columns, here - dent)  # a column may be under the cylinder twice
        deepest = max(deepest, float(dent.max()))
    return lowered, deepest


def _moved(pressure: np.ndarray, columns: int) -> np.ndarray:
    """Return ``pressure`` [Pa] as it lies on the map, seen from a cylinder that has moved on by ``columns``."""
    moved = np.zeros_like(pressure)
    count = len(pressure)
    moved[max(0, -columns) : count - max(0, columns)] = pressure[max(0, columns) : count - max(0, -columns)]
    return moved
