"""Likely slips: values far from what machines have, and the unit in which they may have been meant.

A value outside the usual range is no error: it gets a sentence that names the unit in which it would be usual. The
ranges are wide: those of machines and test rigs with line contacts, with a margin of a few times on both sides.
"""

from __future__ import annotations

from contextlib import contextmanager
from dataclasses import dataclass

from ..errors import ConvergenceError, InputError

MICRO, NANO, GIGA = 1e-6, 1e-9, 1e9


@dataclass(frozen=True)
class Usual:
    """Usual range of a quantity in SI, its unit, units that are mistaken for it with their factors, and the key to give
    instead."""

    low: float
    high: float
    unit: str
    others: tuple[tuple, ...] = ()

    def holds(self, value: float) -> bool:
        """True inside the range."""
        return self.low <= abs(value) <= self.high


USUAL = {
    "bodies.radius": Usual(2e-4, 1.0, "m", (("mm", 1e-3), ("um", MICRO))),
    "bodies.radii": Usual(2e-4, 3.0, "m", (("mm", 1e-3),)),
    "bodies.width": Usual(1e-4, 1.0, "m", (("mm", 1e-3),)),
    "bodies.load": Usual(0.3, 1e6, "N", (("kN", 1e3), ("MN", 1e6))),
    "bodies.e_prime": Usual(1e8, 1.3e12, "Pa", (("GPa", GIGA), ("MPa", 1e6))),
    "bodies.young_modulus": Usual(1e8, 1.3e12, "Pa", (("GPa", GIGA), ("MPa", 1e6))),
    "bodies.hertz_pressure": Usual(1e6, 5e9, "Pa", (("GPa", GIGA), ("MPa", 1e6))),
    "bodies.hardness": Usual(2e7, 5e10, "Pa", (("GPa", GIGA), ("HV", 10.58e6, "give hardness_hv"), ("MPa", 1e6))),
    "bodies.boundary_friction_coefficient": Usual(0.0, 0.5, "-", (("%", 1e-2),)),
    "bodies.boundary_film": Usual(5e-10, 2e-7, "m", (("nm", NANO), ("um", MICRO))),
    "lubricant.viscosity": Usual(3e-4, 5.0, "Pa s", (("mPa s", 1e-3, "for mm²/s give grade, or nu40 and nu100"),)),
    "lubricant.nu40": Usual(1e-6, 5e-3, "m²/s", (("mm²/s", MICRO),)),
    "lubricant.nu100": Usual(5e-7, 1e-3, "m²/s", (("mm²/s", MICRO),)),
    "lubricant.pressure_viscosity_coefficient": Usual(1e-9, 8e-8, "1/Pa", (("1/GPa", NANO), ("1/MPa", MICRO))),
    "lubricant.viscosity_index": Usual(10.0, 600.0, "-"),
    "lubricant.eyring_stress": Usual(3e5, 5e7, "Pa", (("MPa", 1e6),)),
    "lubricant.limiting_stress_coefficient": Usual(0.01, 0.25, "-", (("%", 1e-2),)),
    "lubricant.limiting_stress_offset": Usual(0.0, 5e7, "Pa", ()),
    "lubricant.temperature": Usual(220, 500, "K", ()),
    "lubricant.density": Usual(700, 1300, "kg/m³", (("g/cm³", 1e3),)),
    "motion.entrainment_speed": Usual(0.0, 100.0, "m/s", (("mm/s", 1e-3),)),
    "motion.speeds": Usual(0.0, 100.0, "m/s", (("mm/s", 1e-3),)),
    "motion.slide_roll_ratio": Usual(0.0, 2.0, "-", (("%", 1e-2, "give slip_percent"),)),
    "surface.sq": Usual(5e-10, 2e-5, "m", (("um", MICRO), ("nm", NANO), ("mm", 1e-3))),
    "surface.correlation_length": Usual(1e-8, 2e-3, "m", (("um", MICRO), ("nm", NANO), ("mm", 1e-3))),
    "surface.spacing": Usual(1e-10, 1e-4, "m", (("um", MICRO), ("nm", NANO), ("mm", 1e-3))),
    "numerics.tolerance": Usual(1e-4, 0.2, "-", (("%", 1e-2),)),
    "numerics.sampling_tolerance": Usual(1e-3, 0.5, "-", (("%", 1e-2),)),
    "contact.spacing": Usual(1e-10, 1e-4, "m", (("um", MICRO), ("nm", NANO), ("mm", 1e-3))),
}
NOUGHT = ("lubricant.pressure_viscosity_coefficient", "surface.sq")  # usual where they are 0


def slip(name: str, value) -> str | None:
    """What ``value`` of the key ``name`` (section.key) may have been meant to be. None: the value is usual; "": nothing
    fits."""
    usual = USUAL.get(name)
    if usual is None:
        return None
    numbers = value if isinstance(value, (list, tuple)) else (value,)
    numbers = [v for v in numbers if isinstance(v, (int, float)) and not isinstance(v, bool) and abs(v) < 1e300]
    v = next((v for v in numbers if not usual.holds(v)), None)
    if v is None or v == 0 and name in NOUGHT:
        return None
    for unit, factor, *advice in usual.others:
        if usual.holds(v * factor):
            return "; ".join((f"{unit} meant? {v:g} {unit} = {v * factor:g} {usual.unit}", *advice))
    return ""


@dataclass(frozen=True)
class Doubt:
    """A value [unit] of a key outside its usual range, and the bound that it exceeds. ``meant``: what it may have been
    meant to be, or ""."""

    name: str
    value: float
    limit: float
    unit: str
    meant: str

    @property
    def text(self) -> str:
        """One sentence."""
        return f"{self.name} = {self.value:g} {self.unit} is unusual{self.meant and '; ' + self.meant}"


def doubts(scene) -> tuple[Doubt, ...]:
    """The values of a scene that are outside their usual range."""
    found = []
    for name, usual in USUAL.items():
        section, key = name.split(".")
        value = _index(scene) if key == "viscosity_index" else getattr(getattr(scene, section), key, None)
        for one in value if isinstance(value, (list, tuple)) else (value,):
            meant = None if one is None else slip(name, one)
            if meant is not None:
                limit = usual.high if abs(one) > usual.high else usual.low
                found.append(Doubt(name, float(one), limit, usual.unit, meant))
    return tuple(found)


def _index(scene) -> float | None:
    """Viscosity index of the oil; None without one, or of an oil so thin that it has none."""
    try:
        return None if scene.lubricant.oil is None else round(scene.lubricant.oil.index, 6)
    except InputError:
        return None


@contextmanager
def naming_slips(section: str, values: dict):
    """Add the likely slip, if there is one, to an `InputError` about one of ``values``."""
    try:
        yield
    except InputError as error:
        for name in (error.quantity, *error.also):
            key = name.rpartition(".")[2].partition("[")[0]
            error.hint(slip(f"{section}.{key}", values.get(key)) or "")
        raise


@contextmanager
def told_doubts(scene):
    """Add the unusual values of a scene to an `InputError` or `ConvergenceError`: they are its likely cause."""
    try:
        yield
    except (InputError, ConvergenceError) as error:
        error.hint("; ".join(doubt.text for doubt in doubts(scene)))
        raise
