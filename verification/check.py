"""What a part of the verification hands back: checks, tables, figures and fields. All are plain frozen data."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import KW_ONLY, asdict, dataclass, field, fields

import numpy as np

from .types import PlainRow, TableRow

LEVELS = ("quick", "default", "full")
RELATIVE = "relative"
ABSOLUTE = "absolute"
AT_MOST = "at_most"
AT_LEAST = "at_least"
REPORTED = "reported"
KINDS = (RELATIVE, ABSOLUTE, AT_MOST, AT_LEAST, REPORTED)
CAUSES = ("ours", "theirs", "both", "unknown")
GRADES = {
    "A": "a published number or law",
    "B": "structure: conservation, symmetry, limits, order of convergence",
    "C": "the second program of the same authors",
}


@dataclass(frozen=True, kw_only=True)
class ListedDeviation:
    """A deviation that is known: its check does not pass, and the run does not fail by it.

    cause : who deviates, one of `CAUSES`
    reason : why, as a sentence for the report
    low, high : band of the measured value, in the unit of its check; outside it the check fails
    """

    cause: str
    reason: str
    low: float
    high: float

    def __post_init__(self) -> None:
        if self.cause not in CAUSES:
            raise ValueError(f"cause = {self.cause!r}; allowed: {', '.join(CAUSES)}")
        if not self.reason.strip() or not (math.isfinite(self.low) and math.isfinite(self.high)):
            raise ValueError(f"a listed deviation needs a reason and a finite band: {self}")
        if not self.low <= self.high:
            raise ValueError(f"low = {self.low}, high = {self.high}; allowed: low <= high")


def listed_near(value: float, cause: str, reason: str, within: float = 0.01) -> ListedDeviation:
    """Return the listed deviation whose measured value is ``value`` within a fraction ``within`` of it."""
    half = abs(within * value)
    return ListedDeviation(cause=cause, reason=reason, low=value - half, high=value + half)


@dataclass(frozen=True)
class Check:
    """One measured number and the number that it is compared with. All commands use this record.

    ``kind`` says what passes:

    - "relative": ``|measured - expected| <= tolerance |expected|`` (``expected`` must not be 0)
    - "absolute": ``|measured - expected| <= tolerance``, tolerance in ``unit``
    - "at_most":  ``measured <= expected + tolerance``, for bounds on errors
    - "at_least": ``measured >= expected - tolerance``, for bounds on convergence orders
    - "reported": any finite number: a time, or an error that a chart shows

    A measured value that is NaN or infinite never passes.

    source : where ``expected`` comes from (closed form, publication, another solver)
    seconds : filled in by the runner for studies that yield their checks one by one
    decisive : False for a check that is only shown; it may fail without the run failing
    refused : message of the method where it gave no number; the number is NaN then
    at : where it was measured (axes of a map, setting and cost of a method, seed of a scene), by name
    grade : origin of the expected value, one of `GRADES`; "": that of its study
    errors : compared with a publication, the 95 % bounds of the measured and of the published value, in ``unit``
    listed : the deviation that is known here, with its reason; the run does not fail while it stays in its band

    Raises
    ------
    ValueError : unknown kind or grade, missing name or source, expected or tolerance not finite, negative tolerance,
        a relative tolerance about zero
    """

    name: str
    measured: float
    expected: float
    tolerance: float
    _: KW_ONLY
    source: str
    kind: str = RELATIVE
    unit: str = "1"
    note: str = ""
    seconds: float | None = None
    decisive: bool = True
    refused: str = ""
    at: PlainRow = field(default_factory=dict)
    grade: str = ""
    errors: Sequence[float] = ()
    listed: ListedDeviation | None = None

    def __post_init__(self) -> None:
        for key in ("measured", "expected", "tolerance"):
            object.__setattr__(self, key, float(getattr(self, key)))
        wrong = ""
        if self.kind not in KINDS:
            wrong = f"kind = {self.kind!r}; allowed: {', '.join(KINDS)}"
        elif self.grade and self.grade not in GRADES:
            wrong = f"grade = {self.grade!r}; allowed: {', '.join(GRADES)}"
        elif not self.name.strip() or not self.source.strip():
            wrong = "a name and a source are needed"
        elif not (math.isfinite(self.expected) and math.isfinite(self.tolerance) and self.tolerance >= 0):
            wrong = f"expected = {self.expected}, tolerance = {self.tolerance}; allowed: finite, tolerance >= 0"
        elif self.kind == RELATIVE and self.expected == 0:
            wrong = "a relative tolerance about 0 means nothing; use 'absolute'"
        if wrong:
            raise ValueError(f"check {self.name!r}: {wrong}")

    @property
    def deviation(self) -> float:
        """The number compared with ``tolerance``: an error, or how far a bound is exceeded."""
        if self.kind == REPORTED:
            return 0.0
        difference = self.measured - self.expected
        if self.kind == RELATIVE:
            return abs(difference / self.expected)
        if self.kind == ABSOLUTE:
            return abs(difference)
        return difference if self.kind == AT_MOST else -difference

    @property
    def passed(self) -> bool:
        """Whether the measured value is finite and within the tolerance."""
        return math.isfinite(self.measured) and self.deviation <= self.tolerance

    @property
    def units(self) -> float:
        """Return the deviation in units of the tolerance; compared with a publication, in units of both errors."""
        if self.tolerance:
            return self.deviation / self.tolerance
        return math.inf if self.deviation else 0.0

    @property
    def deviates_as_listed(self) -> bool:
        """Whether the check does not pass, and its value is in the band of the deviation that is listed for it."""
        listed = self.listed
        return listed is not None and not self.passed and listed.low <= self.measured <= listed.high

    @property
    def no_longer_deviates(self) -> bool:
        """Whether the check passes although a deviation is listed for it: the list is out of date."""
        return self.listed is not None and self.passed

    @property
    def failed(self) -> bool:
        """Whether the run fails by this check."""
        return self.decisive and not self.passed and not self.deviates_as_listed

    def as_dict(self) -> PlainRow:
        """Return plain types only, with the verdict."""
        return asdict(self) | {
            "deviation": self.deviation,
            "passed": self.passed,
            "deviates_as_listed": self.deviates_as_listed,
        }

    @classmethod
    def from_dict(cls, values: PlainRow) -> Check:
        """Return the check whose values `as_dict` gave. What JSON has no word for comes back as NaN."""
        known = {f.name: values[f.name] for f in fields(cls) if f.name in values}
        for name in ("measured", "expected", "tolerance"):
            known[name] = math.nan if known[name] is None else known[name]
        if known.get("listed"):
            known["listed"] = ListedDeviation(**known["listed"])
        return cls(**known)


@dataclass(frozen=True)
class Table:
    """Rows of numbers or text under ``columns``. The report shows them, and report.json stores them."""

    name: str
    caption: str
    columns: Sequence[str]
    rows: Iterable[TableRow]

    def __post_init__(self) -> None:
        object.__setattr__(self, "columns", tuple(self.columns))
        object.__setattr__(self, "rows", tuple(tuple(row) for row in self.rows))
        wrong = [row for row in self.rows if len(row) != len(self.columns)]
        if wrong:
            raise ValueError(f"table {self.name!r}: a row has {len(wrong[0])} values for {len(self.columns)} columns")


@dataclass(frozen=True)
class Figure:
    """A finished picture (bytes of ``format`` "svg" or "png"); `plotting.finish` makes one."""

    name: str
    caption: str
    data: bytes
    format: str = "svg"

    def __post_init__(self) -> None:
        file_name(self.name)
        if self.format not in ("svg", "png"):
            raise ValueError(f"figure {self.name!r}: format = {self.format!r}; allowed: svg, png")


@dataclass(frozen=True)
class Field:
    """Values on a mesh, written as a VTU file.

    name : also the name of the file
    caption : what the field shows, with units
    points : (n, 1), (n, 2) or (n, 3) coordinates in m
    cells : connectivity by meshio cell name ("line", "triangle", "quad", "tetra", ...), each (m, nodes)
    point_data : by name, each (n,) or (n, components)
    cell_data : by name, one array for each entry of ``cells`` in the same order
    """

    name: str
    caption: str
    _: KW_ONLY
    points: np.ndarray
    cells: dict[str, np.ndarray]
    point_data: dict[str, np.ndarray] = field(default_factory=dict)
    cell_data: dict[str, list[np.ndarray]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        file_name(self.name)


Item = Check | Table | Figure | Field


# quantity, unit, measured, expected, relative tolerance
ComparedRow = tuple[str, str, float, float, float]


def bound(name: str, error: float, limit: float, source: str, note: str = "") -> Check:
    """Return the check that an error, or what is left over, is at most ``limit``."""
    return Check(name, error, expected=0.0, tolerance=limit, source=source, kind=AT_MOST, note=note)


def compared(label: str, rows: Iterable[ComparedRow], source: str, note: str = "") -> Iterator[Check]:
    """A relative check of each row: (quantity, unit, measured, expected, tolerance)."""
    for quantity, unit, measured, expected, tolerance in rows:
        yield Check(
            f"{label}: {quantity}",
            measured,
            expected=expected,
            tolerance=tolerance,
            source=source,
            unit=unit,
            note=note,
        )


def beside(
    name: str,
    ours: float,
    theirs: float,
    errors: tuple[float, float],
    source: str,
    unit: str = "1",
    note: str = "",
    listed: ListedDeviation | None = None,
) -> Check:
    """Compare a value of lubfric with a published one. The check passes when they differ by no more than the root of
    the sum of the squares of both ``errors`` (lubfric, published; 95 % bounds in ``unit``). Its grade is A."""
    allowed = math.hypot(*errors)
    return Check(
        name,
        ours,
        expected=theirs,
        tolerance=allowed,
        source=source,
        kind=ABSOLUTE,
        unit=unit,
        note=note,
        grade="A",
        errors=errors,
        listed=listed,
    )


def file_name(name: str) -> str:
    """Return ``name`` if it can be part of a file name, else ValueError."""
    if not re.fullmatch(r"[A-Za-z0-9_-]+", name):
        raise ValueError(f"name {name!r} becomes a file name; allowed: letters, digits, _ and -")
    return name
