"""Wear of the cells that carry asperity pressure, by Archard's law.

A cell that bears the pressure p over a sliding distance s loses the depth K p s/H (J. F. Archard, J. Appl. Phys. 24
(1953) 981-988, doi:10.1063/1.1721448: V = K F s/H). The loss changes the pressure, and a step that takes the pressure
from its beginning is stable only for steps in which the shortest wave of the grid loses less than it deflects. So a
step takes the pressure from its end: gap and pressure are those of a half-space with a layer that sinks by (K s/H) p
(`HalfSpace.with_layer`), the implicit Euler method, stable for any step.

A surface that moves passes through the contact. `Passage` lays windows of the map, each as long as the contact, one
after the other along y, so that one contact with one approach and one film bears the load at all of them. The windows
lie a Hertz strip 2 b apart, so that every point of the map is under the strip once.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .._base import validate
from .cylinder import LoadedCylinder
from .operator import HalfSpace

# Turn [-] by which the windows shift from step to step, so that no two steps coincide: the golden ratio. By definition
# of that ratio; its multiples fill a turn most evenly.
GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)


def archard_compliance(coefficient: float, distance: float, hardness: float) -> float:
    """Return the depth lost per pressure [m/Pa], K s/H.

    coefficient : K [-]; distance : sliding s [m]; hardness : H [Pa] of the body that wears
    """
    coefficient = validate.number("coefficient", coefficient, "(-)", minimum=0.0, maximum=1.0)
    distance = validate.nonnegative("distance", distance, "m")
    return coefficient * distance / validate.positive("hardness", hardness, "Pa")


@dataclass(frozen=True, kw_only=True)
class Passage:
    """The windows of a map that lie under a loaded cylinder while the map passes through the contact once.

    Attributes
    ----------
    columns : (windows, count), the columns of the map under each window
    rows : number of cells of the map along y
    dose : sliding that the pressure of a window represents, over that of the passage [-]: the length of map for each
        window over the Hertz strip
    """

    columns: np.ndarray
    rows: int
    dose: float

    def stacked(self, heights: np.ndarray) -> np.ndarray:
        """Return ``heights`` (nx, ny) [m] of the map under all windows, one after the other along y."""
        return np.concatenate(list(heights[self.columns]), axis=1)

    def by_window(self, field: np.ndarray) -> np.ndarray:
        """Return a ``field`` of the stack window by window, (windows, count, ny)."""
        return np.stack(np.split(field, len(self.columns), axis=1))

    def worn(self, heights: np.ndarray, pressure: np.ndarray, compliance: float) -> np.ndarray:
        """Return ``heights`` (nx, ny) [m] less what the ``pressure`` [Pa] of the stack takes away.

        compliance : depth lost per pressure [m/Pa] for the sliding of one passage (`archard_compliance`)
        """
        left = heights.copy()
        depth = self.dose * compliance * self.by_window(pressure)
        for columns, lost in zip(self.columns, depth):
            np.subtract.at(left, columns, lost)  # a column may be under the cylinder twice
        return left


def passage(
    shape: tuple[int, int], cylinder: LoadedCylinder, operator: HalfSpace, *, periodic: bool, turn: int = 0
) -> Passage:
    """Return the windows of a map of ``shape`` (nx, ny) under ``cylinder``.

    operator : from `operator_under`, whose columns a window has; periodic : whether the map continues along x onto
    itself (False: by its mirror image); turn : number of the step, by which the windows shift
    """
    nx, ny = shape
    count = operator.shape[0]
    length = nx * operator.spacing[0]
    strip = 2.0 * cylinder.half_width
    windows = max(1, round(length / strip))
    centres = (np.arange(windows) + (0.5 + turn * GOLDEN) % 1.0) * (nx / windows)
    columns = np.floor(centres).astype(int)[:, None] + np.arange(count) - count // 2
    columns %= nx if periodic else 2 * nx
    columns = np.where(columns < nx, columns, 2 * nx - 1 - columns)
    return Passage(columns=columns, rows=ny, dose=length / windows / strip)
