"""Checks that the short forms share."""

from __future__ import annotations

from ..errors import InputError


def pair(name: str, value, unit: str) -> tuple:
    """A list or tuple of two values, one for each body."""
    if not isinstance(value, (list, tuple)) or len(value) != 2:
        raise InputError(f" = {value!r} must be a pair, one value a body [{unit}]", name)
    return tuple(value)


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
