"""What the range of an estimated pressure-viscosity coefficient changes, in words: of a result, of the points of a study
or a fit, and before there is a result."""

from collections.abc import Iterable, Mapping, Sequence

from ...scene import Scene
from ...units import worded
from .checks import peak_hertz_pressure
from .unmodelled import GIVE_ALPHA, ExpectedEffect, UnmodelledEffect, at_most_in_words, ends_of_alpha
from .violation import numbers_in_words

# What the change is before there is a result. A convention.
UPPER_BOUND = (
    "estimated with closed forms for all asperity load ratios that the result may have; the report states the change "
    "at the solved ratio, which is often much smaller"
)


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
    return (
        "The pressure-viscosity coefficient is an estimate, whose error is not in the interval of f. "
        f"{where}{others}, by closed forms, the range of measured oils changes f by {largest}; {GIVE_ALPHA}."
    )


def alpha_of_fit_in_words(effects_of_points: Iterable[Sequence[UnmodelledEffect]]) -> str:
    """Return by how much the range of an estimated pressure-viscosity coefficient changes f at most at the points of a
    fit, whose parameters have this error too, and what to give; "" as of `alpha_of_points_in_words`."""
    largest = max(map(_largest_by_alpha, effects_of_points), default=0.0)
    if not largest:
        return ""
    return (
        "not in the intervals: the error of the pressure-viscosity coefficient, which is an estimate and moves the "
        f"fitted parameters; by closed forms, the range of measured oils changes f by {at_most_in_words(largest)}; give "
        "lubricant.pressure_viscosity_coefficient"
    )


def expected_alpha_in_words(effects: Sequence[ExpectedEffect]) -> str:
    """Return the same before there is a result, from the ``effects`` that are expected at all points; "" where there is
    none."""
    largest = _largest_by_alpha(effects)
    if not largest:
        return ""
    return (
        "the pressure-viscosity coefficient is an estimate, whose error will not be in the interval of f: the range of "
        f"measured oils changes f by {at_most_in_words(largest)}, {UPPER_BOUND}; {GIVE_ALPHA}"
    )


def expected_alpha_at(scene: Scene, speed: float, effects: Sequence[ExpectedEffect]) -> str:
    """Return what the range of an estimated pressure-viscosity coefficient means for f at ``speed`` [m/s], before there
    is a result, and what to do, in two sentences; "" where none of the ``effects`` is of this coefficient."""
    largest = _largest_by_alpha(effects)
    if not largest:
        return ""
    (low, high) = (1e9 * alpha for alpha in ends_of_alpha(scene))
    peak = worded(peak_hertz_pressure(scene), "Pa")
    return (
        f"the pressure-viscosity coefficient is estimated; measured oils have {low:.3g} to {high:.3g} 1/GPa, and the "
        f"interval of f does not contain this range. At {speed:.4g} m/s and a peak Hertz pressure of {peak} this range "
        f"changes f by {at_most_in_words(largest)}, {UPPER_BOUND}. Give lubricant.pressure_viscosity_coefficient from a "
        "data sheet or a measurement, or as [value, low, high], whose effect is then solved and in the interval"
    )


def alpha_beside_interval(effects: Sequence[UnmodelledEffect]) -> str:
    """Return how the range of an estimated pressure-viscosity coefficient changes f in a few words beside the interval
    of f; "" as of `alpha_of_points_in_words`."""
    largest = _largest_by_alpha(effects)
    if not largest:
        return ""
    return (
        "the pressure-viscosity coefficient is estimated, and the interval does not contain the range of measured oils, "
        f"which changes f by {at_most_in_words(largest)}"
    )


def _largest_by_alpha(effects: Sequence[UnmodelledEffect] | Sequence[ExpectedEffect]) -> float:
    """Return the largest change of f by an estimated pressure-viscosity coefficient among the ``effects``; 0 where
    there is none."""
    return max((effect.largest_change for effect in effects if effect.is_of_alpha), default=0.0)
