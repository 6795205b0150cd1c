"""The balance on one contact grid, at the film level and the tolerances that its own sensitivity needs."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from ..contact import RoughContact
from ..film import LeftOut, given_level, higher, lowest_level
from ..scene import budget
from .balance import Balance, Lubricated, balanced
from .operating_point import OperatingPoint, Settings
from .tolerances import (
    allowed_left_out,
    balance_tolerance,
    contact_tolerance,
    felt_gap,
    felt_share,
    film_tolerance,
    least_cells,
)

ROUNDS = 8  # each with a higher level or tighter tolerances


@dataclass(frozen=True)
class Stage:
    """An operating point, its balance, and what its film leaves out."""

    point: OperatingPoint
    balance: Lubricated
    left_out: LeftOut


def on_grid(
    point: OperatingPoint, whole: RoughContact, start: Balance | None, loosest: float = 0.0, known: Stage | None = None
) -> Stage:
    """The balance on the point's contact. If that is a part of ``whole`` and turns out to be too small, on all of it.

    The balance is repeated, each time from the last, until its settings are those that it shows to be needed.
    ``loosest``: a volume residual that is good enough for any f, where finer grids follow. ``known``: film and contact
    at the split of ``start``, on a part that is enough, and what that film leaves out. Where a balance cannot be closed
    as tightly as needed, because f jumps with single cells, the last one of the same film level stands: its error is
    told.
    """
    closed: Stage | None = None
    for _ in range(ROUNDS):
        balance = balanced(point, start, None if known is None else known.balance.trial)
        again = known is not None and balance.contact is known.balance.contact
        if not again and not point.suffices(whole, balance.film, balance.contact):
            point, known = replace(point, contact=whole), None
            continue
        stage = Stage(point, balance, known.left_out if known is not None and again else _left_out(point, balance))
        closed, settings = stage if balance.report.converged else closed, needed_settings(stage, loosest)
        if settings is None:
            break
        known = stage if _as_good(stage, settings) else None
        point, start = replace(point, settings=settings), balance
    if closed is None or closed.point.settings.level != stage.point.settings.level:
        return stage
    return closed


def _left_out(point: OperatingPoint, balance: Lubricated) -> LeftOut:
    """What the film of ``balance`` leaves out."""
    return point.settings.level.left_out(balance.film, point.line(balance.film_load), math.inf)


def _as_good(stage: Stage, settings: Settings) -> bool:
    """Whether film and contact of the balance would be the same with ``settings``."""
    old, numerics, film = stage.point.settings, stage.point.scene.numerics, stage.balance.film
    solved_so = replace(old, balance_tolerance=settings.balance_tolerance, film_tolerance=settings.film_tolerance)
    by_load = numerics.closure == "load" and numerics.film_deflection != "total"
    return by_load and solved_so == settings and film.report.residual <= settings.film_tolerance


def needed_settings(stage: Stage, loosest: float = 0.0) -> Settings | None:
    """The settings that the balance shows to be needed: a higher film level, more cells, tighter tolerances; None if
    its own are enough. Unless a level is given by name, only levels that leave out no more than allowed are taken."""
    point, balance, settings = stage.point, stage.balance, stage.point.settings
    numerics, levels = point.scene.numerics, point.prepared.film_levels
    sensitivity = felt_share(numerics, balance)
    allowed = allowed_left_out(numerics, sensitivity)
    if given_level(levels, numerics) is None and not stage.left_out.total <= allowed:
        lowest = lowest_level(levels, point.line(balance.film_load), allowed)[0]
        level = higher(levels, settings.level, lowest)
        if level != settings.level:  # the sensitivity found without it is no guide to tolerances
            return replace(settings, level=level, film_tolerance=min(settings.film_tolerance, numerics.tolerances.film))
    film, cells = film_tolerance(numerics, sensitivity), least_cells(numerics, settings, balance)
    if loosest:  # finer grids of the contact follow: what f feels of the film is seen there
        film, cells = max(film, budget.COARSE_FILM), settings.film_cells
    volume = max(balance_tolerance(numerics, felt_gap(numerics, balance)), loosest)
    if not balance.report.converged:  # the contact may scatter by more than its balance allows
        volume = min(volume, settings.balance_tolerance)
    contact = contact_tolerance(point, balance.contact, volume)
    if contact == settings.contact_tolerance:
        fine = film >= settings.film_tolerance / budget.SLACK and cells == settings.film_cells
        closed = abs(balance.contact.volume_residual - settings.aim) <= budget.SLACK * volume
        if not balance.report.converged or closed and (fine or not settings.level.numerical):
            return None
    return replace(
        settings,
        film_tolerance=min(film, settings.film_tolerance),
        balance_tolerance=min(volume, budget.SLACK * settings.balance_tolerance),
        film_cells=cells,
        contact_tolerance=contact,
    )
