"""X3P height maps: a zip archive of main.xml and raw little-endian binary (ISO 25178-72, ISO 5436-2).

Only the standard library is used, nothing is unpacked to disk, and nothing is believed: sizes are checked
before anything is read, the checksums of the archive after, and XML with a document type is refused. Member
layout as in the openGPS reference (https://sourceforge.net/p/open-gps/mwiki/X3p/).
"""

import math
import zipfile
import zlib
from xml.etree import ElementTree
from xml.parsers import expat

import numpy as np

from ..errors import InputError
from .height_map import Surface

MOST_XML = 4 * 2**20  # bytes of main.xml
MOST_POINTS = 2**25  # 256 MiB of doubles
TYPES = {"I": "<i2", "L": "<i4", "F": "<f4", "D": "<f8"}
CORRUPT = (zipfile.BadZipFile, zlib.error, EOFError, OSError, NotImplementedError, RuntimeError, ValueError)


def read_x3p(path) -> Surface:
    """The height map of an X3P file as it stands: unmeasured points NaN, neither levelled nor filled.

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
        raise InputError(f"path = {str(path)!r} is not a complete X3P (zip) file ({problem})") from None


def _read(archive, path) -> Surface:
    root = _parse(_member(archive, "main.xml", MOST_XML))
    if _text(root, "Record1/FeatureType") != "SUR":
        raise _bad("Record1/FeatureType", _text(root, "Record1/FeatureType"), "SUR (a surface)")
    nx, ny, layers = (_count(root, f"Record3/MatrixDimension/Size{a}") for a in "XYZ")
    if layers != 1:
        raise _bad("SizeZ", layers, "1 (one layer)")
    if nx * ny > MOST_POINTS:
        raise _bad("SizeX x SizeY", f"{nx} x {ny}", f"at most {MOST_POINTS} points")
    spacing = _increment(root, "CX"), _increment(root, "CY")
    axis = _text(root, "Record1/Axes/CZ/AxisType")
    name = _text(root, "Record1/Axes/CZ/DataType")
    if axis != "A" or name not in TYPES:
        raise _bad("CZ AxisType, DataType", f"{axis}, {name}", "A with I, L, F or D")
    kind = TYPES[name]
    raw = _linked(archive, root, "PointData", nx * ny * np.dtype(kind).itemsize)
    heights = _heights(root, np.frombuffer(raw, kind)).reshape(ny, nx).T
    mask = ~np.isnan(heights)
    if _text(root, "Record3/DataLink/ValidPointsLink", required=False):
        bits = _linked(archive, root, "ValidPoints", (nx * ny + 7) // 8)
        valid = np.unpackbits(np.frombuffer(bits, np.uint8), bitorder="little", count=nx * ny)
        mask &= valid.reshape(ny, nx).T.astype(bool)
    if not mask.any():
        raise _bad("measured points", 0, "at least 1")
    return Surface(np.where(mask, heights, np.nan), spacing, mask=mask, source=str(path))


def _member(archive, name, most) -> bytes:
    """The bytes of a member whose size is at most ``most``, checked before it is unpacked."""
    found = [info for info in archive.infolist() if info.filename == name]
    if len(found) != 1:
        raise _bad(f"members named {name!r}", len(found), "exactly 1")
    if found[0].file_size > most:
        raise _bad(f"size of {name!r}", f"{found[0].file_size} bytes", f"at most {most} bytes")
    with archive.open(found[0]) as stream:
        return stream.read(most + 1)


def _parse(document) -> ElementTree.Element:
    """The tree of main.xml; entities cannot be declared because a document type is refused."""

    def refuse(*_):
        raise _bad("main.xml", "a document type (DOCTYPE)", "none")

    guard = expat.ParserCreate()
    guard.StartDoctypeDeclHandler = refuse
    try:
        guard.Parse(document, True)
        root = ElementTree.fromstring(document)
    except (expat.ExpatError, ElementTree.ParseError, LookupError) as problem:
        raise _bad("main.xml", f"XML that cannot be parsed ({problem})", "well-formed XML") from None
    for element in root.iter():
        element.tag = element.tag.rpartition("}")[2]
    return root


def _linked(archive, root, what, size) -> bytes:
    """The bytes that a link names, of ``size``."""
    name = _text(root, f"Record3/DataLink/{what}Link")
    data = _member(archive, name, size)
    if len(data) != size:
        raise _bad(f"size of {name!r}", f"{len(data)} bytes", f"{size} bytes for its matrix")
    return data


def _heights(root, values) -> np.ndarray:
    """The heights [m] of the ``values`` in the file."""
    offset = _number(root, "Record1/Axes/CZ/Offset", default=0.0)
    if values.dtype.kind == "i":
        return values.astype(float) * _increment(root, "CZ", axis_type="A") + offset
    step = _number(root, "Record1/Axes/CZ/Increment", default=1.0)
    if step != 1.0:
        raise _bad("CZ Increment of floating-point heights", step, "1 or absent (readers disagree on it)")
    return values.astype(float) + offset


def _increment(root, axis, axis_type="I") -> float:
    found = _text(root, f"Record1/Axes/{axis}/AxisType")
    if found != axis_type:
        raise _bad(f"{axis} AxisType", found, f"{axis_type} (uniform spacing)")
    step = _number(root, f"Record1/Axes/{axis}/Increment")
    if not step > 0:
        raise _bad(f"{axis} Increment", f"{step:g} m", "(0, inf) m")
    return step


def _number(root, where, default=None) -> float:
    text = _text(root, where, required=default is None)
    try:
        value = default if text == "" else float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise _bad(where, text, "a finite number")
    return value


def _count(root, where) -> int:
    text = _text(root, where)
    if not (text.isascii() and text.isdigit() and len(text) < 10 and int(text) > 0):
        raise _bad(where, text[:40], "a whole number >= 1")
    return int(text)


def _text(root, where, required=True) -> str:
    element = root.find(where)
    text = "" if element is None else (element.text or "").strip()
    if required and not text:
        raise _bad(where, "missing", "present in main.xml")
    return text


def _bad(quantity, value, allowed) -> InputError:
    return InputError(f"X3P {quantity} = {value}; allowed: {allowed}")
