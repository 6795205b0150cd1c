"""The nominally flat contact (paper, Sec. 3.1): one periodic contact curve under the film of the Hertz strip."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import ConvergenceError, InputError
from ..scene import Scene, budget
from .asperity_curve import asperity_curve
from .contact_curve import ContactCurve, contact_curve
from .hertz_strip import centred_axis, weighted_mean
from .operator import half_space
from .rough_contract import ContactState, RoughContact

POINTS = 512  # across the strip, where the film is averaged
COLUMNS = 2  # of the strip that say where it touches: evenly
BEYOND = 1.5  # of the total load: how far a curve reaches when a film may be imposed on it
ROUNDING = 1e-9  # of a load that is the heaviest of the curve


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

    def carry(self, film, start=None, shape=None) -> tuple[float, ContactState]:
        """For a film thinner than the gap at the heaviest load of the curve, this is the load at the end of the curve:
        a lower bound, as the volume residual of the state shows."""
        load = self.curve.pressure_at(weighted_mean(film, self.weight)) * self.area
        return load, self.close(film, load)

    @property
    def name(self) -> str:
        return "flat periodic curve"

    @property
    def capacity(self) -> float:
        return float(self.curve.mean_pressure[0] * self.area)

    @property
    def nominally_flat(self) -> bool:
        return True

    def again(self, scene: Scene, old: Scene) -> FlatContact:
        """The curve under the Hertz strip of another load, if that is not heavier and the tolerance not tighter."""
        pressure, heaviest = scene.bodies.mean_hertz_pressure, float(self.curve.mean_pressure[0])
        if pressure > heaviest * (1 + ROUNDING):
            raise InputError(
                f"bodies.load = {scene.bodies.load:g} N needs {pressure:.4g} Pa of a contact curve that ends at "
                f"{heaviest:.4g} Pa; give a lighter load, or prepare the heaviest first"
            )
        if scene.numerics.tolerance < old.numerics.tolerance:
            raise InputError(
                f"numerics.tolerance = {scene.numerics.tolerance:g} is tighter than that of the contact curve; "
                f"give {old.numerics.tolerance:g} or more, or prepare again"
            )
        return _under_the_strip(scene, self.curve)


def flat_contact(scene: Scene, heights, spacing) -> FlatContact:
    """The contact of ``scene``, with a curve for periodic ``heights`` [m] (nx, ny) about their mean."""
    bodies, numerics, contact = scene.bodies, scene.numerics, scene.contact
    heaviest = bodies.load / (2 * bodies.half_width * bodies.width)
    heaviest *= BEYOND if numerics.closure == "separation" else 1.0
    if contact.model == "half-space":
        curve = contact_curve(
            heights,
            spacing,
            bodies.e_prime,
            heaviest=heaviest,
            hardness=bodies.hardness,
            tolerance=numerics.tolerances.contact,
            accuracy=budget.CURVE * numerics.tolerance,
            operator=half_space(heights.shape, spacing, bodies.e_prime, workers=numerics.workers),
        )
    else:
        curve = asperity_curve(
            heights,
            spacing,
            bodies.e_prime,
            heaviest=heaviest,
            definition=contact.model,
            reading=contact.asperity_separation,
            hardness=bodies.hardness,
        )
    return _under_the_strip(scene, curve)


def _under_the_strip(scene: Scene, curve: ContactCurve) -> FlatContact:
    """``curve`` under the Hertz strip of ``scene``. The film is averaged over points that are even in the angle t, x =
    -b cos(t): a thin film opens over less than a hundredth of the strip, at its ends."""
    half_width = scene.bodies.half_width
    angle = (np.arange(POINTS) + 0.5) * (np.pi / POINTS)
    columns = centred_axis(COLUMNS, 2 * half_width / COLUMNS)
    return FlatContact(curve, -half_width * np.cos(angle), np.sin(angle), 2 * half_width * scene.bodies.width, columns)
