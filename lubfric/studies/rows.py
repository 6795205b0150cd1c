"""The points of a study as rows of numbers, and what a store has of them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from ..quantities import NUMBERS
from ..sampling import FrictionResult
from ..sharing import in_a_cell
from .points import Outcome
from .store import Store, digest, point_key

SPEED, STATUS, CONVERGED, VALIDITY = "speed", "status", "converged", "validity"
MISSING = "not computed"
UNUSED = "not needed"  # places of a curve that chose fewer speeds than another


class Rows(NamedTuple):
    """What is known of a study: of each curve, by its key, rows of numbers by speed [m/s], in the order in which they
    were solved; and the keys of the curves that chose all their speeds."""

    points: dict[str, dict[float, dict[str, Any]]]
    ended: set[str]


def row_of(speed: float, outcome: Outcome) -> dict[str, Any]:
    """The numbers of a point by name, those of its uncertainty as ``uncertainty_<name>``, and in words its status and
    the assumptions that do not hold."""
    if not isinstance(outcome, FrictionResult):
        return {STATUS: f"{type(outcome).__name__}: {outcome}", SPEED: speed}
    numbers = {name: getattr(outcome, name) for name in NUMBERS}
    numbers |= {f"uncertainty_{n}": v for n, v in vars(outcome.uncertainty).items() if isinstance(v, float)}
    numbers |= zip(("uncertainty_low", "uncertainty_high"), outcome.uncertainty.interval)
    return {STATUS: outcome.report.status, VALIDITY: in_a_cell(outcome.validity), **numbers}


def stored_rows(store: Store, keys: Sequence[str], speeds: Sequence[float]) -> Rows:
    """The `Rows` that a store has of the curves ``keys`` at ``speeds`` [m/s], or at those that they chose (none)."""
    rows = Rows({key: {} for key in keys}, set())
    places = {point_key(key, u): (key, u) for key in rows.points for u in speeds}
    if not speeds:
        chosen = store.known({digest(key): key for key in rows.points})
        for key in rows.points:
            own, ended = chosen.get(digest(key), ((), False))
            places |= {point_key(key, u): (key, u) for u in own}
            if ended:
                rows.ended.add(key)
    known = store.known(places)
    for place, (key, speed) in places.items():
        if place in known:
            rows.points[key][speed] = row_of(speed, known[place])
        elif not speeds:
            rows.ended.discard(key)  # a record of it was damaged
    return rows
