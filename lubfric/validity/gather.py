"""The entries of many operating points as a few sentences."""

from __future__ import annotations

from typing import Any

from ..errors import ValidityError
from .entry import Validity


def entries_of(point: Any, error: Exception | None) -> tuple[Validity, ...]:
    """Assumptions that do not hold at ``point`` of a curve (None: failed), or at the result that ``error`` refused."""
    refused = error.result if point is None and isinstance(error, ValidityError) else None
    found = point if refused is None else refused
    return () if found is None else found.validity


def gathered(points, unit: str = "m/s", name: str = "speeds") -> tuple[str, ...]:
    """One sentence for each assumption that fails anywhere: at how many points, from where to where, and the worst
    value.

    ``points``: pairs (value of the swept quantity, entries of that point).
    """
    found: dict[tuple[str, bool], list[tuple[float, Validity]]] = {}
    for value, entries in points:
        for entry in entries:
            found.setdefault((entry.what, entry.severe), []).append((value, entry))
    lines = []
    for group in found.values():
        worst = max((entry for _, entry in group), key=_distance)
        values = sorted(value for value, _ in group)
        if len(group) == 1:
            lines.append(f"at {values[0]:g} {unit}: {worst.text}")
        else:
            lines.append(f"{len(group)} {name}, {values[0]:g} to {values[-1]:g} {unit}: {worst.text}")
    return tuple(lines)


def _distance(entry: Validity) -> float:
    """How far beyond its limit, as a ratio."""
    if entry.limit == 0 or entry.value == 0:
        return abs(entry.value - entry.limit)
    ratio = abs(entry.value / entry.limit)
    return max(ratio, 1 / ratio)
