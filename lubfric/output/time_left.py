"""The time left for the points of a study, from their estimates and from the work that is counted inside the point that is being
solved."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import Any

from .._base import counted_work

# Time for which a process is taken to do a second of work in a second [s]. A choice: less makes the first estimates jump.
USUAL_SECONDS = 5.0

# What is left of a point that takes longer than its estimate, over what is done of it [-]. A choice: what is not known is stated as
# some time, and not as none.
LEAST_UNDONE = 0.1


class TimeLeft:
    """Use as ``left = TimeLeft(expected, processes)``, then ``left.end(point)`` when a point ends, and ``left.seconds``.

    ``expected``: the estimated processor seconds of each point, in the order in which they are solved; ``processes``: that solve them. Of one
    process the counted work says how far its point is; of several the time since a point ended. The ratio of counted to
    estimated work of the points that ended, and of one more that is as estimated, corrects the estimates of the others.
    """

    def __init__(
        self,
        expected: Mapping[Any, float],
        processes: int = 1,
        *,
        clock: Callable[[], float] = time.monotonic,
        counted: Callable[[], float] = counted_work,
    ):
        self.expected: dict[Any, float] = dict(expected)
        self.processes = processes
        self._clock = clock
        self._counted = counted
        self._begun = clock()
        self._last = self._begun  # when a point ended
        self._first_work = counted()
        self._last_work = self._first_work  # counted until then
        self._ended = 0.0  # s, estimated, of the points that ended
        self._usual = sum(self.expected.values()) / max(len(self.expected), 1)  # s, of a point that is as estimated

    def end(self, point: Any) -> None:
        """Report that a ``point`` ended."""
        estimate = self.expected.pop(point, None)
        if estimate is not None:
            self._ended += estimate
            self._last = self._clock()
            self._last_work = self._counted()

    def omit(self, point: Any) -> None:
        """Report that a ``point`` is known, and takes no time."""
        self.expected.pop(point, None)

    def end_next(self) -> None:
        """Report that the next point ended, where it is not known which one."""
        if self.expected:
            self.end(next(iter(self.expected)))

    @property
    def seconds(self) -> float:
        """The time left [s]; 0 where nothing is left."""
        estimates = list(self.expected.values())
        if not estimates:
            return 0.0
        if self.processes > 1:
            usual = self.processes * USUAL_SECONDS
            rate = (self._ended + usual) / (self._last - self._begun + USUAL_SECONDS)
            waited = self._clock() - self._last
            return max(sum(estimates) / rate - waited, LEAST_UNDONE * waited)
        ended = self._last_work - self._first_work
        ratio = (ended + self._usual) / (self._ended + self._usual) if self._ended > 0 else 1.0
        done = self._counted() - self._last_work
        of_point = max(ratio * estimates[0] - done, LEAST_UNDONE * done)
        work = self._counted() - self._first_work
        rate = (work + USUAL_SECONDS) / (self._clock() - self._begun + USUAL_SECONDS)
        return (of_point + ratio * sum(estimates[1:])) / rate
