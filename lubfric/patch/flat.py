"""The nominally flat contact (paper, Sec. 3.1): one periodic contact curve under the film of the strip."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import ConvergenceError
from .closure import Closure
from .contact_curve import ContactCurve


@dataclass(frozen=True)
class FlatPatch:
    """Roughness spread evenly over the Hertz strip of the total load.

    x [m]: points across the strip, where the film is averaged; area [m^2] of the strip. The contact
    load divided by that area is the mean pressure of the curve.
    """

    curve: ContactCurve
    x: np.ndarray
    area: float

    def close(self, film_on_patch, contact_load, start=None, shape=None) -> Closure:
        """Gap and area at ``contact_load`` [N], read from the curve; ``start`` and ``shape`` are not needed.

        Raises `ConvergenceError` for a load that the contact model of the curve cannot carry.
        """
        pressure, heaviest = contact_load / self.area, float(self.curve.mean_pressure[0])
        if pressure > heaviest * (1 + 1e-12):
            raise ConvergenceError(
                f"the contact model carries {heaviest * self.area:.4g} N at most, asked for {contact_load:.4g} N"
            )
        gap, touching, plastic = self.curve.at(min(pressure, heaviest))
        return Closure(
            mean_gap=gap,
            mean_film=float(np.mean(film_on_patch)),
            x=self.x,
            contact_fraction=np.full(self.x.size, touching),
            real_contact_area_fraction=touching,
            plastic_area_fraction=plastic,
        )

    def carry(self, film_on_patch, start=None, shape=None) -> tuple[float, Closure]:
        """Contact load [N] at which the mean gap is the mean film, and the closure there.

        A film thinner than the gap at the heaviest load of the curve gives that load: a lower bound, which the
        volume residual of the closure shows.
        """
        load = self.curve.pressure_at(float(np.mean(film_on_patch))) * self.area
        return load, self.close(film_on_patch, load)

    def check(self, closure: Closure) -> None:
        """Nothing to check: the map is periodic."""
