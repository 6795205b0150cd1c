"""The rolling contacts of the campaign: six kinds by name, and random ones by number."""

import math
from dataclasses import dataclass

import numpy as np

import lubfric
from lubfric.models.deterministic import reach
from lubfric.scene import Scene

from ...fem.parts import halved
from ...types import Keywords, Option

# Random contacts are drawn from these ranges, with uniform logarithms: from thin lubrication to nearly full films, from
# light contacts to those of bearings and gears.
RADIUS = (3e-3, 15e-3)  # m
PRESSURE = (0.25e9, 1.15e9)  # Pa, of the Hertz contact
HEAVY = (0.85e9, 1.15e9)  # Pa, of every second contact
LAMBDA = (0.25, 1.6)  # Moes' film of the whole load over Sq
SQ = (8e-8, 4e-7)  # m, of both bodies together
LENGTH = (10e-6, 40e-6)  # m, of correlation
BOUNDARY_FILM = (1e-8, 4e-8)  # m
SLIP = (5e-3, 2.0)  # slide-roll ratio, of either sign

# Hertz half-widths in a correlation length, at least and at most.
HALF_WIDTHS = (1.5, 6.0)

# Columns of an answer's grid, at most: a contact with more is drawn again.
MOST_COLUMNS = 160

# How the name of a random contact begins; its number follows.
RANDOM = "random "

PER_LENGTH = 4.0  # cells of the map in a correlation length
CELLS = 80  # of the map, along x and y


@dataclass(frozen=True)
class RollingContact:
    """A rolling contact: its scene, its speed [m/s], and whether it is heavily loaded, at 1 GPa."""

    name: str
    scene: Scene
    speed: float
    heavy: bool = False


def _contact(name: str, speed: float, *, heavy: bool = False, **sections: Option) -> RollingContact:
    """Return a contact of steel bodies with a stated boundary film, so that only cells and sample are uncertain."""
    bodies = {"boundary_film": 2e-8, "hardness": None, "boundary_friction_coefficient": 0.12} | sections.pop("bodies")
    scene = lubfric.load_scene("paper").with_(bodies=bodies, **sections)
    return RollingContact(name, scene, speed, heavy)


def contacts() -> tuple[RollingContact, ...]:
    """Return the contacts; the surfaces have no seeds of their own yet."""
    return (
        _contact(
            "needle roller",
            2.0,
            heavy=True,
            bodies={"radii": (3e-3, 30e-3), "width": 10e-3, "load": 800.0, "material": "steel"},
            lubricant={"viscosity": 0.0105, "pressure_viscosity_coefficient": 17e-9, "eyring_stress": 5e6},
            motion={"slide_roll_ratio": 0.01},
            surface={"sq": 1.88e-7, "correlation_length": 20e-6, "acf": "gaussian"},
            counterface={"sq": 1.0e-7, "correlation_length": 20e-6, "acf": "gaussian"},
            contact={"shape": (100, 100), "spacing": 5e-6},
        ),
        _contact(
            "roller bearing",
            3.0,
            heavy=True,
            bodies={"radii": (6e-3, 30e-3), "width": 14e-3, "load": 2000.0, "material": "steel"},
            lubricant={
                "viscosity": 0.018,
                "pressure_viscosity_coefficient": 18e-9,
                "eyring_stress": 5e6,
                "limiting_stress_coefficient": 0.06,
            },
            motion={"slide_roll_ratio": 0.1},
            surface={"sq": 2.5e-7, "correlation_length": 30e-6, "acf": "gaussian"},
            counterface={"sq": 1.2e-7, "correlation_length": 30e-6, "acf": "gaussian"},
            contact={"shape": (80, 80), "spacing": 7e-6},
        ),
        _contact(
            "gear flank",
            2.5,
            bodies={"radii": (8e-3, 14e-3), "width": 14e-3, "load": 1750.0, "material": "steel"},
            lubricant={
                "viscosity": 0.03,
                "pressure_viscosity_coefficient": 18e-9,
                "eyring_stress": 5e6,
                "limiting_stress_coefficient": 0.05,
            },
            motion={"slide_roll_ratio": 0.4},
            surface={"sq": 3e-7, "correlation_length": 25e-6, "acf": "gaussian"},
            counterface={"sq": 3e-7, "correlation_length": 25e-6, "acf": "gaussian"},
            contact={"shape": (96, 96), "spacing": 6e-6},
        ),
        _contact(
            "light contact",
            0.6,
            bodies={"radius": 5e-3, "width": 10e-3, "load": 150.0, "material": "steel"},
            lubricant={"viscosity": 0.05, "pressure_viscosity_coefficient": 15e-9, "eyring_stress": 5e6},
            motion={"slide_roll_ratio": -0.5},
            surface={"sq": 1.5e-7, "correlation_length": 15e-6, "acf": "gaussian"},
            contact={"shape": (80, 80), "spacing": 3.5e-6},
        ),
        _contact(
            "sliding roller",
            1.5,
            bodies={"radius": 6e-3, "width": 10e-3, "load": 500.0, "material": "steel"},
            lubricant={
                "viscosity": 0.02,
                "pressure_viscosity_coefficient": 16e-9,
                "limiting_stress_coefficient": 0.08,
            },
            motion={"slide_roll_ratio": 1.0},
            surface={"sq": 1.2e-7, "correlation_length": 20e-6, "acf": "gaussian"},
            contact={"shape": (80, 80), "spacing": 5e-6},
        ),
        _contact(
            "exponential surface",
            1.0,
            bodies={"radius": 6e-3, "width": 10e-3, "load": 700.0, "material": "steel"},
            lubricant={"viscosity": 0.03, "pressure_viscosity_coefficient": 18e-9, "eyring_stress": 8e6},
            motion={"slide_roll_ratio": 0.1},
            surface={"sq": 2e-7, "correlation_length": 45e-6, "acf": "exponential"},
            contact={"shape": (96, 96), "spacing": 5e-6},
        ),
    )


def random_contact(number: int) -> RollingContact:
    """Return the random rolling contact of this ``number``; every second is heavily loaded, and
    every third slides at a slide-roll ratio of 1 to 2."""
    rng = np.random.default_rng([45, number])

    def between(low: float, high: float) -> float:
        return float(math.exp(rng.uniform(math.log(low), math.log(high))))

    while True:
        radius = between(*RADIUS)
        pressure = between(*(PRESSURE if number % 2 else HEAVY))
        sq = between(*SQ)
        length = between(*LENGTH)
        ratio = between(*LAMBDA)
        slip = between(1.0, SLIP[1]) if number % 3 == 2 else between(SLIP[0], 1.0)
        sign = 1.0 if rng.random() < 0.6 else -1.0
        film = between(*BOUNDARY_FILM)
        oil: Keywords = {
            "viscosity": between(0.01, 0.08),
            "pressure_viscosity_coefficient": rng.uniform(14e-9, 24e-9),
            "eyring_stress": between(4e6, 10e6),
        }
        if rng.random() < 0.5:
            oil["limiting_stress_coefficient"] = rng.uniform(0.05, 0.1)
        acf = "exponential" if rng.random() < 0.2 else "gaussian"
        has_two = rng.random() < 0.5
        of_each = sq / math.sqrt(2.0) if has_two else sq
        rough = {"sq": of_each, "correlation_length": length, "acf": acf}
        sections: Keywords = {
            "bodies": {
                "radius": radius,
                "width": 10e-3,
                "material": "steel",
                "hertz_pressure": pressure,
                "boundary_film": film,
                "hardness": None,
                "boundary_friction_coefficient": 0.12,
            },
            "lubricant": oil,
            "motion": {"slide_roll_ratio": sign * slip},
            "surface": rough,
            "contact": {"shape": (CELLS, CELLS), "spacing": length / PER_LENGTH},
        }
        if has_two:
            sections["counterface"] = rough
        scene = lubfric.load_scene("paper").with_(**sections)
        if not HALF_WIDTHS[0] * length <= scene.bodies.half_width <= HALF_WIDTHS[1] * length:
            continue
        speed = _speed_of_film(scene, ratio * sq)
        if sum(reach(scene.line_contact(speed), sq)) * PER_LENGTH / length <= MOST_COLUMNS:
            return RollingContact(f"{RANDOM}{number}", scene, speed, pressure >= HEAVY[0])


def _speed_of_film(scene: Scene, film: float) -> float:
    """Return the speed U [m/s] at which the smooth film of ``scene`` is this ``film`` [m]."""
    return halved(1e-5, 1e3, lambda u: scene.line_contact(u).moes_film < film)


def contact_named(name: str) -> RollingContact:
    """Return the contact of this ``name``: one of `contacts`, or "random" and a number."""
    if name.startswith(RANDOM):
        return random_contact(int(name.removeprefix(RANDOM)))
    return {contact.name: contact for contact in contacts()}[name]
