"""Height maps as text: a matrix of heights, or a list of points x y z; their separators and decimal marks."""

import math
import re

import numpy as np

from .._base import text_of, validate
from ..errors import InputError
from ..quantities import counted
from ..units import UNITS as KINDS
from ..units import spelled

MOST_BYTES = 2**30
NEXT_LINE = 0.1  # of the largest gap between coordinates: a larger one leads to the next grid line
FARTHEST = 1e15  # in the unit of the file
UNEVEN = 0.02  # of the spacing: the most a coordinate may be off its grid line
DECIMALS = (".", ",")
UNITS = {name: KINDS["m"][spelled(name)] for name in ("m", "mm", "um", "µm", "μm", "nm")}  # both signs of micro
UNIT_WORDS = {"mm": "mm", "um": "um", "µm": "um", "μm": "um", "micron": "um", "microns": "um", "nm": "nm"}
MISSING_WORDS = {"na", "n/a", "null", "none", "bad", "missing"}

UNCLEAR = "is neither numbers nor a title; allowed: 'nan' where unmeasured, '#' before a line to be skipped"

_NUMBER = re.compile(r"[+-]?(?:(?:\d+[.,]?\d*|[.,]\d+)(?:e[+-]?\d+)?|nan|inf|infinity)", re.I)
_VALUE = r"(?:[+-]?(?:\d+(?:,\d+)?(?:[eE][+-]?\d+)?|[nN][aA][nN]))"
_EMPTY = re.compile(r"^\t|\t *(?:\t|$)")  # a value left out between tabs
_HEADING = re.compile(
    rf"([^\d;:=,\t]*[a-zµμ][^\d;:=,\t]*)[;:=,\t]\s*({_NUMBER.pattern})\s*[;,\t]?\s*([a-zµμ]*)[;,\t\s]*", re.I
)
_STEPS = {"step", "spacing", "increment", "pitch", "pixel", "dx", "dy"}
_BLANKS_BETWEEN = re.compile(rf"{_VALUE}(?:\s+{_VALUE})*")  # '1,5 2,5'
_PAIR = r"[+-]?\d+,\d+(?:[eE][+-]?\d+)?"
_BOTH_WAYS = re.compile(rf"{_PAIR}(?:,\s*{_PAIR})*")  # '1,5' or '1,5,2,5'

_COMMA_BLANK = re.compile(rf"{_VALUE}(?:,\s+{_VALUE})*")  # '1,5, 2' or '1, 2'

Lines = list[tuple[int, str]]  # (line number in the file, text without blanks around it)


def _lines(path) -> tuple[list[str], list[tuple[int, str]]]:
    """(comment lines, data lines with their number in the file) of a file of text."""
    lines = text_of(path, MOST_BYTES).splitlines()
    text = [(number, line.strip(" \r\f\v")) for number, line in enumerate(lines, 1) if line.strip()]
    comments = [line.strip() for _, line in text if line.lstrip()[0] == "#"]
    return comments, [pair for pair in text if pair[1].lstrip()[0] != "#"]


def read_matrix(path, decimal=None, unit=None) -> tuple[np.ndarray, tuple[float, float] | None, tuple[str, ...]]:
    """heights[ix, iy] with one x per line; the spacing [m] of a ``# spacing = dx dy`` line, or of headings where the
    steps along X and Y are the same (else they do not tell along which a line runs); notes."""
    comments, lines = _lines(path)
    spacing = None
    for line in comments:
        if not re.match(r"#\s*spacing\s*[=:]", line):
            continue
        found = re.fullmatch(r"#\s*spacing\s*[=:]\s*(\S+)(?:[\s,;]+(\S+))?(?:\s+m)?\s*", line)
        words = [] if found is None else [word for word in found.groups() if word not in (None, "m")]
        try:
            pair = [float(word) for word in words or ("none",)]
        except ValueError:  # no match, no numbers
            said = f"spacing in {path.name}: {validate.shown(line)}"
            raise InputError(said, allowed="'# spacing = dx dy' in m") from None
        spacing = validate.spacing("spacing", pair if len(pair) == 2 else pair[0])
    heights, notes, steps = read_table(path, lines, decimal, unit)
    if spacing is None and len(steps) == 2:
        if math.isclose(*steps.values()):
            spacing = validate.spacing("spacing", steps["x"])
        else:
            notes += (f"steps of {steps['x']:g} m along X and {steps['y']:g} m along Y: lines may run along either",)
    return heights, spacing, notes


def read_points(path, decimal=None, unit=None) -> tuple[np.ndarray, tuple[float, float], tuple[str, ...]]:
    """heights[ix, iy], NaN where no point is, and (dx, dy), all in the unit of the file; notes."""
    table, notes, _ = read_table(path, _lines(path)[1], decimal, unit)
    name = f"path = {str(path)!r}"
    if table.shape[1] != 3:
        raise InputError(f" has {table.shape[1]} columns", name, "exactly 3 (x y z)")
    if not (np.abs(table[:, :2]) <= FARTHEST).all():
        raise InputError(f": x or y is NaN, infinite or beyond {FARTHEST:g}", name, "finite coordinates")
    (i, nx, dx), (j, ny, dy) = (_grid_lines(name, table[:, column]) for column, name in enumerate("xy"))
    if nx * ny > 4 * len(table):
        said = f": {len(table)} points on a grid of {nx} x {ny}"
        raise InputError(said, name, "a uniform grid with most of its points")
    heights = np.full((nx, ny), np.nan)
    count = np.zeros((nx, ny), int)
    np.add.at(count, (i, j), 1)
    if count.max() > 1:
        said = f": {np.count_nonzero(count > 1)} grid points are given more than once"
        raise InputError(said, name, way_out="give each once")
    heights[i, j] = table[:, 2]
    return heights, (dx, dy), notes


def _grid_lines(name, coordinate) -> tuple[np.ndarray, int, float]:
    """(index of each point, number of lines, step) of one coordinate; uniform or an error."""
    ordered = np.sort(coordinate)
    gaps = np.diff(ordered)
    if gaps.size == 0 or gaps.max() <= 0:
        raise InputError(f"{name} has one value only ({coordinate[0]:g}); allowed: a grid of at least 2 x 2 points")
    starts = np.flatnonzero(np.concatenate([[True], gaps > NEXT_LINE * gaps.max()]))
    lines = np.add.reduceat(ordered, starts) / np.diff(np.append(starts, ordered.size))
    steps = np.diff(lines)
    count = 1 + int(np.rint(steps / np.median(steps)).sum())  # whole lines may be missing
    step = (ordered[-1] - ordered[0]) / (count - 1)
    position = (coordinate - ordered[0]) / step
    index = np.rint(position).astype(int)
    off = np.abs(position - index).max()
    if off > UNEVEN:
        said = f"spacing along {name} is not uniform: a point is {off:.2g} steps off its grid line"
        raise InputError(said, allowed=f"at most {UNEVEN:g} of the step {step:g}")
    return index, count, float(step)


def read_table(path, lines: Lines, decimal=None, unit=None) -> tuple[np.ndarray, tuple[str, ...], dict[str, float]]:
    """(rows, columns) of the numbers, NaN where a cell is empty; notes of the titles skipped, of a decimal comma and of
    empty cells; steps [m] along "x" and "y" that headings name.

    A point is always a decimal mark. A comma separates values, or it is the decimal mark. It is read where the lines
    admit only one of the two, and is an error where they admit both.

    lines : without comments. decimal : ".", "," or None to find out. unit : what the caller takes the lengths for;
    None makes a title that names another unit than metres an error. Raises `InputError` naming the line.
    """
    titles, lines = _split_titles(path, lines)
    steps = dict(found for _, text in titles if (found := _step(text)) is not None)
    for number, text in titles if unit is None else ():
        named = sorted({UNIT_WORDS[w] for w in re.findall(r"[a-zµμ]+", text.lower()) if w in UNIT_WORDS})
        if named and _step(text) is None:
            allowed = f"allowed: unit = {named[0]!r}, or 'm' if it is m after all"
            said = f"names {' and '.join(named)}, and unit is not given, which means m for every column"
            raise _wrong(path, number, text, f"{said}; {allowed}")
    done = [(number, "read" if _step(text) else "skipped", text[:60]) for number, text in titles]
    notes = tuple(f"line {number} {how} as a title: {text!r}" for number, how, text in done)
    separator, comma = _marks(path, lines, decimal)
    if separator is not None and all(text.endswith(separator) for _, text in lines):
        lines = [(number, text[:-1].rstrip(" ")) for number, text in lines]  # a separator behind every line
    if comma:
        for number, text in lines:
            if "." in text:
                allowed = "allowed: one decimal mark in the file, no mark for thousands"
                raise _wrong(path, number, text, f"has a point where commas are the decimal mark; {allowed}")
        lines = [(number, re.sub(r",(?=\s)", " ", text).replace(",", ".")) for number, text in lines]
        notes += ("decimal comma",)
    if separator is not None:
        cells = [(number, [cell.strip() for cell in text.split(separator)]) for number, text in lines]
        if empty := sum(row.count("") for _, row in cells):
            lines = [(number, separator.join(cell or "nan" for cell in row)) for number, row in cells]
            notes += (f"{counted(empty, 'empty cells')} taken for unmeasured",)
    try:
        table = np.loadtxt([text for _, text in lines], delimiter=separator, ndmin=2, comments=None)
    except ValueError as problem:
        said = f"path = {str(path)!r} is not a table of numbers: {_fault(lines, separator) or problem}"
        raise InputError(said, allowed="lines of equally many numbers, 'nan' where unmeasured") from None
    return table, notes, steps


def _step(title: str) -> tuple[str, float] | None:
    """("x" or "y", step [m]) of a heading such as 'Step X [um];1.0'. None where it names no step, axis or unit."""
    heading = _HEADING.fullmatch(title)
    words = [] if heading is None else re.findall(r"[a-zµμ]+", f"{heading[1]} {heading[3]}".lower())
    axes = [word[-1] for word in words if word in ("x", "y", "dx", "dy")]
    units = [UNIT_WORDS.get(word, word) for word in words if word in UNIT_WORDS or word == "m"]
    if heading is None or not _STEPS & set(words) or len(axes) != 1 or len(units) != 1:
        return None
    return axes[0], float(heading[2].replace(",", ".")) * UNITS[units[0]]


def _wrong(path, number, text, words) -> InputError:
    return InputError(f"path = {str(path)!r}: line {number} {text[:60]!r} {words}")


def _split_titles(path, lines: Lines) -> tuple[Lines, Lines]:
    """Leading lines without any number, with a name and one number (`_HEADING`), or that begin with a word and have
    less than half as many numbers as the first line of numbers alone, are titles; any other leading line with words
    and numbers is an error."""
    doubtful: list[tuple[int, str, int]] = []
    for index, (number, text) in enumerate(lines):
        words = [w for w in re.split(r"[\s;,]+", text) if w]
        numbers = sum(_NUMBER.fullmatch(w) is not None for w in words)
        if numbers == len(words):
            for line, title, count in doubtful:
                if 2 * count >= numbers:
                    raise _wrong(path, line, title, UNCLEAR)
            return lines[:index], lines[index:]
        unmeasured = any(w.lower() in MISSING_WORDS for w in words)
        if unmeasured or not any(c.isalpha() for c in text) or numbers and _NUMBER.fullmatch(words[0]):
            raise _wrong(path, number, text, UNCLEAR)
        if numbers and not _HEADING.fullmatch(text):
            doubtful.append((number, text, numbers))
    raise InputError(f"path = {str(path)!r} holds no numbers")


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
        ways_out = "decimal = '.' (all separate) or ',' (decimal marks, unless a blank follows), or another separator"
        said = "and all others have commas that can separate values or be decimal marks"
        raise _wrong(path, *commas[0], f"{said}; give {ways_out}")
    return ",", False


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
