"""The uncertainty budget of f and its interval, from what a model answers and from the ranges of the inputs."""

import math
from dataclasses import replace

from ..models import ModelAnswer
from ..models.shared import (
    Prepared,
    beside_asperities,
    largest_boundary_friction,
    largest_of,
    largest_sliding_friction,
)
from ..samples import is_measured
from ..scene import SLIDE_ROLL_RATIO_KEY, Scene
from .ranges import changes_by_ranges, with_input_ranges, with_inputs_not_given
from .uncertainty import Uncertainty, interval

# Names of the interval, by whether the sampling error of f is known: else f has only one without it.
NAME_OF_INTERVAL = {True: "the interval", False: "the interval without the sampling error"}

# Why the interval is narrower than the budget.
CUT_AT_LIMIT = "{} ends at the largest f by the limits of the shear stress"
PARTS_AT_LIMIT = ", {} by sliding and {} by rolling"
CUT_AT_ZERO = "{} begins at the smallest f that resists the sliding"
LEAST_F = ", {:.3g}"

ABOVE_BOUNDARY_FRICTION = (
    "the interval reaches above the boundary friction, {:.3g}: no limiting stress of the oil is given, so that a film may "
    "have more friction than asperities; give lubricant.limiting_stress_coefficient to exclude it"
)

# Part of f_b by which the interval exceeds it, from which on this is stated [-]. A choice: the rolling part of f alone
# makes smaller ones.
LEAST_EXCESS = 0.02

# What narrows the sampling error, by whether the sample has more strips.
SMALLER_SAMPLING_TOLERANCE = "set a smaller numerics.sampling_tolerance to reduce it"
LARGER_MAP = "give a larger map to reduce it"
LARGER_PATCH = "omit numerics.sampling, or give a larger contact.shape, to reduce it"

# Parts of the friction force that resist the sliding.
SLIDING_FORCES = ("boundary_force", "couette_force")


def uncertainty_of(prepared: Prepared, answer: ModelAnswer) -> Uncertainty:
    """Return the uncertainty budget of f of an ``answer``, the ranges of inputs included."""
    scene = prepared.scene
    f = answer.numbers["coefficient"]
    errors = answer.errors
    sampling_error = errors.sampling_error
    numerical = min(errors.numerical, _largest_change(scene, answer))
    has_sampling_error = math.isfinite(sampling_error.value)
    counted = sampling_error if has_sampling_error else replace(sampling_error, value=0.0)
    is_above = errors.numerical > scene.numerics.tolerance  # then a note has the same advice
    of_solve = Uncertainty(
        coefficient=f,
        numerical=numerical,
        sampling=sampling_error.value,
        interval=interval(f, numerical=numerical, sampling_error=counted, model_error=errors.model_error),
        line_scatter=sampling_error.value * math.sqrt(answer.length / scene.bodies.width),
        effective_contacts=answer.effective_contacts,
        length=answer.length,
        freedom=float(sampling_error.freedom),
        tolerance=scene.numerics.sampling_tolerance,
        area_needed=errors.area_needed,
        model=max(errors.model_error),
        model_sides=errors.model_error,
        by_limit=errors.by_limit,
        largest_in_model=largest_of(errors.parts_of_model),
        narrows_numerical=f"{answer.recommendation} to reduce it" if is_above else answer.narrows_numerical,
        narrows_sampling=_narrows_sampling(prepared, answer),
        notes=errors.notes,
    )
    uncertainty = with_inputs_not_given(of_solve, answer.not_given)
    if scene.ranges:
        uncertainty = with_input_ranges(uncertainty, changes_by_ranges(prepared, answer))
    limited = _resisting_sliding(scene, answer, within_stress_limits(scene, answer, uncertainty))
    limited = replace(limited, notes=(*limited.notes, *_above_boundary_friction(scene, answer, limited)))
    if has_sampling_error:
        return limited
    return replace(limited, interval=(math.nan, math.nan), interval_without_sampling=limited.interval)


def _narrows_sampling(prepared: Prepared, answer: ModelAnswer) -> str:
    """Return what narrows the sampling error, as text."""
    if answer.narrows_sampling:
        return answer.narrows_sampling
    if prepared.sample.available_strips > answer.decision.strips:
        return SMALLER_SAMPLING_TOLERANCE
    return LARGER_MAP if prepared.has_given_map or is_measured(prepared.scene) else LARGER_PATCH


def within_stress_limits(scene: Scene, answer: ModelAnswer, uncertainty: Uncertainty) -> Uncertainty:
    """Return ``uncertainty`` with an interval no part of which is beyond the largest f that the limits of the shear
    stress allow (`lubfric.models.shared.largest_friction`), unless f itself is."""
    f = answer.numbers["coefficient"]
    (largest, by_rolling) = _largest_parts(scene, answer)
    sliding = _largest_where_shared(scene, answer, largest, uncertainty)
    most = max(sliding + by_rolling, abs(f))
    low, high = uncertainty.interval
    if not (high > most or low < -most):
        return uncertainty
    ends = max(low, -most), min(high, most)
    name = NAME_OF_INTERVAL[math.isfinite(uncertainty.sampling)]
    parts = f"{sliding:.3g}", f"{by_rolling:.2g}"
    cut = CUT_AT_LIMIT.format(name) + PARTS_AT_LIMIT.format(*parts)
    return replace(uncertainty, interval=ends, cut=(*uncertainty.cut, cut))


def _above_boundary_friction(scene: Scene, answer: ModelAnswer, uncertainty: Uncertainty) -> tuple[str, ...]:
    """Return why the interval of f reaches above f_b and the rolling part of f, as text; () if it does not."""
    f_b = largest_boundary_friction(scene)
    rolling = abs(answer.numbers.get("rolling_force", 0.0)) / scene.bodies.load
    high = uncertainty.interval[1]
    has_limit = scene.lubricant.limiting_stress_coefficient is not None
    if has_limit or not (_always_slides(scene) and high > (1.0 + LEAST_EXCESS) * f_b + rolling):
        return ()
    return (ABOVE_BOUNDARY_FRICTION.format(f_b),)


def _largest_change(scene: Scene, answer: ModelAnswer) -> float:
    """Return the largest relative change of f that the limits of the shear stress and the sense of the sliding leave;
    infinite where the bodies do not always slide. An error that is extrapolated from few lengths of cells may be
    larger, which means nothing."""
    f = abs(answer.numbers["coefficient"])
    if f == 0 or not _always_slides(scene):
        return math.inf
    (sliding, by_rolling) = _largest_parts(scene, answer)
    return max(sliding + by_rolling - f, f + by_rolling) / f


def _largest_parts(scene: Scene, answer: ModelAnswer) -> tuple[float, float]:
    """Return the largest f [-] by sliding that the limits of the shear stress allow, and the largest magnitude of its
    rolling part."""
    sliding = largest_sliding_friction(scene, answer.numbers["speed"])
    rolling = abs(answer.numbers.get("rolling_force", 0.0)) / scene.bodies.load
    return sliding, max(map(abs, answer.rolling_ratios)) * (0.0 if math.isnan(rolling) else rolling)


def _largest_where_shared(scene: Scene, answer: ModelAnswer, largest: float, uncertainty: Uncertainty) -> float:
    """Return the largest f [-] by sliding where asperities carry a part of the load, of the ``largest`` anywhere
    (`lubfric.models.shared.beside_asperities`): at least what inputs and their ranges make of f, because they may change
    that part."""
    f = abs(answer.numbers["coefficient"])
    by_inputs = [uncertainty.input_sides, uncertainty.not_given_sides]
    relative = math.hypot(*(sides[1] for sides in by_inputs if math.isfinite(sides[1])))
    shared = beside_asperities(largest, largest_boundary_friction(scene), answer.errors.largest_film_load_ratio)
    return min(max(shared, f * (1.0 + relative)), largest)


def _resisting_sliding(scene: Scene, answer: ModelAnswer, uncertainty: Uncertainty) -> Uncertainty:
    """Return ``uncertainty`` with an interval of f that is not below what the rolling part of the force leaves, where
    the surfaces slide.

    The sliding part of f resists the sliding, because it dissipates power; f is below 0 only by the rolling part of the
    film's force, where that points the other way or may do so.
    """
    f = answer.numbers["coefficient"]
    sliding = sum(answer.numbers.get(force, math.nan) for force in SLIDING_FORCES) / scene.bodies.load
    rolling = f - sliding
    least = min(0.0, f, *(ratio * (0.0 if math.isnan(rolling) else rolling) for ratio in answer.rolling_ratios))
    low, high = uncertainty.interval
    if not (_always_slides(scene) and low < least):
        return uncertainty
    name = NAME_OF_INTERVAL[math.isfinite(uncertainty.sampling)]
    cut = CUT_AT_ZERO.format(name) + LEAST_F.format(least + 0.0)
    return replace(uncertainty, interval=(least, high), cut=(*uncertainty.cut, cut))


def _always_slides(scene: Scene) -> bool:
    """Return whether the surfaces slide, and one way, at all values in the ranges of the inputs."""
    ratios = [scene.motion.slide_roll_ratio]
    ratios += [end for name, *ends in scene.ranges if name == SLIDE_ROLL_RATIO_KEY for end in ends]
    return min(ratios) > 0 or max(ratios) < 0
