"""The inputs of a study: those that are varied, and those that all points share."""

from collections.abc import Container, Iterable, Sequence
from dataclasses import replace

import numpy as np

from ..quantities import CHOICES, COLUMNS, worded_value
from ..scene import Scene
from ..studies import StudyPlan, StudyResult, name_of, scenes_of
from ..units import converted, printed, unit_of_largest
from .inputs import INPUT_SECTIONS, inputs
from .markup import Cell, row_with_key, table


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
    shown = list(dict.fromkeys(worded_value(key, v.item()) if values.dtype.kind == "f" else str(v) for v in values))
    return f"{label}: {', '.join(shown[:6])}{', ...' if len(shown) > 6 else ''}"


def common_inputs(result: StudyResult | StudyPlan) -> str:
    """Return the tables of the inputs that are the same at all points of a study or its plan: all but those that are
    varied."""
    varied = {*result.coords, "motion.entrainment_speed", "motion.speeds"}
    whole_sections = {key for key in varied if "." not in key}
    parts = []
    scene, *others = _scenes_at_ends(result if isinstance(result, StudyPlan) else result.plan)
    for section in INPUT_SECTIONS:
        if section in whole_sections:
            continue
        rows = _common_numbers(scene, others, section, varied)
        rows += _common_choices((scene, *others), section, varied)
        if section == "lubricant" and scene.lubricant.oil is not None:
            names = {"" if each.lubricant.oil is None else each.lubricant.oil.name for each in (scene, *others)}
            rows += [row_with_key("oil", name, "") for name in names if len(names) == 1]
        if rows:
            parts.append(f"<h3>{section}</h3>{table(['quantity', 'value', 'key'], rows)}")
    return "".join(parts)


def _common_numbers(scene: Scene, others: Iterable[Scene], section: str, varied: Container[str]) -> list[list[Cell]]:
    """Return the rows of the inputs of a ``section`` that are not ``varied`` and the same in ``scene`` and the
    ``others``."""
    everywhere = [{(key, text, note) for _, text, key, note in inputs(other, section)} for other in others]
    return [
        row_with_key(label, text + note, key)
        for label, text, key, note in inputs(scene, section)
        if key not in varied and all((key, text, note) in alike for alike in everywhere)
    ]


def _common_choices(scenes: Sequence[Scene], section: str, varied: Container[str]) -> list[list[Cell]]:
    """Return the rows of the keys of a ``section`` that are words, not ``varied``, and the same in all ``scenes``."""
    rows = []
    for key in CHOICES:
        (of_section, _, name) = key.partition(".")
        if of_section != section or key in varied:
            continue
        values = {getattr(getattr(scene, section), name, None) for scene in scenes}
        value = values.pop()
        if not values and isinstance(value, str):
            rows.append(row_with_key(name.replace("_", " "), value, key))
    return rows


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
