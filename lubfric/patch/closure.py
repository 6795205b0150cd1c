"""What a rough contact under a film answers: how far apart the surfaces stay, and where they touch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..contact import ContactResult


@dataclass(frozen=True)
class Closure:
    """Both sides of the volume balance, Eq. (8), at one division of the load.

    mean_gap [m]: lubricant volume per area of A between the rough surfaces; mean_film [m]: the same
    between the smooth ones; contact_fraction (nx,): share of the width in contact at each ``x`` [m];
    real_contact_area_fraction, plastic_area_fraction: of the area A; contact: the dry contact's
    fields (None: separated, or taken from a contact curve).
    """

    mean_gap: float
    mean_film: float
    x: np.ndarray
    contact_fraction: np.ndarray
    real_contact_area_fraction: float
    plastic_area_fraction: float
    contact: ContactResult | None = None

    @property
    def volume_residual(self) -> float:
        """(gap - film)/(gap + film): zero in balance, increasing with the film's share of the load."""
        return (self.mean_gap - self.mean_film) / (abs(self.mean_gap) + self.mean_film)

    def touching(self, x) -> np.ndarray:
        """Share of the width in contact (n - 1,), averaged over each cell between neighbouring ``x`` (n,) [m], either way:
        the columns of the patch are finer than the cells of a film, and vary from one to the next."""
        step = self.x[1] - self.x[0] if self.x.size > 1 else 0.0
        edges = np.append(self.x - 0.5 * step, self.x[-1] + 0.5 * step)
        touched = np.append(0.0, np.cumsum(self.contact_fraction) * step)
        return np.diff(np.interp(x, edges, touched)) / np.diff(x)
