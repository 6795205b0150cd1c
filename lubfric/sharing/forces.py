"""The friction of a balance, and how strongly it depends on an error of the film."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..film import FilmLevel, ShearForce
from ..oil import log_viscosity_ratio
from ..scene import Scene
from .heat import Heat, WarmFilm, point_heat
from .operating_point import Trial


@dataclass(frozen=True)
class Forces:
    """The forces that resist sliding: f = (boundary + shear.total)/F_T.

    - ``sensitivity``: relative error of f per relative error of the film, a (f_b F_H + c |F_sh|)/(f F_T). The rolling
      part of F_sh counts by its parts (`lubfric.film.shear.ShearForce`). With the load, the film gives or takes contact
      area A: c = A/(1 - A) F_H/F_C, at least 1, since a thicker film shears less, over more area. The factor a is the
      change of a film's load by a change of the film at a given gap, from the slope with which the balance was found.
      It is 1 for a rigid film, and up to ten times that for an elastic one.
    - ``quadrature``: estimated error of F_sh by its sum over nodes, relative to f F_T. A pressure spike that the grid
      does not resolve shows here, and not in the film.
    - ``by_load``: relative error of f per relative error of the contact's mean gap, which changes only the division of
      the load (infinite: not known): a' (f_b F_H + (c + k - 1) |F_sh|)/(f F_T). Here a' is a without its lower bound
      of 1, and k = 1 + ln(eta_max/eta_0)/2 bounds how the film's friction changes with its load.
    - ``heat``: of inlet, film and surfaces, and what it changes.
    """

    coefficient: float
    boundary: float
    shear: ShearForce
    sensitivity: float
    quadrature: float = 0.0
    heat: Heat = Heat()
    by_load: float = math.inf

    @property
    def gap_sensitivity(self) -> float:
        """Relative error of f per relative error of the contact's mean gap: at most ``sensitivity``, and small where
        the contact carries little."""
        return min(self.sensitivity, self.by_load)


def forces(
    scene: Scene, level: FilmLevel, found: Trial, slope: float | None = None, gap_slope: float | None = None
) -> Forces:
    """Boundary and viscous friction (paper, Eqs. 9-12) of a film of ``level`` and a contact that share the load.
    ``slope``, ``gap_slope``: those of the balance."""
    shear = _shear(scene, level, found)
    heat, warm = point_heat(scene, found, abs(_boundary(scene, found.contact_load) + shear.total), shear)
    if warm is not None:
        shear = _shear(scene, level, found, warm)
    boundary = _boundary(scene, found.contact_load)
    total = abs(boundary + shear.total)
    moved = _boundary(scene, found.film_load) * (found.contact_load > 0) + shear.felt * max(1.0, _uncovered(found))
    gain, by_load, known, share = 1.0, math.inf, 0 < total < math.inf, found.contact_load / scene.bodies.load
    if slope and share > 0:
        gain = max(1.0, 0.5 * share / slope)
    if gap_slope and share > 0 and known:
        thickening = float(log_viscosity_ratio(scene.lubricant, found.film.pressure.max())[0])
        by_load = 0.5 * share / gap_slope * (moved + 0.5 * thickening * shear.felt) / total
    return Forces(
        (boundary + shear.total) / scene.bodies.load,
        boundary,
        shear,
        gain * moved / total if known else 1.0,
        shear.quadrature / total if known else 0.0,
        heat,
        by_load,
    )


def _uncovered(found: Trial) -> float:
    """Relative change of the open area by a contact load that changes by a share of the film's, over that share: the
    contact area A grows about in proportion to its load, so it is A/(1 - A) F_H/F_C. Where bodies are soft and the
    contact carries little, an error of the film is felt most by this."""
    area = found.contact.real_contact_area_fraction
    return area / (1 - area) * found.film_load / found.contact_load if found.contact_load > 0 and area < 1 else 0.0


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
