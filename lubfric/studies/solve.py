"""The chains of one curve, solved here or on an executor, from where an earlier run was cut."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from ..prepared import Prepared
from .chain import Chain, first_outcome, run_chain
from .journal import Journal, outcome_of, without_fields
from .spread import spread


@dataclass(frozen=True)
class Part:
    """A chain as it is handed out.

    ``folder``: of the store, or None; ``done``: how many of its first points are solved; ``before``: the outcome that
    its first point starts from.
    """

    chain: Chain
    folder: str | None
    done: int
    before: object = None

    @property
    def left(self) -> bool:
        """Whether points of it remain to be solved."""
        return self.done < len(self.chain.keys)


class Kept:
    """The points of each chain that ``keep(index, outcome)`` was told of. ``indices``: those of the speeds, by name
    of chain."""

    def __init__(self, indices: dict, folder: str | None, keep: Callable):
        self._indices, self._folder, self._keep = indices, folder, keep
        self._told = dict.fromkeys(indices, 0)

    def tell(self, name: str, at: int, outcome) -> None:
        """Point number ``at`` of a chain has ended."""
        if at == self._told[name]:
            self._told[name] += 1
            self._keep(int(self._indices[name][at]), outcome)

    def read(self, chain: Chain, before=None) -> Part:
        """Tell what the store holds of ``chain``. Returns what is left of it."""
        told = self._told[chain.name]
        for at, outcome in enumerate(_finished(self._folder, chain, told), told):
            self.tell(chain.name, at, outcome)
        return Part(chain, self._folder, self._told[chain.name], before)


def solve_chains(prepared: Prepared, first: Chain, chains: list, executor, store, keep: Callable) -> None:
    """Solve the chain ``first``, which has one point, then the ``chains`` that start from it. Every point that ends is
    given to ``keep(index, outcome)``.

    ``chains``: pairs of a `Chain` and the indices of its speeds, ``first`` among them. With a ``store``, the points
    found there come first. Points that a process of the ``executor`` puts there are told while it goes on.
    """
    folder = None if store is None else str(store)
    kept = Kept({chain.name: run for chain, run in chains}, folder, keep)
    lead, *parts = [kept.read(chain) for chain in (first, *(chain for chain, _ in chains if chain is not first))]
    parts = [part for part in parts if part.left]
    before = None
    if lead.left or any(not part.done for part in parts):
        (before,) = spread(executor, partial(_first, prepared), [lead], lambda part: kept.read(part.chain))
        kept.tell(first.name, 0, before if first.fields[0] else without_fields(before))
    parts = [part if part.done else Part(part.chain, folder, 0, before) for part in parts]
    if executor is None:
        for part in parts:
            for at, outcome in _points(prepared, part):
                kept.tell(part.chain.name, at, outcome)
    else:
        _spread(prepared, parts, executor, kept, before)
    Journal(folder).end(first.name)


def _spread(prepared: Prepared, parts: list[Part], executor, kept: Kept, before) -> None:
    def look() -> None:
        for part in parts:
            kept.read(part.chain)

    work = partial(_solved, prepared)
    again = partial(kept.read, before=before)
    for name, outcomes in spread(executor, work, parts, lambda part: again(part.chain), look):
        for at, outcome in outcomes:
            kept.tell(name, at, outcome)


def _finished(folder: str | None, chain: Chain, told: int) -> list:
    """Outcomes of the first points of ``chain`` from number ``told`` on, as far as a store holds them whole."""
    journal, outcomes, keys = Journal(folder), [], chain.keys[told:]
    records = {key: record for key, record in journal.records().items() if key in keys}
    for key, fields in zip(keys, chain.fields[told:]):
        if key not in records:
            break
        outcome = outcome_of(records[key])
        if fields and not isinstance(outcome, Exception):
            outcome = journal.fields(key)
            if outcome is None:
                break
        outcomes.append(outcome)
    return outcomes


def _first(prepared: Prepared, part: Part):
    with Journal(part.folder) as journal:
        return first_outcome(prepared, part.chain, journal, part.done)


def _points(prepared: Prepared, part: Part):
    with Journal(part.folder) as journal:
        yield from run_chain(prepared, part.chain, journal, part.done, part.before)


def _solved(prepared: Prepared, part: Part) -> tuple[str, list]:
    return part.chain.name, list(_points(prepared, part))
