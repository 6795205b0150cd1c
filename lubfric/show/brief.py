"""How the parts of a scene print: without the fields that are as they are by default."""

from __future__ import annotations

from dataclasses import MISSING, Field, fields
from typing import Any


class Brief:
    """A dataclass that prints as the call that makes it, its defaults left out."""

    def __repr__(self) -> str:
        told = ", ".join(f"{name}={value!r}" for name, value in changed(self).items())
        return f"{type(self).__name__}({told})"


def changed(part: Any) -> dict[str, Any]:
    """The fields of a dataclass that are not as they are by default, by name."""
    values = {f.name: (getattr(part, f.name), _default(f)) for f in fields(part)}
    return {name: value for name, (value, default) in values.items() if default is MISSING or value != default}


def _default(field: Field) -> Any:
    return field.default if field.default_factory is MISSING else field.default_factory()
