"""What is kept of a chain of points while it is solved: each finished point at once, and the start of the next."""

from __future__ import annotations

import json
from pathlib import Path

from .. import errors
from ..errors import ConvergenceError, LubfricError
from ..report import Report
from ..steady import FrictionResult
from ..store import Records, decode, encode, read_checked, write_checked
from ..store.codec import from_plain, to_plain

POINTS, STATES, FIELDS = "points", "states", "fields"


class Journal:
    """The folder of a store, as one process writes it.

    A point is first put whole into the state of its chain, and then, by one line, into the records. Whatever moment a kill
    strikes, the state is that of the last record or one point ahead of it, and then holds the record that is missing.
    """

    def __init__(self, folder):
        self.folder = Path(folder)
        self.records = Records(self.folder / POINTS)

    def keep(self, chain: str, key: str, outcome, fields: bool = False) -> None:
        """Keep the ``outcome`` (result or error) of point ``key`` of a chain; with ``fields``, its balance too."""
        state = encode({"key": key, "outcome": _storable(outcome)})
        if fields:
            write_checked(self._path(FIELDS, key), state)
        write_checked(self._path(STATES, chain), state, sync=False)
        self.records.add(key, record_of(outcome))

    def state(self, chain: str) -> tuple[str, object]:
        """(key, outcome) of the last point of a chain; ("", None) where there is none that is whole."""
        return self._read(self._path(STATES, chain))

    def fields(self, key: str):
        """The result of point ``key`` with its balance, or None."""
        return self._read(self._path(FIELDS, key))[1]

    def end(self, chain: str) -> None:
        """The chain is complete: its state is not needed any more."""
        self._path(STATES, chain).unlink(missing_ok=True)

    def close(self) -> None:
        """Close the file of the records."""
        self.records.close()

    def _path(self, kind: str, name: str) -> Path:
        return self.folder / kind / f"{name[:32]}.bin"

    def _read(self, path: Path):
        content = read_checked(path) if path.is_file() else None
        if content is None:
            return "", None
        found = decode(content)
        return found["key"], _outcome(found["outcome"])


def record_of(outcome) -> dict:
    """The record of a point, in plain JSON types: all numbers of its result but the fields, or its error."""
    if isinstance(outcome, Exception):
        return {"error": _error(outcome)}
    plain = to_plain(_without_fields(outcome))
    return json.loads(json.dumps(plain))


def outcome_of(record: dict):
    """The `FrictionResult` (without fields) or the exception that `record_of` was given."""
    return _outcome(record) if "error" in record else from_plain(record)


def _without_fields(result: FrictionResult) -> FrictionResult:
    from dataclasses import replace

    return replace(result, balance=None)


def _storable(outcome):
    return {"error": _error(outcome)} if isinstance(outcome, Exception) else outcome


def _error(error: Exception) -> dict:
    report = getattr(error, "report", None)
    plain = to_plain(report) if isinstance(report, Report) else None
    return {"type": type(error).__name__, "message": str(error), "report": json.dumps(plain)}


def _outcome(value):
    if not isinstance(value, dict):
        return value
    error = value["error"]
    kind = getattr(errors, error["type"], LubfricError)
    if issubclass(kind, ConvergenceError):
        return kind(error["message"], from_plain(json.loads(error["report"])))
    return kind(error["message"])
