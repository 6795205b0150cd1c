"""What the line of progress says of a run in time that takes much longer than estimated."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from .._base.processor_time import processor_time
from ..quantities import counted
from ..studies import in_words
from ..units import worded

# Processor time over its estimate [-] from which on a run is slow. A choice: four of five runs take less.
SLOW_RATIO = 3.0
# Part of the estimate [-] in which a run advances by `LEAST_ADVANCE`, or is slow. A choice: a smaller value would name
# reversals.
SLOW_PART = 0.1
# Part of the duration [-]. A choice, as above.
LEAST_ADVANCE = 0.01
# Processor time [s] below which nothing is slow. A choice: nobody stops a run earlier.
LEAST_SECONDS = 10.0


class Mark(NamedTuple):
    """A place that a run reached: its ``time`` [s], the number of ``steps`` until there, and the processor time ``spent``
    [s] when it was reached."""

    time: float
    steps: int
    spent: float


class SlowRun:
    """Use as ``slow = SlowRun(estimate, duration, speed_at)``, ``slow.begin(time, earlier)`` before the first step and
    ``slow.step(time)`` after each; then ``slow.text`` says what takes long, or is "".

    ``estimate``: processor time of the run [s]; ``duration`` [s]; ``speed_at``: of a time [s], the entrainment speed
    [m/s]; ``earlier``: the processor time of the calls that solved it until ``time`` [s].
    """

    def __init__(
        self,
        estimate: float,
        duration: float,
        speed_at: Callable[[float], float],
        *,
        spent: Callable[[], float] = processor_time,
    ):
        self.estimate = estimate
        self.duration = duration
        self._speed_at = speed_at
        self._spent = spent
        self._first = spent()
        self._mark: Mark | None = None
        self._steps = 0

    def begin(self, time: float, earlier: float) -> None:
        """Report that the first step begins at ``time`` [s]."""
        self._first -= earlier
        self._mark = Mark(time, 0, self._spent())

    def step(self, time: float) -> None:
        """Report a step that ended at ``time`` [s]."""
        self._steps += 1
        if self._mark is not None and time >= self._mark.time + LEAST_ADVANCE * self.duration:
            self._mark = Mark(time, self._steps, self._spent())

    @property
    def text(self) -> str:
        """What takes long, at which moment and speed, and what can be done; "" of a run that is not slow."""
        mark = self._mark
        now = self._spent()
        spent = now - self._first
        is_late = spent > max(SLOW_RATIO * self.estimate, LEAST_SECONDS)
        is_stuck = mark is not None and now - mark.spent > max(SLOW_PART * self.estimate, LEAST_SECONDS)
        if not (is_late or is_stuck):
            return ""
        place = "before the first step"
        if mark is not None:
            place = f"at t = {worded(mark.time, 's')}, U = {worded(self._speed_at(mark.time), 'm/s')}"
        if mark is not None and is_stuck:
            place += f", {counted(self._steps - mark.steps, 'steps')} in {in_words(now - mark.spent)}"
        seconds = f"{in_words(spent)} of processor time, estimated {in_words(self.estimate)}"
        return f"slow {place}: {seconds}; it may be stopped: its state is kept, and the same command continues it"
