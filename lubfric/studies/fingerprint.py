"""A hash of all that a number depends on."""

from __future__ import annotations

import hashlib
import json
import struct
from dataclasses import fields, is_dataclass
from pathlib import Path

import numpy as np

from .._base import __version__, saying

LABELS = {"Scene": ("name",), "Surface": ("source", "notes"), "Motion": ("speeds",)}  # no number depends on these


def fingerprint(*parts) -> str:
    """SHA-256, hexadecimal, of ``parts`` and the versions of lubfric and NumPy, whose generator makes the maps.

    Parts are numbers, texts, arrays, dataclasses and collections of these. Of a scene everything counts except its
    name, the provenance of its map and the list of speeds. A height map counts by its heights and spacing, a file by
    its bytes and not by its path.
    """
    return digest([__version__, np.__version__, *parts])


def digest(value) -> str:
    """SHA-256, hexadecimal, of a value: equal for equal numbers, to the last bit, in every process."""
    found = hashlib.sha256()
    _feed(found, value)
    return found.hexdigest()


def _feed(found, value) -> None:
    if isinstance(value, np.ndarray):
        if value.dtype.hasobject:
            raise TypeError(f"an array of {value.dtype} has no fingerprint")
        found.update(f"array {value.dtype.str} {value.shape} ".encode())
        found.update(np.ascontiguousarray(value).data if value.size else b"")
    elif isinstance(value, np.generic):
        _feed(found, value.item())
    elif value is None or isinstance(value, (bool, int, str)):
        found.update(f"{type(value).__name__} {json.dumps(value)} ".encode())
    elif isinstance(value, float):
        found.update(b"float " + struct.pack("<d", value))
    elif isinstance(value, dict):
        found.update(f"dict {len(value)} ".encode())
        for key in sorted(value):
            _feed(found, key)
            _feed(found, value[key])
    elif isinstance(value, (list, tuple)):
        found.update(f"list {len(value)} ".encode())
        for item in value:
            _feed(found, item)
    elif isinstance(value, Path):
        _feed(found, str(value))
    elif is_dataclass(value) and not isinstance(value, type):
        _feed_dataclass(found, value)
    else:
        raise TypeError(f"a {type(value).__name__} has no fingerprint")


def _feed_dataclass(found, value) -> None:
    kind = type(value).__name__
    left_out = LABELS.get(kind, ())
    found.update(f"{kind} ".encode())
    for field in fields(value):
        if field.name in left_out:
            continue
        _feed(found, field.name)
        part = getattr(value, field.name)
        _feed(found, _bytes_of(part) if (kind, field.name) == ("Roughness", "file") and part is not None else part)


def _bytes_of(path: str) -> str:
    with saying(f"surface.file = {path} was not read"), open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
