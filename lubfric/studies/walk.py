"""The unit of work of sweeps and studies: points that are solved in turn, each started from an earlier one."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

from ..scene import Scene
from ..sharing import Prepared
from .fingerprint import digest

MOST = 25  # points of a walk at most


@dataclass(frozen=True)
class Walk:
    """Points of one curve in the order in which they are solved.

    ``name``: hash of all that the first point depends on; ``speeds``: entrainment speeds [m/s], none if the walk
    chooses them on its way; ``wanted``: those whose film and contact are kept; ``index``: position of the curve along
    each axis of a study.
    """

    scene: Scene
    name: str
    speeds: tuple[float, ...]
    wanted: frozenset[float] = frozenset()
    index: tuple[int, ...] = ()

    @cached_property
    def keys(self) -> tuple[str, ...]:
        """The key of each point: a hash of all that it depends on, including the points before it. If speeds are
        chosen, as many keys as there can be points."""
        if not self.speeds:
            return chosen_keys(self.marks[0])
        found, last = [], self.name
        for speed in self.speeds:
            last = digest([last, speed, speed in self.wanted])
            found.append(last)
        return tuple(found)

    @property
    def marks(self) -> tuple[str, ...]:
        """The keys that a store contains when the walk has ended."""
        return self.keys if self.speeds else (digest([self.name, "complete"]),)

    def ended(self, known) -> bool:
        """Whether the keys ``known`` include all its points."""
        return all(mark in known for mark in self.marks)


@dataclass(frozen=True)
class Batch:
    """Walks on one height map, as a process receives them.

    ``leader`` is made ready first, unless it is given ``prepared``; the others reuse its map. ``folder``: of the store,
    or None; ``known``: records of their points that the store has; ``before``: the outcome from which the first point
    of each starts, or None.
    """

    leader: Scene
    walks: tuple[Walk, ...]
    prepared: Prepared | None = None
    folder: str | None = None
    known: dict[str, dict] = field(default_factory=dict)
    before: object = None

    @property
    def name(self) -> str:
        """Name of its mark in a journal."""
        return self.walks[0].keys[0]

    def with_known(self, records: dict[str, dict]) -> Batch:
        """The batch with the ``records`` of those walks that have not ended."""
        known: dict[str, dict] = {}
        for walk in self.walks:
            if walk.ended(records):
                known |= dict.fromkeys(walk.marks, {})
            else:
                known |= {key: records[key] for key in walk.keys if key in records}
        return replace(self, known=known)


def chosen_keys(mark: str) -> tuple[str, ...]:
    """The keys of the points of a walk that chooses its speeds, from the key that marks its end."""
    return tuple(digest([mark, at]) for at in range(MOST))
