"""What follows from the pressure alone: gap, approach and residuals of the whole patch."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .fields import BLOCK
from .residual import blocks, contact_residuals, deflection_scale, dot


@dataclass(frozen=True)
class State:
    """A pressure [Pa] with its displacement and gap [m] (nx, ny) and its approach [m].

    ``scale`` [m]: the length in which residuals are measured; complementarity and penetration: the residuals. All have
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
        """The state without displacement and with the gap in single precision, which is enough for a search."""
        return replace(self, displacement=np.empty((0, 0)), gap=self.gap.astype(np.float32, copy=False))

    @property
    def overlap(self) -> float:
        """Deepest overlap [m] of cells that have not yielded."""
        return (
            self.residuals["penetration"] * self.scale if np.isfinite(self.scale) else max(0.0, -float(self.gap.min()))
        )


def look(problem, operator, pressure, level=None) -> State:
    """The `State` of ``pressure`` by one application of ``operator``; ``level`` [m]: a prescribed approach."""
    displacement = operator.apply(pressure)
    gap = np.empty(displacement.shape, displacement.dtype)
    energy = total = height = 0.0
    count, room = 0, np.empty(min(BLOCK, gap.size))
    for p, u, g, own in blocks(pressure, displacement, problem.gap0, gap):
        np.add(g, u, out=own, casting="same_kind")
        total += float(p.sum())
        energy += dot(p, u)
        if level is None:
            inside = p > 0
            if problem.hardness < np.inf:
                inside &= p < problem.hardness
            count += int(np.count_nonzero(inside))
            height += float(np.multiply(own, inside, out=room[: own.size]).sum())
    approach = level
    if level is None:
        approach = height / count if count else _between(pressure, gap)
    gap -= approach
    scale = deflection_scale(energy, total, problem.roughness, operator)
    residuals = contact_residuals(pressure, gap, scale, problem.hardness, 1.0)
    del residuals["load"]
    return State(pressure, displacement, gap, approach, scale, residuals)


def _between(pressure, height) -> float:
    """The approach if nothing is elastic: halfway between the highest yielded cell and the lowest free one. (Otherwise
    it is the approach at which the mean gap over elastic contact is zero.)"""
    yielded = pressure > 0
    highest = height[yielded].max()
    return float(0.5 * (highest + (height[~yielded].min() if not yielded.all() else highest)))
