"""Frozen dataclasses as plain data and arrays, and back, without pickle: nothing in a file can run code.

A dataclass becomes ``{"class": "lubfric.module.Name", field: ...}``, an array
``{"array": [dtype, shape, order, place]}``, a number that is not finite ``{"float": "nan"}``. Tuples become lists,
lists ``{"list": [...]}``, dicts ``{"dict": {...}}``. Floats keep every bit. The file begins with the length of this
tree; then come the tree and the arrays. Each array is stored once, however often the tree names it.
"""

from __future__ import annotations

import json
import math
from dataclasses import fields, is_dataclass
from importlib import import_module

import numpy as np

HOME = "lubfric."
SCALARS = {"float64": np.float64, "int64": np.int64, "bool": np.bool_}
LENGTH = 8  # bytes of the length of the tree


class Arrays:
    """The arrays of one value, one after the other. ``parts``: their bytes, not copied."""

    def __init__(self) -> None:
        self.parts: list[bytes | memoryview] = []
        self._places: dict[int, list] = {}
        self._kept: list[np.ndarray] = []  # so that no other array takes the identity of one of these
        self._end = 0

    def put(self, array: np.ndarray) -> list:
        """Add ``array`` unless it is there already. Returns [dtype, shape, order, place in bytes]."""
        if id(array) not in self._places:
            if array.dtype.hasobject:
                raise TypeError(f"an array of {array.dtype} cannot be stored")
            order = "F" if array.flags.f_contiguous and not array.flags.c_contiguous else "C"
            flat = np.ascontiguousarray(array.T if order == "F" else array).reshape(-1)
            self._places[id(array)] = [array.dtype.str, array.shape, order, self._end]
            self._kept.append(array)
            self.parts.append(flat.view(np.uint8).data)
            self._end += flat.nbytes
        return self._places[id(array)]


def encode(value) -> list:
    """``value`` as bytes, in pieces that follow each other. It may be a tree of dataclasses of this package,
    numbers, texts and arrays."""
    arrays = Arrays()
    tree = json.dumps(to_plain(value, arrays), allow_nan=False).encode()
    return [len(tree).to_bytes(LENGTH, "little") + tree, *arrays.parts]


def decode(content: bytes):
    """What `encode` was given, from its pieces joined. Raises `ValueError` for what another version stored."""
    end = LENGTH + int.from_bytes(content[:LENGTH], "little")
    try:
        return from_plain(json.loads(content[LENGTH:end]), memoryview(content)[end:])
    except (KeyError, AttributeError, ImportError) as error:
        raise ValueError(f"stored by another version ({error})") from None


def _array(placed, content: memoryview) -> np.ndarray:
    kind, shape, order, place = placed
    count = math.prod(shape)
    flat = np.frombuffer(content, np.dtype(kind), count, place) if count else np.empty(0, np.dtype(kind))
    return flat.copy().reshape(shape, order=order)


def to_plain(value, arrays: Arrays | None = None):
    """JSON types for ``value``; its arrays are put into ``arrays``."""
    if value is None or isinstance(value, (bool, int, str)):
        return value
    if isinstance(value, np.generic):
        return {value.dtype.name: to_plain(value.item())}
    if isinstance(value, float):
        return value if math.isfinite(value) else {"float": str(value)}
    if isinstance(value, tuple):
        return [to_plain(item, arrays) for item in value]
    if isinstance(value, list):
        return {"list": [to_plain(item, arrays) for item in value]}
    if isinstance(value, dict):
        return {"dict": {_text(key): to_plain(item, arrays) for key, item in value.items()}}
    if isinstance(value, np.ndarray) and arrays is not None:
        return {"array": arrays.put(value)}
    kind = type(value)
    if is_dataclass(kind) and kind.__module__.startswith(HOME):
        parts = {f.name: to_plain(getattr(value, f.name), arrays) for f in fields(value)}
        return {"class": f"{kind.__module__}.{kind.__name__}", **parts}
    raise TypeError(f"a {kind.__name__} cannot be stored")


def from_plain(value, arrays=None):
    """What `to_plain` was given."""
    if isinstance(value, list):
        return tuple(from_plain(item, arrays) for item in value)
    if not isinstance(value, dict):
        return value
    if "class" in value:
        return _rebuilt(value, arrays)
    ((mark, content),) = value.items()
    if mark == "float":
        return float(content)
    if mark == "array":
        return _array(content, arrays)
    if mark == "list":
        return list(from_plain(content, arrays))
    if mark == "dict":
        return {key: from_plain(item, arrays) for key, item in content.items()}
    return SCALARS[mark](from_plain(content))


def _rebuilt(value, arrays):
    module, name = value["class"].rsplit(".", 1)
    kind = getattr(import_module(module), name) if module.startswith(HOME) else None
    if not (isinstance(kind, type) and is_dataclass(kind)):
        raise ValueError(f"{value['class']} is no dataclass of this package")
    new = object.__new__(kind)  # as it was: checks and conversions of the constructor had their turn
    for field in fields(kind):
        part = from_plain(value[field.name], arrays)
        if isinstance(part, np.ndarray):
            part.flags.writeable = False
        object.__setattr__(new, field.name, part)
    return new


def _text(key) -> str:
    if not isinstance(key, str):
        raise TypeError(f"a dict with the key {key!r} cannot be stored: not a text")
    return key
