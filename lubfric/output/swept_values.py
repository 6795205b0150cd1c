"""The speeds and the slide-roll ratios of a command, as lists or ranges."""

from __future__ import annotations

import re

import numpy as np

from .. import studies
from .._base import validate
from ..errors import InputError
from ..quantities import counted
from ..scene import (
    FASTEST,
    LARGEST_RATIO,
    MOST_RATIO,
    MOST_SPEEDS,
    check_ratios,
)
from ..units import number_and_unit, number_of, numbers_of
from .commands import (
    say,
)


def parse_speeds(option: str, text: str | None, unit: str = "m/s", most: float = FASTEST) -> list[float]:
    """Return the values of a command's ``option``: 'a,b,c' or the geometric 'low:high:count', in ``unit`` or each with
    its own; none above ``most``."""
    if text is None:
        return []
    if ":" in text:
        return _range(option, text.split(":"), unit, most, linear=False)
    words = text.split(",")
    decimal = re.fullmatch(r"\s*([+-]?\d+),(\d+)(\s*[^\s\d.,:][^,]*)?", text)  # '0,2 m/s'
    if decimal is not None or any(re.match(r"[+-]?0\d", word.strip()) for word in words):
        likely = "write a point in decimals, 0.01"
        if decimal is not None:
            (first, second, suffix) = ((part or "").rstrip() for part in decimal.groups())
            likely = (
                f"write a point in decimals, '{first}.{second}{suffix}', or for two values '{first}{suffix}, "
                f"{second}{suffix}'"
            )
        raise InputError(f"{option} {validate.shown(text)}: a comma separates values; {likely}")
    apart = text.split()
    if len(words) == 1 and len(apart) > 1 and all(_is_number(word) for word in apart):
        raise InputError(
            f" {validate.shown(text)}", option, recommendation=f"separate values by commas, {','.join(apart)}"
        )
    ends = re.fullmatch(r"\s*(\S+)\s+to\s+(\S+)\s*", text)
    if ends is not None:
        example = f"{ends[1]}:{ends[2]}:11"
        raise InputError(f" {validate.shown(text)}", option, recommendation=f"write low:high:count, such as {example}")
    numbers = numbers_of(option, words, [unit] * len(words))
    for number in numbers:
        validate.number(option, number, unit, minimum=-most, maximum=most)
    once = list(studies.each_once(numbers))
    if len(once) < len(numbers):
        say(f"{option}: {counted(len(numbers) - len(once), 'values')} given twice, solved once")
    return once


def _is_number(word: str) -> bool:
    """Return whether a ``word`` is a number without a unit."""
    parts = number_and_unit(word)
    return parts is not None and parts[1] == ""


def in_percent(ratios: list[float]) -> list[float] | list[str]:
    """Return ``ratios`` that were checked as text in percent, where some are such as `lubfric.traction` questions."""
    return [f"{100 * ratio!r} %" for ratio in ratios] if max(map(abs, ratios)) > MOST_RATIO else ratios


def parse_ratios(text: str | None) -> list[float]:
    """Return the slide-roll ratios of --ratios: 'a,b,c', or 'low:high:count', geometric, or in equal steps where low is
    0 or negative or ':linear' follows."""
    parts = [] if text is None else text.split(":")
    spacing = parts.pop().strip().lower() if len(parts) == 4 else ""
    if spacing not in ("", "linear", "log"):
        raise InputError(f" {validate.shown(text)} ends with {validate.shown(spacing)}", "--ratios", "linear or log")
    if len(parts) != 3:
        ratios = parse_speeds("--ratios", ":".join(parts) if parts else text, "-", LARGEST_RATIO)
    else:
        at_zero = number_of("--ratios", parts[0], "-") <= 0
        linear = spacing == "linear" or (at_zero and spacing == "")
        ratios = _range("--ratios", parts, "-", LARGEST_RATIO, linear=linear)
    if "%" not in (text or ""):
        check_ratios("--ratios", ratios)
    return ratios


def _with_unit_of_end(low: str, high: str) -> list[str]:
    """Return both ends of a range, the ``low`` one with the unit of the ``high`` one where it has none:
    "0.1:5 m/s:11"."""
    first = number_and_unit(low)
    last = number_and_unit(high)
    if first is None or last is None or first[1]:
        return [low, high]
    return [f"{low.strip()} {last[1]}".strip(), high]


def _range(option: str, words: list[str], unit: str, most: float, *, linear: bool) -> list[float]:
    """Return the values of a range of ``words`` low, high and count, in equal steps or geometric. Raise `InputError`
    that says what is wrong with it, and what to write."""
    text = validate.shown(":".join(words))
    example = "0:0.5:11" if linear else "0.001:1:13"
    if len(words) != 3:
        parts = counted(len(words), "parts")
        raise InputError(f" {text} has {parts}", option, recommendation=f"write low:high:count, such as {example}")
    (low, high) = numbers_of(option, _with_unit_of_end(words[0], words[1]), [unit, unit])
    count = number_of(option, words[2], "-")  # without a unit, also where the ends are in percent
    for end in (low, high):
        validate.number(option, end, unit, minimum=-most, maximum=most)
    shown = "" if unit == "-" else f" {unit}"
    if low == high:
        recommendation = f"write {low:g} for this value alone"
        raise InputError(f" {text} begins and ends at {low:g}{shown}", option, recommendation=recommendation)
    if low > high:
        recommendation = f"write the smaller one first, {words[1].strip()}:{words[0].strip()}:{words[2].strip()}"
        raise InputError(
            f" {text} begins at {low:g}{shown}, above its end {high:g}{shown}", option, recommendation=recommendation
        )
    if not linear and low <= 0:
        recommendation = "begin above 0, or list the values, separated by commas"
        recommendation += ", or end it with :linear" if option == "--ratios" else ""
        raise InputError(
            f" {text} begins at {low:g}{shown}: a geometric range has no value at or below 0",
            option,
            recommendation=recommendation,
        )
    if count not in range(2, MOST_SPEEDS + 1):
        recommendation = f"write a whole number from 2 to {MOST_SPEEDS}" + (
            f", or {low:g} for one value" if count == 1 else ""
        )
        raise InputError(f" {text} has {count:g} values", option, recommendation=recommendation)
    if linear:
        return [
            float(f"{value:.12g}") for value in np.linspace(low, high, int(count))
        ]  # 0.05, not 0.049999999999999996
    values: list[float] = np.geomspace(low, high, int(count)).tolist()
    return values
