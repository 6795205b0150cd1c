"""What a balance shows to be needed: a higher film level, more cells, tighter tolerances.

Error budget, as shares of the tolerance on f: 0.2 what the film level leaves out, 0.3 the grid of the film (0.6 where
there is no contact), 0.3 the sum of its shear stress, 0.4 the grid of the contact, 0.05 the volume balance, 0.01 the
contact solver. They are bounds that are hardly ever reached together. An error of the film reaches f by the factor
``sensitivity`` (`lubfric.levels.balance_at.Forces`): tolerances of the film are divided by it.
"""

from __future__ import annotations

from dataclasses import replace

from ..patch.cylinder import CylinderPatch
from .balance_at import Forces, Settings
from .decision import FILM_SHARE
from .film_error import FilmError
from .film_level import EHL, higher, lowest_level

LOOSEST_FILM, LOOSEST_VOLUME = 0.03, 0.02
TIGHTEST_FILM, TIGHTEST_VOLUME, TIGHTEST_CONTACT, MOST_CELLS = 2e-4, 1e-7, 1e-9, 1536
SHEAR_SHARE = 0.3  # of the tolerance: the sum of the shear stress
LARGEST_ERROR = 0.3  # of a film to first order: beyond it the estimate is none
SLACK = 1.5  # a tolerance off by less is not worth another solve


def needed_settings(model, speed, settings, balance, found: Forces, error: FilmError) -> Settings | None:
    """Settings that the balance shows to be needed; None where its own will do."""
    numerics = model.scene.numerics
    sensitivity = max(found.sensitivity, 1.0 if numerics.model == "full" else 1e-12)
    film, volume = numerics.film_tolerance, numerics.volume_tolerance
    if numerics.ehl_tolerance is None:
        film = max(min(0.3 * numerics.tolerance / sensitivity, LOOSEST_FILM), TIGHTEST_FILM)
    cells = least_cells(numerics, settings, found, balance.film)
    if numerics.balance_tolerance is None and numerics.closure == "load":  # else an error of the load itself
        volume = max(min(5e-2 * numerics.tolerance / sensitivity, LOOSEST_VOLUME), TIGHTEST_VOLUME)
    level, allowed = settings.level, allowed_error(numerics, sensitivity)
    if numerics.forced_film_level == "auto" and not error.total <= allowed:
        level = higher(level, lowest_level(model.scene, speed, balance.film_load, allowed)[0])
        if level != settings.level:  # the sensitivity found without it is no guide to tolerances
            return replace(settings, level=level, film_tolerance=min(settings.film_tolerance, numerics.film_tolerance))
    contact = _contact_tolerance(model, settings, balance.closure, volume)
    if not balance.report.converged and level == settings.level and contact == settings.contact_tolerance:
        return None
    enough = film >= settings.film_tolerance / SLACK and cells == settings.film_cells or level != EHL
    enough = enough and contact == settings.contact_tolerance
    if level == settings.level and enough and abs(balance.closure.volume_residual) <= SLACK * volume:
        return None
    return replace(
        settings,
        level=level,
        film_tolerance=min(film, settings.film_tolerance),
        volume_tolerance=min(volume, SLACK * settings.volume_tolerance),
        film_cells=cells,
        contact_tolerance=contact,
    )


def allowed_error(numerics, sensitivity: float) -> float:
    """Of the film level, relative to the film."""
    return min(FILM_SHARE * numerics.tolerance / max(sensitivity, 1e-12), LARGEST_ERROR)


def least_cells(numerics, settings, found: Forces, film) -> int:
    """Least number of cells of the film: twice as many where the sum of its shear stress is not good enough."""
    if (
        settings.level != EHL
        or numerics.ehl_tolerance is not None
        or found.quadrature <= SHEAR_SHARE * numerics.tolerance
    ):
        return settings.film_cells
    return min(2 * film.state.pressure.size, max(MOST_CELLS, settings.film_cells))


def _contact_tolerance(model, settings, closure, volume: float) -> float | None:
    """Of the contact, in Sq, such that what the mean gap is off by stays within the ``volume`` balance: where the gap is
    a small part of Sq the patch's own is too loose."""
    unknown = closure.contact is None or not isinstance(model.patch, CylinderPatch) or model.surface.sq == 0
    if unknown or model.scene.numerics.contact_tolerance is not None:
        return settings.contact_tolerance
    enough = max(volume * closure.mean_gap / model.surface.sq, TIGHTEST_CONTACT)
    given = settings.contact_tolerance or model.patch.tolerance
    return settings.contact_tolerance if given <= SLACK * enough else 0.5 * enough
