"""The time left for the parts of a command, from their estimates and from what those that ended took."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from .._base.processor_time import processor_time
from ..studies import in_words

# Time for which a process is taken to do a second of work in a second [s], until twice as much has passed. A choice: a
# smaller value makes the first estimates jump.
USUAL_SECONDS = 5.0

# Time over which the pace of the processor is measured, at least [s]; at most twice as much where the time left is
# stated often. A choice: a mean over all of a command told 57 s as 33 s after other programs had begun; a smaller value
# makes the time left jump.
PACE_SECONDS = 30.0

# Processor time [s] that a process has spent at least, for the rate at which it does. A choice: it divides.
LEAST_WORK = 1e-3

# Time left below which no number is stated [s]. A choice.
LEAST_STATED = 0.1

# Points as estimated after which the measured ratio alone counts. A choice: fewer make the time left jump.
POINTS_OF_PACE = 2.0

# Time that a part still needs which takes longer than estimated, over the time that it has taken [-]. Four of five
# estimates are within a factor of 3: if their logarithms are normal, the median is 0.8 of a part that has taken its
# estimate, and 0.2 of one that has taken ten times as much.
LEFT_OF_LATE = 0.4


class Reading(NamedTuple):
    """The clock [s], and what was ``spent`` [s] until then (`TimeLeft`)."""

    clock: float
    spent: float


class TimeLeft:
    """Use as ``left = TimeLeft(expected, processes)``, then ``left.end(point)`` when a point ends, and
    ``left.seconds``.

    ``expected``: the estimated processor seconds of each point, in the order in which they are solved; ``processes``:
    that solve them. What points take is the processor time of one process, whose ratio to the time that passes is
    measured over the last `PACE_SECONDS`; of several it is the time that passes. The ratio of what the points that ended took to their estimates
    corrects the estimates of the others; until `POINTS_OF_PACE` ended, one more counts that takes what is estimated,
    ``usual`` [s] long (None: as the mean of all).
    Those that are being solved raise it when they take more, and then need `LEFT_OF_LATE` of what they took, which
    raises it too.
    """

    def __init__(
        self,
        expected: Mapping[Any, float],
        processes: int = 1,
        *,
        usual: float | None = None,
        clock: Callable[[], float] = time.monotonic,
        spent: Callable[[], float] = processor_time,
    ):
        self.expected: dict[Any, float] = dict(expected)
        self.processes = processes
        self._clock = clock
        self._spent = spent if processes == 1 else clock
        self._reading = Reading(clock(), self._spent())  # the last one
        self._earlier_reading = self._reading  # from which on the pace is measured
        self._begun: dict[Any, float] = {}  # when each point began that is being solved [s], by `_spent`
        self._taken = 0.0  # s, of the points that ended
        self._estimated = 0.0  # s, of the same
        mean = sum(self.expected.values()) / max(len(self.expected), 1)
        self._usual = mean if usual is None else usual  # s, of a point that is as estimated
        self._lock = threading.RLock()  # a line of progress is drawn on a thread of its own
        self._begin()

    def end(self, point: Any) -> None:
        """Report that a ``point`` ended."""
        with self._lock:
            if point not in self.expected:
                return
            self._estimated += self.expected.pop(point)
            if point not in self._begun:  # the order is another one: it began in place of the last that began
                point = next(reversed(self._begun))
            self._taken += self._spent() - self._begun.pop(point)
            self._begin()

    def omit(self, point: Any) -> None:
        """Report that a ``point`` is known, and takes no time."""
        with self._lock:
            self.expected.pop(point, None)
            self._begun.pop(point, None)
            self._begin()

    def end_next(self) -> None:
        """Report that the next point ended, where it is not known which one."""
        if self.expected:
            self.end(next(iter(self.expected)))

    def _begin(self) -> None:
        """Let each process that is free begin the next point."""
        for point in self.expected:
            if len(self._begun) >= self.processes:
                return
            self._begun.setdefault(point, self._spent())

    @property
    def seconds(self) -> float:
        """The time left [s], by the estimates and by what the points took so far."""
        with self._lock:
            return self._seconds()

    def _seconds(self) -> float:
        """Return `seconds`; call it with the lock."""
        now = self._spent()
        solving = {point: now - begun for point, begun in self._begun.items()}
        usual = _weight_of_usual(self._estimated, self._usual)
        ratio = _ratio(self._taken + usual, self._estimated + usual)
        estimated = self._estimated + sum(self.expected[point] for point in solving)
        in_all = [
            taken * (1.0 + LEFT_OF_LATE) if taken > self.expected[point] else taken for point, taken in solving.items()
        ]
        slower = _ratio(self._taken + sum(in_all) + usual, estimated + usual)
        ratio = max(ratio, slower)
        undone = [
            LEFT_OF_LATE * taken if taken > ratio * self.expected[point] else ratio * self.expected[point] - taken
            for point, taken in solving.items()
        ]
        waiting = ratio * sum(seconds for point, seconds in self.expected.items() if point not in solving)
        left = max((sum(undone) + waiting) / self.processes, *undone, 0.0)
        if self.processes > 1:
            return left
        return left * self._seconds_of_work(Reading(self._clock(), now))

    def _seconds_of_work(self, now: Reading) -> float:
        """Return the time that passes in a second of processor time, over the last `PACE_SECONDS` until ``now``."""
        if now.clock - self._reading.clock >= PACE_SECONDS:
            self._earlier_reading = self._reading
            self._reading = now
        passed = now.clock - self._earlier_reading.clock
        usual = _weight_of_usual(passed, USUAL_SECONDS)
        return (passed + usual) / max(now.spent - self._earlier_reading.spent + usual, LEAST_WORK)

    def in_words(self, more: float = 0.0) -> str:
        """Return the time left and ``more`` [s] as text to be appended; "" where nothing is left."""
        if not self.expected:
            return ""
        left = self.seconds + more
        return (
            f", about {in_words(left)} left" if left >= LEAST_STATED else f", less than {in_words(LEAST_STATED)} left"
        )


def _weight_of_usual(known: float, usual: float) -> float:
    """Return how much [s] of a ``usual`` time, as estimated, counts beside a ``known`` one: all of it until as much is
    known, none from `POINTS_OF_PACE` times as much."""
    return min(max(POINTS_OF_PACE * usual - known, 0.0), usual)


def _ratio(taken: float, estimated: float) -> float:
    """Return the ratio of two times [s]; 1 where nothing is estimated."""
    return taken / estimated if estimated > 0 else 1.0
