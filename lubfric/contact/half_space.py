"""The rough surface on half-spaces, where every point may carry load, under a cylinder: the semi-periodic contact of
the paper, Sec. 3.2."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .._base import FieldsOnly
from .cylinder import LoadedCylinder
from .operator import HalfSpace, half_space
from .problem import ContactStart
from .rough_contract import ContactState, RoughContact, area_weight, centred_axis, weighted_mean
from .solve import solve_contact

# Boundaries of the contact along x and y.
BOUNDARY = ("free", "periodic")


@dataclass(frozen=True, kw_only=True)
class HalfSpaceContact(FieldsOnly, RoughContact):
    """A rough surface under a cylinder on its cells: free along x, periodic along y.

    heights [m] (nx, ny) around their mean; x [m] (nx,) cell centres around the line of contact; weight (nx,): part of
    each column inside the area A of Eq. (8); width [m] of the line; hardness [Pa] (None: elastic); tolerance: of
    `lubfric.solve_contact`.
    """

    heights: np.ndarray
    spacing: tuple[float, float]
    x: np.ndarray
    weight: np.ndarray
    operator: HalfSpace
    width: float
    hardness: float | None
    tolerance: float

    def over_strip(self, half_width: float, before: float) -> HalfSpaceContact:
        """Return the contact with other cells of it inside the strip."""
        return replace(self, weight=area_weight("hertz", half_width, self.x, self.spacing[0]))

    def close(
        self, film: np.ndarray, load: float, start: ContactState | None = None, shape: np.ndarray | None = None
    ) -> ContactState:
        """Return the surface, loaded under the film's shape, by `lubfric.solve_contact`."""
        under = film if shape is None else shape
        if load == 0:
            return self._first_touch(film, under)
        contact = solve_contact(
            under[:, None] - self.heights,
            self.spacing,
            self.operator.e_prime,
            operator=self.operator,
            mean_pressure=load / (self.width * self.x.size * self.spacing[0]),
            hardness=self.hardness,
            boundary=BOUNDARY,
            tolerance=self.tolerance,
            start=self._start_from(start),
        )
        touching = contact.pressure > 0
        plastic = 0.0
        if self.hardness is not None:
            plastic = weighted_mean((contact.pressure >= self.hardness).mean(axis=1), self.weight)
        fraction = touching.mean(axis=1)
        return ContactState(
            mean_gap=weighted_mean(np.maximum(contact.gap, 0.0).mean(axis=1), self.weight),
            mean_film=weighted_mean(film, self.weight),
            x=self.x,
            contact_fraction=fraction,
            real_contact_area_fraction=weighted_mean(fraction, self.weight),
            plastic_area_fraction=plastic,
            fields=contact,
            y=self.y,
            gap_error=contact.report.residual * contact.length,
        )

    @property
    def name(self) -> str:
        return "semi-periodic"

    @property
    def grid(self) -> tuple[int, int]:
        return self.heights.shape

    @property
    def y(self) -> np.ndarray:
        """Return the cells along the line [m], (ny,)."""
        return np.arange(self.heights.shape[1]) * self.spacing[1]

    @cached_property
    def profiles(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the mean and highest of the heights [m] at every x, (nx,) each."""
        return self.heights.mean(axis=1), self.heights.max(axis=1)

    @property
    def adjustable_tolerance(self) -> float:
        return self.tolerance

    def tightened(self, tolerance: float) -> HalfSpaceContact:
        return replace(self, tolerance=tolerance)

    def on_the_ends(self, state: ContactState) -> float:
        if state.fields is None or self.x.size <= 2:
            return 0.0
        pressure = state.fields.pressure
        return float((pressure[0].sum() + pressure[-1].sum()) / pressure.sum())

    def _first_touch(self, film: np.ndarray, under: np.ndarray) -> ContactState:
        """Return the contact without load: the gap is open everywhere, and zero at one cell."""
        mean, highest = self.profiles
        return ContactState(
            mean_gap=weighted_mean(under - mean, self.weight) - float((under - highest).min()),
            mean_film=weighted_mean(film, self.weight),
            x=self.x,
            contact_fraction=np.zeros(self.x.size),
            real_contact_area_fraction=0.0,
            plastic_area_fraction=0.0,
            y=self.y,
        )

    def _start_from(self, state: ContactState | None) -> ContactStart | np.ndarray | None:
        """Return the pressure of ``state``, if any, on these cells, with its displacement where the operator is the
        same; on other cells, its pressure taken from the nearest of its own."""
        if state is None or state.fields is None:
            return None
        pressure = state.fields.pressure
        shape = self.heights.shape
        if pressure.shape == shape and np.array_equal(state.x, self.x):
            displacement = state.fields.displacement
            is_known = state.fields.operator == self.operator.identity
            return ContactStart(pressure=pressure, displacement=displacement if is_known else None)
        row = np.rint((self.x - state.x[0]) / (state.x[1] - state.x[0])).astype(int)
        column = np.arange(shape[1]) * pressure.shape[1] // shape[1]
        inside = (row >= 0) & (row < state.x.size)
        moved = np.where(inside[:, None], pressure[np.clip(row, 0, state.x.size - 1)][:, column], 0.0)
        return moved if moved.any() else None


def half_space_contact(
    heights: np.ndarray,
    spacing: tuple[float, float],
    cylinder: LoadedCylinder,
    *,
    region: str = "hertz",
    tolerance: float = 1e-3,
    workers: int = 1,
    operator: HalfSpace | None = None,
    x: np.ndarray | None = None,
) -> HalfSpaceContact:
    """Return the half-space contact of a rough surface under a loaded cylinder.

    Parameters
    ----------
    heights : (nx, ny) [m] about their mean, x along axis 0
    spacing : (dx, dy) [m] of the cells
    cylinder : the `LoadedCylinder`
    region : area A of Eq. (8): "hertz", the Hertz strip, or "box", the complete patch
    tolerance : of `lubfric.solve_contact`
    workers : threads of the Fourier transforms, for an operator that is made here
    operator : a `HalfSpace` made before for this grid, or None
    x : cell centres [m] (nx,); None: evenly about the line of contact
    """
    x = centred_axis(heights.shape[0], spacing[0]) if x is None else x
    if operator is None:
        operator = half_space(heights.shape, spacing, cylinder.e_prime, BOUNDARY, workers=workers)
    return HalfSpaceContact(
        heights=heights,
        spacing=(spacing[0], spacing[1]),
        x=x,
        weight=area_weight(region, cylinder.half_width, x, spacing[0]),
        operator=operator,
        width=cylinder.width,
        hardness=cylinder.hardness,
        tolerance=tolerance,
    )
