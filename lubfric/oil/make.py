"""Ways to an `Oil`: two viscosities, an ISO VG grade and a viscosity index, a table, a name; and an oil as text."""

import re
from collections.abc import Sequence
from typing import Any

from .._base import packaged, validate
from ..errors import InputError
from .oil import Oil
from .pressure import MeasuredCoefficients
from .viscosity import CELSIUS, ViscosityTable, viscosity_at_100, walther

# Temperatures of the viscosities of ISO 3448 and ASTM D2270 [K].
AT_40 = 40 + CELSIUS
AT_100 = 100 + CELSIUS
GRADES = {  # ISO 3448: grade -> mid-point kinematic viscosity at 40 °C [mm²/s], the grade holds +-10 % of it
    **{2.0: 2.2, 3.0: 3.2, 5.0: 4.6, 7.0: 6.8},
    **{float(g): float(g) for g in (10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460, 680, 1000, 1500, 2200, 3200)},
}

OILS = packaged(__package__, "oils.toml")["oils"]
# Exponent of alpha in the central film of a full EHL contact [-] (Dowson and Toyoda 1978).
FILM_EXPONENT = 0.56

# What an error says of an SAE grade.
SAE_OIL = (
    "an SAE grade is not an ISO grade, and states ranges of viscosity: give nu40 and nu100 of the oil's data sheet"
)


def from_viscosities(nu40: float, nu100: float, **properties: Any) -> Oil:
    """Return an `Oil` from its kinematic viscosities [m²/s] at 40 and 100 °C, by ASTM D341 (constant 0.7).

    ``properties``: fields of `Oil` (base, density, alpha, ...). Raises `InputError` for values out of range.
    """
    nu40 = _viscosity("nu40", nu40)
    nu100 = _viscosity("nu100", nu100)
    return _through(nu40, nu100, {"nu40": nu40, "nu100": nu100}, properties)


def from_index(nu40: float, viscosity_index: float, **properties: Any) -> Oil:
    """Return an `Oil` from its kinematic viscosity [m²/s] at 40 °C and its viscosity index (ASTM D2270 inverted, then
    D341)."""
    nu40 = _viscosity("nu40", nu40)
    nu100 = viscosity_at_100(nu40, viscosity_index)
    return _through(nu40, nu100, {"nu40": nu40, "viscosity_index": float(viscosity_index)}, properties)


def from_grade(grade: str, viscosity_index: float, **properties: Any) -> Oil:
    """Return an `Oil` of an ISO viscosity grade ("ISO VG 68": 68 mm²/s at 40 °C in the middle of its +-10 %, ISO 3448)
    and a viscosity index (ASTM D2270 inverted, then D341)."""
    nu40 = grade_viscosity(grade)
    nu100 = viscosity_at_100(nu40, viscosity_index)
    given = {"grade": str(grade), "viscosity_index": float(viscosity_index)}
    return _through(nu40, nu100, given, {"name": f"ISO VG {nu40 * 1e6:g}, VI {viscosity_index:g}"} | properties)


def _through(nu40: float, nu100: float, given_keys: dict[str, Any], properties: dict[str, Any]) -> Oil:
    """Return an `Oil` by D341 through two viscosities [m²/s], which follow from the ``given_keys``."""
    return Oil(viscosity_law=walther((AT_40, nu40), (AT_100, nu100), **given_keys), **properties)


def from_table(temperatures: Sequence[float], viscosities: Sequence[float], **properties: Any) -> Oil:
    """Return an `Oil` from pairs of temperature [K], rising, and kinematic viscosity [m²/s]; D341 between
    neighbours."""
    rising = validate.array("temperatures", temperatures, "K", ndim=1).tolist()
    table = ViscosityTable(tuple(rising), tuple(_viscosity("viscosities", v) for v in viscosities))
    return Oil(viscosity_law=table, **properties)


def named_oil(name: str, **properties: Any) -> Oil:
    """Return one of the ``OILS``, by its name ("FVA 3", "mineral-100"). ``properties`` replace its fields."""
    spelled = {_letters(known): known for known in OILS}
    if _letters(name) not in spelled:
        near = validate.nearest(str(name).lower(), OILS)
        message = f" = {validate.shown(name)} is not known{'' if _is_of_sae(name) else near}"
        raise InputError(message, "lubricant.oil", ", ".join(OILS), SAE_OIL if _is_of_sae(name) else "")
    key = spelled[_letters(name)]
    row = OILS[key]
    law = walther(*zip((AT_40, AT_100), (nu * 1e-6 for nu in row["nu"])), oil=key)
    fields: dict[str, Any] = {"base": row["base"], "name": row["name"], "density": row.get("density")}
    fields["note"] = row.get("note", "")
    if "alpha" in row:
        fields["measured"] = MeasuredCoefficients(
            temperatures=tuple(celsius + CELSIUS for celsius in row["alpha_at"]),
            coefficients=tuple(alpha * 1e-9 for alpha in row["alpha"]),
            source=row["alpha_source"],
        )
    return Oil(viscosity_law=law, **fields | properties)


def _is_of_sae(name: Any) -> bool:
    """Return whether the name of an oil is a grade of SAE J300 or J306: "SAE 30", "5W-30"."""
    return re.search(r"\bsae|\d+\s*w(\b|\s*[-/]?\s*\d)", str(name), re.IGNORECASE) is not None


def _letters(name: Any) -> str:
    """Return the letters and digits of a name, in small letters: "FVA 3", "fva-3" and "fva3" are one."""
    return re.sub(r"[\s_-]", "", str(name)).lower()


def grade_viscosity(grade: str) -> float:
    """Return the kinematic viscosity [m²/s] at 40 °C in the middle of an ISO viscosity grade (ISO 3448): "ISO VG 68",
    "VG68", "68"."""
    match = re.fullmatch(r"\s*(?:iso[\s-]*)?(?:vg[\s-]*)?(\d+(?:\.\d+)?)\s*", str(grade), re.IGNORECASE)
    if not match or float(match[1]) not in GRADES:
        names = ", ".join(f"{g:g}" for g in GRADES)
        hint = SAE_OIL if _is_of_sae(grade) else ""
        raise InputError(f" = {grade!r} is not an ISO viscosity grade", "grade", f"'ISO VG n' with n of {names}", hint)
    return GRADES[float(match[1])] * 1e-6


def _viscosity(name: str, value: float) -> float:
    """Return a checked kinematic viscosity [m²/s]. The error says so if mm²/s were likely meant."""
    nu = validate.positive(name, value, "m²/s")
    if nu > 0.5:
        error = InputError(f" = {nu:g} m²/s is out of range", name, "up to 0.5 m²/s")
        error.hint(
            f"{name} = {nu:g} is read as {nu:g} m²/s; did you mean {nu:g} mm²/s ({nu * 1e-6:g} m²/s)?", asks=True
        )
        raise error
    return nu


def list_oils() -> str:
    """Return one line for each named oil."""
    lines = [f"{name:<16} {named_oil(name).name_and_note}" for name in OILS]
    other = 'any other: grade = "ISO VG 68" with viscosity_index, or nu40 and nu100 in m²/s, in [lubricant]'
    return "\n".join([*lines, "", other])


def estimate_in_words(oil: Oil, temperature: float) -> str:
    """Return the viscosity and pressure-viscosity coefficient of ``oil`` at ``temperature`` [K], and how well the
    coefficient is known."""
    text = (
        f"{oil.name} at {temperature - CELSIUS:.3g} °C: {oil.viscosity(temperature) * 1e3:.3g} mPa s (D341, constant "
        f"0.7), density {oil.density_at(temperature):.4g} kg/m³{f'; {oil.note}' if oil.note else ''}"
    )
    alpha = oil.pressure_viscosity_coefficient(temperature)
    other = oil.other_estimate(temperature)
    if alpha.low == alpha.high:
        return f"{text}; pressure-viscosity coefficient {alpha.value * 1e9:.3g} /GPa as given"
    text += f"; pressure-viscosity coefficient {alpha.text} /GPa"
    thin, thick = ((bound / alpha.value) ** FILM_EXPONENT - 1 for bound in (alpha.low, alpha.high))
    text += f"; the range of this coefficient changes the film thickness by {100 * thin:+.2g} to {100 * thick:+.2g} %"
    if other is not None:
        difference = other.value / alpha.value - 1
        text += f"; the estimate of {other.source} is {other.value * 1e9:.3g} /GPa ({100 * difference:+.2g} %)"
    return text
