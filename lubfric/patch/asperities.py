"""Independent asperities in the place of the half-space: the same closure, with no deflection beyond each
contact.

The film h(x) less an offset epsilon is the separation, as in the paper's Eq. (7): asperities above it are in
contact. Nothing but the contacts themselves deforms, so the volume balance of Eq. (8) loses its deflection u
and becomes

- "volume":      mean of max(h - epsilon - z, 0) over A = mean film over A, Johnson's definition of the
  separation (K. L. Johnson, J. A. Greenwood, S. Y. Poon, Wear 19 (1972) 91-108,
  doi:10.1016/0043-1648(72)90445-0);
- "mean-plane":  epsilon = 0: the film is the distance of the mean planes, for z about its mean over A.

Under a cylinder the contact load does not flatten the surface as a whole: the film's shape is all there is.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..asperity import AsperityResult, contact_law
from ..errors import ConvergenceError
from .closure import Closure
from .contact_curve import ContactCurve

APPROACHES = np.concatenate([np.geomspace(1e-4, 0.2, 80), np.linspace(0.2, 1.0, 81)[1:]])  # of the height range


def asperity_curve(heights, spacing, e_prime, *, heaviest, definition, reading, hardness=None) -> ContactCurve:
    """Mean gap against mean pressure of independent asperities on a periodic map, from first touch on.

    ``reading``: "volume" or "mean-plane" (the module's docstring) of heights [m] about their mean. The flat
    comes down until ``heaviest`` [Pa] is carried, or, where the model cannot carry it, to the deepest valley
    (to the mean plane itself for "mean-plane"): the curve then ends at the most it carries. Patches that grow
    together carry less than before; such nodes are left out, so the pressure rises along the curve. The search
    ends below half of the most that was carried.
    """
    law = contact_law(heights, spacing, e_prime, definition=definition, hardness=hardness)
    top, span = float(heights.max()), float(np.ptp(heights))
    nodes = []
    for approach in span * APPROACHES:
        found = law(top - approach)
        gap = _curve_gap(heights, top - approach, reading)
        if gap <= 0:
            break
        if found.load > 0 and (not nodes or found.mean_pressure > nodes[-1][0]):
            nodes.append((found.mean_pressure, gap, min(found.contact_area_fraction, 1.0), found.plastic_area_fraction))
        if nodes and (nodes[-1][0] >= heaviest or found.mean_pressure < 0.5 * nodes[-1][0]):
            break
    pressure, gap, area, plastic = np.array(nodes[::-1]).T
    return ContactCurve(pressure, gap, area, plastic, _curve_gap(heights, top, reading), 0)


def _curve_gap(heights, separation, reading) -> float:
    return float(np.maximum(separation - heights, 0.0).mean()) if reading == "volume" else float(separation)


@dataclass(frozen=True)
class AsperityPatch:
    """A rough patch under a cylinder, free along x, periodic along y, its asperities independent.

    heights [m] (nx, ny) around their mean; x [m] (nx,); region_weight (nx,): area A; definition, reading: see
    the module. tolerance: of the mean gap, relative.
    """

    heights: np.ndarray
    spacing: tuple[float, float]
    x: np.ndarray
    region_weight: np.ndarray
    e_prime: float
    width: float
    hardness: float | None
    definition: str
    reading: str
    tolerance: float

    def close(self, film_on_patch, contact_load, start=None, shape=None) -> Closure:
        """Offset at which the asperities carry ``contact_load`` [N] on the whole width; ``start`` is not
        needed.

        The load of patches jumps where they join: the offset of the jump is taken, to which the gap is
        continuous. Raises `ConvergenceError` when the load cannot be reached.
        """
        from scipy.optimize import brentq

        under = self._under(film_on_patch, shape)
        law, touch = self._law(), float((under[:, None] - self.heights).min())
        target = contact_load * self.heights.shape[1] * self.spacing[1] / self.width
        if contact_load == 0:
            return self._closure(film_on_patch, under, touch, None)
        span, approach = float(np.ptp(self.heights)), 0.02 * float(np.ptp(self.heights))
        last = 0.0
        while law(under[:, None] - touch - approach).load < target:
            last, approach = approach, 1.5 * approach
            if approach > 20 * span:
                raise ConvergenceError(
                    f"{self.definition} cannot carry {contact_load:.4g} N on a width of "
                    f"{self.width:.3g} m: below the deepest valley at the end of the "
                    "search"
                )
        film = float(np.dot(film_on_patch, self.region_weight) / self.region_weight.sum())
        root = brentq(
            lambda a: law(under[:, None] - touch - a).load / target - 1,
            last,
            approach,
            xtol=0.1 * self.tolerance * max(film, 1e-3 * span),
            rtol=1e-12,
        )
        return self._closure(film_on_patch, under, touch + root, law(under[:, None] - touch - root))

    def carry(self, film_on_patch, start=None, shape=None) -> tuple[float, Closure]:
        """Contact load [N] under the imposed film, and the closure there: the offset does not depend on the
        load."""
        from scipy.optimize import brentq

        under, weight = self._under(film_on_patch, shape), self.region_weight
        film = float(np.dot(film_on_patch, weight) / weight.sum())
        touch = float((under[:, None] - self.heights).min())
        if self._gap(under, touch) <= film:
            return 0.0, self._closure(film_on_patch, under, touch, None)
        offset = brentq(
            lambda e: self._gap(under, e) - film,
            touch,
            touch + 2 * (float(np.ptp(under)) + np.ptp(self.heights)),
            xtol=1e-3 * self.tolerance * film,
            rtol=1e-14,
        )
        found = self._law()(under[:, None] - offset)
        load = found.load * self.width / (self.heights.shape[1] * self.spacing[1])
        return load, self._closure(film_on_patch, under, offset, found)

    def check(self, closure: Closure) -> None:
        """Nothing to check: the load is where the summits are."""

    def _law(self):
        return contact_law(
            self.heights,
            self.spacing,
            self.e_prime,
            definition=self.definition,
            hardness=self.hardness,
            periodic=(False, True),
        )

    @staticmethod
    def _under(film_on_patch, shape) -> np.ndarray:
        return film_on_patch if shape is None else shape

    def _gap(self, under, offset) -> float:
        gap = under[:, None] - offset - self.heights
        if self.reading == "volume":
            gap = np.maximum(gap, 0.0)
        return float(np.dot(gap.mean(axis=1), self.region_weight) / self.region_weight.sum())

    def _closure(self, film_on_patch, under, offset, found: AsperityResult | None) -> Closure:
        weight = self.region_weight / self.region_weight.sum()
        fraction = np.zeros(self.x.size) if found is None else self._contact_fraction(found)
        plastic = (
            0.0
            if found is None or found.contact_area == 0
            else found.plastic_area_fraction * (fraction @ weight) / found.contact_area_fraction
        )
        return Closure(
            mean_gap=self._gap(under, offset),
            mean_film=float(film_on_patch @ weight),
            x=self.x,
            contact_fraction=fraction,
            real_contact_area_fraction=float(fraction @ weight),
            plastic_area_fraction=float(plastic),
        )

    def _contact_fraction(self, found: AsperityResult) -> np.ndarray:
        """Share of the width inside the contact discs, column by column; 1 where discs overlap to more."""
        centre = self.x[found.index[:, 0]]
        radius = np.sqrt(found.radii * found.overlap)
        edges = np.append(self.x - self.spacing[0] / 2, self.x[-1] + self.spacing[0] / 2)
        s = np.clip((edges[:, None] - centre) / radius, -1.0, 1.0)
        area = (s * np.sqrt(1 - s**2) + np.arcsin(s)) * radius**2  # of the disc left of the edge, + pi/2
        column = np.diff(area.sum(axis=1)) / (self.spacing[0] * self.heights.shape[1] * self.spacing[1])
        return np.minimum(column, 1.0)
