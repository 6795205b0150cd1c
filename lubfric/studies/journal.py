"""The points on disk while a study is solved: each finished one at once, with all that its neighbours start from."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

from .._base import read_checked, validate, write_checked, write_whole
from ..errors import ConvergenceError, InputError, LubfricError, Report, ValidityError
from ..sampling import FrictionResult
from ..sharing import Validity
from .codec import decode, encode, from_plain, to_plain
from .records import Records

POINTS, STATES, FIELDS = "points", "states", "fields"
SPEED = "speed"  # in a record


class Point(NamedTuple):
    """A point that has ended: its speed [m/s] and its `FrictionResult` or error. Without an outcome it marks the end of
    a walk that chose its speeds."""

    key: str
    speed: float = math.nan
    outcome: object = None

    @property
    def record(self) -> dict:
        """Plain JSON types: all numbers of the result but the fields, or the error and the speed."""
        if self.outcome is None:
            return {}
        found = record_of(self.outcome)
        lacks_speed = isinstance(self.outcome, Exception) and not math.isnan(self.speed)
        return found | {SPEED: self.speed} if lacks_speed else found


@dataclass(frozen=True)
class Failure:
    """A point without an answer, as it is stored. ``error``: the name of its exception; the other fields are the
    exception's."""

    error: str
    message: str
    report: Report | None = None
    entries: tuple[Validity, ...] = ()
    result: FrictionResult | None = None


class Journal:
    """The folder of a store, as one process writes it. Without a folder (`NOWHERE`) nothing is saved and nothing found.

    A point is first written whole to a file of its own, its state, and then as one line to the records. So after a kill
    at any moment each state has its record, except at most the last, which is the point whose record is missing.
    """

    def __init__(self, folder):
        self.folder = None if folder is None else validate.folder("store", folder)
        self._records = None if self.folder is None else Records(self.folder / POINTS)

    def __enter__(self) -> Journal:
        return self

    def __exit__(self, *_) -> None:
        if self._records is not None:
            self._records.close()

    def records(self) -> dict[str, dict]:
        """Every undamaged record by key."""
        return {} if self._records is None else dict(self._records.read())

    def point(self, key: str, records: dict[str, dict], wanted) -> Point | None:
        """The point ``key`` from ``records``, with its fields if its speed is ``wanted``; None if it is not
        complete."""
        record = records.get(key)
        if record is None:
            return None
        outcome = outcome_of(record)
        if not isinstance(outcome, FrictionResult):
            return Point(key, record.get(SPEED, math.nan), outcome)
        if outcome.speed in wanted:
            outcome = self._read(FIELDS, key)
        return None if outcome is None else Point(key, outcome.speed, outcome)

    def add(self, point: Point) -> Point:
        """Add the record of a point, and return it."""
        if self._records is not None:
            self._records.add(point.key, point.record)
        return point

    def keep(self, key: str, speed: float, outcome, fields: bool = False) -> Point:
        """Save an ``outcome`` with all that a neighbour starts from. Returns the point without that. With ``fields``,
        these are saved too, and stay in the point."""
        if self.folder is not None:
            state = encode(_storable(outcome))
            if fields:
                write_checked(self._path(FIELDS, key), *state)
            write_checked(self._path(STATES, key), *state, sync=False)
        return self.add(Point(key, speed, outcome if fields else without_fields(outcome)))

    def state(self, key: str):
        """The outcome of point ``key`` with all that a neighbour starts from, or None if no complete one is there."""
        return self._read(STATES, key)

    def end(self, keys: Iterable[str]) -> None:
        """Remove the states of points from which no other point will start."""
        if self.folder is not None:
            for key in keys:
                self._path(STATES, key).unlink(missing_ok=True)

    def begin(self, name: str) -> bool:
        """Mark a piece of work as begun. Returns whether it was begun before and not finished."""
        if self.folder is None:
            return False
        path = self._path(STATES, name, "begun")
        before = path.is_file()
        write_whole(path, b"", sync=False)
        return before

    def finish(self, name: str) -> None:
        """Remove the mark of `begin`."""
        if self.folder is not None:
            self._path(STATES, name, "begun").unlink(missing_ok=True)

    def _path(self, kind: str, name: str, suffix: str = "bin") -> Path:
        return Path(self.folder or "") / kind / f"{name[:32]}.{suffix}"

    def _read(self, kind: str, key: str):
        path = self._path(kind, key)
        content = None if self.folder is None or not path.is_file() else read_checked(path)
        if content is None:
            return None
        try:
            return _outcome(decode(content))
        except ValueError:  # of another version: solved again
            return None


NOWHERE = Journal(None)


def record_of(outcome) -> dict:
    """The record of a point, in plain JSON types: all numbers of its result but the fields, or its error."""
    return to_plain(_storable(without_fields(outcome)))


def outcome_of(record: dict):
    """The `FrictionResult` (without fields) or the exception that `record_of` was given."""
    return _outcome(from_plain(record))


def without_fields(outcome):
    """A result without its fields, or a refusal whose result has none. Any other outcome stays as it is."""
    if isinstance(outcome, FrictionResult):
        return outcome.without_fields()
    if isinstance(outcome, ValidityError) and outcome.result is not None:
        return ValidityError(outcome.message, outcome.entries, outcome.result.without_fields())
    return outcome


def bare(result: FrictionResult) -> FrictionResult:
    """A result without what a neighbour that starts from it can compute again
    (`lubfric.sampling.line_friction.LineStart`)."""
    return result if result.line is None else replace(result, line=result.line.bare())


def _storable(outcome):
    """A result as it is, an exception as a `Failure`."""
    if not isinstance(outcome, Exception):
        return bare(outcome)
    if isinstance(outcome, ValidityError):
        result = None if outcome.result is None else bare(outcome.result)
        return Failure("ValidityError", outcome.message, None, tuple(outcome.entries), result)
    report = outcome.report if isinstance(outcome, ConvergenceError) else None
    return Failure(type(outcome).__name__, str(outcome), report)


def _outcome(stored):
    if not isinstance(stored, Failure):
        return stored
    if stored.error == "ValidityError":
        return ValidityError(stored.message, stored.entries, stored.result)
    if stored.error == "ConvergenceError":
        return ConvergenceError(stored.message, stored.report)
    return {"InputError": InputError}.get(stored.error, LubfricError)(stored.message)
