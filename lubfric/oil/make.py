"""Ways to an `Oil`: two viscosities, an ISO VG grade and a viscosity index, a table, a name."""

from __future__ import annotations

import re
from dataclasses import dataclass

from .._base import validate
from ..errors import InputError
from .oil import Oil
from .temperature import CELSIUS, ViscosityTable, walther
from .viscosity_index import viscosity_at_100

AT_40, AT_100 = 40 + CELSIUS, 100 + CELSIUS
GRADES = {  # ISO 3448: grade -> mid-point kinematic viscosity at 40 °C [mm²/s], the grade holds +-10 % of it
    **{2.0: 2.2, 3.0: 3.2, 5.0: 4.6, 7.0: 6.8},
    **{float(g): float(g) for g in (10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460, 680, 1000, 1500, 2200, 3200)},
}


@dataclass(frozen=True)
class Entry:
    """A named oil: two points (temperature [°C], kinematic viscosity [mm²/s]), base, density [kg/m³] at 15 °C (None:
    typical of the base), alpha [1/Pa] (None: estimated), and the source."""

    name: str
    points: tuple[tuple[float, float], tuple[float, float]]
    base: str
    density: float | None
    alpha: float | None
    source: str


def _generic(grade: float, at_100: float, base: str, text: str) -> Entry:
    source = (
        "generic oil of its grade, D341 through both points; coefficients estimated, density typical of the base oil"
    )
    return Entry(text, ((40.0, grade), (100.0, at_100)), base, None, None, source)


OILS = {
    "mineral-32": _generic(31.81, 5.385, "mineral", "mineral oil, ISO VG 32, VI 102"),
    "mineral-100": _generic(99.14, 10.954, "mineral", "mineral oil, ISO VG 100, VI 94"),
    "mineral-220": _generic(217.98, 18.915, "mineral", "mineral oil, ISO VG 220, VI 97"),
    "pao-220": _generic(218.06, 25.577, "pao", "polyalphaolefin, ISO VG 220, VI 149"),
    "polyglycol-220": _generic(218.78, 31.906, "polyglycol", "polyglycol, ISO VG 220, VI 190"),
}


def from_viscosities(nu40: float, nu100: float, **properties) -> Oil:
    """An `Oil` from its kinematic viscosities [m²/s] at 40 and 100 °C, by ASTM D341 (constant 0.7).

    ``properties``: fields of `Oil` (base, density, alpha, ...). Raises `InputError` for values out of range.
    """
    nu40, nu100 = _viscosity("nu40", nu40), _viscosity("nu100", nu100)
    return _through(nu40, nu100, {"nu40": nu40, "nu100": nu100}, properties)


def from_index(nu40: float, viscosity_index: float, **properties) -> Oil:
    """An `Oil` from its kinematic viscosity [m²/s] at 40 °C and its viscosity index (ASTM D2270 inverted, then
    D341)."""
    nu40 = _viscosity("nu40", nu40)
    nu100 = viscosity_at_100(nu40, viscosity_index)
    return _through(nu40, nu100, {"nu40": nu40, "viscosity_index": float(viscosity_index)}, properties)


def from_grade(grade: str, viscosity_index: float, **properties) -> Oil:
    """An `Oil` of an ISO viscosity grade ("ISO VG 68": 68 mm²/s at 40 °C in the middle of its +-10 %, ISO 3448) and a
    viscosity index (ASTM D2270 inverted, then D341)."""
    nu40 = grade_viscosity(grade)
    nu100 = viscosity_at_100(nu40, viscosity_index)
    said = {"grade": str(grade), "viscosity_index": float(viscosity_index)}
    return _through(nu40, nu100, said, {"name": f"ISO VG {nu40 * 1e6:g}, VI {viscosity_index:g}"} | properties)


def _through(nu40: float, nu100: float, said: dict, properties: dict) -> Oil:
    """An `Oil` by D341 through two viscosities [m²/s], which follow from what was ``said``."""
    return Oil(walther((AT_40, nu40), (AT_100, nu100), **said), **properties)


def from_table(temperatures, viscosities, **properties) -> Oil:
    """An `Oil` from pairs of temperature [K], rising, and kinematic viscosity [m²/s]; D341 between neighbours."""
    table = ViscosityTable(tuple(map(float, temperatures)), tuple(_viscosity("viscosities", v) for v in viscosities))
    return Oil(table, **properties)


def named_oil(name: str, **properties) -> Oil:
    """One of the oils that `oil_names` lists. ``properties`` replace its fields."""
    if str(name).lower() not in OILS:
        near = validate.nearest(str(name).lower(), OILS)
        raise InputError(f"oil {name!r} is not known{near}; allowed: {', '.join(OILS)}")
    entry = OILS[str(name).lower()]
    fields = {"base": entry.base, "density": entry.density, "alpha": entry.alpha, "name": entry.name} | properties
    cold, warm = ((t + CELSIUS, nu * 1e-6) for t, nu in entry.points)
    return Oil(walther(cold, warm, oil=str(name).lower()), **fields)


def oil_names() -> tuple[str, ...]:
    """Names that `named_oil` knows."""
    return tuple(OILS)


def grade_viscosity(grade: str) -> float:
    """Kinematic viscosity [m²/s] at 40 °C in the middle of an ISO viscosity grade (ISO 3448): "ISO VG 68", "VG68",
    "68"."""
    found = re.fullmatch(r"\s*(?:iso[\s-]*)?(?:vg[\s-]*)?(\d+(?:\.\d+)?)\s*", str(grade), re.IGNORECASE)
    if not found or float(found[1]) not in GRADES:
        names = ", ".join(f"{g:g}" for g in GRADES)
        hint = "; an SAE grade is no ISO grade: give nu40 and nu100" if "sae" in str(grade).lower() else ""
        raise InputError(
            f"grade = {grade!r} is not an ISO viscosity grade; allowed: 'ISO VG n' with n of {names}{hint}"
        )
    return GRADES[float(found[1])] * 1e-6


def _viscosity(name: str, value: float) -> float:
    """A checked kinematic viscosity [m²/s]. The error says so if mm²/s were likely meant."""
    nu = validate.positive(name, value, "m²/s")
    if nu > 0.5:
        raise InputError(
            f" = {nu:g} m²/s is out of range",
            name,
            f"up to 0.5 m²/s (mm²/s were meant? {nu:g} mm²/s = {nu * 1e-6:g})",
        )
    return nu
