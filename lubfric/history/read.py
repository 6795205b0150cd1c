"""A history from what a user gives: a number, the inline table of a scene file, a CSV file."""

from __future__ import annotations

import csv
from dataclasses import fields
from pathlib import Path

from .. import validate
from ..errors import InputError
from .kinds import Constant, Harmonic, Ramp, Table

KINDS = {"constant": Constant, "ramp": Ramp, "harmonic": Harmonic, "table": Table}


def history(name: str, given, folder: Path = Path()) -> Constant:
    """A history from a number, a history, or an inline table ``{kind = ..., ...}`` of a scene file."""
    if isinstance(given, Constant):
        return given
    if not isinstance(given, dict):
        return Constant(validate.number(name, given, "(SI)"))
    table = dict(given)
    kind = validate.choice(f"{name} kind", table.pop("kind", None), (*KINDS, "file"))
    allowed = (
        {"file", "column", "time_column", "repeat"}
        if kind == "file"
        else {f.name for f in fields(KINDS[kind]) if f.name != "value" or kind == "constant"}
    )
    for key in table:
        if key not in allowed:
            raise InputError(
                f"unknown key {key!r} in {name}{validate.nearest(key, allowed)}; allowed: {', '.join(sorted(allowed))}"
            )
    try:
        if kind == "file":
            return read_history(folder / table.pop("file"), **table)
        return KINDS[kind](**{k: tuple(v) if isinstance(v, list) else v for k, v in table.items()})
    except InputError as error:
        raise InputError(f"{name}: {error}") from None
    except (TypeError, KeyError) as error:
        raise InputError(f"{name}: {kind} needs more: {error}; allowed keys: {', '.join(sorted(allowed))}") from None


def read_history(path, column: str, *, time_column: str = "time", repeat: bool = False) -> Table:
    """The `Table` in two columns of a CSV file whose first row names the columns (times in s, values in
    SI)."""
    path = Path(path)
    if not path.is_file():
        raise InputError(f"history file {str(path)!r} does not exist; allowed: a CSV file")
    with path.open(newline="") as file:
        rows = [row for row in csv.reader(file) if row and not row[0].lstrip().startswith("#")]
    if not rows:
        raise InputError(f"history file {path.name} is empty; allowed: a heading and at least two rows")
    names = [name.split("[")[0].strip() for name in rows[0]]
    for name in (time_column, column):
        if name not in names:
            raise InputError(
                f"history file {path.name} has no column {name!r}{validate.nearest(name, names)}; "
                f"it has: {', '.join(names)}"
            )
    columns = []
    for name in (time_column, column):
        k = names.index(name)
        try:
            columns.append(tuple(float(row[k]) for row in rows[1:]))
        except (ValueError, IndexError):
            raise InputError(f"history file {path.name}, column {name!r}: not a number in every row") from None
    return Table(times=columns[0], values=columns[1], repeat=repeat)


def check_history(name: str, unit: str, given: Constant, duration: float, *, positive: bool) -> None:
    """The history lasts as long as the run and stays in its range."""
    if isinstance(given, Table) and not given.repeat and given.times[-1] < duration * (1 - 1e-9):
        raise InputError(
            f"{name}: the table ends at {given.times[-1]:g} s, the run lasts {duration:g} s; "
            "allowed: a table as long as the run, or repeat = true"
        )
    lowest = given.range(duration)[0]
    if positive and lowest <= 0.0:
        raise InputError(f"{name} falls to {lowest:g} {unit} during the run; allowed: > 0 {unit} at all times")
