"""The result of a point from what a model answers: its uncertainty budget, warnings, and words."""

import math
import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from ..errors import ConvergenceError
from ..models import ContactFields, ModelAnswer
from ..models.shared import Prepared, warn_error
from ..quantities import NUMBERS
from ..scene import Scene
from .choice import Choice
from .ranges import with_ranges
from .result import FrictionResult
from .uncertainty import Uncertainty, field_errors_of, interval

# Slide-roll ratio, without its sign, at which one surface stands still: (u_2 - u_1)/U with u_1 = 0.
ONE_STANDS_STILL = 2.0


def result_of(prepared: Prepared, choice: Choice, begun: float, *, fine: bool = False) -> FrictionResult:
    """Return the result of the solution that was chosen.

    ``begun``: the starting time, by `time.perf_counter`; ``fine``: whether its fields are solved again on cells fine
    enough to look at.
    """
    scene = prepared.scene
    answer = choice.solution.answer()
    compared_fields = None
    details = {}
    if choice.compared is not None:
        model, solution = choice.compared
        compared = solution.answer()
        compared_fields = compared.fields
        details[model.name] = compared.details
    uncertainty = uncertainty_of(scene, answer)
    decision = answer.decision
    if choice.why:
        decision = replace(decision, notes=(*decision.notes, choice.why))
    validity = (*answer.warnings, *warn_error(answer.numerical, scene.numerics.tolerance, answer.recommendation))
    notes = (*answer.report.notes, decision.text, *(entry.text for entry in validity), uncertainty.text)
    numbers: dict[str, Any] = dict.fromkeys(NUMBERS, math.nan) | answer.numbers
    numbers["seconds"] = time.perf_counter() - begun
    result = FrictionResult(
        **numbers,
        report=replace(answer.report, notes=notes),
        uncertainty=uncertainty,
        errors=field_errors_of(answer.errors, answer.why_no_error, answer.reasons),
        decision=decision,
        validity=validity,
        fields=answer.fields,
        compared_fields=compared_fields,
        details=details | {choice.model.name: answer.details},
    )
    result = not_negative(scene, with_ranges(prepared, result, answer))
    if fine and answer.fine_fields is not None:  # last: work that is spent here is none that the interval needs
        return with_fine_fields(result, answer.fine_fields)
    return result


def uncertainty_of(scene: Scene, answer: ModelAnswer) -> Uncertainty:
    """Return the uncertainty budget of f of an ``answer``, without the ranges of inputs."""
    f = answer.numbers["coefficient"]
    sampling = answer.sampling.error
    return Uncertainty(
        numerical=answer.numerical,
        sampling=sampling,
        interval=interval(f, answer.numerical, sampling, answer.sampling.freedom, *answer.model_error),
        line_scatter=sampling * math.sqrt(answer.length / scene.bodies.width),
        spots=answer.spots,
        length=answer.length,
        freedom=float(answer.sampling.freedom),
        tolerance=scene.numerics.sampling_tolerance,
        area_needed=answer.area_needed,
        model=max(answer.model_error),
        fluid=answer.by_limit,
        largest_in_model=answer.largest_in_model,
        notes=answer.notes,
    )


def with_fine_fields(result: FrictionResult, solve: Callable[[], ContactFields]) -> FrictionResult:
    """Return ``result`` with the fields that ``solve`` gives; where it does not converge, with a note that says so."""
    try:
        return replace(result, fields=solve())
    except ConvergenceError as error:
        note = f"the fields are on the cells that f was solved on, as finer ones were not solved: {error}"
        return replace(result, report=replace(result.report, notes=(*result.report.notes, note)))


def not_negative(scene: Scene, result: FrictionResult) -> FrictionResult:
    """Return ``result`` with an interval of f that is not below 0 where one surface is at rest.

    There the power of the contact is f F_T times the sliding speed, and no contact delivers power.
    """
    low, high = result.uncertainty.interval
    if abs(scene.motion.slide_roll_ratio) != ONE_STANDS_STILL or not low < 0 <= result.coefficient:
        return result
    uncertainty = replace(result.uncertainty, interval=(0.0, high))
    notes = tuple(uncertainty.text if note == result.uncertainty.text else note for note in result.report.notes)
    return replace(result, uncertainty=uncertainty, report=replace(result.report, notes=notes))
