"""Wiring of the smooth film and of its shear, in steady motion."""

from collections.abc import Iterator

import numpy as np

import lubfric
from lubfric.film import EHLResult

from ...check import Item, compared
from ...fem import parts
from ...fem.solvers.fluid import Fluid
from ...types import Keywords

OTHER = "differential deflection, called by itself"
OWN = "own integral over the film that was found"
FIXED = {
    "model": "paper",
    "film_deflection": "hydrodynamic",
    "heat": "off",
    "accept": True,
    "tolerance": 1e-3,
    "sampling": "patch",
    "grid": "given",
}
PAPER = {"viscosity": 0.36, "pressure_viscosity_coefficient": 25e-9}
LAWS: dict[str, Keywords] = {
    "Roelands": {},
    "Barus": {"viscosity_law": "barus"},
    "constant viscosity": {"viscosity_law": "constant", "pressure_viscosity_coefficient": 0.0},
    "Dowson-Higginson": {"density_law": "dowson-higginson"},
    "half of alpha": {"pressure_viscosity_coefficient": 12e-9},
}
SHEARED: dict[str, tuple[Keywords, Keywords]] = {
    "Newtonian": ({}, {}),
    "Eyring": ({"eyring_stress": 1e6}, {}),
    "limiting stress": ({"limiting_stress_coefficient": 0.02, "limiting_stress_offset": 2e5}, {}),
    "slide-roll 0.5": ({}, {"slide_roll_ratio": 0.5}),
}


def wiring_film(level: str) -> Iterator[Item]:
    """Laws of the oil in the film of `friction`, against another discretisation that is called with plain numbers.

    The shear force, with each law of shear, is held against an integral of its own with the columns in contact taken
    out.
    """
    for name, oil in LAWS.items():
        yield from film(name, oil)
    for name, (oil, motion) in SHEARED.items():
        yield from shear(name, oil, motion)


def smooth(oil: Keywords, load: float = 300.0, shape: tuple[int, int] = (160, 12)) -> lubfric.Scene:
    """Return the paper's cylinder nearly without contact; 300 N is a Hertz pressure of 960 MPa."""
    return lubfric.load_scene("paper").with_(
        bodies={"load": load, "hardness": None},
        lubricant=oil,
        surface={"sq": 1e-9, "correlation_length": 4e-6, "acf": "gaussian"},
        contact={"shape": shape, "spacing": 1.6e-6},
        numerics=FIXED,
    )


def film(name: str, oil: Keywords) -> Iterator[Item]:
    """Smallest film at 0.3 m/s."""
    s = smooth(oil)
    b = s.bodies
    point = lubfric.friction(s, 0.3)
    body: Keywords = {"load_per_width": 300.0 / b.width, "radius": b.radius, "e_prime": b.e_prime}
    other = lubfric.solve_differential_deflection(**body | PAPER | oil, entrainment_speed=0.3, tolerance=3e-3)
    rows = [
        ("flow film", "m", parts.film(point).flow_film, other.flow_film, 5e-3),
        ("smallest film", "m", point.min_film, other.min_film, 6e-3),
    ]
    yield from compared(name, rows, OTHER)


def mixed(oil: Keywords, motion: Keywords) -> lubfric.Scene:
    """Return a rough cylinder of 350 MPa, between boundary and full film."""
    return lubfric.load_scene("paper").with_(
        bodies={"load": 20.0, "radius": 1e-3, "hardness": None},
        lubricant=oil,
        motion=motion,
        surface={"correlation_length": 4e-6},
        contact={"shape": (32, 32), "spacing": 1.4e-6},
        numerics=FIXED,
    )


def shear(name: str, oil: Keywords, motion: Keywords) -> Iterator[Item]:
    """Shear force and coefficient at 0.1 m/s."""
    s = mixed(oil, motion)
    speed = 0.1
    pieces = 40
    point = lubfric.friction(s, speed, fields=True)
    line = parts.film(point)
    contact = parts.contact(point)
    fields = parts.contact_fields(point)
    x = np.sort(np.concatenate([np.linspace(a, b, pieces, endpoint=False) for a, b in zip(line.x[:-1], line.x[1:])]))
    x = x[x < line.rupture]
    middle = 0.5 * (x[1:] + x[:-1])
    dx = np.diff(x)
    p = np.interp(middle, line.x, line.pressure)
    h = line.film_at(middle)
    rate = s.motion.slide_roll_ratio * speed / h
    column = np.round((middle - contact.x[0]) / (contact.x[1] - contact.x[0])).astype(int)
    inside = (column >= 0) & (column < contact.x.size)
    pressed = (fields.pressure > 0).mean(axis=1)
    wet = 1 - np.where(inside, pressed[np.clip(column, 0, contact.x.size - 1)], 0.0)
    couette = s.bodies.width * float(np.sum(Fluid.of(PAPER | oil).stress(p, rate) * wet * dx))
    couette += s.bodies.width * 0.36 * s.motion.slide_roll_ratio * speed * upstream(line, s.bodies.radius)
    boundary = 0.09 * fields.pressure.mean() * fields.pressure.shape[0] * 1.4e-6 * s.bodies.width
    f = (boundary + couette + point.rolling_force) / 20.0
    rows = [
        ("Couette force", "N", point.couette_force, couette, 4e-3),
        ("coefficient", "1", point.coefficient, f, 2e-3),
    ]
    yield from compared(name, rows, OWN)


def upstream(line: EHLResult, radius: float) -> float:
    """Return ∫ dx/h before the first node of a parabola."""
    a = -line.x[0]
    h = line.film_thickness[0]
    x = a * np.geomspace(1.0, 1e4, 4001)
    gap = h + (x**2 - a**2) / (2 * radius)
    return float(np.trapezoid(1 / gap, x) + 2 * radius / x[-1])
