"""A rough patch under a cylinder."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import validate
from ..contact import solve_contact
from ..contact.single_loop import single_loop
from ..errors import InputError
from ..halfspace import HalfSpace
from .closure import Closure

EDGE_SHARE = 0.01


@dataclass(frozen=True)
class CylinderPatch:
    """A rough patch under a cylinder: free along x, periodic along y (paper, Sec. 3.2).

    heights [m] (nx, ny) around their mean; x [m] (nx,) cell centres around the line of contact;
    region_weight (nx,): part of each column inside the area A of Eq. (8).
    """

    heights: np.ndarray
    spacing: tuple[float, float]
    x: np.ndarray
    region_weight: np.ndarray
    operator: HalfSpace
    width: float
    hardness: float | None
    tolerance: float

    def close(self, film_on_patch, contact_load, start=None, shape=None) -> Closure:
        """Load the patch with ``contact_load`` [N] (over the whole width) under the film's shape.

        ``shape`` [m] (nx,): what the surface is pressed under where it is not the film itself.
        """
        gap0 = (film_on_patch if shape is None else shape)[:, None] - self.heights
        length = self.x.size * self.spacing[0]
        if contact_load == 0:
            return self._closure(film_on_patch, gap0 - gap0.min(), None)
        contact = solve_contact(
            gap0,
            self.spacing,
            self.operator.e_prime,
            operator=self.operator,
            mean_pressure=contact_load / (self.width * length),
            hardness=self.hardness,
            boundary=("free", "periodic"),
            tolerance=self.tolerance,
            start=start,
        )
        return self._closure(film_on_patch, contact.gap, contact)

    def carry(self, film_on_patch, start=None, shape=None) -> tuple[float, Closure]:
        """Contact load [N] under the imposed film (paper, Appendix 2), and the closure there."""
        film = film_on_patch
        if shape is not None:
            film = shape + _weighted(film_on_patch - shape, self.region_weight)
        contact = single_loop(
            self.heights,
            film,
            self.spacing,
            self.operator.e_prime,
            weight=self.region_weight,
            hardness=self.hardness,
            boundary=("free", "periodic"),
            tolerance=self.tolerance,
            start=start,
            operator=self.operator,
        )
        load = contact.mean_pressure * self.width * self.x.size * self.spacing[0]
        return load, self._closure(film_on_patch, contact.gap, contact if load > 0 else None)

    def check(self, closure: Closure) -> None:
        """Raise `InputError` when the contact reaches the ends of the patch."""
        if closure.contact is None or self.x.size <= 2:
            return
        pressure = closure.contact.pressure
        share = (pressure[0].sum() + pressure[-1].sum()) / pressure.sum()
        if share > EDGE_SHARE:
            raise InputError(
                f"contact.shape: {100 * share:.2g} % of the contact load sits on the edge columns of a "
                f"patch {self.x.size * self.spacing[0]:.3g} m long; allowed: at most "
                f"{100 * EDGE_SHARE:g} % (make the patch longer in x)"
            )

    def _closure(self, film_on_patch, gap, contact) -> Closure:
        weight = self.region_weight
        touching = np.zeros(gap.shape, bool) if contact is None else contact.pressure > 0
        fraction = touching.mean(axis=1)
        plastic = 0.0
        if contact is not None and self.hardness is not None:
            plastic = _weighted((contact.pressure >= self.hardness).mean(axis=1), weight)
        return Closure(
            mean_gap=_weighted(np.maximum(gap, 0.0).mean(axis=1), weight),
            mean_film=_weighted(film_on_patch, weight),
            x=self.x,
            contact_fraction=fraction,
            real_contact_area_fraction=_weighted(fraction, weight),
            plastic_area_fraction=plastic,
            contact=contact,
        )


def _weighted(values, weight) -> float:
    return float(np.dot(values, weight) / weight.sum())


def centred_axis(count: int, step: float) -> np.ndarray:
    """Cell centres [m] of ``count`` cells around zero."""
    return (np.arange(count) - 0.5 * (count - 1)) * step


def strip_weight(x: np.ndarray, step: float, half_width: float) -> np.ndarray:
    """Part of each cell that lies within |x| <= half_width, cut cells counted by their share."""
    inside = np.minimum(x + step / 2, half_width) - np.maximum(x - step / 2, -half_width)
    weight = np.clip(inside / step, 0.0, 1.0)
    if not weight.any():
        raise InputError(
            "contact.spacing: no cell of the contact grid lies in the Hertz strip of half-width "
            f"{validate.positive('half_width', half_width, 'm'):g} m; allowed: finer grids"
        )
    return weight
