"""The effect of another cell length on a patch: its contact is solved again on longer cells, under the same film and
load."""

from __future__ import annotations

import math

from ..sharing import Prepared, Solved, Validity
from .at_split import at

EVERY = (2, 4)  # cells of which one is kept
SLOWEST, FASTEST = 0.5, 0.125  # ratio of successive changes
CHECKED = 0.1  # of the tolerance: an estimate from averaged cells below it needs no other


def by_half_cells(prepared: Prepared, speed: float, point: Solved) -> float:
    """Estimated relative change of f on cells half as long as the map's own.

    The contact on every second and every fourth cell, under the same film and load, changes the volume residual by d1
    and d2. `half_again` gives the next change, and f changes by twice its sensitivity times that. NaN if nothing can be
    told: the point was solved on other cells, or on its own ones by name; averaged cells showed no relevant change; or
    there is nothing to compare with.
    """
    balance, decision = point.balance, point.decision
    known = decision.grid_error is None and decision.own_error > CHECKED * decision.tolerance
    if not known or "grid" in decision.forced or balance.lubricated is None or balance.contact_load == 0:
        return math.nan
    found = [balance.contact.volume_residual]
    for every in EVERY:
        coarse = point.contact.thinned(every)
        if coarse is None:
            break
        thickness, shape = at(prepared, speed, coarse, balance.lubricated).film_on(coarse, balance.lubricated.film)
        found.append(coarse.close(thickness, balance.contact_load, balance.contact, shape).volume_residual)
    if len(found) == 1:
        return math.nan
    return 2 * balance.gap_sensitivity * half_again([a - b for a, b in zip(found, found[1:])])


def half_again(changes) -> float:
    """The change by the next halving, from the ``changes`` d1 (and d2) by the last halvings, the last first.

    It is d1 r with r = d1/d2, kept between 1/8 (smooth, second order and better) and 1/2 (detail at every scale; also
    if there is no d2). It is at least d2/32, in case d1 is small by chance.
    """
    d1, d2 = abs(changes[0]), abs(changes[1]) if len(changes) > 1 else 0.0
    ratio = min(max(d1 / d2, FASTEST), SLOWEST) if d2 > 0 else SLOWEST
    return max(d1 * ratio, d2 / 32)


def too_coarse(change: float, tolerance: float) -> tuple[Validity, ...]:
    """A caution where cells half as long would change f by more than ``tolerance``."""
    if not change > tolerance:
        return ()
    return (
        Validity(
            "change of f by cells half as long, estimated",
            100 * change,
            100 * tolerance,
            "%",
            "the map is too coarse for its roughness; the interval of f does not include that",
            "use a map on shorter cells",
        ),
    )
