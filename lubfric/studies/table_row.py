"""A record of a point, narrowed to the numbers that a table holds."""

from __future__ import annotations

from ..store.codec import from_plain

SPEED, STATUS, CONVERGED = "speed", "status", "converged"


def row_of(record: dict) -> dict:
    """Numbers by name, those of an uncertainty as ``uncertainty_<name>``, and the status in words."""
    if "error" in record:
        return {STATUS: f"{record['error']}: {record['message']}"}
    return {STATUS: record["report"]["status"], **_numbers(record)}


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
