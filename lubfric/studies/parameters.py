"""The unknown numbers of a scene, and their positions between their bounds on the unit interval."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .._base import validate
from ..errors import InputError
from ..scene import Scene
from .vary import check_temperature

LOGARITHMIC = 10.0  # ratio of positive bounds from which a parameter is sought in its logarithm


@dataclass(frozen=True)
class Parameters:
    """``keys`` "section.name" of a scene, and their ``low`` and ``high`` bounds, arrays (p,)."""

    keys: tuple[str, ...]
    low: np.ndarray
    high: np.ndarray

    @property
    def logarithmic(self) -> np.ndarray:
        """Which parameters are searched in their logarithm."""
        return (self.low > 0) & (self.high >= LOGARITHMIC * np.where(self.low > 0, self.low, 1.0))

    def values(self, unit: np.ndarray) -> np.ndarray:
        """Values at positions in [0, 1]."""
        low, high = self._scaled(self.low), self._scaled(self.high)
        found = low + unit * (high - low)
        return np.where(self.logarithmic, np.exp(np.where(self.logarithmic, found, 0.0)), found)

    def unit(self, values: np.ndarray) -> np.ndarray:
        """Positions in [0, 1] of values."""
        low, high = self._scaled(self.low), self._scaled(self.high)
        return (self._scaled(values) - low) / (high - low)

    def slopes(self, unit: np.ndarray) -> np.ndarray:
        """d value/d unit."""
        width = self._scaled(self.high) - self._scaled(self.low)
        return np.where(self.logarithmic, self.values(unit) * width, width)

    def _scaled(self, values: np.ndarray) -> np.ndarray:
        """Logarithms of the values that are searched in these, and the others as they are."""
        return np.where(self.logarithmic, np.log(np.maximum(values, 1e-300)), values)

    def into(self, scene: Scene, values: np.ndarray) -> Scene:
        """``scene`` with these values."""
        return scene.with_keys(dict(zip(self.keys, values.tolist())))


def parameters_of(scene: Scene, bounds) -> Parameters:
    """The `Parameters` of {"section.key": (low, high)}, the scene checked at both ends of each."""
    if not isinstance(bounds, dict) or not bounds:
        raise InputError('parameters must be a dict such as {"bodies.boundary_friction_coefficient": (0.05, 0.2)}')
    check_temperature("parameters", scene, set(bounds))
    low, high = [], []
    for key, pair in bounds.items():
        if not isinstance(pair, (tuple, list)) or len(pair) != 2:
            raise InputError(f"parameters[{key!r}] = {pair!r}; allowed: a pair (lowest, highest)")
        low.append(validate.number(f"parameters[{key!r}] lowest", pair[0], "(of the key)"))
        high.append(validate.number(f"parameters[{key!r}] highest", pair[1], "(of the key)", above=low[-1]))
        section, _, name = str(key).partition(".")
        if section not in ("bodies", "lubricant", "motion", "surface") or not name:
            raise InputError(f"parameters: {key!r}; allowed: a number of [bodies], [lubricant], [motion] or [surface]")
        if key in ("motion.entrainment_speed", "motion.speeds"):
            raise InputError(f"parameters: {key!r} is measured, not fitted; name another number of the scene")
        for end in (low[-1], high[-1]):
            scene.with_keys({key: end})
    return Parameters(tuple(bounds), np.array(low), np.array(high))
