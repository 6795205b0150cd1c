"""Dataclasses of this package as bytes, and back. Reading builds the classes of a given table, each with values of the
types that its fields declare, and nothing else. So a file can run no code, and what it holds has the right shape.

A dataclass becomes ``{"class": name, field: ...}``, an array ``{"array": [dtype, shape, order, place]}``, a number that
is not finite ``{"float": "nan"}``. Tuples become lists, lists ``{"list": [...]}``, dicts ``{"dict": {...}}``. Floats
keep every bit. The bytes begin with the length of this tree in JSON; then come the tree and the arrays.
"""

import json
import math
import re
import sys
from collections.abc import Callable
from dataclasses import fields, is_dataclass
from functools import cache
from types import UnionType
from typing import Any, TypeVar, Union, get_args, get_origin, get_type_hints

import numpy as np

from .._base import Renamed, Shown

HOME = "lubfric."
SCALARS = {"float64": np.float64, "int64": np.int64, "bool": np.bool_}
LENGTH_BYTES = 8  # bytes of the length of the tree; by definition of the format
DTYPE = re.compile(r"[<>|=][biufc]\d{1,2}|[<>=]U\d{1,6}")  # of arrays: numbers and texts, never objects
ACCEPTED = {float: (float, int, np.floating, np.integer), int: (int, np.integer), bool: (bool, np.bool_)}


def classes_of(*roots: type) -> dict[str, type]:
    """Return a table of classes by name: the dataclasses of this package among ``roots``, and all that these lead to by
    the types of their fields and by inheritance."""
    seen: set[type] = set()
    waiting = list(roots)
    while waiting:
        kind = waiting.pop()
        waiting += get_args(kind)
        if isinstance(kind, type) and kind.__module__.startswith(HOME) and kind not in (*seen, Renamed, Shown):
            seen.add(kind)
            waiting += [*kind.__bases__, *kind.__subclasses__()]
            waiting += get_type_hints(kind).values() if is_dataclass(kind) else ()
    return {_name(kind): kind for kind in seen if is_dataclass(kind)}


def _name(kind: type) -> str:
    return f"{kind.__module__}.{kind.__name__}"


def encode(value: Any, field: Callable[..., Any] = getattr) -> list[Any]:
    """Return ``value`` as bytes, in pieces that follow each other. It may be a tree of dataclasses, numbers, texts and
    arrays. ``field(object, name)`` gives what is encoded of a field of a dataclass."""
    arrays: list[bytes | memoryview] = []
    tree = json.dumps(_plain(value, arrays, field), allow_nan=False).encode()
    return [len(tree).to_bytes(LENGTH_BYTES, "little") + tree, *arrays]


def decode(content: bytes, classes: dict[str, type], kind: Any = Any) -> Any:
    """Return what `encode` was given, from its pieces joined. ``classes``: those that it may hold (`classes_of`);
    ``kind``: the type that it must have, as in an annotation. Raises `ValueError` for anything else, such as what
    another version stored."""
    end = LENGTH_BYTES + int.from_bytes(content[:LENGTH_BYTES], "little")
    try:
        value = _value(json.loads(content[LENGTH_BYTES:end]), classes, memoryview(content)[end:])
    except (LookupError, TypeError, AttributeError, ArithmeticError, RecursionError, MemoryError) as error:
        raise ValueError(f"stored by another version ({error})") from None
    if not fits(value, kind):
        raise ValueError(f"stored by another version (a {type(value).__name__} is no {kind})")
    return value


def fits(value: Any, kind: Any) -> bool:
    """Return whether ``value`` has the type ``kind``, as in an annotation, and so have its parts. Fields of dataclasses
    were looked at when these were built, and a named tuple is stored as a plain one. ``kind`` may also be a dict of
    kinds, for a dict that has these keys at least, and a list of one kind."""
    if kind is Any:
        return True
    if isinstance(kind, dict):
        return isinstance(value, dict) and all(name in value and fits(value[name], kind[name]) for name in kind)
    kind = list[kind[0]] if isinstance(kind, list) else kind
    origin = get_origin(kind) or kind
    parts = get_args(kind)
    if origin in (Union, UnionType):
        return any(fits(value, part) for part in parts)
    if isinstance(kind, type) and issubclass(kind, tuple) and kind is not tuple:
        origin = tuple
        parts = tuple(_hints(kind).values())
    if not isinstance(value, ACCEPTED.get(origin, origin)) or (isinstance(value, bool) and origin in (float, int)):
        return False
    if isinstance(value, int) and origin is float:
        return abs(value) <= sys.float_info.max
    if origin is dict and parts:
        return all(fits(key, parts[0]) and fits(item, parts[1]) for key, item in value.items())
    if origin is tuple and parts and parts[-1] is not Ellipsis:
        return len(value) == len(parts) and all(map(fits, value, parts))
    return origin not in (tuple, list) or not parts or all(fits(item, parts[0]) for item in value)


@cache
def _hints(kind: Any) -> dict[str, Any]:
    """Return the types of the fields of a dataclass or a named tuple. A type variable represents a number of one
    point."""
    hints = get_type_hints(kind)
    names = [f.name for f in fields(kind)] if is_dataclass(kind) else kind._fields
    return {name: float if isinstance(hints[name], TypeVar) else hints[name] for name in names}


def _plain(value: Any, arrays: list[Any], field: Callable[..., Any]) -> Any:
    """Return JSON types for ``value``. Its arrays are added to ``arrays``."""
    if value is None or isinstance(value, (bool, int, str)):
        return value
    if isinstance(value, np.generic):
        return {value.dtype.name: _plain(value.item(), arrays, field)}
    if isinstance(value, float):
        return value if math.isfinite(value) else {"float": str(value)}
    if isinstance(value, tuple):
        return [_plain(item, arrays, field) for item in value]
    if isinstance(value, list):
        return {"list": [_plain(item, arrays, field) for item in value]}
    if isinstance(value, dict) and all(isinstance(key, str) for key in value):
        return {"dict": {key: _plain(item, arrays, field) for key, item in value.items()}}
    if isinstance(value, np.ndarray) and not value.dtype.hasobject:
        order = "F" if value.flags.f_contiguous and not value.flags.c_contiguous else "C"
        flat = np.ascontiguousarray(value.T if order == "F" else value).reshape(-1)
        place = sum(len(part) for part in arrays)
        arrays.append(flat.view(np.uint8).data)
        return {"array": [value.dtype.str, value.shape, order, place]}
    if is_dataclass(value) and not isinstance(value, type):
        parts = {f.name: _plain(field(value, f.name), arrays, field) for f in fields(value)}
        return {"class": _name(type(value))} | parts
    raise TypeError(f"a {type(value).__name__} cannot be stored: {value!r}")


def _value(plain: Any, classes: dict[str, type], content: memoryview) -> Any:
    """Return what `_plain` was given. ``content``: the bytes of the arrays."""
    if isinstance(plain, list):
        return tuple(_value(item, classes, content) for item in plain)
    if not isinstance(plain, dict):
        return plain
    if "class" in plain:
        kind = classes[plain["class"]]
        new: Any = object.__new__(kind)  # as it was: checks and conversions of its constructor had their turn
        for name, hint in _hints(kind).items():
            part = _value(plain[name], classes, content)
            if type(part) is not hint and not fits(part, hint):
                raise ValueError(f"{name} of {kind.__name__} is no {hint}")
            if isinstance(part, np.ndarray):
                part.flags.writeable = False
            object.__setattr__(new, name, part)
        return new
    ((mark, inner),) = plain.items()
    if mark == "float":
        return float(inner)
    if mark == "array":
        dtype, shape, order, place = inner
        if not DTYPE.fullmatch(dtype):
            raise ValueError(f"an array of {dtype}")
        flat = np.frombuffer(content, dtype, math.prod(shape), place) if math.prod(shape) else np.empty(0, dtype)
        return flat.copy().reshape(shape, order=order)
    if mark == "list":
        return list(_value(inner, classes, content))
    if mark == "dict":
        return {key: _value(item, classes, content) for key, item in inner.items()}
    return SCALARS[mark](_value(inner, classes, content))
