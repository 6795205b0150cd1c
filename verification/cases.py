"""Smooth line contacts as arguments of the film solvers, in SI units: by their Moes numbers, or of a scene."""

import math

ALPHA, VISCOSITY, RADIUS, E_PRIME = 2.2e-8, 0.0358, 0.01, 2.2e11


def case_of_scene(scene, load: float, speed: float) -> dict:
    """The smooth film of a scene under a load [N] at an entrainment speed [m/s]."""
    bodies, oil = scene.bodies, scene.lubricant
    laws = ("viscosity", "pressure_viscosity_coefficient", "viscosity_law", "density_law")
    case = {"load_per_width": load / bodies.width, "radius": bodies.radius, "e_prime": bodies.e_prime}
    return case | {"entrainment_speed": speed} | {name: getattr(oil, name) for name in laws}


def case_of(M: float, L: float, law: str = "roelands", density: str = "constant") -> dict:
    """Arguments of the film solvers, in SI units, with the Moes numbers M and L. L = 0 is a constant viscosity."""
    law, effective = ("constant", 5.0) if L == 0 else (law, L)
    u1 = (effective / (ALPHA * E_PRIME)) ** 4
    return {
        "load_per_width": M * math.sqrt(u1) * E_PRIME * RADIUS,
        "radius": RADIUS,
        "e_prime": E_PRIME,
        "entrainment_speed": u1 * E_PRIME * RADIUS / (2 * VISCOSITY),
        "viscosity": VISCOSITY,
        "pressure_viscosity_coefficient": ALPHA,
        "viscosity_law": law,
        "density_law": density,
    }
