"""Checks of input values; each failure names quantity, value, allowed range and unit."""

from __future__ import annotations

import difflib
import math

import numpy as np

from .errors import InputError


def number(
    name: str, value, unit: str, *, above: float = -math.inf, minimum: float = -math.inf, maximum: float = math.inf
) -> float:
    """A finite real number with ``above < value``, ``minimum <= value <= maximum``."""
    low = f"({above:g}" if above >= minimum else f"[{minimum:g}"
    allowed = f"allowed: a finite number in {low}, {maximum:g}{')' if math.isinf(maximum) else ']'} {unit}"
    if isinstance(value, (bool, str)) or value is None:
        raise InputError(f"{name} = {value!r} is not a number; {allowed}")
    try:
        x = float(value)
    except (TypeError, ValueError):
        raise InputError(f"{name} = {value!r} is not a number; {allowed}") from None
    if not (math.isfinite(x) and x > above and minimum <= x <= maximum):
        raise InputError(f"{name} = {x:g} {unit} is out of range; {allowed}")
    return x


def positive(name: str, value, unit: str, *, maximum: float = math.inf) -> float:
    """A finite number > 0."""
    return number(name, value, unit, above=0.0, maximum=maximum)


def nonnegative(name: str, value, unit: str, *, maximum: float = math.inf) -> float:
    """A finite number >= 0."""
    return number(name, value, unit, minimum=0.0, maximum=maximum)


def integer(name: str, value, *, minimum: int) -> int:
    """A whole number >= ``minimum``."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < minimum:
        raise InputError(f"{name} = {value!r} must be a whole number >= {minimum}")
    return int(value)


def array(name: str, value, unit: str, *, ndim: int) -> np.ndarray:
    """A non-empty array of finite floats with ``ndim`` axes."""
    try:
        a = np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        hint = f"; allowed: its .heights [{unit}]" if hasattr(value, "heights") else ""
        raise InputError(
            f"{name} is {'a height map, ' if hint else ''}not an array of numbers in {unit}{hint}"
        ) from None
    if a.ndim != ndim:
        raise InputError(f"{name} has {a.ndim} axes (shape {a.shape}); allowed: exactly {ndim} [{unit}]")
    if a.size == 0:
        raise InputError(f"{name} is empty (shape {a.shape}); allowed: at least one value [{unit}]")
    bad = a.size - np.count_nonzero(np.isfinite(a))
    if bad:
        raise InputError(
            f"{name} has {bad} of {a.size} values that are NaN or infinite; allowed: finite values in {unit}"
        )
    return a


def choice(name: str, value, options) -> str:
    """One of ``options``; the error names the nearest valid one."""
    if value in options:
        return value
    raise InputError(
        f"{name} = {value!r} is not known{nearest(value, options)}; allowed: {', '.join(map(repr, options))}"
    )


def nearest(word, options) -> str:
    """' (did you mean ...?)' or an empty string."""
    found = difflib.get_close_matches(str(word), [str(o) for o in options], n=1, cutoff=0.4)
    return f" (did you mean {found[0]!r}?)" if found else ""


def spacing(name: str, value) -> tuple[float, float]:
    """(dx, dy) in metres; one number means equal spacing."""
    pair = (value, value) if np.ndim(value) == 0 else tuple(value)
    if len(pair) != 2:
        raise InputError(f"{name} = {value!r} must be one length or a pair (dx, dy) in m")
    return positive(f"{name}[0]", pair[0], "m"), positive(f"{name}[1]", pair[1], "m")
