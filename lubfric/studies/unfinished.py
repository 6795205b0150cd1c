"""What the store of a run keeps of its Stribeck curve: which speeds were requested, and which of them are solved."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..estimate import FrictionResult
from ..models.shared import Prepared
from ..scene import Scene
from .points import key_of
from .store import CHOSEN, OUTCOME, Store, digest, point_key
from .sweep import StribeckResult, curve_of

# Key of what was requested of a curve: its scene, the key of that, and the speeds [m/s], beside those that it chooses.
REQUEST = "curve"
REQUESTED = tuple[Scene, str, tuple[float, ...]]

# Fields with which a run keeps the points of its curve: none, or film and contact on cells for a picture.
KEPT_FIELDS: tuple[bool | str, ...] = (False, "fine")


@dataclass(frozen=True, kw_only=True)
class UnfinishedCurve:
    """The solved part of a curve.

    Attributes
    ----------
    curve : at the speeds that are solved, or failed
    requested : number of speeds of the complete curve; None where the curve chooses them
    """

    curve: StribeckResult
    requested: int | None

    @property
    def solved(self) -> int:
        """Number of the speeds that have an answer."""
        return len(self.curve.points) - len(self.curve.errors)

    @property
    def in_words(self) -> str:
        """How much of the curve is solved, as text."""
        if self.requested is None:
            return f"{self.solved} speeds are solved so far"
        return f"{self.solved} of {self.requested} speeds are solved"


def keep_request(folder: Path, prepared: Prepared, speeds: Sequence[float]) -> None:
    """Keep in the store ``folder`` what a run requests of its curve, with what interrupted runs of the scene requested;
    ``speeds`` [m/s], none: the curve chooses them."""
    store = Store(folder)
    (_, _, earlier) = store.get(REQUEST, REQUESTED) or (None, "", ())
    store.add(REQUEST, (prepared.scene, key_of(prepared), tuple(dict.fromkeys((*earlier, *speeds)))))


def is_all_solved(folder: Path) -> bool:
    """Return whether the store ``folder`` has all points that the runs of its scene requested."""
    store = Store(folder)
    (_, key, requested) = store.get(REQUEST, REQUESTED) or (None, "", ())
    (_, is_complete) = store.get(digest(key), CHOSEN) or ((), True)
    return is_complete and all(_has_point(store, key, speed) for speed in requested)


def count_of_kept(folder: Path, prepared: Prepared, speeds: Sequence[float]) -> int:
    """Return how many of the ``speeds`` [m/s] have a record in the store ``folder``."""
    store = Store(folder)
    key = key_of(prepared)
    return sum(_has_point(store, key, speed) for speed in speeds)


def _has_point(store: Store, key: str, speed: float) -> bool:
    return any(store.has(point_key(key, speed, fields=fields)) for fields in KEPT_FIELDS)


def unfinished_curve(folder: Path) -> UnfinishedCurve | None:
    """Return the curve in the store ``folder`` as far as it is solved; None where it has no point with an answer."""
    store = Store(folder)
    request = store.get(REQUEST, REQUESTED)
    if request is None:
        return None
    (scene, key, requested) = request
    (chosen, is_complete) = store.get(digest(key), CHOSEN) or ((), True)
    speeds = sorted({*requested, *chosen})
    outcomes = {}
    for speed in speeds:
        records = [store.get(point_key(key, speed, fields=fields), OUTCOME) for fields in KEPT_FIELDS]
        known = [record for record in records if record is not None]
        if known:
            outcomes[speed] = known[0]
    if not any(isinstance(outcome, FrictionResult) for outcome in outcomes.values()):
        return None
    curve = curve_of(list(outcomes), outcomes, scene)
    return UnfinishedCurve(curve=curve, requested=len(speeds) if is_complete else None)
