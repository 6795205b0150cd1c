"""Film and friction of a balance at another division of the load, without solving its contact again."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..contact import ContactState, RoughContact, weighted_mean
from ..sharing import Lubricated, OperatingPoint, Prepared, Settings, Start, Trial, forces

ANY = 0.1  # tolerance of a film whose grid is given


def at(prepared: Prepared, speed: float, contact: RoughContact, balance: Lubricated) -> OperatingPoint:
    """The operating point of ``balance`` on ``contact``, whose film is to be solved again on its present grid."""
    return OperatingPoint(prepared, speed, contact, Settings(balance.level, ANY, 0.0, film_cells=balance.film.cells))


def redivided(point: OperatingPoint, balance: Lubricated, contact_load: float) -> Lubricated:
    """``balance`` with ``contact_load`` [N], and with the film that carries the rest."""
    film_load = balance.contact_load + balance.film_load - contact_load
    imposed = balance.film.imposed
    given = None if imposed is None else (imposed.x, imposed.pressure)
    film = point.film(film_load, Start(balance.film), given)
    found = Trial(film=film, contact=balance.contact, film_load=film_load, contact_load=contact_load)
    friction = forces(point.scene, balance.level, found, balance.slope, balance.gap_slope)
    return replace(balance, contact_load=contact_load, film_load=film_load, film=film, forces=friction)


def grown(state: ContactState, factor: float) -> ContactState:
    """``state`` with ``factor`` times its contact area, at every x up to the whole width."""
    return replace(
        state,
        contact_fraction=np.minimum(state.contact_fraction * factor, 1.0),
        real_contact_area_fraction=min(state.real_contact_area_fraction * factor, 1.0),
    )


def quantities(point: OperatingPoint, balance: Lubricated) -> dict[str, float]:
    """The reported numbers of a balance, by the names of `FrictionResult`. ``mean_gap`` is the mean film over A, since
    the film fills the gap."""
    film, found = balance.film, balance.forces
    return {
        "coefficient": found.coefficient,
        "contact_load": balance.contact_load,
        "film_load": balance.film_load,
        "shear_force": found.shear.total,
        "couette_force": found.shear.couette,
        "rolling_force": found.shear.rolling,
        "boundary_force": found.boundary,
        "min_film": film.min_film,
        "central_film": film.central_film,
        "inlet_film_factor": found.heat.film_factor,
        "flash_temperature_rise": found.heat.flash,
        "film_temperature_rise": found.heat.film,
        "mean_gap": weighted_mean(film.film_at(point.contact.x), point.contact.weight),
    }
