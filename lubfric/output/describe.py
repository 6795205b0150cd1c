"""A scene as text: its inputs with their units, regime numbers, and what will be solved."""

import math
import textwrap
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field

import numpy as np

from ..errors import InputError, LubfricError
from ..estimate import (
    NOT_MEASURED,
    FrictionResult,
    PointWorkEstimate,
    WorkOfPoints,
    estimated_work_of_point,
    expected_of_sample,
    expected_violations,
    seconds_of_points,
)
from ..models import (
    ALL_TOUCH,
    AUTO,
    FEW_TOUCH,
    NONE_TOUCHES,
    MeasuredTime,
    model_named,
    models_up_to,
    prepare_on_sample,
)
from ..models.shared import (
    Assumption,
    ExpectedEffect,
    Violation,
    beforehand,
    effect_in_words,
    expected_alpha_of_scene,
    expected_coefficient,
    expected_effects,
    gathered,
    inlet_at,
    percent,
    student,
    violations_by_form,
    violations_by_strips,
    violations_by_unusual_inputs,
)
from ..quantities import counted
from ..samples import Sample, check_map, sample_of
from ..scene import UNITS_OF_HISTORIES, Constant, Scene, has_moving_roughness, hint_unusual_values, sampled_times
from ..studies import WITHIN_WORDS, expected_speeds, gaps_of, in_words
from ..surface import Surface, correlation_length, rms_slope
from ..time import (
    STANDS_STILL,
    EffectOverTime,
    RunEstimate,
    check_run,
    estimated_run,
    expected_effects_of_run,
    expected_violations_of_run,
    first_largest,
    may_move_roughness,
    periods,
    run_model_of,
    scene_at,
    speeds_of_run,
    strip_of_run,
    way_to_motion_in_time,
    without_steady_film,
)
from ..units import as_beside, converted, worded
from .inputs import FACTS, input_rows
from .regime import FULL_FILM_LAMBDA
from .rolling_part import SMALL_ROLLING_PART, rolling_part

# Part of the largest f by which f may be above the line between two ratios, from which on this is stated before the
# solve [-]. A choice: the closed form does not know f better.
WIDE_GAP = 0.1

# Speeds of many at which the work is counted, about. A choice: fewer take less time, and estimate worse.
SOME = 25

# Speeds in the table, about. A choice: more fills the screen.
TABLE_SPEEDS = 6

# Processor time [s] of a strip of moving roughness above which `info` measures its first steps. A choice: of a shorter
# one that takes as long as the answer.
MEASURED_FROM = 3.0

# Ratio of two speeds [-] from which on the time is measured at both. A choice: of contacts with moving roughness at a
# speed and at a tenth of it (verification/campaigns/rolling_work) the logarithms of the measured work over the expected
# one correlate by 0.5 alone.
MEASURED_AT_ONE = 3.0

# How well a time is known that is measured on the first steps of a strip. Measured: 8 of 11 runs of the campaign of
# estimates from number 20000 on (all within 3, five are in the table); the strips and moments that the sample needs are
# left open.
WITHIN_MEASURED = "within a factor of 2 in three of four cases"

# Characters of a heading that is not broken. A choice, by looking at the table.
LEAST_HEADING = 7

TABLE_CAPTION = "estimate with closed forms: full-load film, asperity contact, and cost"
# Sections of ``lubfric info`` before and after that table: first what a user looks for.
BEFORE_TABLE = ("model", "transient", "validity")
AFTER_TABLE = ("bodies", "lubricant", "motion", "surface", "contact", "effects not modelled")
# Processor seconds of ``lubfric run`` beside its solves: 1.0 to start, and those of pictures and files. Measured on the
# runs of `verification.campaigns.estimates`.
COMMAND_SECONDS = 2.4
# Processor seconds of pictures and files, of these. Measured, as these.
FILES_SECONDS = 1.4
# Processor seconds of a measured map before the first solve, for its file and for each cell of what is used of it.
# Fitted to three files of instruments, of .06 to .4 million cells, as a patch and as strips, whose continuation has up
# to 16 million: they take .09 to .45 s and 15 s, estimated to .6 to 2.4 times that, and three other maps to .6 to 1.9
# times.
FILE_SECONDS = 0.2
FILE_CELL_SECONDS = 9.5e-7
# Whether asperities touch, by the estimate.
ASPERITIES = {ALL_TOUCH: "yes", FEW_TOUCH: "few or none", NONE_TOUCHES: "no"}
# Processor time [s] of what a run solves before its first step, up to which `info` solves how many strips it has. A
# choice: longer than that no one waits.
MOST_START_SECONDS = 10.0

# Relative difference of two speeds or slide-roll ratios that are the same but for rounding. A choice: any number
# between rounding and a digit that a user writes does.
SPEED_ROUNDING = 1e-9
# Part of the largest speed of a run below which a speed is that of a standstill: frequencies are written with nine
# digits. A choice: any number between rounding and a speed does.
STANDSTILL_PART = 1e-8


@dataclass(frozen=True, kw_only=True)
class SceneEstimate:
    """What is known of a scene before it is solved.

    Attributes
    ----------
    sections : lines on "transient" (what changes in time), "surface", "contact", "model", "effects not modelled",
        "validity"
    cost : the time that it will take, as text; "" where it is not known
    seconds : processor time of the solves and, without a run in time, of measured maps before them
    point_seconds : that of each point by its speed [m/s], or by its slide-roll ratio; {} of a run in time
    command_seconds : processor time of ``lubfric run``, with its start, pictures and files
    table : of some speeds, their headings first: expected film, whether it separates the surfaces, what the sample
        costs
    refusals : assumptions that fail by what is known so far, so that f means nothing, or may mean nothing
    severe : those of them for which 'lubfric run' certainly refuses a result
    effects : effects that are not modelled (`lubfric.models.shared.expected_effects`); () of a run in time
    effects_over_time : the same of a run in time, each at the moment at which it is largest; () of any other scene
    run : steps and time of a run in time; None of any other scene
    """

    sections: dict[str, list[str]]
    cost: str
    seconds: float
    command_seconds: float
    table: list[tuple[str, ...]]
    refusals: list[str]
    severe: tuple[Violation, ...]
    effects: tuple[ExpectedEffect, ...]
    effects_over_time: tuple[EffectOverTime, ...] = ()
    run: RunEstimate | None = None
    point_seconds: Mapping[float, float] = field(default_factory=dict)


def rolling_in_words(point: FrictionResult) -> str:
    """Return how much of the power loss of ``point`` is rolling resistance, of which film, and its error at 95 %, as
    text to be appended; "" for a small part."""
    rolling = float(rolling_part(point.rolling_resistance, point.speed))
    if not rolling > SMALL_ROLLING_PART * abs(point.power_loss):
        return ""
    part = as_beside(rolling, point.power_loss, *point.power_loss_interval, unit="W")
    (low, high) = point.rolling_resistance_interval
    error = 0.5 * (high - low) / abs(point.rolling_resistance)
    size = f"± {percent(error)}" if math.isfinite(error) else ""
    facts = ", ".join(filter(None, (size, point.decision.rolling_in_words)))
    return f", of which {part} is rolling resistance{f' ({facts})' if facts else ''}"


def describe_scene(scene: Scene, speeds: Sequence[float] | str = ()) -> str:
    """Return inputs, regime numbers (Hertz, Moes M and L, lambda at its speeds) and the plan, as text. Nothing is
    solved. ``speeds`` [m/s]: instead of those of the scene; "auto": about those that a curve would choose."""
    return described_scene(scene, speeds)[0]


def described_scene(
    scene: Scene, speeds: Sequence[float] | str = (), ratios: Sequence[float] = (), *, measures: bool = False
) -> tuple[str, SceneEstimate]:
    """Return the text of `describe_scene`, and what it states; of a traction curve at the slide-roll ``ratios``.
    ``measures``: as of `estimate_scene`."""
    with hint_unusual_values(scene):
        if scene.transient is not None:
            check_run(scene)
        sample = sample_of(scene)
        surface = sample.stated_map()
        check_map(scene, surface, sample.maps_before_extension[0])
    work = WorkOfPoints(scene, sample, surface)
    estimate = estimate_scene(
        scene, sample, surface, speeds, ratios, measures=measures, solves_strips=measures, work=work
    )
    sections = {name: [*FACTS[name](scene), *input_rows(scene, name)] for name in FACTS} | estimate.sections
    before, after = (
        [f"  {name}\n" + "\n".join(f"    {text}" for text in sections[name]) for name in names if sections[name]]
        for names in (BEFORE_TABLE, AFTER_TABLE)
    )
    table = _table_in_text(estimate.table)
    first = [violation.text for violation in violations_by_unusual_inputs(scene)]
    lines = [*first, f"scene {scene.name}", *before, f"  {TABLE_CAPTION}", *table, *after]
    return "\n".join(lines), estimate


def _table_in_text(rows: Sequence[tuple[str, ...]]) -> list[str]:
    """Return the lines of a table of ``rows``, whose first one is the headings: these are broken between words, such
    that no column is wider than its cells and the words of its heading."""
    columns = []
    for heading, *cells in zip(*rows):
        width = max(LEAST_HEADING, *map(len, (*heading.split(), *cells)))
        columns.append([*textwrap.wrap(heading, width), *cells])
    highest = max(len(column) for column in columns)
    padded = [[""] * (highest - len(column)) + column for column in columns]
    widths = [max(map(len, column)) for column in padded]
    return ["  " + "  ".join(f"{cell:<{width}}" for cell, width in zip(line, widths)).rstrip() for line in zip(*padded)]


def estimate_scene(
    scene: Scene,
    sample: Sample,
    surface: Surface,
    speeds: Sequence[float] | str = (),
    ratios: Sequence[float] = (),
    *,
    measures: bool = False,
    solves_strips: bool = False,
    work: WorkOfPoints | None = None,
) -> SceneEstimate:
    """Return what is known of a ``scene`` before it is solved at ``speeds`` [m/s], as `describe_scene`; or at its own
    speed and the slide-roll ``ratios``. ``sample`` and ``surface``: as `lubfric.prepare` makes them; ``measures``:
    where a strip of moving roughness takes more than `MEASURED_FROM`, its first steps in time are solved, and the
    processor time follows from them; ``solves_strips``: how many strips a run in time has is solved, as the run does,
    where that takes no longer than `MOST_START_SECONDS`; ``work``: the estimates of its points that are known."""
    work = work or WorkOfPoints(scene, sample, surface)
    measured = _measured_times(work, speeds) if measures and not len(ratios) else NOT_MEASURED
    scene_speed = scene.motion.entrainment_speed
    is_of_scene = not len(ratios) and not len(speeds)
    speeds = [scene_speed] if len(ratios) else _speeds_of(scene, surface, speeds)
    changing = []
    over = counted(len(ratios), "ratios") if len(ratios) else counted(len(speeds), "speeds")
    if is_of_scene and len(speeds) > len(scene.motion.speeds) > 0:
        over += f", with the entrainment speed of {scene_speed:g} m/s"
    if scene.transient is not None:
        speeds = list(speeds_of_run(scene)) or [0.0]
        over = "a run in time"
        scene_speed = max(speeds)
    model, seconds = _model(work, speeds, ratios, measured)
    seconds += _seconds_of_files(scene, sample) if seconds else 0.0
    point_seconds = _seconds_of_each(work, speeds, ratios, measured, seconds) if scene.transient is None else {}
    beside = COMMAND_SECONDS
    if scene.transient is None and sample.is_resolved and not len(ratios):
        beside += work.at(speeds[index_of_nearest(speeds, scene_speed, are_speeds=True)]).fine_fields_seconds
    within = _how_well_known(work, speeds, ratios, measured)
    more = f"{in_words(beside)} for start, pictures and files of 'lubfric run'"
    cost = f"about {in_words(seconds)} of processor time for {over} ({within}), and {more}" if seconds else ""
    run = None
    if scene.transient is not None:
        run = estimated_run(scene, sample, surface)
        seconds = run.seconds
        cost, lines = _course(scene, run, _solved_strips(work, run) if solves_strips else None)
        changing = [cost, *_histories(scene), *lines]
    elif cost:
        model.append(f"cost: {cost}")
    at = _violations_before(work, speeds)
    may_refuse = {Assumption.STRESS_OF_OILS_UNDER_TOTAL_LOAD}
    if scene.transient is not None and not run_model_of(scene).continues_patch:
        may_refuse.add(Assumption.LONG_PATCH)
    refusals = _doubts(scene, [pair for pair in at if pair[1].severe or pair[1].assumption in may_refuse])
    scene_map = sample.whole_map
    gaps = _expected_gaps(scene, scene_map.sq, speeds[0], ratios) if len(ratios) else []
    effects, over_time, changes = _effects_before(scene, scene_map.sq, scene_speed)
    sections = {
        "transient": changing,
        "surface": [*sample.described(surface), *scene_map.used_parts, slopes_in_words(scene_map)],
        "contact": [f"{_plan(scene, sample, surface)}; {over}"],
        "model": model,
        "effects not modelled": changes or ["each known effect changes f by less than the numerical tolerance"],
        "validity": [*_doubts(scene, at), *gaps] or ["no limit of the model is exceeded before the solve"],
    }
    return SceneEstimate(
        sections=sections,
        cost=cost,
        seconds=seconds,
        command_seconds=seconds + beside,
        table=_speed_table(work, speeds, measured),
        refusals=refusals,
        severe=tuple(violation for _, violation in at if violation.severe),
        effects=effects,
        effects_over_time=over_time,
        run=run,
        point_seconds=point_seconds,
    )


def _seconds_of_files(scene: Scene, sample: Sample) -> float:
    """Return the processor time [s] in which the measured maps of ``scene`` become its ``sample``."""
    files = sum(rough.file is not None for rough in (scene.surface, scene.counterface) if rough is not None)
    return files * (FILE_SECONDS + FILE_CELL_SECONDS * sample.maps_before_extension[0].heights.size)


def _how_well_known(
    work: WorkOfPoints, speeds: list[float], ratios: Sequence[float], measured: Mapping[str, Sequence[MeasuredTime]]
) -> str:
    """Return how well the processor time is known, as text; ``measured``: as of `WorkOfPoints.at`, the others as of
    `estimate_scene`."""
    if not measured and not len(ratios) and _slow_points(work, speeds):
        return f"{WITHIN_WORDS}; 'lubfric info' measures it on the first steps"
    within = WITHIN_WORDS
    for times in measured.values():
        steps = sum(time.steps for time in times)
        places = f"a strip at {' and '.join(f'{time.speed:.3g}' for time in times)} m/s"
        seconds = sum(time.seconds for time in times)
        within = f"{WITHIN_MEASURED}; measured on {steps} steps in time of {places}, in {in_words(seconds)}"
    return within


def _violations_before(work: WorkOfPoints, speeds: list[float]) -> list[tuple[float | None, Violation]]:
    """Return the assumptions that fail by what is known before the solve, each with its speed [m/s], or its
    moment [s] of a run in time, or None where it does not depend on these."""
    scene = work.scene
    sample = work.sample
    surface = work.surface
    at: list[tuple[float | None, Violation]] = [
        *((None, violation) for violation in beforehand(scene, sample, surface)),
        *(
            (None, violation)
            for violation in violations_by_form(scene, sample.maps_before_extension, has_given_map=False)
        ),
        *((None, violation) for violation in violations_by_strips(*sample.sq_deviation(surface))),
    ]
    if scene.transient is not None:
        return [*at, *expected_violations_of_run(scene)]
    different = sorted(set(speeds))
    known = {violation.assumption for _, violation in at}
    of_sample = expected_of_sample(scene, sample, [work.at(speed) for speed in different])
    of_models = expected_violations(scene, sample, surface, different, work)
    return [*at, *(pair for pair in of_sample if pair[1].assumption not in known), *of_models]


def _effects_before(
    scene: Scene, sq: float, speed: float
) -> tuple[tuple[ExpectedEffect, ...], tuple[EffectOverTime, ...], list[str]]:
    """Return the effects that are not modelled at ``speed`` [m/s], or over a run in time, and both as lines of text;
    none where they change nothing. ``sq`` [m]: of the whole surface."""
    effects: tuple[ExpectedEffect, ...] = ()
    over_time: tuple[EffectOverTime, ...] = ()
    note = ""
    if scene.transient is not None:
        chosen = _chosen_times(scene)
        over_time = expected_effects_of_run(scene, sq, chosen)
        note = without_steady_film(scene, chosen)
        place = "over the run, each at the moment at which it is largest"
        rows = [f"at {each.moment_in_words}: {effect_in_words(each.effect)}" for each in over_time]
    else:
        effects = expected_effects(scene, sq, speed, includes_motion=may_move_roughness(scene))
        place = f"at {speed:.4g} m/s"
        of_alpha = expected_alpha_of_scene(scene, effects)
        rows = [effect_in_words(effect) for effect in effects if not (of_alpha and effect.is_of_alpha)]
        rows = [*filter(None, [of_alpha]), *rows]
    if not rows:
        return effects, over_time, []
    changes = [
        f"likely changes of f {place}, estimated with closed forms. Each range covers the asperity load "
        "ratios that the result may have; the report states the changes for the solved ratio." + note,
        *rows,
    ]
    return effects, over_time, changes


def _speeds_of(scene: Scene, surface: Surface, speeds: Sequence[float] | str) -> list[float]:
    """Return ``speeds`` [m/s]; "auto": about those that a curve would choose; (): those of `speeds_of_curve`."""
    chosen = expected_speeds(scene, surface.sq) if isinstance(speeds, str) else speeds
    return list(chosen) or speeds_of_curve(scene)


def speeds_of_curve(scene: Scene) -> list[float]:
    """Return the speeds [m/s] of the curve that 'lubfric run' solves: those of the ``scene``, and its own speed, which
    is its operating point, where it belongs to that curve and is not among them."""
    scene_speed = scene.motion.entrainment_speed
    speeds = list(scene.motion.speeds)
    if not speeds:
        return [scene_speed]
    if is_among(scene_speed, speeds) or not belongs_to_curve(scene_speed, speeds):
        return speeds
    return sorted([*speeds, scene_speed]) if speeds == sorted(speeds) else [*speeds, scene_speed]


def is_among(value: float, values: Iterable[float]) -> bool:
    """Return whether a speed or a ratio is one of the ``values``, but for rounding."""
    return any(math.isclose(value, other, rel_tol=SPEED_ROUNDING) for other in values)


def belongs_to_curve(speed: float, speeds: Iterable[float]) -> bool:
    """Return whether a ``speed`` [m/s] and the ``speeds`` of a curve are in motion, all in the same direction."""
    return speed != 0 and all(other * speed >= 0 for other in speeds)


def index_of_nearest(values: Sequence[float], value: float, *, are_speeds: bool) -> int:
    """Return the index of the one of the ``values`` nearest to a ``value``: by the ratio of speeds [m/s], those in its
    direction first; by the difference of slide-roll ratios, or where the ``value`` is at rest."""

    def distance(other: float) -> tuple[bool, float]:
        if not are_speeds or value == 0:
            return False, abs(other - value)
        return other * value < 0, abs(math.log(abs(other / value))) if other != 0 else math.inf

    return min(range(len(values)), key=lambda index: distance(values[index]))


def _slow_points(work: WorkOfPoints, speeds: list[float]) -> list[PointWorkEstimate]:
    """Return the points, of some at these ``speeds`` [m/s], one strip of which takes more than `MEASURED_FROM` where
    roughness moves."""
    if work.scene.transient is not None:
        return []
    moving = sorted({abs(u) for u in speeds if u != 0})
    points = [work.at(speed) for speed in moving[:: max(1, len(moving) // SOME)]]
    return [point for point in points if point.model.has_slow_strips and point.slow_strip_seconds > MEASURED_FROM]


def _measured_times(work: WorkOfPoints, speeds: Sequence[float] | str) -> dict[str, list[MeasuredTime]]:
    """Return, by the name of its model, what the first steps in time of the slowest and the fastest point say of its
    time, or those of the point that takes the longest where these are within `MEASURED_AT_ONE`; {}: no strip of moving
    roughness takes more than `MEASURED_FROM`, or none was solved."""
    slow = _slow_points(work, _speeds_of(work.scene, work.surface, speeds))
    if not slow:
        return {}
    ends = [slow[0], slow[-1]]
    if ends[1].speed < MEASURED_AT_ONE * ends[0].speed or ends[0].model is not ends[1].model:
        ends = [max(slow, key=lambda point: point.seconds)]
    prepared = prepare_on_sample(work.scene, work.sample)
    measured = [end.model.measure_time(prepared, end.speed) for end in ends]
    times = [time for time in measured if time is not None]
    return {ends[0].model.name: times} if times else {}


def _expected_gaps(scene: Scene, sq: float, speed: float, ratios: Sequence[float]) -> list[str]:
    """Return between which of the slide-roll ``ratios`` a traction curve at ``speed`` [m/s] is expected not to show f,
    and which ratios do, in sentences; ``sq`` [m]: of the surface."""
    scenes = [scene.with_(motion={"slide_roll_ratio": ratio}) for ratio in ratios]
    f = np.array([expected_coefficient(at, sq, speed) for at in scenes])
    gaps = gaps_of(ratios, f, np.full(f.size, math.nan))
    wide = [gap for gap in gaps if gap.change > WIDE_GAP * f.max()]
    return [f"note: by closed forms, {gap.text}." for gap in wide]


def _fastest_moment(scene: Scene) -> Scene:
    """Return the scene of a run in time at the moment of its largest entrainment speed; any other scene as it is."""
    if scene.transient is None:
        return scene
    moments = [scene_at(scene, time) for time in sampled_times(scene)]
    return max(moments, key=lambda moment: abs(moment.motion.entrainment_speed))


def _doubts(scene: Scene, at: list[tuple[float | None, Violation]]) -> list[str]:
    """Return the violations of ``scene`` as text; ``at``: pairs as of `_violations_before`."""
    fixed = [violation.text for place, violation in at if place is None]
    moving: list[tuple[float, tuple[Violation, ...]]] = [
        (place, (violation,)) for place, violation in at if place is not None
    ]
    unit, places = ("m/s", "speeds") if scene.transient is None else ("s", "moments")
    return [*fixed, *gathered(moving, unit, places)]


def _plan(scene: Scene, sample: Sample, surface: Surface) -> str:
    what = {"flat": "periodic flat contact", "cylinder": "line contact, periodic along the line,"}[
        scene.contact.geometry
    ]
    on = "strips of the rough surface" if sample.represents_more else "{} x {} cells".format(*surface.shape)
    return f"{what} on {on}; target of the numerical error of f: {100 * scene.numerics.tolerance:g} %"


def _model(
    work: WorkOfPoints,
    speeds: list[float],
    ratios: Sequence[float],
    measured: Mapping[str, Sequence[MeasuredTime]],
) -> tuple[list[str], float]:
    """Return which model will answer at the ``speeds`` [m/s] and ``ratios``, and why; and the processor seconds of all
    of them (`lubfric.estimate.friction`; 0: not known here). ``measured``: as of `WorkOfPoints.at`."""
    scene = work.scene
    name = scene.numerics.model
    if scene.transient is not None:
        run = run_model_of(scene)
        rows = [run.described(scene)]
        if has_moving_roughness(scene) and not may_move_roughness(scene):
            rows.append(f"{STANDS_STILL}; {way_to_motion_in_time(scene)}")
        return rows, 0.0
    moving = sorted({abs(u) for u in speeds if u != 0})
    forecasts = [work.at(speed, measured) for speed in moving[:: max(1, len(moving) // SOME)]]
    if len(ratios):
        scenes = [scene.with_(motion={"slide_roll_ratio": ratio}) for ratio in ratios]
        forecasts = [estimated_work_of_point(at, work.sample, work.surface, speeds[0], measured) for at in scenes]
    strip = max((one.slow_strip_seconds for one in forecasts), default=0.0)
    if name != AUTO:
        rows = [model_named(name).described(scene)]
    else:
        rows = [_in_auto(scene, forecasts)]
    if strip:
        slow = next(model for model in models_up_to(AUTO) if model.has_slow_strips)
        takes = f"one strip of moving roughness takes about {in_words(strip)} of processor time by the {slow.title}"
        longest = max(one.longest_strip_seconds for one in forecasts)
        if longest > strip:
            takes += f", and {in_words(longest)} if the error of its cells requires shorter cells"
        if not may_move_roughness(scene):
            takes = f"{STANDS_STILL}; {takes}"
        if name == AUTO:
            takes += f"; {slow.limit_of_work_in_auto()}"
        rows.append(takes)
    many = len(ratios) or len(moving)
    return rows, seconds_of_points(forecasts, many)


def _seconds_of_each(
    work: WorkOfPoints,
    speeds: list[float],
    ratios: Sequence[float],
    measured: Mapping[str, Sequence[MeasuredTime]],
    total: float,
) -> dict[float, float]:
    """Return the processor time [s] of each point, which are ``total`` together, by its speed [m/s]; by its slide-roll
    ratio, each as long as the others, where there are ``ratios``."""
    each = {ratio: 1.0 for ratio in ratios} or {speed: work.at(abs(speed), measured).seconds for speed in speeds}
    in_all = sum(each.values())
    return {value: total * seconds / in_all for value, seconds in each.items()} if in_all else each


def _in_auto(scene: Scene, forecasts: Sequence[PointWorkEstimate]) -> str:
    """Return which model "auto" is expected to take at the points of ``forecasts``, as text: the most expensive at any
    of them, and where that is."""
    expected = {point.model.name for point in forecasts}
    cheapest = models_up_to(AUTO)[:1]
    model = ([each for each in models_up_to(AUTO) if each.name in expected] or cheapest)[-1]
    speeds = [point.speed for point in forecasts if point.model.name == model.name]
    ends = dict.fromkeys(f"{speed:.3g}" for speed in (speeds[0], speeds[-1])) if speeds else {}
    is_everywhere = len(speeds) == len(forecasts)
    return model.described_in_auto(scene, f"at {' to '.join(ends)} m/s", is_everywhere=is_everywhere)


def _histories(scene: Scene) -> list[str]:
    """Return what changes in time, how, how often, and between which values; and the largest speeds."""
    plan = scene.transient
    rows = []
    assert plan is not None
    for name, unit in UNITS_OF_HISTORIES.items():
        history = getattr(plan, name)
        if history is not None:
            low, high = history.range(plan.duration)
            laps = periods(history, plan.duration)
            reverses = ": the motion reverses" if name == "speed" and low < 0 < high else ""
            row = f"{name}: {type(history).__name__.lower()}, {low:.4g} to {high:.4g} {unit}"
            repeated = f", {laps:.3g} {'period' if laps == 1 else 'periods'}" if laps else ""
            rows.append(f"{row}{repeated}{reverses}")
    start = "steady if there is entrainment, else at rest" if plan.initial == "auto" else plan.initial
    if plan.initial_film is not None:
        start = f"film of {worded(plan.initial_film, 'm')}"
    if plan.rotational_speed is not None:
        turns = plan.rotational_speed * plan.duration
        per_minute = converted(plan.rotational_speed, "Hz", "1/min")
        rows.append(
            f"rotational speed: {per_minute:.4g} 1/min, {turns:.4g} {'turn' if turns == 1 else 'turns'} in the run"
        )
    return [*rows, f"start: {start}"]


def _solved_strips(work: WorkOfPoints, run: RunEstimate) -> int | None:
    """Return how many strips the ``run`` has, as it solves them before its first step; None where it has one, where that
    takes long, or where it is not solved."""
    if run.widest is None or run.start_seconds > MOST_START_SECONDS:
        return None
    try:
        return strip_of_run(prepare_on_sample(work.scene, work.sample)).strips
    except LubfricError:  # which the run will raise
        return None


def _course(scene: Scene, estimate: RunEstimate, strips: int | None) -> tuple[str, list[str]]:
    """Return the steps and the time of a run as text, and its sample as text; ``strips``: how many it has, None where
    they are estimated."""
    plan = scene.transient
    assert plan is not None
    lines = []
    if estimate.widest is not None:
        target = f"sampling error of f at 95 % at most {percent(student(math.inf) * scene.numerics.sampling_tolerance)}"
        target += f" in steady motion at {' to '.join(f'{end:.3g}' for end in _ends_of(speeds_of_run(scene)))} m/s"
        known = f"about {counted(estimate.widest.strips, 'strips')}" if strips is None else counted(strips, "strips")
        lines = [f"sample: {known} of the roughness, at all times ({target})"]
    fastest = max(abs(end) for end in (plan.speed or Constant(scene.motion.entrainment_speed)).range(plan.duration))
    top = f"top speed {fastest:.4g} m/s" if fastest else "no entrainment"
    course = (
        f"{plan.duration:.4g} s in about {float(f'{estimate.steps:.2g}'):.0f} steps, {counted(plan.outputs, 'outputs')}"
    )
    cost = f"about {in_words(estimate.seconds)} of processor time ({WITHIN_WORDS})"
    return f"{top}; {course}; {cost}", lines


def _ends_of(speeds: list[float]) -> list[float]:
    """Return the smallest and the largest of ``speeds`` [m/s], once if they are the same."""
    return sorted({min(speeds, default=0.0), max(speeds, default=0.0)})


def _speed_table(
    work: WorkOfPoints, speeds: list[float], measured: Mapping[str, Sequence[MeasuredTime]] = NOT_MEASURED
) -> list[tuple[str, ...]]:
    """Return a table at some of the ``speeds`` [m/s]: Moes numbers and the expected film under the total load, whether
    the summits touch, and what the sample costs; of a run in time `_moment_table`. ``measured``: as of
    `WorkOfPoints.at`."""
    scene = work.scene
    sample = work.sample
    surface = work.surface
    if scene.transient is not None:
        return _moment_table(scene, sample, surface)
    table: list[tuple[str, ...]] = [("U [m/s]", "M", "L", "film [nm]", "lambda ratio", "asperity contact")]
    chosen = ("deterministic strips",) if scene.numerics.model == AUTO else ()
    if sample.is_resolved:
        table[0] += ("strips", *chosen, "length of the line [mm]", "processor time [s]")
    operating_point = speeds[index_of_nearest(speeds, scene.motion.entrainment_speed, are_speeds=True)]
    for speed in sorted({*speeds[:: max(1, len(speeds) // TABLE_SPEEDS)], operating_point, speeds[-1]}):
        one = work.at(speed, measured)
        film = ("", "", "0", "0", "no entrainment: all load")
        if speed != 0:
            film = _film_in_words(scene, surface, speed, one.asperities)
        counts = (
            f"{one.strips}",
            *(f"{one.slow_strips}" for _ in chosen),
            f"{1e3 * one.length:.2g}".replace("nan", "-"),
            _seconds_in_words(one),
        )
        table.append((f"{speed:.4g}", *film, *(counts if sample.is_resolved else ())))
    return table


def _seconds_in_words(point: PointWorkEstimate) -> str:
    """Return the processor time [s] of a ``point``, and that with shorter cells, which the error of its cells may
    require, as text."""
    seconds = f"{float(f'{point.seconds:.1g}'):g}"
    more = point.longest_strip_seconds - point.slow_strip_seconds
    if not (point.slow_strips and more > 0):
        return seconds
    longest = f"{float(f'{point.seconds + more:.1g}'):g}"
    return seconds if longest == seconds else f"{seconds} ({longest} on shorter cells)"


def _moment_table(scene: Scene, sample: Sample, surface: Surface) -> list[tuple[str, ...]]:
    """Return the table of a run in time: at `_chosen_times`, with the load and the radius of the moment."""
    fastest = abs(_fastest_moment(scene).motion.entrainment_speed)
    assert scene.transient is not None
    has_angle = scene.transient.rotational_speed is not None
    over = ("t [s]", "angle [°]") if has_angle else ("t [s]",)
    table: list[tuple[str, ...]] = [
        (*over, "U [m/s]", "load [N]", "radius [mm]", "M", "L", "film [nm]", "lambda ratio", "asperity contact")
    ]
    for time in _chosen_times(scene):
        now = scene_at(scene, time)
        is_at_rest = abs(now.motion.entrainment_speed) < STANDSTILL_PART * fastest
        speed = 0.0 if is_at_rest else now.motion.entrainment_speed
        asperities = estimated_work_of_point(now, sample, surface, speed).asperities
        film = ("", "", "0", "0", "no entrainment")
        if speed != 0:
            film = _film_in_words(now, surface, speed, asperities)
        moment = (time, scene.transient.angle_at(time)) if has_angle else (time,)
        values = (*moment, speed, now.bodies.load, 1e3 * now.bodies.radius)
        table.append((*(f"{value:.4g}" for value in values), *film))
    return table


def _chosen_times(scene: Scene) -> list[float]:
    """Return some times [s] of a run, spread evenly, and those of the largest speed, load and Hertz pressure."""
    moments = {time: scene_at(scene, time) for time in sampled_times(scene)}
    times = list(moments)
    evenly = times[:: max(1, len(times) // TABLE_SPEEDS)]
    fastest = max(times, key=lambda time: abs(moments[time].motion.entrainment_speed))
    heaviest = max(times, key=lambda time: moments[time].bodies.load)
    hardest = times[first_largest([now.bodies.mean_hertz_pressure for now in moments.values()])]
    return sorted({*evenly, fastest, heaviest, hardest})


def _film_in_words(scene: Scene, surface: Surface, speed: float, asperities: str) -> tuple[str, str, str, str, str]:
    """Return the Moes numbers, the expected film under the total load, its lambda ratio and whether asperities touch at
    ``speed`` [m/s], not 0, as text. ``asperities``: as of `asperities_in_words`."""
    line = scene.line_contact(abs(speed))
    inlet, is_used = inlet_at(scene, speed)
    thickness = line.expected_film_with(inlet.factor if is_used and inlet is not None else 1.0)
    ratio = thickness / surface.sq if surface.sq > 0 else math.inf
    contact = asperities_in_words(asperities, ratio)
    return f"{line.M:.3g}", f"{line.L:.3g}", f"{thickness * 1e9:.4g}", f"{ratio:.3g}", contact


def asperities_in_words(asperities: str, lambda_ratio: float) -> str:
    """Return whether asperities touch, as the table says it. ``asperities``: by the height of the highest summit, one
    of `ASPERITIES`. What that does not decide is likely below the `FULL_FILM_LAMBDA`."""
    is_open = asperities == FEW_TOUCH
    return "likely" if is_open and lambda_ratio < FULL_FILM_LAMBDA else ASPERITIES[asperities]


def slopes_in_words(surface: Surface) -> str:
    """Return slopes and correlation lengths of the map, on its own grid."""
    along_x, along_y, total = rms_slope(surface)
    lengths = []
    for axis, step in enumerate(surface.spacing):
        with suppress(InputError):  # flat, one cell, or too short
            length = correlation_length(surface, axis)
            lengths.append(f"{length * 1e6:.3g} µm = {length / step:.3g} cells along {'xy'[axis]}")
    slopes = f"rms slope {total:.3g} ({along_x:.3g} along x, {along_y:.3g} along y)"
    return f"{slopes}; correlation length (to 1/e) {' and '.join(lengths) or 'not known'}"
