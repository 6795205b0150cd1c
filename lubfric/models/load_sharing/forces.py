"""The friction of a film and a contact that share the load (paper, Eqs. 9-12)."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...contact import ContactState
from ...film import EHLResult, ElasticContact, ShearForce, disc_compliance, shear_force
from ...scene import Scene
from ..shared import Heat, point_heat

# Nodes of the asperity pressure where the contact has no cells. Not measured: their limits are scaled to f_b F_C, with
# any number of them.
HERTZ_NODES = 101


@dataclass(frozen=True, kw_only=True)
class Forces:
    """The forces that resist sliding: f = (boundary + shear.total)/F_T.

    Attributes
    ----------
    coefficient : f [-]
    boundary : boundary friction of the asperity contacts [N]
    shear : shear of the film
    quadrature : estimated error of the shear force by its sum over nodes, relative to f F_T. A pressure spike that the
        grid does not resolve shows here, and not in the film
    heat : of inlet, film and surfaces, and what it changes
    """

    coefficient: float
    boundary: float
    shear: ShearForce
    quadrature: float = 0.0
    heat: Heat = Heat()

    @property
    def total(self) -> float:
        """|f F_T| [N]."""
        return abs(self.boundary + self.shear.total)

    @property
    def film_sensitivity(self) -> float:
        """Relative change of f by a relative change of the film at a given division of the load, at most."""
        return self.shear.magnitude / self.total if 0 < self.total < np.inf else 1.0


def forces_of(scene: Scene, film: EHLResult | None, contact_state: ContactState, contact_load: float) -> Forces:
    """Return the forces of ``film`` (None: none) and of a contact that carries ``contact_load`` [N]."""
    bodies = scene.bodies
    slides = scene.motion.slide_roll_ratio != 0
    boundary = bodies.boundary_friction_coefficient * contact_load if slides else 0.0
    if film is None:
        return Forces(coefficient=boundary / bodies.load, boundary=boundary, shear=ShearForce(couette=0.0, rolling=0.0))
    elastic = _elastic(scene, film, contact_state, contact_load)
    shear = _shear(scene, film, contact_state, elastic=elastic)
    boundary *= shear.asperity_share
    point = point_heat(
        scene, film, contact_state, contact_load=contact_load, force=abs(boundary + shear.total), shear=shear
    )
    if point.inlet_viscosity is not None or point.stress is not None:
        shear = _shear(scene, film, contact_state, elastic=elastic, warm=point.inlet_viscosity, stress=point.stress)
    total = abs(boundary + shear.total)
    quadrature = shear.quadrature / total if 0 < total < np.inf else 0.0
    return Forces(
        coefficient=(boundary + shear.total) / bodies.load,
        boundary=boundary,
        shear=shear,
        quadrature=quadrature,
        heat=point.heat,
    )


def _elastic(scene: Scene, film: EHLResult, contact_state: ContactState, contact_load: float) -> ElasticContact | None:
    """Return the discs and asperities that shear elastically, where the lubricant has a shear modulus.

    The mean asperity pressure across the width is that of the contact's cells, or Hertz's with the asperity load.
    """
    if scene.lubricant.shear_modulus is None:
        return None
    bodies = scene.bodies
    half_width = bodies.half_width
    direction = np.copysign(1.0, film.entrainment_speed)
    if contact_state.fields is not None:
        x = contact_state.x * direction
        mean = contact_state.fields.pressure.mean(axis=1)
    else:
        x = np.linspace(-1.0, 1.0, HERTZ_NODES) * half_width
        mean = np.sqrt(np.maximum(half_width**2 - x**2, 0.0))
    order = np.argsort(x)
    load = np.trapezoid(mean[order], x[order]) * bodies.width
    scale = bodies.boundary_friction_coefficient * contact_load / load if load > 0 else 0.0
    return ElasticContact(
        compliance=disc_compliance(half_width, bodies.e_prime),
        x=x[order],
        asperity_limit=scale * mean[order],
    )


def _shear(
    scene: Scene,
    film: EHLResult,
    contact_state: ContactState,
    *,
    elastic: ElasticContact | None,
    warm: float | None = None,
    stress: Callable[..., Any] | None = None,
) -> ShearForce:
    """Return the shear force of ``film`` beside the asperity contacts of ``contact_state``."""
    with np.errstate(over="ignore", invalid="ignore"):  # stresses far above the range of the law, reported by `excess`
        return shear_force(
            film,
            scene.lubricant,
            width=scene.bodies.width,
            slide_roll_ratio=scene.motion.slide_roll_ratio,
            cavitated=scene.numerics.cavitated_shear,
            contact_fraction=contact_state.touching,
            warm=warm,
            heated=stress,
            elastic=elastic,
        )
