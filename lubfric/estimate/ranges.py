"""Inputs of which only a range is known: how the two ends of each range change f and its interval."""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

from .._base.jobs import map_parts
from ..errors import ConvergenceError
from ..models import ModelAnswer
from ..models.shared import UNKNOWN_SIDES, Prepared, Sides, added_changes, percent
from ..scene import BOUNDARY_FRICTION_KEY, HARDNESS_KEY, LENGTH_KEYS, Scene, value_of
from .length_ranges import ChangeByLength, change_by_lengths
from .uncertainty import Uncertainty, with_part

# Change of f over f by the range of an input below which no note reports it: 0.05 %. Not measured: a convention.
LEAST_REPORTED_CHANGE = 5e-4

# Change of f over f that is shown as 0 beside a larger one [-]. A convention.
LEAST_SHOWN_CHANGE = 1e-5

# Change of f in percent that is stated to three digits, at least: it rounds to 100. A convention.
LEAST_OF_THREE_DIGITS = 99.5

GIVEN_CONTACT = "the contact was given by the caller"
NO_ENDS = "this model does not solve the ends of its range"
WITH_ERROR = ", with the error of this change by the quick model, at most {} of f there"
NOT_CONVERGED = "the solve at an end of its range did not converge"


def changes_by_ranges(prepared: Prepared, answer: ModelAnswer) -> dict[str, tuple[float, ...] | ChangeByLength | str]:
    """Return the changes of f [-] by the two ends of each of the `Scene.ranges`, by name; where these are not known,
    why.

    f is linear in f_b at a given division of the load. At each end of every other range it is solved again, by the
    model of the ``answer`` (`ModelAnswer.at_inputs`), unless the model knows its change there from its solution
    (`ModelAnswer.change_without_solve`). The changes are relative to the middle on the same cells. An end that cannot
    be solved, and the hardness of a contact that is not lubfric's own, are not known. The correlation lengths of both
    bodies change f together (`change_by_lengths`), and the first of them has the change.
    """
    scene = prepared.scene
    changes_of_f: dict[str, tuple[float, ...] | ChangeByLength | str] = {}
    without_solve: dict[str, tuple[float | None, ...]] = {}
    to_solve: list[Scene] = []
    (*of_lengths,) = (name for name, *_ in scene.ranges if name in LENGTH_KEYS)
    for name, *ends in scene.at_ends():
        if name in of_lengths:
            changes_of_f[name] = change_by_lengths(prepared, answer) if name == of_lengths[0] else (0.0, 0.0)
        elif name == BOUNDARY_FRICTION_KEY:
            load_ratio = answer.numbers["contact_load"] / scene.bodies.load
            slope = load_ratio if scene.motion.slide_roll_ratio != 0 else 0.0
            changes_of_f[name] = tuple(slope * (value_of(end, name) - value_of(scene, name)) for end in ends)
        elif name == HARDNESS_KEY and prepared.has_given_contact:
            changes_of_f[name] = GIVEN_CONTACT
        elif answer.at_inputs is None:
            changes_of_f[name] = NO_ENDS
        else:
            changes = tuple(answer.change_without_solve(name, number, end) for number, end in enumerate(ends))
            without_solve[name] = changes
            to_solve += [end for end, change in zip(ends, changes) if change is None]
    solved = iter(_changes_at(answer, to_solve))
    f = answer.numbers["coefficient"]
    for name, changes in without_solve.items():
        relative = [next(solved) if change is None else change for change in changes]
        is_solved = all(map(math.isfinite, relative))
        changes_of_f[name] = tuple(f * change for change in relative) if is_solved else NOT_CONVERGED
    return {name: changes_of_f[name] for name, *_ in scene.ranges}


def _changes_at(answer: ModelAnswer, ends: list[Scene]) -> list[float]:
    """Return the relative change of f from the middle to each of the ``ends``; NaN where it is not solved."""
    if not ends or answer.at_inputs is None:
        return []
    try:
        around = answer.at_inputs()
    except ConvergenceError:  # the middle, on other cells than the point itself
        return [math.nan] * len(ends)
    if around.may_run_in_processes:
        values = map_parts(_or_nan, ends, around.coefficient)
    else:
        values = [_or_nan(around.coefficient, end) for end in ends]
    return [value / around.middle - 1 for value in values]


def _or_nan(coefficient: Callable[[Scene], float], scene: Scene) -> float:
    """Return f of ``scene``; NaN where it is not solved."""
    try:
        return coefficient(scene)
    except ConvergenceError:
        return math.nan


def with_inputs_not_given(old: Uncertainty, relative_changes: dict[str, tuple[float, float]]) -> Uncertainty:
    """Return ``old`` with the ``relative_changes`` of f at both ends of the range of inputs that the scene does not
    give, by their keys (`lubfric.models.ModelAnswer.not_given`). They add up as squares, towards 0 and away from it for
    themselves."""
    if not any(any(ends) for ends in relative_changes.values()):
        return old
    f = old.coefficient
    sides = Sides(*added_changes(relative_changes.values()))
    below, above = sides.below_and_above(f)
    return replace(
        with_part(old, abs(f) * below, abs(f) * above),
        not_given=max(sides),
        not_given_sides=sides,
        missing_input=max(relative_changes, key=lambda name: max(map(abs, relative_changes[name]))),
    )


def _signed(percentage: float) -> str:
    """Return a change in percent with its sign, to two digits, or three from 100 % on; "0" for one that the rounding of
    a solve leaves."""
    if abs(percentage) < 100 * LEAST_SHOWN_CHANGE:
        return "0"
    has_three_digits = abs(percentage) >= LEAST_OF_THREE_DIGITS
    return f"{percentage:+.3g}" if has_three_digits else f"{percentage:+.2g}"


def _changes_in_words(ends: tuple[float, ...], f: float) -> Iterator[str]:
    """Yield the changes of ``f`` at both ``ends`` of a range [-], as text, if they are large enough to report."""
    if not f:
        yield f"{ends[0]:+.2g} to {ends[1]:+.2g}"
    elif max(map(abs, ends)) > LEAST_REPORTED_CHANGE * abs(f):
        percents = (0.0, *(100 * end / f for end in ends))  # at the value itself it is 0
        yield f"{' to '.join(map(_signed, (min(percents), max(percents))))} %"


def with_input_ranges(
    old: Uncertainty, changes_of_f: Mapping[str, tuple[float, ...] | ChangeByLength | str]
) -> Uncertainty:
    """Return ``old`` with the ``changes_of_f`` [-] by the two ends of inputs, by name (`changes_by_ranges`).

    Those of several inputs add up as squares, below and above f for themselves. One that is not known leaves ``inputs``
    NaN, and a note.
    """
    f = old.coefficient
    moved: dict[str, tuple[float, ...]] = {}
    notes = []
    for name, change in changes_of_f.items():
        begin = f"range of {name.partition('.')[2]}: "
        if isinstance(change, str):
            notes.append(f"{begin}not in the interval, as {change}")
            continue
        moved[name] = change.ends if isinstance(change, ChangeByLength) else change
        with_error = WITH_ERROR.format(percent(change.error)) if isinstance(change, ChangeByLength) else ""
        notes += [f"{begin}f {words}{with_error}" for words in _changes_in_words(moved[name], f)]
    below, above = added_changes(moved.values())
    largest = max(below, above)
    relative = 0.0
    if f:
        relative = largest / abs(f)
    elif largest:
        relative = math.inf
    is_complete = len(moved) == len(changes_of_f)
    sides = UNKNOWN_SIDES
    if f and is_complete:
        sides = Sides.of_ends(below / abs(f), above / abs(f), f)
    return replace(
        with_part(old, below, above),
        inputs=relative if is_complete else math.nan,
        input_sides=sides,
        notes=(*old.notes, *notes),
        inputs_in_interval=tuple(moved),
        largest_input=max(moved, key=lambda name: max(map(abs, moved[name])), default=""),
    )
