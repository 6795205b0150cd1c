"""The contact on finer and finer grids under the film of a coarser balance, and what its grid makes f wrong by."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from ..balance import Balance
from ..patch.cylinder import CylinderPatch
from .balance_at import Settings, Stage, carried_over, film_shape, moved_split
from .contact_grid import cut, holds, in_contact

WORST_GRID = 2.0  # relative error of the film's load that the coarsest grid may make


@dataclass(frozen=True)
class Moved:
    """A patch, the balance of a coarser one moved to where this one should have its own, and the settings."""

    patch: object
    balance: Balance
    settings: Settings


def finer_contact(model, ladder, index, changes, stage: Stage, limit) -> tuple[int, list, Moved]:
    """Contact on finer and finer grids under the film and load of ``stage``, until the rest is within ``limit``.

    What the volume residual changes by from grid to grid, over the slope of the balance, is what the split of the
    load would: no film is solved. Returns the grid, all changes, and where its balance is to be expected.
    """
    closure, balance, total = stage.balance.closure, stage.balance, 0.0
    changes, patch = list(changes), stage.patch
    while index < len(ladder) - 1:
        index += 1
        whole = ladder[index]
        finer = cut(whole, in_contact(patch, closure.contact.pressure)) if _cut_allowed(model) else whole
        found = _closed(model, finer, balance, closure)
        if not holds(finer, whole, film_shape(model.scene, whole, balance.film), found.contact):
            finer = whole
            found = _closed(model, finer, balance, found)
        change = found.volume_residual - closure.volume_residual
        changes, total, closure, patch = [*changes, change], total + change, found, finer
        if grid_error(changes, stage, limit) <= limit:
            break
    step = 0.0 if not balance.slope else min(max(-total / balance.slope, -1.0), 1.0)
    return index, changes, Moved(patch, moved_split(replace(balance, closure=closure), step), stage.settings)


def _closed(model, patch, balance: Balance, closure):
    """Contact on ``patch`` under the film and load of ``balance``, begun from the pressure of ``closure``."""
    film = balance.film
    start = carried_over(replace(balance, closure=closure), patch).closure.contact
    return patch.close(film.film_at(patch.x), balance.contact_load, start, film_shape(model.scene, patch, film))


def _cut_allowed(model) -> bool:
    return isinstance(model.patch, CylinderPatch) and model.scene.contact.region == "hertz"


def grid_error(changes: list[float], stage: Stage, limit: float) -> float:
    """Estimated relative error of f from the contact grid; infinite where nothing can be said.

    Whatever the grid does to the film's share of the load, f feels no more than ``sensitivity`` of it. Else from the
    last two changes d2, d1 of the volume residual between grids, r = d1/d2 within 1/4 (second order) and 3/4 (hardly
    converging), 1/2 where there is no d2: the rest of the geometric series d1 r/(1 - r), and no less than d2/12, as if d1 were small by chance;
    times 2 ``sensitivity``, the effect of a residual on f.
    """
    if stage.balance.contact_load == 0:
        return math.inf
    bound = WORST_GRID * stage.forces.sensitivity
    if bound <= limit:
        return bound
    if not changes:
        return math.inf
    d2, d1 = abs(changes[-2]) if len(changes) > 1 else 0.0, abs(changes[-1])
    ratio = min(max(d1 / d2, 0.25), 0.75) if d2 > 0 else 0.5
    return 2 * stage.forces.sensitivity * max(d1 * ratio / (1 - ratio), d2 / 12)
