"""Is a solution an answer? The model's assumptions, checked on one operating point."""

from __future__ import annotations

import math

from ..prepared import Prepared
from ..validity.entry import Validity
from ..validity.solution import STRIP_SHARE, of_deflection, of_heat, of_motion, of_pressure, of_shear, of_thickness
from .balance import Balance
from .deflection import strip_rise


def judged_validity(prepared: Prepared, speed: float, balance: Balance) -> tuple[Validity, ...]:
    """Entries for everything that does not hold at ``balance``. Those of bodies and map (`Prepared.known`) come
    first."""
    scene, film = prepared.scene, balance.film
    thickness = film.central_film if film is not None else math.nan
    entries = [*prepared.known, *of_motion(scene, speed, thickness)]
    if film is not None:
        entries += of_pressure(scene.lubricant, float(film.pressure.max()))
        entries += of_thickness(scene.bodies, thickness)
        force = abs(balance.forces.coefficient) * scene.bodies.load
        entries += of_shear(scene, balance.forces.shear, balance.film_load, force)
        entries += of_heat(balance.forces.heat, scene.motion.slide_roll_ratio, scene.numerics.tolerance)
        if scene.numerics.film_deflection == "hydrodynamic":
            entries += of_deflection(strip_rise(scene, balance), STRIP_SHARE)
    return tuple(entries)
