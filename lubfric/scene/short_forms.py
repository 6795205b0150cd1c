"""Short forms of a scene: the numbers on a drawing or an oil can, instead of fields of its sections.

Scene files and `Scene.with_` share them. A field may be given, or one of the short forms that represent it, not two.
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from .._base import validate
from ..errors import InputError
from ..film import composite_modulus
from ..oil import (
    AT_40,
    CELSIUS,
    Lubricant,
    Oil,
    checked_temperature,
    from_grade,
    from_index,
    from_table,
    from_viscosities,
    grade_viscosity,
    named_oil,
)
from ..surface import PER_SQ
from ..units import HV
from .bodies import Bodies, friction_of, pair
from .materials import fields_of_materials
from .roughness import Roughness

MOST_SPEEDS = 1_000_000  # of a range. A convention
SOURCES = ("grade", "viscosity_index", "nu40", "nu100", "viscosity_table", "oil")
PROPERTIES = {"base": "base", "density": "density", "density_slope": "density_slope", "alpha_estimate": "estimate"}
OF_AN_OIL = PROPERTIES | {"pressure_viscosity_coefficient": "alpha", "conductivity": "conductivity"}  # key: its field
OIL_KEYS = (*SOURCES[:-1], *PROPERTIES)  # of [lubricant], beside its fields
OIL_DEFAULTS = {"base": "mineral", "density_law": "dowson-higginson"}  # where neither oil nor scene states them
OFFSET = Lubricant.limiting_stress_offset  # where none is given


def short_keys(section: str) -> tuple[str, ...]:
    """Return the keys of a section that are not fields of it."""
    keys = tuple(key for keys, _, _ in FORMS.get(section, ()) for key in keys)
    return (*keys, *OIL_KEYS) if section == "lubricant" else keys


def resolve(section: str, given: dict[str, Any], old: Any = None) -> dict[str, Any]:
    """Return plain fields of ``section`` from what was ``given``; ``old``: the section to be changed, None for a new
    one.

    Raises `InputError` if two keys say the same thing, one lacks its partner, or a value is out of range.
    """
    forms = FORMS.get(section, ())
    given = {key: validate.python_value(value) for key, value in given.items()}
    for name in dict.fromkeys(name for _, fields, _ in forms for name in fields):
        only_one(section, given, name, *("+".join(keys) for keys, fields, _ in forms if name in fields))
    for keys, _, plain in forms:
        if are_together(section, given, *keys):
            values = [given.pop(key) for key in keys]
            given = plain(*values, given, old) | given
    if "boundary_friction_coefficient" in given:
        given = friction_of(given.pop("boundary_friction_coefficient")) | given
    return resolve_oil(given, old) if section == "lubricant" else given


def without_none(section: str, given: dict[str, Any], old: Any = None) -> dict[str, Any]:
    """Return what is ``given`` without the short forms that are None, which state nothing, and without the fields that
    are None because another key says the same thing: ``{"ra": 1e-7, "sq": None}`` states Ra alone. Of an oil, a
    property that is None is the one that is estimated."""
    short = {*short_keys(section)} - ({*PROPERTIES} if section == "lubricant" and is_of_oil(given, old) else set())
    given = {key: value for key, value in given.items() if value is not None or key not in short}
    groups = [{*keys, *fields} for keys, fields, _ in FORMS.get(section, ())]
    groups += [{*SOURCES} - {"oil"}] if section == "lubricant" else []
    needless: set[str] = set()
    for group in groups:
        if any(given.get(key) is not None for key in group):
            needless |= {key for key in group if key in given and given[key] is None}
    return {key: value for key, value in given.items() if key not in needless}


def is_of_oil(given: dict[str, Any], old: Lubricant | None) -> bool:
    """Return whether the lubricant that ``given`` makes of ``old`` has its numbers from an oil."""
    if any(given.get(key) is not None for key in SOURCES):
        return True
    is_changed = given.get("viscosity") is not None or "oil" in given
    return getattr(old, "oil", None) is not None and not is_changed


def reduced_radius(radii: Any) -> float:
    """Return R [m], 1/R = 1/R1 + 1/R2; a plane is inf, a hollow (the outer ring around a roller) negative."""
    first, second = pair("bodies.radii", radii, "m")
    for radius in (first, second):
        if isinstance(radius, bool) or not isinstance(radius, (int, float)) or radius == 0 or math.isnan(radius):
            recommendation = "give radii in m, inf for a plane, negative for a hollow"
            raise InputError(f" has {validate.shown(radius)}", "bodies.radii", recommendation=recommendation)
    curvature: float = 1 / first + 1 / second
    if curvature <= 0:
        allowed = "1/R1 + 1/R2 > 0 (inf for a plane, negative for a hollow that is wider than the other body)"
        raise InputError(f" = [{first:g}, {second:g}] m do not touch along one line", "bodies.radii", allowed)
    return 1 / curvature


def _of_radii(radii: Any, *_: Any) -> dict[str, Any]:
    return {"radius": reduced_radius(radii)}


def _of_moduli(moduli: Any, ratios: Any, *_: Any) -> dict[str, Any]:
    (e1, e2) = pair("bodies.young_modulus", moduli, "Pa")
    (nu1, nu2) = pair("bodies.poisson_ratio", ratios, "-")
    for e in (e1, e2):
        if e != math.inf:
            validate.number("bodies.young_modulus", e, "Pa (inf: rigid)", minimum=1e4, maximum=1e13)
    return {"e_prime": composite_modulus(e1, nu1, e2, nu2)}


def _of_hertz_pressure(
    pressure: float, given: dict[str, float | tuple[float, float] | None], old: Bodies | None
) -> dict[str, Any]:
    """Return the load [N] of a peak Hertz pressure [Pa]: w = 2 pi R p²/E'."""
    validate.of_key("bodies.hertz_pressure", pressure)
    needed = ("radius", "width", "e_prime")
    if missing := [repr(key) for key in needed if key not in given and old is None]:
        raise InputError(f"[bodies] hertz_pressure needs {', '.join(missing)} as well")
    values = (given.get(key, getattr(old, key, None)) for key in needed)
    radius, width, e_prime = (validate.positive(f"bodies.{key}", value, "") for key, value in zip(needed, values))
    return {"load": 2 * math.pi * radius * pressure**2 / e_prime * width}


def _of_surface_speeds(speeds: Any, *_: Any) -> dict[str, Any]:
    both = pair("motion.surface_speeds", speeds, "m/s")
    u1, u2 = (validate.number("motion.surface_speeds", u, "m/s") for u in both)
    if u1 + u2 == 0:
        raise InputError("motion.surface_speeds sum to 0 m/s: give entrainment_speed = 0 and a slide_roll_ratio")
    return {"entrainment_speed": (u1 + u2) / 2, "slide_roll_ratio": 2 * (u2 - u1) / (u1 + u2)}


def speeds_of_range(name: str, value: Any) -> tuple[float, ...]:
    """Return the speeds [m/s] of [lowest, highest, count], in a geometric series; ``name``: of the key."""
    if not isinstance(value, (list, tuple)) or len(value) != 3:
        raise InputError(f"{name} = {validate.shown(value)} must be [lowest, highest, count] in m/s, m/s, (-)")
    low = validate.positive(f"{name} lowest", value[0], "m/s")
    high = validate.positive(f"{name} highest", value[1], "m/s")
    if high <= low:
        raise InputError(f"{name} highest = {high:g} m/s; it must be above lowest = {low:g} m/s (are they swapped?)")
    count = validate.integer(f"{name} count", value[2], minimum=1, maximum=MOST_SPEEDS)
    return tuple(float(u) for u in np.geomspace(low, high, count))


def _of_heights(key: str, per_sq: float) -> Callable[..., dict[str, Any]]:
    """Return what turns the ``key`` of a generated map, ``per_sq`` times its Sq, into Sq [m]."""

    def plain(height: float, given: dict[str, float | str | None], old: Roughness | None) -> dict[str, float]:
        if given.get("file", getattr(old, "file", None)) is not None:
            message = " is for generated maps, and this one is read from a file"
            raise InputError(message, f"surface.{key}", recommendation="omit it, or scale the map by sq")
        return {"sq": validate.nonnegative(f"surface.{key}", height, "m", maximum=1.0) / per_sq}

    return plain


def resolve_oil(given: dict[str, Any], old: Lubricant | None) -> dict[str, Any]:
    """Return plain fields of [lubricant] from an oil at ``temperature`` [K]: viscosity, pressure-viscosity coefficient,
    temperature coefficient and law of the density (as given, else of the oil).

    The oil is given by ``viscosity_index`` with ``grade`` or ``nu40`` [m²/s], by ``nu40`` and ``nu100``, by
    ``viscosity_table`` (pairs of K and m²/s), or by ``oil``, which is a name of `lubfric.oil.OILS` or an `Oil`.
    """
    limit = given.get("limiting_stress_coefficient", getattr(old, "limiting_stress_coefficient", None))
    if limit is None and given.get("limiting_stress_offset", OFFSET) != OFFSET:
        message = "limiting_stress_offset does nothing without limiting_stress_coefficient (some 0.05 to 0.1)"
        raise InputError(f"[lubricant] {message}; give both, or neither")
    before = getattr(old, "oil", None)
    if given.get("oil", "") is None or not any(key in given for key in (*SOURCES, *PROPERTIES)):
        if before is None:
            _check_temperature(given, old)
            return given
        if "viscosity" in given:
            return {"oil": None} | given
        if not {"temperature", "pressure_viscosity_coefficient", "conductivity"} & set(given):
            return given
    if given.get("viscosity", "") is None:  # states that there is none, as an oil does
        del given["viscosity"]
    if "viscosity" in given:
        both = "viscosity and an oil (grade, nu40, oil, ...)"
        raise InputError(f"[lubricant] has {both}, which give the same quantity; give one of them")
    oil = _oil({key: given.pop(key) for key in SOURCES if key in given}, before)
    changed = {name: given.pop(key) for key, name in OF_AN_OIL.items() if key in given}
    temperature = given.pop("temperature", getattr(old, "temperature", None))
    if temperature is None:
        raise InputError("[lubricant] with an oil needs its temperature in K, or temperature_celsius")
    oil_fields = fields_of(oil.with_(**changed), temperature)
    if old is not None and before is not None:
        oil_fields["density_law"] = old.density_law
        if old.temperature_coefficient != before.temperature_coefficient(old.temperature):
            oil_fields["temperature_coefficient"] = old.temperature_coefficient  # it was given
    return oil_fields | given


def _check_temperature(given: dict[str, Any], old: Lubricant | None) -> None:
    """Raise `InputError` for a new temperature that would leave the viscosity, a number, unchanged."""
    if old is None or "viscosity" in given or given.get("temperature") in (None, old.temperature):
        return
    if old.temperature is None and given.get("temperature_coefficient", old.temperature_coefficient):
        return  # from now on the heat of the film can be found
    ways = "give the viscosity there as well, or an oil (grade, nu40 and nu100, oil, viscosity_table) in place of it"
    raise InputError(f"[lubricant] temperature does not change a viscosity that is given as a number; {ways}")


def fields_of(oil: Oil, temperature: float) -> dict[str, Any]:
    """Return fields of a `Lubricant` of ``oil`` at ``temperature`` [K]."""
    temperature = checked_temperature(temperature, "lubricant.temperature")
    return {
        "viscosity": oil.viscosity(temperature),
        "pressure_viscosity_coefficient": oil.pressure_viscosity_coefficient(temperature).value,
        "temperature": temperature,
        "temperature_coefficient": oil.temperature_coefficient(temperature),
        "conductivity": oil.thermal_conductivity,
        "density_law": "dowson-higginson",
        "oil": oil,
    }


def of_celsius(celsius: float, *_: Any) -> dict[str, Any]:
    """Return the temperature [K] of ``lubricant.temperature_celsius``."""
    degrees = validate.number("lubricant.temperature_celsius", celsius, "°C")
    if degrees > 250:
        error = InputError(f" = {degrees:g} °C", "lubricant.temperature_celsius", "up to 250 °C")
        error.hint(
            f"lubricant.temperature_celsius = {degrees:g} is read as {degrees:g} °C; did you mean temperature = "
            f"{degrees:g} K?",
            asks=True,
        )
        raise error
    return {"temperature": degrees + CELSIUS}


def _oil(source: dict[str, Any], before: Oil | None) -> Oil:
    """Return the oil that ``source`` names. It keeps the properties of the one ``before`` that ``source`` does not
    change."""
    only_one("lubricant", source, "grade", "nu40+nu100", "viscosity_table", "oil")
    only_one("lubricant", source, "viscosity_index", "nu100", "viscosity_table", "oil")
    kept = {} if before is None else {name: getattr(before, name) for name in OF_AN_OIL.values()}
    if "oil" in source:
        return source["oil"] if isinstance(source["oil"], Oil) else named_oil(source["oil"])
    if "viscosity_table" in source:
        table = source["viscosity_table"]
        if not isinstance(table, (list, tuple)) or not table:
            raise InputError(f" = {validate.shown(table)}", "lubricant.viscosity_table", "pairs of K and m²/s")
        rows = [pair("lubricant.viscosity_table", row, "K, m²/s") for row in table]
        return from_table(*zip(*rows), **kept)
    index = source.get("viscosity_index")
    if "grade" in source:
        index = index if index is not None or before is None else before.index
        if index is None:
            grade_viscosity(source["grade"])  # refuses a grade that is none
            raise InputError("[lubricant] grade needs viscosity_index as well (95 is common for mineral oils)")
        return from_grade(source["grade"], index, **kept)
    if "nu40" in source and "nu100" not in source and index is None:
        index = _index_of(before)
    if index is None and are_together("lubricant", source, "nu40", "nu100"):
        return from_viscosities(source["nu40"], source["nu100"], **kept)
    nu40 = source.get("nu40", before and before.kinematic_viscosity(AT_40))
    if index is not None and nu40 is not None:
        return from_index(nu40, index, **kept)
    if before is None:
        key = next(iter(source), "base, density or another property")
        raise InputError(f"[lubricant] {key} needs an oil: grade, nu40 and nu100, viscosity_table or oil")
    return before


def _index_of(before: Oil | None) -> float:
    """Return the viscosity index that the oil ``before`` was given with, for another viscosity at 40 °C."""
    if before is None or "viscosity_index" not in before.given_keys:
        raise InputError("[lubricant] nu40 needs nu100 or viscosity_index as well")
    return float(before.given_keys["viscosity_index"])


def only_one(section: str, given: dict[str, Any], *keys: str) -> None:
    """Raise `InputError` where more than one of ``keys`` is given, each a key, or several that go together joined by
    '+'."""
    given_keys = [key for key in keys if any(k in given for k in key.split("+"))]
    if len(given_keys) > 1:
        names = " and ".join(given_keys)
        raise InputError(f"[{section}] has {names}, which give the same quantity; give one of {', '.join(keys)}")


def are_together(section: str, given: dict[str, Any], *keys: str) -> bool:
    """Return True when all ``keys`` are given, False when none is; an error when some are."""
    there = [key for key in keys if key in given]
    if there and len(there) < len(keys):
        missing = ", ".join(key for key in keys if key not in given)
        raise InputError(f"[{section}] {', '.join(there)} needs {missing} as well")
    return bool(there)


FORMS: dict[str, tuple[tuple[tuple[str, ...], tuple[str, ...], Callable[..., dict[str, Any]]], ...]] = {
    # section: keys that go together, the fields that they stand for, and the function of (*values, given, old) that
    # gives these fields, and others that count where they are not given
    "bodies": (
        (("radii",), ("radius",), _of_radii),
        (("material",), ("e_prime",), fields_of_materials),
        (("young_modulus", "poisson_ratio"), ("e_prime",), _of_moduli),
        (("hardness_hv",), ("hardness",), lambda hv, *_: {"hardness": HV * validate.of_key("bodies.hardness_hv", hv)}),
        (("hertz_pressure",), ("load",), _of_hertz_pressure),
    ),
    "lubricant": ((("temperature_celsius",), ("temperature",), of_celsius),),
    "motion": (
        (("surface_speeds",), ("entrainment_speed", "slide_roll_ratio"), _of_surface_speeds),
        (
            ("slip_percent",),
            ("slide_roll_ratio",),
            lambda slip, *_: {"slide_roll_ratio": validate.of_key("motion.slip_percent", slip) / 100},
        ),
        (("speed_range",), ("speeds",), lambda given, *_: {"speeds": speeds_of_range("motion.speed_range", given)}),
    ),
    "surface": tuple(((key,), ("sq",), _of_heights(key, per_sq)) for key, per_sq in PER_SQ.items()),
}
FORMS["counterface"] = FORMS["surface"]


def fields_of_key(name: str) -> tuple[str, ...]:
    """Return the fields (section.field) that the key ``name`` (section.key) states: itself, and those of a short
    form."""
    section, _, key = name.partition(".")
    stated = [field for keys, fields, _ in FORMS.get(section, ()) if key in keys for field in fields]
    return (name, *(f"{section}.{field}" for field in stated))
