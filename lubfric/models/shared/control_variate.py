"""What a cheaper model knows of the strips of a line: the control of a more expensive one."""

import math
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from ..._base import FloatArray
from .statistics import StandardError

# Force over the load that differences of forces may leave where there is none [-]. A choice, above rounding.
FORCE_ROUNDING = 1e-12

T = TypeVar("T", float, np.ndarray)


@dataclass(frozen=True, kw_only=True)
class ControlVariate:
    """By how much the strips of a line differ from it.

    Attributes
    ----------
    by_place : of f at every place of each strip (count, rows)
    numbers : of each strip (count,), by name
    sampling_error : relative, of f on the line
    """

    by_place: FloatArray
    numbers: dict[str, np.ndarray]
    sampling_error: StandardError

    @property
    def count(self) -> int:
        """Number of its strips."""
        return len(self.by_place)

    def deviations(self, index: int, places: int) -> FloatArray:
        """Return the differences of f at so many ``places`` along strip ``index`` (places,), with a mean of 0."""
        values: FloatArray = self.by_place[index].reshape(places, -1).mean(axis=1)
        deviations: FloatArray = values - values.mean()
        return deviations


def with_forces_of_film(numbers: dict[str, T], load: float) -> dict[str, T]:
    """Return ``numbers`` with the shear force of the film that makes all friction forces add up to ``coefficient``
    times the ``load`` [N], and with its sliding part."""
    shear_force = load * numbers["coefficient"] - numbers["boundary_force"]
    return numbers | {"shear_force": shear_force, "couette_force": shear_force - numbers["rolling_force"]}


def with_divided_sliding(numbers: dict[str, float], before: dict[str, float], load: float) -> dict[str, float]:
    """Return ``numbers``, of a point that has another ``coefficient`` than ``before``, with friction forces that add up
    to it times the ``load`` [N].

    The film has what the asperity contacts leave. Where that would be against the sliding friction ``before``, asperity
    load and forces of asperities and film change in proportion to it. Where there was none, or the load does not
    suffice, the film keeps its sliding part and the rolling part changes.
    """
    changed = with_forces_of_film(numbers, load)
    sliding = changed["boundary_force"] + changed["couette_force"]
    sliding_before = before["boundary_force"] + before["couette_force"]
    if sliding_before and changed["couette_force"] * math.copysign(1.0, sliding_before) > -FORCE_ROUNDING * load:
        return changed
    growth = sliding / sliding_before if sliding_before else 0.0
    contact_load = growth * before["contact_load"]
    if growth > 0 and contact_load <= load:
        changed |= {name: growth * before[name] for name in ("boundary_force", "couette_force")}
        changed |= {"contact_load": contact_load, "film_load": load - contact_load}
        return changed | {"shear_force": changed["couette_force"] + changed["rolling_force"]}
    return with_rest_rolling(numbers | {"couette_force": before["couette_force"]}, load)


def with_rest_rolling(numbers: dict[str, float], load: float) -> dict[str, float]:
    """Return ``numbers`` with the rolling part that makes all friction forces add up to ``coefficient`` times the
    ``load`` [N], and with the shear force of the film."""
    shear_force = load * numbers["coefficient"] - numbers["boundary_force"]
    return numbers | {"shear_force": shear_force, "rolling_force": shear_force - numbers["couette_force"]}
