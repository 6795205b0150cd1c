"""The chains of one curve, solved here or on an executor, from where an earlier run was cut."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from ..prepared import Prepared
from .chain import Chain, run_chain
from .journal import Journal, outcome_of
from .spread import spread


@dataclass(frozen=True)
class Part:
    """A chain as it is handed out. ``folder``: of the store, or None; ``done``: how many of its first points are
    solved."""

    chain: Chain
    folder: str | None
    done: int


def solve_chains(prepared: Prepared, chains: list, executor, store, keep: Callable) -> None:
    """Solve ``chains``, pairs of a `Chain` and the indices of its speeds. Every point that ends is given to
    ``keep(index, outcome)``.

    With a ``store``, the points found there come first.
    """
    folder = None if store is None else str(store)
    indices = {chain.name: run for chain, run in chains}
    known: dict[str, int] = {}

    def found(chain: Chain) -> Part:
        outcomes = [] if folder is None else _finished(folder, chain)
        for at in range(known.get(chain.name, 0), len(outcomes)):
            keep(int(indices[chain.name][at]), outcomes[at])
        known[chain.name] = max(len(outcomes), known.get(chain.name, 0))
        return Part(chain, folder, len(outcomes))

    parts = [found(chain) for chain, _ in chains]
    parts = [part for part in parts if part.done < len(part.chain.keys)]
    if executor is None:
        for part in parts:
            for at, outcome in _points(prepared, part):
                keep(int(indices[part.chain.name][at]), outcome)
        return
    for name, outcomes in spread(executor, partial(_solved, prepared), parts, lambda part: found(part.chain)):
        for at, outcome in outcomes:
            keep(int(indices[name][at]), outcome)


def _finished(folder: str, chain: Chain) -> list:
    """Outcomes of the first points of ``chain``, as far as a store holds them whole."""
    journal, outcomes = Journal(folder), []
    records = {key: record for key, record in journal.records.read() if key in chain.keys}
    for key, fields in zip(chain.keys, chain.fields):
        if key not in records:
            break
        outcome = outcome_of(records[key])
        if fields and not isinstance(outcome, Exception):
            outcome = journal.fields(key)
            if outcome is None:
                break
        outcomes.append(outcome)
    return outcomes


def _points(prepared: Prepared, part: Part):
    journal = None if part.folder is None else Journal(part.folder)
    try:
        yield from run_chain(prepared, part.chain, journal, part.done)
    finally:
        if journal is not None:
            journal.close()


def _solved(prepared: Prepared, part: Part) -> tuple[str, list]:
    return part.chain.name, list(_points(prepared, part))
