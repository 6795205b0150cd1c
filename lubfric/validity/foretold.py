"""The cautions and refusals that a result will have, foretold from closed forms. Nothing is solved."""

from __future__ import annotations

import numpy as np

from ..analytic import hertz
from ..film.shear import ShearForce
from ..line_contact import LineContact
from ..lubricant import carried_stress, shear_stress
from .beforehand import beforehand
from .bodies import of_motion
from .entry import Validity
from .film import of_pressure
from .stress import of_shear

NODES = 201


def foretold(scene, surface, speeds) -> tuple[tuple[float | None, Validity], ...]:
    """Pairs (speed [m/s], entry). The speed is None where the entry is about bodies or map. Films are Moes' films
    under the whole load."""
    found = [(None, entry) for entry in beforehand(scene, surface)]
    if scene.numerics.model == "deterministic":
        return tuple(found)
    bodies = scene.bodies
    for speed in speeds:
        if speed == 0:
            continue
        line = LineContact(bodies.load / bodies.width, bodies.radius, bodies.e_prime, speed, scene.lubricant)
        entries = [*of_motion(scene, speed, line.moes_film), *_of_film(scene, speed, line)]
        found += [(speed, entry) for entry in entries]
    return tuple(found)


def _of_film(scene, speed: float, line) -> list[Validity]:
    """Entries for a film of even thickness under the Hertz pressure."""
    bodies, lubricant, w = scene.bodies, scene.lubricant, scene.bodies.load / scene.bodies.width
    x = np.linspace(-1, 1, NODES) * bodies.half_width
    pressure = hertz.line_pressure(x, w, bodies.radius, bodies.e_prime)
    with np.errstate(over="ignore"):
        sliding = abs(scene.motion.slide_roll_ratio * speed)
        stress = np.minimum(shear_stress(lubricant, pressure, sliding / line.moes_film), 1e30)
    above = np.maximum(stress - carried_stress(pressure), 0.0)
    force, excess = (float(bodies.width * np.trapezoid(tau, x)) for tau in (stress, above))
    shear = ShearForce(force, 0.0, excess=excess, stress_ratio=float(np.max(stress / carried_stress(pressure))))
    newtonian = lubricant.eyring_stress is None and lubricant.limiting_stress_coefficient is None
    total = max(force, bodies.boundary_friction_coefficient * bodies.load)
    entries = of_shear(shear, bodies.load, total, scene.numerics.tolerance, newtonian)
    return [*of_pressure(lubricant, float(pressure.max())), *entries]
