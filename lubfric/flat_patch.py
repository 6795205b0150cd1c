"""The nominally flat contact (paper, Sec. 3.1): one periodic contact curve under the film of the strip."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .contact_curve import ContactCurve
from .patch import Closure


@dataclass(frozen=True)
class FlatPatch:
    """Roughness spread evenly over the Hertz strip of the total load.

    x [m]: points across the strip, where the film is averaged; area [m^2] of the strip. The contact
    load divided by that area is the mean pressure of the curve.
    """

    curve: ContactCurve
    x: np.ndarray
    area: float

    def close(self, film_on_patch, contact_load, start=None) -> Closure:
        """Gap and area at ``contact_load`` [N], read from the curve; ``start`` is not needed."""
        gap, touching, plastic = self.curve.at(contact_load / self.area)
        return Closure(mean_gap=gap, mean_film=float(np.mean(film_on_patch)), x=self.x,
                       contact_fraction=np.full(self.x.size, touching),
                       real_contact_area_fraction=touching, plastic_area_fraction=plastic)
