"""The cautions and refusals that a result will have, predicted from closed forms. Nothing is solved."""

from __future__ import annotations

import numpy as np

from ..film import ShearForce, hertz
from ..oil import carried_stress, shear_stress
from .validity import Validity
from .validity_beforehand import beforehand
from .validity_solution import of_motion, of_pressure, of_shear

NODES = 201


def foretold(scene, surface, speeds) -> tuple[tuple[float | None, Validity], ...]:
    """Pairs (speed [m/s], entry). The speed is None if the entry is about bodies or map. Films are Moes' films under
    the whole load."""
    found = [(None, entry) for entry in beforehand(scene, surface)]
    if scene.numerics.model == "deterministic":
        return tuple(found)
    for speed in speeds:
        if speed == 0:
            continue
        film = scene.line_contact(speed).moes_film
        entries = [*of_motion(scene, speed, film), *_of_film(scene, speed, film)]
        found += [(speed, entry) for entry in entries]
    return tuple(found)


def _of_film(scene, speed: float, film: float) -> list[Validity]:
    """Entries for a ``film`` [m] of even thickness under the Hertz pressure."""
    bodies, lubricant, w = scene.bodies, scene.lubricant, scene.bodies.load / scene.bodies.width
    x = np.linspace(-1, 1, NODES) * bodies.half_width
    pressure = hertz.line_pressure(x, w, bodies.radius, bodies.e_prime)
    with np.errstate(over="ignore"):
        sliding = abs(scene.motion.slide_roll_ratio * speed)
        stress = np.minimum(shear_stress(lubricant, pressure, sliding / film), 1e30)
    above = np.maximum(stress - carried_stress(pressure), 0.0)
    force, excess = (float(bodies.width * np.trapezoid(tau, x)) for tau in (stress, above))
    shear = ShearForce(force, 0.0, excess=excess, stress_ratio=float(np.max(stress / carried_stress(pressure))))
    total = max(force, bodies.boundary_friction_coefficient * bodies.load)
    return [*of_pressure(scene, float(pressure.max())), *of_shear(scene, shear, bodies.load, total)]
