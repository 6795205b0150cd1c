"""What the deterministic model says of one operating point: its numbers, their errors, warnings and fields."""

import math
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial

import numpy as np

from ...errors import ConvergenceError
from ...quantities import counted, depending_on
from ...samples import Sample
from ...scene import BOUNDARY_FILM_KEY, HARDNESS_KEY, Scene, has_moving_roughness, inputs_not_given, value_of
from ..load_sharing import largest_film_load_ratio
from ..model_answer import AnswerErrors, AtInputs, ContactFields, ModelAnswer
from ..shared import (
    BY_HEAT,
    NEAR_ZERO,
    PLACE_BLOCK,
    SAMPLING_ERROR,
    SAMPLING_ERROR_MISSED,
    TIME_BLOCK,
    Assumption,
    Decision,
    Heat,
    ModelErrorPart,
    Prepared,
    StandardError,
    Violation,
    area_needed,
    error_by_heat,
    film_lubricant,
    half_width_of_error,
    heat_error_in_words,
    is_near_zero,
    limit_bounds,
    limit_in_words,
    percent_beside,
    percent_or_less,
    pictured_contact,
    sides_of_parts,
    smooth_rolling_resistance,
    standard_error_in_words,
    way_to_shorter_cells,
    why_map_too_small,
    why_sample_too_short,
    why_too_few_blocks,
)
from .counted_work import MOST_WORK_OF_POINT
from .estimated_work import pictured_length
from .expected_friction import HARDNESS_MATTERS, REDISTRIBUTED
from .heat_of_strip import heat_of_strips, strip_heat, warmed
from .ladder import EndOfCells
from .levels import Levels, mean
from .problem import MOST_GRID_CELLS
from .result import DeterministicResult, stress_with_oil
from .rough_bodies import map_of_contact, map_of_strip, summit_control
from .scatter import samples_over_time
from .strip import StripSolution, change_by_flow, solve_strip
from .strip_on_two_grids import SampleCoarsening, StripOnTwoGrids, patch_coarsening_to_look_at, sample_coarsening_of
from .time_and_place import least_blocks
from .violations_of_strips import BY_GAP, error_by_gap_of, violations_of_strips

BY_PLACES = "the scatter of the difference between the models from strip to strip"
LESS_BY_TOLERANCE = "set a smaller numerics.model_tolerance to reduce it"
BY_FLOW_AT_LIMIT = "the flow of a film at its limiting stress, on which published theories differ"

# Counted work of a strip [s] above which no cells are recommended: an hour. A convention.
LONGEST_WORK = 3600.0
FEW_STRIPS = "not known from fewer than three strips, where it is no load or force"
UNSOLVED_CELLS = "shorter cells did not converge{}: the numerical error is twice the estimate from longer cells"
WITHIN_WORK = " within the work of a point"
MORE_WORK = "set a larger numerics.max_work"
ENDED_CELLS = (
    "shorter cells were not solved: judging by the changes of f so far, they would take too much work, or leave the numerical "
    "error above numerics.tolerance"
)
# What to do where a strip of moving roughness on the cells of its map takes more than `LONGEST_WORK`.
ACCEPT_CELLS = (
    "accept the numerical error by a larger numerics.tolerance: a strip on the cells of this map, which would reduce it, "
    "takes too long"
)
SMALLER_PATCH = "give a smaller patch (contact.shape)"
PATCH_IN_PLACE = "use a narrow patch in place of strips (numerics.sampling = 'patch')"
TOO_MANY_CELLS = (
    "shorter cells of {} would be more than {:.3g}, the largest number that is solved: the numerical error is twice "
    "the estimate from longer cells; {} to reduce it"
)
ONE_HEAT = "heat is the mean of the solved strips, each at one moment if roughness moves; its scatter is not known"
MIRRORED = ", mirrored along the line"
BIASED = "a single short patch also has a bias: near the lift-off speed f is some 10 % too low"
# What has the boundary friction f_b, by whether the shear stress of the lubricant is unlimited: where it has a limit, a
# film at this limit is no part of the asperity load.
RUBS = {
    True: "gaps below the boundary film, and film at its limiting stress",
    False: "gaps below the boundary film",
}
BY_FILM = "change of f with half the boundary film {:+.2g} %, with twice {:+.2g} %"
BY_INLET = "without the heat of the inlet f would change by {:+.2g} %"
BY_FLOW = "change of f with half the thinning of the flow at the limiting stress {:+.2g} %"
BY_LIMIT = "the limiting stress of the oil, which is not given"
LESS_BY_LIMIT = "give lubricant.limiting_stress_coefficient to reduce it"
# Of which film the rolling resistance of moving roughness is.
OF_SMOOTH_FILM = "of a smooth film under the film load F_H"
LIMITED = ("coefficient", "at_least_limit", "at_most_limit")
# What lets shorter cells converge: on them the summits of an optical map are steeper.
FILTERED_MAP = "filter short waves out of the map (surface.s_filter; f changes too)"
SMALLER_SOLVE_TOLERANCE = "set a smaller numerics.tolerance"

# Relative change of f at rest, by the flow of an oil with another critical stress, above which this oil is solved in
# motion too [-]. Up to .006 the shear stress of the solved moments alone gave the change of f within 7 % (needle
# rollers, bearings, light contacts); at .023, on a gear flank, it gave -47 % instead of -30 %.
FLOW_MATTERS = 0.01

# Correction of f by the summits of the sample [-] above which a note states it whatever the sampling error is. A
# convention: the usual model_tolerance.
LARGE_CORRECTION = 0.05

# Correction of f by the summits of the sample [-] below which no note states it. A convention: the usual tolerance.
SMALL_CORRECTION = 0.01


def answer_of(prepared: Prepared, speed: float, levels: Levels) -> ModelAnswer:
    """Return the answer of the strips of ``levels`` at ``speed`` [m/s], which is not 0."""
    scene = prepared.scene
    sample = prepared.sample
    results = [pair.resolved.result for pair in levels.pairs]
    heat = heat_of_strips(scene, results)
    numbers = warmed(scene, levels.numbers, heat) | {"speed": speed}
    errors = dict(levels.errors)
    of_which_film = ""
    if has_moving_roughness(scene):
        with suppress(ConvergenceError):  # then it is that of the strips, whose error is not known
            resistance, error = smooth_rolling_resistance(scene, speed, numbers["film_load"])
            numbers["rolling_resistance"] = resistance
            errors["rolling_resistance"] = error
            of_which_film = OF_SMOOTH_FILM
    sampling_error = levels.sampling_error
    if not math.isfinite(sampling_error.value):
        sampling_error = replace(sampling_error, value=math.nan)
    with_thinner, with_thicker = levels.by_film
    by_input_not_given = {BOUNDARY_FILM_KEY: (with_thinner, with_thicker)}
    of_heat = heat_error_in_words(heat, levels.by_inlet, scene.numerics.tolerance, is_at_most=False)
    by_limit = _by_limit(scene, results)
    parts_of_model = _parts_of_model_error(levels, results, heat, by_limit)
    reasons = dict.fromkeys(depending_on("heat"), heat.reason(scene) or ONE_HEAT)
    return ModelAnswer(
        numbers=numbers,
        errors=AnswerErrors(
            numerical=levels.numerical,
            sampling_error=sampling_error,
            model_error=sides_of_parts(parts_of_model),
            by_limit=max(by_limit),
            parts_of_model=parts_of_model,
            of_numbers=errors | dict.fromkeys(reasons, math.nan),
            why_not_known=FEW_STRIPS,
            reasons=reasons,
            notes=(
                *_sample_notes(prepared, sampling_error, levels),
                *filter(None, [limit_in_words(by_limit), of_heat]),
                *_end_of_cells_in_words(prepared.sample, levels.end_of_cells),
            ),
            largest_film_load_ratio=_largest_film_load_ratio(prepared, numbers),
            area_needed=_area_needed(prepared, sampling_error, levels),
        ),
        not_given={key: by_input_not_given[key] for key in inputs_not_given(scene)},
        report=replace(results[0].report, notes=()),
        decision=replace(_decision(scene, results, levels, heat), rolling_in_words=of_which_film),
        length=levels.length,
        violations=(
            *violations_of_strips(prepared, numbers, results, heat),
            *violations_by_correction(
                levels.by_summits,
                half_width_of_error(sampling_error.value, sampling_error.freedom),
                numbers["coefficient"],
            ),
        ),
        recommendation=_recommendation(prepared, levels),
        narrows_numerical=_narrows_numerical(prepared, levels),
        fields=fields_of(levels.finest, sample.in_words(1) + (MIRRORED if levels.pairs[0].is_mirrored else "")),
        fine_fields=None if has_moving_roughness(scene) else partial(fine_fields_of, prepared, speed, levels.finest),
        details=levels.finest.result,
        at_inputs=lambda: _at_inputs(prepared, levels.finest, speed),
        change_without_solve=partial(_change_without_solve, levels.finest, scene, speed),
    )


def _parts_of_model_error(
    levels: Levels, results: Sequence[DeterministicResult], heat: Heat, by_limit: tuple[float, float]
) -> tuple[ModelErrorPart, ...]:
    """Return the parts of the model-form error of f. ``by_limit``: by how much f may be lower and higher, relative, by
    the limiting stress of the oil."""
    by_scatter = half_width_of_error(levels.difference_error.value, levels.difference_error.freedom)
    by_flow = abs(levels.by_flow)
    by_heat = error_by_heat(heat, levels.by_inlet)
    by_gap = error_by_gap_of(results)
    return (
        ModelErrorPart(sides=(by_scatter, by_scatter), cause=BY_PLACES, recommendation=LESS_BY_TOLERANCE),
        ModelErrorPart(sides=(by_flow, by_flow), cause=BY_FLOW_AT_LIMIT),
        ModelErrorPart(sides=(by_heat, by_heat), cause=BY_HEAT),
        ModelErrorPart(sides=(by_gap, by_gap), cause=BY_GAP),
        ModelErrorPart(sides=by_limit, cause=BY_LIMIT, recommendation=LESS_BY_LIMIT, is_of_input=True),
    )


def _by_limit(scene: Scene, results: Sequence[DeterministicResult]) -> tuple[float, float]:
    """Return by how much f may be lower and higher, relative, by the unknown limit of an oil."""
    f, low, high = (mean(getattr(result, name) for result in results) for name in LIMITED)
    saturated = mean(result.split.saturated / result.load for result in results)
    return limit_bounds(scene, saturated, f, (low, high))


def fields_of(strip: StripSolution, where: str) -> ContactFields:
    """Return the fields of ``strip``; of roughness that moves those of its last moment."""
    result = strip.result
    heights = strip.problem.heights
    parts = filter(None, (where, strip.moment_in_words and f"at {strip.moment_in_words}"))
    return ContactFields(
        solve=f"deterministic model on {', '.join(parts)}",
        x=result.x,
        y=np.arange(result.pressure.shape[1]) * result.spacing[1],
        heights=heights - heights.mean(),
        pressure=result.pressure,
        gap=result.gap,
        deflection=result.gap - strip.problem.rigid_gap - result.approach,
        film=result.gap,
        shear=result.shear,
        half_width=strip.problem.line.half_width,
        pressure_includes_film=True,
    )


def fine_fields_of(prepared: Prepared, speed: float, finest: StripSolution) -> ContactFields:
    """Return the fields of a piece of the surface on cells fine enough to look at, solved by itself; of a patch, those
    of its ``finest`` solution, or of all of it on shorter cells, from that solution on."""
    sample = prepared.sample
    scene = prepared.scene
    if sample.refines_in_place:
        surface = map_of_strip(prepared, 0)
        (along, across) = (round(long / short) for long, short in zip(finest.problem.spacing, surface.spacing))
        shorter = patch_coarsening_to_look_at(scene, sample, (along, across))
        if shorter != (along, across):
            finest = solve_strip(scene, surface, speed, map_coarsening=shorter, start=finest, memo=prepared.memo)
        return fields_of(finest, sample.piece_on_cells_in_words(finest.problem.spacing))
    coarsening = sample.coarsening_to_look_at(scene.bodies.half_width)
    length = pictured_length(scene, sample)
    rough_contact = pictured_contact(prepared, sample, coarsening=coarsening, length=length)
    strip = solve_strip(scene, map_of_contact(prepared, rough_contact), speed)
    return fields_of(strip, sample.piece_on_cells_in_words(rough_contact.spacing))


def _change_by_hardness(strip: StripSolution, scene: Scene, end: Scene) -> float:
    """Return the largest relative change of f by the hardness of ``end``: `REDISTRIBUTED` times that where the load
    that it moves on ``strip`` rubs as the mean does instead of with f_b, or the other way round; in pure rolling, where
    it changes the rolling resistance in proportion. 0: no cell reaches it."""
    hardness, other = (value_of(each, HARDNESS_KEY) for each in (scene, end))
    moved = strip.share_moved(hardness, other)
    if moved == 0 or scene.motion.slide_roll_ratio == 0:
        return moved
    f = abs(strip.result.coefficient)
    return REDISTRIBUTED * moved * abs(scene.bodies.boundary_friction_coefficient - f) / f


def _change_without_solve(
    strip: StripSolution, scene: Scene, speed: float, name: str, number: int, end: Scene
) -> float | None:
    """Return the relative change of f at end ``number`` of the range of the input of this ``name``, where it needs no
    solve; None where it needs one. ``end``: the scene there.

    A hardness that moves little of the load changes f by no more than what that rubs, here down at the lower end and up
    at the upper one. Where roughness moves, an oil's own stress (`OF_SHEAR`) changes the shear of the moments that are
    solved, if its flow at rest changes f by no more than `FLOW_MATTERS`. Continuations with the other oil gave changes
    within 7 % of these.
    """
    if name == HARDNESS_KEY:
        most = _change_by_hardness(strip, scene, end)
        return (-most, most)[number] if most <= HARDNESS_MATTERS else None
    f = strip.coefficient_with_oil(name, number)
    if f is None:
        return None
    try:
        flow = abs(change_by_flow(strip.at_rest, film_lubricant(end, speed)))
    except ConvergenceError:
        return None
    if flow > FLOW_MATTERS:
        return None
    shear = stress_with_oil(strip.result, strip.problem.sliding, end.lubricant)
    return _with_heat(end, replace(strip.result, coefficient=f, shear=shear)) / _with_heat(scene, strip.result) - 1


def _at_inputs(prepared: Prepared, strip: StripSolution, speed: float) -> AtInputs:
    """Return f at other inputs, on the cells of ``strip``, which is solved at the prepared ones."""
    coefficient = partial(_at_end, prepared, strip, speed)
    middle = _with_heat(prepared.scene, strip.compared_result)
    return AtInputs(middle=middle, coefficient=coefficient, may_run_in_processes=True)


def _at_end(prepared: Prepared, strip: StripSolution, speed: float, scene: Scene) -> float:
    """Return f at ``speed`` [m/s] of a ``scene`` that differs from the prepared one in inputs only, by the
    deterministic model on the cells of ``strip``, which is solved at the prepared one and from which it begins.

    These are the cells of the answer, because the change of f by the stress of an oil is up to three times as large on
    cells twice as long.
    """
    surface = partial(map_of_strip, prepared, 0)
    return _with_heat(scene, strip.at_inputs(scene, speed, surface))


def _with_heat(scene: Scene, result: DeterministicResult) -> float:
    """Return f of ``result`` with the share that the temperatures of film and surfaces take away."""
    return result.coefficient * (1 - strip_heat(scene, result).change)


def _decision(scene: Scene, results: Sequence[DeterministicResult], levels: Levels, heat: Heat) -> Decision:
    """Return what was modelled at a point, in words: its ``levels``, the division of the load, the ``heat`` and
    remarks."""
    by_film = BY_FILM.format(*(100 * change for change in levels.by_film))
    by_flow = (BY_FLOW.format(100 * levels.by_flow),) if levels.by_flow else ()
    by_inlet = (BY_INLET.format(100 * levels.by_inlet),) if levels.by_inlet else ()
    of_levels = (levels.note,) if levels.note else ()
    notes = (
        *by_inlet,
        _division(scene, levels.numbers, results),
        by_film,
        *by_flow,
        *results[0].report.notes,
        *of_levels,
    )
    words = _words_of_levels(levels)
    tolerance = scene.numerics.tolerance
    known = heat.text(tolerance)
    return Decision(
        contact_load_in_words=f"Boundary friction acts on {{part}} of the load "
        f"({RUBS[scene.lubricant.has_unlimited_stress]})",
        film_in_words=words,
        contact_in_words="boundary friction where the gap is below the boundary film",
        tolerance=tolerance,
        strips=len(results),
        cells_of_strip=results[0].pressure.shape,
        cell_size=results[0].spacing,
        control_strips=levels.control_strips,
        shorter_cells=_shorter_cells(levels),
        heat_in_words=known,
        notes=notes,
    )


def _end_of_cells_in_words(sample: Sample, end: EndOfCells) -> list[str]:
    """Return that shorter cells of ``sample`` were not solved, and what reduces the error; [] where they are not
    needed."""
    if end is EndOfCells.NOT_NEEDED:
        return []
    if end is EndOfCells.TOO_MANY:
        return [TOO_MANY_CELLS.format(sample.piece_in_words(), MOST_GRID_CELLS, _fewer_cells(sample))]
    text = UNSOLVED_CELLS.format(WITHIN_WORK if end.lacks_work else "") if end.is_failure else ENDED_CELLS
    return [f"{text}; {MORE_WORK} to reduce it" if end.lacks_work else text]


def _largest_film_load_ratio(prepared: Prepared, numbers: dict[str, float]) -> float:
    """Return the largest part of the load [-] that the film carries: that of the load-sharing model, whose error is the
    larger one (sample, cells and boundary film change the asperity load ratio of the deterministic model by less)."""
    share = numbers["contact_load"] / prepared.scene.bodies.load
    return largest_film_load_ratio(numbers["central_film"] / (prepared.surface.sq or math.nan), share)


def _recommendation(prepared: Prepared, levels: Levels) -> str:
    """Return what makes an error by the cells above the tolerance smaller: shorter cells, if the map has them."""
    scene = prepared.scene
    sample = prepared.sample
    if has_moving_roughness(scene):
        return shorter_cells_in_motion(prepared, levels.pairs[0])
    if levels.end_of_cells is EndOfCells.TOO_MANY:
        return _fewer_cells(sample)
    if levels.end_of_cells.lacks_work:
        return f"{MORE_WORK} for shorter cells"
    if levels.end_of_cells is EndOfCells.UNSOLVED:
        return FILTERED_MAP
    if not sample.cells.is_native and not sample.refines_in_place:
        return "set numerics.grid = 'given' for shorter cells"
    return f"give {way_to_shorter_cells(prepared)}"


def shorter_cells_in_motion(prepared: Prepared, pair: StripOnTwoGrids, purpose: str = "") -> str:
    """Return how a scene whose roughness moves takes shorter cells than those of ``pair``, at what cost, and for which
    ``purpose``, as text; or that it is to accept the error."""
    scene = prepared.scene
    sample = prepared.sample
    sample_coarsening = sample_coarsening_of(scene, sample)
    if pair.has_halved_cells:
        sample_coarsening = SampleCoarsening((sample_coarsening[0], sample_coarsening[1] // 2))
    along = sample.cells.coarsening[0] * sample_coarsening[0]
    if along == 1:  # cells of the map, on which most of the error depends
        way = way_to_shorter_cells(prepared, along_x=True)
        return f"give {way} and numerics.grid = 'given' for shorter cells{purpose}"
    (fx, fy) = (a * b for a, b in zip(sample.cells.coarsening, sample_coarsening))
    times = fx * fx * fy  # as many more steps in time as cells along x
    work = times * pair.resolved.work
    cost = f"some {float(f'{times:.2g}'):g} times the work of a strip"
    if work > LONGEST_WORK:
        return ACCEPT_CELLS
    with_model = "" if work <= MOST_WORK_OF_POINT else " and numerics.model = 'deterministic'"
    return f"set numerics.grid = 'given'{with_model} for shorter cells ({cost}){purpose}"


def _narrows_numerical(prepared: Prepared, levels: Levels) -> str:
    """Return what narrows the numerical error, as text: where roughness moves, or shorter cells are too many, no
    tolerance does."""
    if has_moving_roughness(prepared.scene):
        return shorter_cells_in_motion(prepared, levels.pairs[0], " to reduce it")
    if levels.end_of_cells is EndOfCells.TOO_MANY:
        return f"{_fewer_cells(prepared.sample)} to reduce it"
    if levels.end_of_cells is EndOfCells.UNSOLVED:
        return f"{FILTERED_MAP} to reduce it"
    narrower = MORE_WORK if levels.end_of_cells.lacks_work else SMALLER_SOLVE_TOLERANCE
    return f"{narrower} to reduce it"


def _fewer_cells(sample: Sample) -> str:
    """Return what gives ``sample`` fewer cells, as text."""
    return SMALLER_PATCH if sample.refines_in_place else PATCH_IN_PLACE


def _why_no_sampling_error(prepared: Prepared, levels: Levels) -> str:
    """Return why the sampling error of the strips of ``levels`` is not known, and what to change."""
    scene = prepared.scene
    sample = prepared.sample
    samples = samples_over_time(levels.pairs)
    width = sample.correlation_lengths[1]
    if not samples:
        return why_sample_too_short(scene, levels.length / width, sample)
    (first, *_) = samples
    (moments, places) = first.friction.shape
    return why_too_few_blocks(
        scene,
        sample,
        blocks=first.block_counts(width),
        needed=least_blocks(summit_control(prepared)),
        size=(moments * first.travelled, places * first.spacing / width),
        size_of_block=(TIME_BLOCK, PLACE_BLOCK),
    )


def _sample_notes(prepared: Prepared, error: StandardError, levels: Levels) -> tuple[str, ...]:
    """Return what a reader should know of the sampling ``error`` of the strips of ``levels``."""
    tolerance = prepared.scene.numerics.sampling_tolerance
    if math.isnan(error.value):
        return _why_no_sampling_error(prepared, levels), BIASED
    if error.value <= SAMPLING_ERROR_MISSED * tolerance:
        return ()
    half_widths = [half_width_of_error(each, error.freedom) for each in (error.value, tolerance)]
    f = levels.numbers["coefficient"]
    if is_near_zero(f, half_widths[0]):
        return (f"{SAMPLING_ERROR} is {abs(f) * half_widths[0]:.2g} in f itself, which is below {NEAR_ZERO:g}",)
    (stated, target) = percent_beside(*half_widths)
    note = f"{SAMPLING_ERROR} is {stated}, above {target}; {standard_error_in_words(tolerance)} sets this limit"
    needed = _area_needed(prepared, error, levels)
    return (note, why_map_too_small(tolerance, needed)) if needed > 1 else (note,)


def _area_needed(prepared: Prepared, error: StandardError, levels: Levels) -> float:
    """Return how many times its area a map needs whose strips are all solved (`area_needed`)."""
    has_ended = prepared.sample.ends_after(len(levels.pairs))
    return area_needed(error.value, prepared.scene.numerics.sampling_tolerance, has_ended=has_ended)


def _words_of_levels(levels: Levels) -> str:
    """Return the film in one phrase: its strips and cells, and what was added up."""
    first = levels.pairs[0].resolved.result
    count = len(levels.pairs)
    pieces = levels.pieces
    strips = f"{counted(count, 'strips')} of {first.pressure.shape[0]} x {first.pressure.shape[1]} cells"
    if levels.control_strips:
        strips += f" of a line of {counted(levels.control_strips, 'strips')}"
    if pieces:
        (times, *more) = _shorter_cells(levels)
        strips += f", with the effect of cells {times} times as short on {counted(len(pieces), 'pieces')}"
        if more:
            strips += f" and of cells {more[0]} times as short on one of them, or a part of it"
    if not levels.control_strips:
        return f"solved together with the contact on {strips}"
    return f"solved together with the contact: the difference from Eq. (8) on {strips}"


def _shorter_cells(levels: Levels) -> tuple[int, ...]:
    """Return how many times as short as those of the strips the cells of each further level are; () without one."""
    if not levels.pieces:
        return ()
    of_strips = levels.pieces[0].on_cells_of_strips.result.spacing
    last = [levels.pieces[0], *([levels.shortest] if levels.shortest else [])]
    spacings = [piece.on_shortest_cells.result.spacing for piece in last]
    return tuple(round(max(long / short for long, short in zip(of_strips, spacing))) for spacing in spacings)


def _division(scene: Scene, numbers: dict[str, float], results: Sequence[DeterministicResult]) -> str:
    """Return the load that rubs with f_b, by its parts, as text: those of the answer, and the cells that touch on the
    strips."""
    thin, saturated = (numbers[f"{name}_film_load"] / scene.bodies.load for name in ("boundary", "saturated"))
    touching = mean(result.split.touching / result.load for result in results)
    on_touching = percent_or_less(touching, 3)
    text = f"load on gaps below the boundary film {percent_or_less(thin, 3)} (on touching cells {on_touching})"
    if saturated > 0:
        of = "asperity" if scene.lubricant.has_unlimited_stress else "film"
        text += f", on film at its limiting stress {percent_or_less(saturated, 3)}, which is part of the {of} load"
    return text


def violations_by_correction(by_summits: float, of_sample: float, f: float) -> Iterator[Violation]:
    """Yield the note that ``f`` is corrected ``by_summits`` (relative to f) by more than `LARGE_CORRECTION`, or than
    the error ``of_sample`` at 95 %, if that is `SMALL_CORRECTION` at least. Where f is near 0, a correction within that
    error has none."""
    if is_near_zero(f, of_sample) and abs(by_summits) <= of_sample:
        return
    limit = min(LARGE_CORRECTION, max(of_sample, SMALL_CORRECTION)) if math.isfinite(of_sample) else LARGE_CORRECTION
    if abs(by_summits) > limit:
        yield Violation(
            assumption=Assumption.SAMPLE_LIKE_SURFACE,
            what="correction of f for the summits of the sample",
            value=100 * abs(by_summits),
            limit=100 * limit,
            unit="%",
            consequence=f"f contains a correction of {100 * by_summits:+.2g} %, because the summits of the sample differ "
            "from those of the infinite surface; the sampling error is that of the corrected f",
            recommendation="",
            is_note=True,
            effect=abs(by_summits),
        )
