"""The nominally flat contact (paper, Sec. 3.1): one periodic contact curve under the film of the Hertz strip."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import ConvergenceError
from ..scene import Scene, budget
from .asperities import asperity_curve
from .contact_curve import ContactCurve, contact_curve
from .operator import half_space
from .rough_contract import ContactState, RoughContact, centred_axis, weighted_mean

POINTS = 512  # across the strip, where the film is averaged
COLUMNS = 2  # of the strip that say where it touches: evenly


@dataclass(frozen=True)
class FlatContact(RoughContact):
    """Roughness spread evenly over the Hertz strip of the total load.

    x [m] (nx,), weight (nx,): points across the strip, and the part of it that each stands for; area [m^2] of the
    strip: a load divided by it is a mean pressure of the curve; columns [m]: where it is said to touch.
    """

    curve: ContactCurve
    x: np.ndarray
    weight: np.ndarray
    area: float
    columns: np.ndarray

    def close(self, film, load, start=None, shape=None) -> ContactState:
        """Read from the curve; ``start`` and ``shape`` are not needed. Raises `ConvergenceError` for a load that the
        contact model of the curve cannot carry."""
        pressure, heaviest = load / self.area, float(self.curve.mean_pressure[0])
        if pressure > heaviest * (1 + 1e-12):
            raise ConvergenceError(f"the contact model carries {self.capacity:.4g} N at most, asked for {load:.4g} N")
        gap, touching, plastic = self.curve.at(min(pressure, heaviest))
        return ContactState(
            mean_gap=gap,
            mean_film=weighted_mean(film, self.weight),
            x=self.columns,
            contact_fraction=np.full(self.columns.size, touching),
            real_contact_area_fraction=touching,
            plastic_area_fraction=plastic,
            gap_error=self.curve.error_at(pressure),
            area_error=self.curve.area_error_at(pressure),
        )

    @property
    def name(self) -> str:
        return "flat periodic curve"

    @property
    def capacity(self) -> float:
        return float(self.curve.mean_pressure[0] * self.area)


def flat_contact(scene: Scene, heights, spacing) -> FlatContact:
    """The contact of ``scene``, with a curve for periodic ``heights`` [m] (nx, ny) about their mean."""
    bodies, numerics, contact = scene.bodies, scene.numerics, scene.contact
    half_width = bodies.half_width
    area = 2 * half_width * bodies.width
    given, limits = (heights, spacing, bodies.e_prime), {"heaviest": bodies.load / area, "hardness": bodies.hardness}
    if contact.model == "half-space":
        curve = contact_curve(
            *given,
            **limits,
            tolerance=numerics.tolerances.contact,
            accuracy=budget.CURVE * numerics.tolerance,
            operator=half_space(heights.shape, spacing, bodies.e_prime, workers=numerics.workers),
        )
    else:
        curve = asperity_curve(*given, **limits, definition=contact.model, reading=contact.asperity_separation)
    # The film is averaged over points that are even in the angle t, x = -b cos(t): a thin film opens over less than a
    # hundredth of the strip, at its ends.
    angle = (np.arange(POINTS) + 0.5) * (np.pi / POINTS)
    columns = centred_axis(COLUMNS, 2 * half_width / COLUMNS)
    return FlatContact(curve, -half_width * np.cos(angle), np.sin(angle), area, columns)
