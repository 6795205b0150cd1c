"""Short forms of a scene: the numbers on a drawing or an oil can, in the place of fields of its sections.

Scene files and `Scene.with_` share them. A field may be given, or one of the short forms that stand for it, not two.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from importlib import resources
from typing import Any

import numpy as np

from .._base import python_value, validate
from ..errors import InputError
from ..film import composite_modulus
from .bodies import pair
from .short_oil import OIL_KEYS, of_celsius, only_one, resolve_oil, together

PRESSURE_PER_HV = 9.80665e6 / 0.9272  # Pa: kgf/mm² over the facets of the pyramid -> pressure over the projected area
MOST_SPEEDS = 1_000_000


@dataclass(frozen=True)
class ShortForm:
    """``keys``, which go together, and the ``fields`` that they stand for. ``plain(*values, given, old)`` gives these
    fields, and others that count where they are not ``given``."""

    keys: tuple[str, ...]
    fields: tuple[str, ...]
    plain: Callable[..., dict[str, Any]]


def short_keys(section: str) -> tuple[str, ...]:
    """Keys of a section that are not fields of it."""
    keys = tuple(key for form in FORMS.get(section, ()) for key in form.keys)
    return (*keys, *OIL_KEYS) if section == "lubricant" else keys


def resolve(section: str, given: dict, old=None) -> dict:
    """Plain fields of ``section`` from what was ``given``; ``old``: the section to be changed, None for a new one.

    Raises `InputError` if two keys say the same thing, one lacks its partner, or a value is out of range.
    """
    given, forms = {key: python_value(value) for key, value in given.items()}, FORMS.get(section, ())
    for name in dict.fromkeys(name for form in forms for name in form.fields):
        only_one(section, given, name, *("+".join(form.keys) for form in forms if name in form.fields))
    for form in forms:
        if together(section, given, *form.keys):
            values = [given.pop(key) for key in form.keys]
            given = form.plain(*values, given, old) | given
    return resolve_oil(given, old) if section == "lubricant" else given


def reduced_radius(first: float, second: float) -> float:
    """R [m], 1/R = 1/R1 + 1/R2; a plane is inf, a hollow (the outer ring around a roller) negative."""
    for radius in (first, second):
        if isinstance(radius, bool) or not isinstance(radius, (int, float)) or radius == 0 or math.isnan(radius):
            way_out = "give radii in m, inf for a plane, negative for a hollow"
            raise InputError(f" has {validate.shown(radius)}", "bodies.radii", way_out=way_out)
    curvature = 1 / first + 1 / second
    if curvature <= 0:
        allowed = "1/R1 + 1/R2 > 0 (inf for a plane, negative for a hollow that is wider than the other body)"
        raise InputError(f" = [{first:g}, {second:g}] m do not touch along one line", "bodies.radii", allowed)
    return 1 / curvature


def _of_radii(radii, *_) -> dict:
    return {"radius": reduced_radius(*pair("bodies.radii", radii, "m"))}


def _of_materials(names, *_) -> dict:
    """Fields of one or two named materials (materials.toml)."""
    known = tomllib.loads((resources.files(__package__) / "materials.toml").read_text(encoding="utf-8"))
    both = (names, names) if isinstance(names, str) else pair("bodies.material", names, "names")
    first, second = (known[validate.choice("bodies.material", name, known)] for name in both)
    return {
        "e_prime": composite_modulus(
            *(m[name] for m in (first, second) for name in ("young_modulus", "poisson_ratio"))
        ),
        "conductivity": (first["conductivity"], second["conductivity"]),
        "volumetric_heat": tuple(m["density"] * m["specific_heat"] for m in (first, second)),
    }


def _of_moduli(moduli, ratios, *_) -> dict:
    (e1, e2), (nu1, nu2) = pair("bodies.young_modulus", moduli, "Pa"), pair("bodies.poisson_ratio", ratios, "-")
    for e in (e1, e2):
        if e != math.inf:
            validate.number("bodies.young_modulus", e, "Pa (inf: rigid)", minimum=1e4, maximum=1e13)
    return {"e_prime": composite_modulus(e1, nu1, e2, nu2)}


def _of_vickers(number, *_) -> dict:
    return {
        "hardness": PRESSURE_PER_HV * validate.number("bodies.hardness_hv", number, "(HV)", minimum=5, maximum=5000)
    }


def _of_hertz_pressure(pressure, given, old) -> dict:
    """The load [N] of a peak Hertz pressure [Pa]: w = 2 pi R p²/E'."""
    validate.number("bodies.hertz_pressure", pressure, "Pa", minimum=1e3, maximum=1e11)
    needed = ("radius", "width", "e_prime")
    if missing := [repr(key) for key in needed if key not in given and old is None]:
        raise InputError(f"[bodies] hertz_pressure needs {', '.join(missing)} as well")
    values = (given.get(key, getattr(old, key, None)) for key in needed)
    radius, width, e_prime = (validate.positive(f"bodies.{key}", value, "") for key, value in zip(needed, values))
    return {"load": 2 * math.pi * radius * pressure**2 / e_prime * width}


def _of_surface_speeds(speeds, *_) -> dict:
    both = pair("motion.surface_speeds", speeds, "m/s")
    u1, u2 = (validate.number("motion.surface_speeds", u, "m/s") for u in both)
    if u1 + u2 == 0:
        raise InputError("motion.surface_speeds sum to 0 m/s: give entrainment_speed = 0 and a slide_roll_ratio")
    return {"entrainment_speed": (u1 + u2) / 2, "slide_roll_ratio": 2 * (u2 - u1) / (u1 + u2)}


def _of_slip(percent, *_) -> dict:
    return {"slide_roll_ratio": validate.number("motion.slip_percent", percent, "%") / 100}


def _of_range(given, *_) -> dict:
    return {"speeds": speeds_of_range("motion.speed_range", given)}


def speeds_of_range(name: str, value) -> tuple[float, ...]:
    """The speeds [m/s] of [lowest, highest, count], in a geometric series; ``name``: of the key."""
    if not isinstance(value, (list, tuple)) or len(value) != 3:
        raise InputError(f"{name} = {validate.shown(value)} must be [lowest, highest, count] in m/s, m/s, (-)")
    low = validate.positive(f"{name} lowest", value[0], "m/s")
    high = validate.positive(f"{name} highest", value[1], "m/s")
    if high <= low:
        raise InputError(f"{name} highest = {high:g} m/s; it must be above lowest = {low:g} m/s (are they swapped?)")
    count = validate.integer(f"{name} count", value[2], minimum=1, maximum=MOST_SPEEDS)
    return tuple(float(u) for u in np.geomspace(low, high, count))


FORMS = {
    "bodies": (
        ShortForm(("radii",), ("radius",), _of_radii),
        ShortForm(("material",), ("e_prime",), _of_materials),
        ShortForm(("young_modulus", "poisson_ratio"), ("e_prime",), _of_moduli),
        ShortForm(("hardness_hv",), ("hardness",), _of_vickers),
        ShortForm(("hertz_pressure",), ("load",), _of_hertz_pressure),
    ),
    "lubricant": (ShortForm(("temperature_celsius",), ("temperature",), of_celsius),),
    "motion": (
        ShortForm(("surface_speeds",), ("entrainment_speed", "slide_roll_ratio"), _of_surface_speeds),
        ShortForm(("slip_percent",), ("slide_roll_ratio",), _of_slip),
        ShortForm(("speed_range",), ("speeds",), _of_range),
    ),
}
