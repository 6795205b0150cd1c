"""What the range of an estimated pressure-viscosity coefficient changes, in words: of a result, of the points of a study
or a fit, and before there is a result."""

from collections.abc import Iterable, Mapping, Sequence

from ...scene import Scene
from .unmodelled import (
    GIVE_ALPHA,
    ExpectedEffect,
    UnmodelledEffect,
    at_most_in_words,
    ends_of_alpha,
    is_alpha_measured,
)
from .violation import numbers_in_words

# Where the change of f is stated, which depends on the asperity load ratio of the result.
IN_REPORT = "the report states by how much this changes f"

# What the coefficient is, and the range that changes f: that of its measurements (True), or of measured oils.
ORIGINS = {True: "measured for this oil", False: "an estimate"}
RANGES = {True: "the range of its measurements", False: "the range of measured oils"}


def alpha_of_points_in_words(effects_by_point: Mapping[int, Sequence[UnmodelledEffect]], count: int) -> str:
    """Return in a sentence by how much the range of an estimated pressure-viscosity coefficient changes f at most at
    ``count`` points of a study, where, and what to give; "" where the coefficient is given, or the changes are below
    the tolerance.

    ``effects_by_point``: the effects that are not modelled, by the number of the point, from 1.
    """
    changes = {number: _largest_by_alpha(effects) for number, effects in effects_by_point.items()}
    numbers = sorted(number for number, change in changes.items() if change > 0)
    if not numbers:
        return ""
    worst = max(numbers, key=lambda number: changes[number])
    largest = at_most_in_words(changes[worst]) + (f" (at point {worst})" if count > 1 else "")
    where = "At all points" if len(numbers) == count > 1 else numbers_in_words(numbers, count)
    others = " (less than the numerical tolerance at the others)" if len(numbers) < count else ""
    is_measured = _is_measured(effects_by_point[worst])
    return (
        f"The pressure-viscosity coefficient is {ORIGINS[is_measured]}; its error is not in the interval of f. "
        f"{where}{others}, by closed forms, {RANGES[is_measured]} changes f by {largest}; {GIVE_ALPHA}."
    )


def alpha_of_fit_in_words(effects_of_points: Iterable[Sequence[UnmodelledEffect]]) -> str:
    """Return by how much the range of an estimated pressure-viscosity coefficient changes f at most at the points of a
    fit, whose parameters have this error too, and what to give; "" as of `alpha_of_points_in_words`."""
    worst = max(effects_of_points, key=_largest_by_alpha, default=())
    largest = _largest_by_alpha(worst)
    if not largest:
        return ""
    is_measured = _is_measured(worst)
    return (
        f"not in the intervals: the error of the pressure-viscosity coefficient, which is {ORIGINS[is_measured]} and "
        f"moves the fitted parameters; by closed forms, {RANGES[is_measured]} changes f by {at_most_in_words(largest)}; give "
        "lubricant.pressure_viscosity_coefficient"
    )


def expected_alpha_in_words(effects: Sequence[ExpectedEffect]) -> str:
    """Return that the interval of f will not contain the range of the pressure-viscosity coefficient, from the
    ``effects`` that are expected at all points; "" where there is none. A bound of the change of f for all asperity
    load ratios would be several times the change."""
    if not _largest_by_alpha(effects):
        return ""
    is_measured = _is_measured(effects)
    return (
        f"the pressure-viscosity coefficient is {ORIGINS[is_measured]}, and the interval of f will not contain "
        f"{RANGES[is_measured]}; {IN_REPORT}; {GIVE_ALPHA}"
    )


def expected_alpha_of_scene(scene: Scene, effects: Sequence[ExpectedEffect]) -> str:
    """Return the same of one ``scene``, with the range, in sentences; "" where none of the ``effects`` is of this
    coefficient."""
    if not _largest_by_alpha(effects):
        return ""
    (low, high) = (1e9 * alpha for alpha in ends_of_alpha(scene))
    is_measured = is_alpha_measured(scene)
    return (
        f"the pressure-viscosity coefficient is {ORIGINS[is_measured]}; {RANGES[is_measured]} is {low:.3g} to {high:.3g} "
        f"1/GPa, which the interval of f does not contain; {IN_REPORT}. Give lubricant.pressure_viscosity_coefficient "
        "from a data sheet or a measurement, or as [value, low, high], whose effect is then solved and in the interval"
    )


def alpha_beside_interval(effects: Sequence[UnmodelledEffect]) -> str:
    """Return how the range of an estimated pressure-viscosity coefficient changes f in a few words beside the interval
    of f; "" as of `alpha_of_points_in_words`."""
    largest = _largest_by_alpha(effects)
    if not largest:
        return ""
    is_measured = _is_measured(effects)
    return (
        f"the pressure-viscosity coefficient is {ORIGINS[is_measured]}, and the interval does not contain "
        f"{RANGES[is_measured]}, which changes f by {at_most_in_words(largest)}"
    )


def _is_measured(effects: Sequence[UnmodelledEffect] | Sequence[ExpectedEffect]) -> bool:
    """Return whether the coefficient of the ``effects`` is measured for the oil."""
    return any(effect.is_of_measured_alpha for effect in effects)


def _largest_by_alpha(effects: Sequence[UnmodelledEffect] | Sequence[ExpectedEffect]) -> float:
    """Return the largest change of f by an estimated pressure-viscosity coefficient among the ``effects``; 0 where
    there is none."""
    return max((effect.largest_change for effect in effects if effect.is_of_alpha), default=0.0)
