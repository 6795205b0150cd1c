"""One step of the working-set conjugate gradient: find the set, search, advance.

The working set holds the cells whose pressure may change: elastic contact (0 < p < H), overlap
without pressure, yielded cells that have opened. On it the gap is the gradient of the energy. The
preconditioner multiplies by |k|, the inverse of the half-space up to a factor. The step is exact for
a fixed set, then cut to 0 <= p <= H and, under a given load, shifted to carry it. Directions are kept
when the set changes, where I. A. Polonsky and L. M. Keer (Wear 231 (1999) 206-219,
doi:10.1016/S0043-1648(99)00113-1) restart.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..halfspace.operator import filtered, wavenumber
from .projection import with_load
from .residual import deflection_scale, dot

CAPACITY = 0.999  # of hardness times the set, beyond which the set has to grow
MEAN_STIFFNESS, NEARLY_FULL = 30.0, 1e-3  # measured: fewest iterations from one spot to 99.99 % contact


@dataclass(frozen=True)
class WorkingSet:
    """Flat indices of the set, pressure [Pa] and gap [m] there, and the worst residual of the whole field."""

    cells: np.ndarray
    pressure: np.ndarray
    gap: np.ndarray
    residual: float


class Descent:
    """The fields of one solve, changed in place, and the steps that change them.

    ``pressure`` [Pa] and ``height`` = gap0 + K p [m] are double; search directions and convolutions of
    changes are single, so ``height`` drifts by rounding until `recompute`. Exactly one of ``load``
    (total, Pa cells) and ``level`` (approach, m) is given.
    """

    def __init__(self, problem, pressure, *, load=None, level=None):
        self.problem, self.load, self.level = problem, load, level
        self.pressure = pressure
        self.fast = problem.operator.astype(np.float32)
        self.inverse = wavenumber(problem.operator.shape, problem.operator.spacing).astype(np.float32)
        self.direction, self.residue, self.scratch = (np.zeros(pressure.shape, np.float32) for _ in range(3))
        self.power = np.inf
        self.convolutions = 0
        self.recompute()

    def recompute(self) -> None:
        """Height from the pressure alone, in double precision."""
        self.height = self.problem.operator.apply(self.pressure)
        self.height += self.problem.gap0
        self.convolutions += 1
        self.approach = self._level(self.pressure.ravel(), self.height.ravel())

    def _level(self, pressure, height) -> float:
        """Prescribed approach, or the one at which the mean gap over elastic contact is zero; where nothing is
        elastic, halfway between the highest yielded cell and the lowest free one."""
        if self.level is not None:
            return self.level
        inside = (pressure > 0) & (pressure < self.problem.hardness)
        if inside.any():
            return float(height[inside].mean())
        yielded = self.pressure > 0
        highest = self.height[yielded].max()
        lowest_free = self.height[~yielded].min() if not yielded.all() else highest
        return float(0.5 * (highest + lowest_free))

    def working_set(self) -> WorkingSet:
        """Where the pressure may change, and the worst of complementarity and penetration."""
        hardness = self.problem.hardness
        candidate = self.height < self.approach
        candidate |= self.pressure > 0
        cells = np.flatnonzero(candidate)
        pressure, gap = self.pressure.ravel()[cells], self.height.ravel()[cells]
        total = pressure.sum()
        undeformed = self.problem.gap0.ravel()[cells]
        energy = dot(pressure, np.subtract(gap, undeformed, out=undeformed))
        del undeformed
        gap -= self.approach
        if np.isfinite(hardness):
            keep = (pressure < hardness) | (gap > 0)
            cells, pressure, gap = self._enough(cells[keep], pressure[keep], gap[keep], total)
        if not cells.size:
            return WorkingSet(cells, pressure, gap, 0.0)
        scale = deflection_scale(energy, total, self.problem.roughness, self.problem.operator)
        overlap = max(0.0, -gap[pressure < hardness].min(initial=0.0))
        if total <= 0:
            return WorkingSet(cells, pressure, gap, math.inf if overlap > 0 else 0.0)
        misfit = dot(pressure, np.abs(gap)) / total
        return WorkingSet(cells, pressure, gap, float(max(overlap, misfit) / scale))

    def _enough(self, cells, pressure, gap, total):
        """The set itself, or everything that has not yielded for good when the set could not carry its share."""
        hardness = self.problem.hardness
        if self.load is None or self.load - (total - pressure.sum()) <= CAPACITY * hardness * cells.size:
            return cells, pressure, gap
        cells = np.flatnonzero((self.pressure < hardness) | (self.height > self.approach))
        return cells, self.pressure.ravel()[cells], self.height.ravel()[cells] - self.approach

    def search(self, work: WorkingSet, restart: bool) -> tuple[np.ndarray, float]:
        """Conjugate direction on the set (Polak-Ribiere, never negative) and its slope."""
        self._scatter(self.scratch, work.cells, self._balanced(work.gap.copy()))
        operator = self.problem.operator
        self.inverse[0, 0] = self._mean_stiffness(work.cells.size / self.pressure.size)
        d = filtered(self.scratch, self.inverse, operator.shape, operator.workers).ravel()[work.cells]
        d = self._balanced(np.negative(d, dtype=float))
        self.convolutions += 1
        power = -dot(work.gap, d)
        if not restart:
            turned = self.scratch.ravel()[work.cells]
            turned -= self.residue.ravel()[work.cells]
            keep = np.float32(max(0.0, -dot(turned, d) / self.power))
            np.multiply(self.direction.ravel()[work.cells], keep, out=turned)
            d += turned
            d = self._balanced(d)
        self.residue, self.scratch, self.power = self.scratch, self.residue, power
        return d, dot(work.gap, d)

    def advance(self, work: WorkingSet, d: np.ndarray, slope: float) -> bool:
        """Exact step along ``d``, made admissible; False when there is nowhere to go."""
        self._scatter(self.direction, work.cells, d)
        change = self.fast.apply(self.direction)
        self.convolutions += 1
        curvature = dot(d, change.ravel()[work.cells])
        if not (curvature > 0 and slope < 0):
            return False
        step = -slope / curvature
        new = step * d
        new += work.pressure
        if new.min() >= 0 and new.max() <= self.problem.hardness:
            change *= np.float32(step)
        else:
            new = self._admissible(new, work)
            self._scatter(self.scratch, work.cells, new - work.pressure)
            change = self.fast.apply(self.scratch)
            self.convolutions += 1
        self.pressure.ravel()[work.cells] = new
        self.height += change
        self.approach = self._level(new, self.height.ravel()[work.cells])
        return True

    def _admissible(self, trial, work: WorkingSet) -> np.ndarray:
        if self.load is None:
            return np.clip(trial, 0.0, self.problem.hardness)
        yielded_outside = self.pressure.sum() - work.pressure.sum()
        return with_load(trial, self.load - yielded_outside, self.problem.hardness)

    def _balanced(self, values) -> np.ndarray:
        """``values`` in place, without their mean where the load is given."""
        if self.load is not None:
            values -= values.mean()
        return values

    def _mean_stiffness(self, fraction: float) -> float:
        """|k| that stands in at k = 0: immaterial under a load, whose search has no mean. For an approach the mean
        pressure is free, and the stiffer the less of the area is left to open."""
        smallest = 2 * math.pi / max(n * d for n, d in zip(self.problem.operator.shape, self.problem.operator.spacing))
        return MEAN_STIFFNESS * smallest * fraction / (1 - fraction + NEARLY_FULL)

    @staticmethod
    def _scatter(field, cells, values) -> None:
        field.fill(0)
        field.ravel()[cells] = values
