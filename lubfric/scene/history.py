"""Quantities that change in time: constant, ramp, harmonic, table.

Each gives its value just after (``at``) and just before (``before``) a time [s], the times of its jumps, and
its range. `lubfric.scene.read_history` makes them from a scene file or a CSV file.
"""

import math
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .._base import FloatArray, validate
from ..errors import InputError

TIME_ROUNDING = 1e-12  # relative: times that are closer are one time; a choice, above rounding
BEND = 0.01  # of the value, by which a straight line may miss it; a choice: what a figure shows

# Part of the largest value [-]: smaller values have the error that is allowed at this value. A choice: a smaller part
# cuts a history into more pieces.
LEAST_PART = 1e-4


class History:
    """A quantity that changes in time; the kinds below are its only ones in scene files."""

    def at(self, time: float) -> float:
        """Return the value at (just after) ``time`` [s]."""
        raise NotImplementedError

    def before(self, time: float) -> float:
        """Return the value just before ``time`` [s]."""
        return self.at(time)

    def stops(self, duration: float) -> tuple[float, ...]:
        """Return the times [s] inside the run, other than the jumps, at which a step ends."""
        return ()

    def jumps(self, duration: float) -> tuple[float, ...]:
        """Return the times [s] at which the value jumps."""
        return ()

    @property
    def horizon(self) -> float:
        """The time [s] after which nothing new follows: the end of the changes, or of the first period; 0 for none."""
        return 0.0

    @property
    def period(self) -> float:
        """The time [s] after which it repeats itself; infinite where it does not."""
        return math.inf

    def range(self, duration: float) -> tuple[float, float]:
        """Return the smallest and largest value from 0 to ``duration`` [s]; here of a quantity that never turns."""
        return min(self.at(0.0), self.at(duration)), max(self.at(0.0), self.at(duration))

    def integral(self, time: float) -> float:
        """Return the integral over the time from 0 to ``time`` [s]."""
        raise NotImplementedError

    def _check_numbers(self, **units: str) -> None:
        """Make the named fields floats, checked to be finite."""
        for name, unit in units.items():
            object.__setattr__(self, name, validate.number(f"history {name}", getattr(self, name), unit))


@dataclass(frozen=True)
class Constant(History):
    """A history that has one ``value`` at all times."""

    value: float

    def __post_init__(self) -> None:
        self._check_numbers(value="(SI)")

    def at(self, time: float) -> float:
        return self.value

    def integral(self, time: float) -> float:
        return self.value * time


@dataclass(frozen=True, kw_only=True)
class Harmonic(History):
    """mean + amplitude sin(2 pi frequency t + phase); frequency [Hz] > 0, phase [rad]."""

    amplitude: float = 0.0
    frequency: float = 1.0
    phase: float = 0.0
    mean: float = 0.0

    def __post_init__(self) -> None:
        self._check_numbers(amplitude="(SI)", mean="(SI)", phase="rad")
        object.__setattr__(self, "frequency", validate.positive("history frequency", self.frequency, "Hz"))

    def at(self, time: float) -> float:
        return self.mean + self.amplitude * math.sin(2.0 * math.pi * self.frequency * time + self.phase)

    @property
    def horizon(self) -> float:
        return self.period

    @property
    def period(self) -> float:
        return 1.0 / self.frequency

    def range(self, duration: float) -> tuple[float, float]:
        if self.frequency * duration >= 1.0:
            return self.mean - abs(self.amplitude), self.mean + abs(self.amplitude)
        turns = (np.pi * (np.arange(-2, 6) + 0.5) - self.phase % (2 * np.pi)) / (2 * np.pi * self.frequency)
        values = [self.at(t) for t in (0.0, duration, *turns[(turns > 0.0) & (turns < duration)])]
        return min(values), max(values)

    def integral(self, time: float) -> float:
        turn = 2.0 * math.pi * self.frequency
        return self.mean * time + self.amplitude / turn * (math.cos(self.phase) - math.cos(turn * time + self.phase))


@dataclass(frozen=True, kw_only=True)
class Table(History):
    """Straight lines between ``values`` at ``times`` [s] (not decreasing, from 0 or before).

    A time given twice is a jump. ``repeat``: begin again at the last time (a period); without it the table must last as
    long as the run. A step ends at every corner (`corners`), so that no step passes over a pulse.
    """

    times: tuple[float, ...] = ()
    values: tuple[float, ...] = ()
    repeat: bool = False

    def __post_init__(self) -> None:
        times = validate.array("history times", self.times, "s", ndim=1)
        values = validate.array("history values", self.values, "(SI)", ndim=1)
        if times.size != values.size or times.size < 2:
            raise InputError(f"history has {times.size} times and {values.size} values; allowed: as many, at least two")
        object.__setattr__(self, "repeat", validate.boolean("history repeat", self.repeat))
        object.__setattr__(self, "times", tuple(times.tolist()))
        object.__setattr__(self, "values", tuple(values.tolist()))
        name = "history times"
        first = times[0]
        last = times[-1]
        falls = np.flatnonzero(np.diff(times) < 0.0)
        if falls.size:
            i = int(falls[0])
            message = f" are not sorted: {times[i + 1]:g} s follows {times[i]:g} s (entry {i + 2})"
            raise InputError(message, name, "times that do not decrease, in s")
        if first > 0.0 or last <= first:
            raise InputError(f" run from {first:g} to {last:g} s", name, "from 0 s or before to a later time")
        if self.repeat and first != 0.0:
            raise InputError(f" start at {first:g} s", name, "0 s for the start of a table that repeats")
        if np.any(times[2:] == times[:-2]):
            raise InputError(" contain the same time three times", name, "at most twice (a jump)")

    def at(self, time: float) -> float:
        return self._value(time, "right")

    def before(self, time: float) -> float:
        return self._value(time, "left")

    def _value(self, time: float, side: str) -> float:
        t = self.times
        v = self.values
        time = self._on_a_row(time, side)
        i = bisect_left(t, time) if side == "left" else bisect_right(t, time)
        if i == 0 or i == len(t):
            return v[min(i, len(t) - 1)]
        return v[i - 1] + (v[i] - v[i - 1]) * (time - t[i - 1]) / (t[i] - t[i - 1])

    def _on_a_row(self, time: float, side: str) -> float:
        """Return ``time`` in the first period. If it differs only by rounding from a row of the table, it is the time
        of that row: 0.1 + 0.2 s is a jump at 0.3 s."""
        t = self.times
        near = TIME_ROUNDING * max(time, t[-1])
        if self.repeat and time > 0.0:
            laps = math.floor((time + near) / t[-1])
            time = max(time - laps * t[-1], 0.0)
            if laps and side == "left" and time <= near:
                return t[-1]
        i = bisect_left(t, time)
        return next((row for row in t[max(i - 1, 0) : i + 1] if abs(row - time) <= near), time)

    def stops(self, duration: float) -> tuple[float, ...]:
        """Return the corners, of every period."""
        stop_times = [*corners(np.array(self.times), np.array(self.values)), self.times[-1]]
        return tuple(time for time in self._in_every_period(stop_times, duration) if time > 0.0)

    def jumps(self, duration: float) -> tuple[float, ...]:
        """Return the times [s] at which the value jumps, 0 <= t < duration."""
        t = np.array(self.times)
        v = np.array(self.values)
        jump_times = t[1:][(np.diff(t) == 0.0) & (np.diff(v) != 0.0)]
        if self.repeat and v[0] != v[-1]:
            jump_times = np.append(jump_times, t[-1])
        return self._in_every_period(jump_times, duration)

    def _in_every_period(self, times: FloatArray | list[float], duration: float) -> tuple[float, ...]:
        """Return the ``times`` of the table, in every period, from 0 to before ``duration``."""
        laps = np.arange(math.ceil(duration / self.times[-1]) if self.repeat else 1)
        every_time = np.unique(np.asarray(times, float)[None, :] + laps[:, None] * self.times[-1])
        return tuple(every_time[(every_time >= 0.0) & (every_time < duration)].tolist())

    @property
    def horizon(self) -> float:
        return self.times[-1]

    @property
    def period(self) -> float:
        return self.times[-1] if self.repeat else math.inf

    def range(self, duration: float) -> tuple[float, float]:
        is_whole = self.repeat and duration >= self.times[-1]
        inside = [v for t, v in zip(self.times, self.values) if is_whole or 0.0 <= t <= duration]
        values = [*inside, self.at(0.0), self.before(duration)]
        return min(values), max(values)

    def integral(self, time: float) -> float:
        laps = math.floor(time / self.times[-1]) if self.repeat else 0
        return laps * self._area(self.times[-1]) + self._area(time - laps * self.times[-1])

    def _area(self, time: float) -> float:
        """Return the area under the lines from 0 to ``time``, in the first period."""
        t = np.array(self.times)
        v = np.array(self.values)
        inside = (t > 0.0) & (t < time)
        values = np.array([self.at(0.0), *v[inside], self.before(time)])
        return float(np.sum(0.5 * (values[1:] + values[:-1]) * np.diff(np.array([0.0, *t[inside], time]))))


@dataclass(frozen=True, kw_only=True)
class Ramp(History):
    """``start`` until the time ``begin`` [s], then a straight line to ``end`` at ``until`` [s], ``end`` after it."""

    start: float = 0.0
    end: float = 0.0
    until: float = 1.0
    begin: float = 0.0

    def __post_init__(self) -> None:
        self._check_numbers(start="(SI)", end="(SI)")
        object.__setattr__(self, "begin", validate.nonnegative("history begin", self.begin, "s"))
        object.__setattr__(self, "until", validate.number("history until", self.until, "s", above=self.begin))

    def at(self, time: float) -> float:
        share = min(max((time - self.begin) / (self.until - self.begin), 0.0), 1.0)
        return self.start + share * (self.end - self.start)

    @property
    def horizon(self) -> float:
        return self.until

    def integral(self, time: float) -> float:
        passed = min(max(time - self.begin, 0.0), self.until - self.begin)
        ramp = self.until - self.begin
        risen = 0.5 * passed**2 / ramp + max(time - self.until, 0.0)
        return self.start * time + (self.end - self.start) * risen

    def stops(self, duration: float) -> tuple[float, ...]:
        """Return the two corners."""
        return tuple(t for t in (self.begin, self.until) if 0.0 < t < duration)


def horizon_of(histories: Sequence[History], duration: float) -> float:
    """Return the time [s] until which ``histories`` are looked through for what a run needs whatever its ``duration``
    [s]: after it nothing new follows, unless histories of different periods meet otherwise, until the run ends."""
    horizons = [history.horizon for history in histories]
    periods = {history.period for history in histories if math.isfinite(history.period)}
    return max(horizons, default=0.0) if len(periods) < 2 else max(duration, *horizons)


def corners(times: np.ndarray, values: np.ndarray) -> list[float]:
    """Return the times [s] at which a line of straight pieces has to have a corner to follow ``values`` within 1 %.

    Every piece begins at a row. It is as long as one straight line from there stays within `BEND` of the values of all
    rows (the cone of such lines gets narrower with every row). A jump, which is a time given twice, begins a new piece.
    So a smooth wave has some twenty corners a period, however finely it is sampled, and a pulse keeps all of its own.
    """
    allowed = BEND * np.maximum(np.abs(values), LEAST_PART * np.abs(values).max())
    t = times.tolist()
    v = values.tolist()
    miss = allowed.tolist()
    corner_times = []
    start = 0
    low = -math.inf
    high = math.inf
    for j in range(1, len(t)):
        if t[j] > t[j - 1] and not low <= (v[j] - v[start]) / (t[j] - t[start]) <= high:
            start = j - 1
            low = -math.inf
            high = math.inf
            corner_times.append(t[start])
        if t[j] == t[j - 1]:
            start = j
            low = -math.inf
            high = math.inf
            continue
        run = t[j] - t[start]
        low = max(low, (v[j] - miss[j] - v[start]) / run)
        high = min(high, (v[j] + miss[j] - v[start]) / run)
    return corner_times
