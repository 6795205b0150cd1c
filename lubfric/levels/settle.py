"""The loop that spends no more than the tolerance needs: levels, grids and inner tolerances of one operating point."""

from __future__ import annotations

import math
from dataclasses import replace

from ..analytic.film import moes_flow_film
from ..balance import Balance
from ..patch.cylinder import CylinderPatch
from ..patch.flat import FlatPatch
from .balance_at import Settings, Stage, balance_at, dry, film_shape, forces, separated_at
from .contact_grid import grids, holds
from .decision import FILM_SHARE, GRID_SHARE, Decision
from .film_error import FilmError
from .film_level import EHL, ISOVISCOUS, level_error, lowest_level
from .finer_contact import finer_contact, grid_error
from .needed import LOOSEST_FILM, SHEAR_SHARE, allowed_error, least_cells, needed_settings

ROUNDS = 8  # of one balance, each with a higher level or tighter tolerances
SEPARATED_SHARE = 0.6  # of the tolerance: the grid of a film without contact
LEAST_CONTACT = 1e-6  # of the load: less is next to separation on this grid
SAFE_FILM = 2.0  # times Moes' film: more than any film has


def settle(model, speed: float, start: Balance | None = None, *, given_grid: bool = False) -> tuple[Balance, Decision]:
    """Balance of ``model`` at ``speed`` [m/s], and how far it was modelled. ``given_grid``: on the scene's own."""
    numerics = model.scene.numerics
    decision = Decision(film="none", contact="", tolerance=numerics.tolerance, forced=_forced(numerics))
    if speed == 0 or numerics.film_level == "none":
        balance = dry(model, model.patch)
        model.patch.check(balance.closure)
        return balance, replace(decision, contact=_contact_name(model), shape=_shape(model.patch))
    touching = numerics.contact_level != "none" and _certainly_touching(model, model.patch, speed)
    if not touching:
        stage = _separated(model, speed, start)
        closure = stage.balance.closure
        clearance = (closure.mean_film - closure.mean_gap) / max(model.surface.sq, 1e-12)
        if clearance >= 0 or numerics.contact_level == "none":
            return stage.balance, replace(_described(decision, stage), contact="none", clearance=clearance)
    return _in_contact(
        model, speed, start, decision, given_grid or numerics.grid == "given" or numerics.model == "full"
    )


def _separated(model, speed, start) -> Stage:
    """The film with the whole load, at the level and on the grid that f asks for."""
    numerics, load = model.scene.numerics, model.scene.bodies.load
    level, error = numerics.forced_film_level, FilmError()
    if level == "auto":
        level, error = lowest_level(model.scene, speed, load, FILM_SHARE * numerics.tolerance)
    alone = numerics.ehl_tolerance or min(SEPARATED_SHARE * numerics.tolerance, LOOSEST_FILM)
    settings = Settings(
        level, alone if numerics.model == "auto" else numerics.film_tolerance, numerics.volume_tolerance
    )
    while True:
        balance = separated_at(model, model.patch, speed, settings, start)
        found = forces(model.scene, speed, balance)
        stage = Stage(balance, found, model.patch, settings, FilmError() if level == EHL else error)
        cells = least_cells(numerics, settings, found, balance.film)
        if cells == settings.film_cells:
            return stage
        settings, start = replace(settings, film_cells=cells), balance


def _certainly_touching(model, patch, speed) -> bool:
    """Twice Moes' film over an undeformed cylinder, thicker than any film everywhere, would not clear the summits."""
    bodies, lubricant = model.scene.bodies, model.scene.lubricant
    film = SAFE_FILM * moes_flow_film(
        load_per_width=bodies.load / bodies.width,
        radius=bodies.radius,
        e_prime=bodies.e_prime,
        entrainment_speed=abs(speed),
        viscosity=lubricant.viscosity,
        pressure_viscosity_coefficient=lubricant.pressure_viscosity_coefficient,
    )
    return patch.close(film + patch.x**2 / (2 * bodies.radius), 0.0).volume_residual > 0


def _in_contact(model, speed, start, decision, given_grid) -> tuple[Balance, Decision]:
    ladder = [model.patch] if given_grid else grids(model)
    limit, last = GRID_SHARE * decision.tolerance, len(ladder) - 1
    index, changes, error = 0, [], math.inf
    stage = _stage(model, ladder[0], speed, *_begin(model, speed, start))
    while index < last and error > limit:
        if stage.balance.contact_load < LEAST_CONTACT * model.scene.bodies.load:  # too coarse to hold the summits
            index += 1
            stage = _stage(model, ladder[index], speed, None, stage.settings)
            continue
        index, changes, moved = finer_contact(model, ladder, index, changes, stage, limit)
        if index > 0:
            stage = _stage(model, moved.patch, speed, moved.balance, moved.settings, ladder[index])
        error = grid_error(changes, stage, limit)
    decision = replace(
        _described(decision, stage),
        contact=_contact_name(model),
        shape=_shape(stage.patch),
        coarsening=_coarsening(model.patch, stage.patch),
    )
    if index < last:
        return stage.balance, replace(decision, grid_error=error)
    if decision.tolerance < error < math.inf:
        note = (
            f"the map is too coarse for its roughness: cells half as long would change f by about {100 * error:.1g} %"
        )
        decision = replace(decision, notes=(*decision.notes, note))
    return stage.balance, decision


def _described(decision: Decision, stage: Stage) -> Decision:
    """``decision`` with what is known of the film of a stage."""
    notes = ()
    if stage.settings.level == EHL and stage.forces.quadrature > SHEAR_SHARE * decision.tolerance:
        notes = (
            f"the film's friction is not resolved (a pressure spike?): estimated error "
            f"{100 * stage.forces.quadrature:.1g} % of f",
        )
    return replace(
        decision,
        film=stage.settings.level,
        film_error=stage.film_error,
        notes=notes,
        sensitivity=stage.forces.sensitivity,
        film_tolerance=stage.settings.film_tolerance if stage.settings.level == EHL else 0.0,
    )


def _begin(model, speed, start: Balance | None) -> tuple[Balance | None, Settings]:
    """What to start from: a neighbouring balance and the level that its load needs; or nothing, and the rigid
    isoviscous film, which costs next to nothing and tells what is needed."""
    numerics, level = model.scene.numerics, model.scene.numerics.forced_film_level
    tolerance = LOOSEST_FILM if numerics.ehl_tolerance is None else numerics.ehl_tolerance
    settings = Settings(ISOVISCOUS if level == "auto" else level, tolerance, numerics.volume_tolerance, touching=True)
    if start is None or start.film is None or start.contact_load == 0:
        return start, settings
    if level == "auto":
        share = forces(model.scene, start.film.entrainment_speed, start).sensitivity
        level = lowest_level(model.scene, speed, start.film_load, allowed_error(numerics, share))[0]
    return start, replace(settings, level=level)


def _stage(model, patch, speed, begun: Balance | None, settings: Settings, whole=None) -> Stage:
    """The balance on ``patch`` (cut from ``whole``), with the film level and tolerances that its sensitivity asks for."""
    whole = whole or patch
    for _ in range(ROUNDS):
        balance = balance_at(model, patch, speed, settings, begun)
        if not holds(patch, whole, film_shape(model.scene, whole, balance.film), balance.closure.contact):
            patch = whole
            continue
        found = forces(model.scene, speed, balance)
        error = level_error(balance.film, model.scene, speed)
        better = needed_settings(model, speed, settings, balance, found, error)
        if better is None:
            break
        used, settings, begun = settings, better, balance
    else:
        settings = used
    whole.check(balance.closure)
    return Stage(balance, found, patch, settings, error)


def _forced(numerics) -> tuple[str, ...]:
    full = numerics.model == "full"
    return tuple(name for name in ("film_level", "contact_level", "grid") if full or getattr(numerics, name) != "auto")


def _contact_name(model) -> str:
    if isinstance(model.patch, CylinderPatch):
        return "semi-periodic"
    return "flat periodic curve" if isinstance(model.patch, FlatPatch) else f"independent {model.scene.contact.model}"


def _shape(patch) -> tuple[int, int] | None:
    return patch.heights.shape if hasattr(patch, "heights") else None


def _coarsening(whole, patch) -> tuple[int, int]:
    if not hasattr(whole, "spacing"):
        return (1, 1)
    return tuple(round(a / b) for a, b in zip(patch.spacing, whole.spacing))
