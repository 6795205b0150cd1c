"""Wiring of the transient: what does not change leaves the steady state alone, and what changes ends in the new one."""

from collections.abc import Iterator

import lubfric
from lubfric.estimate import FrictionResult
from lubfric.scene import Ramp
from lubfric.time import TransientResult

from ...check import Item, compared
from ...types import Keywords
from .film import mixed, smooth

UNCHANGED = {  # unit and relative tolerance
    "coefficient": ("1", 5e-3),
    "couette_force": ("N", 1e-2),
    "film_load": ("N", 1e-2),
    "contact_load": ("N", 1e-2),
    "mean_gap": ("m", 5e-3),
    "min_film": ("m", 5e-3),
}
RAMPED = {
    "coefficient": ("1", 2e-2),
    "couette_force": ("N", 2e-2),
    "min_film": ("m", 1e-2),
    "central_film": ("m", 1e-2),
}
OILS: dict[str, Keywords] = {
    "Newtonian": {},
    "Eyring": {"eyring_stress": 2e5},
    "limiting stress": {"limiting_stress_coefficient": 0.002, "limiting_stress_offset": 5e4},
    "Dowson-Higginson": {"density_law": "dowson-higginson"},
    "Barus": {"viscosity_law": "barus"},
}
TIGHT = {"film_tolerance": 1e-3}


def wiring_time(level: str) -> Iterator[Item]:
    """A transient in which nothing changes, with each law of the oil, against the steady coefficient.

    In another one load, radius, viscosity, speed and sliding ramp at once. It ends in the steady state of the new
    values.
    """
    for name, oil in OILS.items():
        yield from unchanged(name, oil)
    yield from ramped()


def unchanged(name: str, oil: Keywords) -> Iterator[Item]:
    """Mixed lubrication at 0.1 m/s, a slide-roll ratio of 0.5, for a fifth of a passage of the contact."""
    s = mixed(oil, {"slide_roll_ratio": 0.5, "entrainment_speed": 0.1}).with_(numerics=TIGHT)
    steady = lubfric.friction(s)
    run = lubfric.transient(s, [1e-5])
    yield from ended(f"{name}, nothing changes", run, steady, UNCHANGED)


def ended(
    label: str, run: TransientResult, steady: FrictionResult, tolerances: dict[str, tuple[str, float]]
) -> Iterator[Item]:
    """Compare the last values of a run in time with the steady ones."""
    rows = [
        (what.replace("_", " "), unit, float(getattr(run, what)[-1]), getattr(steady, what), tolerance)
        for what, (unit, tolerance) in tolerances.items()
    ]
    yield from compared(label, rows, "lubfric.friction, steady")


def ramped() -> Iterator[Item]:
    """All histories at once. The film forgets within a few passages of the contact."""
    end = 2e-3

    def ramp(first: float, last: float) -> Ramp:
        return Ramp(start=first, end=last, begin=0.0, until=1e-4)

    ramps: Keywords = {"speed": ramp(0.2, 0.3), "sliding": ramp(0.1, 0.06)}
    bodies: Keywords = {"load": ramp(30.0, 22.0), "radius": ramp(2e-3, 1.5e-3), "viscosity": ramp(0.36, 0.25)}
    plan = lubfric.Transient(duration=end, outputs=1, **ramps, **bodies)
    scene = smooth({"eyring_stress": 2e6}, 30.0, (64, 12)).with_(motion={"slide_roll_ratio": 0.5}, numerics=TIGHT)
    run = lubfric.transient(scene.with_(transient=plan))
    oil = {"viscosity": 0.25}
    motion = {"entrainment_speed": 0.3, "slide_roll_ratio": 0.2}
    later = scene.with_(bodies={"load": 22.0, "radius": 1.5e-3}, lubricant=oil, motion=motion)
    yield from ended("ramps", run, lubfric.friction(later), RAMPED)
