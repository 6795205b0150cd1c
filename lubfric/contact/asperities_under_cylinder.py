"""Independent asperities instead of a half-space, under a cylinder and on a flat: nothing deforms outside the single
contacts.

The film h(x) less an offset epsilon is the separation, as in the paper's Eq. (7): asperities above it are in contact.
Since only the contacts deform, the volume balance of Eq. (8) loses its deflection u and becomes

- "volume":      mean of max(h - epsilon - z, 0) over A = mean film over A, Johnson's definition of the
  separation (K. L. Johnson, J. A. Greenwood, S. Y. Poon, Wear 19 (1972) 91-108,
  doi:10.1016/0043-1648(72)90445-0);
- "mean-plane":  epsilon = 0: the film is the distance of the mean planes, for z about its mean over A.

Under a cylinder the contact load does not flatten the surface as a whole: its shape is that of the film.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from .._base import FieldsOnly, FloatArray
from ..errors import ConvergenceError
from .asperity import AsperityResult, find_asperities
from .cylinder import LoadedCylinder
from .rough_contract import ContactState, RoughContact, area_weight, centred_axis, weighted_mean


@dataclass(frozen=True, kw_only=True)
class AsperityContact(FieldsOnly, RoughContact):
    """The contact of a rough surface by independent asperities under a cylinder, free along x, periodic along y.

    Attributes
    ----------
    cylinder : the `LoadedCylinder`
    heights : (nx, ny) [m] around their mean
    spacing : (dx, dy) [m]
    x : cell centres [m] (nx,)
    weight : (nx,), the part of each column inside the area A of Eq. (8)
    definition : "summits" or "patches"
    asperity_separation : "volume" or "mean-plane" (see the module)
    tolerance : of the offset, relative to a tenth of the mean film
    """

    cylinder: LoadedCylinder
    heights: np.ndarray
    spacing: tuple[float, float]
    x: np.ndarray
    weight: np.ndarray
    definition: str
    asperity_separation: str
    tolerance: float

    def over_strip(self, half_width: float, before: float) -> AsperityContact:
        """Return the contact with other cells of it inside the strip."""
        return replace(self, weight=area_weight("hertz", half_width, self.x, self.spacing[0]))

    def close(
        self, film: np.ndarray, load: float, start: ContactState | None = None, shape: np.ndarray | None = None
    ) -> ContactState:
        """Return the offset at which the asperities carry ``load`` [N] on the full width; ``start`` is not needed.

        The load of patches jumps where two of them join. Then the offset of the jump is taken, at which the gap is
        continuous. Raises `ConvergenceError` if the load cannot be reached.
        """
        under = (film if shape is None else shape)[:, None]
        touch = float((under - self.heights).min())
        if load == 0:
            return self._state(film, under - touch, None)
        separation = under - touch - self._approach(film, load, lambda a: self._at(under - touch - a).load)
        return self._state(film, separation, self._at(separation))

    @cached_property
    def _at(self) -> Callable[..., AsperityResult]:
        """What touches at a separation [m], (nx, ny)."""
        return find_asperities(
            self.heights,
            self.spacing,
            self.cylinder.e_prime,
            definition=self.definition,
            hardness=self.cylinder.hardness,
            periodic=(False, True),
        )

    def _approach(self, film: FloatArray, load: float, carried: Callable[..., Any]) -> float:
        """Return the approach [m] from first touch at which ``carried(approach)`` [N] of the map is ``load`` of the
        width."""
        from scipy.optimize import brentq

        width = self.cylinder.width
        target = load * self.heights.shape[1] * self.spacing[1] / width
        span = float(np.ptp(self.heights))
        last = 0.0
        approach = 0.02 * span
        while carried(approach) < target:
            last, approach = approach, 1.5 * approach
            if approach > 20 * span:
                raise ConvergenceError(
                    f"{self.definition} cannot carry {load:.4g} N on a width of {width:.3g} m: below the "
                    "deepest valley at the end of the search"
                )
        nearest = 0.1 * self.tolerance * max(weighted_mean(film, self.weight), 1e-3 * span)
        return brentq(lambda a: carried(a) / target - 1, last, approach, xtol=nearest, rtol=1e-12)

    @property
    def name(self) -> str:
        return f"independent {self.definition}"

    @property
    def grid(self) -> tuple[int, int]:
        return self.heights.shape

    def _state(self, film: np.ndarray, separation: Any, asperities: AsperityResult | None) -> ContactState:
        """Return the state of the contact with the surfaces at a ``separation`` [m] under the ``film`` [m];
        ``asperities``: None where none touches."""
        gap = separation - self.heights
        if self.asperity_separation == "volume":
            gap = np.maximum(gap, 0.0)
        fraction = np.zeros(self.x.size)
        plastic = 0.0
        if asperities is not None:
            fraction = self._contact_fraction(asperities)
        area = weighted_mean(fraction, self.weight)
        if asperities is not None and asperities.contact_area > 0:
            plastic = asperities.plastic_area_fraction * area / asperities.contact_area_fraction
        return ContactState(
            mean_gap=weighted_mean(gap.mean(axis=1), self.weight),
            mean_film=weighted_mean(film, self.weight),
            x=self.x,
            contact_fraction=fraction,
            real_contact_area_fraction=area,
            plastic_area_fraction=plastic,
        )

    def _contact_fraction(self, asperities: AsperityResult) -> np.ndarray:
        """Return the share of the width inside the contact discs, column by column; 1 if overlapping discs add up to
        more."""
        centre = self.x[asperities.index[:, 0]]
        radius = np.sqrt(asperities.radii * asperities.overlap)
        edges = np.append(self.x - self.spacing[0] / 2, self.x[-1] + self.spacing[0] / 2)
        s = np.clip((edges[:, None] - centre) / radius, -1.0, 1.0)
        area = (s * np.sqrt(1 - s**2) + np.arcsin(s)) * radius**2  # of the disc left of the edge, + pi/2
        column = np.diff(area.sum(axis=1)) / (self.spacing[0] * self.heights.shape[1] * self.spacing[1])
        return np.minimum(column, 1.0)


def asperities_under_cylinder(
    heights: np.ndarray,
    spacing: tuple[float, float],
    cylinder: LoadedCylinder,
    *,
    region: str = "hertz",
    definition: str = "summits",
    asperity_separation: str = "volume",
    tolerance: float = 1e-3,
) -> AsperityContact:
    """Return the contact by independent asperities on ``heights`` [m] (nx, ny) about their mean.

    region : area A of Eq. (8): "hertz", the Hertz strip of the ``cylinder``, or "box", the complete patch; the others
        as in `AsperityContact`.
    """
    x = centred_axis(heights.shape[0], spacing[0])
    return AsperityContact(
        cylinder=cylinder,
        heights=heights,
        spacing=spacing,
        x=x,
        weight=area_weight(region, cylinder.half_width, x, spacing[0]),
        definition=definition,
        asperity_separation=asperity_separation,
        tolerance=tolerance,
    )
