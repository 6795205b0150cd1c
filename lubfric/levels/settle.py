"""The loop that spends no more than the tolerance needs: levels, grids and inner tolerances of one operating point.

Error budget, as shares of the tolerance on f: 0.2 what the film level leaves out, 0.3 the grid of the film (0.6 where
there is no contact), 0.3 the sum of its shear stress, 0.4 the grid of the contact, 0.05 the volume balance, 0.01 the
contact solver. They are bounds that are hardly ever reached together. An error of the film reaches f by the factor
``sensitivity`` (`lubfric.levels.balance_at.Forces`): tolerances of the film are divided by it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from ..analytic.film import moes_flow_film
from ..balance import Balance
from ..flat_patch import FlatPatch
from ..patch import CylinderPatch
from .balance_at import (
    Forces,
    Settings,
    balance_at,
    carried_over,
    dry,
    film_shape,
    forces,
    moved_split,
    separated_at,
)
from .contact_grid import cut, grids, holds, in_contact
from .decision import FILM_SHARE, GRID_SHARE, Decision
from .film_error import FilmError
from .film_level import EHL, ISOVISCOUS, higher, level_error, lowest_level

LOOSEST_FILM, LOOSEST_VOLUME = 0.03, 0.02
TIGHTEST_FILM, TIGHTEST_VOLUME, TIGHTEST_CONTACT, MOST_CELLS = 2e-4, 1e-7, 1e-9, 1536
SEPARATED_SHARE, SHEAR_SHARE = 0.6, 0.3    # of the tolerance: the grid of a film without contact; the sum of its shear
LARGEST_ERROR = 0.3        # of a film to first order: beyond it the estimate is none
ROUNDS = 8                 # of one balance, each with a higher level or tighter tolerances
SLACK = 1.5                # a tolerance off by less is not worth another solve
LEAST_CONTACT = 1e-6       # of the load: less is next to separation on this grid
WORST_GRID = 2.0           # relative error of the film's load that the coarsest grid may make
SAFE_FILM = 2.0            # times Moes' film: more than any film has


@dataclass(frozen=True)
class Stage:
    """One balance, the friction of it, and the patch and settings it was found with."""

    balance: Balance
    forces: Forces
    patch: object
    settings: Settings
    film_error: FilmError


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
    return _in_contact(model, speed, start, decision, given_grid or numerics.grid == "given" or numerics.model == "full")


def _separated(model, speed, start) -> Stage:
    """The film with the whole load, at the level and on the grid that f asks for."""
    numerics, load = model.scene.numerics, model.scene.bodies.load
    level, error = numerics.forced_film_level, FilmError()
    if level == "auto":
        level, error = lowest_level(model.scene, speed, load, FILM_SHARE * numerics.tolerance)
    alone = numerics.ehl_tolerance or min(SEPARATED_SHARE * numerics.tolerance, LOOSEST_FILM)
    settings = Settings(level, alone if numerics.model == "auto" else numerics.film_tolerance, numerics.volume_tolerance)
    while True:
        balance = separated_at(model, model.patch, speed, settings, start)
        found = forces(model.scene, speed, balance)
        stage = Stage(balance, found, model.patch, settings, FilmError() if level == EHL else error)
        cells = _cells(numerics, settings, found, balance.film)
        if cells == settings.film_cells:
            return stage
        settings, start = replace(settings, film_cells=cells), balance


def _cells(numerics, settings, found: Forces, film) -> int:
    """Least number of cells of the film: twice as many where the sum of its shear stress is not good enough."""
    if settings.level != EHL or numerics.ehl_tolerance is not None or found.quadrature <= SHEAR_SHARE * numerics.tolerance:
        return settings.film_cells
    return min(2 * film.state.pressure.size, max(MOST_CELLS, settings.film_cells))


def _certainly_touching(model, patch, speed) -> bool:
    """Twice Moes' film over an undeformed cylinder, thicker than any film everywhere, would not clear the summits."""
    bodies, lubricant = model.scene.bodies, model.scene.lubricant
    film = SAFE_FILM * moes_flow_film(load_per_width=bodies.load / bodies.width, radius=bodies.radius,
                                      e_prime=bodies.e_prime, entrainment_speed=abs(speed), viscosity=lubricant.viscosity,
                                      pressure_viscosity_coefficient=lubricant.pressure_viscosity_coefficient)
    return patch.close(film + patch.x**2 / (2 * bodies.radius), 0.0).volume_residual > 0


def _in_contact(model, speed, start, decision, given_grid) -> tuple[Balance, Decision]:
    ladder = [model.patch] if given_grid else grids(model)
    limit, last = GRID_SHARE * decision.tolerance, len(ladder) - 1
    index, changes, error = 0, [], math.inf
    stage = _stage(model, ladder[0], speed, *_begin(model, speed, start))
    while index < last and error > limit:
        if stage.balance.contact_load < LEAST_CONTACT * model.scene.bodies.load:     # too coarse to hold the summits
            index += 1
            stage = _stage(model, ladder[index], speed, None, stage.settings)
            continue
        index, changes, moved = _finer(model, ladder, index, changes, stage, limit)
        if index > 0:
            stage = _stage(model, moved.patch, speed, moved.balance, moved.settings, ladder[index])
        error = _grid_error(changes, stage, limit)
    decision = replace(_described(decision, stage), contact=_contact_name(model), shape=_shape(stage.patch),
                       coarsening=_coarsening(model.patch, stage.patch))
    if index < last:
        return stage.balance, replace(decision, grid_error=error)
    if decision.tolerance < error < math.inf:
        note = f"the map is too coarse for its roughness: cells half as long would change f by about {100 * error:.1g} %"
        decision = replace(decision, notes=(*decision.notes, note))
    return stage.balance, decision


def _described(decision: Decision, stage: Stage) -> Decision:
    """``decision`` with what is known of the film of a stage."""
    notes = ()
    if stage.settings.level == EHL and stage.forces.quadrature > SHEAR_SHARE * decision.tolerance:
        notes = (f"the film's friction is not resolved (a pressure spike?): estimated error "
                 f"{100 * stage.forces.quadrature:.1g} % of f",)
    return replace(decision, film=stage.settings.level, film_error=stage.film_error, notes=notes,
                   sensitivity=stage.forces.sensitivity,
                   film_tolerance=stage.settings.film_tolerance if stage.settings.level == EHL else 0.0)


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
        level = lowest_level(model.scene, speed, start.film_load, _allowed_error(numerics, share))[0]
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
        better = _needed(model, speed, settings, balance, found, error)
        if better is None:
            break
        used, settings, begun = settings, better, balance
    else:
        settings = used
    whole.check(balance.closure)
    return Stage(balance, found, patch, settings, error)


@dataclass(frozen=True)
class Moved:
    """A patch, the balance of a coarser one moved to where this one should have its own, and the settings."""

    patch: object
    balance: Balance
    settings: Settings


def _finer(model, ladder, index, changes, stage: Stage, limit) -> tuple[int, list, Moved]:
    """Contact on finer and finer grids under the film and load of ``stage``, until the rest is within ``limit``.

    What the volume residual changes by from grid to grid, over the slope of the balance, is what the split of the
    load would: no film is solved. Returns the grid, all changes, and where its balance is to be expected.
    """
    closure, balance, total = stage.balance.closure, stage.balance, 0.0
    changes, patch = list(changes), stage.patch
    while index < len(ladder) - 1:
        index += 1
        whole = ladder[index]
        finer = cut(whole, in_contact(patch, closure.contact.pressure)) if _cut_allowed(model) else whole
        found = _closed(model, finer, balance, closure)
        if not holds(finer, whole, film_shape(model.scene, whole, balance.film), found.contact):
            finer = whole
            found = _closed(model, finer, balance, found)
        change = found.volume_residual - closure.volume_residual
        changes, total, closure, patch = [*changes, change], total + change, found, finer
        if _grid_error(changes, stage, limit) <= limit:
            break
    step = 0.0 if not balance.slope else min(max(-total / balance.slope, -1.0), 1.0)
    return index, changes, Moved(patch, moved_split(replace(balance, closure=closure), step), stage.settings)


def _closed(model, patch, balance: Balance, closure):
    """Contact on ``patch`` under the film and load of ``balance``, begun from the pressure of ``closure``."""
    film = balance.film
    start = carried_over(replace(balance, closure=closure), patch).closure.contact
    return patch.close(film.film_at(patch.x), balance.contact_load, start, film_shape(model.scene, patch, film))


def _cut_allowed(model) -> bool:
    return isinstance(model.patch, CylinderPatch) and model.scene.contact.region == "hertz"


def _allowed_error(numerics, sensitivity: float) -> float:
    """Of the film level, relative to the film."""
    return min(FILM_SHARE * numerics.tolerance / max(sensitivity, 1e-12), LARGEST_ERROR)


def _needed(model, speed, settings, balance, found: Forces, error: FilmError) -> Settings | None:
    """Settings that the balance shows to be needed; None where its own will do."""
    numerics = model.scene.numerics
    sensitivity = max(found.sensitivity, 1.0 if numerics.model == "full" else 1e-12)
    film, volume = numerics.film_tolerance, numerics.volume_tolerance
    if numerics.ehl_tolerance is None:
        film = max(min(0.3 * numerics.tolerance / sensitivity, LOOSEST_FILM), TIGHTEST_FILM)
    cells = _cells(numerics, settings, found, balance.film)
    if numerics.balance_tolerance is None and numerics.closure == "load":        # else an error of the load itself
        volume = max(min(5e-2 * numerics.tolerance / sensitivity, LOOSEST_VOLUME), TIGHTEST_VOLUME)
    level, allowed = settings.level, _allowed_error(numerics, sensitivity)
    if numerics.forced_film_level == "auto" and not error.total <= allowed:
        level = higher(level, lowest_level(model.scene, speed, balance.film_load, allowed)[0])
        if level != settings.level:                       # the sensitivity found without it is no guide to tolerances
            return replace(settings, level=level, film_tolerance=min(settings.film_tolerance, numerics.film_tolerance))
    contact = _contact_tolerance(model, settings, balance.closure, volume)
    if not balance.report.converged and level == settings.level and contact == settings.contact_tolerance:
        return None
    enough = film >= settings.film_tolerance / SLACK and cells == settings.film_cells or level != EHL
    enough = enough and contact == settings.contact_tolerance
    if level == settings.level and enough and abs(balance.closure.volume_residual) <= SLACK * volume:
        return None
    return replace(settings, level=level, film_tolerance=min(film, settings.film_tolerance),
                   volume_tolerance=min(volume, SLACK * settings.volume_tolerance), film_cells=cells,
                   contact_tolerance=contact)


def _contact_tolerance(model, settings, closure, volume: float) -> float | None:
    """Of the contact, in Sq, such that what the mean gap is off by stays within the ``volume`` balance: where the gap is
    a small part of Sq the patch's own is too loose."""
    if closure.contact is None or model.scene.numerics.contact_tolerance is not None:
        return settings.contact_tolerance
    enough = max(volume * closure.mean_gap / model.surface.sq, TIGHTEST_CONTACT)
    given = settings.contact_tolerance or model.patch.tolerance
    return settings.contact_tolerance if given <= SLACK * enough else 0.5 * enough


def _grid_error(changes: list[float], stage: Stage, limit: float) -> float:
    """Estimated relative error of f from the contact grid; infinite where nothing can be said.

    Whatever the grid does to the film's share of the load, f feels no more than ``sensitivity`` of it. Else from the
    last two changes d2, d1 of the volume residual between grids, r = d1/d2 within 1/4 (second order) and 3/4 (hardly
    converging), 1/2 where there is no d2: the rest of the geometric series d1 r/(1 - r), and no less than d2/12, as if d1 were small by chance;
    times 2 ``sensitivity``, the effect of a residual on f.
    """
    if stage.balance.contact_load == 0:
        return math.inf
    bound = WORST_GRID * stage.forces.sensitivity
    if bound <= limit:
        return bound
    if not changes:
        return math.inf
    d2, d1 = abs(changes[-2]) if len(changes) > 1 else 0.0, abs(changes[-1])
    ratio = min(max(d1 / d2, 0.25), 0.75) if d2 > 0 else 0.5
    return 2 * stage.forces.sensitivity * max(d1 * ratio / (1 - ratio), d2 / 12)


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
