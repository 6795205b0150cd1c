"""Which combination of design has the lowest friction at each operating condition of a study, in sentences and as a
table of report.html."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np

from ..models.shared import numbers_in_words, sentence
from ..quantities import COLUMNS, worded_value
from ..studies import (
    ORDERED_BY,
    BestDesign,
    StudyResult,
    best,
    best_mean,
    design_keys,
    is_condition,
    name_of,
    operating_keys,
    points_are_designs,
    why_not_compared,
)
from ..units import beside_interval, interval_in_words, with_interval
from .markup import INTERVAL_OF_F, plain_cells, table

# Combinations that a sentence names. A choice: more makes a table of a text.
MOST_NAMED = 3

# Rows of the table of operating conditions, at most. A choice: more is read from study.csv.
MOST_CONDITIONS = 200

# Columns of a table of operating points from which its others follow: they say enough of a condition.
GIVEN_SPEEDS = ("u1", "u2")

# Numbers by which points are compared that are designs, as sentences name them.
SYMBOLS_OF_POINTS = {"power_loss": "The power loss", "coefficient": "f"}

# Why a point of a sample with conditions of its own is no best design.
CONDITIONS_DIFFER = "The points differ in {} too, so that none of them is the best design."

RULE = (
    "Conditions are the load, the speeds, the slide-roll ratio, the temperature of the oil and the position of an "
    "operating point. All other varied keys are design, except seeds and keys of [numerics] and [contact]. Two points "
    "cannot be distinguished if they differ by less than the error of their difference, or if an interval is not "
    "known. Numerical and sampling errors count as independent, and so do model-form errors, except those of the "
    "quick model and of the load-sharing model in designs that differ by the size of the roughness, radius, viscosity "
    "or boundary friction alone: these are correlated, as pairs of solved contacts show. Ranges of inputs that "
    "are not varied are common to all designs: only the difference of their effects on the two points counts. "
    "The interval of f contains these ranges, so intervals of points that can be distinguished may overlap."
)


def values_in_words(values: dict[str, Any]) -> str:
    """Return ``values`` [SI] by their keys as text."""
    return ", ".join(f"{name_of(key)} {worded_value(key, value)}" for key, value in values.items())


def condition_in_words(condition: dict[str, Any]) -> str:
    """Return an operating ``condition`` as text: where it lies, if that is known, else the values that it has."""
    places = {key: value for key, value in condition.items() if key in ORDERED_BY}
    surfaces = {key: value for key, value in condition.items() if key in GIVEN_SPEEDS}
    others = {
        key: value
        for key, value in condition.items()
        if not surfaces or key not in ("speed", "motion.slide_roll_ratio")
    }
    return values_in_words(places or others)


def has_designs(result: StudyResult) -> bool:
    """Return whether a study compares combinations of design at speeds that they have in common."""
    return not result.chosen and bool(design_keys(result.plan)) and bool(np.isfinite(result["coefficient"]).any())


def best_lines(result: StudyResult) -> list[str]:
    """Return in sentences which combination of design has the lowest mean over the operating conditions, of f or, of
    operating points, of the power loss; and which have the lowest f at these conditions, of which the report has a
    table; none where no designs are compared."""
    if not has_designs(result):
        return []
    if why := why_not_compared(result.plan):
        return [sentence(why)]
    if points_are_designs(result.plan):
        lines = [line for quantity in SYMBOLS_OF_POINTS for line in _best_points(result, quantity)]
        conditions = " and ".join(name_of(key) for key in design_keys(result.plan) if is_condition(key))
        return [*lines, CONDITIONS_DIFFER.format(conditions)] if lines and conditions else lines
    lines = []
    quantity = "power_loss" if result.paired else "coefficient"
    mean = best_mean(result, quantity)
    if mean is not None:
        name = "power loss" if result.paired else "friction coefficient"
        lines.append(
            f"The mean {name} over all operating conditions is lowest with {values_in_words(mean.design)}: "
            f"{_number(mean, COLUMNS[quantity].unit)}. {_comparison(mean)}"
        )
    best_ones = best(result)
    if len(best_ones) == 1:
        (one,) = best_ones
        place = f"At {condition_in_words(one.condition)}, f" if operating_keys(result.plan) else "f"
        lines.append(
            f"{place} is lowest with {values_in_words(one.design)} (point {one.row}): {_number(one, '-')}. "
            f"{_comparison(one)}"
        )
    elif best_ones:
        lines.append(_summary(best_ones))
    return lines


def _best_points(result: StudyResult, quantity: str) -> list[str]:
    """Return which points, each of them a design, have the lowest ``quantity``, in sentences."""
    return [
        f"{SYMBOLS_OF_POINTS[quantity]} is lowest at point {one.row}"
        f"{_where(one)}: {_number(one, COLUMNS[quantity].unit)}, with {values_in_words(one.design)}. "
        f"{_rival_points(one)}"
        for one in best(result, quantity)
    ]


def _rival_points(one: BestDesign) -> str:
    """Return which points the best ``one`` cannot be distinguished from, by their numbers, in a sentence."""
    if not one.rivals or not np.isfinite(one.interval[0]):
        return _comparison(one)
    where = numbers_in_words(sorted(one.rival_rows), one.compared)
    return f"{where} the difference from this is within its error."


def _where(one: BestDesign) -> str:
    """Return at which values the condition of ``one`` lies, as text to be appended; "" where there is one alone."""
    return f" at {condition_in_words(one.condition)}" if one.condition else ""


def _number(one: BestDesign, unit: str) -> str:
    return with_interval(one.value, *one.interval, unit=unit)


def _comparison(one: BestDesign) -> str:
    """Return from which other combinations the best ``one`` cannot be distinguished, in sentences."""
    others = one.compared - 1
    if not one.rivals:
        than = "the other combination" if others == 1 else f"all {others} other combinations"
        return f"It is lower than with {than} by more than the error of the difference."
    if not np.isfinite(one.interval[0]):
        return "Its interval is not known, so that it cannot be distinguished from the other combinations."
    count = f"{len(one.rivals)} of the {others} other combinations"
    if len(one.rivals) == others:
        count = "the other combination" if others == 1 else f"any of the {others} other combinations"
    named = "; ".join(values_in_words(rival) for rival in one.rivals[:MOST_NAMED])
    more = "; ..." if len(one.rivals) > MOST_NAMED else ""
    common = values_in_words(one.common_design)
    alike = f" All of these have {common}." if common and others > len(one.rivals) else ""
    unknown = f" The interval of {one.unknown_rivals} of these is not known." if one.unknown_rivals else ""
    return (
        f"Within the error of the difference it cannot be distinguished from {count} ({named}{more}).{alike}{unknown}"
    )


def _summary(best_ones: tuple[BestDesign, ...]) -> str:
    """Return in a sentence or two which combinations are the best of several operating conditions: one of all, or how
    often each one, and what they have in common."""
    counts = Counter(values_in_words(one.design) for one in best_ones)
    conditions = f"{len(best_ones)} operating conditions"
    if len(counts) == 1:
        where = "both operating conditions" if len(best_ones) == 2 else f"all {conditions}"
        text = f"One design has the lowest f at {where}: {next(iter(counts))}."
    else:
        words = "; ".join(f"with {name} at {count}" for name, count in counts.most_common(MOST_NAMED))
        more = "; ..." if len(counts) > MOST_NAMED else "."
        common = {
            key: value
            for key, value in best_ones[0].design.items()
            if all(np.array_equal(one.design[key], value) for one in best_ones)
        }
        alike = f" At all of them the lowest f has {values_in_words(common)}." if common else ""
        text = f"Of {conditions} f is lowest {words}{more}{alike}"
    least, most = (_number(find(best_ones, key=lambda one: one.value), "-") for find in (min, max))
    ends = f"The lowest f is from {least} to {most}, by condition."
    clear = sum(not one.rivals for one in best_ones)
    which = "It" if clear == len(best_ones) else f"At {clear} of them it"
    others = "with the other design" if max(one.compared for one in best_ones) == 2 else "with all other designs"
    distinct = f"{which} is lower than {others} by more than the error of the difference"
    unclear = f"At none of them can it be distinguished from {others.removeprefix('with ')}"
    return f"{text} {ends} {distinct if clear else unclear}. The table of the report has a row for each condition."


def best_table(result: StudyResult) -> str:
    """Return the part of a report that has the best combination of each operating condition; "" where no designs are
    compared or there is one condition."""
    best_ones = best(result) if has_designs(result) else ()
    if not best_ones or not operating_keys(result.plan):
        return ""
    rows = []
    for one in best_ones[:MOST_CONDITIONS]:
        f = beside_interval(one.value, *one.interval)
        interval = interval_in_words(*one.interval, value=one.value)
        design = (condition_in_words(one.condition), values_in_words(one.design))
        rows.append(plain_cells([*design, f, interval, str(one.row), _rivals_in_words(one)]))
    heads = [
        "operating condition",
        "design with the lowest f",
        "f",
        INTERVAL_OF_F,
        "no.",
        "cannot be distinguished from",
    ]
    some = f" The first {MOST_CONDITIONS} of {len(best_ones)} conditions." if len(best_ones) > MOST_CONDITIONS else ""
    return f"<h2>Lowest friction at each operating condition</h2><p>{RULE}{some}</p>{table(heads, rows)}"


def _rivals_in_words(one: BestDesign) -> str:
    """Return the combinations that the best ``one`` cannot be distinguished from, for a cell of a table."""
    if not one.rivals:
        return "none"
    if len(one.rivals) == one.compared - 1 and len(one.rivals) > MOST_NAMED:
        why = f" (the interval of {one.unknown_rivals} of them is not known)" if one.unknown_rivals else ""
        why = why if np.isfinite(one.interval[0]) else ": its interval is not known"
        return f"any of the {len(one.rivals)} others{why}"
    named = [
        f"{values_in_words(rival)} (no. {row})"
        for rival, row in zip(one.rivals[:MOST_NAMED], one.rival_rows[:MOST_NAMED])
    ]
    others = [str(row) for row in sorted(one.rival_rows[MOST_NAMED:])]
    return "; ".join([*named, *([f"no. {', '.join(others)}"] if others else [])])
