"""Height maps of ISO 25178-71 as text (.sdf, also of the older BCR layout): a header, the heights, a trailer, each
ended by "*"."""

from pathlib import Path

import numpy as np

from .._base import FloatArray, validate
from ..errors import InputError
from .layout import refuse_profile

SDF_FIRST_WORDS = ("aISO-1.0", "aISO-2.0", "aBCR-1.0")

# Words for a point that was not measured: of the standard, and of programs that write what their language prints.
UNMEASURED_WORDS = ("bad", "nan")

# Fields with the points of a profile and the number of profiles; Xscale, Yscale and Zscale are in m by the standard.
COUNT_FIELDS = ("NumPoints", "NumProfiles")

# Fields for what lubfric does not read: heights that are compressed, or followed by a checksum.
MUST_BE_ZERO = ("Compression", "CheckType")


def read_sdf(
    path: Path, text: str, units: tuple[str, str, str] | None
) -> tuple[FloatArray, tuple[float, float], tuple[str, ...]]:
    """Return the heights[ix, iy] [m] of a file, NaN where unmeasured, its spacing [m], and notes.

    Raises `InputError` for a file that is cut off, compressed, of another layout, and where the caller gives a unit.
    """
    name = f"path = {str(path)!r}"
    if units is not None:
        raise InputError(f"unit = {units[2]!r} is given, and {name} states its own (m)", recommendation="omit it")
    records = text.split("*")
    if len(records) < 3:
        message = f"{name} is cut off: it has {len(records) - 1} of the marks '*' that end its header and its heights"
        raise InputError(message, recommendation="give the whole file")
    magic, *lines = records[0].splitlines()
    fields = _fields(name, lines)
    nx, ny = (int(_number(name, fields, field, whole=True)) for field in COUNT_FIELDS)
    for field in MUST_BE_ZERO:
        if fields.get(field, "0") != "0":
            raise InputError(f"{name}: {field} = {validate.shown(fields[field])}", allowed="0: export it without")
    heights = _heights(name, records[1], nx * ny).reshape(ny, nx).T * _number(name, fields, "Zscale")
    if ny == 1 or nx == 1:
        refuse_profile(path.name, heights.reshape(-1, 1), None, ("m", "m", "m"))
    steps = (_number(name, fields, "Xscale"), _number(name, fields, "Yscale"))
    return heights, steps, (f"header of ISO 25178-71 ({magic.strip()})", "x runs along the profiles of the file")


def _fields(name: str, lines: list[str]) -> dict[str, str]:
    """Return the fields of the header as text. Raise `InputError` where one is stated twice, or a line is none."""
    fields: dict[str, str] = {}
    for line in lines:
        key, mark, value = line.partition("=")
        if not line.strip():
            continue
        if not mark:
            raise InputError(
                f"{name} has the line {validate.shown(line.strip())} in its header", allowed="name = value"
            )
        if fields.setdefault(key.strip(), value.strip()) != value.strip():
            raise InputError(f"{name} states {key.strip()} twice: {fields[key.strip()]} and {value.strip()}")
    return fields


def _number(name: str, fields: dict[str, str], field: str, *, whole: bool = False) -> float:
    """Return the positive number of a field."""
    given = fields.get(field)
    if given is None:
        raise InputError(f"{name} does not state {field}", recommendation="export the file again")
    try:
        value = float(given)
    except ValueError:
        raise InputError(f"{name}: {field} = {validate.shown(given)} is no number", allowed="above 0") from None
    if whole and not (value == np.rint(value) and 1 <= value <= 1e9):
        raise InputError(f"{name}: {field} = {given}", allowed="a whole number above 0")
    return validate.number(f"{field} of {name}", value, "(m)", above=0.0, maximum=1e9)


def _heights(name: str, record: str, count: int) -> FloatArray:
    """Return the numbers of the second record, NaN where it says that a point is unmeasured."""
    words = record.split()
    if len(words) != count:
        message = f"{name} has {len(words)} heights, and its header states {count}"
        raise InputError(message, recommendation="give the whole file")
    try:
        return np.array(["nan" if word.lower() in UNMEASURED_WORDS else word for word in words], float)
    except ValueError as problem:
        raise InputError(f"{name}: {validate.shown(str(problem))}", allowed="numbers, BAD where unmeasured") from None
