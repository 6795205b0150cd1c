"""The points of a walk, solved or taken over from an interrupted run, to the same bits."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from multiprocessing import parent_process

from ..errors import LubfricError, ValidityError
from ..sampling import FrictionResult, friction
from ..sharing import Prepared, prepare
from .adaptive import begin_with, choose
from .journal import NOWHERE, Journal, Point
from .walk import Batch, Walk


def points_of(batch: Batch) -> Iterator[Point]:
    """Yield every point of a batch as it ends, when it is in the store. A walk that chose its speeds ends with a point
    without outcome.

    If a scene cannot be made ready, that is the error of all points of its walk.
    """
    leader = batch.prepared
    with Journal(batch.folder) as journal:
        known = journal.records() if journal.begin(batch.name) else batch.known  # what a lost worker had finished
        for walk in batch.walks:
            if walk.ended(batch.known):
                continue
            try:
                leader = leader or prepare(batch.leader)
                prepared = leader if walk.scene == leader.scene else prepare(walk.scene, like=leader)
                points = Trail(prepared, walk, journal, known, batch.before).points()
            except LubfricError as error:
                points = _failed(walk, error, journal, known)
            yield from points
            if not walk.speeds:
                end = Point(walk.marks[0])
                yield end if end.key in known else journal.add(end)
            journal.end(walk.keys)


def first_point(batch: Batch) -> Iterator[tuple[Point, object]]:
    """Yield the first point of a batch, and its outcome with all that others start from."""
    with Journal(batch.folder) as journal:
        trail = Trail(batch.prepared or prepare(batch.leader), batch.walks[0], journal, batch.known)
        yield next(trail.points()), trail.whole(0)


def _failed(walk: Walk, error: LubfricError, journal: Journal, known: dict) -> Iterator[Point]:
    for key, speed in zip(walk.keys, walk.speeds or (math.nan,)):
        yield journal.point(key, known, ()) or journal.add(Point(key, speed, error))


class Trail:
    """The points of a walk so far: ``speeds`` [m/s] and ``outcomes``, which have fields only if these are wanted.

    ``known``: records that the ``journal`` has, by key; ``before``: the outcome from which the first point starts.
    Raises `InputError` if there is no range from which to choose speeds.
    """

    def __init__(self, prepared: Prepared, walk: Walk, journal: Journal = NOWHERE, known=None, before=None):
        self.speeds: list[float] = []
        self.outcomes: list = []
        self._prepared, self._walk, self._journal = prepared, walk, journal
        self._known, self._before = known or {}, before
        self._ahead = [] if walk.speeds else begin_with(prepared, walk.wanted)
        self._whole: dict[int, object] = {}  # outcomes with all that a neighbour starts from

    def points(self) -> Iterator[Point]:
        """Yield the points. A point that fails leaves its error, and points that would start from it begin cold. Every
        exception but a `LubfricError` is an error of the program and is raised."""
        walk, journal, parent = self._walk, self._journal, os.getppid()
        for at, key in enumerate(walk.keys):
            point = journal.point(key, self._known, walk.wanted)
            if point is not None:
                self.speeds.append(point.speed)
            else:
                speed = walk.speeds[at] if walk.speeds else self._choice()
                if speed is None:
                    return
                self.speeds.append(speed)
                whole = self.whole(at)
                if parent_process() is not None and os.getppid() != parent:
                    raise SystemExit(1)  # who asked for it is dead, and may have been started again
                point = journal.keep(key, speed, whole, speed in walk.wanted)
                if walk.speeds:
                    journal.end(walk.keys[:at][-1:])  # no other point starts from it
            self.outcomes.append(point.outcome)
            yield point

    def whole(self, at: int):
        """Outcome number ``at`` with all that a neighbour starts from: remembered, read, or solved again."""
        if at not in self._whole:
            found = self._journal.state(self._walk.keys[at])
            if found is None:
                found = self._solved(self.speeds[at], self._start(at))
            if self._walk.speeds:
                self._whole.clear()
            self._whole[at] = found
        return self._whole[at]

    def _start(self, at: int):
        """The outcome from which point ``at`` starts: the one before it or, of chosen speeds, the nearest so far."""
        if at == 0:
            return self._before
        if self._walk.speeds:
            return self.whole(at - 1)
        return self.whole(min(range(at), key=lambda i: abs(math.log(self.speeds[i] / self.speeds[at]))))

    def _solved(self, speed: float, neighbour):
        result = neighbour.result if isinstance(neighbour, ValidityError) else neighbour  # refused or not
        start = result if isinstance(result, FrictionResult) and result.starts else None
        try:
            return friction(self._prepared, speed, start=start, fields=speed in self._walk.wanted)
        except LubfricError as error:
            return error

    def _choice(self) -> float | None:
        ahead = [speed for speed in self._ahead if speed not in self.speeds]
        return ahead[0] if ahead else choose(self._prepared, self.speeds, self.outcomes)
