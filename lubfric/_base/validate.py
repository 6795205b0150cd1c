"""Checks of input values; each failure names quantity, value, allowed range and unit."""

import difflib
import math
import os
import re
from collections.abc import Callable, Iterable
from contextlib import suppress
from decimal import Decimal
from fractions import Fraction
from importlib import import_module
from numbers import Real
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from ..errors import InputError
from ..quantities import CHOICES, KEYS, OTHER_VALUES
from ..units import SANE, UNITS, spelled, without_unit

T = TypeVar("T")
# Other words for the options of readers of height maps, in small letters, and what is meant by them.
OTHER_OPTIONS = {"parabola": "quadratic", "tilt": "plane", "remove": "mask"}

# Limits of messages and numbers, by choice.
LONG_NUMBER = 31  # bits of a number that is shown as a power of two
LONGEST_SHOWN = 80  # characters of a value in a message
DEEPEST = 3  # nested lists that are looked into
# Smallest and largest magnitude of any number: a choice, beyond which powers of it overflow.
SMALLEST_NUMBER = 1e-100
LARGEST_NUMBER = 1e100
NUMBER_KINDS = "iuf"  # kinds of NumPy types that are real numbers; not truth values, complex numbers, words or dates


def shown(value: Any) -> str:
    """Return ``value`` for a message: its ``repr``, cut where it is long. A value without one (an integer of 5000
    digits) is shown by its type."""
    try:
        text = repr(value)
    except (ValueError, RecursionError):
        return f"<{type(value).__name__}>"
    return text if len(text) <= LONGEST_SHOWN else f"{text[: LONGEST_SHOWN - 4]} ..."


def python_value(value: Any, depth: int = DEEPEST) -> Any:
    """Return a number of NumPy, a `Decimal` or a `Fraction` as one of Python, an array as a tuple, also inside lists
    and tuples, nested up to ``depth`` times; anything else unchanged."""
    if isinstance(value, np.ma.MaskedArray) or type(value) in (float, int, str, bool):
        return value
    if isinstance(value, np.floating):
        return float(value)  # tolist() leaves a longdouble as it is
    if isinstance(value, (np.generic, np.ndarray)):
        given = value.tolist()
        return tuple(python_value(part) for part in given) if isinstance(given, list) else given
    if isinstance(value, (Decimal, Fraction)):
        try:
            return float(value)
        except OverflowError:
            return math.inf  # refused with its name
        except ValueError:  # a signalling NaN
            return math.nan
    if type(value) in (list, tuple) and depth > 0:
        return type(value)(python_value(part, depth - 1) for part in value)
    return value


def python_fields(part: Any, section: str) -> None:
    """Make the fields of a frozen dataclass, which is this ``section`` of a scene, `python_value` (call it first in
    ``__post_init__``), and text with a unit a number. A pair in an array is a pair, a scene prints and is written as
    numbers, and nothing is computed in single precision."""
    for name, value in list(vars(part).items()):
        key = f"{section}.{name}"
        plain = python_value(value)
        object.__setattr__(part, name, without_unit(key, plain, KEYS[key].unit) if key in KEYS else plain)


def in_plain(name: str, value: Any, unit: str) -> Any:
    """Return ``value`` with text such as "12 mm" as numbers in ``unit``, as far as that is one ("Pa (inf: rigid)" is).
    Raises `InputError`, as `without_unit` does."""
    unit = "-" if unit in ("", "(-)") else spelled(re.sub(r" \(.*", "", unit))
    return without_unit(name, python_value(value), unit) if any(unit in row for row in UNITS.values()) else value


def _real(value: Any) -> float:
    """Return ``value`` as a float. Raises TypeError if it is not one real number, OverflowError if it is too large for
    a float."""
    if type(value) in (float, int):
        return float(value)
    if isinstance(value, (np.ma.MaskedArray, str, bytes)):
        raise TypeError
    if not isinstance(value, (np.ndarray, np.generic)) and isinstance(value, (Real, Decimal)):
        if isinstance(value, bool):
            raise TypeError
        return float(value)
    scalar = np.asarray(value)
    if scalar.ndim or scalar.dtype.kind not in NUMBER_KINDS:
        raise TypeError
    return float(scalar[()])


def number(
    name: str, value: Any, unit: str, *, above: float = -math.inf, minimum: float = -math.inf, maximum: float = math.inf
) -> float:
    """Return ``value`` as a finite real number with ``above < value``, ``minimum <= value <= maximum``.

    Whatever the limits, its magnitude is at most the largest of `SANE` for its unit, and zero or at least
    `SMALLEST_NUMBER`.
    """
    return _within(name, value, unit, above, minimum, maximum, SMALLEST_NUMBER if unit in SANE else 0.0)


def positive(name: str, value: Any, unit: str, *, minimum: float = 0.0, maximum: float = math.inf) -> float:
    """Return ``value`` as a finite number > 0, in [minimum, maximum] and in the range of `SANE` for its unit."""
    least = max(minimum, SANE.get(unit, (SMALLEST_NUMBER, LARGEST_NUMBER))[0])
    return _within(name, value, unit, 0.0, -math.inf, maximum, least)


def _within(name: str, value: float, unit: str, above: float, minimum: float, maximum: float, least: float) -> float:
    """Return ``value`` as a finite number above ``above``, in [minimum, maximum], and at least ``least`` in size unless
    it is 0."""
    largest = SANE.get(unit, (SMALLEST_NUMBER, LARGEST_NUMBER))[1]
    minimum = max(minimum, -largest)
    maximum = min(maximum, largest)
    if type(value) is float and above < value and minimum <= value <= maximum and (value == 0 or abs(value) >= least):
        return value
    low = f"above {above:g}, up to" if above >= minimum else f"{minimum:g} to"
    shown_unit = "" if unit == "-" else f" {unit}"
    allowed = f"{low} {maximum:g}{shown_unit}"
    value = in_plain(name, value, unit) if isinstance(value, str) else value
    try:
        x = _real(value)
    except OverflowError:
        raise InputError(f" = {shown(value)}{shown_unit} is out of range", name, allowed) from None
    except (TypeError, ValueError, RecursionError):
        raise InputError(f" = {shown(value)} is not a number", name, allowed) from None
    if not (math.isfinite(x) and x > above and minimum <= x <= maximum):
        smallest = max(minimum, least if above >= 0 else 0.0)
        sign = ", as it has to be positive" if x <= 0 < smallest else ""
        raise InputError(f" = {x:g}{shown_unit} is out of range{sign}", name, allowed)
    if 0 < abs(x) < least:
        raise InputError(
            f" = {x:g}{shown_unit} is too small", name, f"{allowed}, of at least {least:g} where it is not 0"
        )
    return x


def nonnegative(name: str, value: Any, unit: str, *, maximum: float = math.inf) -> float:
    """Return ``value`` as a finite number >= 0."""
    return number(name, value, unit, minimum=0.0, maximum=maximum)


def in_range(section: str, part: Any, prefix: str | None = None) -> None:
    """Check the numbers and the choices among the fields of a ``section`` of a scene by what keys.toml says of them;
    None is let pass where it is the default. ``prefix``: of their names in messages (None: the section)."""
    for key, field in part.__dataclass_fields__.items():
        name = f"{section}.{key}"
        value = getattr(part, key)
        called = name if prefix is None else prefix + key
        if name in CHOICES:
            choice(called, value, CHOICES[name])
        elif name in KEYS and KEYS[name].limited and (value is not None or field.default is not None):
            of_key(name, value, called)


def of_key(name: str, value: Any, called: str | None = None) -> float:
    """Return ``value`` as a number that the key ``name`` of a scene can have, by keys.toml; ``called``: its name in
    messages."""
    q = KEYS[name]
    unit = "(-)" if q.unit == "-" else q.unit
    if q.above == 0:
        return positive(called or name, value, unit, maximum=q.most)
    return number(called or name, value, unit, minimum=q.least, maximum=q.most)


def integer(name: str, value: Any, *, minimum: int, maximum: int | None = None) -> int:
    """Return ``value`` as an integer >= ``minimum`` and <= ``maximum``."""
    is_integer = isinstance(value, (int, np.integer)) and not isinstance(value, (bool, np.timedelta64))
    if not is_integer or value < minimum or maximum is not None and value > maximum:
        allowed = f">= {minimum}" if maximum is None else f"from {minimum} to {_power_of_two(maximum)}"
        raise InputError(f" = {shown(value)} must be a whole number {allowed}", name)
    return int(value)


def _power_of_two(number: int) -> str:
    """Return a whole number as text, a long one below a power of two as "2^128 - 1"."""
    power = (number + 1).bit_length() - 1
    return f"2^{power} - 1" if power > LONG_NUMBER and number + 1 == 2**power else f"{number}"


def boolean(name: str, value: Any) -> bool:
    """Return ``value`` as True or False; a word such as "no" is neither."""
    if not isinstance(value, (bool, np.bool_)):
        raise InputError(f" = {shown(value)} is neither true nor false", name, "true, false")
    return bool(value)


def instance(name: str, value: Any, kind: type | tuple[type, ...], allowed: str) -> None:
    """Check that ``value`` is of ``kind``. ``allowed`` says how to get such a value."""
    if not isinstance(value, kind):
        raise InputError(f" = {shown(value)} is a {type(value).__name__}", name, allowed)


def called_back(name: str, value: Any, arguments: str) -> None:
    """Check that ``value`` is None or a function, which is called with these ``arguments``."""
    if value is not None and not callable(value):
        raise InputError(
            f" = {shown(value)} is a {type(value).__name__}", name, f"None, or a function of ({arguments})"
        )


def array(name: str, value: Any, unit: str, *, ndim: int) -> np.ndarray:
    """Return ``value`` as a non-empty array of finite floats with ``ndim`` axes; ``value`` itself if it is one.

    Refused with `InputError`: truth values, complex numbers, words, dates and None, which NumPy would turn into
    numbers, and a masked array with masked values, whose mask it would drop.
    """
    a = real_array(name, value, unit)
    if np.ma.is_masked(value):
        message = f" has {np.count_nonzero(np.ma.getmaskarray(value))} of {a.size} values masked"
        raise InputError(message, name, f"none (finite values in {unit})")
    if a.ndim != ndim:
        raise InputError(f" has {a.ndim} axes (shape {a.shape})", name, f"exactly {ndim} [{unit}]")
    if a.size == 0:
        raise InputError(f" is empty (shape {a.shape})", name, f"at least one value [{unit}]")
    with np.errstate(invalid="ignore"):
        furthest = max(float(a.max()), -float(a.min()))  # NaN where any value is
    if not math.isfinite(furthest):
        bad = a.size - np.count_nonzero(np.isfinite(a))
        message = f" has {bad} of {a.size} values that are NaN or infinite"
        raise InputError(message, name, f"finite values in {unit}")
    most = SANE.get(unit, (SMALLEST_NUMBER, LARGEST_NUMBER))[1]
    if furthest > most:
        raise InputError(f" reaches {furthest:g} {unit}", name, f"up to {most:g} {unit}")
    return a


def numbers(name: str, values: Any, unit: str, most: float) -> np.ndarray:
    """Return one number, or a list of them, as an array (n,) of its own, of magnitudes up to ``most``."""
    values_given = array(name, listed(values), unit, ndim=1).copy()
    for value in values_given.tolist():
        number(name, value, unit, minimum=-most, maximum=most)
    return values_given


def listed(values: Any) -> Any:
    """Return one value as a list of one; anything else unchanged, for `array` to check."""
    try:
        return [values] if np.ndim(values) == 0 else values
    except ValueError:  # a list of lists of several lengths
        return values


def folder(name: str, value: Any) -> Path:
    """Return a path as words or a `pathlib.Path` that the file system takes, whether or not there is anything. A "~" is
    the home directory."""
    if isinstance(value, (str, os.PathLike)) and value != "" and "\0" not in str(value):
        # a TypeError of a path that is not of words, a RuntimeError of the home of an unknown user
        with suppress(OSError, TypeError, RuntimeError):
            path = Path(value).expanduser()
            path.exists()
            return path
    raise InputError(f" = {shown(value)} is not a path", name, "a string or a pathlib.Path that the file system takes")


def real_array(name: str, value: Any, unit: str) -> np.ndarray:
    """Return ``value`` as an array of floats of any shape, which may contain NaN and infinity. A mask is dropped."""
    odd = _odd_entry(value, DEEPEST)
    try:
        numbers_given = np.empty(0) if odd else np.asarray(value)
        if numbers_given.dtype.kind == "U":
            numbers_given = np.asarray(in_plain(name, value, unit))
        if numbers_given.dtype.kind == "O":
            numbers_given = np.array([_real(x) for x in numbers_given.ravel()], dtype=float).reshape(
                numbers_given.shape
            )
    except InputError:
        raise
    except (TypeError, ValueError, OverflowError, RecursionError):
        instead = f"its .heights [{unit}]" if hasattr(value, "heights") else ""
        message = f" is {'a height map, ' if instead else ''}not an array of numbers in {unit}"
        raise InputError(message, name, instead) from None
    if odd or numbers_given.dtype.kind not in NUMBER_KINDS:
        raise InputError(f" holds {odd or f'values of type {numbers_given.dtype}'}", name, f"real numbers in {unit}")
    with np.errstate(over="ignore"):
        return numbers_given.astype(float, copy=False)


def _odd_entry(value: Any, depth: int) -> str:
    """Return the first entry of a list that is no number but that NumPy would make one: True, False or a masked
    value."""
    if isinstance(value, (list, tuple)) and depth > 0:
        return next(filter(None, (_odd_entry(v, depth - 1) for v in value)), "")
    if isinstance(value, (bool, np.bool_)):
        return "truth values"
    return "masked values" if value is np.ma.masked else ""


def choice(name: str, value: Any, options: Iterable[Any]) -> Any:
    """Return ``value`` if it is one of ``options``; the error names the nearest valid one."""
    options = tuple(options)
    if isinstance(value, (str, int, np.integer)) and not isinstance(value, bool) and value in options:
        return options[options.index(value)]
    meant = (OTHER_VALUES | OTHER_OPTIONS).get(value.lower()) if isinstance(value, str) else None
    near = f" (did you mean {meant!r}?)" if meant in options else nearest(value, options)
    raise InputError(f" = {shown(value)} is not known{near}", name, ", ".join(map(repr, options)))


def nearest(word: Any, options: Iterable[Any], cutoff: float = 0.4) -> str:
    """Return ' (did you mean ...?)' or an empty string; ``cutoff``: the least likeness, 0 to 1."""
    text = word[:LONGEST_SHOWN] if isinstance(word, str) else shown(word)
    matches = difflib.get_close_matches(text, [str(o) for o in options], n=1, cutoff=cutoff)
    return f" (did you mean {matches[0]!r}?)" if matches else ""


def installed(name: str, extra: str) -> Any:
    """Import the optional package ``name`` of that ``extra``; `InputError` where it is not installed."""
    try:
        return import_module(name)
    except ImportError as problem:
        message = f"this needs the package {name}: pip install 'lubfric[{extra}]' ({problem})"
        raise InputError(message) from None


def keys(where: str, given: Iterable[Any], allowed: Iterable[str], other: Callable[[], dict[str, str]] = dict) -> None:
    """Raise `InputError` for a key of ``given`` that is none of ``allowed``. ``other`` gives other words for keys, and
    what to write instead; the similarity of the letters decides where a word is not among them."""
    options = list(allowed)
    for key in given:
        if key not in options:
            word = key.lower() if isinstance(key, str) else ""
            words = other()
            meant = repr(word) if word in options else words.get(word)
            near = f" (did you mean {meant}?)" if meant else nearest(key, options, 0.6)
            raise InputError(f"unknown key {shown(key)} in {where}{near}; allowed: {', '.join(options)}")


def pair(name: str, value: Any, check: Callable[[str, Any], T], what: str) -> tuple[T, T]:
    """Return both parts of a pair for x and y, as ``check(name, part)`` returns them; one value represents both.
    ``what``: one of them as text."""
    several = isinstance(value, (list, tuple)) or isinstance(value, np.ndarray) and value.ndim == 1
    if several and len(value) != 2:
        raise InputError(f" = {shown(value)} must be {what} or a pair of them, for x and y", name)
    if several and isinstance(value[0], str) != isinstance(value[1], str):
        message = f" = {shown(value)} has one part with a unit and one without one"
        raise InputError(message, name, recommendation="give each its unit, or none")
    first, second = (check(f"{name}[{i}]", part) for i, part in enumerate(value if several else (value, value)))
    return first, second


def spacing(name: str, value: Any) -> tuple[float, float]:
    """Return (dx, dy) in metres; one number means equal spacing."""
    return pair(name, value, lambda n, step: positive(n, step, "m", minimum=1e-15, maximum=1e3), "one length in m")
