"""What a cheaper model knows of the strips of a line: the control of a more expensive one."""

from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from ..._base import FloatArray
from .statistics import StandardError

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
