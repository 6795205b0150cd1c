"""Height maps as text: a matrix of heights, or a list of points x y z; their separators, decimal marks and headers."""

import math
import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from .._base import FloatArray, text_of, validate
from ..errors import InputError
from ..quantities import counted
from .header import (
    LENGTH_UNITS,
    LENGTHS,
    UNIT_WORDS,
    Header,
    Statement,
    column_units,
    directions_by_sizes,
    grid_of,
    names_size,
    read_header,
    statements,
    steps_in_unit,
)
from .layout import FEWEST_COORDINATES, SAME_SPACING, Border, border_of, kind_of_table, refuse_profile
from .points import gridded
from .sdf import SDF_FIRST_WORDS as SDF
from .sdf import read_sdf
from .surfer import SURFER_FIRST_WORD as SURFER
from .surfer import read_surfer
from .zygo import PHASES_TITLE, POINTS_TITLE, read_zygo

MOST_TEXT_BYTES = 2**30  # of a file of text; a choice, for memory
DECIMALS = (".", ",")
EITHER_WAY = frozenset((True, False))  # x may run along a line of the file, or from line to line
UNCLEAR = "is neither numbers nor a title; use 'nan' where unmeasured, '#' before a line to be skipped"
WYKO = "Wyko ASCII Data File Format"
_PROFILM = re.compile(r"(numCols)\s+(numRows)\s+(pixelSize) \((\w+)\)\s+(\S+)\s+(\S+)\s+(\S+)\s", re.I)  # Filmetrics
_SMD = re.compile(r"[^\n]*\n[^\n]* PRF [^\n]*\n *CX ")  # a profile of ISO 5436-2, as Taylor Hobson writes .prf and .smd
HEIGHT_BLOCKS = ("RAW_DATA", "RAW DATA", "OPD", "SAMPLE_DATA")  # of a Wyko file; others are intensities
# 'heights in nm'
OF_HEIGHTS = re.compile(r"\b(?:heights?|z)\s+(?:are\s+|values\s+)?in\s+[\[(]?(mm|um|µm|μm|nm)\b", re.I)
LATERAL = (1.0, 1e-3, 1e-6, 1e-9)  # m: units that coordinates without a stated one may be in; as in `LENGTHS`

_NUMBER_IN_FIELD = re.compile(r"[+-]?(?:(?:\d+[.,]?\d*|[.,]\d+)(?:e[+-]?\d+)?|nan|inf|infinity)", re.I)
# the label in the corner of a table with coordinates: words up to the first number, in one cell
_CORNER = re.compile(
    rf"(?!{_NUMBER_IN_FIELD.pattern}[\s;,])[^;,\t]+?(?=\s*[;,\t\s]\s*{_NUMBER_IN_FIELD.pattern}(?:[\s;,]|$))", re.I
)
_VALUE = r"(?:[+-]?(?:\d+(?:,\d+)?(?:[eE][+-]?\d+)?|[nN][aA][nN]))"
_TWO_NUMBERS = re.compile(rf"{_NUMBER_IN_FIELD.pattern}[\s;,]{{1,9}}{_NUMBER_IN_FIELD.pattern}[\s;,]{{0,9}}", re.I)
# in quotation marks, where a comma is the decimal mark
_QUOTED = re.compile(r'"((?:[+-]?(?:\d{1,40}[.,]?\d{0,40}|[.,]\d{1,40})(?:[eE][+-]?\d{1,4})?|nan)?)"')
_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}")  # '1,234', which is 1.234 or 1234
_EMPTY = re.compile(r"^\t|\t *(?:\t|$)")  # a value left out between tabs
_BLANKS_BETWEEN = re.compile(rf"{_VALUE}(?:\s+{_VALUE})*")  # '1,5 2,5'
_PAIR = r"[+-]?\d+,\d+(?:[eE][+-]?\d+)?"
_BOTH_WAYS = re.compile(rf"{_PAIR}(?:,\s*{_PAIR})*")  # '1,5' or '1,5,2,5'
_COMMA_BLANK = re.compile(rf"{_VALUE}(?:,\s+{_VALUE})*")  # '1,5, 2' or '1, 2'
# in a cell of a spreadsheet
_SHEET_ERROR = re.compile(r"#(?:n/?[av]|div/0!|value!|wert!|ref!|num!|zahl!|null!|name\?)(?![^\s;,])", re.I)
_MISSING = re.compile(  # how programs mark a point that was not measured
    r"(?<![^\s;,\"])\"?(?:no[ _]?data|bad|#?n/?a|null|none|missing|invalid|void|undefined|masked|-{1,9}|\*{1,9}|\?{1,9}"
    r"|[+-]?1[.,]#[a-z]+|#nv|#(?:div/0|value|wert|ref|num|zahl|null)!)\"?(?![^\s;,\"])",
    re.I,
)
_ODD = re.compile(r"[^\d\s.,;+eE-]|--|(?<![^\s;,])-(?![^\s;,])")  # a line that may hold such a mark

Units = tuple[str, str, str] | None  # of x, y and the heights, as the caller gives them
Pair = tuple[float, float] | None  # a spacing [m], where there is one
Lines = list[tuple[int, str]]  # (line number in the file, text without blanks around it)
Reader = Callable[[Path, str, Units], tuple[FloatArray, Pair, tuple[str, ...]]]

# Formats that their first words name, and their readers: heights [m], spacing [m] and notes.
BY_FIRST_WORDS: dict[tuple[str, ...], Reader] = {
    (POINTS_TITLE, PHASES_TITLE): read_zygo,
    SDF: read_sdf,
    (SURFER,): read_surfer,
}


@dataclass(frozen=True, kw_only=True)
class NumberTable:
    """The numbers of a file of text as they are, and what its titles and comments say of them."""

    numbers: np.ndarray
    header: Header
    titles: Lines
    comments: Lines = field(default_factory=list)
    own_spacing: tuple[float, float] | None = None
    directions: frozenset[bool] = EITHER_WAY  # of x that the corner of coordinates leaves; True: along a line
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True)
class TextMap:
    """A map of a file of text: heights[ix, iy] in the unit ``height_scale`` [m], NaN where unmeasured, and its
    spacing [m], None where the file does not carry it."""

    heights: np.ndarray
    height_scale: float
    spacing: tuple[float, float] | None
    missing_value: float | None = None
    notes: tuple[str, ...] = field(default=())
    unused_steps: str = ""  # why steps that the file states are not its spacing
    unread_sizes: tuple[str, ...] = ()  # lines that may state the spacing, where there is none


def read_text(
    path: Path,
    *,
    points: bool,
    decimal: str | None = None,
    units: tuple[str, str, str] | None = None,
    spacing: tuple[float, float] | None = None,
) -> TextMap:
    """Read the map in a file of text.

    points : the file is a list of points x y z (.xyz); a matrix that is such a list is read as one too
    units : of x, y and the heights, as the caller gives them; None to find them in the file
    spacing : as the caller gives it [m], which the file must not contradict
    """
    text = text_of(path, MOST_TEXT_BYTES)
    if text.startswith(WYKO):
        return _wyko(path, text, units, spacing)
    if reader := next((reader for marks, reader in BY_FIRST_WORDS.items() if text.lstrip().startswith(marks)), None):
        heights, steps, notes = reader(path, text.lstrip(), units)
        if steps is not None and spacing is not None:
            _same_spacing(path, spacing, steps, either=False)
        return TextMap(heights=heights, height_scale=1.0, spacing=steps or spacing, notes=notes)
    if names := _PROFILM.match(text[:400]):  # its header is a row of names above a row of numbers
        text = f"columns: {names[5]}\nrows: {names[6]}\npixel size: {names[7]} {names[4]}\n{text[names.end() :]}"
    if _SMD.match(text[:1000]):
        _refuse_smd(path, text)
    try:
        table = _table(path, text, decimal)
    except InputError:
        _refuse_profile_with_results(path, text, decimal)
        raise
    kind = "points" if points else kind_of_table(path.name, table.numbers)
    if kind == "profile":
        named = column_units([*table.titles, *table.comments], columns=2)
        refuse_profile(path.name, table.numbers, table.header, units, spacing, named)
    if kind == "points":
        return _points(path, table, units, spacing)
    return _matrix(path, table, units, spacing)


def _refuse_profile_with_results(path: Path, text: str, decimal: str | None) -> None:
    """Raise `InputError` with the statistics of a profile below which a program has written its results, as that of a
    Dektak does."""
    lines = text.splitlines()
    while lines and not _TWO_NUMBERS.fullmatch(lines[-1].strip()):
        lines.pop()
    table: NumberTable | None = None
    with suppress(InputError):
        table = _table(path, "\n".join(lines), decimal)
    if table is not None and kind_of_table(path.name, table.numbers) == "profile":
        refuse_profile(path.name, table.numbers, table.header, None)


def _refuse_smd(path: Path, text: str) -> None:
    """Raise `InputError` with the statistics of a profile in the SMD format of ISO 5436-2 (.prf, .smd): records that
    end with EOR; in the first one axes "CX M points MM increment D" and "CZ ..."; the heights in whole increments come
    last."""
    lines = [line.split() for line in text.splitlines()]
    axes = {words[0]: words for words in lines if len(words) >= 5 and words[0] in ("CX", "CZ")}
    ends = [place for place, words in enumerate(lines) if words == ["EOR"]]
    spacing = next((words for words in lines if words[:2] == ["SPACING", "CX"] and len(words) > 2), None)
    try:
        (begin, end) = ends[1:3]
        scale = LENGTHS[axes["CZ"][3].lower()] * float(axes["CZ"][4])
        step = LENGTHS[axes["CX"][3].lower()] * float(axes["CX"][4] if spacing is None else spacing[2])
        z = np.array([float(words[0]) for words in lines[begin + 1 : end] if words])
    except (KeyError, ValueError, IndexError, OverflowError):
        message = f"path = {str(path)!r} is a profile (PRF) whose records are not those of ISO 5436-2"
        raise InputError(message, recommendation="measure a map") from None
    refuse_profile(path.name, np.stack([step * np.arange(z.size), scale * z], axis=1), None, ("m", "m", "m"))


# --- a matrix ----------------------------------------------------------------------------------


def _matrix(path: Path, table: NumberTable, units: Units, spacing: Pair) -> TextMap:
    """Return the map of a table of heights: turned so that x is axis 0, without rows and columns of coordinates."""
    header = table.header
    scale, notes = _height_scale(path, table, units)
    border, numbers = border_of(table.numbers)
    line_count, column_count = numbers.shape
    stated = header.value("dx"), header.value("dy")
    in_header = None if stated[0] is None or stated[1] is None else (stated[0], stated[1])
    own = table.own_spacing or in_header or spacing
    directions, sizes = directions_by_sizes(header, line_count, column_count, own)
    if border is not None and directions & table.directions:
        directions &= table.directions
    grid = grid_of(header, line_count, column_count, directions=frozenset(directions))
    steps = table.own_spacing if table.own_spacing is not None else grid.steps
    unused_steps = _unitless_steps(path, header, spacing) if steps is None and border is None else ()
    notes += unused_steps
    if grid.steps is not None and table.own_spacing is not None:
        _same_spacing(path, table.own_spacing, grid.steps, either=grid.either)
    if border is not None:
        numbers, coordinates, new_notes = _coordinates(
            path, table, border, numbers, across=grid.across, spacing=spacing, steps=steps
        )
        steps = coordinates if steps is None else steps
        notes += new_notes
    notes += (*table.notes, *grid.notes)
    if grid.steps is not None and steps is not None and not grid.either:
        lines = sorted({header.stated[name].line for name in ("dx", "dy", "width", "height") if name in header.stated})
        where = "line " if len(lines) == 1 else "lines "
        notes += (f"spacing {steps[0]:.6g} x {steps[1]:.6g} m from {where}{', '.join(map(str, lines))}",)
    if spacing is not None and steps is not None:
        _same_spacing(path, spacing, steps, either=grid.either)
        steps = spacing
    elif grid.either and table.own_spacing is None and border is None and steps is not None:
        unused_steps = (f"steps of {steps[0]:g} m along X and {steps[1]:g} m along Y: lines may run along either",)
        notes += unused_steps
        steps = None
    steps = steps if spacing is None else spacing
    unread = _unread_sizes(table)
    if own is not None and grid.across not in directions:
        unread += [statement for statement in sizes if statement.line in {number for number, _ in table.titles}]
    counts = (column_count, line_count) if grid.across else (line_count, column_count)
    _refuse_unreconciled(path, unread, counts, steps)
    return TextMap(
        heights=numbers.T if grid.across else numbers,
        height_scale=scale,
        spacing=steps,
        missing_value=header.value("missing"),
        notes=notes,
        unused_steps="".join(unused_steps),
        unread_sizes=tuple(dict.fromkeys(statement.worded() for statement in [*unread, *sizes])),
    )


def _unread_sizes(table: NumberTable) -> list[Statement]:
    """Return what titles that were not read say of a number of points, a step or an extent of the table."""
    skipped = [title for title in table.titles if title[0] not in table.header.lines_read]
    return [statement for title in skipped for statement in statements(*title) if names_size(statement)]


def _refuse_unreconciled(path: Path, unread: list[Statement], counts: tuple[int, int], steps: Pair) -> None:
    """Raise `InputError` for a size that a skipped line states and that a table of ``counts`` points with these
    ``steps`` [m] has not; where the steps are not known, their absence is refused."""
    if steps is None:
        return
    (nx, ny) = counts
    lengths = [*steps, *((n - less) * step for n, step in zip(counts, steps) for less in (0, 1))]
    for statement in unread:
        units = LATERAL if statement.unit is None else (LENGTHS.get(statement.unit, math.nan),)
        for number in statement.numbers:
            is_count = statement.unit is None and number in (nx, ny, nx * ny)
            is_length = any(abs(number * u / length - 1) < SAME_SPACING for u in units for length in lengths)
            if not (is_count or is_length):
                message = f"does not agree with a map of {nx} x {ny} points, {steps[0]:.4g} x {steps[1]:.4g} m each"
                advice = "correct the line or the spacing; or write '#' before it if it does not describe the map"
                raise _wrong(path, statement.line, statement.text, f"{message}; {advice}")


def _unitless_steps(path: Path, header: Header, spacing: Pair) -> tuple[str, ...]:
    """Return a note of steps whose unit no line states. Raise `InputError` where the ``spacing`` that the caller gives
    is not theirs in any unit, along either axis."""
    stated = [header.unitless[name] for name in ("dx", "dy") if name in header.unitless]
    if not stated:
        return ()
    if spacing is None:
        return (f"steps of {stated[0].worded()} have no unit",)
    for unit in LATERAL:
        steps = steps_in_unit(header, unit)
        if _are_all_near(steps, spacing) or _are_all_near(steps, spacing[::-1]):
            return ()
    message = f"spacing = {spacing[0]:g}, {spacing[1]:g} m is given, and file {path.name} states {stated[0].worded()}"
    raise InputError(
        message, allowed="that in m, mm, um or nm", recommendation="give it, or remove the wrong line from the file"
    )


def _coordinates(
    path: Path, table: NumberTable, border: Border, numbers: np.ndarray, *, across: bool, spacing: Pair, steps: Pair
) -> tuple[FloatArray, tuple[float, float] | None, tuple[str]]:
    """Return the heights, the steps [m] of the coordinates beside them where these are known, and notes."""
    along, down = border.steps
    pair = (along, down) if across else (down, along)
    unit = table.header.value("xy unit")
    known = [step for step in pair if step is not None]
    expected = spacing if spacing is not None else steps
    if unit is None and expected is not None:
        unit = next((u for u in LATERAL if _are_all_near([s and s * u for s in pair], expected)), None)
        if unit is None:
            message = f"file {path.name}: {border.worded()} with steps of {' and '.join(f'{s:g}' for s in known)}"
            raise InputError(message, allowed=f"steps of {expected[0]:g} and {expected[1]:g} m in m, mm, um or nm")
    note = f"{border.worded()} taken off"
    if unit is None:
        message = f"file {path.name}: {border.worded()}, and no line states their unit"
        raise InputError(message, recommendation="give spacing in m, or write '# xy unit = um' above the table")
    if pair[0] is None or pair[1] is None:
        if expected is None:
            message = f"file {path.name}: {border.worded()}, and the other step is not stated"
            raise InputError(message, recommendation="give spacing = (dx, dy) in m")
        return numbers, None, (note,)
    return numbers, (pair[0] * unit, pair[1] * unit), (note,)


def _are_all_near(pair: Sequence[float | None], expected: tuple[float, float]) -> bool:
    return all(step is None or abs(step / goal - 1) < SAME_SPACING for step, goal in zip(pair, expected))


def _same_spacing(path: Path, given: tuple[float, float], steps: tuple[float, float], *, either: bool) -> None:
    """Raise `InputError` where the spacing that the caller gives is not the one that the file states."""
    if _are_all_near(given, steps) or either and _are_all_near(given, steps[::-1]):
        return
    message = (
        f"spacing = {given[0]:g}, {given[1]:g} m is given, and file {path.name} states {steps[0]:g}, {steps[1]:g} m"
    )
    raise InputError(message, recommendation="omit spacing, or remove the wrong line from the file")


def _height_scale(path: Path, table: NumberTable, units: Units) -> tuple[float, tuple[str, ...]]:
    """Return the unit [m] of the heights, by the caller or by the file. Raise `InputError` where they differ."""
    header = table.header
    stated = header.stated.get("z unit")
    factor = header.value("z factor") or 1.0
    if stated is not None:
        if units is not None and LENGTH_UNITS[units[2]] != stated.value:
            message = f"unit = {units[2]!r} is given, and file {path.name} says {stated.unit}: {stated.worded()}"
            raise InputError(message, recommendation="omit unit, or remove the wrong line from the file")
        return stated.value * factor, (f"heights in {stated.unit} by {stated.worded()}",)
    if units is None:
        _refuse_unit_words(path, table)
        return factor, ()
    return LENGTH_UNITS[units[2]] * factor, ()


def _refuse_unit_words(path: Path, table: NumberTable, *, points: bool = False) -> None:
    """Raise `InputError` for a title that names a unit which nobody has assigned: the heights may be in it. ``points``:
    whether the table is a list of points, which may have two units."""
    for number, text in table.titles:
        if number in table.header.lines_read:
            of_heights = OF_HEIGHTS.search(text[:1000])
            if of_heights:
                unit = UNIT_WORDS[of_heights[1].lower()]
                message = f"says that the heights are in {unit}, and unit is not given, which means m"
                raise _wrong(path, number, text, f"{message}; allowed: unit = {unit!r}, or 'm' if it is m after all")
            continue
        words = re.findall(r"[a-zµμ]+", text[:1000].lower())
        named = list(
            dict.fromkeys(UNIT_WORDS[word] for word in words if word in UNIT_WORDS and word not in ("m", "in"))
        )
        if named:
            message = f"names {' and '.join(named)}, and unit is not given, which means m for every column"
            ways = f"unit = {named[0]!r}, or 'm' if it is m after all"
            if points:
                ways = f"unit = {named[0]!r} for all columns, or unit = {(named[0], named[-1])!r} for x and y, and z"
            raise _wrong(path, number, text, f"{message}; allowed: {ways}")


# --- a list of points --------------------------------------------------------------------------


def _points(path: Path, table: NumberTable, units: Units, spacing: Pair) -> TextMap:
    """Return the map of a table of three columns x y z."""
    numbers = table.numbers
    if numbers.shape[1] != 3:
        raise InputError(f" has {numbers.shape[1]} columns", f"path = {str(path)!r}", "exactly 3 (x y z)")
    named = column_units([*table.titles, *table.comments])
    notes = table.notes
    if named is not None:
        if units is not None and [LENGTH_UNITS[unit] for unit in units] != [LENGTHS[unit] for unit in named[0]]:
            message = (
                f"unit = {', '.join(units)} is given, and file {path.name} says {', '.join(named[0])}: {named[1]!r}"
            )
            raise InputError(message, recommendation="omit unit, or correct the headings")
        scales = [LENGTHS[unit] for unit in named[0]]
        notes += (f"columns in {', '.join(named[0])} by {named[1][:60]!r}",)
    elif {"z unit", "xy unit"} & set(table.header.stated):
        scales = _stated_scales(path, table, units)
    else:
        if units is None:
            _refuse_unit_words(path, table, points=True)
        scales = [LENGTH_UNITS[unit] for unit in units or ("m", "m", "m")]
    heights, steps, made = gridded(path.name, numbers * np.array([scales[0], scales[1], 1.0]))
    if spacing is not None:
        _same_spacing(path, spacing, steps, either=False)
    missing = table.header.value("missing")
    return TextMap(heights=heights, height_scale=scales[2], spacing=steps, missing_value=missing, notes=(*notes, *made))


def _stated_scales(path: Path, table: NumberTable, units: Units) -> list[float]:
    """Return the units [m] of x, y, z by separate lines of the header, for both of which there must be one."""
    stated = [table.header.stated.get(name) for name in ("xy unit", "xy unit", "z unit")]
    scales = []
    for place, statement in enumerate(stated):
        unit = None if units is None else units[place]
        given = None if unit is None else LENGTH_UNITS[unit]
        if statement is not None and given is not None and statement.value != given:
            message = f"unit = {unit!r} is given, and file {path.name} says {statement.unit}: {statement.worded()}"
            raise InputError(message, recommendation="omit unit, or remove the wrong line from the file")
        scale = given if statement is None else statement.value
        if scale is None:
            message = f"file {path.name} does not state the unit of {'the heights' if place == 2 else 'x and y'}"
            raise InputError(message, recommendation="give unit = (unit of x, of y, of z), such as ('mm', 'mm', 'um')")
        scales.append(scale)
    return scales


# --- Wyko --------------------------------------------------------------------------------------


def _wyko(path: Path, text: str, units: Units, spacing: Pair) -> TextMap:
    """Return the first block of heights of a Wyko (Veeco, Bruker Vision) ASCII file.

    Each line of a block holds the points at one x. Values are in nm where the second flag of the first line is 1, else
    in waves: times Wavelength [nm] over Mult. Pixel_size is in mm; Aspect is dy/dx (Gwyddion's opdfile.c).
    """
    if units is not None:
        raise InputError(
            f"unit = {units[2]!r} is given, and a Wyko file has its own (nm, mm)", recommendation="omit it"
        )
    rows = text.splitlines()
    flags = rows[0].removeprefix(WYKO).split()
    fields: dict[str, str] = {}
    start = None
    for number, row in enumerate(rows[1:], 2):
        cells = [cell.strip() for cell in row.split("\t")]
        if cells[0] in HEIGHT_BLOCKS:
            start = number
            break
        value = cells[3] if len(cells) > 3 else ""
        if cells[0] in ("X Size", "Y Size") and len(cells) > 1:
            value = cells[1]
        if fields.setdefault(cells[0], value) != value:
            raise InputError(f"file {path.name} states {cells[0]} twice: {fields[cells[0]]} and {value}")
    if start is None:
        raise InputError(f"file {path.name} has no block of heights", allowed=", ".join(HEIGHT_BLOCKS))
    nx, ny = (_field(path, fields, name, whole=True) for name in ("X Size", "Y Size"))
    block = _block_lines(rows[start : start + int(nx)], start)
    if len(block) < nx:
        raise InputError(f"file {path.name} has {len(block)} lines of heights", "", f"{nx:g} by its X Size")
    heights = _numbers(path, block, None, dict(enumerate(rows, 1)))
    if heights.shape[1] != ny:
        raise InputError(f"file {path.name} has {heights.shape[1]} values in a line", "", f"{ny:g} by its Y Size")
    pixel = _field(path, fields, "Pixel_size") * LENGTHS["mm"]
    aspect = _field(path, fields, "Aspect", default=1.0)
    in_nm = len(flags) > 1 and flags[1] == "1"
    unit = 1.0 if in_nm else _field(path, fields, "Wavelength") / _field(path, fields, "Mult", default=1.0)
    more = sum(row.split("\t")[0].strip() in (*HEIGHT_BLOCKS, "Intensity", "Image") for row in rows[start + int(nx) :])
    notes = ["header of Wyko", f"heights in {'nm' if in_nm else f'waves, {unit:g} nm each'}"]
    notes += [f"first block of {more + 1}"] if more else []
    steps = (pixel, pixel * aspect)
    if spacing is not None:
        _same_spacing(path, spacing, steps, either=False)
    scale = unit * LENGTHS["nm"]
    return TextMap(heights=heights, height_scale=scale, spacing=steps, notes=tuple(notes))


def _field(
    path: Path, fields: dict[str, str], name: str, *, whole: bool = False, default: float | None = None
) -> float:
    """Return the positive number of a field of a Wyko header."""
    given = fields.get(name, "")
    if not given and default is not None:
        return default
    called = f"{name} of {path.name}"
    try:
        value = float(given)
    except ValueError:
        raise InputError(f"{called} = {given[:40]!r} is no number", allowed="a number above 0") from None
    value = validate.number(called, value, "(unit of the file)", above=0.0, maximum=1e9)
    if whole and value != int(value):
        raise InputError(f"{called} = {value:g}", allowed="a whole number")
    return value


# --- numbers -----------------------------------------------------------------------------------


def _lines(text: str) -> tuple[Lines, Lines]:
    """Return (comment lines, data lines) with their numbers in the file. Data end where the header of a second block
    begins."""
    if '"' in text:
        text = _QUOTED.sub(lambda cell: cell[1].replace(",", "."), text)
    numbered = [(number, line.strip(" \r\f\v")) for number, line in enumerate(text.splitlines(), 1)]
    numbered = [(number, line) for number, line in numbered if line.strip(' \t"')]
    comments: Lines = []
    data: Lines = []
    for number, line in numbered:
        if line.lstrip()[0] == "#" and not _SHEET_ERROR.match(line.lstrip()):
            comments.append((number, line.strip()))
        else:
            data.append((number, line))
    return comments, data


def _block_lines(rows: list[str], before: int) -> Lines:
    """Return rows of a block with its marks of missing points made NaN, with their numbers in the file."""
    lines = []
    for number, row in enumerate(rows, before + 1):
        text = row.strip()
        if not text:
            break
        lines.append((number, _MISSING.sub("nan", text) if _ODD.search(text) else text))
    return lines


def _table(path: Path, text: str, decimal: str | None) -> NumberTable:
    """Return the numbers of a file, NaN where a cell is empty or marked as missing, and what is around them.

    A point is always a decimal mark. A comma separates values, or it is the decimal mark. It is read where the lines
    admit only one of the two, and is an error where they admit both. ``decimal``: ".", "," or None to find out. Raises
    `InputError` naming the line.
    """
    comments, lines = _lines(text)
    in_file = dict(lines)
    notes: list[str] = []
    marked = 0
    for place, (number, line) in enumerate(lines):
        if _ODD.search(line):
            made, count = _MISSING.subn("nan", line)
            if count and not any(c.isalpha() for c in re.sub("nan|[eE]", "", made, flags=re.I)):
                lines[place] = (number, made)
                marked += count
    titles, lines, corner = _split_titles(path, lines)
    first = lines[0][0]
    second = next((number for number, line in comments if number > first and _begins_a_block(line)), None)
    if second is not None:
        lines = [(number, line) for number, line in lines if number < second]
        comments = [(number, line) for number, line in comments if number < second]
        notes.append(f"first of several blocks; the next begins at line {second}")
    header = read_header(path.name, sorted([*comments, *titles]))
    own_spacing = _own_spacing(path, comments)
    directions = EITHER_WAY
    if corner is not None:
        directions = _read_corner(header, *corner)
        titles = [*titles, corner]
    for number, line in titles:
        is_read = number in header.lines_read or bool(column_units([(number, line)]))
        notes.append(f"line {number} {'read' if is_read else 'skipped'} as a title: {line[:60]!r}")
    separator, comma = _marks(path, lines, decimal)
    if separator is not None and all(line.endswith(separator) for _, line in lines):
        lines = [(number, line[:-1].rstrip(" ")) for number, line in lines]  # a separator behind every line
    if comma:
        for number, line in lines:
            if "." in line:
                advice = "use one decimal mark in the file, no mark for thousands"
                raise _wrong(path, number, line, f"has a point where commas are the decimal mark; {advice}")
        lines = [(number, re.sub(r",(?=\s)", " ", line).replace(",", ".")) for number, line in lines]
        notes.append("decimal comma")
    if separator is not None:
        cells = [(number, [cell.strip() for cell in line.split(separator)]) for number, line in lines]
        if empty := sum(row.count("") for _, row in cells):
            lines = [(number, separator.join(cell or "nan" for cell in row)) for number, row in cells]
            notes.append(f"{counted(empty, 'empty cells')} treated as unmeasured")
    if marked:
        notes.append(f"{counted(marked, 'marks')} of missing points treated as unmeasured")
    numbers = _numbers(path, lines, separator, in_file)
    return NumberTable(
        numbers=numbers,
        header=header,
        titles=titles,
        comments=comments,
        own_spacing=own_spacing,
        directions=directions,
        notes=tuple(notes),
    )


def _read_corner(header: Header, number: int, label: str) -> frozenset[bool]:
    """State the unit of the coordinates that the ``label`` in the corner above them names, 'x [um] \\ y [um]', in the
    ``header``. Return the directions of x that it leaves (True: along a line): a backslash has the rows on its left."""
    axes = [word for word in re.findall(r"[a-zµμ]+", label.lower()) if word in ("x", "y")]
    units = {UNIT_WORDS.get(mark.lower(), "") for mark in re.findall(r"[\[(]\s*([^\[\]()\s]{1,12})\s*[\])]", label)}
    if sorted(axes) != ["x", "y"]:
        return EITHER_WAY
    if len(units) == 1 and (unit := units.pop()):
        statement = Statement(words=("x", "y"), numbers=(), unit=unit, line=number, text=label)
        header.state("xy unit", statement, LENGTHS[unit], unit)
    return frozenset((axes[0] == "y",)) if "\\" in label else EITHER_WAY


def _numbers(path: Path, lines: Lines, separator: str | None, in_file: Mapping[int, str]) -> np.ndarray:
    """Return the numbers of ``lines``; ``in_file``: the same lines as they are in the file, for a message."""
    try:
        return np.loadtxt([text for _, text in lines], delimiter=separator, ndmin=2, comments=None)
    except ValueError as problem:
        message = f"path = {str(path)!r} is not a table of numbers: {_fault(lines, separator, in_file) or problem}"
        raise InputError(message, recommendation="use lines of equally many numbers, 'nan' where unmeasured") from None


def _begins_a_block(comment: str) -> bool:
    """Return whether a comment among the numbers is the header of a second table (Gwyddion's export of several
    channels)."""
    return bool(re.match(r"#\s*(?:Channel|Width|Kanal|Breite|Canal|Largeur)\b\s*[:=：]", comment))


def _own_spacing(path: Path, comments: Lines) -> tuple[float, float] | None:
    """Return the spacing [m] of a comment '# spacing = dx dy', or None."""
    spacing = None
    for _, line in comments:
        key, mark, value = line[1:].replace(":", "=", 1).partition("=")
        if key.strip() != "spacing" or not mark:
            continue
        words = [word for word in re.split(r"[\s,;]+", value) if word not in ("", "m")]
        try:
            pair = [float(word) for word in words]
        except ValueError:
            pair = []
        if len(pair) not in (1, 2):
            message = f"spacing in {path.name}: {validate.shown(line)}"
            raise InputError(message, allowed="'# spacing = dx dy' in m")
        stated = validate.spacing("spacing", pair if len(pair) == 2 else pair[0])
        if spacing not in (None, stated):
            raise InputError(f"file {path.name} states its spacing twice: {spacing} and {stated} m")
        spacing = stated
    return spacing


def _wrong(path: Path, number: int, text: str, words: str) -> InputError:
    return InputError(f"path = {str(path)!r}: line {number} {text[:60]!r} {words}")


def _split_titles(path: Path, lines: Lines) -> tuple[Lines, Lines, tuple[int, str] | None]:
    """Return (titles, data lines, line and text of a label in the corner of coordinates).

    Leading lines without any number, with words and one number, that state something of the table, or that begin with a
    word and have less than half as many numbers as the first line of numbers alone, are titles. Any other leading line
    with words and numbers is an error, except a row of coordinates with a label in its first cell.
    """
    doubtful: list[tuple[int, str, int]] = []
    for index, (number, text) in enumerate(lines):
        words = [w for w in re.split(r"[\s;,]+", text) if w]
        numbers = sum(_NUMBER_IN_FIELD.fullmatch(w) is not None for w in words)
        if numbers == len(words):
            for line, title, count in doubtful:
                if line == lines[index - 1][0] and count == numbers - 1 >= FEWEST_COORDINATES - 1:
                    cell = _CORNER.match(title)
                    if cell is not None:
                        row = (line, f"nan{title[cell.end() :]}")
                        return lines[: index - 1], [row, *lines[index:]], (line, cell[0].strip())
                if 2 * count >= numbers:
                    raise _wrong(path, line, title, UNCLEAR)
            return lines[:index], lines[index:], None
        if not any(c.isalpha() for c in text) or numbers and _NUMBER_IN_FIELD.fullmatch(words[0]):
            raise _wrong(path, number, text, UNCLEAR)
        if numbers and not _is_heading(path, number, text):
            doubtful.append((number, text, numbers))
    raise InputError(f"path = {str(path)!r} contains no numbers")


def _is_heading(path: Path, number: int, text: str) -> bool:
    """Return whether a line is a name with a mark and one number ('Width: 10 um'), or states something of the table."""
    parts = statements(number, text)
    numbers = sum(len(statement.numbers) for statement in parts)
    if parts and numbers == 1 and parts[0].words and re.search(r"[:=;,\t]", text):
        return True
    return bool(read_header(Path(path).name, [(number, text)]).lines_read)


def _marks(path: Path, lines: Lines, decimal: str | None) -> tuple[str | None, bool]:
    """Return (separator or None for blanks, whether the comma is the decimal mark)."""
    commas = [(number, text) for number, text in lines if "," in text]
    semicolon, tab = (any(mark in text for _, text in lines) for mark in ";\t")
    separator = "\t" if any(_EMPTY.search(text) for _, text in lines) else None
    if semicolon:
        separator = ";"
    if decimal == "," or not commas or semicolon or tab:
        if commas and decimal == ".":
            raise _wrong(path, *commas[0], "has a comma inside a number and decimal = '.'; give decimal = ','")
        if decimal is None and commas and _may_be_thousands(lines):
            message = "has commas that can be decimal marks or marks of thousands, as all others have"
            raise _wrong(path, *commas[0], f"{message}; give decimal = ',', or write the numbers without them")
        return separator, bool(commas) or decimal == ","
    if decimal == ".":
        return ",", False
    if any(len(text.split()) > 1 for _, text in lines) and all(_BLANKS_BETWEEN.fullmatch(text) for _, text in lines):
        return None, True
    inside = any(re.search(r",\S", text) for _, text in lines)
    ways = (all(way.fullmatch(text.removesuffix(",")) for _, text in lines) for way in (_BOTH_WAYS, _COMMA_BLANK))
    if inside and any(ways):
        ways_out = "decimal = '.' (all separate) or ',' (decimal marks, unless a blank follows), or another separator"
        message = "and all others have commas that can separate values or be decimal marks"
        raise _wrong(path, *commas[0], f"{message}; give {ways_out}")
    return ",", False


def _may_be_thousands(lines: Lines) -> bool:
    """Return whether every comma between digits stands before exactly three digits, and none behind a zero alone."""
    cells = (cell for _, text in lines for cell in re.split(r"[\s;]+", text) if re.search(r"\d,\d", cell))
    return all(_THOUSANDS.fullmatch(cell) for cell in cells)


def _fault(lines: Lines, separator: str | None, in_file: Mapping[int, str]) -> str:
    """Return the first line that is not numbers or not as long as the first, as text; with the words that the file
    has."""
    width = len(lines[0][1].split(separator))
    for number, text in lines:
        fields = [f.strip() for f in text.split(separator)]
        bad = [f for f in fields if _NUMBER_IN_FIELD.fullmatch(f) is None or "," in f]
        if bad:
            original = in_file.get(number, text)
            return f"line {number} has {(bad[0] if bad[0] in original else original)[:40]!r}"
        if len(fields) != width:
            return f"line {number} has {len(fields)} values, the first one {width}"
    return ""
