"""A table of numbers in text: the titles above it, what separates its values, and its decimal mark.

A point is always a decimal mark. A comma separates values, or it is the decimal mark. It is read where the lines admit
only one of the two, and is an error where they admit both.
"""

from __future__ import annotations

import re

import numpy as np

from ..errors import InputError

DECIMALS = (".", ",")
UNIT_WORDS = {"mm": "mm", "um": "um", "µm": "um", "μm": "um", "micron": "um", "microns": "um", "nm": "nm"}
MISSING_WORDS = {"na", "n/a", "null", "none", "bad", "missing"}

_NUMBER = re.compile(r"[+-]?(?:(?:\d+[.,]?\d*|[.,]\d+)(?:e[+-]?\d+)?|nan|inf|infinity)", re.I)
_VALUE = r"(?:[+-]?(?:\d+(?:,\d+)?(?:[eE][+-]?\d+)?|[nN][aA][nN]))"
_EMPTY = re.compile(r"\t\s*\t")  # a value left out between tabs
_BLANKS_BETWEEN = re.compile(rf"{_VALUE}(?:\s+{_VALUE})*")  # '1,5 2,5'
_PAIR = r"[+-]?\d+,\d+(?:[eE][+-]?\d+)?"
_BOTH_WAYS = re.compile(rf"{_PAIR}(?:,\s*{_PAIR})*")  # '1,5' or '1,5,2,5'

_COMMA_BLANK = re.compile(rf"{_VALUE}(?:,\s+{_VALUE})*")  # '1,5, 2' or '1, 2'

Lines = list[tuple[int, str]]  # (line number in the file, text without blanks around it)


def read_table(path, lines: Lines, decimal=None, unit=None) -> tuple[np.ndarray, tuple[str, ...]]:
    """(rows, columns) of the numbers, and notes of the titles skipped and of a decimal comma.

    lines : without comments. decimal : ".", "," or None to find out. unit : what the caller takes the lengths for;
    None makes a title that names another unit than metres an error. Raises `InputError` naming the line.
    """
    titles, lines = _split_titles(path, lines)
    if unit is None:
        _check_units(path, titles)
    notes = tuple(f"line {number} skipped as a title: {text[:60]!r}" for number, text in titles)
    separator, comma = _marks(path, lines, decimal)
    if separator is not None and all(text.endswith(separator) for _, text in lines):
        lines = [(number, text[:-1].rstrip()) for number, text in lines]  # a separator behind every line
    if comma:
        _refuse_points(path, lines)
        lines = [(number, re.sub(r",(?=\s)", " ", text).replace(",", ".")) for number, text in lines]
        notes += ("decimal comma",)
    try:
        return np.loadtxt([text for _, text in lines], delimiter=separator, ndmin=2, comments=None), notes
    except ValueError as problem:
        raise InputError(
            f"path = {str(path)!r} is not a table of numbers: {_fault(lines, separator) or problem}; "
            "allowed: lines of equally many numbers, 'nan' where unmeasured"
        ) from None


def _wrong(path, number, text, words) -> InputError:
    return InputError(f"path = {str(path)!r}: line {number} {text[:60]!r} {words}")


def _split_titles(path, lines: Lines) -> tuple[Lines, Lines]:
    """Leading lines without any number are titles; a leading line with words and numbers is an error."""
    for index, (number, text) in enumerate(lines):
        words = [w for w in re.split(r"[\s;,]+", text) if w]
        numbers = sum(_NUMBER.fullmatch(w) is not None for w in words)
        if numbers and numbers == len(words):
            return lines[:index], lines[index:]
        unmeasured = words and all(w.lower() in MISSING_WORDS for w in words)
        if numbers or unmeasured or not any(c.isalpha() for c in text):
            raise _wrong(
                path,
                number,
                text,
                "is neither numbers nor a title without numbers; allowed: 'nan' where "
                "unmeasured, '#' before a line to be skipped",
            )
    raise InputError(f"path = {str(path)!r} holds no numbers")


def _check_units(path, titles: Lines) -> None:
    for number, text in titles:
        named = sorted({UNIT_WORDS[w] for w in re.findall(r"[a-zµμ]+", text.lower()) if w in UNIT_WORDS})
        if named:
            raise _wrong(
                path,
                number,
                text,
                f"names {' and '.join(named)}, and unit is not given, which means m for "
                f"every column; allowed: unit = {named[0]!r}, or 'm' if it is m after all",
            )


def _marks(path, lines: Lines, decimal) -> tuple[str | None, bool]:
    """(separator or None for blanks, whether the comma is the decimal mark)."""
    commas = [(number, text) for number, text in lines if "," in text]
    semicolon, tab = (any(mark in text for _, text in lines) for mark in ";\t")
    separator = ";" if semicolon else "\t" if any(_EMPTY.search(text) for _, text in lines) else None
    if decimal == "," or not commas or semicolon or tab:
        if commas and decimal == ".":
            raise _wrong(path, *commas[0], "has a comma inside a number and decimal = '.'; give decimal = ','")
        return separator, bool(commas) or decimal == ","
    if decimal == ".":
        return ",", False
    if any(len(text.split()) > 1 for _, text in lines) and all(_BLANKS_BETWEEN.fullmatch(text) for _, text in lines):
        return None, True
    inside = any(re.search(r",\S", text) for _, text in lines)
    ways = (all(way.fullmatch(text.removesuffix(",")) for _, text in lines) for way in (_BOTH_WAYS, _COMMA_BLANK))
    if inside and any(ways):
        raise _wrong(
            path,
            *commas[0],
            "and all others have commas that can separate values or be decimal marks; "
            "give decimal = '.' (all separate) or ',' (decimal marks, unless a blank follows), "
            "or another separator",
        )
    return ",", False


def _refuse_points(path, lines: Lines) -> None:
    for number, text in lines:
        if "." in text:
            raise _wrong(
                path,
                number,
                text,
                "has a point where commas are the decimal mark; allowed: one decimal mark "
                "in the file, no mark for thousands",
            )


def _fault(lines: Lines, separator) -> str:
    """The first line that is not numbers or not as long as the first, in words."""
    width = len(lines[0][1].split(separator))
    for number, text in lines:
        fields = [f.strip() for f in text.split(separator)]
        bad = [f for f in fields if _NUMBER.fullmatch(f) is None or "," in f]
        if bad:
            return f"line {number} has {bad[0][:40]!r}"
        if len(fields) != width:
            return f"line {number} has {len(fields)} values, the first one {width}"
    return ""
