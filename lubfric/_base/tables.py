"""Tables as text: those of results, written and read back, and columns of numbers in files from elsewhere (headings
with units, any usual separator and decimal mark). Results in JSON types."""

import csv
import io
import json
import math
import tomllib
from collections.abc import Container, Mapping, Sequence
from functools import cache
from importlib import resources
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from ..errors import InputError
from ..quantities import NAMES_IN_TABLES
from ..units import UNITS, converted, kind_of, spelled
from .validate import nearest, shown

IN_WORDS = ("model", "validity", "uncertainty")  # columns of a result
MOST_TABLE_BYTES = 2**27  # of a table that is read at once. A convention

# Limits by choice: what is longer is no table of numbers.
TITLES = 1000  # lines of a preamble among which the headings are looked for
LONGEST_LINE = 10_000  # characters of a line of a table of columns
LONGEST_HEADING = 200  # characters
OPEN = {")": "(", "]": "["}
FORMULA_BEGINS = ("=", "+", "-", "@", "\t", "\r")  # begin a formula in a spreadsheet
BLANKS = "  "  # the separator of columns that two or more blanks separate


@cache
def packaged(package: str, name: str) -> dict[str, Any]:
    """Return the table in the TOML file ``name`` of a ``package`` of lubfric."""
    return tomllib.loads((resources.files(package) / name).read_text(encoding="utf-8"))


def plain(value: Any) -> Any:
    """Return ``value`` in JSON types alone: numpy scalars and tuples unpacked, NaN and infinity as null."""
    if isinstance(value, dict):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(v) for v in value]
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value


def read_json(path: Path, recommendation: str) -> Any:
    """Return what is in a JSON file. Raises `InputError`, which ends with the ``recommendation``, if it cannot be read,
    is cut off, nested too deeply or binary."""
    if not Path(path).is_file():  # nor is one waited for that is no file, such as a pipe
        raise InputError(f"{path} is not a file; {recommendation}")
    try:
        return json.loads(Path(path).read_bytes().decode("utf-8"))
    except (OSError, ValueError, RecursionError, MemoryError) as problem:
        why = problem.strerror if isinstance(problem, OSError) else type(problem).__name__
        raise InputError(f"{path} is damaged, or no such record ({why}); {recommendation}") from None


def table_bytes(columns: Mapping[str, np.ndarray | list[Any]]) -> bytes:
    """Return ``columns`` by heading as comma-separated text. Text that a spreadsheet would take for a formula begins
    with an apostrophe."""
    file = io.StringIO(newline="")
    writer = csv.writer(file)
    writer.writerow(map(_no_formula, columns))
    columns_of_cells = [map(_no_formula, np.asarray(values, dtype=object).tolist()) for values in columns.values()]
    writer.writerows(zip(*columns_of_cells))
    return file.getvalue().encode()


def _no_formula(cell: Any) -> Any:
    """Return a cell of a table such that no spreadsheet evaluates it."""
    if isinstance(cell, str) and cell.lstrip()[:1] in FORMULA_BEGINS and cell.strip():
        return cell if _is_number(cell) else f"'{cell}"
    return cell


class Columns(dict[str, Any]):
    """Columns of a table by name; a missing one is an `InputError` that names the ``source``."""

    source = "the table"

    def __missing__(self, name: str) -> None:
        raise InputError(f"{self.source} has no column {name!r}; give a table that 'lubfric run' wrote")


def read_table(path: Path, content: bytes | None = None) -> Columns:
    """Return the columns that `table_bytes` wrote, by name; an empty cell of numbers is NaN. ``content``: that of the
    file ``path`` where it is not yet there. Raises `InputError` for a damaged table or another one."""
    try:
        text = (Path(path).read_bytes() if content is None else content).decode()
        heading, *rows = list(csv.reader(io.StringIO(text, newline="")))
        known = {shown_as: name for name, shown_as in NAMES_IN_TABLES.items()}
        names = [name.split(" [")[0] for name in heading]
        columns = {known.get(name, name): [row[i] for row in rows] for i, name in enumerate(names)}
        words = {n: np.array(c, str) for n, c in columns.items() if n in IN_WORDS}
        numbers = {n: np.array([cell or "nan" for cell in c], float) for n, c in columns.items() if n not in IN_WORDS}
        result = Columns({n: words[n] if n in IN_WORDS else numbers[n] for n in columns})
        result.source = str(path)
        return result
    except (ValueError, IndexError, csv.Error) as problem:
        message = f"{path} is not a complete table of numbers ({shown(str(problem))})"
        raise InputError(f"{message}; give a table that 'lubfric run' wrote") from None


def read_columns(
    path: Path,
    names: Sequence[str],
    units: Sequence[str | None],
    must_say: Sequence[str] = (),
    of_other_kind: Mapping[str, str] = MappingProxyType({}),
    words: Mapping[str, Container[str] | None] = MappingProxyType({}),
) -> list[list[Any]]:
    """Return columns in ``units``, found by the ``names``, which are headings with or without their units, in the first
    row that has most of them: a preamble of up to `TITLES` lines may precede the table.

    A heading may carry its unit in brackets: ``time [ms]``, ``load (kN)``, and so may the name of one that does not. A
    line of units may follow the headings (``s;mm/s;-``). Without a unit a column is in SI, unless its unit is among
    those that ``must_say`` it; a heading that ends with another unit without brackets is refused. ``units``: to which
    each column is converted (None: from any of `UNITS`, to SI); ``of_other_kind``: by the SI unit, what to do with a
    column that is of another kind; ``words``: by the name of a column that takes text, which (None: any). Comma, semicolon, tab or two blanks separate;
    with one of the others, a comma is the decimal mark. UTF-8 (with or without a byte-order mark), UTF-16 with one, or
    Windows-1252.

    Raises `InputError` naming file and line for anything else.
    """
    rows = _rows(path, names)
    headings = [text.strip() for text in rows[0][1]]
    stated = _line_of_units(headings, rows)
    if stated is not None:
        rows = [rows[0], *rows[2:]]
    if len(rows) < 2:
        raise InputError(f"file {path.name} has no row of numbers below its headings; give some")
    for line, row in rows[1:]:
        if any(field.strip() for field in row[len(headings) :]):
            hint = "; are its decimals written with a comma? Write a point, or separate the columns by semicolons"
            message = f"file {path.name}, line {line}: {len(row)} values for {len(headings)} headings"
            raise InputError(f"{message}{hint if len(row) > len(headings) + 1 else ''}")
    columns = []
    known = [*(name_and_unit(text)[0] for text in headings), *headings]
    for name, unit in zip(names, units):
        places = _places(headings, name)
        if len(places) != 1:
            count = f"{len(places)} columns" if places else "no column"
            raise InputError(
                f"file {path.name} has {count} {name!r}{'' if places else nearest(name, known)}; "
                f"it has: {', '.join(headings)}"
            )
        heading = headings[places[0]]
        given = _unit_of_column(path, heading, name, None if stated is None else stated[places[0]])
        if given is None and unit in must_say:
            raise InputError(
                f"column {heading!r} of {path} names no unit; write {heading} [{unit}] in the file or in the command"
            )
        if given is None:
            _refuse_bare_unit(path, heading, unit)
        word = spelled(given or "")
        tables = [table for table in UNITS.values() if unit is None or unit in table]
        if word and not any(word in table for table in tables):
            listed = ", ".join(other for table in tables for other in table)
            message = f"file {path.name}, column {name!r}: unit {given!r} is not known here"
            advice = next((of_other_kind[si] for si, row in UNITS.items() if word in row and si in of_other_kind), "")
            raise InputError(message, allowed=f"{listed}, or no unit for SI", recommendation=advice)
        cells = [row[places[0]].strip() if places[0] < len(row) else "" for _, row in rows[1:]]
        column: list[Any] = [
            cell if name in words and _is_word(cell, words[name]) else _number(path, line, row, places[0], heading)
            for cell, (line, row) in zip(cells, rows[1:])
        ]
        if word:
            si = unit or kind_of(word)
            column = [value if isinstance(value, str) else converted(value, word, si) for value in column]
        columns.append(column)
    return columns


def _line_of_units(headings: list[str], rows: list[tuple[int, list[str]]]) -> list[str | None] | None:
    """Return the units in the line below the headings, None for a column without one; None where that line holds
    numbers."""
    if len(rows) < 2:
        return None
    line, row = rows[1]
    cells = [cell.strip() for cell in row]
    words = [cell[1:-1].strip() if cell[:1] in ("[", "(") and cell[-1:] in ("]", ")") else cell for cell in cells]
    if any(_is_number(cell) for cell in cells) or not any(words):
        return None
    if not any(_is_unit(word) for word in words if len(word) <= LONGEST_HEADING):
        return None  # refused by `_number` with its line
    padded = [*words, *([""] * len(headings))]
    return [word or None for word in padded[: len(headings)]]


def _unit_of_column(path: Path, heading: str, name: str, stated: str | None) -> str | None:
    """Return the unit that the heading, the line below it or the caller names. Raise `InputError` where two differ."""
    named = [unit for unit in (name_and_unit(heading)[1], stated, name_and_unit(name)[1]) if unit is not None]
    for unit in named[1:]:
        if spelled(unit) != spelled(named[0]):
            message = f"column {heading!r} of {path.name} is in {named[0]!r} and in {unit!r}"
            raise InputError(message, recommendation="name one unit")
    return named[0] if named else None


def _is_word(cell: str, words: Container[str] | None) -> bool:
    """Return whether a ``cell`` is one of the ``words`` that its column takes (None: any text but a number)."""
    return bool(cell) and (not _is_number(cell) if words is None else cell in words)


def _is_unit(word: str) -> bool:
    return any(spelled(word) in table for table in UNITS.values())


def _is_number(text: str) -> bool:
    try:
        float(text.replace(",", "."))
    except ValueError:
        return False
    return True


def table_headings(path: Path, names: Sequence[str]) -> list[str]:
    """Return the headings of a text file, in the first row that has most of the ``names``, as `read_columns` finds it;
    each with the unit that a line below it may give."""
    rows = _rows(path, names)
    headings = [text.strip() for text in rows[0][1]]
    units = _line_of_units(headings, rows) or [None] * len(headings)
    return [
        heading if unit is None or name_and_unit(heading)[1] is not None else f"{heading} [{unit}]"
        for heading, unit in zip(headings, units)
    ]


def _places(headings: Sequence[str], name: str) -> list[int]:
    """Return where the column ``name`` is: that has this heading, this heading less its unit, or this one less that of
    ``name``."""
    ways = (lambda text: text == name, lambda text: name_and_unit(text)[0] == name, name_and_unit(name)[0].__eq__)
    ways_found = ([i for i, text in enumerate(headings) if way(text)] for way in ways)
    return next(filter(None, ways_found), [])


def name_and_unit(heading: str) -> tuple[str, str | None]:
    """Return the two parts of a heading; the unit, in square or round brackets at its end, is None if it names none."""
    text = heading.strip()
    opening = OPEN.get(text[-1:])
    if opening is None:
        return text, None
    depth = 0
    for place in range(len(text) - 1, -1, -1):
        if text[place] == text[-1]:
            depth += 1
        elif text[place] == opening:
            depth -= 1
        if depth == 0:
            return text[:place].strip(), text[place + 1 : -1]
    return text, None


def _refuse_bare_unit(path: Path, heading: str, expected: str | None) -> None:
    """Raise `InputError` for a ``heading`` without brackets that ends with a unit other than SI (``time/ms``, ``speed
    mm/s``, ``speed_mm_s``, ``slip %``): its values would be read as SI."""
    text = spelled(heading)
    while text and not (text[-1].isascii() and text[-1].isalnum() or text[-1] in "%°"):
        text = text[:-1]
    for si, table in UNITS.items():
        for unit, factor in table.items():
            if expected != si and (expected is not None or unit.isalpha() and len(unit) < 2):  # a letter may be a name
                continue
            for spelling in (unit, unit.replace("/", "_"), unit.replace(" ", "")):
                before = text[: len(text) - len(spelling)][-1:]
                apart = unit == "%" or not (before.isascii() and before.isalnum())
                if unit and factor != 1.0 and text.endswith(spelling) and apart:
                    raise InputError(
                        f"column {heading!r} of {path.name} names {unit} without brackets, and would be read in SI; "
                        f"put the unit into brackets: 'name [{unit}]', or [{si}] if it is that after all"
                    )


def _rows(path: Path, names: Sequence[str]) -> list[tuple[int, list[str]]]:
    """Return (line number, fields) of the rows that are neither empty nor comments, from that on which has most of the
    ``names``; decimal marks made points."""
    every = enumerate(text_of(path).splitlines(), 1)
    lines = [(n, line) for n, line in every if line.strip() and line.lstrip()[0] != "#"]
    if len(lines) < 2:
        raise InputError(f"file {path.name} has {len(lines)} rows; it needs a heading and rows of numbers")
    for number, line in lines:
        if len(line) > LONGEST_LINE:
            message = f"file {path.name}, line {number} has {len(line)} characters"
            raise InputError(message, allowed=f"up to {LONGEST_LINE}")
    try:
        heads = [[text.strip()[:LONGEST_HEADING] for text in _fields(line)] for _, line in lines[:-1][:TITLES]]
        known = [sum(map(bool, (_places(head, name) for name in names))) for head in heads]
        lines = lines[known.index(max(known)) :]
        separator = _separator(lines[0][1])
        rows = [(n, _fields(line, separator)) for n, line in lines]
    except csv.Error as problem:
        raise InputError(f"file {path.name} is not a table ({problem}); give a CSV file") from None
    if separator == ",":
        return rows
    return rows[:1] + [(n, [field.replace(",", ".") for field in row]) for n, row in rows[1:]]


def _separator(line: str) -> str:
    """Return what separates the fields of a line: a semicolon or tab that it has, two blanks where it has no comma,
    else a comma."""
    marks = (";", "\t") if "," in line or BLANKS not in line.strip() else (";", "\t", BLANKS)
    return next((mark for mark in marks if mark in line.strip(" ")), ",")


def _fields(line: str, separator: str = "") -> list[str]:
    """Return those between the ``separator`` ("": that of the line)."""
    mark = separator or _separator(line)
    if mark == BLANKS:
        return [field.strip() for field in line.strip().split(BLANKS) if field.strip()]
    return next(csv.reader([line], delimiter=mark))


def _number(path: Path, line: int, row: list[str], place: int, heading: str) -> float:
    field = row[place].strip() if place < len(row) else ""
    try:
        value = float(field)
    except ValueError:
        value = math.nan
    if not math.isfinite(value) or "_" in field:
        raise InputError(
            f"file {path.name}, line {line}, column {place + 1} ({heading}): "
            f"{f'{shown(field)} is not a number' if field else 'the cell is empty'}; allowed: a "
            "finite number in every row, without marks for thousands"
        )
    return value


def text_of(path: Path, most: float = MOST_TABLE_BYTES) -> str:
    """Return what is in a file of text of at most so many bytes, in UTF-8 (with or without a byte-order mark), in
    UTF-16 with one, or in Windows-1252. Raises `InputError` for anything else."""
    try:
        if not path.is_file():
            raise InputError(f"file {shown(str(path))} does not exist; give a CSV file")
        if path.stat().st_size > most:
            raise InputError(f"file {path.name} has {path.stat().st_size:.3g} bytes; allowed: up to {most:.3g}")
        with path.open("rb") as file:
            begin = file.read(4096)
            wide = begin[:2] in (b"\xff\xfe", b"\xfe\xff")
            if b"\0" in begin and not wide:
                raise InputError(f"file {path.name} is not text; give it in UTF-8, UTF-16 or Windows-1252")
            content = begin + file.read()
    except (OSError, ValueError) as problem:
        raise (
            problem
            if isinstance(problem, InputError)
            else InputError(f"file {shown(str(path))} cannot be read ({problem})")
        ) from None
    except MemoryError:
        size = path.stat().st_size
        raise InputError(
            f"file {path.name} with {size:.3g} bytes does not fit into the memory; give a smaller one"
        ) from None
    for code in ("utf-16",) if wide else ("utf-8-sig", "cp1252"):
        try:
            text = content.decode(code)
        except UnicodeDecodeError:
            continue
        if "\0" not in text:
            return text
    raise InputError(f"file {path.name} is not text; give it in UTF-8, UTF-16 or Windows-1252")
