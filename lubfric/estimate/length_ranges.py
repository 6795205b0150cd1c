"""Correlation lengths of generated roughness of which only a range is known: f on the surfaces of both ends, by the quick
model."""

import math
from dataclasses import dataclass, replace

import numpy as np

from .._base.jobs import map_parts
from ..errors import ConvergenceError, InputError
from ..models import ModelAnswer, model_named, prepare
from ..models.shared import Prepared, error_of_parts, half_width_of_error
from ..scene import LENGTH_KEYS, Scene, has_moving_roughness, value_of

# Correlation of the model-form errors of the quick model at a correlation length and at half or twice of it [-]. A
# choice: with it the change of ln f of 26 of 27 pairs of contacts of verification.campaigns.calibration, at rest and
# rolling, is within its error from that of the deterministic model.
CORRELATION_AT_TWICE_THE_LENGTH = 0.5

# The model that solves the ends: the cheapest that includes the motion of the roughness. A choice, by its name.
MODEL_OF_ENDS = "quick"

# Power of the work of the quick model with the length of its cells, which is in proportion to the correlation length, at
# rest and where roughness moves [-]: the number of cells along a strip, times that of the steps in time. By definition.
WORK_AT_REST = -1.0
WORK_IN_MOTION = -2.0

GIVEN_MAP = "the map was given by the caller"
NO_FRICTION = "f is 0"


@dataclass(frozen=True, kw_only=True)
class QuickFriction:
    """f on one surface by the quick model.

    Attributes
    ----------
    coefficient : f [-]
    by_model, by_sample : its relative errors at 95 %
    """

    coefficient: float
    by_model: float
    by_sample: float

    @staticmethod
    def of(answer: ModelAnswer) -> "QuickFriction":
        """Return f and its errors of an ``answer``: of the model-form error what a more expensive model reduces, as the
        rest, by heat and by what is not known of the oil, is alike on all surfaces. An error that is not known, and so
        in no interval, counts as 0."""
        error = answer.errors.sampling_error
        parts = [part for part in answer.errors.parts_of_model if part.reduced_by_model]
        return QuickFriction(
            coefficient=answer.numbers["coefficient"],
            by_model=float(np.nan_to_num(error_of_parts(parts))) if parts else 0.0,
            by_sample=float(np.nan_to_num(half_width_of_error(error.value, error.freedom))),
        )

    def error_of_change(self, other: "QuickFriction", octaves: float) -> float:
        """Return the error at 95 % of ln of f over that of ``other``, on surfaces whose correlation lengths differ by
        this number of ``octaves``. Errors of alike surfaces cancel; samples of half or twice the length are
        independent."""
        by_model = _error_of_difference(
            self.by_model, other.by_model, 1.0 - (1.0 - CORRELATION_AT_TWICE_THE_LENGTH) * octaves
        )
        return math.hypot(by_model, _error_of_difference(self.by_sample, other.by_sample, 1.0 - octaves))


@dataclass(frozen=True, kw_only=True)
class ChangeByLength:
    """The change of f by the range of a correlation length.

    Attributes
    ----------
    ends : changes of f [-]: the least and the largest that each end may make, with its error
    error : largest error of these changes at 95 %, relative to f there
    """

    ends: tuple[float, ...]
    error: float


def change_by_lengths(prepared: Prepared, answer: ModelAnswer) -> ChangeByLength | str:
    """Return the change of f by the ranges of the correlation lengths of ``prepared``, of which there is one at least;
    where it is not known, why.

    Both ends are solved by the quick model on surfaces of their own, made with the same seed, and compared with f of
    the same model at the value itself. Two bodies that both have a range have the lower ends together, and the upper
    ends: they are made alike.
    """
    if prepared.has_given_map or prepared.has_given_contact:
        return GIVEN_MAP
    scene = replace(prepared.scene, ranges=())
    scenes = [end.with_(numerics={"model": MODEL_OF_ENDS}) for end in (*scenes_at_ends(prepared.scene), scene)]
    is_by_quick_model = answer.decision.counts_cells_as_model_error
    if is_by_quick_model:
        scenes.pop()
    try:
        solved = list(map_parts(quick_friction, scenes, answer.numbers["speed"]))
    except (ConvergenceError, InputError) as error:
        return f"the quick model does not solve an end of its range: {error}"
    middle = QuickFriction.of(answer) if is_by_quick_model else solved.pop()
    if middle.coefficient == 0:
        return NO_FRICTION
    errors = [
        middle.error_of_change(end, max(map(abs, octaves_between(prepared.scene, there))))
        for end, there in zip(solved, scenes_at_ends(prepared.scene))
    ]
    f = answer.numbers["coefficient"]
    ratios = [end.coefficient / middle.coefficient for end in solved]
    ends = [f * (ratio * math.exp(side * error) - 1) for ratio, error in zip(ratios, errors) for side in (-1, 1)]
    return ChangeByLength(ends=tuple(ends), error=max(map(math.expm1, errors)))


def scenes_at_ends(scene: Scene) -> list[Scene]:
    """Return ``scene`` at the lower ends of the ranges of its correlation lengths and at the upper ones, without
    ranges."""
    plain = replace(scene, ranges=())
    of_lengths = [row for row in scene.ranges if row[0] in LENGTH_KEYS]
    return [plain.with_keys({name: ends[number] for name, *ends in of_lengths}) for number in (0, 1)]


def octaves_between(scene: Scene, other: Scene) -> list[float]:
    """Return the powers of 2 by which the correlation lengths of ``other`` differ from those of ``scene``."""
    keys = [key for key in LENGTH_KEYS if value_of(scene, key) is not None]
    lengths = [(np.atleast_1d(value_of(scene, key)), np.atleast_1d(value_of(other, key))) for key in keys]
    return [octave for here, there in lengths for octave in np.log2(there / here).tolist()]


def quick_friction(speed: float, scene: Scene) -> QuickFriction:
    """Return f of ``scene`` at ``speed`` [m/s] by the quick model, on a surface of its own. Raises `ConvergenceError`,
    and `InputError` where its patch does not hold its correlation length."""
    model = model_named(MODEL_OF_ENDS)
    prepared = prepare(scene)
    sample = prepared.sample
    solution = model.solve(prepared, sample, model.strips_to_begin_with(sample), speed).completed()
    return QuickFriction.of(solution.answer())


def solves_of_lengths(scene: Scene) -> float:
    """Return how many solves at the value itself take the time of both ends of the ranges of the correlation lengths of
    ``scene``; 0 where there is none."""
    if not any(name in LENGTH_KEYS for name, *_ in scene.ranges):
        return 0.0
    power = WORK_IN_MOTION if has_moving_roughness(scene) else WORK_AT_REST
    octaves = [max(octaves_between(scene, end), key=abs) for end in scenes_at_ends(scene)]
    return sum(math.exp2(power * octave) for octave in octaves)


def _error_of_difference(one: float, other: float, correlation: float) -> float:
    """Return the error of the difference of two numbers with errors of this ``correlation``, at least 0."""
    return math.sqrt(max(one**2 + other**2 - 2.0 * max(correlation, 0.0) * one * other, 0.0))
