"""The state at t = 0: steady, at rest with all load on the contact, or a film without pressure."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ..errors import CONVERGED, ConvergenceError, InputError
from ..sampling import friction
from .at_a_time import changes
from .film_active_set import StepSolution
from .film_setting import discretisation, parabola, steady, steady_start
from .sharing import Contact, Sharing


def first_state(sharing: Sharing) -> tuple[StepSolution, float]:
    """The state at t = 0 and the grid error of the steady film in it (NaN from another start)."""
    plan = changes(sharing.prepared.scene)
    still = sharing.setting.contact.speed.before(0.0) == 0.0
    if plan.initial_film is not None:
        return _flying(sharing, parabola(sharing.setting, plan.initial_film)), math.nan
    if plan.initial == "rest" or (plan.initial == "auto" and still):
        return _resting(sharing), math.nan
    return _steady(sharing)


def _untouched(sharing: Sharing, H: np.ndarray) -> Contact:
    state = sharing.prepared.contact.close(sharing.to_patch @ H, 0.0)
    return Contact(0.0, state, max(0.3 * state.mean_gap, 1e-12))


def _flying(sharing: Sharing, z: np.ndarray) -> StepSolution:
    """No pressure anywhere; the gap as given."""
    found = sharing.setting.at_rest(z)
    contact = _untouched(sharing, found.terms.H)
    if contact.state.volume_residual > 0.0:
        raise InputError(
            f"transient.initial_film: the surfaces touch at {contact.state.mean_film:g} m of mean film; "
            f"give a film above {contact.state.mean_gap:g} m, or initial = 'rest'"
        )
    return replace(found, payload=contact)


def _resting(sharing: Sharing) -> StepSolution:
    """The contact carries the load under the undeformed cylinder, its gap full of lubricant without pressure."""
    setting, patch = sharing.setting, sharing.prepared.contact
    radius = setting.contact.radius.before(0.0)
    state = patch.close(patch.x**2 / (2.0 * radius), sharing.total(0.0))
    z = parabola(setting, 0.0)
    flat = setting.grid.kernel @ z[:-1] + 0.5 * setting.conditions(0.0).curvature * setting.grid.x**2
    z[-1] = (state.mean_gap - sharing.mean_row @ flat) / setting.problem.film_unit
    if z[-1] <= 0.0:
        raise InputError(
            "at rest the contact leaves no room for a film under the undeformed cylinder; give "
            "initial = 'steady' with an entrainment speed, or transient.initial_film"
        )
    found = setting.at_rest(z)
    state = replace(state, mean_film=float(sharing.mean_row @ found.terms.H))
    return replace(found, payload=Contact(sharing.total(0.0), state, 0.3 * state.mean_gap))


def _steady(sharing: Sharing) -> tuple[StepSolution, float]:
    """The balance of the steady state, and then the same on the grid of the run."""
    setting, scene = sharing.setting, sharing.prepared.scene
    viscosity = changes(scene).viscosity
    c, speed = setting.contact, setting.contact.speed.before(0.0)
    if speed == 0.0:
        raise InputError("transient.initial = 'steady' needs entrainment before t = 0; give 'rest', or a speed")
    cold = scene.lubricant.viscosity if viscosity is None else viscosity.before(0.0)
    values = scene.with_(
        bodies={"load": sharing.total(0.0), "radius": c.radius.before(0.0)},
        lubricant=replace(scene.lubricant, viscosity=cold),
        numerics={"film_deflection": "hydrodynamic", "accept": True},  # judged with the other moments
    )
    point = friction(replace(sharing.prepared, scene=values), speed, fields=True)
    film = steady_start(setting, point.film_load / sharing.width)
    if film.status != CONVERGED:
        raise ConvergenceError("transient: no steady film on the grid of the run to start from")
    error = discretisation(setting, film)
    if point.balance is None or point.contact_load == 0.0:
        return replace(film, payload=_untouched(sharing, film.terms.H)), error
    contact = Contact(point.contact_load, point.balance.contact, 0.3 * point.mean_gap)
    found = sharing.solve(0.0, steady(setting.grid), film.z, contact)
    if found.status != CONVERGED:
        raise ConvergenceError("transient: film and contact of the steady start do not balance on the grid of the run")
    return found, error
