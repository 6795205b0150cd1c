"""What a cheaper model knows of the strips of a line: the control of a more expensive one."""

from dataclasses import dataclass

import numpy as np

from .statistics import StandardError


@dataclass(frozen=True)
class ControlVariate:
    """By how much the strips of a line differ from it.

    Attributes
    ----------
    by_place : of f at every place of each strip (count, rows)
    numbers : of each strip (count,), by name
    sampling_error : relative, of f on the line
    """

    by_place: np.ndarray
    numbers: dict[str, np.ndarray]
    sampling_error: StandardError

    @property
    def count(self) -> int:
        """Number of its strips."""
        return self.by_place.shape[0]

    def deviations(self, index: int, places: int) -> np.ndarray:
        """Return the differences of f at so many ``places`` along strip ``index`` (places,), with a mean of 0."""
        values = self.by_place[index].reshape(places, -1).mean(axis=1)
        return values - values.mean()
