"""`Transient`: what changes in time in a scene, and for how long; histories from what a user gives."""

import math
from dataclasses import KW_ONLY, dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np

from .._base import FloatArray, read_columns, validate
from ..errors import InputError
from ..quantities import KEYS
from ..units import UNITS, number_and_unit, spelled, without_unit, worded
from .history import Constant, Harmonic, History, Ramp, Table

HISTORIES = {  # what may change in time, and the key that has it where it does not
    "speed": "motion.entrainment_speed",
    "sliding": "motion.sliding_speed",
    "load": "bodies.load",
    "radius": "bodies.radius",
    "viscosity": "lubricant.viscosity",
}
UNITS_OF_HISTORIES = {name: KEYS.get(key, KEYS["speed"]).unit for name, key in HISTORIES.items()}
DEGREES_OF_TURN = 360.0  # of one turn; by definition
MOST_LAPS = 1e5  # periods of a history in a run. A convention

# Least and largest value of a history, by its unit: a choice, against slips of units.
HISTORY_LIMITS = {"m/s": (0.0, 1e6), "N": (1e-12, 1e12), "m": (1e-9, 1e3), "Pa s": (1e-9, 1e9)}

HISTORY_KINDS = {"constant": Constant, "ramp": Ramp, "harmonic": Harmonic, "table": Table}

WORDS = ("kind", "file", "column", "time_column", "angle_column")  # keys of histories that are no numbers
HISTORY_UNITS = {  # units of others
    **dict.fromkeys(("begin", "until", "times"), "s"),
    "frequency": "Hz",
    "phase": "rad",
    "angles": "°",
}
# Keys of histories that are over the angle of rotation, and what they replace.
OVER_ANGLE = {"angles": "times", "angle_column": "time_column"}


@dataclass(frozen=True)
class Transient:
    """What changes in time in a scene, and for how long.

    A history is a number or one of `lubfric.scene`. None means the scene's own constant.

    Attributes
    ----------
    duration : [s]
    outputs : number of output times, spread evenly, in addition to the first
    first_output : time of the first output [s]; the time before it, such as the start of a periodic motion, is solved
        but is not part of the results
    speed : entrainment speed [m/s]
    sliding : u2 - u1 [m/s]; None: slide-roll ratio x speed
    load : [N]
    radius : reduced radius [m]
    viscosity : at ambient pressure [Pa s]
    initial : "steady": the steady state of the values before t = 0; "rest": no film pressure, the contact carries the
        load; "auto": steady where there is entrainment, else rest
    initial_film : start from the undeformed parabola at this height instead [m]
    tolerance : largest local error of the film in a step, relative; None: 0.01 x the scene's film tolerance
    rotational_speed : of a cam or a crank, turns per second [Hz]: histories may be over its angle, and results state it
    """

    duration: float
    outputs: int = 200
    _: KW_ONLY
    first_output: float = 0.0
    speed: History | None = None
    sliding: History | None = None
    load: History | None = None
    radius: History | None = None
    viscosity: History | None = None
    initial: str = "auto"
    initial_film: float | None = None
    tolerance: float | None = None
    rotational_speed: float | None = None

    @property
    def histories(self) -> tuple[History, ...]:
        """The histories of all that changes."""
        return tuple(h for h in (getattr(self, name) for name in UNITS_OF_HISTORIES) if h is not None)

    @property
    def output_times(self) -> FloatArray:
        """The times of the outputs [s]."""
        return np.linspace(self.first_output, self.duration, self.outputs + 1)

    def angle_at(self, time: float) -> float:
        """Return the angle of rotation [°] at ``time`` [s], 0 at the start and not reduced to one turn; NaN without a
        ``rotational_speed``."""
        return math.nan if self.rotational_speed is None else DEGREES_OF_TURN * self.rotational_speed * time

    def moment_in_words(self, time: float) -> str:
        """Return a ``time`` [s] as text, with its angle where that is known: "30 ms (180°)"."""
        return moment_in_words(time, self.angle_at(time))

    def __post_init__(self) -> None:
        validate.python_fields(self, "transient")
        validate.in_range("transient", self)
        validate.integer("transient.outputs", self.outputs, minimum=1, maximum=1_000_000)
        if self.first_output >= self.duration:
            message = f" = {self.first_output:g} s is not before the end of the run, {self.duration:g} s"
            raise InputError(message, "transient.first_output", f"0 to below {self.duration:g} s")
        if self.initial_film is not None and self.initial != "auto":
            message = f" = {self.initial!r} has no effect together with initial_film, from which the run starts"
            raise InputError(message, "transient.initial", "one of the two")
        for name, unit in UNITS_OF_HISTORIES.items():
            given = getattr(self, name)
            if given is not None:
                given = history(f"transient.{name}", given, unit, rotational_speed=self.rotational_speed)
                given = checked_history(f"transient.{name}", given, unit, self.duration, positive=unit != "m/s")
                object.__setattr__(self, name, given)


def moment_in_words(time: float, angle: float) -> str:
    """Return a ``time`` [s] as text, with an ``angle`` of rotation [°] (NaN: not known): "30 ms (180°)"."""
    return worded(time, "s") if math.isnan(angle) else f"{worded(time, 's')} ({angle:.4g}°)"


def history(
    name: str, given: Any, unit: str | None = None, folder: Path = Path(), rotational_speed: float | None = None
) -> History:
    """Return a history from a number, a history, or an inline table ``{kind = ..., ...}`` of a scene file.

    ``unit``: SI unit of the quantity; ``folder``: which a file of the table is relative to; ``rotational_speed`` [Hz]:
    with which angles become times.
    """
    if isinstance(given, History):
        return given
    if not isinstance(given, dict):
        return Constant(validate.number(name, without_unit(name, given, unit) if unit else given, "(SI)"))
    table = dict(given)
    for key in table if unit else ():
        if key not in WORDS:
            table[key] = without_unit(f"{name} {key}", table[key], HISTORY_UNITS.get(key, str(unit)))
    kind = validate.choice(f"{name} kind", table.pop("kind", None), (*HISTORY_KINDS, "file"))
    allowed = (
        {"file", "column", "time_column", "repeat"} if kind == "file" else {f.name for f in fields(HISTORY_KINDS[kind])}
    )
    allowed |= {angle for angle, time in OVER_ANGLE.items() if time in allowed}
    validate.keys(name, table, sorted(allowed))
    for angle, over_time in OVER_ANGLE.items():
        if angle in table and over_time in table:
            raise InputError(f"{name} has {over_time} and {angle}; give one of them")
    of_table = ("angles" if "angles" in table else "times", "values")
    needed = {"constant": ("value",), "file": ("file", "column"), "table": of_table}.get(kind, ())
    missing = [key for key in needed if key not in table]
    if missing:
        raise InputError(f"{name}: {kind} needs {' and '.join(missing)}; allowed keys: {', '.join(sorted(allowed))}")
    try:
        if "angles" in table:
            table["times"] = times_of_angles(table.pop("angles"), rotational_speed)
        if kind == "file":
            path = folder / _word("file", table.pop("file"))
            return read_history(path, **table, unit=unit, rotational_speed=rotational_speed)
        history: History = HISTORY_KINDS[kind](**table)
        return history
    except InputError as error:
        error.quantity = f"{name}: {error.quantity}"
        raise


def read_history(
    path: str | Path,
    column: str,
    *,
    time_column: str = "time",
    angle_column: str | None = None,
    rotational_speed: float | None = None,
    repeat: bool = False,
    unit: str | None = None,
) -> Table:
    """Return the `Table` in two columns of a CSV file whose first row names the columns.

    Headings may carry units (``time [ms]``, ``load (kN)``); without them times are in s and values in SI. ``unit``: SI
    unit of the quantity ("m/s", "N", "m", "Pa s"); a column of another quantity is refused. ``angle_column``: a column
    of angles of rotation [°] in place of the times, at a ``rotational_speed`` [Hz].
    """
    over = _word("time_column", time_column) if angle_column is None else _word("angle_column", angle_column)
    names = over, _word("column", column)
    times, values = read_columns(Path(path), names, ("s" if angle_column is None else "°", unit))
    if angle_column is not None:
        times = times_of_angles(times, rotational_speed)
    return Table(times=tuple(times), values=tuple(values), repeat=repeat)


def is_angle(given: Any) -> bool:
    """Return whether what is ``given`` is text with a unit of angles, such as "360 deg"."""
    parts = number_and_unit(given) if isinstance(given, str) else None
    return parts is not None and bool(parts[1]) and spelled(parts[1]) in UNITS["rad"]


def times_of_angles(angles: Any, rotational_speed: float | None) -> list[float]:
    """Return the times [s] at which something that turns with ``rotational_speed`` [Hz] has turned by each of
    ``angles`` [°]. Raises `InputError` without that speed."""
    if rotational_speed is None:
        raise InputError(
            "angles are given without transient.rotational_speed", recommendation="give it, such as '1000 1/min'"
        )
    numbers = validate.array("history angles", angles, "°", ndim=1)
    times: list[float] = (numbers / (DEGREES_OF_TURN * rotational_speed)).tolist()
    return times


def _word(name: str, value: str) -> str:
    if not isinstance(value, str) or not value or "\0" in value:
        raise InputError(f"{name} = {validate.shown(value)}; give a word in quotes")
    return value


def checked_history(name: str, value: Any, unit: str, duration: float, *, positive: bool = True) -> History:
    """Return a number or a history as a history that lasts for ``duration`` [s] and stays in its range."""
    given = history(name, value, unit)
    if isinstance(given, Table):
        last = given.times[-1]
        if not given.repeat and last < duration * (1 - 1e-9):
            message = f": the table ends at {last:g} s, the run lasts {duration:g} s"
            raise InputError(message, name, recommendation="give a table as long as the run, or repeat = true")
        if given.repeat and duration > MOST_LAPS * last:
            message = f": the table of {last:g} s is repeated {duration / last:.3g} times"
            raise InputError(message, name, f"up to {MOST_LAPS:g}")
    least, most = HISTORY_LIMITS.get(unit, (1e-30, 1e30))
    for end in given.range(duration):
        validate.number(f"{name} during the run", end, unit, minimum=least if positive else -most, maximum=most)
    return given
