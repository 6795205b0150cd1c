"""Tolerances of film, volume balance and contact, from how strongly f depends on their errors (`scene.budget`)."""

from __future__ import annotations

import math

from ..contact import ContactState
from ..scene import Numerics, budget
from .balance import Balance, Lubricated
from .operating_point import OperatingPoint, Settings
from .validity_solution import meaningless


def felt_share(numerics: Numerics, balance: Balance) -> float:
    """Share of a film's error that f feels. It is 1 where nothing is to be left out, or where contact just begins."""
    if balance.contact_load == 0:
        return 1.0
    return max(balance.forces.sensitivity, 1.0 if numerics.model == "full" else 1e-12)


def felt_gap(numerics: Numerics, balance: Balance) -> float:
    """Share of an error of the contact's mean gap that f feels, as in `felt_share`.

    The load of a light contact depends exponentially on its gap. So the share is found from the error that changes f by
    its share of the tolerance, by ``sensitivity`` times ``|slope| (exp(d) - 1)``, where d is the change of ln(F_H/F_C).
    """
    if balance.contact_load == 0 or numerics.model == "full":
        return felt_share(numerics, balance)
    sensitivity = max(balance.gap_sensitivity, 1e-12)
    if not balance.slope:
        return sensitivity
    first_order = budget.BALANCE * numerics.tolerance / (sensitivity * abs(balance.slope))
    return sensitivity * first_order / math.log1p(first_order)


def film_tolerance(numerics: Numerics, sensitivity: float) -> float:
    """Tolerance of a numerical film. f feels the share ``sensitivity`` of the film's error."""
    if numerics.film_tolerance is not None:
        return numerics.tolerances.film
    share = budget.FILM_GRID * numerics.tolerance / sensitivity
    return max(min(share, budget.LOOSEST_FILM), budget.TIGHTEST_FILM)


def film_alone_tolerance(numerics: Numerics) -> float:
    """Tolerance of a numerical film without contact."""
    if numerics.model == "full":
        return numerics.tolerances.film
    return numerics.film_tolerance or min(budget.FILM_GRID_ALONE * numerics.tolerance, budget.LOOSEST_FILM)


def first_film_tolerance(numerics: Numerics) -> float:
    """Tolerance of the first film, which serves to find out what is needed."""
    return budget.LOOSEST_FILM if numerics.film_tolerance is None else numerics.film_tolerance


def balance_tolerance(numerics: Numerics, sensitivity: float) -> float:
    """Tolerance of the volume balance. f feels the share ``sensitivity`` of its error. Where the film is imposed on the
    contact, the error is one of the load itself."""
    if numerics.balance_tolerance is not None or numerics.closure != "load":
        return numerics.tolerances.balance
    share = budget.BALANCE * numerics.tolerance / sensitivity
    return max(min(share, budget.LOOSEST_VOLUME), budget.TIGHTEST_VOLUME)


def allowed_left_out(numerics: Numerics, sensitivity: float) -> float:
    """What the film level may leave out, relative to the film."""
    return min(budget.FILM_LEVEL * numerics.tolerance / max(sensitivity, 1e-12), budget.LARGEST_LEFT_OUT)


def least_cells(numerics: Numerics, settings: Settings, balance: Lubricated) -> int:
    """Least number of cells of the film: twice its present number where the sum of its shear stress is not exact
    enough. It stays where that sum is of stresses that no oil carries."""
    found = balance.forces
    resolved = found.quadrature <= budget.SHEAR_SUM * numerics.tolerance or meaningless(found.shear)
    if not settings.level.numerical or numerics.film_tolerance is not None or resolved:
        return settings.film_cells
    return min(2 * balance.film.cells, max(budget.MOST_CELLS, settings.film_cells))


def contact_tolerance(point: OperatingPoint, state: ContactState, volume: float) -> float | None:
    """Tolerance of the contact, in Sq, such that the error of the mean gap stays within the ``volume`` balance. It is
    tighter than the contact's own where the gap is a small part of Sq."""
    own, given, sq = (
        point.prepared.contact.adjustable_tolerance,
        point.settings.contact_tolerance,
        point.prepared.surface.sq,
    )
    if state.fields is None or own is None or sq == 0 or point.scene.numerics.contact_tolerance is not None:
        return given
    enough = max(volume * state.mean_gap / sq, budget.TIGHTEST_CONTACT)
    return given if (given or own) <= budget.SLACK * enough else 0.5 * enough
