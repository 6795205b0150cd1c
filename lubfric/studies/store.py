"""The store: records in a folder, each in a file of its own by the hash of all that it depends on. Points of curves,
studies and runs of the command line, and states of runs in time, are kept in it."""

import hashlib
import os
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .._base import LOCK, FolderLock, clear_checked, clear_parts, files, read_checked, validate, write_checked
from ..errors import ConvergenceError, InputError, LubfricError, OutputError, Report, ValidityError
from ..estimate import FrictionResult
from ..film import EHLResult
from ..models.shared import Violation
from ..scene import Scene
from .arithmetic import arithmetic
from .codec import classes_of, decode, encode
from .store_contract import RecordStore
from .vary import Axis

POINTS = "points"
FILE = ("Roughness", "file")  # the field of a scene that names a map
# Fields on which no number depends.
LABELS = {
    ("Scene", "name"),
    ("Scene", "doubtful"),
    ("Surface", "source"),
    ("Surface", "notes"),
    ("Motion", "speeds"),
}


@dataclass(frozen=True, kw_only=True)
class Failure:
    """A point without an answer, as it is stored: the name of its exception, and what that holds."""

    error: str
    message: str
    report: Report | None = None
    violations: tuple[Violation, ...] = ()
    result: FrictionResult | None = None


STORED_CLASSES = classes_of(FrictionResult, EHLResult, Failure, Scene, Axis)
ERRORS = {kind.__name__: kind for kind in (InputError, ConvergenceError, ValidityError)}
OUTCOME = FrictionResult | Failure  # what is stored of a point
# What is stored of the plan of a study: scene, axes, speeds [m/s], keys, and speeds, coordinates and notes of operating
# points.
PLAN = "plan"  # key of the plan of a study
PLANNED = tuple[
    Scene,
    tuple[Axis, ...],
    tuple[float, ...],
    tuple[str, ...],
    tuple[float, ...],
    dict[str, tuple[float, ...]],
    tuple[str, ...],
    str,
]
CHOSEN = tuple[tuple[float, ...], bool]  # the same of a curve: its speeds [m/s] so far, and whether these are all


class Store(RecordStore):
    """Records by key in the folder ``root``; without one (None) nothing is kept and nothing found. ``classes``: those
    that a record may hold.

    A record is a complete file with a checksum, which appears at once when it is complete. So any number of processes
    may add, and what was added outlives every failure of them. A record that was cut off or overwritten counts as
    absent, and so does one that was renamed, because it begins with its key.
    """

    def __init__(self, root: str | Path | None, classes: dict[str, type] = STORED_CLASSES):
        self.root = root
        self.classes = classes
        self.folder = None if root is None else Path(root) / POINTS
        self.faults: list[str] = []
        self.gathers_faults = False

    @contextmanager
    def one_warning(self) -> Iterator[None]:
        """Report all records inside that do not count in one `UserWarning`, of the first of them, with their number."""
        self.gathers_faults = True
        try:
            yield
        finally:
            self.gathers_faults = False
            others = len(self.faults) - 1
            if self.faults:
                more = f", as {others} other{'s' if others > 1 else ''} in that folder," if others else ""
                solve = "their points are" if others else "its point is"
                warnings.warn(f"{self.faults[0]}{more} and is not used: {solve} solved again", stacklevel=3)
            self.faults.clear()

    def add(self, key: str, outcome: Any, *, sync: bool = False) -> None:
        """Keep a dataclass of the ``classes``, a `LubfricError`, or a tuple of these and of numbers; ``sync``: it also
        outlives a loss of power. Raises `OutputError` when that fails."""
        if self.folder is not None:
            stored = _failure(outcome) if isinstance(outcome, LubfricError) else outcome
            write_checked(self._path(key), _name(key), *encode(stored), sync=sync)

    def get(self, key: str, kind: Any = Any) -> Any:
        """Return what was added under ``key``, of the type ``kind``; None for what is absent. A record that cannot be
        read, is damaged, or of another version, counts as absent; a `UserWarning` reports it."""
        if self.folder is None or not os.path.lexists(self._path(key)):
            return None
        fault = "is damaged"
        try:
            content = read_checked(self._path(key)) if self._path(key).is_file() else None
            if not (content or b"").startswith(_name(key)):
                raise ValueError("cut off, overwritten, or the record of another key")
            fault = "was written by another version of lubfric"
            record = decode((content or b"")[len(_name(key)) :], self.classes, kind)
        except (ValueError, OutputError):
            self.faults.append(f"{self._path(key)} {fault}")
            if not self.gathers_faults:
                warnings.warn(f"{self.faults.pop()} and is not used: its point is solved again", stacklevel=2)
            return None
        return _error(record) if isinstance(record, Failure) else record

    @property
    def empty(self) -> bool:
        """Whether there is no record at all."""
        return self.folder is None or not self.folder.is_dir()

    @property
    def count(self) -> int:
        """Number of records, sound or not."""
        return 0 if self.folder is None or not self.folder.is_dir() else sum(1 for _ in self.folder.glob("*.bin"))

    def has(self, key: str) -> bool:
        """Return whether there is a record of ``key``, sound or not."""
        return self.folder is not None and os.path.lexists(self._path(key))

    def known(self, keys: Iterable[str], kind: Any = Any) -> dict[str, Any]:
        """Return all sound records of ``keys``."""
        records = {key: self.get(key, kind) for key in keys} if self.folder is not None and self.folder.is_dir() else {}
        return {key: outcome for key, outcome in records.items() if outcome is not None}

    def clear(self, keys: Iterable[str] = ("*",)) -> None:
        """Remove the records of ``keys`` (default: all), what killed writers left, and the folders that are empty
        then."""
        if self.folder is not None:
            clear_checked(self.folder, *(self._path(key).name for key in keys))
            clear_checked(self.folder.parent)

    def _path(self, key: str) -> Path:
        return (self.folder or Path()) / f"{key[:40]}.bin"


@contextmanager
def opened(
    folder: str | Path | None, classes: dict[str, type] = STORED_CLASSES, name: str = "store"
) -> Iterator[Store]:
    """Yield the `Store` in ``folder`` (None: none), which one caller at a time may fill. Raises `InputError` for a
    second. ``name``: of the argument that gives the folder."""
    if folder is None:
        yield Store(None)
        return
    folder = validate.folder(name, folder)
    with FolderLock(folder):
        clear_parts(folder)
        clear_parts(folder / POINTS)
        yield Store(os.path.abspath(folder), classes)


def _name(key: str) -> bytes:
    """Return the first line of the record of ``key``."""
    return key.encode() + b"\n"


def is_shared(folder: str | Path | None) -> bool:
    """Return whether this process sees the ``folder`` of a store that another one has `opened`. A worker on another
    machine may not; then the process that planned the work keeps what comes back."""
    return folder is not None and os.path.exists(os.path.join(folder, LOCK))


def point_key(scene_key: str, speed: float, *, fields: bool | str = False) -> str:
    """Return the key of a point: of its scene (`fingerprint`), its speed [m/s], and the fields that are kept, as
    `lubfric.friction` takes them."""
    return digest([scene_key, float(speed), fields])


def _failure(error: LubfricError) -> Failure:
    if isinstance(error, ValidityError):
        return Failure(
            error="ValidityError",
            message=error.message,
            report=None,
            violations=tuple(error.violations),
            result=error.result,
        )
    return Failure(error=type(error).__name__, message=str(error), report=getattr(error, "report", None))


def _error(stored: Failure) -> LubfricError:
    kind = ERRORS.get(stored.error, LubfricError)
    if kind is ValidityError:
        return ValidityError(stored.message, stored.violations, stored.result)
    return ConvergenceError(stored.message, stored.report) if kind is ConvergenceError else kind(stored.message)


def fingerprint(*parts: Any) -> str:
    """Return the SHA-256, hexadecimal, of ``parts`` and of all else that their numbers depend on (`arithmetic`).

    Parts are numbers, texts, arrays, dataclasses and collections of these. Of a scene everything counts except its
    name, the provenance of its map and the list of speeds. A height map counts by its heights and spacing, a file by
    its bytes at this moment and not by its path.
    """
    return digest([*arithmetic(), *parts])


def fingerprint_without_files(*parts: Any) -> str:
    """Return the `fingerprint` of ``parts`` among which are the heights that were read: files of maps do not count, as
    they may have changed since."""
    return _digest([*arithmetic(), *parts], _counted_without_files)


def digest(value: Any) -> str:
    """Return the SHA-256, hexadecimal, of a value: equal for equal numbers, to the last bit, in every process."""
    return _digest(value, _counted)


def _digest(value: Any, counted: Callable[..., Any]) -> str:
    hashed = hashlib.sha256()
    for piece in encode(value, counted):
        hashed.update(piece)
    return hashed.hexdigest()


def _counted(part: Any, name: str) -> Any:
    """Return what of the field ``name`` of a dataclass a number depends on."""
    value = getattr(part, name)
    if (type(part).__name__, name) in LABELS:
        return None
    if (type(part).__name__, name) == FILE and value is not None:
        return files.checksum_of_file(value)
    return value


def _counted_without_files(part: Any, name: str) -> Any:
    return None if (type(part).__name__, name) == FILE else _counted(part, name)
