"""Why the interval of f contains 0 at some times of a run: the part of its error that takes most of f away there."""

import math
from collections import Counter
from dataclasses import dataclass

import numpy as np

from ..models.load_sharing import load_sharing_error_parts
from ..models.shared import BY_HEAT
from ..scene import Scene, has_moving_roughness
from .result import TransientResult, errors_in_time, sense_of_friction_over_time
from .scene_in_time import scene_at

# The parts of the error of f that may take it to 0, as text.
BY_SAMPLING = "sampling"
BY_INPUT = "the range of f_b"
BY_NUMERICAL = "the sum of the film's shear stress"
BY_SHARE = "model-form: how film and asperities divide the load"
BY_FILM_SHEAR = "model-form: the shear of the film between rough surfaces"
BY_FLANKS = "model-form: pressure on the flanks of moving roughness"
BY_CONTACT = "model-form: the friction in contact"
BY_HEAT_OF_MODEL = f"model-form: {BY_HEAT}"

# What narrows the interval where each of these parts is the largest, as text; of the model-form error the notes of a
# run say it.
WAYS_FROM_ZERO = {
    BY_SAMPLING: "set a smaller numerics.sampling_tolerance",
    BY_INPUT: "give a measured boundary friction coefficient",
    BY_NUMERICAL: "set a smaller numerics.film_tolerance",
}


@dataclass(frozen=True, kw_only=True)
class IntervalsToZero:
    """Where and why the interval of f of a run contains 0.

    Attributes
    ----------
    outputs : indices of the outputs, rising
    causes : at how many of them each part of the error is the largest, the most frequent first
    """

    outputs: tuple[int, ...]
    causes: tuple[tuple[str, int], ...]

    @property
    def ways(self) -> tuple[str, ...]:
        """What narrows the intervals, each once, as text."""
        return tuple(WAYS_FROM_ZERO[cause] for cause, _ in self.causes if cause in WAYS_FROM_ZERO)


def intervals_to_zero(scene: Scene, result: TransientResult) -> IntervalsToZero:
    """Return at which outputs of the run of ``scene`` the interval of f contains 0, also where f is negative or that of
    rolling resistance, and by which part of its error."""
    f = result.coefficient
    low, high = result.uncertainty.interval.T
    outputs = tuple(np.flatnonzero((low <= 0) & (high >= 0)).tolist())
    sides = errors_in_time(result.columns, *np.broadcast_to(result.inputs, (2, f.size)))
    towards = {name: np.where(f >= 0, below, above) for name, (below, above) in sides.items()}
    causes = Counter(_largest_cause(scene, result, index, towards) for index in outputs)
    return IntervalsToZero(outputs=outputs, causes=tuple(causes.most_common()))


def _largest_cause(scene: Scene, result: TransientResult, index: int, towards: dict[str, np.ndarray]) -> str:
    """Return which part of the error takes most of f away at the output ``index``, as text; ``towards``: how far each
    part of the budget moves f towards 0."""
    parts = {
        BY_SAMPLING: float(towards["sampling"][index]),
        BY_INPUT: float(towards["input"][index]),
        BY_NUMERICAL: float(towards["numerical"][index]),
    }
    model = float(towards["model-form"][index])
    if math.isfinite(model):
        parts |= _parts_of_model(scene, result, index, model)
    return max(parts, key=lambda name: np.nan_to_num(parts[name]))


def _parts_of_model(scene: Scene, result: TransientResult, index: int, model: float) -> dict[str, float]:
    """Return how far each part of the model-form error, which is ``model`` in all, moves f towards 0 at the output
    ``index``."""
    load = float(result.load[index])
    sense = float(sense_of_friction_over_time(result.columns)[index])
    rolling = sense * float(result.rolling_force[index]) / load
    errors = load_sharing_error_parts(
        float(result.film_to_roughness_ratio[index]),
        share=float(result.contact_load[index]) / load,
        boundary=sense * float(result.boundary_force[index]) / load,
        shear=sense * float(result.couette_force[index]) / load + rolling,
        rolling=rolling if has_moving_roughness(scene_at(scene, float(result.time[index]))) else 0.0,
    )
    known = {
        BY_SHARE: errors.of_share.towards,
        BY_FILM_SHEAR: errors.of_film,
        BY_FLANKS: errors.of_flanks,
        BY_CONTACT: errors.in_contact,
    }
    of_equation = min(sum(known.values()), abs(float(result.coefficient[index])))
    return known | {BY_HEAT_OF_MODEL: math.sqrt(max(model**2 - of_equation**2, 0.0))}
