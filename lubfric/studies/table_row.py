"""The numbers of a point's record that a table contains."""

from __future__ import annotations

from typing import Any

from ..sharing import in_a_cell
from .adaptive import DECIDED
from .codec import from_plain
from .journal import SPEED

STATUS, CONVERGED, VALIDITY = "status", "converged", "validity"
MISSING = "not computed"
UNUSED = "not needed"  # places of a curve that chose fewer speeds than another


def row_of(record: dict) -> dict[str, Any]:
    """The numbers of a point by name, those of its uncertainty as ``uncertainty_<name>``, and in words its status and
    the assumptions that do not hold. Nothing for the mark of a complete curve."""
    if not record:
        return {}
    if "error" in record:
        speed = {SPEED: record[SPEED]} if SPEED in record else {}
        return {STATUS: f"{record['error']}: {record['message']}", **speed}
    numbers = _numbers(record)
    decided = record.get("decision") or {}
    numbers |= {name: float(from_plain(decided[name])) for name in DECIDED if _is_number(decided.get(name))}
    told = {VALIDITY: in_a_cell(from_plain(record["validity"]))} if record.get("validity") else {}
    return {STATUS: record["report"]["status"], **told, **numbers}


def _numbers(record: dict) -> dict[str, float]:
    found: dict[str, float] = {}
    for name, value in record.items():
        if name == "uncertainty" and isinstance(value, dict):
            found |= {f"uncertainty_{part}": number for part, number in _numbers(value).items()}
        elif name == "interval" and isinstance(value, list) and len(value) == 2:
            found |= {"low": from_plain(value[0]), "high": from_plain(value[1])}
        elif _is_number(value):
            found[name] = float(from_plain(value))
    return found


def _is_number(value) -> bool:
    if isinstance(value, dict):
        return bool({"float", "float64"} & set(value))
    return isinstance(value, (int, float)) and not isinstance(value, bool)
