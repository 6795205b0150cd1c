"""The careful search, with exact steps: two or three convolutions an iteration.

It converges surely where a small change of the contact set changes the pressure a lot: for nearly rigid bodies, and
after rounds that gained nothing.
"""

from __future__ import annotations

import numpy as np

from .descent import Descent
from .projection import with_load
from .residual import dot

CAPACITY = 0.999  # of the hardness times the free cells, beyond which they have to be more


class CarefulDescent(Descent):
    """A `Descent` whose steps are exact for the cells that are free. The part that the limits cut off is convolved at
    once."""

    def _precondition(self, operator, by_transform: bool) -> None:
        super()._precondition(operator, True)

    def _narrowed(self) -> bool:
        return False

    def _mark(self) -> tuple[int, float]:
        """As before; but if the free cells could not carry their share, everything that has not yielded for good."""
        count, height = super()._mark()
        f = self.fields
        if f.upper is None or not self.given:
            return count, height
        if self._share(f.weight > 0) > CAPACITY * self.hardness / self.unit * count:
            f.weight[:] = (f.change < f.upper) | (f.gap > self.level)
            count, height = int(np.count_nonzero(f.weight)), dot(f.gap, f.weight)
        return count, height

    def _share(self, free) -> float:
        """The load that the free cells have to carry."""
        f = self.fields
        return float((f.change - f.lower).sum(where=free)) + self.target - float(f.change.sum())

    def _step(self, mean: np.float32) -> None:
        """The step that is exact along the direction, then brought within the limits and to the load, on the free
        cells."""
        f = self.fields
        f.without(mean)
        free = f.weight > 0
        curvature = dot(f.direction, self._answer(f.direction)) * self.compliance
        slope = dot(f.before, f.direction)
        if not (curvature > 0 and slope < 0):
            self.power = 0.0
            return
        aim = (f.change + np.float32(-slope / curvature) * f.direction)[free]
        base = np.negative(f.lower[free], dtype=float)
        new, limit = base + aim, self.hardness / self.unit
        if self.given:
            new = with_load(new, self._share(free), limit)
        else:
            np.clip(new, 0.0, limit, out=new)
        way = np.negative(f.change)
        f.change[free] = self._rounded(new, base, free)
        way += f.change
        f.gap += self._answer(way) * np.float32(self.compliance)
        f.known[:] = f.change
