"""X3P height maps: a zip archive of main.xml and raw little-endian binary (ISO 25178-72, ISO 5436-2).

Only the standard library is used, nothing is unpacked to disk, and nothing is believed: sizes are checked
before anything is read, the checksums of the archive after, and XML with a document type is refused. Member
layout as in the openGPS reference (https://sourceforge.net/p/open-gps/mwiki/X3p/).
"""

import hashlib
import lzma
import math
import zipfile
import zlib
from pathlib import Path
from typing import Any
from xml.etree import ElementTree
from xml.parsers import expat

import numpy as np

from .._base import validate
from ..errors import InputError
from .height_map import Surface

MOST_XML = 4 * 2**20  # bytes of main.xml; a choice, for memory
MOST_X3P_POINTS = 2**25  # 256 MiB of doubles; a choice, for memory
TYPES = {"I": "<i2", "L": "<i4", "F": "<f4", "D": "<f8"}
MOST_SUMS = 2**16  # bytes of the file of checksums; a choice, for memory
CORRUPT = (
    zipfile.BadZipFile,
    zlib.error,
    lzma.LZMAError,
    EOFError,
    OSError,
    NotImplementedError,
    RuntimeError,
    ValueError,
)


def read_x3p(path: Path) -> Surface:
    """Return the height map of an X3P file unchanged: unmeasured points NaN, neither levelled nor filled.

    The file counts x fastest; here x is axis 0. Integer heights are signed (openGPS reference) and times
    their axis increment; floating-point heights are metres. Raises `InputError` for anything else than
    one complete, consistent surface.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            return _read(archive, path)
    except InputError:
        raise
    except CORRUPT as problem:
        raise InputError(
            f"path = {str(path)!r} is not a complete X3P (zip) file ({validate.shown(str(problem))})"
        ) from None


def _read(archive: zipfile.ZipFile, path: Path) -> Surface:
    """Return the one layer of heights in an open X3P ``archive``. Raises `InputError` for anything else."""
    document = _member(archive, "main.xml", MOST_XML)
    root = _parse(document)
    _check_document(archive, root, document)
    if _text(root, "Record1/FeatureType") != "SUR":
        raise _bad("Record1/FeatureType", _text(root, "Record1/FeatureType"), "SUR (a surface)")
    nx, ny, layers = (_count(root, f"Record3/MatrixDimension/Size{a}") for a in "XYZ")
    if layers != 1:
        raise _bad("SizeZ", layers, "1 (one layer)")
    if nx * ny > MOST_X3P_POINTS:
        raise _bad("SizeX x SizeY", f"{nx} x {ny}", f"at most {MOST_X3P_POINTS} points")
    spacing = _increment(root, "CX"), _increment(root, "CY")
    axis = _text(root, "Record1/Axes/CZ/AxisType")
    name = _text(root, "Record1/Axes/CZ/DataType")
    if axis != "A" or name not in TYPES:
        raise _bad("CZ AxisType, DataType", f"{axis}, {name}", "A with I, L, F or D")
    kind = TYPES[name]
    if root.find("Record3/DataList") is not None:
        if root.find("Record3/DataLink") is not None:
            raise _bad("Record3", "a DataList and a DataLink", "one of them")
        values = _listed(root, nx * ny, kind)
    else:
        values = np.frombuffer(_linked(archive, root, "PointData", nx * ny * np.dtype(kind).itemsize), kind)
    heights = _heights(root, values).reshape(ny, nx).T
    mask = ~np.isnan(heights)
    if _text(root, "Record3/DataLink/ValidPointsLink", required=False):
        bits = _linked(archive, root, "ValidPoints", (nx * ny + 7) // 8)
        valid = np.unpackbits(np.frombuffer(bits, np.uint8), bitorder="little", count=nx * ny)
        mask &= valid.reshape(ny, nx).T.astype(bool)
    if not mask.any():
        raise _bad("measured points", 0, "at least 1")
    return Surface(np.where(mask, heights, np.nan), spacing, mask=mask, source=str(path))


def _member(archive: zipfile.ZipFile, name: str, most: int) -> bytes:
    """Return the bytes of a member whose size is at most ``most``, checked before it is unpacked. Links of some
    programs have "\\" between folders, or begin with "./"."""
    wanted = _path(name)
    members = [info for info in archive.infolist() if _path(info.filename) == wanted]
    if len(members) != 1:
        raise _bad(f"members named {name[:80]!r}", len(members), "exactly 1")
    if members[0].file_size > most:
        raise _bad(f"size of {name[:80]!r}", f"{members[0].file_size} bytes", f"at most {most} bytes")
    with archive.open(members[0]) as stream:
        return stream.read(most + 1)


def _path(name: str) -> str:
    """Return a path within the archive in one spelling."""
    parts = [part for part in name.replace("\\", "/").split("/") if part not in ("", ".")]
    return "/".join(parts)


def _check_sum(what: str, data: bytes, stated: str) -> None:
    """Raise `InputError` where the MD5 checksum ``stated`` in the file is not that of the ``data``."""
    computed = hashlib.md5(data, usedforsecurity=False).hexdigest()
    if stated and stated.lower() != computed:
        raise _bad(
            f"MD5 checksum of {what}", f"{stated[:40]} (that of the data is {computed})", "equal ones: copy it again"
        )


def _check_document(archive: zipfile.ZipFile, root: ElementTree.Element, document: bytes) -> None:
    """Check main.xml by the file of checksums that Record4 names, where it is there."""
    name = _text(root, "Record4/ChecksumFile", required=False)
    if not name or not any(_path(info.filename) == _path(name) for info in archive.infolist()):
        return
    lines = _member(archive, name, MOST_SUMS).decode("ascii", "replace").split("\n")
    for line in lines:
        words = line.split()
        if len(words) == 2 and _path(words[1].removeprefix("*")) == "main.xml":
            _check_sum("main.xml", document, words[0])


def _listed(root: ElementTree.Element, count: int, kind: str) -> np.ndarray:
    """Return the heights of a DataList: one Datum a point, its last number is z, NaN where it is empty."""
    data = [(element.text or "").strip() for element in root.iterfind("Record3/DataList/Datum")]
    if len(data) != count:
        raise _bad("number of Datum", len(data), f"{count} for its matrix")
    numbers = [text.split(";")[-1].strip() for text in data]
    try:
        values = np.array([float(text) if text else math.nan for text in numbers])
    except ValueError as problem:
        raise _bad("Datum", str(problem)[:80], "a number, or none where unmeasured") from None
    are_integers = kind in ("<i2", "<i4")
    if are_integers and not (np.isnan(values) | (values == np.rint(values))).all():
        raise _bad("Datum", "a fraction", "whole numbers for CZ DataType I or L")
    return values


def _parse(document: bytes) -> ElementTree.Element:
    """Return the tree of main.xml; entities cannot be declared because a document type is refused."""

    def refuse(*_: int | str | None) -> None:
        raise _bad("main.xml", "a document type (DOCTYPE)", "none")

    guard = expat.ParserCreate()
    guard.StartDoctypeDeclHandler = refuse
    try:
        guard.Parse(document, True)  # noqa: FBT003  # pyexpat takes no keyword
        root = ElementTree.fromstring(document)
    except (expat.ExpatError, ElementTree.ParseError, LookupError) as problem:
        raise _bad("main.xml", f"XML that cannot be parsed ({problem})", "well-formed XML") from None
    for element in root.iter():
        element.tag = element.tag.rpartition("}")[2]
    return root


def _linked(archive: zipfile.ZipFile, root: ElementTree.Element, what: str, size: int) -> bytes:
    """Return the bytes that a link names, of ``size``, checked by the checksum beside it."""
    name = _text(root, f"Record3/DataLink/{what}Link")
    data = _member(archive, name, size)
    if len(data) != size:
        raise _bad(f"size of {name[:80]!r}", f"{len(data)} bytes", f"{size} bytes for its matrix")
    sums = {"PointData": "MD5ChecksumPointData", "ValidPoints": "MD5ChecksumValidPoints"}
    _check_sum(name[:80], data, _text(root, f"Record3/DataLink/{sums[what]}", required=False))
    return data


def _heights(root: ElementTree.Element, values: np.ndarray) -> np.ndarray:
    """Return the heights [m] of the ``values`` in the file."""
    offset = _number(root, "Record1/Axes/CZ/Offset", default=0.0)
    if _text(root, "Record1/Axes/CZ/DataType") in ("I", "L"):
        return values.astype(float) * _increment(root, "CZ", axis_type="A") + offset
    step = _number(root, "Record1/Axes/CZ/Increment", default=1.0)
    if step != 1.0:
        raise _bad("CZ Increment of floating-point heights", step, "1 or absent (readers disagree on it)")
    return values.astype(float) + offset


def _increment(root: ElementTree.Element, axis: str, axis_type: str = "I") -> float:
    axis_kind = _text(root, f"Record1/Axes/{axis}/AxisType")
    if axis_kind != axis_type:
        raise _bad(f"{axis} AxisType", axis_kind, f"{axis_type} (uniform spacing)")
    step = _number(root, f"Record1/Axes/{axis}/Increment")
    if not step > 0:
        raise _bad(f"{axis} Increment", f"{step:g} m", "(0, inf) m")
    return step


def _number(root: ElementTree.Element, where: str, default: float | None = None) -> float:
    text = _text(root, where, required=default is None)
    try:
        value = default if text == "" and default is not None else float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise _bad(where, text, "a finite number")
    return value


def _count(root: ElementTree.Element, where: str) -> int:
    text = _text(root, where)
    if not (text.isascii() and text.isdigit() and len(text) < 10 and int(text) > 0):
        raise _bad(where, text[:40], "a whole number >= 1")
    return int(text)


def _text(root: ElementTree.Element, where: str, *, required: bool = True) -> str:
    element = root.find(where)
    text = "" if element is None else (element.text or "").strip()
    if required and not text:
        raise _bad(where, "missing", "present in main.xml")
    return text


def _bad(quantity: str, value: Any, allowed: str) -> InputError:
    return InputError(f"X3P {quantity} = {value}; allowed: {allowed}")
