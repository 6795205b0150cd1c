"""Likely slips: values far from what machines have, and the unit in which they may have been meant.

A value outside the usual range (keys.toml) is no error: it gets a sentence that names the unit in which it would be
usual.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any

from .._base import packaged
from ..errors import ConvergenceError, InputError
from ..quantities import KEYS
from ..units import converted, without_unit


@cache
def typical(name: str) -> dict[str, list[float]]:
    """Words that represent a value of the key ``name`` (section.key): that value, and the lowest and highest that are
    usual, in the unit of the key."""
    return {word: without_unit(name, values, KEYS[name].unit) for word, (*values, _) in _rows(name).items()}


def source_of(name: str, word: str) -> str:
    """Where the `typical` value of the key ``name`` for ``word`` was seen in print."""
    return _rows(name)[word][-1]


def _rows(name: str) -> dict[str, list[Any]]:
    section, _, key = name.partition(".")
    return packaged(__package__, "typical.toml").get(section, {}).get(key, {})


def slip(name: str, value: Any) -> str | None:
    """What ``value`` of the key ``name`` (section.key) may have been meant to be. None: the value is usual; "": nothing
    fits."""
    q = KEYS.get(name)
    if q is None or not q.usual:
        return None
    low, high = q.usual
    numbers = value if isinstance(value, (list, tuple)) else (value,)
    numbers = [v for v in numbers if isinstance(v, (int, float)) and not isinstance(v, bool) and abs(v) < 1e300]
    v = next((v for v in numbers if not low <= abs(v) <= high), None)
    if v is None or v == 0 and q.zero:
        return None
    for unit, *advice in ([other] if isinstance(other, str) else other for other in q.meant):
        meant = converted(v, unit, q.unit)
        if low <= abs(meant) <= high:
            return "; ".join((f"{unit} meant? {v:g} {unit} = {meant:g} {q.unit}", *advice))
    return ""


def unusual_values(scene: Any) -> tuple[tuple[str, float, float, str, str], ...]:
    """Return the values of a scene that are outside their usual range: key, value, the bound that it exceeds, their unit, and
    what the value may have been meant to be, or ""."""
    unusual = []
    for name, q in KEYS.items():
        section, _, key = name.rpartition(".")
        value = _index(scene) if key == "viscosity_index" else getattr(getattr(scene, section, None), key, None)
        for one in value if isinstance(value, (list, tuple)) else (value,):
            meant = None if one is None else slip(name, one)
            if meant is not None:
                unusual.append((name, float(one), q.usual[abs(one) > q.usual[1]], q.unit, meant))
    return tuple(unusual)


def _index(scene: Any) -> float | None:
    """Viscosity index of the oil; None without one, or of an oil so thin that it has none."""
    try:
        return None if scene.lubricant.oil is None else round(scene.lubricant.oil.index, 6)
    except InputError:
        return None


@contextmanager
def naming_slips(section: str, values: dict[str, Any]) -> Iterator[None]:
    """Add the likely slip, if there is one, to an `InputError` about one of ``values``."""
    try:
        yield
    except InputError as error:
        for name in (error.quantity, *error.also):
            key = name.rpartition(".")[2].partition("[")[0]
            error.hint(slip(f"{section}.{key}", values.get(key)) or "")
        raise


@contextmanager
def warn_unusual_values(scene: Any) -> Iterator[None]:
    """Add the unusual values of a scene to an `InputError` or `ConvergenceError`: they are its likely cause."""
    try:
        yield
    except (InputError, ConvergenceError) as error:
        for name, value, _, unit, meant in unusual_values(scene):
            error.hint(f"{name} = {value:g} {unit} is unusual{meant and '; ' + meant}")
        raise
