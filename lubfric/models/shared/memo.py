"""What a prepared scene remembers between speeds: contacts, operators and reference points, by typed keys.

A value depends on the prepared scene and its key alone. Its work is counted at each use, also where it is not made
again, because the work that a point has left decides what it solves. So the memory changes the time of a point, never
its result.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass
from typing import Any, ClassVar, Generic, TypeVar

from ..._base import count_work, with_its_work, work_left
from ...contact import ContactResult, HalfSpace, HalfSpaceContact, RoughContact
from ...scene import Scene
from ...surface import Surface

T = TypeVar("T")

# Contacts, operators and reference points that are remembered, at most. Half and twice as many change no time by more
# than 8 %.
MOST_ENTRIES = 256

# Cells of all entries but the last, at most, for memory: 64 MB of heights. Half and twice as many change no time by
# more than 8 %.
MOST_MEMO_CELLS = 8_000_000


class Key(Generic[T]):
    """What is remembered: a frozen dataclass. ``T``: the type of what is remembered under it."""

    # Whether it holds for scenes of the same surface and elastic bodies with another speed, lubricant or tolerance.
    is_shared_between_scenes: ClassVar[bool]


@dataclass(frozen=True)
class JoinedKey(Key[RoughContact]):
    """The contact on the first ``count`` strips, joined, on cells of this ``coarsening``."""

    is_shared_between_scenes = True
    coarsening: tuple[int, int]
    count: int


@dataclass(frozen=True)
class StripKey(Key[HalfSpaceContact]):
    """The contact on strip ``index`` alone, on cells of this ``coarsening``."""

    is_shared_between_scenes = True
    coarsening: tuple[int, int]
    index: int


@dataclass(frozen=True)
class PieceMapKey(Key[Surface]):
    """The map of piece ``index``, some ``length`` correlation lengths long, on native cells; ``strip_coarsening``:
    length of the cells of the strips, in native ones."""

    is_shared_between_scenes = True
    strip_coarsening: tuple[int, int]
    index: int
    length: float


@dataclass(frozen=True)
class PieceKey(Key[HalfSpaceContact]):
    """The contact on piece ``index``, on cells of this ``coarsening``, beside strips on cells of the
    ``strip_coarsening``."""

    is_shared_between_scenes = True
    strip_coarsening: tuple[int, int]
    index: int
    length: float
    coarsening: tuple[int, int]


@dataclass(frozen=True)
class OperatorKey(Key[HalfSpace]):
    """The half-space operator of a grid, on bodies of this E'."""

    is_shared_between_scenes = True
    shape: tuple[int, int]
    spacing: tuple[float, float]
    e_prime: float


@dataclass(frozen=True, kw_only=True)
class DryContactKey(Key[ContactResult]):
    """A contact without fluid: the digest of its ``rigid_gap``, the arguments of `lubfric.solve_contact`, and
    `HalfSpace.identity` of its operator."""

    is_shared_between_scenes = True
    rigid_gap: bytes
    mean_pressure: float
    hardness: float | None
    operator: tuple[Hashable, ...]
    tolerance: float


@dataclass(frozen=True, kw_only=True)
class BalanceKey(Key[Any]):
    """A balance of a ``scene`` at a fixed slide-roll ratio, from which those at other speeds and ratios start, on cells
    of this ``coarsening``; ``at``: the expected film [Sq] of its fixed speed; ``is_forward``: whether that is
    positive."""

    is_shared_between_scenes = True
    scene: Scene
    coarsening: tuple[int, int]
    at: float
    is_forward: bool


@dataclass(frozen=True, kw_only=True)
class CellEffectKey(Key[Any]):
    """The effect of shorter cells at a fixed ``speed`` [m/s], on cells of this ``coarsening``."""

    is_shared_between_scenes = False
    coarsening: tuple[int, int]
    speed: float


@dataclass(frozen=True, kw_only=True)
class ShorterCellsKey(Key[Any]):
    """The change by shorter cells than of this ``coarsening`` at a fixed speed: ``step``, its number in ln of the
    expected film; ``is_forward``: whether it is positive."""

    is_shared_between_scenes = False
    coarsening: tuple[int, int]
    step: int
    is_forward: bool


@dataclass(frozen=True, kw_only=True)
class AttenuatedSummitsKey(Key[Any]):
    """The attenuated summits of strips on cells of this ``coarsening``, which depend on no speed."""

    is_shared_between_scenes = False
    coarsening: tuple[int, int]


def numbers_of_fields(contact: ContactResult | None) -> int:
    """Return how many numbers the fields of a dry ``contact`` have, each of which counts as a cell; 0 without one."""
    return 0 if contact is None else contact.pressure.size + contact.gap.size + contact.displacement.size


@dataclass(frozen=True, kw_only=True)
class MemoEntry:
    """What was made: ``value``, its number of ``cells``, and the ``work`` [s] that was counted for it."""

    value: Any
    cells: int
    work: float


class Memo:
    """What was made so far, by `Key`; the oldest goes first. One that is pickled is empty."""

    def __init__(self) -> None:
        self._kept: dict[Key[Any], MemoEntry] = {}
        self._of_surface: Memo | None = None

    def __reduce__(self) -> tuple[type[Memo], tuple[()]]:
        return Memo, ()

    def get(self, key: Key[T], make: Callable[[], T], cells: Callable[[T], int] = lambda value: 0) -> T:
        """Return what ``make`` gives, made once for ``key``, and kept as long as there is room for its ``cells``.

        Its work is counted at each use. Where the caller has less left, it is made again, so that the limit ends it at
        the same step (`WorkLimitError`), which is not remembered.
        """
        if key.is_shared_between_scenes and self._of_surface is not None:
            return self._of_surface.get(key, make, cells)
        entry = self._kept.get(key)
        if entry is not None and entry.work <= work_left():
            count_work(entry.work)
            self._kept[key] = self._kept.pop(key)  # the youngest
            value: T = entry.value
            return value
        value, work = with_its_work(make)
        self.put(key, value, cells(value), work)
        return value

    def put(self, key: Key[T], value: T, cells: int = 0, work: float = 0.0) -> None:
        """Keep ``value``, which has so many ``cells`` and took so much counted ``work`` [s]."""
        if key.is_shared_between_scenes and self._of_surface is not None:
            self._of_surface.put(key, value, cells, work)
            return
        self._kept[key] = MemoEntry(value=value, cells=cells, work=work)
        entries = list(self._kept.items())
        while len(entries) > MOST_ENTRIES or sum(entry.cells for _, entry in entries[:-1]) > MOST_MEMO_CELLS:
            self._kept.pop(entries.pop(0)[0], None)

    def share_surface_of(self, other: Memo) -> None:
        """Share with ``other``, and with all that share with it, what depends on the surface and the elastic bodies
        alone, or has all else in its key."""
        self._of_surface = other if other._of_surface is None else other._of_surface
