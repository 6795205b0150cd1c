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

# Keys that change along a path of contact, over a turn or a duty cycle in addition to those: a table of operating points
# that varies no others is one of a cycle.
KEYS_OF_CYCLE = frozenset({"bodies.radius", "bodies.width", "lubricant.viscosity"})

# Keys that say how f is computed, and on which sample of a surface: points are compared at the same ones.
COMPUTATION = ("numerics.", "surface.seed", "counterface.seed", "contact.")


def points_are_designs(plan: Any) -> bool:
    """Return whether each row of the table of operating points of a `StudyPlan` is a design with a load and a speed of
    its own, as a sample of them: it varies a key that no cycle does, and does not say where a point lies."""
    if not plan.paired or not COORDINATES.keys().isdisjoint(plan.coords):
        return False
    return any(not is_condition(key) and key not in KEYS_OF_CYCLE for key in _of_table(plan))


def _of_table(plan: Any) -> set[str]:
    """Return the columns with several values of the table of operating points of a `StudyPlan`."""
    return {key for key in _varied(plan) if plan.paired and plan.coords[key][0] == POINT}


def operating_keys(plan: Any) -> tuple[str, ...]:
    """Return the keys with several values in a `StudyPlan` that are conditions: load, speeds, slide-roll ratio and
    temperature of the oil, columns that say where an operating point lies, and keys of the computation. Of a table of
    operating points with one of these all columns are, as the radius of a gear flank changes along the path of contact;
    none is where `points_are_designs`."""
    varied = _varied(plan)
    of_table = _of_table(plan)
    if points_are_designs(plan):
        return tuple(key for key in varied if key not in of_table and is_condition(key))
    if not any(is_condition(key) for key in of_table):
        of_table = set()
    return tuple(key for key in varied if is_condition(key) or key in of_table)


def design_keys(plan: Any) -> tuple[str, ...]:
    """Return the keys with several values in a `StudyPlan` that are design: all that are no `operating_keys`."""
    conditions = operating_keys(plan)
    return tuple(key for key in _varied(plan) if key not in conditions)


def have_common_condition(plan: Any) -> bool:
    """Return whether some designs of a `StudyPlan` are solved at one condition, so that they can be compared. Where
    both are drawn together, as in ``[sample]``, each design has a condition of its own."""
    conditions = operating_keys(plan)
    designs = design_keys(plan)
    for dim in {plan.coords[key][0] for key in designs}:
        of_dim = {key: values.tolist() for key, (name, values) in plan.coords.items() if name == dim}
        count = len(next(iter(of_dim.values())))
        at = [tuple(of_dim[key][i] for key in conditions if key in of_dim) for i in range(count)]
        design = [tuple(of_dim[key][i] for key in designs if key in of_dim) for i in range(count)]
        if len(set(zip(at, design))) > len(set(at)):
            return True
    return False


def why_not_compared(plan: Any) -> str:
    """Return that each design of a `StudyPlan` has a condition of its own, and what to change, as text; "" where some
    have one in common, or there are no designs or no conditions."""
    conditions = operating_keys(plan)
    if not conditions or not design_keys(plan) or plan.chooses_speeds or have_common_condition(plan):
        return ""
    varied = ", ".join(key for key in conditions if key != SPEED) or SPEED
    return (
        f"designs are not compared, because each has operating conditions of its own ({varied}); give these in [vary], "
        "so that all designs have them in common"
    )


def comparison_in_words(plan: Any) -> str:
    """Return which designs of a `StudyPlan` are compared at which conditions, or `why_not_compared`, as text; "" where
    there are no designs or no conditions."""
    conditions = operating_keys(plan)
    designs = design_keys(plan)
    if not conditions or not designs or plan.chooses_speeds:
        return ""
    compared = f"designs  ({', '.join(designs)}) are compared at each condition ({', '.join(conditions)})"
    return why_not_compared(plan) or compared


def _varied(plan: Any) -> list[str]:
    varied = [key for key, (_, values) in plan.coords.items() if np.unique(values).size > 1]
    return [*varied, SPEED] if plan.chooses_speeds else varied


def is_condition(key: str) -> bool:
    """Return whether a ``key`` that a study varies is a condition of operation or of the computation, not of design."""
    return key in OPERATING_KEYS or key.startswith((OPERATING_SECTION, *COMPUTATION))
