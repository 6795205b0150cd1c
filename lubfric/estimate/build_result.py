"""The result of a point from what a model answers: its numbers, uncertainty budget, warnings, and words."""

import math
import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from .._base import share_read_only
from ..errors import ConvergenceError, InputError, Report
from ..models import ContactFields, Model, ModelAnswer
from ..models.shared import (
    MAP_WIDTH,
    Prepared,
    largest_sliding_friction,
    unmodelled_effects,
    violations_by_numerical_error,
)
from ..quantities import NUMBERS
from ..scene import SLIDE_ROLL_RATIO_KEY, Scene
from .choice import Choice
from .full_load import full_load_numbers
from .methods import MethodUse, methods_of
from .power import PowerLoss, power_loss_of
from .ranges import changes_by_ranges, widened, with_missing_inputs
from .result import FrictionResult
from .uncertainty import Uncertainty, interval, number_errors_of

AT_MOST = (
    "the interval ends at the largest f that the limits of the shear stress allow, {} by sliding: f_b, or the stress of the oil "
    "in the thinnest film"
)

# What narrows the sampling error, by whether the sample has more strips.
SMALLER_SAMPLING_TOLERANCE = "a smaller numerics.sampling_tolerance narrows it"
LARGER_MAP = "a larger map narrows it"

# Sampling error of f over its target, up to which the length of the sample is no matter [-]: a convention.
SAMPLED_WELL = 0.1

# Parts of the friction force that resist the sliding.
SLIDING_FORCES = ("boundary_force", "couette_force")


def result_of(prepared: Prepared, speed: float, choice: Choice, begun: float, *, fine: bool = False) -> FrictionResult:
    """Return the result of the solution that was chosen at ``speed`` [m/s].

    ``begun``: the starting time, by `time.perf_counter`; ``fine``: whether its fields are solved again on cells fine
    enough to look at. Raises `InputError` where f is not finite.
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
    errors = answer.errors | {"power_loss": loss.error}
    sampling = answer.sampling_error.error
    is_sampled_well = sampling <= SAMPLED_WELL * scene.numerics.sampling_tolerance
    of_answer = [each for each in answer.violations if each.what != MAP_WIDTH or not is_sampled_well]
    violations = (
        *of_answer,
        *violations_by_numerical_error(answer.numerical, scene.numerics.tolerance, answer.recommendation),
    )
    decision = answer.decision
    if choice.why:
        decision = replace(decision, notes=(*decision.notes, choice.why))
    known = numbers["boundary_force"] / scene.bodies.load, f
    details = {choice.model.name: answer.details}
    compared_fields = None
    if choice.compared is not None:
        model, solution = choice.compared
        compared = solution.answer()
        compared_fields = compared.fields
        details = {model.name: compared.details} | details
    fields = answer.fields
    report = answer.report
    if fine and answer.fine_fields is not None:  # last: work that is spent here is none that the interval needs
        fields, report = _fine_fields(answer.fine_fields, fields, report)
    share_read_only((fields, compared_fields, details))
    notes = (*report.notes, decision.text, *(violation.text for violation in violations), uncertainty.text)
    numbers["seconds"] = time.perf_counter() - begun
    return FrictionResult(
        **numbers,
        report=replace(report, notes=notes),
        uncertainty=uncertainty,
        errors=number_errors_of(errors, answer.why_no_error, answer.reasons),
        decision=decision,
        power_loss_interval=loss.interval,
        validity=violations,
        unmodelled_effects=unmodelled_effects(
            scene, prepared.surface.sq, speed, known, includes_motion=choice.model.includes_motion
        ),
        methods=methods_of(prepared, _use(scene, choice.model, numbers, uncertainty)),
        fields=fields,
        compared_fields=compared_fields,
        details=details,
    )


def uncertainty_of(prepared: Prepared, answer: ModelAnswer) -> Uncertainty:
    """Return the uncertainty budget of f of an ``answer``, the ranges of inputs included."""
    scene = prepared.scene
    f = answer.numbers["coefficient"]
    sampling_error = answer.sampling_error
    of_solve = Uncertainty(
        coefficient=f,
        numerical=answer.numerical,
        sampling=sampling_error.error,
        interval=interval(f, numerical=answer.numerical, sampling_error=sampling_error, model_error=answer.model_error),
        line_scatter=sampling_error.error * math.sqrt(answer.length / scene.bodies.width),
        effective_contacts=answer.effective_contacts,
        length=answer.length,
        freedom=float(sampling_error.freedom),
        tolerance=scene.numerics.sampling_tolerance,
        area_needed=answer.area_needed,
        model=max(answer.model_error),
        model_sides=answer.model_error,
        by_limit=answer.by_limit,
        largest_in_model=answer.largest_in_model,
        narrows_numerical=answer.narrows_numerical,
        narrows_sampling=LARGER_MAP
        if prepared.sample.available_strips <= answer.decision.strips
        else SMALLER_SAMPLING_TOLERANCE,
        notes=answer.notes,
    )
    known = with_missing_inputs(of_solve, f, answer.not_given)
    with_inputs = widened(known, f, changes_by_ranges(prepared, answer)) if scene.ranges else known
    return _not_driving(scene, answer, within_stress_limits(scene, answer, with_inputs))


def within_stress_limits(scene: Scene, answer: ModelAnswer, uncertainty: Uncertainty) -> Uncertainty:
    """Return ``uncertainty`` with an interval no part of which is beyond the largest f that the limits of the shear stress
    allow (`lubfric.models.shared.largest_friction`), unless f itself is."""
    f = answer.numbers["coefficient"]
    rolling = abs(answer.numbers.get("rolling_force", 0.0)) / scene.bodies.load
    sliding = largest_sliding_friction(scene, answer.numbers["speed"])
    most = max(sliding + answer.most_rolling_ratio * (0.0 if math.isnan(rolling) else rolling), abs(f))
    low, high = uncertainty.interval
    if not (high > most or low < -most):
        return uncertainty
    ends = max(low, -most), min(high, most)
    return replace(uncertainty, interval=ends, notes=(*uncertainty.notes, AT_MOST.format(f"{sliding:.3g}")))


def _not_driving(scene: Scene, answer: ModelAnswer, uncertainty: Uncertainty) -> Uncertainty:
    """Return ``uncertainty`` with an interval of f that is not below what the rolling part of the force leaves, where the
    surfaces slide.

    The sliding part of f resists the sliding, because it dissipates power; f is below 0 only by the rolling part of the
    film's force, where that points the other way.
    """
    f = answer.numbers["coefficient"]
    sliding = sum(answer.numbers.get(force, math.nan) for force in SLIDING_FORCES) / scene.bodies.load
    rolling = answer.most_rolling_ratio * (f - sliding)
    least = min(0.0, 0.0 if math.isnan(rolling) else rolling, f)
    low, high = uncertainty.interval
    if not (_always_slides(scene) and low < least):
        return uncertainty
    return replace(uncertainty, interval=(least, high))


def _always_slides(scene: Scene) -> bool:
    """Return whether the surfaces slide, and one way, at all values in the ranges of the inputs."""
    ratios = [scene.motion.slide_roll_ratio]
    ratios += [end for name, *ends in scene.ranges if name == SLIDE_ROLL_RATIO_KEY for end in ends]
    return min(ratios) > 0 or max(ratios) < 0


def _power_loss(
    scene: Scene, speed: float, *, model: Model, answer: ModelAnswer, numbers: dict[str, Any], uncertainty: Uncertainty
) -> PowerLoss:
    """Return the power loss of the ``answer`` of ``model`` at ``speed`` [m/s]; its ``numbers`` have the lambda ratio."""
    return power_loss_of(
        scene,
        speed=speed,
        coefficient=numbers["coefficient"],
        interval=uncertainty.interval,
        coefficient_error=answer.errors.get("coefficient", math.nan),
        resistance=numbers["rolling_resistance"],
        resistance_error=answer.errors.get("rolling_resistance", math.nan),
        resistance_model_error=model.rolling_error(numbers["lambda_ratio"]),
    )


def _use(scene: Scene, model: Model, numbers: dict[str, Any], uncertainty: Uncertainty) -> MethodUse:
    """Return what the ``numbers`` of ``model`` show of the methods behind them."""
    return MethodUse(
        model=model,
        has_contact=numbers["contact_load"] > 0,
        has_film=numbers["film_load"] > 0,
        sliding=scene.motion.slide_roll_ratio != 0,
        sampled=uncertainty.sampling > 0,
        inlet_heat=numbers["inlet_film_factor"] < 1.0,
        film_heat=numbers["film_temperature_rise"] > 0,
        flash=numbers["flash_temperature_rise"] > 0,
    )


def _fine_fields(
    solve: Callable[[], ContactFields], fields: ContactFields | None, report: Report
) -> tuple[ContactFields | None, Report]:
    """Return the fields that ``solve`` gives, and the report; where it does not converge, ``fields`` and a note."""
    try:
        return solve(), report
    except ConvergenceError as error:
        note = f"the fields are on the cells that f was solved on, as finer ones were not solved: {error}"
        return fields, replace(report, notes=(*report.notes, note))
