"""Units as people write them, once: for scene files, the command line, headings of tables, and results on request.

Each row of units.toml holds the units of one kind of quantity, as factors to the SI unit at its head. Numbers are
converted in decimals, so that "68 mm2/s" is 6.8e-05 m2/s to the last bit.
"""

import math
import re
import tomllib
from collections.abc import Iterable
from decimal import (
    MAX_EMAX,
    MIN_EMIN,
    ROUND_HALF_EVEN,
    Context,
    Decimal,
    DivisionByZero,
    InvalidOperation,
    localcontext,
)
from difflib import get_close_matches
from importlib.resources import files
from statistics import median
from typing import Any

from .errors import InputError

ZERO_CELSIUS = Decimal("273.15")  # K
# Decimals of a number that is printed with its interval, at most. A choice: more shows rounding.
MOST_DECIMALS = 7

# Numbers without a unit below the one, or from the other on, are printed with a power of ten. A choice, for numbers
# that can be read.
SMALLEST_PLAIN = 1e-4
LARGEST_PLAIN = 1e6
_TABLE = tomllib.loads((files(__package__) / "units.toml").read_text(encoding="utf-8"))
UNITS: dict[str, dict[str, float]] = _TABLE["units"]
PEOPLE: dict[str, list[str]] = _TABLE["people"]
SANE: dict[str, list[float]] = _TABLE["sane"]
HV = UNITS["Pa"]["HV"]
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)
LONGEST_TEXT = 200  # characters of a number with its unit; a choice: longer text is no number
# Of conversions: that of the host may have any precision, and traps. 60 digits are a choice, far more than numbers
# have.
_EXACT = Context(
    prec=60, rounding=ROUND_HALF_EVEN, Emin=MIN_EMIN, Emax=MAX_EMAX, traps=[DivisionByZero, InvalidOperation]
)
MICRO = "\N{MICRO SIGN}\N{GREEK SMALL LETTER MU}"
RAISED = str.maketrans("23", "²³")
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
SPELLINGS = str.maketrans(f"{MICRO}\N{MINUS SIGN}\N{SUPERSCRIPT MINUS}¹²³·⋅*", "uu--123   ", "^")
OTHER_WORDS = {"degC": "°C", "C": "°C", "micron": "um", "W/mK": "W/(m K)", "deg": "°"}


def spelled(unit: str) -> str:
    """Return ``unit`` as in the table: a u for the sign of micro, digits for raised ones, single spaces between
    factors."""
    text = " ".join(unit.translate(SPELLINGS).split())
    text = re.sub(r"(?<=Pa)\s?\.?\s?s$", " s", text)  # Pa.s
    text = re.sub(r"^1? ?/ ?", "1/", text)
    inverse = re.fullmatch(r"(\w+) ?-1", text)  # GPa^-1
    text = f"1/{inverse[1]}" if inverse else text
    text = re.sub(r"/(\w+)[ /]K$|/\((\w+)[ .]K\)$", lambda m: f"/({m[1] or m[2]} K)", text)  # W/m K, W/m/K
    return OTHER_WORDS.get(text, text)


def kind_of(unit: str) -> str:
    """Return the SI unit of the row that holds ``unit``; KeyError for one that no row holds."""
    for si, row in UNITS.items():
        if unit in row:
            return si
    raise KeyError(unit)


def converted(value: Any, unit: str, to: str) -> Any:
    """Return ``value`` (a number, an array, or a `Decimal`, which stays one) in the unit ``to`` instead of ``unit``,
    both in one row of the table. Raises `InputError` for a unit that is not in the row of the other."""
    unit = spelled(unit)
    to = spelled(to)
    row = UNITS[kind_of(unit)]
    if to not in row:
        raise InputError(f" = {to!r} is not a unit of a number in {unit}", "unit", ", ".join(filter(None, row)))
    if to == unit:
        return value
    exact = isinstance(value, Decimal)
    first, second = (Decimal(repr(row[name])) if exact else row[name] for name in (unit, to))
    shift = ZERO_CELSIUS if exact else float(ZERO_CELSIUS)
    with localcontext(_EXACT):
        in_si = value * first + (shift if unit == "°C" else 0)
        return (in_si - (shift if to == "°C" else 0)) / second


def number_and_unit(text: str) -> tuple[str, str] | None:
    """Return the number and the unit (perhaps none) of a text such as "12 mm"; None where it does not begin with a
    number, has a decimal comma, or is too long."""
    text = text.strip().replace("\N{MINUS SIGN}", "-")
    number = _NUMBER.match(text) if len(text) <= LONGEST_TEXT else None
    if number is None:
        return None
    unit = text[number.end() :]
    return None if unit[:1].isdigit() or unit[:1] in (".", ",") else (number[0], unit.strip())


def unit_for(values: Any, unit: str) -> str:
    """Return the unit of people for numbers in the SI ``unit``: the largest in which a number of middle size is 1 or
    more. Zeros, NaN and infinities do not count; numbers of which none counts are in the SI unit."""
    units = PEOPLE.get(unit, (unit,))
    sizes = [abs(v) for v in values if v and abs(v) < math.inf]
    if not sizes and unit in units:
        return unit
    middle = median(sizes) if sizes else 0.0
    large = (name for name in reversed(units[1:]) if middle >= UNITS[unit][name] * (1 - 1e-9))
    return next(large, units[0])


def unit_of_largest(values: Any, unit: str) -> str:
    """Return the unit of people in which the largest of the numbers in the SI ``unit`` is 1 or more: for a column of a
    table or an axis, whose largest number has to read well."""
    sizes = [abs(value) for value in values if abs(value) < math.inf]
    return unit_for([max(sizes, default=0.0)], unit)


def printed(unit: str) -> str:
    """Return ``unit`` as printed: "µm", "m²"; "" for "-"."""
    raised = re.sub(r"(?<=[A-Za-z])[23]", lambda digit: digit[0].translate(RAISED), unit)
    return "" if unit == "-" else re.sub(r"^u(?=m|s|J)", "µ", raised)


def worded(value: Any, unit: str) -> str:
    """Return a number, or several of one kind, in the SI ``unit``, to four digits in a common unit: "12 mm". What is no
    number is left unchanged."""
    values = value if isinstance(value, (tuple, list)) else (value,)
    if not values or not all(isinstance(v, (int, float)) for v in values) or isinstance(values[0], bool):
        return str(value)
    name = unit_for(values, unit)
    shown = [converted(v, unit, name) if name != unit else v for v in values]
    text = " and ".join(f"{v:.4g}" for v in shown)
    if len(shown) > 3:
        text = f"{len(shown)} values, {min(shown):.4g} to {max(shown):.4g}"
    return f"{text} {printed(name)}".rstrip()


def range_in_words(low: Any, high: Any, unit: str) -> str:
    """Return "300 to 700 N", or one number where both are alike; of pairs "5 and 20 µm to 20 and 80 µm"."""
    if worded(low, unit) == worded(high, unit):
        return worded(high, unit)
    if isinstance(low, tuple):
        return f"{worded(low, unit)} to {worded(high, unit)}"
    return worded((low, high), unit).replace(" and ", " to ")


def with_interval(value: float, low: float, high: float, level: str = " at 95 %", unit: str = "-") -> str:
    """Return a ``value`` in the SI ``unit`` with its interval: "0.0443 (0.0413 to 0.0473 at 95 %)", "3.39 W (3.36 to
    3.43 W at 95 %)".

    All three have as many decimals as show two digits of half the width of the interval, or none, and one unit of
    people; numbers without a unit that are all smaller than `SMALLEST_PLAIN` have a common power of ten. Without a
    finite interval the value is alone, with three digits.
    """
    head = beside_interval(value, low, high, unit)
    return f"{head} ({interval_in_words(low, high, unit, value)}{level})" if _is_interval(low, high) else head


def beside_interval(value: float, low: float, high: float, unit: str = "-") -> str:
    """Return a ``value`` in the decimals and the unit in which `with_interval` writes it, without its interval."""
    return _shown(value, low, high, unit)[0] if _is_interval(low, high) else plain_number(value, unit)


def as_beside(part: float, value: float, low: float, high: float, unit: str) -> str:
    """Return a ``part`` of a ``value`` with the unit and the decimals that `with_interval` shows of the value; a part
    smaller than half the width of the interval, of which these may show no digit, as `plain_number`."""
    if not _is_interval(low, high):
        return plain_number(part, unit)
    if abs(part) < 0.5 * (high - low):
        return plain_number(part, unit, 2)
    return _shown(value, low, high, unit, part)[-1]


def interval_in_words(low: float, high: float, unit: str = "-", value: float = math.nan) -> str:
    """Return "0.0413 to 0.0473", as `with_interval` writes it around a ``value``."""
    if not (math.isfinite(low) and math.isfinite(high)):
        return "not known"
    if not _is_interval(low, high):
        return f"{plain_number(low, unit, 4)} to {plain_number(high, unit, 4)}"
    (_, first, last) = _shown(value, low, high, unit)
    same_unit = first.partition(" ")[2]
    return f"{first.removesuffix(f' {same_unit}')} to {last}"


def plain_number(value: float, unit: str = "-", digits: int = 3) -> str:
    """Return a ``value`` in the SI ``unit`` to so many ``digits``, in a common unit, or with a power of ten where it
    has none and is very small or large: "8.3 nm", "2.8·10⁻⁶"."""
    if not math.isfinite(value):
        return "not known" if math.isnan(value) else f"{value}"
    name = unit_for([value], unit)
    number = converted(value, unit, name) if name != unit else value
    if number and not SMALLEST_PLAIN <= abs(number) < LARGEST_PLAIN:
        power = math.floor(math.log10(abs(number)))
        text = f"{number / 10.0**power:.{digits}g}·10{str(power).translate(SUPERSCRIPTS)}"
    else:
        rounded = f"{number:.{max(digits, 1 + math.floor(math.log10(abs(number))))}g}" if number else "0"
        text = f"{float(rounded):g}"  # 999.6 is rounded to 1000, not 1e+03
    return f"{text} {printed(name)}".rstrip()


def in_unit_of(part: float, value: float, unit: str) -> str:
    """Return a ``part`` of a ``value`` in the SI ``unit``, or its deviation, to two digits in the unit of people of the
    value."""
    name = unit_for([value], unit)
    number = converted(part, unit, name) if name != unit else part
    return f"{plain_number(number, digits=2)} {printed(name)}".rstrip()


def _is_interval(low: float, high: float) -> bool:
    return 0 < high - low < math.inf


def _shown(value: float, low: float, high: float, unit: str, *others: float) -> list[str]:
    """Return the three numbers with as many decimals as show two digits of half the width of the interval, in one unit
    of people or with one power of ten; and the ``others`` as these."""
    numbers = [value, low, high, *others]
    largest = max(abs(number) for number in numbers if math.isfinite(number))
    name = unit_for([value if math.isfinite(value) and value else largest], unit)
    if name != unit:
        numbers = [converted(number, unit, name) for number in numbers]
    after = f" {printed(name)}".rstrip()
    if unit == "-" and largest < SMALLEST_PLAIN:
        power = math.floor(math.log10(largest))
        numbers = [number / 10.0**power for number in numbers]
        after = f"·10{str(power).translate(SUPERSCRIPTS)}"
    half = 0.5 * (numbers[2] - numbers[1])
    digits = min(max(1 - math.floor(math.log10(half)), 0), MOST_DECIMALS)
    return [f"{number:z.{digits}f}{after}" for number in numbers]


def without_unit(name: str, value: Any, unit: str, named: Iterable[str] = (), depth: int = 3) -> Any:
    """Return ``value`` in ``unit`` where it is text with a unit, such as "12 mm"; anything else unchanged.

    Lists are gone through, nested up to ``depth`` times. ``unit`` may name several, "m/s, m/s, -", one for each part of
    a list. ``name``: of the key; ``named``: words that it takes too, and that are left as they are.
    Raises `InputError` for text that is no number with a unit, and for a unit of another kind.
    """
    if isinstance(value, (list, tuple)) and depth:
        several = unit.split(", ")
        if len(several) != len(value) or any(isinstance(part, (list, tuple)) for part in value):
            several = [unit] * len(value)
        check_all_have_units(name, value, several)
        return type(value)(without_unit(name, part, one, named, depth - 1) for part, one in zip(value, several))
    if not isinstance(value, str) or value in named or ", " in unit:  # one word for a list: not for this to refuse
        return value
    if value.strip().lower() == "inf":
        return math.inf
    parts = number_and_unit(value)
    row = UNITS[kind_of(unit)]
    shown = value if len(value) < 40 else f"{value[:40]} ..."
    examples = [f"'20{other if other == '%' else ' ' + other}'" for other in row if other not in ("", "-")][:5]
    plain = "a plain number" if unit == "-" else f"a plain number in {unit}"
    allowed = f"{plain}, or one with a unit in quotes: {', '.join(examples)}"
    allowed += f", or a range [low, high], or a name: {', '.join(named)}" if named else ""
    if parts is None or not parts[1]:
        none = " is neither a number with a unit nor a known name" if named else " is not a number with a unit"
        comma = re.match(r"\s*[+-]?\d{1,40},\d{1,40}", value)
        none += f": write a point in decimals, {shown.replace(',', '.', 1).strip()}" if comma else ""
        message = " has no unit: omit the quotes, or add one" if parts else none
        raise InputError(f" = {shown!r}{message}", name, allowed)
    (digits, written) = parts
    given = spelled(written)
    if given not in row:
        other = next((si for si, units in UNITS.items() if given in units), "")
        if unit == "N" and other == "N/m":
            allowed += "; a load per length times the length of the line, bodies.width, is the load"
        hrc = given == "HRC" and "HV" in row
        target = "a number without a unit" if unit == "-" else unit
        message = (
            f"is in {written}, which does not convert to {target}" if other else f"has an unknown unit, {written!r}"
        )
        if named and not other:
            near = get_close_matches(value, [*named], n=3)
            meant = f" (did you mean {' or '.join(map(repr, near))}?)" if near else ""
            message = f"is no known name{meant}, and no number with a known unit"
        if unit == "Pa s" and other == "m2/s":
            allowed += "; a kinematic viscosity goes into nu40 (at 40 °C), together with nu100 or viscosity_index"
        message = "is not a pressure; give HV: 57 HRC is 633 HV, 60: 697, 63: 772" if hrc else message
        raise InputError(f" = {shown!r} {message}", name, allowed)
    try:
        return float(converted(Decimal(digits, _EXACT), given, unit))
    except (ArithmeticError, ValueError):
        raise InputError(f" = {shown!r} is out of range", name, allowed) from None


def check_all_have_units(name: str, values: Iterable[Any], units: Iterable[str]) -> None:
    """Raise `InputError` where some of the ``values`` are text with a unit and others, of the same one of ``units``,
    are plain numbers: ["1 mm/s", 5] may mean 5 mm/s or 5 m/s, and "1,5 mm/s", split at its comma, is 1 and 5 mm/s. A
    zero needs no unit. What is in no unit of that row is not for this to refuse."""
    bare: dict[str, str] = {}
    with_unit: dict[str, str] = {}
    for value, unit in zip(values, units):
        if isinstance(value, str):
            parts = number_and_unit(value)
            known = parts is not None and (not parts[1] or spelled(parts[1]) in UNITS.get(spelled(unit), ()))
            if parts is not None and known and (parts[1] or float(parts[0]) != 0):
                (with_unit if parts[1] else bare).setdefault(unit, value.strip())
        elif isinstance(value, (int, float)) and not isinstance(value, bool) and value != 0 and math.isfinite(value):
            bare.setdefault(unit, str(value))
    for unit in bare.keys() & with_unit.keys():
        message = f" has {with_unit[unit][:40]!r} with a unit and {bare[unit][:40]} without one"
        raise InputError(message, name, recommendation="give each its unit, or none; write a point in decimals, 1.5")


def numbers_of(name: str, words: list[str], units: list[str]) -> list[float]:
    """Return the numbers in ``units`` that the ``words`` of a command line give. Raise `InputError` where some have a
    unit and others, of the same kind, have none."""
    check_all_have_units(name, words, units)
    return [number_of(name, word, unit) for word, unit in zip(words, units)]


def in_si(name: str, text: str) -> tuple[float, str]:
    """Return the number that ``text`` with a unit gives, in SI, and that SI unit. Raises `InputError`, as
    `without_unit`."""
    parts = number_and_unit(text)
    unit = next((si for si, row in UNITS.items() if parts and spelled(parts[1]) in row), "-")
    return without_unit(name, text, unit), unit


def number_of(name: str, text: str, unit: str) -> float:
    """Return the number in ``unit`` that ``text`` of a command line gives, alone ("0.01") or with a unit ("1 cm")."""
    if _NUMBER.fullmatch(text.strip()) and len(text) <= LONGEST_TEXT:
        return float(text)
    if text.strip().lower() in ("nan", "inf", "+inf", "-inf", "infinity", "-infinity"):
        return float(text)  # refused with its name by what takes the number
    number: float = without_unit(name, text, unit)
    return number
