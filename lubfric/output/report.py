"""report.html of a run: one page that a reader understands who was not there. It needs no other file, and prints."""

import base64
import math
from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from html import escape
from itertools import cycle
from typing import Any

import numpy as np

from ..errors import InputError
from ..estimate import PARTS, FrictionResult
from ..models import title_of
from ..models.deterministic import FLOOR
from ..models.shared import (
    ERROR_OF_ORDER_OF_MAGNITUDE,
    LARGE_NUMERICAL_ERROR,
    Assumption,
    ExpectedEffect,
    GatheredTexts,
    Prepared,
    UnmodelledEffect,
    at_values,
    change_in_words,
    percent,
    percent_of_sides,
    sentence,
)
from ..quantities import COLUMNS, KEYS, counted, worded_value
from ..scene import Scene, moment_in_words, short_keys
from ..studies import CurveResult, Law, StribeckResult, TractionResult, columns_of_curve
from ..time import TransientResult, effects_of_run, in_motion, rolls, run_model_of
from ..units import converted, interval_in_words, plain_number, printed, unit_of_largest, with_interval, worded
from .describe import TABLE_CAPTION, SceneEstimate, belongs_to_curve, is_among, rolling_in_words
from .inputs import FACTS, INPUT_SECTIONS, inputs, over_the_run
from .missed_tolerances import MissedTolerance, missed_tolerances
from .page import framed
from .run_files import captions

# columns of the operating table, after the swept quantity, f and its interval
OF_POINT = ("power_loss", "full_load_film", "lambda_ratio")
# Columns of the table of a run in time: before f, or after it.
OF_OUTPUT = {
    "time": "before",
    "angle_of_rotation": "before",
    "entrainment_speed": "before",
    "sliding_speed": "before",
    "load": "before",
    "power_loss": "after",
    "full_load_film": "after",
    "lambda_ratio": "after",
    "min_film": "after",
}

# Caption of the picture of a curve of one point.
CAPTION_OF_POINT = "Friction with its parts and its interval, load ratios and film of the point"
# Heading of the column of the intervals of f.
INTERVAL_OF_F = "95 % interval of f"
# What follows the scene's own speed or ratio in the table of a curve.
OPERATING_POINT = " (operating point)"
# Which force f is, where a reader may ask for its sign.
SIGN_OF_F = (
    "f is the force on surface 2 ([counterface], which moves at U (1 + S/2)) against its sliding over surface 1 ([surface], U (1 - "
    "S/2)), over the load: positive where it resists the sliding, at either sign of the slide-roll ratio S. The rolling part raises f "
    "at positive S, and lowers it, even below 0, at negative S."
)
# What a smallest film of `FLOOR` is.
GAP_OF_TOUCHING = "the gap that the deterministic model assumes where asperities touch, not a computed film"
# Relative rounding error of that gap as a mean over strips. A choice: any number between rounding and a nanometre does.
FLOOR_ROUNDING = 1e-6
# Rows of the table of a run in time, about. A choice, for a table that can be read.
HISTORY_ROWS = 13
# Quantities whose change over time decides of which outputs that table has rows. A choice: what a user puts into a run, and f.
CHANGING = ("entrainment_speed", "sliding_speed", "load", "coefficient")
# Part of the change of a run that is below it. A choice: above the differences of moments that repeat one another.
SAME_CHANGE = 1e-3
# Labels of the parts of the uncertainty budget; that of an input that the scene does not give names it (`budget_labels`).
BUDGET = {name: part.label for name, part in PARTS.items()}
# The same where the error of the cells is a model-form one.
BUDGET_ON_LONG_CELLS = {name: part.label_on_long_cells or part.label for name, part in PARTS.items()}
# A number smaller than this times the largest of its column is 0 in a table: frequencies are written with nine digits.
# A choice: any number between rounding and a digit shown does.
TABLE_ROUNDING = 1e-8

# Asperity load ratio up to which the solved film is that of the total load, and is stated beside the formula. A convention.
FULL_FILM_PART = 0.01

# What the page has where there are no warnings.
NO_WARNINGS = "No checked limit of the model is exceeded."

# Loads that say what carries F_T.
LOADS = ("contact_load", "film_load", "boundary_film_load", "saturated_film_load")

# Part of the load on films at their limiting stress from which it is stated. A convention.
LEAST_AT_LIMIT = 0.01

# Ratio of the solved speeds on both sides of a point, up to which they show how f changes there. A convention.
MOST_STEP = 10.0

# Factor on the speed, of which the change of f is stated. A choice: any other is as good.
FASTER = 1.1

# Largest error of f between the solved speeds that is stated: beyond it f is not known there. A convention.
LARGEST_BETWEEN = 0.5

# Columns of a table that a narrow screen shows as they are. A choice, by looking at the report.
NARROW_COLUMNS = 3
# Columns of a table from which on its numbers may wrap, so that it fits a page. A choice, by looking at the report.
MANY_COLUMNS = 8
MOST_GIVEN = 60  # characters of a value in the column of how an input was given; a choice, by looking at the report


def report_page(
    prepared: Prepared,
    result: CurveResult | TransientResult,
    *,
    record: dict[str, Any],
    contents: dict[str, bytes],
    estimate: SceneEstimate,
    given: dict[str, Any],
    law: Law | str = "",
) -> bytes:
    """Return the page of ``result``.

    Parameters
    ----------
    record : what result.json holds
    contents : content of the files of the run by name, its pictures among them
    estimate : what was known before the solve
    given : tables of the scene as the user wrote them
    law : the formula of a curve, or why it has none; "" for what is no Stribeck curve
    """
    scene = prepared.scene
    parts = (
        _curve_parts(scene, result, law, estimate)
        if isinstance(result, CurveResult)
        else _history_parts(prepared, result, estimate)
    )
    return framed(
        "report.html",
        "friction of a lubricated line contact",
        f"{scene_in_words(scene)}. {record['date']}, lubfric {record['versions']['lubfric']}.",
        parts
        | {
            "name": escape(scene.name),
            "curve": _pictures(contents, shows_answer=True, caption=_caption_of_point(result)),
            "warnings": warnings_and_notes(result.gathered, gap_notes(result)),
            "inputs": "".join(inputs_as_given(scene, section, given.get(section, {})) for section in INPUT_SECTIONS),
            "pictures": _pictures(contents, shows_answer=False)
            or "<p>There is no contact or rough surface to show.</p>",
            "method": methods_to_quote(
                [scene_in_words(scene), *[f"roughness: {text}" for text in estimate.sections["surface"][:1]]], result
            )
            + _method(prepared, result, estimate),
            "made": _made(record),
        },
    )


def methods_to_quote(facts: Sequence[str], result: Any) -> str:
    """Return a paragraph about the ``facts`` of a scene and the methods of its ``result`` (`cite`), which a reader may quote."""
    text = " ".join([*map(sentence, facts), result.cite("methods")]).strip()
    return f'<p class="small">Methods, to quote:</p><blockquote>{escape(text)}</blockquote>' if text else ""


def gap_notes(result: CurveResult | TransientResult) -> list[str]:
    """Return a note for each range in which a traction curve does not determine f; none for other results."""
    return [gap.text for gap in result.gaps] if isinstance(result, TractionResult) else []


def _caption_of_point(result: CurveResult | TransientResult) -> str:
    """Return the caption of the picture of a curve of one point; "" of any other result."""
    return CAPTION_OF_POINT if isinstance(result, CurveResult) and len(result.points) == 1 else ""


def _pictures(contents: dict[str, bytes], *, shows_answer: bool, caption: str = "") -> str:
    """Return the pictures among ``contents`` that the page shows beside its answer, or at its end; ``caption``: of all of them, ""
    for their own."""
    return "".join(
        picture(contents[name], caption or text) for name, text in captions(contents, shows_answer=shows_answer).items()
    )


def scene_in_words(scene: Scene) -> str:
    """Return the contact and the oil of a scene in a line."""
    bodies = scene.bodies
    oil = scene.lubricant
    warm = "" if oil.temperature is None else f" at {oil.temperature - 273.15:.4g} °C"
    radius = over_the_run(scene, "radius", bodies.radius, "m")
    load = over_the_run(scene, "load", bodies.load, "N")
    viscosity = over_the_run(scene, "viscosity", oil.viscosity, "Pa s")
    return (
        f"Line contact of reduced radius {radius} and length {worded(bodies.width, 'm')} under {load}, in an oil of "
        f"{viscosity}{warm}"
    )


# curves


def _curve_parts(scene: Scene, curve: CurveResult, law: Law | str, estimate: SceneEstimate) -> dict[str, str]:
    """Return the parts of the page that a curve fills."""
    nearest = _nearest(scene, curve)
    failed = bool(curve.errors)
    point = None if nearest is None else nearest[0]
    answer = ["No point of the curve has an answer."] if nearest is None else _curve_answer(scene, curve, *nearest)
    effects = estimate.effects if point is None else point.unmodelled_effects
    return {
        "kind": status_kind(failed=failed, inexact=_largely_inexact(curve) + len(_missed(scene, curve))),
        "status": escape(curve_status(scene, curve)),
        "answer": paragraphs(answer),
        "budget": "" if nearest is None else _point_budget(*nearest[:2]),
        "table": _operating_table(scene, curve),
        "effects": effects_table(effects, "before the solve" if nearest is None else nearest[1])
        + _effects_at_other_points(curve, {effect.what for effect in effects}),
        "details": _details(curve) + _law(law, curve),
        "sources": bullets(curve.cite().splitlines()),
    }


def _effects_at_other_points(curve: CurveResult, listed: Container[str]) -> str:
    """Return the table of the effects that are not modelled and are not ``listed`` for the operating point, each at the point of
    the curve where it changes f the most; "" where there are none."""
    largest: dict[str, tuple[float, UnmodelledEffect, str]] = {}
    for index, point in enumerate(curve.points):
        if point is None:
            continue
        for effect in point.unmodelled_effects:
            if effect.what in listed:
                continue
            change = float(np.nan_to_num(effect.largest_change * abs(point.coefficient)))
            if effect.what not in largest or change > largest[effect.what][0]:
                largest[effect.what] = (change, effect, _place(curve, index))
    shown = sorted(largest.values(), key=lambda row: -row[0])
    place = "at other points of the curve, each at that at which it changes f the most"
    moments = [where.removeprefix("at ") for *_, where in shown]
    return effects_table([effect for _, effect, _ in shown], place, moments) if shown else ""


def status_kind(*, failed: bool, inexact: int) -> str:
    """Return the kind of a status, a class of the style sheet: whether points ``failed``, and whether (not 0) f is ``inexact``:
    an order of magnitude, or beyond a tolerance."""
    if failed:
        return "failed"
    return "inexact" if inexact else ""


# Assumptions on errors of f, whose violation the status of a run names.
ERRORS_OF_F = (Assumption.NUMERICAL_ERROR, Assumption.MODEL_FORM_ERROR)

# What is known of f where the sample is too short for an interval.
WITHOUT_SAMPLING = (
    "The 95 % interval is not known, because the sampling error is not known; the other errors alone give {}."
)


def curve_status(scene: Scene, curve: CurveResult) -> str:
    """Return in sentences whether all points of ``curve`` of ``scene`` were solved, and which of its tolerances they miss; the
    first failure with its message."""
    plural = curve.SWEPT[3]
    total = len(curve.points)
    solved = total - len(curve.errors)
    if not curve.errors:
        head = "The point is solved." if total == 1 else f"All {total} {plural} are solved."
        if _largely_inexact(curve) == 0:
            head = f"Converged: {head[0].lower()}{head[1:]}"
        points = [point for point in curve.points if point is not None]
        unknown = sum(not math.isfinite(point.uncertainty.interval[0]) for point in points)
        sentences = shortfalls(_missed(scene, curve), unknown, total, lambda index: _place(curve, index))
        errors = [point.uncertainty.numerical for point in points]
        return " ".join((*orders_of_magnitude(errors), head, *sentences))
    first = min(curve.errors)
    return f"Not complete: {solved} of {counted(total, plural)} solved. First failure {_place(curve, first)}: " + str(
        curve.errors[first]
    )


def _missed(scene: Scene, curve: CurveResult) -> list[MissedTolerance]:
    return list(missed_tolerances(columns_of_curve(curve), [scene] * len(curve.points)))


def _largely_inexact(curve: CurveResult) -> int:
    """Return at how many points of ``curve`` the numerical error of f is a warning."""
    return sum(
        any(each.assumption == Assumption.NUMERICAL_ERROR and not each.is_note for each in point.validity)
        for point in curve.points
        if point is not None
    )


def orders_of_magnitude(errors: Iterable[float]) -> list[str]:
    """Return at how many solved points, with these relative numerical ``errors`` of f, f is known to an order of magnitude only,
    in a sentence; none where there are none."""
    are_large = [error > ERROR_OF_ORDER_OF_MAGNITUDE for error in errors]
    if not any(are_large):
        return []
    where = "The" if len(are_large) == 1 else f"At {sum(are_large)} of {len(are_large)} points the"
    return [
        f"{where} numerical error of f is above {percent(ERROR_OF_ORDER_OF_MAGNITUDE)}, so f is only an order of magnitude (see the "
        "warnings)."
    ]


def shortfalls(exceeded: Sequence[MissedTolerance], unknown: int, total: int, place: Callable[[int], str]) -> list[str]:
    """Return which tolerances of ``total`` solved points are ``exceeded`` and where (``place`` of a row), and how many points have an
    ``unknown`` interval, in sentences."""
    sentences = [each.in_words(total, place) for each in exceeded]
    if exceeded and not unknown:
        sentences.append(f"The interval of f includes {'this error' if len(exceeded) == 1 else 'these errors'}.")
    if unknown > 0:
        head = f"At {unknown} of {total} points the" if total > 1 else "The"
        sentences.append(f"{head} interval of f is not known.")
    return sentences


def operating_point_not_solved(scene: Scene, solved: Iterable[float], name: str = "speed") -> str:
    """Return in a sentence why a curve over speeds or slide-roll ratios (``name``: "speed", "ratio") has no point at the
    scene's own one, which is its operating point; "" where it is one of those ``solved``."""
    value = operating_point_of(scene, name)
    others = list(solved)
    if is_among(value, others):
        return ""
    key = "motion.entrainment_speed" if name == "speed" else "motion.slide_roll_ratio"
    what = f"The scene's own {'speed' if name == 'speed' else 'slide-roll ratio'}, {worded_value(key, value)} ({key}), is not solved, "
    if name == "speed" and value == 0:
        return f"{what}because a curve over the speed has no point at rest."
    if name == "speed" and not belongs_to_curve(value, others):
        return f"{what}because the curve is in the other direction."
    return f"{what}because --{name}s does not contain it."


def operating_point_of(scene: Scene, name: str) -> float:
    """Return the scene's own "speed" [m/s] or slide-roll "ratio"."""
    return scene.motion.entrainment_speed if name == "speed" else scene.motion.slide_roll_ratio


def _curve_answer(
    scene: Scene, curve: CurveResult, point: FrictionResult, place: str, sliding_speed: float
) -> list[str]:
    """Return the answer of a curve in sentences: at the point nearest to the scene's own, whose surfaces slide at
    ``sliding_speed`` [m/s], and over all."""
    swept = curve.SWEPT[0]
    own = operating_point_of(scene, swept)
    values = getattr(curve, swept).tolist()
    missing = operating_point_not_solved(scene, values, swept)
    failed = [index for index in curve.errors if is_among(own, [values[index]])]
    if failed:
        missing = f"The scene's own {COLUMNS[swept].label}, {worded_value(swept, own)}, has no answer (see the status)."
    if len(values) > 1 and not missing:
        place += ", the operating point of the scene"
    low, high = point.uncertainty.interval
    unknown = "" if not math.isnan(point.uncertainty.model) else " The model-form error is not known and not included."
    omitted = f"; {point.not_in_interval}" if point.not_in_interval else ""
    sentences = [f"f = {with_interval(point.coefficient, low, high)} {place}{omitted}.{unknown}"]
    if missing:
        sentences.append(f"{missing} The answer is for the nearest solved one.")
    if others := point.uncertainty.without_sampling_in_words:
        sentences.append(WITHOUT_SAMPLING.format(others))
    sentences.append(_inputs_in_interval(point))
    if isinstance(curve, TractionResult) or np.nanmin(curve["coefficient"]) < 0:
        sentences.append(SIGN_OF_F)
    if point.decision.basis:
        sentences.append(f"The model of this point is the {point.decision.basis}.")
        sentences += _change_of_model(curve)
    low, high = point.power_loss_interval
    loss = f"The power loss is {with_interval(point.power_loss, low, high, unit='W')}"
    sentences.append(f"{loss}{rolling_in_words(point, sliding_speed)}.")
    if math.isfinite(point.lambda_ratio):
        sentences[-1] += (
            f" The full-load film by closed forms is {plain_number(point.full_load_film, 'm')} thick, a lambda ratio of "
            f"{point.lambda_ratio:.3g}."
        )
        if point.contact_load <= FULL_FILM_PART * (point.contact_load + point.film_load):
            sentences[-1] += (
                f" The film carries the load, and the solved film is {plain_number(point.central_film, 'm')} thick at the "
                f"centre, {point.film_to_roughness_ratio:.3g} times Sq."
            )
    share = point.contact_load / (point.contact_load + point.film_load)
    rubbing = point.decision.contact_load_in_words.format(part=f"{100 * share:.3g} %")
    if math.isfinite(point.mean_gap):
        rubbing += f"; the mean separation of the surfaces is {plain_number(point.mean_gap, 'm')}"
    sentences.append(f"{rubbing}.")
    f = curve["coefficient"]
    solved = np.flatnonzero(np.isfinite(f))
    if solved.size > 1:
        least = _place(curve, solved[f[solved].argmin()])
        largest = _place(curve, solved[f[solved].argmax()])
        ends = f"from {plain_number(f[solved].min())} {least} to {plain_number(f[solved].max())} {largest}"
        sentences.append(f"Over the {counted(solved.size, curve.SWEPT[3])} solved, f goes {ends}.")
    return [*sentences, *_by_speed(curve, point), *_lift_off(curve, point)]


def _inputs_in_interval(point: FrictionResult) -> str:
    """Return in a sentence which inputs the interval of f of a ``point`` contains, and what is taken of all others."""
    known = point.uncertainty
    if not math.isfinite(known.sampling):
        return ""
    names = [*known.inputs_in_interval, *([known.missing_input] if known.not_given else [])]
    labels = dict.fromkeys(names_of_inputs([name]) for name in names)
    if not labels:
        return "The interval contains no error of the inputs: all of them count as exact."
    *first, last = labels
    words = " and ".join(filter(None, (", ".join(first), last)))
    ranges = "ranges" if first else "range"
    return f"The interval contains the {ranges} of {words}. All other inputs count as exact."


def _change_of_model(curve: CurveResult) -> list[str]:
    """Return in a sentence which points of a ``curve`` are by which model, and what that does to its numbers; none where all are
    by the same."""
    name, _, unit, plural = curve.SWEPT
    places: dict[str, list[float]] = {}
    for value, point in zip(getattr(curve, name).tolist(), curve.points):
        if point is not None:
            places.setdefault(_model_of(point), []).append(value)
    if len(places) < 2:
        return []
    parts = "; ".join(f"{at_values(values, unit, plural)} by the {model}" for model, values in places.items())
    return [
        f"Several models solved the points: {parts}. Each model has its own error, so numbers other than f, such as the smallest film "
        "and the temperature rises, jump where the model changes."
    ]


def _model_of(point: FrictionResult) -> str:
    """Return what a ``point`` is by, as text."""
    return model_in_words(point.decision.basis, point.decision.model)


def model_in_words(basis: str, model: str) -> str:
    """Return by which ``model`` a point is; the ``basis`` where it has one (`lubfric.models.shared.Decision`)."""
    return basis or title_of(model)


def _by_speed(curve: CurveResult, point: FrictionResult) -> list[str]:
    """Return in a sentence how f and the lambda ratio of a ``point`` in mixed lubrication change with the speed, between the
    solved speeds on both sides of it; none for other points, or where these are far apart.

    At the same slide-roll ratio the equations of film and shear contain the viscosity in the product with the speed alone,
    but for the heat and for the pressure-viscosity coefficient, which is held.
    """
    if not isinstance(curve, StribeckResult) or point.contact_load <= FULL_FILM_PART * (
        point.contact_load + point.film_load
    ):
        return []
    good = np.flatnonzero((curve["coefficient"] > 0) & (curve["lambda_ratio"] > 0) & (curve.speed * point.speed > 0))
    size = np.abs(curve.speed)
    slower = [index for index in good if size[index] < abs(point.speed)]
    faster = [index for index in good if size[index] > abs(point.speed)]
    if not slower or not faster:
        return []
    ends = [max(slower, key=lambda index: size[index]), min(faster, key=lambda index: size[index])]
    (low, high) = size[ends]
    if high > MOST_STEP * low:
        return []
    by_factor = math.log(FASTER) / math.log(high / low)
    changes = []
    for name in ("coefficient", "lambda_ratio"):
        (first, last) = curve[name][ends]
        changes.append(f"{100 * ((last / first) ** by_factor - 1):+.2g} %")
    return [
        f"Between U = {low:.4g} and {high:.4g} m/s, {100 * (FASTER - 1):.0f} % more speed changes f by {changes[0]} and the "
        f"lambda ratio by {changes[1]}. As much more viscosity has the same effect, except for heat."
    ]


def _lift_off(curve: CurveResult, point: FrictionResult) -> list[str]:
    """Return the lift-off speed of a curve over the speed in sentences, and how well f is known between its speeds; none
    for too few points. ``point``: that of the answer."""
    if not isinstance(curve, StribeckResult):
        return []
    try:
        speed = curve.lift_off
        low, high = curve.lift_off_range
    except InputError:  # too few points, or in both directions
        return []
    if speed is None:
        touching = np.nanmax(curve.contact_load[curve.speed != 0]) > 0
        first = f"The lift-off speed is {'above' if touching else 'below'} the speeds solved."
    elif math.isnan(speed):
        first = (
            f"The lift-off speed, above which the film separates the surfaces, lies between the solved speeds {low:.4g} and "
            f"{high:.4g} m/s; "
        )
        inexact = curve.numerical_at_lift_off
        first += (
            f"the numerical error of f there, {percent(inexact)}, is too large to say where."
            if inexact > LARGE_NUMERICAL_ERROR
            else "solve more speeds between them to determine it."
        )
    else:
        surface = ", for this sample of the surface" if point.uncertainty.sampling else ""
        known = with_interval(speed, low, high, " by the solved speeds alone", unit="m/s")
        first = f"The lift-off speed, above which the film separates the surfaces, is {known}{surface}."
    if curve.between > LARGEST_BETWEEN:
        between = "Between some of the solved speeds f is not known."
    else:
        between = (
            f"Between the solved speeds f is interpolated within {percent(curve.between)}, in addition to the errors of these points"
            f"{_largest_error_of_points(curve)}."
        )
    return [f"{first} {between} {minimum_in_words(curve)}"]


def _largest_error_of_points(curve: StribeckResult) -> str:
    """Return how large half the 95 % interval of f at a point of a curve is at most, as text to be appended; "" where that is
    not known, or f is near 0."""
    if any(point is not None and point.uncertainty.is_near_zero for point in curve.points):
        return ""
    good = np.isfinite(curve.coefficient) & (curve.coefficient != 0)
    low, high = curve.uncertainty.interval[good].T
    widths = 0.5 * (high - low) / np.abs(curve.coefficient[good])
    return f" (up to {percent(float(widths.max()))} at 95 %)" if np.isfinite(widths).all() else ""


def minimum_in_words(curve: StribeckResult) -> str:
    """Return in a sentence between which of the solved speeds f is least, as far as these bracket it."""
    minimum = curve.minimum
    solved = np.sort(curve.speed[np.isfinite(curve.coefficient) & (curve.speed != 0)])
    low = float(solved[solved <= minimum.speeds[0]].max(initial=solved[0]))
    high = float(solved[solved >= minimum.speeds[1]].min(initial=solved[-1]))
    if minimum.is_bracketed:
        f = with_interval(minimum.coefficient, *minimum.interval)
        return f"The minimum of f is {f}, between U = {low:.3g} and {high:.3g} m/s."
    more = "solve more speeds there, or let --speeds auto choose them"
    if minimum.is_inside:
        return f"The minimum of f lies between U = {low:.3g} and {high:.3g} m/s; {more}."
    outside = " and ".join(
        name for name, reached in (("below", low <= solved[0]), ("above", high >= solved[-1])) if reached
    )
    return f"The minimum of f lies between U = {low:.3g} and {high:.3g} m/s, or {outside} the speeds solved; {more}."


def names_of_inputs(keys: Iterable[str]) -> str:
    """Return the labels of the inputs of these ``keys`` (section.key), each once; "input" where there is none."""
    labels = (COLUMNS[key].label if key in COLUMNS else key for key in keys)
    return " and ".join(dict.fromkeys(labels)) or "input"


def budget_labels(points: Sequence[FrictionResult], parts: dict[str, str] = BUDGET) -> dict[str, str]:
    """Return what the ``parts`` of the uncertainty budget of ``points`` are called; inputs that the scene does not give by
    their labels, and no such part where all are given."""
    missing = [known.missing_input for known in (point.uncertainty for point in points) if known.not_given]
    labels = {name: text.format(names_of_inputs(missing)) for name, text in parts.items()}
    return {name: text for name, text in labels.items() if name != "not given" or missing}


def _budget(
    values: dict[str, float],
    words: dict[str, str],
    subject: str,
    notes: Iterable[str],
    labels: dict[str, str],
    *,
    is_cut: bool = False,
) -> str:
    """Return the uncertainty budget of ``subject`` (`lubfric.estimate.Uncertainty.budget`) as bars of its parts, relative
    to f; ``words``: the parts as text; ``labels``: what each is called; ``is_cut``: whether ``notes`` have a limit of the interval."""
    longest = max([value for value in values.values() if math.isfinite(value)], default=0.0) or 1.0
    shown = {name: label for name, label in labels.items() if name in values}
    rows = "".join(
        f'<span>{label}</span><span><i style="width:{100 * min(values[name] / longest, 1.0):.1f}%"></i></span>'
        f"<span>{escape(words[name])}</span>"
        if math.isfinite(values[name])
        else f"<span>{label}</span><span></span><span>not known</span>"
        for name, label in shown.items()
    )
    lines = bullets([sentence(note) for note in notes if note])
    unknown = {name for name in shown if not math.isfinite(values[name])}
    combined = "the interval of f combines them"
    if unknown:
        combined = "the interval of f combines those that are known"
    if unknown - {"model-form"}:
        combined = "one of them is not known, so f has no interval"
    elif is_cut:
        combined += ", within the limits stated below"
    return (
        f"<h2>Uncertainty budget</h2><p>Relative errors of {escape(subject)}, each at 95 %; {combined}.</p>"
        f'<div class="budget">{rows}</div>{lines}'
    )


def _point_budget(point: FrictionResult, place: str) -> str:
    known = point.uncertainty
    labels = budget_labels([point], BUDGET_ON_LONG_CELLS if point.decision.counts_cells_as_model_error else BUDGET)
    notes = (known.largest_part, *known.notes)
    return _budget(known.budget, known.budget_in_words, f"f {place}", notes, labels, is_cut=bool(known.cut))


def _operating_table(scene: Scene, curve: CurveResult) -> str:
    """Return the table of all points: what was swept, f with its interval, and the numbers of the point. That of the scene's
    own speed or ratio is named where there are others."""
    swept = curve.SWEPT[0]
    names = (swept, *OF_POINT)
    values = {swept: getattr(curve, swept)} | {name: curve[name] for name in OF_POINT}
    units = {name: unit_of_largest(values[name].tolist(), COLUMNS[name].unit) for name in names}
    shown = {name: converted(values[name], COLUMNS[name].unit, units[name]) for name in names}
    heads = [_heading(swept, units[swept]), "f", INTERVAL_OF_F, *(_heading(n, units[n]) for n in OF_POINT)]
    heads.append("asperity load ratio F_C/F_T")
    rows = []
    for index, point in enumerate(curve.points):
        place = f"{shown[swept][index]:.4g}"
        if len(curve.points) > 1 and is_among(operating_point_of(scene, swept), [values[swept][index]]):
            place += OPERATING_POINT
        if point is None:
            why = escape(str(curve.errors[index]))
            rows.append(f'{_cells([place])}<td colspan="{len(heads) - 1}" class="warning">{why}</td>')
            continue
        low, high = point.uncertainty.interval
        f = with_interval(point.coefficient, low, high).partition(" (")[0]
        interval = interval_in_words(low, high, value=point.coefficient)
        ratio = point.contact_load / (point.contact_load + point.film_load)
        loss = converted(np.array(point.power_loss_interval), COLUMNS["power_loss"].unit, units["power_loss"])
        numbers = [_number(shown[name][index]) for name in OF_POINT]
        numbers[OF_POINT.index("power_loss")] = with_interval(
            float(shown["power_loss"][index]), float(loss[0]), float(loss[1]), ""
        )
        rows.append(_cells([place, f, interval, *numbers, f"{ratio:.3g}"]))
    at_limit = films_at_limit({name: curve[name] for name in LOADS})
    beside = f"<p>{escape(at_limit)}</p>" if at_limit else ""
    return f"<h2>Operating points</h2>{beside}{table(heads, rows)}"


def films_at_limit(loads: Mapping[str, np.ndarray]) -> str:
    """Return in a sentence how much of the load films at their limiting stress carry that are no part of the asperity load, by
    the ``loads`` (`LOADS`) [N] of some points; "" where that is less than `LEAST_AT_LIMIT` everywhere or not known."""
    (contact, film, boundary, saturated) = (loads[name] for name in LOADS)
    shares = (saturated - np.maximum(contact - boundary, 0.0)) / (contact + film)
    shares = shares[shares > LEAST_AT_LIMIT]
    if not shares.size:
        return ""
    ends = " to ".join(dict.fromkeys(f"{100 * end:.2g}" for end in (shares.min(), shares.max())))
    where = f" at {shares.size} of {counted(contact.size, 'points')}" if contact.size > 1 else ""
    return (
        f"Films sheared at their limiting stress carry {ends} % of the load{where}; the asperity load ratio does not include "
        "this load."
    )


def _heading(name: str, unit: str) -> str:
    column = COLUMNS[name]
    return " ".join(filter(None, (column.label, column.symbol, f"[{printed(unit)}]" if printed(unit) else "")))


def _number(value: float) -> str:
    return plain_number(value) if math.isfinite(value) else "-"


def _rounded(values: np.ndarray, index: int) -> float:
    """Return one of ``values``; 0 where it is below the rounding errors of the largest."""
    value = float(values[index])
    return 0.0 if abs(value) < TABLE_ROUNDING * float(np.nanmax(np.abs(values), initial=0.0)) else value


def _details(curve: CurveResult) -> str:
    """Return the uncertainty budget of every point and the model that solved it, folded."""
    swept = curve.SWEPT[0]
    unit = unit_of_largest(getattr(curve, swept).tolist(), COLUMNS[swept].unit)
    labels = budget_labels([point for point in curve.points if point is not None])
    rows = []
    for value, point in zip(converted(getattr(curve, swept), COLUMNS[swept].unit, unit), curve.points):
        if point is not None:
            words = point.uncertainty.budget_in_words
            parts = [words[name] for name in labels]
            forces = [point.contact_load, point.film_load, point.boundary_force, point.shear_force]
            lengths = [converted(getattr(point, name), "m", "nm") for name in ("mean_gap", "central_film", "min_film")]
            numbers = [_number(number) for number in (*forces, *lengths)]
            rows.append(_cells([f"{value:.4g}", *parts, *numbers, _model_of(point)]))
    heads = [
        _heading(swept, unit),
        *(label.partition(" (")[0] for label in labels.values()),
        "asperity load F_C [N]",
        "film load F_H [N]",
        "boundary force [N]",
        "shear force of the film [N]",
        "mean separation [nm]",
        "central separation [nm]",
        "smallest film [nm]",
        "model",
    ]
    at_floor = any(point is not None and is_gap_of_touching(point.min_film) for point in curve.points)
    note = f"<p>{sentence(f'a smallest film of 1 nm is {GAP_OF_TOUCHING}')}</p>" if at_floor else ""
    return f"<details><summary>Details of every point</summary>{note}{table(heads, rows)}</details>" if rows else ""


def is_gap_of_touching(film: float) -> bool:
    """Return whether a smallest ``film`` [m] is the gap that the deterministic model gives to touching cells."""
    return math.isclose(film, FLOOR, rel_tol=FLOOR_ROUNDING)


def _law(law: Law | str, curve: CurveResult) -> str:
    """Return the formula of a curve over the speed, or why it has none, folded; "" for any other curve."""
    if not law:
        return ""
    if isinstance(law, Law) and isinstance(curve, StribeckResult):
        deviation, within = (f"{100 * error:.2g} %" for error in (law.largest, curve.between))
        fastest = law.ranges["speed"][1]
        warning = (
            f'<p class="warning">{escape(sentence(law.warning.removeprefix("warning: ")))}</p>' if law.warning else ""
        )
        text = (
            f"{warning}<p>The formula is for simulations of a machine; law.json and law.c (in C) contain it. It deviates by at "
            f"most {deviation} from the curve through the solved points, which adds at most {within} between them to "
            f"the errors of the points{_largest_error_of_points(curve)}. Check "
            f"value: f = {law(fastest):.4g} at U = {fastest:.4g} m/s.</p><pre>{escape(law.text)}</pre>"
        )
    else:
        text = f"<p>{escape(sentence(f'no formula was fitted: {law}'))}</p>"
    return f"<details><summary>The curve as a formula</summary>{text}</details>"


def _nearest(scene: Scene, curve: CurveResult) -> tuple[FrictionResult, str, float] | None:
    """Return the solved point nearest to the scene's own, its place as text, and its sliding speed [m/s]; None if no point
    has an answer."""
    name = curve.SWEPT[0]
    scene_value = operating_point_of(scene, name)
    away = np.where(np.isfinite(curve["coefficient"]), np.abs(getattr(curve, name) - scene_value), np.inf)
    index = int(away.argmin())
    point = curve.points[index]
    if point is None:
        return None
    ratio = float(curve.ratio[index]) if isinstance(curve, TractionResult) else scene.motion.slide_roll_ratio
    return point, _place(curve, index), ratio * point.speed


def _place(curve: CurveResult, index: int) -> str:
    name, symbol, unit, _ = curve.SWEPT
    return f"at {symbol} = {getattr(curve, name)[index]:.4g} {unit}".rstrip()


# runs in time


def _history_parts(prepared: Prepared, result: TransientResult, estimate: SceneEstimate) -> dict[str, str]:
    """Return the parts of the page that a run in time fills."""
    above = missed_by_run(result)
    return {
        "kind": status_kind(failed=not result.is_complete, inexact=len(above)),
        "status": escape(" ".join((result.status, *above))),
        "answer": paragraphs(
            [
                *history_answer(prepared.scene, result, complete=result.is_complete),
                *_history_notes(prepared.scene, result),
            ]
        ),
        "budget": _history_budget(result),
        "table": _history_table(result),
        "effects": _history_effects(prepared, result, estimate),
        "details": "",
        "sources": bullets(result.cite().splitlines()),
    }


def missed_by_run(result: TransientResult) -> list[str]:
    """Return the errors of f that are above their tolerances at outputs of a run, in a sentence each."""
    sentences = []
    for each in result.gathered:
        violation = each.violation
        if violation is None or violation.is_note or violation.assumption not in ERRORS_OF_F:
            continue
        worst = f"{float(f'{violation.value:.2g}'):g} {violation.unit}"
        sentences.append(
            f"{sentence(each.place).removesuffix('.')} the {violation.what} is above {violation.limit:g} {violation.unit}, up to {worst}."
        )
    return sentences


def _history_effects(prepared: Prepared, result: TransientResult, estimate: SceneEstimate) -> str:
    """Return the table of the effects that are not modelled, each at the output at which it changes f the most."""
    effects = effects_of_run(prepared, result)
    place = "of the run, each at the output at which it changes f the most"
    if result.time.size < 2 or not rolls(result.columns).any():
        effects = estimate.effects_over_time
        place = "before the solve, each at the moment at which it changes f the most"
    return effects_table([each.effect for each in effects], place, [each.moment_in_words for each in effects])


def history_answer(scene: Scene, result: TransientResult, *, complete: bool) -> list[str]:
    """Return the answer of a run of ``scene`` in time in sentences; of one that is not ``complete`` what its outputs show."""
    if result.time.size < 2:
        return ["The run has no answer."]
    mean = result.average()
    f = result.coefficient
    peak = _largest_friction(result)
    low, high = result.uncertainty.interval[peak]
    first = float(result.time[0])
    last = float(result.time[-1])
    span = worded(last, "s") if first == 0.0 else f"the time from {worded(first, 's')} to {worded(last, 's')}"
    when = (
        f"over {span}" if mean.in_motion == 1 else f"while the surfaces move ({100 * mean.in_motion:.3g} % of {span})"
    )
    head = "" if complete else "The run has no valid answer. Its outputs so far show: "
    film = plain_number(float(np.nanmin(result.min_film)), "m")
    at_floor = f": {GAP_OF_TOUCHING}" if is_gap_of_touching(float(np.nanmin(result.min_film))) else ""
    level = " at 95 %" + (", without the model-form error, which is not known" if result.model_form_unknown else "")
    mean_text = with_interval(mean.coefficient, *mean.interval, level)
    sentences = [sentence(f"{head}the mean friction coefficient {when} is {mean_text}.")]
    if result.model_form_unknown:
        sentences.append(sentence(f"why the model-form error is not known: {result.model_form_unknown}"))
    range_ = with_interval(float(f[peak]), low, high, level)
    sentences.append(f"The largest f is {range_}, at t = {_moment(result, peak)}.")
    sentences.append(_largest_force(result))
    power = result.power_loss
    if np.isfinite(power).any():
        loss = with_interval(mean.power_loss, *mean.power_loss_interval, unit="W")
        duration = last - first
        (low, high) = mean.power_loss_interval
        taken = with_interval(duration * mean.power_loss, duration * low, duration * high, unit="J")
        sentences.append(
            f"The mean power loss is {loss}, {_largest_power_loss(result)}. Friction takes {taken} in {worded(duration, 's')}."
        )
    sentences.append(
        f"The smallest film thickness is {film}{at_floor}."
        if run_model_of(scene).solves_rough_film
        else f"The solved film is thinnest {_moment_of_least_film(result)}: {film}."
    )
    ratio = result.lambda_ratio[np.isfinite(result.lambda_ratio) & rolls(result.columns)]
    if ratio.size:
        sentences.append(
            "At the outputs in motion, the lambda ratio (full-load film thickness in steady motion over Sq) lies between "
            f"{_number(float(ratio.min()))} and {_number(float(ratio.max()))}{_without_lambda_ratio(result)}."
        )
    solved = result.film_to_roughness_ratio[np.isfinite(result.film_to_roughness_ratio)]
    if solved.size:
        sentences.append(
            f"The solved central separation lies between {_number(float(solved.min()))} and {_number(float(solved.max()))} "
            "times Sq."
        )
    if result.start_in_words:
        sentences.append(result.start_in_words)
    return sentences


def _moment(result: TransientResult, index: int) -> str:
    """Return the time of an output, and the angle of rotation where it is known, as text."""
    return moment_in_words(float(result.time[index]), float(result.angle_of_rotation[index]))


def _without_lambda_ratio(result: TransientResult) -> str:
    """Return at how many outputs no oil is entrained, so that there is no lambda ratio, as text to be appended; "" for none."""
    count = int(np.sum(~rolls(result.columns)))
    return f"; {counted(count, 'outputs')} without entrainment {'have' if count > 1 else 'has'} none" if count else ""


def _largest_force(result: TransientResult) -> str:
    """Return the largest friction force of a run in motion, without its sign, with its interval and its time, in a sentence."""
    force = np.where(in_motion(result.columns), np.abs(result.friction_force), -1.0)
    index = int(np.nanargmax(force))
    load = float(result.load[index])
    (low, high) = (load * float(end) for end in result.uncertainty.interval[index])
    largest = with_interval(load * float(result.coefficient[index]), low, high, unit="N")
    return f"The largest friction force is {largest}, at t = {_moment(result, index)}."


def _largest_power_loss(result: TransientResult) -> str:
    """Return the largest power loss of a run, with its interval where that is known, and its time, as text."""
    columns = result.columns
    index = int(np.nanargmax(result.power_loss))
    (low, high) = (float(columns[f"power_loss_{end}"][index]) for end in ("low", "high"))
    largest = with_interval(float(result.power_loss[index]), low, high, unit="W")
    return f"the largest {largest} at t = {_moment(result, index)}"


def _moment_of_least_film(result: TransientResult) -> str:
    """Return when the film of a run by load sharing is thinnest, and which part of the load it carries then."""
    index = int(np.nanargmin(result.min_film))
    film = 1.0 - float(result.contact_load[index] / result.load[index])
    if film <= 0.0:
        return f"at t = {_moment(result, index)}, where asperities carry all of the load"
    others = " and asperities carry the rest" if film < 1.0 else ""
    return f"at t = {_moment(result, index)}, where it carries {100 * film:.3g} % of the load{others}"


def _history_notes(scene: Scene, result: TransientResult) -> list[str]:
    """Return what a reader of f and of its mean should know: which model answers, and where a steady point may have a
    narrower interval; and why f is negative at some times."""
    notes = [_model_of_run(scene, result)]
    negative = int(np.sum((result.coefficient < 0) & (result.sliding_speed != 0) & in_motion(result.columns)))
    if negative:
        notes.append(
            f"f is the force on surface 2 against its sliding, over the load. It is negative at "
            f"{counted(negative, 'outputs')}, where the rolling resistance of this surface exceeds the friction of "
            "sliding; the power loss includes both surfaces."
        )
    return notes


def _model_of_run(scene: Scene, result: TransientResult) -> str:
    """Return which model answers at all times, as a sentence, and at which outputs a steady point by another one may have a
    narrower interval."""
    answers = f"The {run_model_of(scene).model_in_words} answers at all times."
    target = scene.numerics.model_tolerance
    wide = in_motion(result.columns) & (result.uncertainty.model > target)
    if not wide.any():
        return answers
    return (
        f"{answers} At {counted(int(wide.sum()), 'outputs')} its model-form error is above {100 * target:g} % "
        "(numerics.model_tolerance). For a narrower interval, solve a steady point with the values of such a moment (a scene without "
        "[transient]); this helps where the deterministic model applies and heat causes less than half of this error."
    )


def _largest_friction(result: TransientResult) -> int:
    """Return the index of the output in motion with the largest friction coefficient, without its sign."""
    return int(np.nanargmax(np.where(in_motion(result.columns), np.abs(result.coefficient), -1.0)))


def _history_budget(result: TransientResult) -> str:
    """Return the uncertainty budget of the mean friction coefficient of a run in time."""
    sides = result.average().budget if result.time.size > 1 else {}
    if not sides:
        return ""
    values = {name: max(below, above) for name, (below, above) in sides.items()}
    words = {name: percent_of_sides(both, values[name]) for name, both in sides.items()}
    notes = [
        "The numerical part is the error of the integral of the film's shear stress. The error of a step in time, at most "
        "transient.tolerance, is not included",
        "The errors keep their sign at all times, so the interval of a mean is the mean of the intervals",
        *result.not_in,
    ]
    if math.isfinite(values["model-form"]):
        notes.insert(1, "The model-form error is that of steady motion at the same film, asperity load ratio and heat")
    return _budget(values, words, "the mean friction coefficient", notes, BUDGET)


def evenly_by_change(columns: Mapping[str, np.ndarray], count: int) -> list[int]:
    """Return the indices of about so many outputs of a run, the first and the last among them, between which `CHANGING`
    quantities change by about the same: moments that repeat another one are left out."""
    steps = np.zeros(columns["time"].size - 1)
    for name in CHANGING:
        values = np.nan_to_num(columns[name])
        steps += np.abs(np.diff(values)) / max(
            float(np.ptp(values)), TABLE_ROUNDING * float(np.abs(values).max(initial=1.0))
        )
    change = np.append(0.0, np.cumsum(steps))
    if not change[-1] > 0:
        return [0, change.size - 1]
    places = np.searchsorted(change, np.linspace(0.0, change[-1], count) * (1.0 - SAME_CHANGE))
    return sorted({0, *places.tolist(), change.size - 1})


def _history_table(result: TransientResult) -> str:
    """Return the table of some outputs of a run in time, more of them where it changes fast, and of those with the largest f and power."""
    count = result.time.size
    if count < 2:
        return ""
    c = result.columns
    chosen = {*evenly_by_change(c, min(HISTORY_ROWS, count))}
    chosen |= {_largest_friction(result)}
    if np.isfinite(c["power_loss"]).any():
        chosen |= {int(np.nanargmax(c["power_loss"]))}
    rows_at = sorted(chosen)
    moving = in_motion(c)
    entrains = rolls(c)
    units = {name: unit_of_largest(c[name].tolist(), COLUMNS[name].unit) for name in OF_OUTPUT}
    shown = {name: converted(c[name], COLUMNS[name].unit, unit) for name, unit in units.items()}
    shown |= {name: np.where(moving, shown[name], 0.0) for name in ("entrainment_speed", "sliding_speed", "power_loss")}
    shown |= {name: np.where(entrains, shown[name], np.nan) for name in ("full_load_film", "lambda_ratio")}
    without_angle = not np.isfinite(c["angle_of_rotation"]).any()
    omitted = {"angle_of_rotation"} if without_angle else set()
    before = [name for name in OF_OUTPUT if OF_OUTPUT[name] == "before" and name not in omitted]
    after = [name for name in OF_OUTPUT if OF_OUTPUT[name] == "after"]
    heads = [_heading(name, units[name]) for name in before]
    heads += [
        "f",
        INTERVAL_OF_F + (", without model-form error" if result.model_form_unknown else ""),
        *(_heading(name, units[name]) for name in after),
        "asperity load ratio F_C/F_T",
    ]
    rows = []
    for index in rows_at:
        low = c["interval_low"][index]
        high = c["interval_high"][index]
        f = with_interval(float(c["coefficient"][index]), low, high).partition(" (")[0]
        interval = interval_in_words(low, high, value=float(c["coefficient"][index]))
        ratio = _number(float(c["contact_load"][index] / c["load"][index]))
        numbers = [_number(_rounded(shown[name], index)) for name in after]
        if not moving[index]:
            f = "at rest"
            interval = "-"
        time = f"{shown['time'][index]:.5g}"  # two outputs differ
        others = [_number(_rounded(shown[name], index)) for name in before if name != "time"]
        rows.append(_cells([time, *others, f, interval, *numbers, ratio]))
    about = f"{len(rows)} of {counted(count, 'outputs')}, chosen by the change of speed, load and f, with the largest f and the largest power loss;"
    films = (
        " The full-load film is that of smooth surfaces under the total load; the smallest film is solved under the part "
        "of the load that the film carries, so it may be thicker."
        if (c["contact_load"] > 0).any()
        else ""
    )
    return f"<h2>Operating points</h2><p>{about} history.csv has all of them.{films}</p>{table(heads, rows)}"


# parts that all pages share


def effects_table(effects: Sequence[UnmodelledEffect | ExpectedEffect], place: str, moments: Sequence[str] = ()) -> str:
    """Return the table of the effects that are not modelled; ``moments``: of a run in time, when each is largest."""
    if not effects:
        where = place.partition(",")[0]
        return f"<p>Each known effect changes f {escape(where)} by less than numerics.tolerance.</p>"
    cells = [f"<td>{escape(text)}</td>" for text in moments] or [""] * len(effects)
    rows = [
        f"<td>{escape(sentence(effect.what))}</td>"
        f'<td class="number">{change_in_words(*effect.changes)}</td>'
        f"{moment}<td>{escape(sentence(effect.recommendation))}</td>"
        for effect, moment in zip(effects, cells)
    ]
    head = f"<p>Likely changes of f {escape(place)}, estimated with closed forms.</p>"
    heads = ["effect", "change of f", *(["largest at"] if moments else []), "recommendation"]
    return head + table(heads, rows, in_sentences=True)


def warnings_and_notes(gathered: Iterable[GatheredTexts], further_notes: Iterable[str] = ()) -> str:
    """Return the list of the warnings among the ``gathered`` violations, and below it that of the notes and the
    ``further_notes``, each a sentence."""
    known = list(gathered)
    warnings = [sentence(each.text) for each in known if not each.is_note]
    notes = [sentence(each.text_without_head) for each in known if each.is_note]
    notes += map(sentence, further_notes)
    return bullets(warnings, NO_WARNINGS, "warning") + folded_notes(bullets(notes), len(notes))


def folded_notes(notes: str, count: int) -> str:
    """Return a list of ``count`` ``notes``, folded; "" where there are none."""
    return f"<details><summary>Notes ({count})</summary>{notes}</details>" if count else ""


def inputs_as_given(scene: Scene, section: str, given: dict[str, Any], fitted: Container[str] = ()) -> str:
    """Return the inputs of a section: each value used, how it was given, and what follows from them; ``fitted``: the keys that
    a fit found."""
    shown = dict(given)
    rows = []
    for label, text, key, note in inputs(scene, section):
        name = key.partition(".")[2]
        source = "derived" if _is_derived(scene, section, name, given) else "default"
        if name in shown:
            source = _given(name, shown.pop(name))
        source = BY_FIT if key in fitted else source
        cells = f'<td>{escape(label)}</td><td>{escape(text)}{escape(note)}</td><td class="key">{escape(source)}</td>'
        rows.append(cells)
    for name, value in shown.items():
        label = KEYS[f"{section}.{name}"].label if f"{section}.{name}" in KEYS else name.replace("_", " ")
        if f"{section}.{name}" in fitted:
            continue
        used = _used_in_words(f"{section}.{name}", value)
        rows.append(
            f'<td>{escape(label)}</td><td>{escape(used)}</td><td class="key">{escape(_given(name, value))}</td>'
        )
    facts = bullets([sentence(text) for text in FACTS[section](scene)]) if section in FACTS else ""
    heads = ["quantity", "value used", "given as"]
    return (f"<h3>{section}</h3>{table(heads, rows)}" if rows else "") + facts


# A radius that is infinite: the one input that may be.
PLANE = "a plane"


def _used_in_words(key: str, value: Any) -> str:
    """Return the ``value`` of a ``key`` as a user wrote it, its numbers with their unit; "" of a table."""
    if isinstance(value, dict):
        return ""
    values = value if isinstance(value, list) else [value]
    units = (KEYS[key].unit if key in KEYS else "-").split(", ")
    numbers_with_units = zip(values, cycle(units))
    return ", ".join(PLANE if number == math.inf else worded(number, unit) for number, unit in numbers_with_units)


# How an input was given that a fit found.
BY_FIT = "fitted"


# Key of an oil by its name, from which other inputs follow.
NAMED_OIL = "oil"

# Key of the bodies by their material, from which other inputs follow.
NAMED_MATERIAL = "material"


def _is_derived(scene: Scene, section: str, name: str, given: dict[str, Any]) -> bool:
    """Return whether a value that is not among the ``given`` keys of a section follows from one of these, and is not the default
    of its key; a material or an oil with a name has values that may be alike."""
    if not any(key in given for key in (*short_keys(section), NAMED_OIL)):
        return False
    used = getattr(scene, section)
    is_default = getattr(used, name) == getattr(type(used), name, None)
    return not is_default or any(key in given for key in (NAMED_MATERIAL, NAMED_OIL))


def _given(name: str, value: Any) -> str:
    text = f"{name} = {value!r}"
    return text if len(text) <= MOST_GIVEN else f"{text[: MOST_GIVEN - 4]} ..."


def _method(prepared: Prepared, result: CurveResult | TransientResult, estimate: SceneEstimate) -> str:
    """Return what was solved and on which surface; and, folded, what was estimated before."""
    planned = [text for name in ("contact", "model") for text in estimate.sections[name]]
    lines = estimate.sections["transient"]
    nearest = _nearest(prepared.scene, result) if isinstance(result, CurveResult) else None
    if nearest is not None:
        (point, place, _) = nearest
        lines = [f"{place}: {part}" for part in point.decision.parts]
    elif isinstance(result, TransientResult):
        lines = [*lines, *planned]
        planned = []
    surface = dict.fromkeys([*estimate.sections["surface"], *prepared.surface.notes])
    heads = estimate.table[0]
    rows = [_cells(row) for row in estimate.table[1:]]
    return (
        bullets([sentence(line) for line in lines])
        + bullets([sentence(line) for line in surface])
        + "<details><summary>Estimate before the solve</summary>"
        + bullets([sentence(line) for line in planned])
        + f"<p>{escape(sentence(TABLE_CAPTION))}</p>"
        + table(heads, rows)
        + "</details>"
    )


def _made(record: dict[str, Any]) -> str:
    """Return versions, the hash of the scene, and the time of the run."""
    rows = [
        *record["versions"].items(),
        *((f"SHA-256 of the height map {path}", checksum) for path, checksum in record["map_sha256"].items()),
        ("scene", record["hash"]),
        *(
            []
            if record["seed"] is None
            else [("seed of the scene (surface.seed), from which those of the strips follow", record["seed"])]
        ),
        ("wall-clock time of the run", f"{record['seconds']:.3g} s"),
        ("processor time, all processes together", f"{record['processor_seconds']:.3g} s"),
        ("solver", record["report"]["solver"]),
    ]
    lines = [f'<td>{escape(name)}</td><td class="key">{escape(str(value))}</td>' for name, value in rows]
    note = (
        f"<p>resolved.toml contains the scene with all defaults. In its folder, <code>{escape(record['command'])}</code> "
        "computes the same numbers with the versions and height maps below.</p>"
    )
    return note + table(("", ""), lines)


def picture(content: bytes, caption: str) -> str:
    """Return a figure with the PNG ``content`` and its ``caption``."""
    data = base64.b64encode(content).decode()
    text = escape(caption)
    return f'<figure><img alt="{text}" src="data:image/png;base64,{data}"><figcaption>{text}</figcaption></figure>'


def table(heads: Sequence[str], rows: Sequence[str], *, in_sentences: bool = False) -> str:
    """Return a table that scrolls by itself where it is wider than the page. On a narrow screen each row of more than
    `NARROW_COLUMNS`, or of sentences, becomes a list in which every cell has its heading before it, so that nothing is cut."""
    kind = ' class="wide"' if len(heads) > NARROW_COLUMNS or in_sentences else ""
    kind = ' class="wide many"' if len(heads) > MANY_COLUMNS else kind
    kinds = _kinds_of_heads(heads, rows)
    head = "".join(f"<th{of_head}>{escape(text)}</th>" for text, of_head in zip(heads, kinds))
    head = f"<thead><tr>{head}</tr></thead>" if any(heads) else ""
    body = "".join(f"<tr>{_labelled(heads, row)}</tr>" for row in rows)
    return f'<div class="scroll"><table{kind}>{head}<tbody>{body}</tbody></table></div>'


def _kinds_of_heads(heads: Sequence[str], rows: Sequence[str]) -> list[str]:
    """Return the class of each heading as an attribute: that of a number, at the right, where its cells are numbers."""
    longest = max(rows, key=lambda row: row.count("<td"), default="")  # the row of a failed point joins cells
    number = ' class="number"'
    kinds = [number if cell.startswith(number) else "" for cell in longest.split("<td")[1:]]
    return kinds + [""] * (len(heads) - len(kinds))


def _labelled(heads: Sequence[str], row: str) -> str:
    """Return a ``row`` of cells, each with its heading as an attribute."""
    first, *cells = row.split("<td")
    labels = [escape(head) for head in heads] + [""] * len(cells)
    return first + "".join(f'<td data-label="{label}"{cell}' for label, cell in zip(labels, cells))


def _cells(texts: Iterable[str]) -> str:
    return "".join(f'<td class="number">{escape(text)}</td>' for text in texts)


def paragraphs(sentences: Iterable[str]) -> str:
    """Return the first sentence as the answer, the others as a paragraph."""
    first, *others = [escape(text) for text in sentences] or [""]
    more = f"<p>{' '.join(others)}</p>" if others else ""
    return f'<p class="answer">{first}</p>{more}' if first else ""


def bullets(lines: Sequence[str], otherwise: str = "", kind: str = "") -> str:
    """Return ``lines`` as a list of the class ``kind``; where there are none, ``otherwise`` as a paragraph."""
    if not lines:
        return f"<p>{escape(otherwise)}</p>" if otherwise else ""
    return f'<ul class="{kind}">{"".join(f"<li>{escape(line)}</li>" for line in lines)}</ul>'
