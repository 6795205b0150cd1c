"""What follows from a pressure alone: gap, approach and residuals of the whole patch."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .residual import blocks, contact_residuals, deflection_scale, dot


@dataclass(frozen=True)
class State:
    """A pressure [Pa] with its displacement and gap [m] (nx, ny) and its approach [m].

    ``scale`` [m]: the length that residuals are measured in; complementarity and penetration: the residuals. All are in
    the precision of the operator used.
    """

    pressure: np.ndarray
    displacement: np.ndarray
    gap: np.ndarray
    approach: float
    scale: float
    residuals: dict[str, float]

    @property
    def residual(self) -> float:
        """The worst."""
        return max(self.residuals.values())

    def light(self) -> State:
        """The state without displacement and with the gap in single precision, which is what a search needs."""
        return replace(self, displacement=np.empty((0, 0)), gap=self.gap.astype(np.float32))

    @property
    def overlap(self) -> float:
        """Deepest overlap [m] of cells that have not yielded."""
        return (
            self.residuals["penetration"] * self.scale if np.isfinite(self.scale) else max(0.0, -float(self.gap.min()))
        )


def look(problem, operator, pressure, level=None) -> State:
    """The `State` of ``pressure`` by one application of ``operator``; ``level`` [m]: a prescribed approach."""
    displacement = operator.apply(pressure)
    gap = problem.gap0 + displacement
    approach = _approach(problem, pressure, gap) if level is None else level
    gap -= approach
    scale = deflection_scale(dot(pressure, displacement), pressure.sum(), problem.roughness, operator)
    residuals = contact_residuals(pressure, gap, scale, problem.hardness, 1.0)
    del residuals["load"]
    return State(pressure, displacement, gap, approach, scale, residuals)


def _approach(problem, pressure, height) -> float:
    """The approach at which the mean gap over elastic contact is zero; where nothing is elastic, halfway between the
    highest yielded cell and the lowest free one."""
    count, total = 0, 0.0
    for p, h in blocks(pressure, height):
        inside = p > 0
        inside &= p < problem.hardness
        count += int(np.count_nonzero(inside))
        total += dot(h, inside.astype(float))
    if count:
        return total / count
    yielded = pressure > 0
    highest = height[yielded].max()
    return float(0.5 * (highest + (height[~yielded].min() if not yielded.all() else highest)))
