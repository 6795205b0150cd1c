"""Which limits of the load-sharing model a balance is beyond."""

import math

from ..shared import (
    Prepared,
    Violation,
    typical_heat,
    violations_by_asperities,
    violations_by_deflection,
    violations_by_ends,
    violations_by_film,
    violations_by_inlet,
    violations_by_motion,
    violations_by_patches,
    violations_by_typical_heat,
)
from .balance import Balance


def limits_exceeded(
    prepared: Prepared, speed: float, balance: Balance, *, ends: float, asperity_pressure: float
) -> tuple[Violation, ...]:
    """Return the limits of load sharing that ``balance`` exceeds, those about bodies and map (`Prepared.violations`)
    first. ``ends``: the share of the contact's load on the edge columns of its patch; ``asperity_pressure`` [Pa]: the
    highest of its cells."""
    scene = prepared.scene
    film = balance.film
    thickness = film.central_film if film is not None else math.nan
    violations = [
        *prepared.violations,
        *violations_by_motion(scene, speed, thickness),
        *violations_by_ends(scene, ends, prepared.surface),
        *violations_by_asperities(scene, asperity_pressure),
    ]
    violations += violations_by_patches(
        scene, prepared.surface.heights, balance.contact_state.real_contact_area_fraction
    )
    if film is not None:
        peak = float(film.pressure.max())
        forces = balance.forces
        force = abs(forces.coefficient) * scene.bodies.load
        violations += violations_by_inlet(scene, film.line, film.flow_film, force)
        violations += violations_by_film(
            scene,
            thickness=thickness,
            peak=peak,
            shear=forces.shear,
            film_load=balance.film_load,
            force=force,
            heat=forces.heat,
        )
        typical = typical_heat(
            scene, film, balance.contact_state, contact_load=balance.contact_load, force=force, shear=forces.shear
        )
        violations += violations_by_typical_heat(scene, typical)
        if scene.numerics.film_deflection == "hydrodynamic" and balance.contact_load > 0:
            violations += violations_by_deflection(scene, balance.contact_state.mean_gap)
    return tuple(violations)
