"""What a balance shows to be needed: a higher film level, more cells, tighter tolerances; within `lubfric.budget`."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from .. import budget
from ..film.contract import Film, LeftOut
from ..film.ladder import given_level, higher, lowest_level
from ..rough.contract import ContactState
from ..scene import Numerics
from ..validity.stress import meaningless
from .balance import Balance
from .forces import Forces, forces
from .operating_point import OperatingPoint, Settings


@dataclass(frozen=True)
class Stage:
    """A point, its balance, the friction of it, and what its film leaves out."""

    point: OperatingPoint
    balance: Balance
    forces: Forces
    left_out: LeftOut


def judged(point: OperatingPoint, balance: Balance) -> Stage:
    """``balance`` of ``point`` with the numbers that it is judged by."""
    film, level = balance.film, point.settings.level
    line = point.line(balance.film_load)
    return Stage(point, balance, forces(point.scene, balance), level.left_out(film, line, math.inf))


def needed_settings(stage: Stage) -> Settings | None:
    """Settings that the balance shows to be needed; None where its own will do."""
    point, balance, settings = stage.point, stage.balance, stage.point.settings
    numerics = point.scene.numerics
    sensitivity = max(stage.forces.sensitivity, 1.0 if numerics.model == "full" else 1e-12)
    film, volume = film_tolerance(numerics, sensitivity), volume_tolerance(numerics, sensitivity)
    level, allowed = settings.level, allowed_left_out(numerics, sensitivity)
    if given_level(point.model.film_levels, numerics) is None and not stage.left_out.total <= allowed:
        lowest = lowest_level(point.model.film_levels, point.line(balance.film_load), allowed)[0]
        level = higher(point.model.film_levels, level, lowest)
        if level != settings.level:  # the sensitivity found without it is no guide to tolerances
            return replace(settings, level=level, film_tolerance=min(settings.film_tolerance, numerics.film_tolerance))
    cells = least_cells(numerics, settings, stage.forces, balance.film)
    contact = contact_tolerance(point, balance.contact, volume)
    if not balance.report.converged and contact == settings.contact_tolerance:
        return None
    enough = film >= settings.film_tolerance / budget.SLACK and cells == settings.film_cells or not level.numerical
    enough = enough and contact == settings.contact_tolerance
    if enough and abs(balance.contact.volume_residual) <= budget.SLACK * volume:
        return None
    return replace(
        settings,
        film_tolerance=min(film, settings.film_tolerance),
        volume_tolerance=min(volume, budget.SLACK * settings.volume_tolerance),
        film_cells=cells,
        contact_tolerance=contact,
    )


def film_tolerance(numerics: Numerics, sensitivity: float) -> float:
    """Of a numerical film, where ``sensitivity`` of its error reaches f."""
    if numerics.ehl_tolerance is not None:
        return numerics.film_tolerance
    share = budget.FILM_GRID * numerics.tolerance / sensitivity
    return max(min(share, budget.LOOSEST_FILM), budget.TIGHTEST_FILM)


def volume_tolerance(numerics: Numerics, sensitivity: float) -> float:
    """Of the volume balance; where the film is imposed on the contact it is an error of the load itself."""
    if numerics.balance_tolerance is not None or numerics.closure != "load":
        return numerics.volume_tolerance
    share = budget.BALANCE * numerics.tolerance / sensitivity
    return max(min(share, budget.LOOSEST_VOLUME), budget.TIGHTEST_VOLUME)


def allowed_left_out(numerics: Numerics, sensitivity: float) -> float:
    """Of the film level, relative to the film."""
    return min(budget.FILM_LEVEL * numerics.tolerance / max(sensitivity, 1e-12), budget.LARGEST_LEFT_OUT)


def least_cells(numerics: Numerics, settings: Settings, found: Forces, film: Film) -> int:
    """Least number of cells of the film: twice as many where the sum of its shear stress is not good enough, unless that
    sum is one of stresses that no oil carries."""
    resolved = found.quadrature <= budget.SHEAR_SUM * numerics.tolerance or meaningless(found.shear)
    if not settings.level.numerical or numerics.ehl_tolerance is not None or resolved:
        return settings.film_cells
    return min(2 * film.cells, max(budget.MOST_CELLS, settings.film_cells))


def contact_tolerance(point: OperatingPoint, state: ContactState, volume: float) -> float | None:
    """Of the contact, in Sq, such that what the mean gap is off by stays within the ``volume`` balance: where the gap is
    a small part of Sq the contact's own is too loose."""
    own, settings, sq = point.model.contact.adjustable_tolerance, point.settings, point.model.surface.sq
    if state.fields is None or own is None or sq == 0 or point.scene.numerics.contact_tolerance is not None:
        return settings.contact_tolerance
    enough = max(volume * state.mean_gap / sq, budget.TIGHTEST_CONTACT)
    given = settings.contact_tolerance or own
    return settings.contact_tolerance if given <= budget.SLACK * enough else 0.5 * enough
