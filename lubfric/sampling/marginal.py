"""Cells of a contact of which the error of its balance leaves open whether they touch, and what friction hangs on them.

On a small patch f moves in steps: a cell that touches carries no fluid shear. Where friction is the small rest of what
the film pushes forward and back, one cell is worth some per cent of f.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..contact import ContactState, Grid
from ..film import ShearForce
from ..sharing import Prepared, Solved, forces

SQUARE = 8 * math.asinh(1) / math.pi  # E' times the deflection amid a square under pressure, over pressure and side


@dataclass(frozen=True)
class Marginal:
    """What cells that may touch or not leave open: ``couette`` and ``rolling`` [N] of the film's shear, without sign,
    and the contact ``area``, relative."""

    couette: float = 0.0
    rolling: float = 0.0
    area: float = 0.0

    def errors(self, shear: ShearForce) -> dict[str, float]:
        """Relative errors of ``shear`` and its parts, by the names of `FrictionResult`."""
        parts = {
            "shear_force": (self.couette + self.rolling, shear.total),
            "couette_force": (self.couette, shear.couette),
            "rolling_force": (self.rolling, shear.rolling),
        }
        return {name: error / abs(force) for name, (error, force) in parts.items() if force}


def marginal_cells(state: ContactState, grid: Grid, e_prime: float, gap_error: float) -> tuple[np.ndarray, np.ndarray]:
    """Cells (nx, ny) that touch and may open, and open ones that may touch, where both surfaces may be nearer or
    further by ``gap_error`` [m].

    An open cell may touch if its gap is smaller than that. A touching one may open if its pressure is less than that
    which deflects the middle of a square cell of side a by it: p < pi E' gap_error/(8 a asinh 1), with E' = 2/((1 -
    nu1²)/E1 + (1 - nu2²)/E2) (Johnson 1985, Contact Mechanics, Eq. 3.25). Unloaded neighbours make it less.
    """
    fields = state.fields
    assert fields is not None
    side = math.sqrt(math.prod(grid.spacing))
    touching = fields.pressure > 0
    return touching & (fields.pressure < e_prime * gap_error / (SQUARE * side)), ~touching & (fields.gap < gap_error)


def marginal(prepared: Prepared, point: Solved, gap_error: float) -> Marginal:
    """What the `marginal_cells` of ``point`` leave open at ``gap_error`` [m]: the more of all of them opening and all
    closing, before and behind the line of contact by themselves, since there the rolling friction has other signs."""
    state, grid = point.balance.contact, point.contact.grid
    if point.balance.lubricated is None or point.balance.contact_load == 0 or state.fields is None or grid is None:
        return Marginal()
    found, touching = [Marginal()], np.count_nonzero(state.fields.pressure)
    for cells, sign in zip(marginal_cells(state, grid, prepared.scene.bodies.e_prime, gap_error), (-1, 1)):
        if cells.any():
            sides = [_changed(prepared, point, sign * np.where(side, cells.mean(axis=1), 0)) for side in _sides(state)]
            couette, rolling = (float(sum(side)) for side in zip(*sides))
            found.append(Marginal(couette, rolling, np.count_nonzero(cells) / touching))
    return Marginal(*(max(getattr(one, name) for one in found) for name in ("couette", "rolling", "area")))


def _sides(state: ContactState) -> tuple[np.ndarray, np.ndarray]:
    return state.x < 0, state.x >= 0


def _changed(prepared: Prepared, point: Solved, more: np.ndarray) -> tuple[float, float]:
    """Change of the couette and rolling force [N], without sign, where ``more`` (nx,) of the width touches."""
    balance = point.balance.lubricated
    assert balance is not None
    if not more.any():
        return 0.0, 0.0
    fraction = np.clip(balance.contact.contact_fraction + more, 0.0, 1.0)
    trial = replace(balance.trial, contact=replace(balance.contact, contact_fraction=fraction))
    shear, old = forces(prepared.scene, balance.level, trial).shear, balance.forces.shear
    return abs(shear.couette - old.couette), abs(shear.rolling - old.rolling)
