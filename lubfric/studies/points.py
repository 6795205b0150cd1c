"""The unit of work of curves, studies and fits: points of one scene, solved or found in a store, and their rows of
numbers. A point is a function of its scene and speed alone, so one process or many, in any order, in one call or
several, give the same bits."""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..errors import InputError, LubfricError, ValidityError
from ..estimate import FrictionResult, Uncertainty, friction, row_of_uncertainty
from ..models import prepare, prepare_on_maps
from ..models.shared import (
    IN_INTERVAL,
    SAMPLING_ERROR,
    Assumption,
    Prepared,
    Violation,
    standard_error_in_words,
    student,
    violations_by_model_error,
)
from ..quantities import NUMBERS
from ..samples import is_measured, whole_maps
from ..scene import Numerics, Scene
from .choose import chosen, each_once, first_speeds
from .operating_points import INTERVAL_COLUMNS
from .store import OUTCOME, Store, digest, fingerprint_without_files, is_shared, point_key

Outcome = FrictionResult | LubfricError
SPEED = "speed"
STATUS = "status"
MODEL = "model"
CONVERGED_COLUMN = "converged"
VALIDITY = "validity"
VIOLATIONS = "violations"
MISSING = "not computed"
BY_MODEL_TOLERANCE = "numerics.model_tolerance sets this limit"
UNUSED = "not needed"  # places of a curve that chose fewer speeds than another


def solved(
    scene: Scene | Prepared,
    key: str,
    speeds: Sequence[float],
    kept: frozenset[float] = frozenset(),
    folder: str | Path | None = None,
    *,
    fine_fields: bool = False,
    warns: bool = True,
) -> Iterator[tuple[str, float, Outcome | None]]:
    """Yield (key, speed, outcome) of each point of a scene, when it is in the store. A point that fails has its error
    as outcome. If the scene cannot be made ready, that is the error of all.

    Parameters
    ----------
    key : of the scene (`key_of`)
    speeds : [m/s]; none: the curve chooses them, and ends with the outcome None
    kept : speeds at which film and contact are kept, which chosen ones include
    folder : of the store, or None
    fine_fields : whether these are on cells fine enough to look at
    warns : whether records that do not count are reported; a study has reported them when it read its store
    """
    store = Store(folder if is_shared(folder) else None)
    store.gathers_faults = not warns
    done: tuple[float, ...] = ()
    model: Prepared | LubfricError
    try:
        model = scene if isinstance(scene, Prepared) else _prepared_as_planned(scene, key)
        first = speeds or sorted(each_once((*kept, *first_speeds(model.scene, model.surface.sq))), reverse=True)
    except LubfricError as error:
        model = error
        first = speeds or (math.nan,)

    def solve(speed: float) -> Outcome:
        fields: bool | str = speed in kept
        if fields and fine_fields:
            fields = "fine"
        key_of_point = point_key(key, speed, fields=fields)
        outcome = store.get(key_of_point, OUTCOME)
        if outcome is None and not fields:
            with_fields = store.get(point_key(key, speed, fields="fine"), OUTCOME)  # it has the same numbers
            outcome = with_fields.without_fields() if isinstance(with_fields, FrictionResult) else None
        if outcome is None:
            outcome = model if isinstance(model, LubfricError) else outcome_of(model, speed, fields=fields)
            if not isinstance(outcome, MapError):  # its file may be there again, next time
                store.add(key_of_point, outcome)
        return outcome

    choosing = chosen(model, first, solve) if isinstance(model, Prepared) and not speeds else None
    for speed, outcome in choosing or ((speed, solve(speed)) for speed in first):
        done = (*done, speed)
        if not speeds and not isinstance(model, MapError):
            store.add(digest(key), (done, False))
        yield key, speed, outcome
    if not speeds:
        if not isinstance(model, MapError):
            store.add(digest(key), (done, True))
        yield key, math.nan, None


def solved_together(
    tasks: Sequence[tuple[Scene, str, tuple[float, ...]]], folder: str | Path | None = None
) -> Iterator[Any]:
    """Yield what `solved` yields of each of the ``tasks`` (scene, key, speeds)."""
    for scene, key, speeds in tasks:
        yield from solved(scene, key, speeds, folder=folder, warns=False)


def outcome_of(prepared: Prepared, speed: float, *, fields: bool | str = False) -> Outcome:
    """Return the result of `lubfric.friction`, or the `LubfricError` that it raised; without ``fields`` unless they are
    requested."""
    try:
        point = friction(prepared, speed, fields=fields)
        return point if fields else point.without_fields()
    except ValidityError as error:
        result = None if error.result is None else error.result.without_fields()
        return ValidityError(error.message, error.violations, result)
    except LubfricError as error:
        return error


class MapError(InputError):
    """The file of a height map cannot be read, or is another than when the study was planned."""


def _prepared_as_planned(scene: Scene, key: str) -> Prepared:
    """Return ``scene`` made ready. Raises `MapError` unless its files hold the maps that the ``key`` of its plan was
    made of."""
    if not is_measured(scene):
        return prepare(scene)
    try:
        read = whole_maps(scene)
    except LubfricError as error:
        raise MapError(str(error)) from None
    if scene_key(scene, digest(read)) != key:
        names = " and ".join(str(rough.file) for rough in (scene.surface, scene.counterface) if rough and rough.file)
        message = f"{names} has changed since the study was planned"
        raise MapError(message, recommendation="plan the study again, in another folder if both maps are wanted")
    return prepare_on_maps(scene, read)


def scene_key(scene: Scene, maps: str | None) -> str:
    """Return the key of a ``scene``: a hash of all that its points depend on in addition to the speed. ``maps``: the
    digest of the maps that were read for it; None where they are generated."""
    return fingerprint_without_files(scene, maps)


def key_of(prepared: Prepared) -> str:
    """Return the key of a scene that was made ready: a hash of the scene, and of the heights and the contact where
    these were read from a file or given to `lubfric.prepare`."""
    if prepared.is_given_or_measured:
        return fingerprint_without_files(prepared)
    return scene_key(prepared.scene, None)


def at_ratios(base: Prepared, ratios: Iterable[float]) -> list[Prepared]:
    """Return ``base`` at each of the slide-roll ``ratios``, on the same map."""
    return [prepare(base.scene.with_(motion={"slide_roll_ratio": ratio}), like=base) for ratio in ratios]


def row_of(speed: float, outcome: Outcome, numerics: Numerics) -> dict[str, Any]:
    """Return the numbers of a point by name, those of its uncertainty among them, its status and its model as text and
    the assumptions that do not hold, by the ``numerics`` of its study."""
    if not isinstance(outcome, FrictionResult):
        return {STATUS: f"{type(outcome).__name__}: {outcome}", SPEED: speed}
    numbers = {name: getattr(outcome, name) for name in NUMBERS}
    numbers |= row_of_uncertainty(outcome.uncertainty)
    numbers |= zip(INTERVAL_COLUMNS["power_loss"], outcome.power_loss_interval)
    notes = (*_missed_sampling_tolerance(outcome.uncertainty), *_accepted_model_error(outcome, numerics))
    violations = (*outcome.validity, *notes)
    return {STATUS: outcome.report.status, MODEL: outcome.decision.model, VIOLATIONS: violations, **numbers}


def _missed_sampling_tolerance(uncertainty: Uncertainty) -> Iterator[Violation]:
    """Yield a note if the sampling error of f is above its tolerance, both at 95 %. A single point has it among the
    notes of its ``uncertainty``; a table has it among the assumptions that do not hold, as the numerical error."""
    if uncertainty.misses_sampling_tolerance:
        times = uncertainty.area_needed
        at_95 = student(uncertainty.freedom)
        yield Violation(
            assumption=Assumption.SAMPLING_ERROR,
            what=SAMPLING_ERROR,
            is_note=True,
            value=100 * at_95 * uncertainty.sampling,
            limit=100 * at_95 * uncertainty.tolerance,
            unit="%",
            consequence=f"{standard_error_in_words(uncertainty.tolerance)} sets this limit; the interval of f includes it",
            recommendation=f"give a map of about {times:.2g} times the area" if times > 1 else "",
            effect=at_95 * uncertainty.sampling,
        )


def _accepted_model_error(point: FrictionResult, numerics: Numerics) -> Iterator[Violation]:
    """Yield a note if the model-form error of f is above its target and no warning of the ``point`` says so, as where
    the scene names the model."""
    if any(violation.assumption == Assumption.MODEL_FORM_ERROR for violation in point.validity):
        return
    is_named = numerics.model != "auto"
    has_interval = math.isfinite(point.uncertainty.interval[0])
    for violation in violations_by_model_error(
        point.uncertainty.model,
        tolerance=numerics.model_tolerance,
        f=point.coefficient,
        has_interval=has_interval,
    ):
        yield replace(
            violation,
            is_note=True,
            consequence=f"{BY_MODEL_TOLERANCE}; {IN_INTERVAL[has_interval]}",
            recommendation="set numerics.model = 'auto' for the cheapest model within this limit" if is_named else "",
        )
