"""The begin of a run in time: its histories, its grid, and its state at t = 0, which is steady, at rest with all load
on the contact, or a film without pressure."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ..errors import CONVERGED, ConvergenceError, InputError
from ..scene import Constant, Scene
from ..sharing import Prepared, prepare, scene_of, solve_balance
from .film_setting import FINER, ContactHistory, FilmStep, discretisation, make_setting, steady_start
from .scene_now import changes, inlet_viscosity
from .sharing import Contact, Sharing, make_sharing
from .steady import strip_for

DONE = {  # what a run does of the steady options; the film is deflected by its own pressure, whatever the default says
    "model": ("auto", "load-sharing"),
    "film_deflection": ("scaled", "hydrodynamic"),
    "cavitated_shear": ("none",),
}
SOFT = 0.3  # of the mean gap: softness of the contact, until a step has measured it


def begin(scene: Scene | Prepared) -> tuple[Sharing, FilmStep, float]:
    """Check a scene with a ``transient`` and make it ready. Returns the `Sharing`, the state at t = 0, and the relative
    error by the grid of the films of a steady start (NaN for another start)."""
    base = scene_of(scene)
    plan, load = changes(base), changes(base).load or Constant(base.bodies.load)
    for name, done in DONE.items():
        value = getattr(base.numerics, name)
        if value not in done:
            raise InputError(f" = {value!r} is not for a run in time", f"numerics.{name}", ", ".join(map(repr, done)))
    if load.range(plan.duration)[1] > base.bodies.load * (1 + 1e-9):
        raise InputError(
            f"transient.load rises to {load.range(plan.duration)[1]:g} N; allowed: up to bodies.load = "
            f"{base.bodies.load:g} N, whose Hertz strip is the area A"
        )
    strip = strip_for(scene if isinstance(scene, Prepared) else prepare(scene))
    sq, contact = strip.prepared.surface.sq, _contact_history(strip.prepared.scene)
    if not sq > 0.0 and plan.initial_film is None and contact.speed.before(0.0) == 0.0:
        raise InputError(
            "smooth surfaces at rest have no film to start from; give transient.initial_film > 0 m, or "
            "an entrainment speed before t = 0"
        )
    reach = float(np.max(np.abs(strip.prepared.contact.x))) if sq > 0.0 else 0.0
    allowed = base.numerics.tolerances.film
    for finer in FINER:
        sharing = make_sharing(strip, make_setting(contact, allowed, sq=max(sq, 0.0), reach=reach, finer=finer))
        start, grid_error = _first_state(sharing)
        if not grid_error > allowed:  # NaN: no steady start to judge by
            break
    return sharing, start, grid_error


def _contact_history(scene: Scene) -> ContactHistory:
    """The line contact of a scene in time, with the scene's constants where nothing changes."""
    bodies, plan = scene.bodies, changes(scene)
    return ContactHistory(
        load=plan.load or Constant(bodies.load),
        radius=plan.radius or Constant(bodies.radius),
        e_prime=bodies.e_prime,
        speed=plan.speed or Constant(scene.motion.entrainment_speed),
        viscosity=inlet_viscosity(scene),
        lubricant=scene.lubricant,
        duration=plan.duration,
        initial_film=plan.initial_film,
        width=bodies.width,
    )


def _first_state(sharing: Sharing) -> tuple[FilmStep, float]:
    """The state at t = 0 and the grid error of the steady film in it (NaN from another start)."""
    plan = changes(sharing.scene)
    if plan.initial_film is not None:
        return _flying(sharing, plan.initial_film), math.nan
    still = sharing.setting.contact.speed.before(0.0) == 0.0
    if plan.initial == "rest" or (plan.initial == "auto" and still):
        return _resting(sharing), math.nan
    if still:
        raise InputError("transient.initial = 'steady' needs entrainment before t = 0; give 'rest', or a speed")
    return _steady(sharing)


def _untouched(sharing: Sharing, film: FilmStep) -> FilmStep:
    state = sharing.patch.close(sharing.to_patch @ film.terms.H, 0.0)
    return replace(film, payload=Contact(0.0, state, max(SOFT * state.mean_gap, 1e-12)))


def _flying(sharing: Sharing, film: float) -> FilmStep:
    """No pressure anywhere under a parabola at the height ``film`` [m]."""
    found = _untouched(sharing, sharing.setting.undeformed(film))
    state = found.payload.state
    if state.volume_residual > 0.0:
        raise InputError(
            f"transient.initial_film: the surfaces touch at {state.mean_film:g} m of mean film; "
            f"give a film above {state.mean_gap:g} m, or initial = 'rest'"
        )
    return found


def _resting(sharing: Sharing) -> FilmStep:
    """The contact carries the load under the undeformed cylinder, its gap full of lubricant without pressure."""
    setting, patch, load = sharing.setting, sharing.patch, sharing.setting.contact.load.before(0.0)
    state = patch.close(patch.x**2 / (2.0 * setting.contact.radius.before(0.0)), load)
    touching = setting.undeformed(0.0).terms.H
    film = state.mean_gap - float(sharing.mean_row @ touching)
    if film <= 0.0:
        raise InputError(
            "at rest the contact leaves no room for a film under the undeformed cylinder; give "
            "initial = 'steady' with an entrainment speed, or transient.initial_film"
        )
    found = setting.undeformed(film)
    state = replace(state, mean_film=float(sharing.mean_row @ found.terms.H))
    return replace(found, payload=Contact(load, state, SOFT * state.mean_gap))


def _steady(sharing: Sharing) -> tuple[FilmStep, float]:
    """The balance of the steady state, and then the same on the grid of the run."""
    setting, scene, c = sharing.setting, sharing.scene, sharing.setting.contact
    viscosity = changes(scene).viscosity
    cold = scene.lubricant.viscosity if viscosity is None else viscosity.before(0.0)
    values = scene.with_(
        bodies={"load": c.load.before(0.0), "radius": c.radius.before(0.0)},
        lubricant=replace(scene.lubricant, viscosity=cold),
        numerics={"film_deflection": "hydrodynamic", "accept": True},  # judged with the other moments
    )
    balance = solve_balance(values, c.speed.before(0.0), sharing.patch, sharing.strip.prepared.surface.sq)
    film = steady_start(setting, balance.film_load)
    if film.status != CONVERGED:
        raise ConvergenceError("transient: no steady film on the grid of the run to start from")
    error = discretisation(setting, film)
    if balance.contact_load == 0.0:
        return _untouched(sharing, film), error
    state = balance.contact
    found = sharing.solve(0.0, None, film.z, Contact(balance.contact_load, state, SOFT * state.mean_gap))
    if found.status != CONVERGED:
        raise ConvergenceError("transient: film and contact of the steady start do not balance on the grid of the run")
    return found, error
