"""A study plan as the text of a study file, which `lubfric.studies.load_study` reads back to the same points."""

from dataclasses import is_dataclass
from itertools import takewhile
from typing import Any

from ..errors import InputError
from ..quantities import KEYS
from ..scene import toml_value
from ..units import printed
from .choose import AUTO_SPEEDS
from .operating_points import COORDINATES, POINT
from .points import SPEED
from .vary import Axis

# Key of a study file that says how its values were drawn.
DRAWN_BEFORE = "drawn"


def study_toml(plan: Any, scene: str) -> str:
    """Return a `StudyPlan` as the text of a study file of the file ``scene``, which holds the scene of the plan, all
    numbers in SI units.

    Of operating points, the speeds and radii of single surfaces are left out: the numbers of the scene that follow from
    them are there. Raises `InputError` for values that a study file cannot hold.
    """
    lines = [f"scene = {toml_value(scene)}"]
    if plan.drawn:
        lines.append(f"{DRAWN_BEFORE} = {toml_value(plan.drawn)}")
    if plan.chooses_speeds:
        lines.append(f"speeds = {toml_value(AUTO_SPEEDS)}")
    elif not plan.paired:
        lines.append(f"speeds = {toml_value(plan.speeds)}")
    varied = [axis for axis in plan.axes if not (plan.paired and axis.name == POINT)]
    alone = list(takewhile(lambda axis: len(axis.keys) == 1, varied))
    if alone:
        lines += ["", "[vary]", *(line for axis in alone for line in _lists(axis))]
    for axis in varied[len(alone) :]:
        lines += ["", "[[together]]", *_lists(axis)]
    if plan.paired:
        for row, speed in enumerate(plan.point_speeds):
            coordinates = {name: values[row] for name, values in plan.coordinates.items() if name in COORDINATES}
            numbers = coordinates | plan.axes[-1].at(row) | {SPEED: speed}
            lines += ["", "[[points]]", *(_entry(_heading(key), value) for key, value in numbers.items())]
    return "\n".join(lines) + "\n"


def _lists(axis: Axis) -> list[str]:
    """Return a line with the values of each key of ``axis``."""
    return [_entry(key, list(values)) for key, values in zip(axis.keys, zip(*axis.values))]


def _heading(key: str) -> str:
    """Return ``key`` with its SI unit, as the heading of a column of operating points."""
    known = KEYS | COORDINATES
    unit = printed(known[key].unit) if key in known else ""
    return f"{key} [{unit}]" if unit else key


def _entry(key: str, value: Any) -> str:
    """Return a line of a study file. Raises `InputError` for a value that it cannot hold."""
    parts = value if isinstance(value, list) else [value]
    if any(is_dataclass(part) or part is None for part in parts):
        message = f"{key}: a section of a scene as an object, or None, has no form in a study file"
        raise InputError(message, recommendation="a dict of its keys")
    return f"{toml_value(key)} = {toml_value(value)}"
