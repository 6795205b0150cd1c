"""[lubricant]: an oil at a temperature instead of its viscosity and pressure-viscosity coefficient."""

from __future__ import annotations

from .._base import validate
from ..errors import InputError
from ..oil import (
    CELSIUS,
    Lubricant,
    Oil,
    checked_temperature,
    from_grade,
    from_index,
    from_table,
    from_viscosities,
    named_oil,
)
from .bodies import pair

SOURCES = ("grade", "viscosity_index", "nu40", "nu100", "viscosity_table", "oil")
PROPERTIES = {"base": "base", "density": "density", "density_slope": "density_slope", "alpha_estimate": "estimate"}
OF_AN_OIL = PROPERTIES | {"pressure_viscosity_coefficient": "alpha", "conductivity": "conductivity"}  # key: its field
OIL_KEYS = (*SOURCES[:-1], *PROPERTIES)  # of [lubricant], beside its fields
AT_40 = 40 + CELSIUS
OFFSET = Lubricant.limiting_stress_offset  # where none is given


def resolve_oil(given: dict, old) -> dict:
    """Plain fields of [lubricant] from an oil at ``temperature`` [K]: viscosity, pressure-viscosity coefficient,
    temperature coefficient and law of the density (as given, else of the oil).

    The oil is given by ``viscosity_index`` with ``grade`` or ``nu40`` [m²/s], by ``nu40`` and ``nu100``, by
    ``viscosity_table`` (pairs of K and m²/s), or by ``oil``, which is a name of `lubfric.oil.oil_names` or an `Oil`.
    """
    limit = given.get("limiting_stress_coefficient", getattr(old, "limiting_stress_coefficient", None))
    if limit is None and given.get("limiting_stress_offset", OFFSET) != OFFSET:
        raise InputError(
            "[lubricant] limiting_stress_offset does nothing without limiting_stress_coefficient (some 0.05 to 0.1); "
            "give both, or neither"
        )
    before = getattr(old, "oil", None)
    if given.get("oil", "") is None or not any(key in given for key in (*SOURCES, *PROPERTIES)):
        if before is None:
            _check_temperature(given, old)
            return given
        if "viscosity" in given:
            return {"oil": None} | given
        if not {"temperature", "pressure_viscosity_coefficient", "conductivity"} & set(given):
            return given
    if "viscosity" in given:
        both = "viscosity and an oil (grade, nu40, oil, ...)"
        raise InputError(f"[lubricant] has {both}, which say the same thing; give one of them")
    oil = _oil({key: given.pop(key) for key in SOURCES if key in given}, before)
    changed = {name: given.pop(key) for key, name in OF_AN_OIL.items() if key in given}
    temperature = given.pop("temperature", getattr(old, "temperature", None))
    if temperature is None:
        raise InputError("[lubricant] with an oil needs its temperature in K, or temperature_celsius")
    found = fields_of(oil.with_(**changed), temperature)
    if before is not None:
        found["density_law"] = old.density_law
        if old.temperature_coefficient != before.temperature_coefficient(old.temperature):
            found["temperature_coefficient"] = old.temperature_coefficient  # it was given
    return found | given


def _check_temperature(given: dict, old) -> None:
    """Raise `InputError` for a new temperature that would leave the viscosity, a number, as it is."""
    if old is None or "viscosity" in given or given.get("temperature") in (None, old.temperature):
        return
    if old.temperature is None and given.get("temperature_coefficient", old.temperature_coefficient):
        return  # from now on the heat of the film can be found
    raise InputError(
        "[lubricant] temperature moves no viscosity that is given as a number; give the viscosity there as well, or an "
        "oil (grade, nu40 and nu100, oil, viscosity_table) in place of it"
    )


def fields_of(oil: Oil, temperature: float) -> dict:
    """Fields of a `Lubricant` of ``oil`` at ``temperature`` [K]."""
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


def of_celsius(celsius, *_) -> dict:
    """The temperature [K] of ``lubricant.temperature_celsius``."""
    degrees = validate.number("lubricant.temperature_celsius", celsius, "°C")
    if degrees > 250:
        allowed = "up to 250 °C (K were meant? temperature)"
        raise InputError(f" = {degrees:g} °C", "lubricant.temperature_celsius", allowed)
    return {"temperature": degrees + CELSIUS}


def _oil(source: dict, before: Oil | None) -> Oil:
    """The oil that ``source`` names. It keeps the properties of the one ``before`` that ``source`` does not change."""
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
            raise InputError("[lubricant] grade needs viscosity_index as well (95 is common for mineral oils)")
        return from_grade(source["grade"], index, **kept)
    if index is None and together("lubricant", source, "nu40", "nu100"):
        return from_viscosities(source["nu40"], source["nu100"], **kept)
    nu40 = source.get("nu40", before and before.kinematic_viscosity(AT_40))
    if index is not None and nu40 is not None:
        return from_index(nu40, index, **kept)
    if before is None:
        key = next(iter(source), "base, density or another property")
        raise InputError(f"[lubricant] {key} needs an oil: grade, nu40 and nu100, viscosity_table or oil")
    return before


def only_one(section: str, given: dict, *keys: str) -> None:
    """At most one of ``keys`` (each a key, or several that go together joined by '+') is given."""
    found = [key for key in keys if any(k in given for k in key.split("+"))]
    if len(found) > 1:
        names = " and ".join(found)
        raise InputError(f"[{section}] has {names}, which say the same thing; give one of {', '.join(keys)}")


def together(section: str, given: dict, *keys: str) -> bool:
    """True when all ``keys`` are given, False when none is; an error when some are."""
    there = [key for key in keys if key in given]
    if there and len(there) < len(keys):
        missing = ", ".join(key for key in keys if key not in given)
        raise InputError(f"[{section}] {', '.join(there)} needs {missing} as well")
    return bool(there)
