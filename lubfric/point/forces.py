"""What resists the sliding at a balance, and how much of a film's error reaches it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..film.shear import ShearForce
from ..heat.point import Heat, WarmFilm, point_heat
from ..scene import Scene
from .balance import Balance


@dataclass(frozen=True)
class Forces:
    """What resists the sliding: f = (boundary + shear.total)/F_T.

    sensitivity: relative error of f per relative error of the film, a (f_b F_H + |F_sh|)/(f F_T). a is what a change of
    the film at a given gap does to its load, 1 for a rigid film and up to ten times that for an elastic one, from
    the slope that the balance was found with. quadrature: estimated error of the sum that F_sh is, relative to f F_T
    (`lubfric.film.shear.ShearForce`). A pressure spike that the grid does not hold shows here and not in the film. heat: of
    inlet, film and surfaces, and what it changes.
    """

    coefficient: float
    boundary: float
    shear: ShearForce
    sensitivity: float
    quadrature: float = 0.0
    heat: Heat = Heat()


def forces(scene: Scene, balance: Balance) -> Forces:
    """Boundary and viscous friction of a balance (paper, Eqs. 9-12)."""
    bodies, motion = scene.bodies, scene.motion
    sliding = bodies.boundary_friction_coefficient * (motion.slide_roll_ratio != 0)
    boundary = sliding * balance.contact_load
    shear = _shear(scene, balance)
    heat, warm = point_heat(scene, balance, abs(boundary + shear.total), shear)
    if warm is not None:
        shear = _shear(scene, balance, warm)
    total = abs(boundary + shear.total)
    moved = sliding * balance.film_load * (balance.contact_load > 0) + abs(shear.couette) + abs(shear.rolling)
    gain = 1.0
    if balance.slope and balance.contact_load > 0:
        gain = max(1.0, 0.5 * balance.contact_load / (bodies.load * balance.slope))
    known = 0 < total < math.inf
    return Forces(
        (boundary + shear.total) / bodies.load,
        boundary,
        shear,
        gain * moved / total if known else 1.0,
        shear.quadrature / total if known else 0.0,
        heat,
    )


def _shear(scene: Scene, balance: Balance, warm: WarmFilm | None = None) -> ShearForce:
    if balance.film is None:
        return ShearForce(0.0, 0.0)
    with np.errstate(over="ignore", invalid="ignore"):  # a rigid film far above its range
        return balance.level.shear(
            balance.film,
            scene.lubricant,
            width=scene.bodies.width,
            slide_roll_ratio=scene.motion.slide_roll_ratio,
            cavitated=scene.numerics.cavitated_shear,
            contact_fraction=balance.contact.touching,
            **({} if warm is None else {"warm": warm}),
        )
