"""The contact on finer and finer grids under the film of a coarser balance, and what its grid makes f wrong by."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from ..rough.contract import ContactState, RoughContact
from .balance import Balance
from .operating_point import OperatingPoint, pressed_under
from .tolerances import Stage

WORST_GRID = 2.0  # relative error of the film's load that the coarsest grid may make
LARGEST_MOVE = 1.0  # of ln(F_H/F_C), foretold from grid to grid


@dataclass(frozen=True)
class Refined:
    """The grid reached (its index), what the volume residual changed by from grid to grid on the way there, and the point
    and balance, moved from a coarser grid to where this one should have its own."""

    index: int
    changes: tuple[float, ...]
    point: OperatingPoint
    balance: Balance


def refined(grids: Sequence[RoughContact], index: int, changes: tuple[float, ...], stage: Stage, limit: float):
    """Contact on grids finer than ``grids[index]`` under the film and load of ``stage``, until the rest is within ``limit``.

    What the volume residual changes by from grid to grid, over the slope of the balance, is what the split of the
    load would: no film is solved.
    """
    balance, contact, state, total = stage.balance, stage.point.contact, stage.balance.contact, 0.0
    while index < len(grids) - 1:
        index += 1
        contact, found = _under_the_film(stage, grids[index], contact, state)
        change = found.volume_residual - state.volume_residual
        changes, total, state = (*changes, change), total + change, found
        if grid_error(changes, stage, limit) <= limit:
            break
    step = 0.0 if not balance.slope else min(max(-total / balance.slope, -LARGEST_MOVE), LARGEST_MOVE)
    point = replace(stage.point, contact=contact)
    return Refined(index, changes, point, replace(balance, contact=state).moved(step))


def _under_the_film(stage: Stage, whole: RoughContact, coarser: RoughContact, state: ContactState):
    """(contact, state) on ``whole``, or the part of it that is enough, under the film and load of ``stage``."""
    balance = stage.balance
    part = whole.cut(state, coarser)
    found = _closed(stage, part, state)
    if part is whole or whole.holds(part, pressed_under(stage.point.scene, balance.film, whole.x), found):
        return part, found
    return whole, _closed(stage, whole, found)


def _closed(stage: Stage, contact: RoughContact, start: ContactState) -> ContactState:
    """At the tolerance of ``contact`` itself: between grids no more is asked."""
    film = stage.balance.film
    shape = pressed_under(stage.point.scene, film, contact.x)
    return contact.close(film.film_at(contact.x), stage.balance.contact_load, start, shape)


def grid_error(changes: Sequence[float], stage: Stage, limit: float) -> float:
    """Estimated relative error of f from the contact grid; infinite where nothing can be said.

    Whatever the grid does to the film's share of the load, f feels no more than ``sensitivity`` of it. Else from the
    last two changes d2, d1 of the volume residual between grids, r = d1/d2 within 1/4 (second order) and 3/4 (hardly
    converging), 1/2 where there is no d2: the rest of the geometric series d1 r/(1 - r), and no less than d2/12, as if d1
    were small by chance; times 2 ``sensitivity``, the effect of a residual on f.
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
