"""Whether a solution is an answer: the assumptions of the model, checked on one operating point."""

from __future__ import annotations

import math

from .balance import Balance
from .prepared import Prepared
from .validity import Validity
from .validity_solution import of_deflection, of_ends, of_film, of_motion, of_patches


def judged_validity(prepared: Prepared, speed: float, balance: Balance, ends: float) -> tuple[Validity, ...]:
    """Entries for every assumption that ``balance`` violates. Those about bodies and map (`Prepared.known`) come
    first. ``ends``: the share of the contact's load on the edge columns of its patch."""
    scene, film = prepared.scene, balance.film
    thickness = film.central_film if film is not None else math.nan
    entries = [*prepared.known, *of_motion(scene, speed, thickness), *of_ends(ends, prepared.surface.size[0])]
    entries += of_patches(scene, prepared.surface.heights, balance.contact.real_contact_area_fraction)
    if film is not None:
        peak, found = float(film.pressure.max()), balance.forces
        force = abs(found.coefficient) * scene.bodies.load
        entries += of_film(scene, thickness, peak, found.shear, balance.film_load, force, found.heat)
        if scene.numerics.film_deflection == "hydrodynamic" and balance.contact_load > 0:
            entries += of_deflection(scene, balance.contact.mean_gap)
    return tuple(entries)
