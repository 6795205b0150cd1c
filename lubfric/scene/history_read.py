"""A history from what a user gives: a number, the inline table of a scene file, a CSV file."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path

from .._base import read_columns, validate
from ..errors import InputError
from .history import Constant, Harmonic, History, Ramp, Table

UNITS = {  # of the quantities of a scene that may change in time
    "speed": "m/s",
    "entrainment_speed": "m/s",
    "sliding": "m/s",
    "sliding_speed": "m/s",
    "load": "N",
    "radius": "m",
    "viscosity": "Pa s",
}
MOST_LAPS = 1e5
LIMITS = {"m/s": (0.0, 1e6), "N": (1e-12, 1e12), "m": (1e-9, 1e3), "Pa s": (1e-9, 1e9)}  # least and largest
KINDS = {"constant": Constant, "ramp": Ramp, "harmonic": Harmonic, "table": Table}


def history(name: str, given, folder: Path = Path()) -> History:
    """A history from a number, a history, or an inline table ``{kind = ..., ...}`` of a scene file."""
    if isinstance(given, History):
        return given
    if not isinstance(given, dict):
        return Constant(validate.number(name, given, "(SI)"))
    table = dict(given)
    kind = validate.choice(f"{name} kind", table.pop("kind", None), (*KINDS, "file"))
    allowed = {"file", "column", "time_column", "repeat"} if kind == "file" else {f.name for f in fields(KINDS[kind])}
    validate.keys(name, table, sorted(allowed))
    needed = {"constant": ("value",), "file": ("file", "column"), "table": ("times", "values")}.get(kind, ())
    missing = [key for key in needed if key not in table]
    if missing:
        raise InputError(f"{name}: {kind} needs {' and '.join(missing)}; allowed keys: {', '.join(sorted(allowed))}")
    try:
        if kind == "file":
            return read_history(folder / _word("file", table.pop("file")), **table, unit=UNITS.get(name.split(".")[-1]))
        return KINDS[kind](**table)
    except InputError as error:
        error.quantity = f"{name}: {error.quantity}"
        raise


def read_history(
    path, column: str, *, time_column: str = "time", repeat: bool = False, unit: str | None = None
) -> Table:
    """The `Table` in two columns of a CSV file whose first row names the columns.

    Headings may carry units (``time [ms]``, ``load (kN)``); without them times are in s and values in SI. ``unit``: SI
    unit of the quantity ("m/s", "N", "m", "Pa s"); a column of another quantity is refused. See `lubfric._base.tables`.
    """
    names = _word("time_column", time_column), _word("column", column)
    times, values = read_columns(Path(path), names, ("s", unit))
    return Table(times=tuple(times), values=tuple(values), repeat=repeat)


def _word(name: str, value) -> str:
    if not isinstance(value, str) or not value or "\0" in value:
        raise InputError(f"{name} = {validate.shown(value)}; give a word in quotes")
    return value


def checked_history(name: str, value, unit: str, duration: float, *, positive: bool = True) -> History:
    """A number or a history as a history that lasts for ``duration`` [s] and stays in its range."""
    given = history(name, value)
    if isinstance(given, Table) and not given.repeat and given.times[-1] < duration * (1 - 1e-9):
        raise InputError(
            f"{name}: the table ends at {given.times[-1]:g} s, the run lasts {duration:g} s; "
            "give a table as long as the run, or repeat = true"
        )
    if isinstance(given, Table) and given.repeat and duration > MOST_LAPS * given.times[-1]:
        raise InputError(
            f"{name}: the table of {given.times[-1]:g} s is repeated {duration / given.times[-1]:.3g} times; allowed: "
            f"up to {MOST_LAPS:g}"
        )
    low, high = given.range(duration)
    if positive and low <= 0.0:
        raise InputError(f"{name} falls to {low:g} {unit} during the run; it must stay above 0 {unit}")
    least, most = LIMITS.get(unit, (1e-30, 1e30))
    for value in (low, high):
        if abs(value) > most or (positive or value != 0) and abs(value) < max(least, validate.LEAST):
            raise InputError(
                f"{name} reaches {value:g} {unit} during the run; allowed: magnitudes up to {most:g} {unit}"
                f"{f', at least {least:g}' if positive else ''}"
            )
    return given
