"""The answer of a study, in sentences."""

import math

import numpy as np

from ..models.shared import alpha_of_points_in_words, is_by_sliding, numbers_in_words, percent, sentence
from ..quantities import COLUMNS, GIVEN_DIGITS
from ..scene import SLIDE_ROLL_RATIO_KEY, Scene
from ..studies import (
    DURATION,
    INTERVAL_COLUMNS,
    ORDERED_BY,
    POSITION,
    MainEffect,
    StudyPlan,
    StudyResult,
    columns_of_study,
    design_keys,
    differences,
    is_scattered,
    label,
    main_effects,
    mean_over_cycle,
    name_of,
    pairs_around_reversals,
    place_in_words,
    points_are_designs,
    why_not_separated,
)
from ..units import converted, interval_in_words, plain_number, printed, unit_of_largest, with_interval
from .best_designs import best_lines
from .regime import regimes_in_words
from .rolling_part import rolling_part
from .single_changes import listed_changes, single_change_lines
from .status import omitted_heat_in_words, status_of_study
from .study_points import effects_at, error_in_words, parts_of_error, scene_of_each

# Points of a study at which the effects that are not modelled are computed for its answer, at most. A choice: some ms
# each.
MOST_CHECKED_EFFECTS = 500
# Numbers on which the effects of the inputs are stated, with their symbols.
OF_EFFECTS = {"coefficient": "f", "power_loss": "P"}
# Errors that are within the intervals of the effects on f; those on P hold the error of the inputs as well.
PARTS_OF_EFFECTS = ("numerical", "sampling", "model-form")
# How the effects of inputs can be told apart.
DRAW_INDEPENDENTLY = (
    "Vary the inputs independently: all combinations, or points drawn as [sample] of a study file does."
)
# What f is at a point where nothing slides, and why the power loss there is not f times a speed.
IN_PURE_ROLLING = (
    "Nothing slides there: f is the rolling part of the force on one surface. The power loss comes from the rolling "
    "resistance of both surfaces; in their sum, the pressure on the flanks of moving roughness, which is part of f, "
    "cancels"
)
# What the intervals of the effects omit where the points are a sample of designs.
OMITS_FINITE_SAMPLE = (
    "The ranges do not include the error by the finite number of points: another sample of as many has other parts."
)
# What to do where the heat of the film is omitted.
GIVE_TEMPERATURE = (
    "Give lubricant.temperature and temperature_coefficient, or an oil (grade, nu40, oil), to include it."
)
# What the mean power loss of a path of contact is.
OF_TOOTH_PAIR = (
    "It is that of one tooth pair; for a gear, multiply it by the contact ratio if each row has the load on one pair."
)
# Combinations of what is varied beside operating points whose means are reported, at most. A choice: more makes a table
# of a text.
MOST_MEANS = 6
# What sentences call the numbers of a study with an interval.
NAMES = {"coefficient": "friction coefficient", "power_loss": "power loss"}
# Relative difference up to which two products of load and sliding speed are the same. A choice: rounding.
SAME_SLIDING = 1e-9
# Share of the variance below which the end of its interval is written as 0. A convention.
LEAST_STATED_SHARE = 1e-3


def answer_lines(result: StudyResult) -> list[str]:
    """Return the answer of a study in sentences: the best design, what the inputs do to f, of operating points the
    means over the cycle, and the smallest and the largest f and power loss with intervals and places. Without designs
    the means and the extremes are before what the inputs do."""
    rows = best_lines(result)
    effects = _main_effects_lines(result)
    if rows:
        rows += effects
        effects = []
    if result.paired and result.status.size > 1 and not points_are_designs(result.plan):
        rows += _mean_lines(result)
    rows += _extremes_lines(result)
    heat = [f"{text} {GIVE_TEMPERATURE}" for text in omitted_heat_in_words(status_of_study(result).omitted_heat)]
    return [
        *rows,
        *effects,
        *_regimes_lines(result),
        *_rolling_line(result),
        *heat,
        *_alpha_line(result),
        *_budget_line(result),
    ]


def _regimes_lines(result: StudyResult) -> list[str]:
    """Return the lubrication regimes of the points in a sentence; none where no load is known."""
    columns = columns_of_study(result)
    loads = zip(columns["contact_load"].tolist(), columns["film_load"].tolist())
    return regimes_in_words(contact / (contact + film) if contact + film else math.nan for contact, film in loads)


def _extremes_lines(result: StudyResult) -> list[str]:
    """Return the smallest and the largest f and power loss of the computed points with their intervals and places, in
    sentences, whether the two can be distinguished, and why another point has the smallest f; of one point its numbers
    alone. Without the smallest where the points are designs, as the best of them has been stated."""
    places = {name: _extremes(result, name) for name in INTERVAL_COLUMNS}
    known = {name: ends for name, ends in places.items() if ends}
    if np.count_nonzero(np.isfinite(result["coefficient"])) == 1:
        index = next(iter(known.values()))[0]
        numbers = " and ".join(f"the {NAMES[name]} is {_number_at(result, name, index)}" for name in known)
        return [f"{sentence(f'{numbers}, at {point_in_words(result, index)}')}{_why_rolling(result, index)}"]
    words = ("largest",) if points_are_designs(result.plan) else ("smallest", "largest")
    computed = " of the computed points" if result.paired and not points_are_designs(result.plan) else ""
    rows = []
    for name, ends in known.items():
        for word, index in zip(words, ends[-len(words) :]):
            why = _why_rolling(result, index) if name == "coefficient" else ""
            number = _number_at(result, name, index)
            place = point_in_words(result, index)
            rows.append(f"The {word} {NAMES[name]}{computed} is {number}, at {place}.{why}")
        rows[-1] += _whether_distinct(result, name, ends)
    return [*rows, *_orders_line(result, known), *_reversal_lines(result)]


def _extremes(result: StudyResult, name: str) -> list[tuple[int, ...]]:
    """Return the places of the smallest and the largest magnitude of a number of a study, of f where it comes from
    sliding; none where none is known."""
    sizes = np.abs(result.columns.get(name, np.full(result.status.shape, np.nan)))
    if name == "coefficient":
        sizes = np.where(is_by_sliding(result.columns), sizes, np.nan)
    if not np.isfinite(sizes).any():
        return []
    return [tuple(map(int, np.unravel_index(int(find(sizes)), sizes.shape))) for find in (np.nanargmin, np.nanargmax)]


def _number_at(result: StudyResult, name: str, index: tuple[int, ...]) -> str:
    """Return a number of a study at a point with its interval, as text."""
    low, high = (float(result[end][index]) for end in INTERVAL_COLUMNS[name])
    shown = with_interval(float(result[name][index]), low, high, unit=COLUMNS[name].unit)
    return shown + ("" if np.isfinite(low) else " (interval not known)")


def _why_rolling(result: StudyResult, index: tuple[int, ...]) -> str:
    """Return what f is where nothing slides, as a sentence to be appended; "" where something does."""
    return "" if _slides(result, index) else f" {IN_PURE_ROLLING}."


def _whether_distinct(result: StudyResult, name: str, ends: list[tuple[int, ...]]) -> str:
    """Return that the smallest and the largest of a number cannot be distinguished, as a sentence to be appended; ""
    where they can, or are not compared."""
    if result.chosen:
        return ""
    first, last = (int(np.ravel_multi_index(index, result.status.shape)) for index in ends)
    (difference,) = differences(result, name, [(first, last)])
    low = difference.interval[0]
    if first == last or not np.isfinite(low) or difference.is_distinct:
        return ""
    return f" Within the error of their difference it cannot be distinguished from the smallest (point {first + 1})."


def _orders_line(result: StudyResult, extremes: dict[str, list[tuple[int, ...]]]) -> list[str]:
    """Return why the power loss is smallest, or largest, at another point than f, in a sentence: by the product of load
    and sliding speed, or where that is the same by the rolling resistance; none where it is at the same point."""
    if result.chosen or len(extremes) < len(INTERVAL_COLUMNS):
        return []
    columns = columns_of_study(result)
    scenes = scene_of_each(result)
    for sign, word, places in zip((1.0, -1.0), ("smallest", "largest"), zip(*extremes.values())):
        rows = [int(np.ravel_multi_index(place, result.status.shape)) for place in places]
        sliding = [scenes[row].bodies.load * abs(_sliding_speed(scenes[row], columns["speed"][row])) for row in rows]
        rolling = rolling_part(columns["rolling_resistance"], columns["speed"])[rows].tolist()
        is_same = math.isclose(*sliding, rel_tol=SAME_SLIDING)
        reason = "the rolling resistance of both surfaces, a part of it," if is_same else "load times sliding speed"
        of_f, of_loss = rolling if is_same else sliding
        if rows[0] == rows[1] or not sign * of_loss < sign * of_f:
            continue
        ends = (
            f"{plain_number(of_loss, 'W')} at point {rows[1] + 1} and {plain_number(of_f, 'W')} at point {rows[0] + 1}"
        )
        return [
            f"The power loss is {word} at point {rows[1] + 1} and f at point {rows[0] + 1}, because {reason} is {ends}."
        ]
    return []


def _sliding_speed(scene: Scene, speed: float) -> float:
    """Return u2 - u1 [m/s] of a ``scene`` at an entrainment ``speed`` [m/s]."""
    return scene.motion.slide_roll_ratio * speed


def _reversal_lines(result: StudyResult) -> list[str]:
    """Return between which operating points, in the order of their place, the sliding changes its direction, and how
    small the power loss is there, in a sentence; none where it does not, or a point is solved at each change."""
    if not result.paired or not any(name in result.coords for name in ORDERED_BY):
        return []
    index = (0,) * (result.status.ndim - 1)
    pairs = pairs_around_reversals(result, index)
    if not pairs:
        return []
    loss = rolling_part(result["rolling_resistance"][index], np.array(result.plan.point_speeds))
    rows = sorted({row for pair in pairs for row in pair})
    low = float(loss[rows].min())
    high = float(loss[rows].max())
    ends = interval_in_words(low, high, "W") if high > low else plain_number(low, "W", 2)
    between = " and ".join(f"{one + 1} and {other + 1}" for one, other in pairs)
    return [
        f"Between points {between} the sliding changes its direction: f passes through 0 there, and the power loss "
        f"falls to about the rolling resistance, {ends}."
    ]


def _main_effects_lines(result: StudyResult) -> list[str]:
    """Return what the inputs that are varied do to f and to the power loss, each by itself, in a sentence each: their
    parts of the variance, else what one changes between two points that differ in it alone, or why that is not known;
    none where no designs vary."""
    lines = [_effects_in_words(result, main_effects(result, name), symbol) for name, symbol in OF_EFFECTS.items()]
    if any(lines):
        return [line for line in lines if line]
    changes = listed_changes(result)
    why = why_not_separated(result)
    known = {key for change in changes for key in change.before}
    unknown = [key for key in design_keys(result.plan) if key not in known]
    if not why or not unknown:
        return single_change_lines(result, changes)
    what = ", ".join(map(name_of, unknown)) if changes else "each input"
    lines = [f"What {what} does by itself is not known, because {why}. {DRAW_INDEPENDENTLY}"]
    return [*single_change_lines(result, changes), *lines]


def _effects_in_words(result: StudyResult, effects: dict[str, MainEffect], symbol: str) -> str:
    """Return the ``effects`` on the quantity with this ``symbol`` in a sentence, and why most of them are not known, if
    so, in another; "" where there are none."""
    if not effects:
        return ""
    trends = {-1: [f"on average {symbol} falls with it"], 0: [], 1: [f"on average {symbol} rises with it"]}
    words = []
    for key, effect in effects.items():
        low, high = (plain_number(100 * end, digits=2) if end >= LEAST_STATED_SHARE else "0" for end in effect.interval)
        known = [f"{low} to {high} %"] if np.isfinite(effect.interval).all() and low != high else []
        details = ", ".join([*known, *trends[effect.slope]])
        words.append(f"{name_of(key)} {percent(effect.share)}" + (f" ({details})" if details else ""))
    within = (
        f", with its range within the errors of {symbol} at 95 %"
        if np.isfinite([*effects.values()][0].interval).all()
        else ""
    )
    omitted = f" {OMITS_FINITE_SAMPLE}" if within and any(is_scattered(result, key) for key in effects) else ""
    return (
        f"Part of the variance of ln {symbol} that each input alone explains{within}: {'; '.join(words)}. The remaining "
        f"part comes from combinations of inputs.{omitted}{_why_not_known(result, effects, symbol)}"
    )


def _why_not_known(result: StudyResult, effects: dict[str, MainEffect], symbol: str) -> str:
    """Return why the intervals of most ``effects`` hold all parts from none to the whole variance, and what narrows
    them, in sentences; "" where they do not."""
    ends = [effect.interval for effect in effects.values()]
    unknown = sum(low < LEAST_STATED_SHARE and high > 1.0 - LEAST_STATED_SHARE for low, high in ends)
    if 2 * unknown <= len(ends):
        return ""
    columns = columns_of_study(result)
    parts = parts_of_error(columns, np.isfinite(columns["coefficient"]), [result.plan.scene])
    named = PARTS_OF_EFFECTS if symbol == OF_EFFECTS["coefficient"] else (*PARTS_OF_EFFECTS, "input")
    largest = max(named, key=lambda name: float(np.median(np.nan_to_num(parts[name].largest))))
    way = f"a smaller {largest} error does"
    if largest == "model-form":
        way = "a model with a smaller model-form error does (numerics.model)"
    return (
        f" Most of these parts are not known, because the errors of {symbol}, of which the {largest} error is the "
        f"largest, exceed its differences between the points; more points do not narrow them, {way}."
    )


def _mean_lines(result: StudyResult) -> list[str]:
    """Return the mean power loss and f over the operating points in a sentence, for each combination of what else is
    varied (at most `MOST_MEANS`)."""
    of_tooth_pair = f" {OF_TOOTH_PAIR}" if POSITION in result.coords else ""
    weighed = "each point weighted by its duration" if "duration" in result.coords else "all with the same weight"
    rows = []
    for index in list(np.ndindex(*result.status.shape[:-1]))[:MOST_MEANS]:
        where = f" for {place}" if (place := label(result.plan, (*index, slice(None)))) else ""
        low, high = (float(np.asarray(end)[index]) for end in result.mean_interval("power_loss"))
        mean = float(np.asarray(result.mean("power_loss"))[index])
        text = _mean_in_words(mean, low, high, "W")
        rows.append(f"The mean power loss of the operating points, {weighed}, is {text}{where}.{of_tooth_pair}")
        rows.append(_mean_friction(result, index, where, weighed))
    others = int(np.prod(result.status.shape[:-1], dtype=int)) - MOST_MEANS
    if others > 0:
        rows.append(
            f'The means of {others} other combinations are not listed; in Python, study.mean("power_loss") has all.'
        )
    return rows


def _mean_in_words(mean: float, low: float, high: float, unit: str) -> str:
    """Return a mean in the SI ``unit`` with its interval, or why it is not known."""
    if not np.isfinite(mean):
        return "not known, as points are not solved"
    return with_interval(mean, low, high, unit=unit) + ("" if np.isfinite(low) else " (interval not known)")


def _mean_friction(result: StudyResult, index: tuple[int, ...], where: str, weighed: str) -> str:
    """Return the mean magnitude of f over the operating points, and how they are ``weighed``, in a sentence. Where f changes its sign, as at the pitch
    point of a gear, a mean with the sign would say nothing."""
    f = result["coefficient"][index]
    ends = np.abs([result[name][index] for name in INTERVAL_COLUMNS["coefficient"]])
    crosses = result["interval_low"][index] * result["interval_high"][index] < 0
    low = np.where(crosses, 0.0, ends.min(axis=0))
    durations = np.array(result.plan.coordinates.get(DURATION, np.ones(f.shape[-1])))
    weights = np.where(result.counts_in_means(index), durations, 0.0)
    mean, least, most = (mean_over_cycle(values, weights) for values in (np.abs(f), low, ends.max(axis=0)))
    what = "mean friction coefficient" if not (f < 0).any() else "mean magnitude of the friction coefficient"
    text = _mean_in_words(mean, least, most, "-")
    return f"The {what}, {weighed}, is {text}{where}."


def _slides(result: StudyResult, index: tuple[int, ...]) -> bool:
    """Return whether the surfaces slide at a point."""
    if SLIDE_ROLL_RATIO_KEY not in result.coords:
        return result.plan.scene.motion.slide_roll_ratio != 0
    dim, ratios = result.coords[SLIDE_ROLL_RATIO_KEY]
    return bool(ratios[index[result.dims.index(dim)]] != 0)


def _alpha_line(result: StudyResult) -> list[str]:
    """Return at which points the range of an estimated pressure-viscosity coefficient is not in the interval of f, and
    by how much it changes f, in a sentence; none where there are no such points."""
    known = np.flatnonzero(np.isfinite(columns_of_study(result)["coefficient"]))
    rows = known[:: max(1, -(-known.size // MOST_CHECKED_EFFECTS))]
    effects = {row + 1: each for row, each in zip(rows.tolist(), effects_at(result, rows.tolist()))}
    text = alpha_of_points_in_words(effects, len(effects))
    some = f" Checked at {rows.size} of {known.size} points." if text and rows.size < known.size else ""
    return [f"{text}{some}"] if text else []


def _rolling_line(result: StudyResult) -> list[str]:
    """Return at which points f is that of rolling resistance in a sentence; none where it is so at none, or at all."""
    solved = np.isfinite(result["coefficient"])
    numbers = np.flatnonzero((solved & ~is_by_sliding(result.columns)).ravel()) + 1
    if not numbers.size:
        return []
    where = numbers_in_words(numbers.tolist(), int(solved.sum()))
    return [
        f"{where} rolling resistance makes most of f: this f does not count in the smallest f, in means of f and in "
        "the best designs; the power loss counts at all points."
    ]


def _budget_line(result: StudyResult) -> list[str]:
    """Return the relative errors of f at its largest value in a sentence; none where f or its interval is not known."""
    f = np.abs(result["coefficient"])
    f = np.where(np.isfinite(result["interval_low"]), f, np.nan)
    if not np.isfinite(f).any():
        return []
    index = tuple(map(int, np.unravel_index(int(np.nanargmax(f)), f.shape)))
    curves = result.plan.scenes
    scene = curves[int(np.ravel_multi_index(index, f.shape)) * len(curves) // f.size]
    parts = parts_of_error(result.columns, index, [scene])
    size = float(result["coefficient"][index])
    words = ", ".join(f"{name} {error_in_words(part, 0, size)}" for name, part in parts.items())
    place = result.place(index) if result.chosen else numbered_point(result.plan, index)
    some = "" if np.isfinite(result["interval_low"]).all() else " with an interval"
    return [f"The relative errors of the largest f{some}, at {place}, each at 95 %, are: {words}."]


def point_in_words(result: StudyResult, index: tuple[int, ...]) -> str:
    """Return where a point lies, as text; an operating point by its number in the tables and its coordinate alone."""
    return result.place(index) if result.chosen else planned_point_in_words(result.plan, index)


def planned_point_in_words(plan: StudyPlan, index: tuple[int, ...]) -> str:
    """Return where a point of a ``plan`` lies that does not choose its speeds, as `point_in_words`."""
    name = numbered_point(plan, index)
    return name if plan.paired else f"{name}: {place_in_words(plan, index, plan.point_speed(index))}"


def numbered_point(plan: StudyPlan, index: tuple[int, ...]) -> str:
    """Return the number of a point of a ``plan`` in the tables as text, of an operating point with its coordinate."""
    number = int(np.ravel_multi_index(index, plan.shape)) + 1
    if not plan.paired:
        return f"point {number}"
    known = (name for name in ORDERED_BY if name in plan.coords)
    place = "".join(f" ({name} {_coordinate(name, plan.coords[name][1], index[-1])})" for name in known)
    return f"point {number}{place}"


def _coordinate(name: str, values: np.ndarray, index: int) -> str:
    """Return one of the ``values`` of a coordinate in the unit that all have in common, in the digits of the user."""
    unit = unit_of_largest(values.tolist(), COLUMNS[name].unit)
    text = f"{converted(float(values[index]), COLUMNS[name].unit, unit):.{GIVEN_DIGITS}g} {printed(unit)}"
    return text.replace(" °", "°")
