"""Which of the keys that a study varies are conditions of operation, and which are design."""

from __future__ import annotations

from typing import Any

import numpy as np

from .operating_points import COORDINATES, POINT, SPEEDS_OF_SURFACES
from .points import SPEED

# Keys that are conditions of operation. The others are design, but those of the computation.
OPERATING_KEYS = frozenset(
    {
        SPEED,
        "bodies.load",
        "bodies.hertz_pressure",
        "lubricant.temperature",
        "lubricant.temperature_celsius",
        *COORDINATES,
        *SPEEDS_OF_SURFACES,
    }
)
OPERATING_SECTION = "motion."

# Keys that say how f is computed, and on which sample of a surface: points are compared at the same ones.
COMPUTATION = ("numerics.", "surface.seed", "counterface.seed", "contact.")


def operating_keys(plan: Any) -> tuple[str, ...]:
    """Return the keys with several values in a `StudyPlan` that are conditions: load, speeds, slide-roll ratio and
    temperature of the oil, columns that say where an operating point lies, and keys of the computation. Of a table of
    operating points with one of these all columns are: the radius of a gear flank changes along the path of contact."""
    varied = _varied(plan)
    of_table = {key for key in varied if plan.paired and plan.coords[key][0] == POINT}
    if not any(_is_condition(key) for key in of_table):
        of_table = set()
    return tuple(key for key in varied if _is_condition(key) or key in of_table)


def design_keys(plan: Any) -> tuple[str, ...]:
    """Return the keys with several values in a `StudyPlan` that are design: all that are no `operating_keys`."""
    conditions = operating_keys(plan)
    return tuple(key for key in _varied(plan) if key not in conditions)


def _varied(plan: Any) -> list[str]:
    varied = [key for key, (_, values) in plan.coords.items() if np.unique(values).size > 1]
    return [*varied, SPEED] if plan.chooses_speeds else varied


def _is_condition(key: str) -> bool:
    return key in OPERATING_KEYS or key.startswith((OPERATING_SECTION, *COMPUTATION))
