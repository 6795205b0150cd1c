"""Contact areas of a patch that was solved on cells longer than its own, extrapolated to its own cells."""

from __future__ import annotations

import math

from ..contact import ContactState, Grid
from ..sharing import Prepared, Solved
from .at_split import at

SURE = 1.5  # times the estimate: seen to hold in 95 % of random scenes
FIELDS = ("real_contact_area_fraction", "real_contact_area", "plastic_area_fraction")


def areas_on_own_cells(prepared: Prepared, speed: float, point: Solved) -> dict[str, tuple[float, float]]:
    """(value, relative error) of the areas, by the names of `FrictionResult`. Empty if ``point`` is on its own cells,
    or if there are no coarser ones.

    Averages over longer cells touch over more area, in proportion to their length. Say the contact on cells s times as
    long, under the same film and load, changes an area by d. Then the area on cells c times as long as the map's own is
    too large by d (c - 1)/(c (s - 1)), which is subtracted. The stated error is one and a half times that, together
    with the error of counting the n cells in contact, 1/sqrt(n).
    """
    balance, decision = point.balance, point.decision
    coarse, grid = point.contact.coarsened() if decision.grid_error is not None else None, point.contact.grid
    if coarse is None or grid is None or coarse.grid is None or balance.contact_load == 0 or balance.lubricated is None:
        return {}
    thickness, shape = at(prepared, speed, coarse, balance.lubricated).film_on(coarse, balance.lubricated.film)
    state = coarse.close(thickness, balance.contact_load, balance.contact, shape)
    times, longer = math.sqrt(math.prod(decision.coarsening)), _cell(coarse.grid) / _cell(grid)
    share, width = (times - 1) / (times * (longer - 1)), prepared.scene.bodies.width
    counted = balance.contact.contact_fraction.sum() * grid.cells[1]
    found = {}
    for name, value in _areas(balance.contact, width).items():
        change = share * (_areas(state, width)[name] - value)
        if value - change > 0:
            found[name] = value - change, SURE * math.hypot(change / (value - change), counted**-0.5)
    return found


def _areas(state: ContactState, width: float) -> dict[str, float]:
    touched = float(state.contact_fraction.sum() * (state.x[1] - state.x[0]) * width)
    return dict(zip(FIELDS, (state.real_contact_area_fraction, touched, state.plastic_area_fraction)))


def _cell(grid: Grid) -> float:
    """Length of a cell [m], the geometric mean of both axes."""
    return math.sqrt(math.prod(grid.spacing))
