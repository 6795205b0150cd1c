"""The result of a point from what a model answers: its numbers, uncertainty budget, warnings, and words."""

import math
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any

from .._base import share_read_only
from ..errors import ConvergenceError, InputError, Report
from ..models import ContactFields, Model, ModelAnswer
from ..models.shared import (
    Assumption,
    Prepared,
    Violation,
    unmodelled_effects,
    violations_by_model_error,
    violations_by_numerical_error,
)
from ..quantities import NUMBERS
from ..scene import Scene
from .choice import Choice
from .full_load import full_load_numbers
from .inputs_to_quote import inputs_to_quote
from .methods import MethodUse, methods_of
from .power import PowerLoss, power_loss_of
from .result import FrictionResult
from .uncertainty import Uncertainty, number_errors_of
from .uncertainty_of_f import uncertainty_of
from .work_of_point import estimated_work_of_point

# Sampling error of f over its target, up to which the length of the sample is no matter [-]: a convention.
SAMPLED_WELL = 0.1


def result_of(
    prepared: Prepared, speed: float, choice: Choice, begun: float, *, with_fine_fields: bool = False
) -> FrictionResult:
    """Return the result of the solution that was chosen at ``speed`` [m/s].

    ``begun``: the starting time, by `time.perf_counter`; ``with_fine_fields``: whether its fields are solved again on
    cells fine enough to look at. Raises `InputError` where f is not finite.
    """
    scene = prepared.scene
    answer = choice.solution.answer()
    numbers: dict[str, Any] = dict.fromkeys(NUMBERS, math.nan) | answer.numbers
    f = numbers["coefficient"]
    if not math.isfinite(f):
        raise InputError(
            f"f = {f} at a speed of {speed:g} m/s: numbers overflow; give speeds, viscosities and stresses of a "
            "lubricated contact"
        )
    numbers |= full_load_numbers(scene, speed, prepared.surface.sq, numbers["inlet_film_factor"])
    uncertainty = uncertainty_of(prepared, answer)
    loss = _power_loss(scene, speed, model=choice.model, answer=answer, numbers=numbers, uncertainty=uncertainty)
    numbers["power_loss"] = loss.value
    errors = answer.errors.of_numbers | {"power_loss": loss.error}
    violations = tuple(_violations(prepared, answer, uncertainty))
    why = [choice.why] if choice.why else []
    decision = replace(answer.decision, model=choice.model.name, notes=(*answer.decision.notes, *why))
    friction_parts = (numbers["boundary_force"] / scene.bodies.load, f)
    details = {choice.model.name: answer.details}
    compared_fields = None
    if choice.compared is not None:
        model, solution = choice.compared
        compared = solution.answer()
        compared_fields = compared.fields
        details = {model.name: compared.details} | details
    fields = answer.fields
    report = answer.report
    # last: work that is spent here is none that the interval needs
    if with_fine_fields and answer.fine_fields is not None:
        fields, report = _fine_fields(answer.fine_fields, fields, report)
    share_read_only((fields, compared_fields, details))
    notes = (*report.notes, decision.text, *(violation.text for violation in violations), uncertainty.text)
    numbers["seconds"] = time.perf_counter() - begun
    return FrictionResult(
        **numbers,
        report=replace(report, notes=notes),
        uncertainty=uncertainty,
        errors=number_errors_of(numbers, errors, answer.errors.why_not_known, answer.errors.reasons),
        decision=decision,
        power_loss_interval=loss.interval,
        rolling_resistance_interval=loss.resistance_interval,
        validity=violations,
        unmodelled_effects=unmodelled_effects(
            scene, prepared.surface.sq, speed, friction_parts, includes_motion=choice.model.includes_motion
        ),
        methods=_methods(prepared, choice, numbers, uncertainty),
        inputs=inputs_to_quote(
            scene,
            prepared.sample.maps_before_extension,
            has_given_map=prepared.has_given_map,
            has_sampling_error=math.isfinite(uncertainty.sampling),
            takes_boundary_film=choice.model.takes_boundary_film,
        ),
        fields=fields,
        compared_fields=compared_fields,
        details=details,
    )


def _violations(prepared: Prepared, answer: ModelAnswer, uncertainty: Uncertainty) -> Iterator[Violation]:
    """Yield the violations of the ``answer``, and those by the errors of f. A short sample whose sampling error is small
    is none."""
    scene = prepared.scene
    sampling = answer.errors.sampling_error.value
    is_sampled_well = sampling <= SAMPLED_WELL * scene.numerics.sampling_tolerance
    for violation in answer.violations:
        if violation.assumption != Assumption.LONG_SAMPLE or not is_sampled_well:
            yield violation
    has_interval = math.isfinite(uncertainty.interval[0])
    for violation in _violations_by_model_error(prepared, answer, has_interval=has_interval):
        yield beside_larger_part(violation, uncertainty)
    yield from violations_by_numerical_error(
        uncertainty.numerical, scene.numerics.tolerance, answer.recommendation, has_interval=has_interval
    )


def _violations_by_model_error(prepared: Prepared, answer: ModelAnswer, *, has_interval: bool) -> Iterator[Violation]:
    """Yield the warning of a model-form error above ``numerics.model_tolerance``, unless the scene accepts it.
    ``has_interval``: whether f has an interval."""
    if answer.accepts_model_error:
        return
    yield from violations_by_model_error(
        answer.errors.of_model_alone,
        tolerance=prepared.scene.numerics.model_tolerance,
        f=answer.numbers["coefficient"],
        has_interval=has_interval,
        parts=[part for part in answer.errors.parts_of_model if not part.is_of_input],
        seconds_by=partial(_seconds_by, prepared, answer.numbers["speed"]),
    )


def _seconds_by(prepared: Prepared, speed: float, model: str) -> float:
    """Return the estimated processor time [s] of a point at ``speed`` [m/s] by the ``model`` of this name, as
    ``lubfric info`` has it; NaN where that model has no answer."""
    scene = prepared.scene.with_(numerics={"model": model})
    estimate = estimated_work_of_point(scene, prepared.sample, prepared.surface, speed)
    return estimate.seconds if estimate.model.name == model else math.nan


def beside_larger_part(violation: Violation, uncertainty: Uncertainty) -> Violation:
    """Return the warning of a large model-form error with the part of the budget that is larger, if one is."""
    if uncertainty.is_largest_by_model or not uncertainty.largest_part:
        return violation
    other = f"A larger part of the interval of f comes from another error: {uncertainty.largest_part_in_words}"
    return replace(violation, recommendation=". ".join(filter(None, (violation.recommendation, other))))


def _power_loss(
    scene: Scene, speed: float, *, model: Model, answer: ModelAnswer, numbers: dict[str, Any], uncertainty: Uncertainty
) -> PowerLoss:
    """Return the power loss of the ``answer`` of ``model`` at ``speed`` [m/s]; its ``numbers`` have the lambda
    ratio."""
    film_load = numbers["film_load"]
    growth = answer.errors.largest_film_load_ratio * scene.bodies.load / film_load if film_load > 0 else 1.0
    return power_loss_of(
        scene,
        speed=speed,
        coefficient=numbers["coefficient"],
        interval=uncertainty.interval,
        coefficient_error=answer.errors.of_numbers.get("coefficient", math.nan),
        resistance=numbers["rolling_resistance"],
        resistance_error=answer.errors.of_numbers.get("rolling_resistance", math.nan),
        resistance_model_error=model.rolling_error(numbers["lambda_ratio"], max(growth, 1.0)),
    )


def _methods(prepared: Prepared, choice: Choice, numbers: dict[str, Any], uncertainty: Uncertainty) -> tuple[str, ...]:
    """Return the methods of the answer, and then those of the model that it was compared with."""
    models = [choice.model] if choice.compared is None else [choice.model, choice.compared[0]]
    uses = [_method_use(prepared.scene, model, numbers, uncertainty) for model in models]
    return tuple(dict.fromkeys(name for use in uses for name in methods_of(prepared, use)))


def _method_use(scene: Scene, model: Model, numbers: dict[str, Any], uncertainty: Uncertainty) -> MethodUse:
    """Return what the ``numbers`` of the answer show of the methods of ``model``, which answers or is compared with
    it."""
    return MethodUse(
        model=model,
        has_contact=numbers["contact_load"] > 0,
        has_film=numbers["film_load"] > 0,
        slides=scene.motion.slide_roll_ratio != 0,
        is_sampled=uncertainty.sampling > 0,
        has_inlet_heat=numbers["inlet_film_factor"] < 1.0,
        has_film_heat=numbers["film_temperature_rise"] > 0,
        has_flash=numbers["flash_temperature_rise"] > 0,
    )


def _fine_fields(
    solve: Callable[[], ContactFields], fields: ContactFields | None, report: Report
) -> tuple[ContactFields | None, Report]:
    """Return the fields that ``solve`` gives, and the report; where it does not converge, or has too many cells,
    ``fields`` and a note."""
    try:
        return solve(), report
    except (ConvergenceError, InputError) as error:
        note = f"the fields are on the cells that f was solved on, as finer ones were not solved: {error}"
        return fields, replace(report, notes=(*report.notes, note))
