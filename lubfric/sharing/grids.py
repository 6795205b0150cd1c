"""The contact on finer and finer grids, and the resulting error of f."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..contact import ContactState, RoughContact
from ..scene import budget
from .balance import Balance
from .one_grid import Stage, on_grid
from .operating_point import OperatingPoint
from .split import growth
from .tolerances import balance_tolerance, felt_gap

LEAST_ROUGHNESS = 0.9  # of Sq, kept by the averages over the largest cells
LEAST_CONTACT = 1e-6  # of the load: less is next to separation on this grid
WORST_GRID = 2.0  # relative error of the film's load that the coarsest grid may make
SEEN, FEW_CELLS = 0.3, 64  # of what summits have lost; touching cells below which all of that counts
LARGEST_MOVE = 1.0  # of ln(F_H/F_C), foretold from grid to grid


@dataclass(frozen=True)
class Refined:
    """The grid reached (its index), the changes of the volume residual from grid to grid on the way there, and the
    point on it. The point is either ``known`` (film and contact at the split of ``balance``), or ``balance`` moved from
    a coarser grid to where the balance on this one is expected."""

    index: int
    changes: tuple[float, ...]
    point: OperatingPoint
    balance: Balance
    known: Stage | None = None


def coarser_grids(contact: RoughContact, sq: float) -> list[RoughContact]:
    """``contact`` on several grids, from the coarsest that still resolves its roughness ``sq`` [m] to its own: at least
    two grids if it can be halved."""
    contacts = [contact]
    while (coarse := contacts[0].coarsened()) is not None:
        if len(contacts) > 1 and coarse.sq < LEAST_ROUGHNESS * sq:
            break
        contacts.insert(0, coarse)
    return contacts


def on_enough_cells(
    point: OperatingPoint, grids: Sequence[RoughContact], start: Balance | None
) -> tuple[Stage, int, float]:
    """The balance on the first of ``grids`` whose estimated error of f is within its share; the index of that grid; and
    the error (infinite: unknown).

    With several grids, the volume on the coarsest is closed only loosely, and short by the change that finer grids made
    at ``start``. The balance then continues from the residual left, from its change by the grid, and from its slope.
    """
    numerics = point.scene.numerics
    limit, movable = budget.CONTACT_GRID * numerics.tolerance, numerics.closure == "load"
    sensitivity = 1.0 if start is None or start.film is None else felt_gap(numerics, start)
    index, last = 0, len(grids) - 1
    given, known = start, () if start is None else start.states
    if start is not None and known:
        start = replace(start.closed, contact=known[0])
    point = replace(point, contact=grids[0])
    changes: tuple[float, ...] = ()
    refound: Stage | None = None
    while True:
        states = () if start is None or not index else start.states
        loosest = budget.LOOSEST_VOLUME if movable and index < last and not changes else 0.0
        tolerance = max(balance_tolerance(numerics, sensitivity), loosest)
        aim = 0.0 if start is None or not loosest else start.coarse
        point = replace(point, settings=replace(point.settings, balance_tolerance=tolerance, aim=aim))
        stage = on_grid(point, grids[index], start, loosest, refound)
        sensitivity = felt_gap(numerics, stage.balance)
        balance = replace(stage.balance, states=(*states, stage.balance.contact), coarse=-sum(changes))
        stage = replace(stage, balance=balance)
        error = grid_error(changes, stage.balance, limit, grids[index].lost) if changes else math.inf
        if index == last or error <= limit:
            return stage, index, error
        if stage.balance.contact_load < LEAST_CONTACT * point.scene.bodies.load:  # too coarse to hold the summits
            index, changes, refound = index + 1, (), None
            point, start = replace(stage.point, contact=grids[index]), given
        else:
            finer = refined(stage, grids, (index, changes, limit), known)
            index, changes, refound = finer.index, finer.changes, finer.known
            point, start = finer.point, finer.balance


def refined(
    stage: Stage,
    grids: Sequence[RoughContact],
    at: tuple[int, tuple[float, ...], float],
    known: Sequence[ContactState] = (),
) -> Refined:
    """Solve the contact on grids finer than that of ``stage``, under its film and load, until the remaining error is
    within the limit. The change of the volume residual from grid to grid, over the slope of the balance, is the change
    of the split; no film is solved. ``at``: index of the grid, changes of the residual so far, and limit. ``known``:
    states of a neighbour, to start from."""
    index, changes, limit = at
    balance, contact, state = stage.balance, stage.point.contact, stage.balance.contact
    states = list(balance.states)
    while index < len(grids) - 1:
        index += 1
        near = known[index] if index < len(known) else None
        contact, found = under_the_film(stage, grids[index], (contact, state), near)
        change = found.volume_residual - state.volume_residual
        changes, state = (*changes, change), found
        states.append(found)
        if grid_error(changes, balance, limit, grids[index].lost) <= limit:
            break
    point = replace(stage.point, contact=contact)
    found_here = replace(balance, contact=state, states=tuple(states[:-1]))
    if _is_trial(stage):
        return Refined(index, changes, point, found_here, replace(stage, point=point, balance=found_here))
    step = 0.0 if not balance.slope else -state.volume_residual / balance.slope
    step = min(max(step, -LARGEST_MOVE), LARGEST_MOVE)
    return Refined(index, changes, point, found_here.moved(step))


def _is_trial(stage: Stage) -> bool:
    """Whether a contact under the film of ``stage`` is what a trial of the root on that grid would find, so that the
    root can continue from it."""
    numerics, settings = stage.point.scene.numerics, stage.point.settings
    by_load = numerics.closure == "load" and numerics.film_deflection != "total"
    return by_load and settings.contact_tolerance is None and bool(stage.balance.slope)


def under_the_film(
    stage: Stage, whole: RoughContact, coarser: tuple[RoughContact, ContactState], near: ContactState | None
) -> tuple[RoughContact, ContactState]:
    """The contact on ``whole``, or on the part of it that is enough, under the film and load of ``stage``, and its
    state. It starts from the contact on a ``coarser`` grid, or from ``near``, that of a neighbour on such a grid. It is
    solved to its own tolerance: the comparison of grids needs no more."""
    contact, state = coarser
    film, load, part = stage.balance.film, stage.balance.contact_load, whole.cut(state, contact)
    thickness, shape = stage.point.film_on(part, film)
    found = part.close(thickness, load, near or state, shape)
    if part is whole:
        return whole, found
    thickness, shape = stage.point.film_on(whole, film)
    if whole.holds(part, shape, found):
        return part, found
    return whole, whole.close(thickness, load, found, shape)


def grid_error(changes: Sequence[float], balance: Balance, limit: float, lost: float = 0.0) -> float:
    """Estimated relative error of f by the contact grid; infinite where nothing can be said.

    It follows from the last two changes d2, d1 of the volume residual between grids. The changes still to come are a
    geometric series d1 r/(1 - r) with r = d1/d2, kept between 1/4 (second order) and 3/4 (hardly converging), or 1/2
    where there is no d2. It has two lower bounds: d2/12, in case d1 is small by chance, and, where few cells touch, a
    part of what its summits have ``lost`` [m] to the averages over its cells. To first order f changes by 2
    ``gap_sensitivity`` times the sum; but the load of a light contact depends exponentially on the gap, with s =
    ln(F_H/F_C) in proportion to it. However the grid changes the film's share of the load, f changes by at most
    ``sensitivity`` times that change.
    """
    if balance.contact_load == 0:
        return math.inf
    bound = WORST_GRID * balance.forces.sensitivity
    if bound <= limit:
        return bound
    if not changes:
        return math.inf
    d2, d1 = abs(changes[-2]) if len(changes) > 1 else 0.0, abs(changes[-1])
    ratio = min(max(d1 / d2, 0.25), 0.75) if d2 > 0 else 0.5
    rest = max(d1 * ratio / (1 - ratio), d2 / 12, _by_chance(balance.contact, lost))
    return 2 * balance.gap_sensitivity * rest * growth(rest / abs(balance.slope) if balance.slope else 0.0)


def _by_chance(contact: ContactState, lost: float) -> float:
    """Part of the volume residual by ``lost`` [m] summits that two grids may miss, however alike the contact looks."""
    cells = FEW_CELLS if contact.pressure is None else np.count_nonzero(contact.pressure)
    return SEEN * lost / (2 * contact.mean_film) * min(1.0, FEW_CELLS / max(cells, 1))
