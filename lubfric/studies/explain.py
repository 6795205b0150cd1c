"""What a study or a fit will take, before a point is solved: its points, and the time of one by the work counted on the
scene."""

import time
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from numbers import Real
from pathlib import Path
from textwrap import shorten
from typing import Any, TypeVar

from ..errors import InputError
from ..estimate import (
    PointWorkEstimate,
    WorkOfPoints,
    estimated_work_of_point,
    expected_of_sample,
    expected_violations,
    seconds_of_points,
)
from ..models import prepare, title_of
from ..models.shared import (
    Assumption,
    ExpectedEffect,
    Prepared,
    Violation,
    ends_of_alpha,
    expected_alpha_in_words,
    expected_effects,
    sentence,
    violations_by_unusual_inputs,
)
from ..quantities import counted, worded_value
from .choose import EXPECTED_SPEEDS, expected_speeds, first_speeds
from .conditions import comparison_in_words
from .operating_points import POINT
from .store import PLAN, Store
from .study_table import StudyTable

T = TypeVar("T")

# How well times are estimated: 93 % of 292 runs of verification.campaigns.estimates are within that; most of the
# constants were chosen with these in sight. Measured.
WITHIN_WORDS = "within a factor of 3 in four of five cases"

# The speed of a curve that chooses its speeds, in the place of one: a name.
NO_SPEED = None

# Processor time [s] of a point from which on a study says that it keeps no part of it. A choice: a shorter one is no
# loss.
LONG_POINT = 20.0

# Scenes of a study that are made ready to count their cells. A choice between time and what is seen.
SAMPLED = 8

# Values of a key that are named one by one. A choice, for a line that can be read.
LISTED = 4


def curve_seconds(prepared: Prepared, speeds: Sequence[float], *, has_new_map: bool = True) -> float:
    """Return the processor seconds of the points of a scene at ``speeds`` [m/s] (none: at those that it chooses),
    within a factor of about 3; ``has_new_map``: whether what the surface alone demands is still to be done."""
    return _curve_seconds(_estimated_points(_work_of(prepared), speeds), speeds, has_new_map=has_new_map)


def traction_seconds(models: Sequence[Prepared], speed: float, *, has_new_map: bool = True) -> float:
    """Return the processor seconds of points at ``speed`` [m/s] of scenes that differ in slip alone, ``models``, which
    share what those of one scene do; ``has_new_map``: as of `curve_seconds`."""
    points = [estimated_work_of_point(model.scene, model.sample, model.surface, speed) for model in models]
    return _curve_seconds(points, [speed], has_new_map=has_new_map)


def _curve_seconds(points: Sequence[PointWorkEstimate], speeds: Sequence[float], *, has_new_map: bool = True) -> float:
    """Return the processor seconds of the ``points`` of a scene; ``speeds``, ``has_new_map``: as of `curve_seconds`."""
    known = {part.what for point in points for part in point.shared if part.is_of_surface_alone and not has_new_map}
    return seconds_of_points(points, None if speeds else EXPECTED_SPEEDS, known)


def _work_of(prepared: Prepared) -> WorkOfPoints:
    return WorkOfPoints(prepared.scene, prepared.sample, prepared.surface)


def _estimated_points(work: WorkOfPoints, speeds: Sequence[float]) -> list[PointWorkEstimate]:
    """Return what the points of a scene at ``speeds`` [m/s] (none: at those that it chooses) will take."""
    return [work.at(speed) for speed in speeds or expected_speeds(work.scene, work.surface.sq)]


def estimated_study(plan: Any, store: str | Path | None = None) -> float:
    """Return the estimated processor seconds of the points of a `StudyPlan` that the folder ``store`` has not yet. Some
    of the maps are made."""
    table = StudyTable(plan)
    table.read(Store(store))
    return _left(plan, table).seconds


def warnings_of(plan: Any) -> list[str]:
    """Return the warnings on a `StudyPlan` that are known before the solve, in sentences: how plain numbers were read,
    and unusual values of its scenes. Nothing is made or solved."""
    violations = [violations_by_unusual_inputs(scene) for scene in plan.scenes]
    return [*(f"warning: {sentence(note)}" for note in plan.notes), *_in_sentences(violations, "scenes")]


def _in_sentences(violations: Sequence[Sequence[Violation]], plural: str) -> list[str]:
    """Return a sentence for each assumption that fails in ``violations`` (of each scene), with its smallest and largest
    value; ``plural``: the name of what there is one of for each of ``violations``."""
    groups: dict[tuple[str, str, bool, bool, bool], dict[int, Violation]] = {}
    for place, of_scene in enumerate(violations):
        for violation in of_scene:
            groups.setdefault(violation.kind, {})[place] = violation
    lines = []
    for group in groups.values():
        ordered = sorted(group.values(), key=lambda violation: violation.value)
        values = dict.fromkeys(violation.value_in_words for violation in (ordered[0], ordered[-1]))
        some = f"in {len(group)} of {len(violations)} {plural}: " if len(group) < len(violations) else ""
        texts = (
            {violation.consequence for violation in ordered},
            {violation.recommendation for violation in ordered},
        )
        worst = ordered[0 if ordered[0].is_below else -1]
        end = "smallest" if worst.is_below else "largest"
        where = (f"where it is {end}" if len(differing) > 1 else "" for differing in texts)
        limits = [violation.limit for violation in ordered]
        lines.append(f"{some}{worst.text_of(' to '.join(values) + worst.spaced_unit, *where, limits=limits)}")
    return lines


@dataclass(frozen=True, kw_only=True)
class Left:
    """What is left of a study, from some of its scenes.

    Attributes
    ----------
    seconds : estimated processor time [s]
    points : of each point by the key of its scene and its speed [m/s], in the order in which they are solved; of a
        curve that chooses its speeds with `NO_SPEED`
    models : number of the points of these scenes that each model is expected to answer, by its name
    failed : why some cannot be solved, in lines
    warnings : what is expected not to hold, but the unusual values (`warnings_of`), in sentences
    alpha : what the range of an estimated pressure-viscosity coefficient is expected to change at the points of the
        study, left or not, in words; "": nothing
    """

    seconds: float
    points: dict[tuple[str, Any], float]
    models: Counter[str]
    failed: list[str]
    warnings: list[str]
    alpha: str


def _left(plan: Any, table: StudyTable) -> Left:
    """Return what is left of a study."""
    left = [(plan.scenes[curve], key, speeds) for curve, key, speeds in sorted(table.left())]
    some = _some_of(left)
    seconds = 0.0
    models: Counter[str] = Counter()
    failed = []
    violations: list[tuple[Violation, ...]] = []
    made: dict[str, Prepared] = {}
    known: dict[tuple[str, Any], float] = {}
    for scene, key, speeds in some:
        try:
            begun = time.process_time()  # of the map, which takes its time as well
            prepared = prepare(scene)
            work = _work_of(prepared)
            points = _estimated_points(work, speeds)
            one = _curve_seconds(points, speeds) + time.process_time() - begun
            seconds += one * len(left) / len(some)
            known |= _seconds_of_each(key, points, one) if speeds else {(key, NO_SPEED): one}
            models.update(point.model.name for point in points)
            violations.append(_expected(prepared, speeds, points, work))
            made[key] = prepared
        except InputError as error:
            failed.append(f"  cannot be solved: {error}")
    all_scenes = len(plan.scenes)
    checked = "scenes" if len(violations) == all_scenes else f"scenes checked (of {all_scenes})"
    mean = sum(known.values()) / max(len(known), 1)
    places = [(key, speed) for _, key, speeds in left for speed in speeds or (NO_SPEED,)]
    each = {place: known.get(place, mean) for place in places}
    return Left(
        seconds=seconds,
        points=each,
        models=models,
        failed=failed,
        warnings=_in_sentences(violations, checked),
        alpha=expected_alpha_in_words(_effects_of_plan(plan, made)),
    )


def _some_of(scenes: Sequence[T]) -> Sequence[T]:
    """Return some of the ``scenes``, evenly spread, which are made ready."""
    return scenes[:: -(-len(scenes) // SAMPLED)] if scenes else []


def _effects_of_plan(plan: Any, made: dict[str, Prepared]) -> list[ExpectedEffect]:
    """Return the effects that are not modelled at some points of all of a ``plan``, so that a study that goes on states
    the same as before; ``made``: scenes that are ready, by their key."""
    scene_of_key = dict(zip(reversed(plan.keys), reversed(plan.scenes)))
    effects: list[ExpectedEffect] = []
    for key, speeds in _some_of(list(plan.requested.items())):
        if not ends_of_alpha(scene_of_key[key]):
            continue
        with suppress(InputError):  # a scene that cannot be solved is reported where it is left
            effects += _expected_effects(made.get(key) or prepare(scene_of_key[key]), speeds)
    return effects


def _seconds_of_each(key: str, points: Sequence[PointWorkEstimate], total: float) -> dict[tuple[str, Any], float]:
    """Return the processor seconds of each of the ``points`` of a scene with this ``key``, the first with what they
    share, such that they are ``total`` together."""
    alone = [point.seconds - sum(part.seconds for part in point.shared) for point in points]
    alone[0] += total - sum(alone)
    return {(key, point.speed): seconds for point, seconds in zip(points, alone)}


def _expected(
    prepared: Prepared, speeds: Sequence[float], points: Sequence[PointWorkEstimate], work: WorkOfPoints
) -> tuple[Violation, ...]:
    """Return what is expected not to hold of a scene at ``speeds`` [m/s] (none: at those that it chooses), but its
    unusual values; ``points``: the estimates of its points, of ``work``."""
    scene = prepared.scene
    solved_speeds = list(speeds) or list(first_speeds(scene, prepared.surface.sq))
    expected = expected_violations(scene, prepared.sample, prepared.surface, solved_speeds, work)
    known_before = {violation.assumption for violation in prepared.violations}
    of_sample = [
        pair for pair in expected_of_sample(scene, prepared.sample, points) if pair[1].assumption not in known_before
    ]
    known = (*prepared.violations, *(violation for _, violation in (*of_sample, *expected)))
    return tuple(violation for violation in known if violation.assumption != Assumption.USUAL_VALUES)


def _expected_effects(prepared: Prepared, speeds: Sequence[float]) -> Iterator[ExpectedEffect]:
    """Yield the effects that are not modelled of a scene at the lowest and the highest of ``speeds`` [m/s] (none: of
    those that it chooses)."""
    sq = prepared.surface.sq
    solved_speeds = speeds or first_speeds(prepared.scene, sq)
    for speed in {min(solved_speeds, key=abs), max(solved_speeds, key=abs)}:
        yield from expected_effects(prepared.scene, sq, speed)


def in_words(seconds: float) -> str:
    """Return a time in a suitable unit."""
    for unit, size in (("h", 3600.0), ("min", 60.0)):
        if seconds > 2 * size:
            return f"{float(f'{seconds / size:.2g}'):g} {unit}"
    return f"{float(f'{seconds:.2g}'):g} s"


def explain(plan: Any, store: Path | None = None, *, workers: int = 1) -> str:
    """Return the points of a `StudyPlan`, how many of them the folder ``store`` has already, and about how long the
    others will take on as many cores as there are ``workers``, as text. Some of the maps are made. No point is
    solved."""
    return explained(plan, store, workers=workers)[0]


def explained(
    plan: Any, store: Path | None = None, *, workers: int = 1, refuses: bool = False
) -> tuple[str, dict[tuple[str, Any], float], int]:
    """Return what `explain` does; the estimated processor seconds of each point that is left, as `Left.points`; and the
    number of points that the folder ``store`` has, identical ones counted once. With ``refuses`` raises `InputError` if
    no point can be solved."""
    about = "about " if plan.chooses_speeds else ""
    different = plan.points if plan.chooses_speeds else sum(map(len, plan.requested.values()))
    once = f", {different} of them different: identical ones are solved once" if different < plan.points else ""
    lines = [f"study of {plan.scene.name}: {about}{counted(plan.points, 'points')}{once}"]
    for axis in plan.axes:
        shown = "; ".join(f"{key} {_range(key, column)}" for key, column in zip(axis.keys, zip(*axis.values)))
        if axis.name == POINT:
            shown = "; ".join(filter(None, (shown, f"speed {_range('speed', plan.point_speeds)}")))
        lines.append(f"  {len(axis.values):6d} x {shown}")
    if plan.paired:
        lines.append(f"  other    inputs are those of the scene {plan.scene.name}")
    if plan.speeds:
        lines.append(f"  {counted(len(plan.speeds), 'speeds'):>13}: {_range('speed', plan.speeds)}")
    elif plan.chooses_speeds:
        lines.append(f"      about {EXPECTED_SPEEDS} speeds that each curve chooses")
    if plan.scene.transient is not None:
        lines.append("  steady   points only; the histories of the scene ([transient]) are ignored")
    if compared := comparison_in_words(plan):
        lines.append(f"  {compared}")
    table = StudyTable(plan)
    table.read(Store(store))
    held = len(table.ended) if plan.chooses_speeds else table.solved
    if held:
        total = len(plan.requested) if plan.chooses_speeds else sum(map(len, plan.requested.values()))
        what = "curves" if plan.chooses_speeds else "points"
        lines.append(f"  kept     {held} of {total} {what} are in {store} already")
    kept = Store(store)
    others = 0 if plan.chooses_speeds else kept.count - held - kept.has(PLAN)
    if others > 0:
        lines.append(
            f"  other    {counted(others, 'points')} of other scenes, or of another version of lubfric, are in "
            f"{store} too; they are not used"
        )
    if not any(True for _ in table.left()):
        lines += [f"  {text}" for text in warnings_of(plan)]
        return "\n".join([*lines, "  time     nothing is left to solve"]), {}, table.solved
    left = _left(plan, table)
    if refuses and not left.models and not held:
        _check_solvable(plan, table)
    lines += [f"  {text}" for text in (*warnings_of(plan), *left.warnings)]
    lines += [f"  interval {left.alpha}"] if left.alpha else []
    if left.models:
        checked = left.models.total()
        answers = (
            title_of(name) if count == checked else f"{title_of(name)} at {count} of {checked} points checked"
            for name, count in left.models.most_common()
        )
        lines.append(f"  model    {', '.join(answers)} (numerics.model = {plan.scene.numerics.model!r})")
    lines += [f"  {text}" for text in _time_in_words(left, workers, "curves" if plan.chooses_speeds else "points")]
    return "\n".join([*lines, *dict.fromkeys(left.failed)]), left.points, table.solved


def _check_solvable(plan: Any, table: StudyTable) -> None:
    """Raise `InputError` with the first reason if none of the scenes that are left can be made ready."""
    reasons = []
    for curve, _, _ in sorted(table.left()):
        try:
            prepare(plan.scenes[curve])
        except InputError as error:
            reasons.append(error)
        else:
            return
    raise InputError(f"no point of the study can be solved: {reasons[0]}") from reasons[0]


def _time_in_words(left: Left, workers: int, what: str) -> Iterator[str]:
    """Yield how long a study will take with so many ``workers``, and its parts (``what``, their plural), as text."""
    text = f"time     about {in_words(left.seconds)} on one core"
    longest = max(left.points.values())
    if workers > 1:
        text += f", {in_words(max(left.seconds / workers, longest))} with {workers} workers if each has a core"
    yield f"{text} ({WITHIN_WORDS})"
    if longest > LONG_POINT:
        ends = dict.fromkeys(in_words(seconds) for seconds in (min(left.points.values()), longest))
        kept = "an interrupted study keeps those that are solved, and no parts of others"
        yield f"each     of the {what} takes about {' to '.join(ends)}; {kept}"


def _range(key: str, values: tuple[Any, ...]) -> str:
    """Return the values of a key, each once: all if they are few, else the smallest and the largest, or first and last."""
    if len(values) > LISTED and all(isinstance(value, Real) for value in values):
        return " to ".join(dict.fromkeys(_range(key, (end,)) for end in (min(values), max(values))))
    words = list(dict.fromkeys(worded_value(key, v) for v in values))
    shown = words if len(words) <= LISTED else (words[0], "...", words[-1])
    return ", ".join(shorten(text, 50, placeholder="...") for text in shown)
