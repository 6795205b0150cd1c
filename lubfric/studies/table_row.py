"""A record of a point, narrowed to the numbers that a table holds."""

from __future__ import annotations

from ..store.codec import from_plain
from .journal import PLACE

SPEED, STATUS, CONVERGED = "speed", "status", "converged"
MISSING = "not computed"
UNUSED = "not needed"  # places of a curve that chose fewer speeds than another
CURVE, AT, COUNT = "curve", "place", "points"  # of a point whose speed was chosen: its curve, its place; points in all
DECIDED = CLEARANCE, STEEPNESS = "clearance", "steepness"  # what an interpolation needs of the decision of a point


def row_of(record: dict) -> dict:
    """The numbers of a point by name, those of its uncertainty as ``uncertainty_<name>``, and its status in words. A
    point whose speed was chosen has its place on its curve too."""
    place = {name: value for name, value in record.get(PLACE, {}).items() if value is not None}
    if "error" in record:
        return {STATUS: f"{record['error']}: {record['message']}", **place}
    if "report" not in record:  # a curve that is complete
        return place
    numbers = _numbers(record)
    decided = record.get("decision") or {}
    numbers |= {name: float(from_plain(decided[name])) for name in DECIDED if _is_number(decided.get(name))}
    return {STATUS: record["report"]["status"], **numbers, **place}


def named(rows: dict[str, dict]) -> dict[str, dict]:
    """``rows`` by key, where rows of chosen speeds go by their curve and place instead."""
    return {f"{row[CURVE]} {row[AT]}" if AT in row else key: row for key, row in rows.items()}


def _numbers(record: dict) -> dict[str, float]:
    found: dict[str, float] = {}
    for name, value in record.items():
        if name == "uncertainty" and isinstance(value, dict):
            found |= {f"uncertainty_{part}": number for part, number in _numbers(value).items()}
        elif name == "interval" and isinstance(value, list) and len(value) == 2:
            found |= {"low": from_plain(value[0]), "high": from_plain(value[1])}
        elif name != SPEED and _is_number(value):
            found[name] = float(from_plain(value))
    return found


def _is_number(value) -> bool:
    if isinstance(value, dict):
        return bool({"float", "float64"} & set(value))
    return isinstance(value, (int, float)) and not isinstance(value, bool)
