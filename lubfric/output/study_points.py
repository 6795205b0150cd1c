"""The points of a study: the scene of each, the effects that are not modelled there, and the parts of the error of
f."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from .._base import FloatArray
from ..estimate import PARTS
from ..models.shared import (
    UnmodelledEffect,
    Violation,
    half_width_of_error,
    is_near_zero,
    percent_of_sides,
    sides_in_f,
    unmodelled_effects,
)
from ..quantities import COLUMN_OF_ERROR
from ..scene import Scene, inputs_not_given
from ..studies import UNUSED, StudyResult, columns_of_study
from ..time import may_move_roughness
from .budget_bars import names_of_inputs


@dataclass(frozen=True, kw_only=True)
class PartOfError:
    """A part of the error of f at some points, relative, at 95 %, (n,).

    Attributes
    ----------
    largest : of both sides
    towards, away : towards 0 and away from it; NaN where both sides are ``largest``
    """

    largest: FloatArray
    towards: FloatArray
    away: FloatArray


def scene_of_each(result: StudyResult) -> list[Scene]:
    """Return the scene of each point of `columns_of_study`."""
    curves = result.plan.scenes
    each = result.status.size // len(curves)
    return [curves[i // each] for i in np.flatnonzero(result.status.ravel() != UNUSED)]


def violations_of_each(result: StudyResult) -> list[tuple[Violation, ...]]:
    """Return the assumptions that do not hold at each point of `columns_of_study`."""
    return [result.violations.flat[i] for i in np.flatnonzero(result.status.ravel() != UNUSED)]


def effects_at(result: StudyResult, rows: Sequence[int]) -> Iterator[tuple[UnmodelledEffect, ...]]:
    """Yield the effects that are not modelled at each of the ``rows`` of `columns_of_study`, where f is known."""
    columns = columns_of_study(result)
    scenes = scene_of_each(result)
    for i in rows:
        scene = scenes[i]
        numbers = {
            name: abs(float(columns[name][i])) for name in ("coefficient", "speed", "boundary_force", "central_film")
        }
        ratio = float(columns["film_to_roughness_ratio"][i])
        sq = numbers["central_film"] / ratio if np.isfinite(ratio) and ratio > 0 else 0.0
        known = numbers["boundary_force"] / scene.bodies.load, numbers["coefficient"]
        yield unmodelled_effects(scene, sq, numbers["speed"], known, includes_motion=may_move_roughness(scene))


def parts_of_error(
    columns: Mapping[str, np.ndarray], index: np.ndarray | tuple[int, ...], scenes: Sequence[Scene]
) -> dict[str, PartOfError]:
    """Return the parts of the error of f at an ``index`` of the ``columns``, by what they are called.

    Columns hold no text, so the inputs that are not given, whose range changes f, are those of the ``scenes`` there;
    where f does not depend on them, they are no part.
    """

    def at_index(name: str) -> FloatArray:
        values = columns.get(name)
        return np.full(len(scenes), np.nan) if values is None else np.atleast_1d(values[index])

    columns_of = {name: COLUMN_OF_ERROR[part.quantity] for name, part in PARTS.items()}
    parts = {
        name: PartOfError(largest=at_index(column), towards=at_index(f"{column}_low"), away=at_index(f"{column}_high"))
        for name, column in columns_of.items()
    }
    of_sample = zip(parts["sampling"].largest, at_index("sampling_freedom"))
    at_95 = np.array([half_width_of_error(error, float(n)) for error, n in of_sample])
    parts["sampling"] = replace(parts["sampling"], largest=at_95)
    missing = names_of_inputs(key for scene in scenes for key in inputs_not_given(scene))
    labels = {"not given": f"{missing} not given"}
    return {labels.get(name, name): part for name, part in parts.items() if name != "not given" or part.largest.any()}


def error_in_words(error: PartOfError, place: int, f: float) -> str:
    """Return a relative ``error`` of ``f`` at a ``place`` of its arrays as text, with both sides where they differ; in
    f itself where that is near 0."""
    largest, towards, away = (float(values[place]) for values in (error.largest, error.towards, error.away))
    if is_near_zero(f, largest):
        return f"{sides_in_f((towards, away), largest, f)} in f"
    return percent_of_sides((towards, away), largest)
