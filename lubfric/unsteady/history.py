"""Quantities that change in time: constant, ramp, harmonic, table, CSV file.

Each gives its value just after (``at``) and just before (``before``) a time [s], the times of its jumps, and
its range; `history` turns a number, one of these, or the inline table of a scene file into one of them.
"""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np

from .. import validate
from ..errors import InputError


@dataclass(frozen=True)
class Constant:
    """The same ``value`` at all times."""

    value: float

    def __post_init__(self):
        validate.number("history value", self.value, "(SI)")

    def at(self, time: float) -> float:
        """Value at (just after) ``time`` [s]."""
        return float(self.value)

    before = at

    def stops(self, duration: float) -> tuple[float, ...]:
        """Times [s] inside the run at which the value or its slope jumps: a step ends there."""
        return ()

    def jumps(self, duration: float) -> tuple[float, ...]:
        """Times [s] at which the value jumps."""
        return ()

    def range(self, duration: float) -> tuple[float, float]:
        """Smallest and largest value from 0 to ``duration`` [s]."""
        return float(self.value), float(self.value)


@dataclass(frozen=True)
class Harmonic(Constant):
    """mean + amplitude sin(2 pi frequency t + phase); frequency [Hz] > 0, phase [rad]."""

    amplitude: float = 0.0
    frequency: float = 1.0
    phase: float = 0.0
    mean: float = 0.0
    value: float = 0.0

    def __post_init__(self):
        for name, unit in (("amplitude", "(SI)"), ("mean", "(SI)"), ("phase", "rad")):
            validate.number(f"history {name}", getattr(self, name), unit)
        validate.positive("history frequency", self.frequency, "Hz")

    def at(self, time: float) -> float:
        """Value at ``time`` [s]."""
        return self.mean + self.amplitude * math.sin(2.0 * math.pi * self.frequency * time + self.phase)

    before = at

    def range(self, duration: float) -> tuple[float, float]:
        """Smallest and largest value from 0 to ``duration`` [s]."""
        if self.frequency * duration >= 1.0:
            return self.mean - abs(self.amplitude), self.mean + abs(self.amplitude)
        turns = (np.pi * (np.arange(-2, 6) + 0.5) - self.phase % (2 * np.pi)) / (2 * np.pi * self.frequency)
        times = np.concatenate([[0.0, duration], turns[(turns > 0.0) & (turns < duration)]])
        values = [self.at(t) for t in times]
        return min(values), max(values)


@dataclass(frozen=True)
class Table(Constant):
    """Straight lines between ``values`` at ``times`` [s] (not decreasing, from 0 or before).

    A time given twice is a jump. ``repeat``: begin again at the last time (a period); without it the table
    must last as long as the run.
    """

    times: tuple[float, ...] = ()
    values: tuple[float, ...] = ()
    repeat: bool = False
    value: float = 0.0

    def __post_init__(self):
        times = validate.array("history times", self.times, "s", ndim=1)
        values = validate.array("history values", self.values, "(SI)", ndim=1)
        if times.size != values.size or times.size < 2:
            raise InputError(
                f"history has {times.size} times and {values.size} values; allowed: as many, at least two"
            )
        falls = np.flatnonzero(np.diff(times) < 0.0)
        if falls.size:
            i = int(falls[0])
            raise InputError(
                f"history times are not sorted: {times[i + 1]:g} s follows {times[i]:g} s (entry {i + 2}); "
                "allowed: times that do not decrease, in s"
            )
        if times[0] > 0.0 or times[-1] <= times[0]:
            raise InputError(
                f"history times run from {times[0]:g} to {times[-1]:g} s; allowed: from 0 s or before to a "
                "later time"
            )
        if self.repeat and times[0] != 0.0:
            raise InputError(f"history times start at {times[0]:g} s; allowed for repeat: 0 s")
        if np.any(times[2:] == times[:-2]):
            raise InputError("history times hold the same time three times; allowed: at most twice (a jump)")
        object.__setattr__(self, "times", tuple(float(t) for t in times))
        object.__setattr__(self, "values", tuple(float(v) for v in values))

    def at(self, time: float) -> float:
        """Value just after ``time`` [s]."""
        return self._value(time, "right")

    def before(self, time: float) -> float:
        """Value just before ``time`` [s]."""
        return self._value(time, "left")

    def _value(self, time: float, side: str) -> float:
        t, v = self.times, self.values
        if self.repeat and time > 0.0:
            laps = math.floor(time / t[-1])
            time -= laps * t[-1]
            if laps and side == "left" and time <= 1e-12 * t[-1]:
                time = t[-1]
        i = int(np.searchsorted(t, time, side))
        if i == 0 or i == len(t):
            return v[min(i, len(t) - 1)]
        return v[i - 1] + (v[i] - v[i - 1]) * (time - t[i - 1]) / (t[i] - t[i - 1])

    def jumps(self, duration: float) -> tuple[float, ...]:
        """Times [s] at which the value jumps, 0 <= t < duration."""
        t, v = np.array(self.times), np.array(self.values)
        found = t[1:][(np.diff(t) == 0.0) & (np.diff(v) != 0.0)]
        if self.repeat:
            if v[0] != v[-1]:
                found = np.append(found, t[-1])
            laps = np.arange(math.ceil(duration / t[-1]))
            found = np.unique((found[None, :] + laps[:, None] * t[-1]).ravel())
        return tuple(float(x) for x in found if 0.0 <= x < duration)

    stops = jumps

    def range(self, duration: float) -> tuple[float, float]:
        """Smallest and largest value from 0 to ``duration`` [s]."""
        inside = [v for t, v in zip(self.times, self.values) if self.repeat or 0.0 <= t <= duration]
        values = [*inside, self.at(0.0), self.before(duration)]
        return min(values), max(values)


@dataclass(frozen=True)
class Ramp(Constant):
    """``start`` until the time ``begin`` [s], then a straight line to ``end`` at ``until`` [s], ``end``
    after it."""

    start: float = 0.0
    end: float = 0.0
    until: float = 1.0
    begin: float = 0.0
    value: float = 0.0

    def __post_init__(self):
        for name in ("start", "end"):
            validate.number(f"history {name}", getattr(self, name), "(SI)")
        validate.nonnegative("history begin", self.begin, "s")
        validate.number("history until", self.until, "s", above=self.begin)

    def at(self, time: float) -> float:
        """Value at ``time`` [s]."""
        share = min(max((time - self.begin) / (self.until - self.begin), 0.0), 1.0)
        return self.start + share * (self.end - self.start)

    before = at

    def stops(self, duration: float) -> tuple[float, ...]:
        """The two corners."""
        return tuple(t for t in (self.begin, self.until) if 0.0 < t < duration)

    def range(self, duration: float) -> tuple[float, float]:
        """Smallest and largest value from 0 to ``duration`` [s]."""
        return min(self.at(0.0), self.at(duration)), max(self.at(0.0), self.at(duration))


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
            raise InputError(
                f"history file {path.name}, column {name!r}: not a number in every row"
            ) from None
    return Table(times=columns[0], values=columns[1], repeat=repeat)


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
                f"unknown key {key!r} in {name}{validate.nearest(key, allowed)}; "
                f"allowed: {', '.join(sorted(allowed))}"
            )
    try:
        if kind == "file":
            return read_history(folder / table.pop("file"), **table)
        return KINDS[kind](**{k: tuple(v) if isinstance(v, list) else v for k, v in table.items()})
    except InputError as error:
        raise InputError(f"{name}: {error}") from None
    except (TypeError, KeyError) as error:
        raise InputError(
            f"{name}: {kind} needs more: {error}; allowed keys: {', '.join(sorted(allowed))}"
        ) from None


def check_history(name: str, unit: str, given: Constant, duration: float, *, positive: bool) -> None:
    """The history lasts as long as the run and stays in its range."""
    if isinstance(given, Table) and not given.repeat and given.times[-1] < duration * (1 - 1e-9):
        raise InputError(
            f"{name}: the table ends at {given.times[-1]:g} s, the run lasts {duration:g} s; "
            "allowed: a table as long as the run, or repeat = true"
        )
    lowest = given.range(duration)[0]
    if positive and lowest <= 0.0:
        raise InputError(
            f"{name} falls to {lowest:g} {unit} during the run; allowed: > 0 {unit} at all times"
        )


@dataclass(frozen=True)
class Transient:
    """What changes in time in a scene, and for how long.

    duration [s]; outputs: number of output times, spread evenly, beside 0. Histories (numbers or histories
    of this module; None: the scene's own constant): speed [m/s] entrainment speed; sliding [m/s] u2 - u1
    (None: slide-roll ratio x speed); load [N]; radius [m]; viscosity [Pa s] at ambient pressure.
    initial: "steady" (the steady state of the values before t = 0), "rest" (no film pressure, the contact
    carries the load) or "auto" (steady where there is entrainment, else rest); initial_film [m]: start
    from the undeformed parabola at this height instead.
    tolerance: largest local error of the film per step, relative (None: 0.01 x the scene's film tolerance).
    """

    duration: float
    outputs: int = 200
    speed: Constant | None = None
    sliding: Constant | None = None
    load: Constant | None = None
    radius: Constant | None = None
    viscosity: Constant | None = None
    initial: str = "auto"
    initial_film: float | None = None
    tolerance: float | None = None

    def __post_init__(self):
        validate.positive("transient.duration", self.duration, "s")
        validate.integer("transient.outputs", self.outputs, minimum=1)
        validate.choice("transient.initial", self.initial, ("auto", "steady", "rest"))
        if self.initial_film is not None:
            validate.positive("transient.initial_film", self.initial_film, "m")
        if self.tolerance is not None:
            validate.number("transient.tolerance", self.tolerance, "(-)", minimum=1e-9, maximum=0.1)
        for name, unit in (
            ("speed", "m/s"),
            ("sliding", "m/s"),
            ("load", "N"),
            ("radius", "m"),
            ("viscosity", "Pa s"),
        ):
            given = getattr(self, name)
            if given is not None:
                given = history(f"transient.{name}", given)
                object.__setattr__(self, name, given)
                check_history(
                    f"transient.{name}", unit, given, self.duration, positive=unit in ("N", "m", "Pa s")
                )
