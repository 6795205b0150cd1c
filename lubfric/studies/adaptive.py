"""A Stribeck curve at speeds that it chooses itself, each from all that is solved so far."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..curve.choose import first_speeds, next_speed
from ..curve.interpolate import Samples
from ..prepared import Prepared
from ..steady import FrictionResult
from ..store import digest
from .chain import Chain, resumed, solved, start_from
from .journal import Journal, outcome_of, without_fields

MOST = 25  # speeds at most
FEWEST = 3  # solved speeds that an interpolation needs


@dataclass(frozen=True)
class Search:
    """What to solve. ``low``, ``high``: ends of the curve [m/s]; ``tolerance``: relative, on f between the points;
    ``wanted``: speeds [m/s] that must be among them, with their fields; ``name``: fingerprint of the prepared scene."""

    low: float
    high: float
    tolerance: float
    wanted: tuple[float, ...]
    name: str

    def chain(self, speeds: list[float]) -> Chain:
        """The chain of the speeds so far. Its keys hold the range and the tolerance, which decide on what follows."""
        keys, last = [], digest([self.name, self.low, self.high, self.tolerance, self.wanted])
        for speed in speeds:
            last = digest([last, speed])
            keys.append(last)
        return Chain(tuple(speeds), tuple(keys), tuple(speed in self.wanted for speed in speeds))


def run_adaptive(prepared: Prepared, search: Search, journal: Journal | None) -> Iterator[tuple[float, object]]:
    """Yield (speed, outcome) until the estimated error is within the tolerance, or 25 speeds are solved.

    Each speed starts from the one before. Points that the ``journal`` knows are taken from there: the choices, and so
    the rest, come out the same.
    """
    known = {} if journal is None else dict(journal.records.read())
    speeds: list[float] = []
    outcomes: list = []
    last = None  # the whole outcome before, where it was solved by this run
    ahead = sorted({*first_speeds(search.low, search.high).tolist(), *search.wanted}, reverse=True)
    while len(speeds) < MOST:
        speed = ahead.pop(0) if ahead else _next(speeds, outcomes, search)
        if speed is None:
            break
        speeds.append(float(speed))
        chain = search.chain(speeds)
        if journal is not None and chain.keys[-1] in known:
            outcome, last = _known(chain, journal, known), None
        else:
            outcome = last = _continued(prepared, chain, journal, last)
            outcome = outcome if chain.fields[-1] else without_fields(outcome)
        outcomes.append(outcome)
        yield speeds[-1], outcome
    if journal is not None and speeds:
        journal.end(search.chain(speeds).name)


def _known(chain: Chain, journal: Journal, known: dict):
    outcome = outcome_of(known[chain.keys[-1]])
    return journal.fields(chain.keys[-1]) or outcome if chain.fields[-1] else outcome


def _continued(prepared: Prepared, chain: Chain, journal: Journal | None, last):
    """The last point of ``chain``, whole, solved from the one before and kept."""
    at = len(chain.keys) - 1
    start = start_from(last)
    if journal is not None and last is None and at:
        start, caught_up = resumed(prepared, chain, journal, at)
        if caught_up is not None:
            return caught_up
    outcome = solved(prepared, chain, at, start)
    if journal is not None:
        journal.keep(chain.name, chain.keys[at], outcome, chain.fields[at])
    return outcome


def _next(speeds: list[float], outcomes: list, search: Search) -> float | None:
    good = [(u, o) for u, o in zip(speeds, outcomes) if isinstance(o, FrictionResult)]
    if len(good) < FEWEST:
        return None
    tried = [u for u, o in zip(speeds, outcomes) if not isinstance(o, FrictionResult)]
    return next_speed(samples_of([o for _, o in good]), search.tolerance, tried)[0]


def samples_of(points: list[FrictionResult]) -> Samples:
    """What an interpolation needs of solved points, by ascending speed."""
    points = sorted(points, key=lambda point: abs(point.speed))
    total = np.array([p.contact_load + p.film_load for p in points])
    boundary = np.array([p.boundary_force for p in points]) / total
    clearance = [np.nan if p.decision is None or p.decision.clearance is None else p.decision.clearance for p in points]
    return Samples(
        speed=np.array([abs(p.speed) for p in points]),
        boundary=np.maximum(boundary, 0.0),
        film=np.array([p.coefficient for p in points]) - boundary,
        touching=np.array([p.contact_load > 0 for p in points]),
        clearance=np.array(clearance, dtype=float),
    )
