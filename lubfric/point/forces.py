"""What resists the sliding at a balance, and how much of a film's error reaches it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..film.contract import FilmLevel
from ..film.shear import ShearForce
from ..heat.point import Heat, WarmFilm, point_heat
from ..scene import Scene
from .operating_point import Trial


@dataclass(frozen=True)
class Forces:
    """What resists the sliding: f = (boundary + shear.total)/F_T.

    sensitivity: relative error of f per relative error of the film, a (f_b F_H + |F_sh|)/(f F_T), where the rolling
    part of F_sh counts by its parts (`lubfric.film.shear.ShearForce`). a is what a change of
    the film at a given gap does to its load, 1 for a rigid film and up to ten times that for an elastic one, from
    the slope that the balance was found with. quadrature: estimated error of the sum that F_sh is, relative to f F_T
    (`lubfric.film.shear.ShearForce`). A pressure spike that the grid does not hold shows here and not in the film.
    heat: of inlet, film and surfaces, and what it changes.
    """

    coefficient: float
    boundary: float
    shear: ShearForce
    sensitivity: float
    quadrature: float = 0.0
    heat: Heat = Heat()


def forces(scene: Scene, level: FilmLevel, found: Trial, slope: float | None = None) -> Forces:
    """Boundary and viscous friction (paper, Eqs. 9-12) of a film of ``level`` and a contact that share the load,
    ``slope`` that of the balance."""
    shear = _shear(scene, level, found)
    heat, warm = point_heat(scene, found, abs(_boundary(scene, found.contact_load) + shear.total), shear)
    if warm is not None:
        shear = _shear(scene, level, found, warm)
    boundary = _boundary(scene, found.contact_load)
    total = abs(boundary + shear.total)
    viscous = abs(shear.couette) + max(abs(shear.rolling), shear.rolling_parts)
    moved = _boundary(scene, found.film_load) * (found.contact_load > 0) + viscous
    gain = 1.0
    if slope and found.contact_load > 0:
        gain = max(1.0, 0.5 * found.contact_load / (scene.bodies.load * slope))
    known = 0 < total < math.inf
    return Forces(
        (boundary + shear.total) / scene.bodies.load,
        boundary,
        shear,
        gain * moved / total if known else 1.0,
        shear.quadrature / total if known else 0.0,
        heat,
    )


def dry_forces(scene: Scene) -> Forces:
    """Friction of a contact that carries the whole load."""
    boundary = _boundary(scene, scene.bodies.load)
    return Forces(boundary / scene.bodies.load, boundary, ShearForce(0.0, 0.0), 0.0)


def _boundary(scene: Scene, load: float) -> float:
    """Friction [N] of contact spots that carry ``load`` [N]."""
    return scene.bodies.boundary_friction_coefficient * (scene.motion.slide_roll_ratio != 0) * load


def _shear(scene: Scene, level: FilmLevel, found: Trial, warm: WarmFilm | None = None) -> ShearForce:
    more: dict[str, Any] = {} if warm is None else {"warm": warm}
    with np.errstate(over="ignore", invalid="ignore"):  # a rigid film far above its range
        return level.shear(
            found.film,
            scene.lubricant,
            width=scene.bodies.width,
            slide_roll_ratio=scene.motion.slide_roll_ratio,
            cavitated=scene.numerics.cavitated_shear,
            contact_fraction=found.contact.touching,
            **more,
        )
