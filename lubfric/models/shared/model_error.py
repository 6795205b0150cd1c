"""The model-form error of f: its parts, and the warning that it is above its target."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from .sides import Sides, added_sides
from .violation import Assumption, Violation
from .wording import NEAR_ZERO, is_near_zero, percent

MODEL_ERROR = "model-form error of f"
MODEL_ERROR_NEAR_ZERO = f"{MODEL_ERROR} below {NEAR_ZERO:g}, in f itself,"
BY_HEAT = "heat (half of its effect counts as error)"
REDUCED_BY_DETERMINISTIC = "set numerics.model = 'deterministic' to reduce it"
DETERMINISTIC = "deterministic"
REDUCED_BY_TOLERANCE = "set a smaller numerics.tolerance to reduce it"
LARGEST_PART = "its largest part is {}"
# Whether (True) the interval of f includes an error.
IN_INTERVAL = {True: "the interval of f includes it", False: "f has no interval that would include it"}
READ_INTERVAL = "use f with its interval"
# Why it is a note, and why a warning, where the error of the model alone is usual.
WHY_A_NOTE_OF_MODEL = (
    "this is a note, because that part is usual for this model, and the other parts are within the limit"
)
WHY_A_WARNING_BY_OTHERS = "this is a warning, because the other parts, {}, are above the limit without that part"
WHY_A_WARNING = "this is a warning and no note, because {}"
OTHER_PARTS = "{}; without that part the model-form error is {}"


@dataclass(frozen=True, kw_only=True)
class ModelErrorPart:
    """A part of the model-form error of f.

    Attributes
    ----------
    sides : relative errors at 95 %, towards 0 and away from it
    cause : what it comes from, as text
    recommendation : what reduces it, as text; "": nothing that a user may give
    is_of_input : whether it comes from an input that is not known, which no other model knows either
    reduced_by_model : name of the model that the ``recommendation`` names; "": of none
    is_usual : whether it is usual for the model that answers (docs/models.md), so that a note reports it instead of a
        warning
    why_unusual : why it is not usual for a model that has a usual error, as text; "": the model has none
    """

    sides: tuple[float, float]
    cause: str
    recommendation: str = ""
    reduced_by_model: str = ""
    is_of_input: bool = False
    is_usual: bool = False
    why_unusual: str = ""

    @property
    def error(self) -> float:
        """The larger of both sides."""
        return max(self.sides)


def largest_of(parts: Sequence[ModelErrorPart]) -> ModelErrorPart | None:
    """Return the largest of ``parts``, the first of equal ones; None where there are none."""
    return max(parts, key=lambda part: part.error, default=None)


def error_of_parts(parts: Sequence[ModelErrorPart]) -> float:
    """Return the root of the sum of squares of the errors of ``parts``."""
    return math.hypot(*(part.error for part in parts))


def sides_of_parts(parts: Sequence[ModelErrorPart]) -> Sides:
    """Return the relative model-form error of f of which these are all ``parts``."""
    return added_sides([part.sides for part in parts])


def violations_by_model_error(
    error: float,
    *,
    tolerance: float,
    f: float,
    has_interval: bool,
    parts: Sequence[ModelErrorPart] = (),
    seconds_by: Callable[[str], float] = lambda model: math.nan,
) -> Iterator[Violation]:
    """Yield a violation where the model-form ``error`` of ``f``, relative, is above ``tolerance``, by its ``parts``: a
    note where this is because of parts that are usual for the model.

    Where f is near 0, the warning states the error in f itself. ``has_interval``: whether f has an interval, which
    includes the error. ``seconds_by``: the estimated processor time [s] of the point by the model of this name.
    """
    if not error > tolerance:
        return
    is_relative = not is_near_zero(f, error)
    unit = 100.0 if is_relative else abs(f)
    largest = largest_of(parts)
    recommendation = largest.recommendation if largest is not None else ""
    unusual = [part for part in parts if not part.is_usual]
    if recommendation:
        others = error_of_parts([part for part in parts if part is not largest])
        recommendation = OTHER_PARTS.format(recommendation, percent(others)) if others else recommendation
    model = largest.reduced_by_model if largest is not None else ""
    seconds = seconds_by(model) if model else math.nan
    consequence = LARGEST_PART.format(largest.cause) if largest is not None else IN_INTERVAL[has_interval]
    is_note = len(unusual) < len(parts) and not error_of_parts(unusual) > tolerance
    if largest is not None and largest.is_usual:
        by_others = WHY_A_WARNING_BY_OTHERS.format(percent(error_of_parts(unusual)))
        consequence += f"; {WHY_A_NOTE_OF_MODEL if is_note else by_others}"
    if largest is not None and largest.why_unusual:
        consequence += f"; {WHY_A_WARNING.format(largest.why_unusual)}"
    yield Violation(
        assumption=Assumption.MODEL_FORM_ERROR,
        what=MODEL_ERROR if is_relative else MODEL_ERROR_NEAR_ZERO,
        value=unit * error,
        limit=unit * tolerance,
        unit="%" if is_relative else "",
        consequence=consequence,
        recommendation=recommendation or (READ_INTERVAL if has_interval else ""),
        is_note=is_note,
        effect=error,
        recommendation_seconds=seconds,
    )
