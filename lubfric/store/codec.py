"""Frozen dataclasses as plain data and arrays, and back, without pickle: nothing in a file can run code.

A dataclass becomes ``{"class": "lubfric.module.Name", field: ...}``, an array ``{"array": number}``, a number that is
not finite ``{"float": "nan"}``; tuples become lists, lists ``{"list": [...]}``, dicts ``{"dict": {...}}``. Floats keep
every bit.
"""

from __future__ import annotations

import io
import json
import math
from dataclasses import fields, is_dataclass
from importlib import import_module

import numpy as np

HOME = "lubfric."
SCALARS = {"float64": np.float64, "int64": np.int64, "bool": np.bool_}


def encode(value) -> bytes:
    """``value``, a tree of dataclasses of this package, numbers, texts and arrays, as one ``.npz`` file in bytes."""
    arrays: dict[str, np.ndarray] = {}
    tree = to_plain(value, arrays)
    buffer = io.BytesIO()
    arrays["tree"] = np.array(json.dumps(tree, allow_nan=False))
    np.savez(buffer, **arrays)  # type: ignore[arg-type]  # NumPy types allow_pickle, not the arrays
    return buffer.getvalue()


def decode(content: bytes):
    """What `encode` was given."""
    with np.load(io.BytesIO(content), allow_pickle=False) as file:
        return from_plain(json.loads(str(file["tree"])), file)


def to_plain(value, arrays: dict | None = None):
    """JSON types for ``value``; its arrays are put into ``arrays`` by name."""
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
        name = f"array_{len(arrays)}"
        arrays[name] = value
        return {"array": name}
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
        return arrays[content]
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
