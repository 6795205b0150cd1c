"""ISO viscosity grades and named oils."""

from __future__ import annotations

from dataclasses import dataclass

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
