"""A section of a scene with some of its fields changed."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from .._base import validate
from ..errors import InputError
from .numerics import refuse_dropped
from .plausible import told_slips
from .roughness import Roughness, as_given, counterface, named
from .short_forms import resolve, short_keys
from .transient import Transient


def changed_section(section: str, old: Any, values: Any) -> Any:
    """``old`` with the fields in the dict ``values``. ``values`` may also be a whole section, which then replaces
    ``old``."""
    kinds: dict[str, type] = {"name": str, "transient": Transient, "counterface": Roughness}
    kind: Any = kinds.get(section, type(old))
    if isinstance(values, kind) or (section in ("transient", "counterface") and values is None):
        return values
    if section == "counterface" and old is None and isinstance(values, dict):
        return counterface(values)
    if not isinstance(values, dict) or not isinstance(old, kind) or kind is str:
        by_field = "a dict of its fields, or " if kind is not str and old is not None else ""
        shown = repr(values) if isinstance(values, (str, float, int)) else f"a {type(values).__name__}"
        raise InputError(f"{section} = {shown}; allowed: {by_field}a {kind.__name__}")
    if section == "numerics":
        refuse_dropped(values)
    allowed = (*old.__dataclass_fields__, *short_keys(section))
    for key in values:
        if key not in allowed:
            raise InputError(
                f"{section} has no field {key!r}{validate.nearest(key, allowed)}; allowed: {', '.join(allowed)}"
            )
    if isinstance(old, Roughness):
        values = as_given(old, values)
    with told_slips(section, values), named(section):
        return replace(old, **resolve(section, values, old))
