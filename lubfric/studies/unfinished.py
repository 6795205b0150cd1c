"""What the store of a run keeps of its Stribeck or traction curve: which points were requested, and which of them are
solved."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ..estimate import FrictionResult
from ..models.shared import Prepared
from ..scene import Scene
from .curve import CurveResult
from .points import Outcome, at_ratios, key_of
from .store import CHOSEN, OUTCOME, Store, digest, point_key
from .sweep import curve_of, traction_of

# Key of what was requested of a Stribeck curve: its scene, the key of that, and the speeds [m/s], beside those that it
# chooses.
REQUEST = "curve"
REQUESTED = tuple[Scene, str, tuple[float, ...]]

# Key of what was requested of a traction curve: its scene, the speed [m/s], the slide-roll ratios, and the key of each.
REQUEST_OF_RATIOS = "traction"
REQUESTED_RATIOS = tuple[Scene, float, tuple[float, ...], tuple[str, ...]]

# Fields with which a run keeps the points of its curve: none, or film and contact on cells for a picture.
KEPT_FIELDS: tuple[bool | str, ...] = (False, "fine")


@dataclass(frozen=True, kw_only=True)
class UnfinishedCurve:
    """The solved part of a curve.

    Attributes
    ----------
    scene : of the curve
    curve : at the speeds or slide-roll ratios that are solved, or failed
    requested : number of points of the complete curve; None where the curve chooses them
    """

    scene: Scene
    curve: CurveResult
    requested: int | None

    @property
    def solved(self) -> int:
        """Number of the points that have an answer."""
        return len(self.curve.points) - len(self.curve.errors)

    @property
    def in_words(self) -> str:
        """How much of the curve is solved, as text."""
        plural = self.curve.SWEPT[3]
        if self.requested is None:
            return f"{self.solved} {plural} are solved so far"
        return f"{self.solved} of {self.requested} {plural} are solved"


def keys_of_ratios(prepared: Prepared, ratios: Sequence[float]) -> dict[float, str]:
    """Return the keys of a prepared scene at each of the slide-roll ``ratios``."""
    return {ratio: key_of(model) for ratio, model in zip(ratios, at_ratios(prepared, ratios))}


def keep_request(folder: Path, prepared: Prepared, speeds: Sequence[float]) -> None:
    """Keep in the store ``folder`` what a run requests of its Stribeck curve, with what interrupted runs of the scene
    requested; ``speeds`` [m/s], none: the curve chooses them."""
    store = Store(folder)
    (_, _, earlier) = store.get(REQUEST, REQUESTED) or (None, "", ())
    store.add(REQUEST, (prepared.scene, key_of(prepared), tuple(dict.fromkeys((*earlier, *speeds)))))


def keep_ratios(folder: Path, scene: Scene, keys: Mapping[float, str]) -> None:
    """Keep in the store ``folder`` what a run requests of its traction curve of ``scene``, with what interrupted runs
    requested; ``keys``: of each slide-roll ratio (`keys_of_ratios`)."""
    store = Store(folder)
    (_, _, ratios, earlier) = store.get(REQUEST_OF_RATIOS, REQUESTED_RATIOS) or (None, 0.0, (), ())
    together = dict(zip(ratios, earlier)) | dict(keys)
    speed = scene.motion.entrainment_speed
    store.add(REQUEST_OF_RATIOS, (scene, speed, tuple(together), tuple(together.values())))


def is_all_solved(folder: Path) -> bool:
    """Return whether the store ``folder`` has all points that the runs of its scene requested."""
    store = Store(folder)
    (_, key, requested) = store.get(REQUEST, REQUESTED) or (None, "", ())
    (_, is_complete) = store.get(digest(key), CHOSEN) or ((), True)
    (_, speed, _, keys) = store.get(REQUEST_OF_RATIOS, REQUESTED_RATIOS) or (None, 0.0, (), ())
    points = [*((key, each) for each in requested), *((each, speed) for each in keys)]
    return is_complete and all(_has_point(store, *point) for point in points)


def count_of_kept(folder: Path, prepared: Prepared, speeds: Sequence[float], with_fields: Sequence[float] = ()) -> int:
    """Return how many of the ``speeds`` [m/s] (none: of those that the curve has chosen so far) have a record in the
    store ``folder``, with fields if they are among those ``with_fields``."""
    store = Store(folder)
    key = key_of(prepared)
    (chosen, _) = store.get(digest(key), CHOSEN) or ((), True)
    return sum(
        _has_point(store, key, speed, KEPT_FIELDS[speed in with_fields :]) for speed in dict.fromkeys(speeds or chosen)
    )


def count_of_kept_ratios(folder: Path, speed: float, keys: Mapping[float, str]) -> int:
    """Return how many slide-roll ratios have a record at ``speed`` [m/s] in the store ``folder``; ``keys``: of each of
    them."""
    store = Store(folder)
    return sum(_has_point(store, key, speed) for key in keys.values())


def _has_point(store: Store, key: str, speed: float, kept: Sequence[bool | str] = KEPT_FIELDS) -> bool:
    return any(store.has(point_key(key, speed, fields=fields)) for fields in kept)


def unfinished_curve(folder: Path) -> UnfinishedCurve | None:
    """Return the curve in the store ``folder`` as far as it is solved; None where it has no point with an answer."""
    store = Store(folder)
    if store.has(REQUEST_OF_RATIOS):
        return _unfinished_traction(store)
    request = store.get(REQUEST, REQUESTED)
    if request is None:
        return None
    (scene, key, requested) = request
    (chosen, is_complete) = store.get(digest(key), CHOSEN) or ((), True)
    speeds = sorted({*requested, *chosen})
    outcomes = {speed: outcome for speed in speeds if (outcome := _outcome(store, key, speed)) is not None}
    if not any(isinstance(outcome, FrictionResult) for outcome in outcomes.values()):
        return None
    curve = curve_of(list(outcomes), outcomes, scene)
    return UnfinishedCurve(scene=scene, curve=curve, requested=len(speeds) if is_complete else None)


def _unfinished_traction(store: Store) -> UnfinishedCurve | None:
    """Return the traction curve in ``store`` as far as it is solved; None where it has no point with an answer."""
    request = store.get(REQUEST_OF_RATIOS, REQUESTED_RATIOS)
    if request is None:
        return None
    (scene, speed, ratios, keys) = request
    known = {ratio: _outcome(store, key, speed) for ratio, key in sorted(zip(ratios, keys))}
    outcomes = {ratio: outcome for ratio, outcome in known.items() if outcome is not None}
    if not any(isinstance(outcome, FrictionResult) for outcome in outcomes.values()):
        return None
    curve = traction_of(list(outcomes), outcomes, speed)
    return UnfinishedCurve(scene=scene, curve=curve, requested=len(ratios))


def _outcome(store: Store, key: str, speed: float) -> Outcome | None:
    """Return the outcome of a point in ``store``; None where there is none."""
    records = (store.get(point_key(key, speed, fields=fields), OUTCOME) for fields in KEPT_FIELDS)
    return next((record for record in records if record is not None), None)
