"""[bodies]: two radii, two materials, Vickers hardness, Hertz pressure instead of the load."""

from __future__ import annotations

import math

from .._base import validate
from ..errors import InputError
from ..film import composite_modulus
from .short_materials import material
from .short_pairs import only_one, pair, together

KEYS = ("radii", "material", "young_modulus", "poisson_ratio", "hardness_hv", "hertz_pressure")
PRESSURE_PER_HV = 9.80665e6 / 0.9272  # Pa: kgf/mm² over the facets of the pyramid -> pressure over the projected area


def resolve(given: dict, old) -> dict:
    """Plain fields of [bodies].

    - ``radii`` [m] of both bodies become the reduced radius.
    - ``material``, or ``young_modulus`` [Pa] with ``poisson_ratio``, becomes E'.
    - ``hardness_hv`` becomes the hardness, 10.58 MPa HV (load over the projected area of the indentation).
    - ``hertz_pressure`` [Pa], the peak, becomes the load.
    """
    only_one("bodies", given, "radius", "radii")
    only_one("bodies", given, "e_prime", "material", "young_modulus+poisson_ratio")
    only_one("bodies", given, "hardness", "hardness_hv")
    only_one("bodies", given, "load", "hertz_pressure")
    if "radii" in given:
        given["radius"] = reduced_radius(*pair("bodies.radii", given.pop("radii"), "m"))
    if "material" in given:
        given = _of_materials(given.pop("material")) | given
    if together("bodies", given, "young_modulus", "poisson_ratio"):
        (e1, e2), (nu1, nu2) = (
            pair(f"bodies.{key}", given.pop(key), unit)
            for key, unit in (("young_modulus", "Pa"), ("poisson_ratio", "-"))
        )
        for e in (e1, e2):
            if e != math.inf:
                validate.number("bodies.young_modulus", e, "Pa (inf: rigid)", minimum=1e4, maximum=1e13)
        given["e_prime"] = composite_modulus(e1, nu1, e2, nu2)
    if "hardness_hv" in given:
        number = validate.number("bodies.hardness_hv", given.pop("hardness_hv"), "(HV)", minimum=5, maximum=5000)
        given["hardness"] = PRESSURE_PER_HV * number
    if "hertz_pressure" in given:
        given["load"] = _load(given, old, given.pop("hertz_pressure"))
    return given


def reduced_radius(first: float, second: float) -> float:
    """R [m], 1/R = 1/R1 + 1/R2; a plane is inf, a hollow (the outer ring around a roller) negative."""
    curvature = 0.0
    for radius in (first, second):
        if isinstance(radius, bool) or not isinstance(radius, (int, float)) or radius == 0 or math.isnan(radius):
            raise InputError(
                f" has {radius!r}", "bodies.radii", way_out="give radii in m, inf for a plane, negative for a hollow"
            )
        curvature += 1 / radius
    if curvature <= 0:
        raise InputError(
            f" = [{first:g}, {second:g}] m do not touch along one line",
            "bodies.radii",
            "1/R1 + 1/R2 > 0 (inf for a plane, negative for a hollow that is wider than the other body)",
        )
    return 1 / curvature


def _of_materials(names) -> dict:
    """Fields of one or two named materials."""
    both = (names, names) if isinstance(names, str) else pair("bodies.material", names, "names")
    first, second = (material(name) for name in both)
    return {
        "e_prime": composite_modulus(
            first.young_modulus, first.poisson_ratio, second.young_modulus, second.poisson_ratio
        ),
        "conductivity": (first.conductivity, second.conductivity),
        "volumetric_heat": (first.volumetric_heat, second.volumetric_heat),
    }


def _load(given: dict, old, pressure: float) -> float:
    """Load [N] of a peak Hertz pressure [Pa]: w = 2 pi R p²/E'."""
    validate.number("bodies.hertz_pressure", pressure, "Pa", minimum=1e3, maximum=1e11)
    needed = ("radius", "width", "e_prime")
    if missing := [repr(key) for key in needed if key not in given and old is None]:
        raise InputError(f"[bodies] hertz_pressure needs {', '.join(missing)} as well")
    values = {key: validate.positive(f"bodies.{key}", given.get(key, getattr(old, key, None)), "") for key in needed}
    return 2 * math.pi * values["radius"] * pressure**2 / values["e_prime"] * values["width"]
