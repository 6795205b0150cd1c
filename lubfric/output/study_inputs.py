"""The inputs of a study: those that are varied, and those that all points share."""

import tomllib
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ..quantities import COLUMNS, worded_value
from ..scene import Scene
from ..studies import StudyPlan, StudyResult, name_of, scenes_of
from ..units import converted, printed, unit_of_largest
from .inputs import INPUT_SECTIONS
from .inputs_as_given import inputs_as_given


def range_in_a_line(key: str, values: np.ndarray) -> str:
    """Return the values of a key in a line: all if they are few, else their range."""
    label = name_of(key)
    if values.dtype.kind == "f" and values.size > 6:
        ends = dict.fromkeys(worded_value(key, float(value)) for value in (values.min(), values.max()))
        count = f"{values.size} values, " if len(ends) > 1 else ""
        return f"{label}: {count}{' to '.join(ends)}"
    if values.dtype.kind == "f" and key in COLUMNS and COLUMNS[key].unit not in ("-", "K"):
        unit = unit_of_largest(values.tolist(), COLUMNS[key].unit)
        numbers = dict.fromkeys(f"{converted(value, COLUMNS[key].unit, unit):.4g}" for value in values.tolist())
        return f"{label}: {', '.join(numbers)} {printed(unit)}"
    shown = list(dict.fromkeys(worded_value(key, value) for value in values.tolist()))
    return f"{label}: {', '.join(shown[:6])}{', ...' if len(shown) > 6 else ''}"


def common_inputs(result: StudyResult | StudyPlan, given: Mapping[str, Any] | None = None) -> str:
    """Return the tables of the inputs that are the same at all points of a study or its plan: all but those that are
    varied. ``given``: tables of the scene as the user wrote them; None: those of the scene in full."""
    varied = {*result.coords, "motion.entrainment_speed", "motion.speeds"}
    plan = result if isinstance(result, StudyPlan) else result.plan
    scenes = [replace(each, transient=None) for each in _scenes_at_ends(plan)]
    tables = tomllib.loads(replace(plan.scene, transient=None).to_toml()) if given is None else given
    return "".join(
        inputs_as_given(scenes[0], section, dict(tables.get(section, {})), others=scenes[1:], varied=varied)
        for section in INPUT_SECTIONS
        if section not in varied and section != "transient"
    )


def _scenes_at_ends(plan: StudyPlan) -> list[Scene]:
    """Return the scene of the first point of a ``plan``, and those at the ends of the range of each number that is
    varied: what follows from it, as the viscosity from a temperature, differs there."""
    first = {axis.name: axis.values[0] for axis in plan.axes}
    corners = [first]
    for axis in plan.axes:
        for column in zip(*axis.values):
            is_number = all(isinstance(value, (int, float)) for value in column)
            ends = (min, max) if is_number else ()
            corners += [first | {axis.name: axis.values[column.index(end(column))]} for end in ends]
        corners.append(first | {axis.name: axis.values[-1]})
    scenes = []
    for corner in corners:
        axes = tuple(replace(axis, values=(corner[axis.name],)) for axis in plan.axes)
        scenes += list(scenes_of(plan.scene, axes))
    return scenes
