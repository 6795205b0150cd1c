"""The answer of a Stribeck or traction curve, in sentences."""

import math

import numpy as np

from ..errors import InputError
from ..estimate import FrictionResult
from ..models import title_of
from ..models.shared import LARGE_NUMERICAL_ERROR, at_values, is_by_sliding, percent, percent_or_less
from ..quantities import COLUMNS, worded_value
from ..scene import Scene
from ..studies import LARGEST_BETWEEN, CurveResult, StribeckResult, TractionResult, columns_of_curve
from ..time import TransientResult
from ..units import plain_number, with_interval
from .budget_bars import names_of_inputs
from .describe import is_among, rolling_in_words
from .operating_point import operating_point_not_solved, operating_point_of, place_on_curve
from .regime import FULL_FILM_PART, regime_in_words

# Ratio of the solved speeds on both sides of a point, up to which they show how f changes there. A convention.
MOST_STEP = 10.0
# Factor on the speed, of which the change of f is stated. A choice: any other is as good.
FASTER = 1.1
# What leaves open where f is least, if the points alone do not.
BY_INTERPOLATION = "the error of the interpolation between the points"
BY_NUMERICAL_ERRORS = "the numerical errors of the points"
# Which force f is, where a reader may ask for its sign.
SIGN_OF_F = (
    "f is the force on surface 2 ([counterface], which moves at U (1 + S/2)) against its sliding over surface 1 "
    "([surface], U (1 - S/2)), over the load: positive where it resists the sliding, at either sign of the slide-roll "
    "ratio S. Rolling resistance raises f at positive S, and lowers it, even below 0, at negative S."
)
# What is known of f where the sample is too short for an interval.
WITHOUT_SAMPLING = (
    "The 95 % interval is not known, because the sampling error is not known; the other errors alone give {}."
)


def curve_answer(scene: Scene, curve: CurveResult, point: FrictionResult, place: str) -> list[str]:
    """Return the answer of a curve in sentences: at the ``point`` nearest to the scene's own, and over all."""
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
    share = point.contact_load / (point.contact_load + point.film_load)
    sentences += regime_in_words(share, point.lambda_ratio)
    sentences += _inputs_in_interval(point)
    if isinstance(curve, TractionResult) or np.nanmin(curve["coefficient"]) < 0:
        sentences.append(SIGN_OF_F)
    if point.decision.basis:
        sentences.append(f"The model of this point is the {point.decision.basis}.")
        sentences += change_of_model(curve)
    low, high = point.power_loss_interval
    loss = f"The power loss is {with_interval(point.power_loss, low, high, unit='W')}"
    sentences.append(f"{loss}{rolling_in_words(point)}.")
    if math.isfinite(point.lambda_ratio):
        sq = point.full_load_film / point.lambda_ratio if point.lambda_ratio > 0 else math.nan
        over = f" over a Sq of {plain_number(sq, 'm')}" if math.isfinite(sq) else ""
        sentences[-1] += (
            f" The film thickness is {plain_number(point.full_load_film, 'm')} (full-load film by closed forms), a lambda "
            f"ratio of {point.lambda_ratio:.3g}{over}."
        )
        if point.contact_load <= FULL_FILM_PART * (point.contact_load + point.film_load):
            sentences[-1] += (
                f" The film carries the load, and the solved film is {plain_number(point.central_film, 'm')} thick at "
                f"the centre, {point.film_to_roughness_ratio:.3g} times Sq."
            )
    rubbing = point.decision.contact_load_in_words.format(part=percent_or_less(share, 3))
    if math.isfinite(point.mean_gap):
        rubbing += f"; the mean separation, which is the mean gap of the rough surfaces, is {plain_number(point.mean_gap, 'm')}"
    sentences.append(f"{rubbing}.")
    f = curve["coefficient"]
    solved = np.flatnonzero(np.isfinite(f))
    sliding = solved[is_by_sliding(columns_of_curve(curve))[solved]]
    if sliding.size > 1:
        least = place_on_curve(curve, sliding[f[sliding].argmin()])
        largest = place_on_curve(curve, sliding[f[sliding].argmax()])
        ends = f"from {plain_number(f[sliding].min())} {least} to {plain_number(f[sliding].max())} {largest}"
        where = "" if sliding.size == solved.size else " at which rolling resistance does not make most of f"
        count = f"{sliding.size} solved {curve.SWEPT[3]}"
        sentences.append(f"Over the {count}{where}, f goes {ends}.")
    return [*sentences, *_by_speed(curve, point), *_lift_off(curve, point)]


def _inputs_in_interval(point: FrictionResult) -> list[str]:
    """Return in a sentence which inputs the interval of f of a ``point`` contains, and what is taken of all others;
    none where there is no interval."""
    known = point.uncertainty
    if not math.isfinite(known.sampling):
        return []
    names = [*known.inputs_in_interval, *([known.missing_input] if known.not_given else [])]
    labels = dict.fromkeys(names_of_inputs([name]) for name in names)
    if not labels:
        return ["The interval contains no error of the inputs: all of them count as exact."]
    *first, last = labels
    words = " and ".join(filter(None, (", ".join(first), last)))
    ranges = "ranges" if first else "range"
    return [f"The interval contains the {ranges} of the {words}. All other inputs count as exact."]


def change_of_model(curve: CurveResult) -> list[str]:
    """Return in a sentence which points of a ``curve`` are by which model, and what that does to its numbers; none
    where all are by the same."""
    name, _, unit, plural = curve.SWEPT
    places: dict[str, list[float]] = {}
    for value, point in zip(getattr(curve, name).tolist(), curve.points):
        if point is not None:
            places.setdefault(model_of_point(point), []).append(value)
    if len(places) < 2:
        return []
    parts = "; ".join(f"{at_values(values, unit, plural)} by the {model}" for model, values in places.items())
    return [
        f"Several models solved the points: {parts}. Each model has its own error, so numbers other than f, such as "
        "the smallest film and the temperature rises, jump where the model changes."
    ]


def model_of_point(point: FrictionResult) -> str:
    """Return what a ``point`` is by, as text."""
    return model_in_words(point.decision.basis, point.decision.model)


def model_in_words(basis: str, model: str) -> str:
    """Return by which ``model`` a point is; the ``basis`` where it has one (`lubfric.models.shared.Decision`)."""
    return basis or title_of(model)


def _by_speed(curve: CurveResult, point: FrictionResult) -> list[str]:
    """Return in a sentence how f and the lambda ratio of a ``point`` in mixed lubrication change with the speed,
    between the solved speeds on both sides of it; none for other points, or where these are far apart.

    At the same slide-roll ratio the equations of film and shear contain the viscosity in the product with the speed
    alone, but for the heat and for the pressure-viscosity coefficient, which is held.
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
        f"Between U = {low:.4g} and {high:.4g} m/s, {100 * (FASTER - 1):.0f} % more speed changes f by {changes[0]} "
        f"and the lambda ratio by {changes[1]}. {100 * (FASTER - 1):.0f} % more viscosity does the same, but for the heat."
    ]


def _lift_off(curve: CurveResult, point: FrictionResult) -> list[str]:
    """Return the lift-off speed of a curve over the speed in sentences, and how well f is known between its speeds;
    none for too few points. ``point``: that of the answer."""
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
            "The lift-off speed, above which the film separates the surfaces, lies between the solved speeds "
            f"{low:.4g} and {high:.4g} m/s; "
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
    if not curve.between <= LARGEST_BETWEEN:
        between = "Between some of the solved speeds f is not known."
    else:
        between = (
            f"Between the solved speeds f is interpolated within {percent(curve.between)}, in addition to the errors "
            f"of these points{largest_error_of_points(curve)}."
        )
    return [f"{first} {between} {minimum_in_words(curve)}"]


def largest_error_of_points(curve: StribeckResult) -> str:
    """Return how far an end of the 95 % interval of f is from f at a point of a curve at most, as text to be appended;
    "" where that is not known, or f is near 0."""
    if any(point is not None and point.uncertainty.is_near_zero for point in curve.points):
        return ""
    good = np.isfinite(curve.coefficient) & (curve.coefficient != 0)
    f = curve.coefficient[good]
    sides = np.abs(curve.uncertainty.interval[good].T / f - 1.0)
    return f" (up to {percent(float(sides.max()))} at 95 %)" if np.isfinite(sides).all() else ""


def minimum_in_words(curve: StribeckResult) -> str:
    """Return in a sentence between which of the solved speeds f is least, as far as these bracket it."""
    minimum = curve.minimum
    speeds = curve.speed[np.isfinite(curve.coefficient) & (curve.speed != 0)]
    sense = float(np.sign(speeds[0]))
    solved = np.sort(np.abs(speeds))
    (low, high) = _solved_around(solved, minimum.speeds)
    between = f"between U = {sense * low:.3g} and {sense * high:.3g} m/s"
    if minimum.is_bracketed:
        return f"The minimum of f is {with_interval(minimum.coefficient, *minimum.interval)}, {between}."
    more = "solve more speeds there, or let --speeds auto choose them"
    is_below = low <= solved[0]
    is_above = high >= solved[-1]
    if is_below and is_above:
        return f"The speeds solved do not show where f has its minimum; {more}."
    for is_at_end, end, name, beside, others in (
        (is_above, solved[-1], "fastest", low >= solved[-2:][0], "higher"),
        (is_below, solved[0], "slowest", high <= solved[:2][-1], "lower"),
    ):
        if is_at_end and abs(minimum.speed) != end:
            return f"The minimum of f lies {between} or at {others} speeds; solve these to find it."
        if is_at_end:
            is_interpolated = (low, high) == _solved_around(solved, minimum.interpolated_speeds)
            error = BY_INTERPOLATION if is_interpolated else BY_NUMERICAL_ERRORS
            errors = "" if beside else f"; by {error} it may lie {between}"
            return f"The minimum of f is not reached: f still falls towards the {name} speed, U = {sense * end:.3g} m/s{errors}."
    return f"The minimum of f lies {between}; {more}."


def _solved_around(solved: np.ndarray, speeds: tuple[float, float]) -> tuple[float, float]:
    """Return (lowest, highest) of the ``solved`` speeds [m/s], ascending without their sign, around ``speeds``."""
    first, last = sorted(map(abs, speeds))
    return float(solved[solved <= first].max(initial=solved[0])), float(solved[solved >= last].min(initial=solved[-1]))


def gap_notes(result: CurveResult | TransientResult) -> list[str]:
    """Return a note for each range in which a traction curve does not determine f; none for other results."""
    return [gap.text for gap in result.gaps] if isinstance(result, TractionResult) else []
