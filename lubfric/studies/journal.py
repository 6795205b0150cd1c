"""What is kept on disk of a chain of points while it is solved: each finished point at once, and the start of the
next."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from ..errors import ConvergenceError, InputError, LubfricError, ValidityError
from ..report import Report
from ..result import FrictionResult
from ..store import Records, decode, encode, read_checked, write_checked, write_whole
from ..store.codec import from_plain, to_plain
from ..validity.entry import Validity

POINTS, STATES, FIELDS = "points", "states", "fields"
PLACE = "place"  # in a record


@dataclass(frozen=True)
class Failure:
    """A point without an answer, as it is stored. ``error``: the name of its exception. The other fields are those
    of it."""

    error: str
    message: str
    report: Report | None = None
    entries: tuple[Validity, ...] = ()
    result: FrictionResult | None = None


class Journal:
    """The folder of a store, as one process writes it; without a folder (`NOWHERE`) nothing is kept, and nothing found.

    A point is first put whole into the state of its chain, then as one line into the records. So a kill at any moment
    leaves a state that belongs to the last record, or is one point ahead of it. In the second case the state holds the
    record that is missing.
    """

    def __init__(self, folder):
        self.folder = None if folder is None else Path(folder)
        self._records = None if folder is None else Records(Path(folder) / POINTS)

    def __enter__(self) -> Journal:
        return self

    def __exit__(self, *_) -> None:
        if self._records is not None:
            self._records.close()

    def records(self) -> dict[str, dict]:
        """Every whole record by key."""
        return {} if self._records is None else dict(self._records.read())

    def add(self, key: str, record: dict) -> None:
        """Add one record, as `record_of` makes it."""
        if self._records is not None:
            self._records.add(key, record)

    def keep(self, chain: str, key: str, outcome, fields: bool = False, place: dict | None = None) -> None:
        """Keep the ``outcome`` (result or error) of point ``key`` of a chain; with ``fields``, its balance too.

        ``place``: for a point whose speed was chosen on the way, its curve, its place on it and its speed [m/s]. It is
        put into the record.
        """
        if self.folder is None:
            return
        state = encode({"key": key, "outcome": _storable(outcome)})
        if fields:
            write_checked(self._path(FIELDS, key), *state)
        write_checked(self._path(STATES, chain), *state, sync=False)
        record = record_of(outcome)
        self.add(key, record if place is None else record | {PLACE: place})

    def state(self, chain: str) -> tuple[str, object]:
        """(key, outcome) of the last point of a chain, or ("", None) where no whole one is kept."""
        return self._read(STATES, chain)

    def fields(self, key: str):
        """The result of point ``key`` with its balance, or None."""
        return self._read(FIELDS, key)[1]

    def end(self, chain: str) -> None:
        """Remove the state of a chain that is complete."""
        if self.folder is not None:
            self._path(STATES, chain).unlink(missing_ok=True)

    def begin(self, name: str) -> bool:
        """Mark a piece of work as begun. Returns whether it was begun before and not finished."""
        if self.folder is None:
            return False
        path = self._path(STATES, name, "begun")
        before = path.is_file()
        write_whole(path, b"", sync=False)
        return before

    def finish(self, name: str) -> None:
        """Take the mark of `begin` away."""
        if self.folder is not None:
            self._path(STATES, name, "begun").unlink(missing_ok=True)

    def _path(self, kind: str, name: str, suffix: str = "bin") -> Path:
        return Path(self.folder or "") / kind / f"{name[:32]}.{suffix}"

    def _read(self, kind: str, name: str):
        path = self._path(kind, name)
        content = None if self.folder is None or not path.is_file() else read_checked(path)
        if content is None:
            return "", None
        try:
            found = decode(content)
        except ValueError:  # of another version: solved again
            return "", None
        return found["key"], _outcome(found["outcome"])


NOWHERE = Journal(None)


def record_of(outcome) -> dict:
    """The record of a point, in plain JSON types: all numbers of its result but the fields, or its error."""
    return to_plain(_storable(without_fields(outcome)))


def outcome_of(record: dict):
    """The `FrictionResult` (without fields) or the exception that `record_of` was given."""
    return _outcome(from_plain(record))


def without_fields(outcome):
    """A result without its fields. The same for the result that a refusal carries. Any other outcome stays as it is."""
    if isinstance(outcome, FrictionResult):
        return outcome.without_fields()
    if isinstance(outcome, ValidityError) and outcome.result is not None:
        return ValidityError(outcome.message, outcome.entries, outcome.result.without_fields())
    return outcome


def bare(result: FrictionResult) -> FrictionResult:
    """A result without what a neighbour that starts from it can make again
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
