"""How dataclasses of results and scenes behave: arrays stay read-only, derived values are not pickled, and they print
as one line, or as the call that makes them."""

from dataclasses import MISSING, fields
from typing import Any, ClassVar

import numpy as np


class FrozenArrays:
    """Base of frozen dataclasses: every array field is read-only, after copying and unpickling too. The arrays have to
    be its own."""

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        FrozenArrays.__post_init__(self)

    def __post_init__(self) -> None:
        for value in self.__dict__.values():
            if isinstance(value, np.ndarray):
                value.flags.writeable = False


class FieldsOnly:
    """Base of frozen dataclasses with cached properties: derived values are not pickled."""

    def __getstate__(self) -> dict[str, Any]:
        return {f.name: getattr(self, f.name) for f in fields(self)}  # type: ignore[arg-type]


class Renamed:
    """Base of results: an attribute that has another name today raises `AttributeError` with that name."""

    _RENAMED: ClassVar[dict[str, str]] = {}  # today's name by the old one

    def __getattr__(self, name: str) -> Any:
        kind = type(self)
        if name in kind._RENAMED:
            raise AttributeError(f"{kind.__name__}.{name} is called {kind._RENAMED[name]} now")
        raise AttributeError(f"{kind.__name__!r} object has no attribute {name!r}")


class Shown:
    """Prints as one line of its ``_facts``, a dict of words by name; without any, as the call that makes it, its
    defaults left out."""

    def _facts(self) -> dict[str, str]:
        return {}

    def __repr__(self) -> str:
        if facts := self._facts():
            return f"<{type(self).__name__}: {', '.join(f'{k} {v}' if k else v for k, v in facts.items())}>"
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in changed(self).items())})"


def changed(part: Any) -> dict[str, Any]:
    """The fields of a dataclass that differ from their defaults, by name."""
    found = {}
    for f in fields(part):
        value = getattr(part, f.name)
        default = f.default if f.default_factory is MISSING else f.default_factory()
        if default is MISSING or value != default:
            found[f.name] = value
    return found
