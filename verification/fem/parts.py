"""What several studies share: smooth line contacts as arguments of the film solvers, in SI units; and the parts of a
result and of a model that a study needs. A missing part ends the study with a message."""

import math
from collections.abc import Callable
from typing import TypeVar

import numpy as np

from lubfric.contact import ContactResult, ContactState, HalfSpaceContact, solve_contact
from lubfric.estimate import FrictionResult
from lubfric.film import EHLResult, LineContact
from lubfric.models.shared import Prepared
from lubfric.oil import Lubricant
from lubfric.scene import Scene

from ..types import Keywords, PlainRow
from . import exact_contact

T = TypeVar("T")
ALPHA = 2.2e-8  # 1/Pa, pressure-viscosity coefficient of a mineral oil
VISCOSITY = 0.0358  # Pa s
RADIUS = 0.01  # m
E_PRIME = 2.2e11  # Pa, E' of two steel bodies


def the(part: T | None, name: str) -> T:
    """Return ``part``; raises ValueError where there is none."""
    if part is None:
        raise ValueError(f"this study needs a {name}, and there is none")
    return part


def film(result: FrictionResult) -> EHLResult:
    """Return the smooth film of a point with entrainment."""
    return the(the(result.balance, "balance").film, "film")


def contact(result: FrictionResult) -> ContactState:
    """Return the rough contact of a point."""
    return the(result.balance, "balance").contact_state


def contact_fields(result: FrictionResult) -> ContactResult:
    """Return pressure and gap on the contact grid, of a point in contact."""
    return the(contact(result).fields, "contact with fields")


def half_space(model: Prepared) -> HalfSpaceContact:
    """Return the rough contact of a scene under a cylinder, on a height map."""
    if not isinstance(model.rough_contact, HalfSpaceContact):
        raise TypeError(f"this study needs a contact of half-spaces, not {type(model.rough_contact).__name__}")
    return model.rough_contact


def line_contact(case: Keywords) -> LineContact:
    """Return the contact of arguments of `solve_ehl`, which may have an ``eyring_stress`` as well."""
    laws = ("viscosity", "pressure_viscosity_coefficient", "viscosity_law", "density_law", "eyring_stress")
    oil = Lubricant(**{name: case[name] for name in laws if name in case})
    return LineContact(
        load_per_width=case["load_per_width"],
        radius=case["radius"],
        e_prime=case["e_prime"],
        entrainment_speed=case["entrainment_speed"],
        lubricant=oil,
    )


def moes_unit(speed: float) -> float:
    """Return the film [m] that is 1 in Moes' units at this entrainment ``speed``, in the cases of `case_of`."""
    return math.sqrt(2 * VISCOSITY * speed / (E_PRIME * RADIUS)) * RADIUS


def halved(low: float, high: float, below: Callable[[float], bool], times: int = 60) -> float:
    """Return the value between two positive ones up to which ``below`` holds, by bisection of its logarithm."""
    for _ in range(times):
        middle = math.sqrt(low * high)
        low, high = (middle, high) if below(middle) else (low, middle)
    return low


def pressed_cylinder(
    line: exact_contact.Line, across: float, hardness: float | None = None
) -> tuple[np.ndarray, ContactResult]:
    """Return x [m], and a cylinder pressed dry by `solve_contact` in a box four half-widths wide, with ``across`` cells
    in one."""
    dx = line.half_width / across
    n = 2 * int(2 * across)
    x = (np.arange(n) - (n - 1) / 2) * dx
    settings: Keywords = {"mean_pressure": line.load / (n * dx), "boundary": ("free", "periodic"), "tolerance": 1e-8}
    gap0 = np.tile(x[:, None] ** 2 / (2 * line.radius), (1, 4))
    return x, solve_contact(gap0, dx, line.e_prime, hardness=hardness, **settings)


def case_of_scene(scene: Scene, load: float, speed: float) -> PlainRow:
    """Return the smooth film of a scene under a load [N] at an entrainment speed [m/s]."""
    bodies = scene.bodies
    oil = scene.lubricant
    laws = ("viscosity", "pressure_viscosity_coefficient", "viscosity_law", "density_law")
    case = {"load_per_width": load / bodies.width, "radius": bodies.radius, "e_prime": bodies.e_prime}
    return case | {"entrainment_speed": speed} | {name: getattr(oil, name) for name in laws}


def case_of(M: float, L: float, law: str = "roelands", density: str = "constant") -> PlainRow:
    """Return arguments of the film solvers, in SI units, with the Moes numbers M and L. L = 0 is a constant
    viscosity."""
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
