"""The sections of a scene: which there are, made from the keys given for them, or changed by them."""

from dataclasses import MISSING, fields, replace
from typing import Any

from .._base import packaged, validate
from ..errors import InputError
from ..oil import AS_BOUNDARY, Lubricant
from ..quantities import KEYS
from ..surface import PER_SQ
from ..units import without_unit
from .bodies import Bodies, ContactDomain, Motion
from .numerics import Numerics, refuse_dropped
from .plausible import naming_slips, typical
from .roughness import LENGTH_KEYS, NEEDED, Roughness, as_given, lengths_in_range, named
from .short_forms import OF_AN_OIL, OIL_DEFAULTS, is_of_oil, resolve, short_keys, without_none
from .transient import Transient

ROUGH_SECTIONS = ("surface", "counterface")
SECTIONS: dict[str, Any] = {"bodies": Bodies, "lubricant": Lubricant, "motion": Motion}
SECTIONS |= dict.fromkeys(ROUGH_SECTIONS, Roughness) | {
    "contact": ContactDomain,
    "numerics": Numerics,
    "transient": Transient,
}
# Keys that may be a range though no name represents a typical value of them.
RANGED_KEYS = ("lubricant.pressure_viscosity_coefficient", *LENGTH_KEYS)
NEEDED_SECTIONS = ("bodies", "lubricant", "motion", "surface")


def meant(section: str) -> dict[str, str]:
    """Return other words for the keys of a section ("scene": for the sections), in small letters, and what to write."""
    groups = packaged(__package__, "other_words.toml").get(section, {})
    return {word: text for words, text in groups.items() for word in words.split()}


def check_keys(section: str, given: dict[str, Any], others: tuple[str, ...] = ()) -> None:
    """Raise `InputError` for a key of [``section``] that is not known; ``others`` are known in addition to its own."""
    if section == "numerics":
        refuse_dropped(given)
    allowed = (*_keys_of(section), *others)
    words = "surface" if section in ROUGH_SECTIONS else section
    validate.keys(f"[{section}]", given, allowed, lambda: keys_elsewhere(section) | meant(words))


def _keys_of(section: str) -> tuple[str, ...]:
    """Return the keys that a section may have."""
    return (*SECTIONS[section].__dataclass_fields__, *short_keys(section))


def keys_elsewhere(section: str = "") -> dict[str, str]:
    """Return the keys of all sections but ``section``, each with the sections that have it, as text."""
    places: dict[str, list[str]] = {}
    for other in SECTIONS:
        if other not in (section, "counterface"):  # whose keys are those of [surface]
            for key in _keys_of(other):
                places.setdefault(key, []).append(f"[{other}]")
    return {key: f"{key!r} in {' or '.join(sections)}" for key, sections in places.items()}


def made_section(section: str, given: dict[str, Any], old: Any = None) -> Any:
    """Return the section that the keys ``given`` make, or ``old`` with them changed. An error has the likely slip."""
    check_keys(section, given)
    with naming_slips(section, dict(given)), named(section):
        given = {key: read_value(section, key, value)[0] for key, value in given.items()}
        given = _cleared(section, without_none(section, given, old), old)
        plain = {key: tuple(v) if isinstance(v, list) else v for key, v in resolve(section, given, old).items()}
        if old is None and (missing := _missing_fields(section, plain)):
            raise InputError(f"[{section}] needs {missing}")
        return SECTIONS[section](**plain) if old is None else replace(old, **plain)


def _cleared(section: str, given: dict[str, Any], old: Any) -> dict[str, Any]:
    """Return what is ``given`` with the default of its field in place of each None, of an oil with what is estimated. A
    field without a default stays None."""
    defaults = {f.name: f.default for f in fields(SECTIONS[section]) if f.default is not MISSING}
    if section == "lubricant" and is_of_oil(given, old):
        defaults |= dict.fromkeys(OF_AN_OIL) | OIL_DEFAULTS
    return {key: defaults.get(key) if value is None else value for key, value in given.items()}


def takes_range(name: str) -> bool:
    """Return whether the value of the key ``name`` (section.key) may be a range."""
    return name in RANGED_KEYS or bool(typical(name))


def read_value(section: str, key: str, value: Any) -> tuple[Any, tuple[Any, Any] | None]:
    """Return ``value`` as a number in the unit of the ``key``, and the range in which it is known to lie (None: it is
    given).

    It may be text with a unit; a name that represents a typical value and its range (typical.toml); and for a key that
    `takes_range` [low, high], whose middle is the value, or [value, low, high]; of a correlation length the latter
    alone (`lengths_in_range`). A key without a unit is used unchanged.
    """
    name = f"{section}.{key}"
    if name not in KEYS:
        return value, None
    if name == "lubricant.inlet_length" and isinstance(value, (list, tuple, dict)):
        message = f" = {validate.shown(value)}: one number serves both directions of motion, at all times"
        raise InputError(message, name, "a length, such as '0.3 mm'")
    known = typical(name)
    words = {**known, AS_BOUNDARY: AS_BOUNDARY} if name == "lubricant.limiting_stress_coefficient" else known
    given = without_unit(name, validate.python_value(value), KEYS[name].unit, words)
    if isinstance(given, str) and given in known:
        given = known[given]
    if name in LENGTH_KEYS:
        return lengths_in_range(name, given)
    if not takes_range(name) or not isinstance(given, (list, tuple)):
        return given, None
    if len(given) not in (2, 3) or not all(type(v) in (int, float) for v in given):
        raise InputError(f" = {validate.shown(value)}", name, "a number, [low, high], or [value, low, high]")
    low, high = given[-2:]
    if low > high:
        message = f" = {validate.shown(value)}: low and high are exchanged"
        raise InputError(message, name, recommendation="write [low, high] or [value, low, high]")
    return (given[0] if len(given) == 3 else 0.5 * (low + high)), (float(low), float(high))


def ranges_of(section: str, values: Any) -> dict[str, tuple[Any, Any] | None]:
    """Return the ranges of ``values``, which are given for a ``section``, by "section.key" of each that may have one;
    of a complete section, None for all."""
    keys = SECTIONS[section].__dataclass_fields__ if not isinstance(values, dict) else values
    ranged = [key for key in keys if takes_range(f"{section}.{key}")]
    is_complete = not isinstance(values, dict)
    return {f"{section}.{key}": None if is_complete else read_value(section, key, values[key])[1] for key in ranged}


def changed_section(section: str, old: Any, values: Any) -> Any:
    """Return ``old`` with the fields in the dict ``values``. ``values`` may also be a complete section, which then
    replaces ``old``."""
    kind = SECTIONS.get(section, str)
    if isinstance(values, kind) or (section in ("transient", "counterface") and values is None):
        return values
    by_field = section in SECTIONS and (old is not None or section == "counterface")
    if not isinstance(values, dict) or not by_field:
        shown = repr(values) if isinstance(values, (str, float, int)) else f"a {type(values).__name__}"
        allowed = f"{'a dict of its fields, or ' if by_field else ''}a {kind.__name__}"
        raise InputError(f" = {shown}", section, allowed)
    return made_section(section, as_given(old, values) if section in ROUGH_SECTIONS else values, old)


def check_complete(name: str, table: dict[str, Any]) -> None:
    """Raise `InputError` with everything that the ``table`` of scene ``name`` lacks.

    A section whose keys contradict each other is left to the check that says so.
    """
    incomplete = [
        f"[{section}] needs {missing}" for section in NEEDED_SECTIONS if (missing := _missing(section, table))
    ]
    if incomplete:
        raise InputError(f"scene {name} is not complete: {'; '.join(incomplete)}")


def _missing(section: str, table: dict[str, Any]) -> str:
    given = dict(table.get(section, {}))
    if section in ROUGH_SECTIONS:
        height = any(key in given for key in ("sq", *PER_SQ, "sk"))
        return "" if "file" in given or height and "correlation_length" in given else NEEDED
    try:
        plain = resolve(section, given)
    except InputError:  # values still to be read, such as "6 mm": `made_section` sees what is missing
        return ""
    return _missing_fields(section, plain)


def _missing_fields(section: str, plain: dict[str, Any]) -> str:
    """Return the fields without a default that the ``plain`` values of a ``section`` leave out, as text; "" for
    none."""
    needed = [
        f.name
        for f in fields(SECTIONS[section])
        if f.default is MISSING and f.default_factory is MISSING and f.name not in plain
    ]
    words = packaged(__package__, "other_words.toml")["missing"]
    return "; ".join(f"{name!r} {words.get(f'{section}.{name}', '')}".rstrip() for name in needed)
