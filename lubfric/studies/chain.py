"""Speeds that are solved one after the other, each started from its neighbour. This is the smallest piece of work
that is handed out."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass

from ..errors import LubfricError, ValidityError
from ..prepared import Prepared
from ..result import FrictionResult
from ..steady import friction
from ..store import digest
from .journal import NOWHERE, Journal, without_fields


@dataclass(frozen=True)
class Chain:
    """Entrainment ``speeds`` [m/s] in the order in which they are solved, and the ``key`` of each point.

    A key is a hash of all that its point depends on: the input and the whole chain up to there, since every start
    depends on the point before it. ``fields``: whether film and contact of each point are kept. ``after``: the chain of
    one point from which the first one starts (None: it starts from nothing).
    """

    speeds: tuple[float, ...]
    keys: tuple[str, ...]
    fields: tuple[bool, ...]
    after: Chain | None = None

    @property
    def name(self) -> str:
        """Name of its state in a journal."""
        return self.keys[0]


def make_chain(fingerprint: str, speeds, fields=None, after: Chain | None = None) -> Chain:
    """The chain of ``speeds`` for an input of that ``fingerprint`` (`lubfric.store.fingerprint`)."""
    speeds = tuple(float(u) for u in speeds)
    kept = (False,) * len(speeds) if fields is None else tuple(bool(f) for f in fields)
    keys, last = [], fingerprint if after is None else after.keys[-1]
    for speed, keep in zip(speeds, kept):
        last = digest([last, speed, keep])
        keys.append(last)
    return Chain(speeds, tuple(keys), kept, after)


def run_chain(
    prepared: Prepared, chain: Chain, journal: Journal = NOWHERE, done: int = 0, before=None
) -> Iterator[tuple[int, object]]:
    """Yield (index, `FrictionResult` or `LubfricError`) for the points after the first ``done``. Each is kept in
    ``journal`` before.

    A point that fails leaves its error, and the next one begins cold. Every other exception is a fault of the program
    and is raised. The results are the same to the last bit wherever an earlier run was cut. ``before``: the whole
    outcome of ``chain.after``. Where it is None, that outcome is read or solved again when it is needed.
    """
    parent = os.getppid()
    if done:
        start, caught_up = resumed(prepared, chain, journal, done)
        if caught_up is not None:
            yield done, caught_up if chain.fields[done] else without_fields(caught_up)
            done += 1
    else:
        start = start_from(before if before is not None else _before(prepared, chain, journal))
    for index in range(done, len(chain.speeds)):
        outcome = solved_at(prepared, chain.speeds[index], start, chain.fields[index])
        start = start_from(outcome)
        if os.getppid() != parent:  # who asked for it is dead, and may have been started again
            return
        journal.keep(chain.name, chain.keys[index], outcome, chain.fields[index])
        yield index, outcome if chain.fields[index] else without_fields(outcome)
    journal.end(chain.name)


def first_outcome(prepared: Prepared, chain: Chain, journal: Journal = NOWHERE, done: int = 0):
    """The outcome of a chain of one point with all that others start from: read from ``journal``, or solved and kept
    there."""
    parent = os.getppid()
    key, outcome = journal.state(chain.name)
    if key != chain.keys[0]:
        outcome = solved_at(prepared, chain.speeds[0], None, chain.fields[0])
    if not done and os.getppid() == parent:
        journal.keep(chain.name, chain.keys[0], outcome, chain.fields[0])
    return outcome


def _before(prepared: Prepared, chain: Chain, journal: Journal):
    return None if chain.after is None else first_outcome(prepared, chain.after, journal, done=1)


def start_from(outcome) -> FrictionResult | None:
    """The result that a neighbour can start from, refused or not; None where there is none."""
    result = outcome.result if isinstance(outcome, ValidityError) else outcome
    return result if isinstance(result, FrictionResult) and result.starts else None


def solved_at(prepared: Prepared, speed: float, start: FrictionResult | None, fields: bool):
    """The result or error of one point."""
    try:
        return friction(prepared, speed, start=start, fields=fields)
    except LubfricError as error:
        return error


def resumed(prepared: Prepared, chain: Chain, journal: Journal, done: int):
    """What to go on with after ``done`` points: the start of the next point, and the outcome of the point whose
    record a kill had left out (or None)."""
    key, outcome = journal.state(chain.name)
    if done < len(chain.keys) and key == chain.keys[done]:
        journal.keep(chain.name, key, outcome, chain.fields[done])
        return start_from(outcome), outcome
    if key != chain.keys[done - 1] and done < len(chain.keys):  # the state is lost: solved again, to the same bits
        outcome = _before(prepared, chain, journal)
        for index in range(done):
            outcome = solved_at(prepared, chain.speeds[index], start_from(outcome), chain.fields[index])
    return start_from(outcome), None
