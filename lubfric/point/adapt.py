"""The loop that spends no more than the tolerance needs: levels, grids and inner tolerances of one operating point."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from .. import budget
from ..film.contract import FilmLevel, LeftOut
from ..film.ladder import given_level, lowest_level
from ..line_contact import LineContact
from ..model import Model
from ..rough.contract import RoughContact
from ..rough.half_space_grid import coarser_grids
from .balance import Balance, balanced, dry, separated
from .decision import Decision
from .forces import Forces, forces
from .operating_point import OperatingPoint, Settings, pressed_under
from .refine import grid_error, refined
from .tolerances import Stage, allowed_left_out, judged, least_cells, needed_settings

ROUNDS = 8  # of one balance, each with a higher level or tighter tolerances
LEAST_CONTACT = 1e-6  # of the load: less is next to separation on this grid
SAFE_FILM = 2.0  # times Moes' film: more than any film has


@dataclass(frozen=True)
class Solved:
    """A balance, its forces, and how far it was modelled."""

    balance: Balance
    forces: Forces
    decision: Decision


def solved(model: Model, speed: float, start: Balance | None = None, *, given_grid: bool = False) -> Solved:
    """``model`` at ``speed`` [m/s], modelled no further than the tolerance on f needs.

    First the film of the whole load: where it clears the summits, no contact is solved. Else film and contact on the
    coarsest grid, then on finer ones until what is left is within its share. ``given_grid``: on the scene's own.
    """
    numerics = model.scene.numerics
    if speed == 0 or numerics.film_level == "none":
        return _dry(model)
    if numerics.contact_level == "none" or not _certainly_touching(model, speed):
        stage = _separated(model, speed, start)
        state = stage.balance.contact
        clearance = (state.mean_film - state.mean_gap) / max(model.surface.sq, 1e-12)
        if clearance >= 0 or numerics.contact_level == "none":
            return Solved(stage.balance, stage.forces, replace(_decision(stage), contact="none", clearance=clearance))
    own = given_grid or numerics.grid == "given" or numerics.model == "full"
    grids = [model.contact] if own else coarser_grids(model.contact, model.surface.sq)
    point = OperatingPoint(model, speed, grids[0], _first_settings(model, speed, start))
    stage, reached, error = _in_contact(point, grids, start)
    decision = _decision_in_contact(stage, error, finest=reached is grids[-1])
    return Solved(stage.balance, stage.forces, decision)


def _dry(model: Model) -> Solved:
    balance = dry(model)
    model.contact.check(balance.contact)
    numerics, grid = model.scene.numerics, model.contact.grid
    decision = Decision(
        film="none",
        contact=model.contact.name,
        tolerance=numerics.tolerance,
        forced=_forced(numerics),
        shape=None if grid is None else grid.cells,
    )
    return Solved(balance, forces(model.scene, balance), decision)


def _certainly_touching(model: Model, speed: float) -> bool:
    """Twice Moes' film over an undeformed cylinder, thicker than any film everywhere, would not clear the summits."""
    bodies, x = model.scene.bodies, model.contact.x
    line = LineContact(bodies.load / bodies.width, bodies.radius, bodies.e_prime, speed, model.scene.lubricant)
    film = SAFE_FILM * line.moes_film
    return model.contact.close(film + x**2 / (2 * bodies.radius), 0.0).volume_residual > 0


def _separated(model: Model, speed: float, start: Balance | None) -> Stage:
    """The film with the whole load, at the level and on the grid that f asks for."""
    numerics, load = model.scene.numerics, model.scene.bodies.load
    tolerance = numerics.film_tolerance
    if numerics.model == "auto":
        tolerance = numerics.ehl_tolerance or min(budget.FILM_GRID_ALONE * numerics.tolerance, budget.LOOSEST_FILM)
    settings = Settings(model.film_levels[0], tolerance, numerics.volume_tolerance)
    point = OperatingPoint(model, speed, model.contact, settings)
    level, left_out = _level(point, load, budget.FILM_LEVEL * numerics.tolerance)
    point, film = replace(point, settings=replace(settings, level=level)), start.film if start else None
    while True:
        balance = separated(point, film)
        stage = Stage(point, balance, forces(model.scene, balance), left_out)
        cells = least_cells(numerics, point.settings, stage.forces, balance.film)
        if cells == point.settings.film_cells:
            return stage
        point, film = replace(point, settings=replace(point.settings, film_cells=cells)), balance.film


def _level(point: OperatingPoint, film_load: float, allowed: float) -> tuple[FilmLevel, LeftOut]:
    """The level given, or the lowest that leaves out no more than ``allowed`` at ``film_load`` [N], and what that is."""
    levels = point.model.film_levels
    given = given_level(levels, point.scene.numerics)
    level, left_out = (given, LeftOut()) if given else lowest_level(levels, point.line(film_load), allowed)
    return level, left_out if left_out.total <= allowed else LeftOut()


def _first_settings(model: Model, speed: float, start: Balance | None) -> Settings:
    """The level that a neighbour's film load needs; without one the simplest, which costs next to nothing and tells what
    is needed."""
    numerics = model.scene.numerics
    tolerance = budget.LOOSEST_FILM if numerics.ehl_tolerance is None else numerics.ehl_tolerance
    level = given_level(model.film_levels, numerics) or model.film_levels[0]
    settings = Settings(level, tolerance, numerics.volume_tolerance, touching=True)
    if start is None or start.film is None or start.contact_load == 0:
        return settings
    point = OperatingPoint(model, speed, model.contact, settings)
    allowed = allowed_left_out(numerics, forces(model.scene, start).sensitivity)
    return replace(settings, level=_level(point, start.film_load, allowed)[0])


def _in_contact(
    point: OperatingPoint, grids: list[RoughContact], start: Balance | None
) -> tuple[Stage, RoughContact, float]:
    """The balance on the first of ``grids`` whose estimated error of f is within its share, the grid, and that error
    (infinite: unknown)."""
    numerics, load = point.scene.numerics, point.scene.bodies.load
    limit, last = budget.CONTACT_GRID * numerics.tolerance, len(grids) - 1
    index, changes, error = 0, (), math.inf
    stage = _settled(point, grids[0], start)
    while index < last and error > limit:
        if stage.balance.contact_load < LEAST_CONTACT * load:  # too coarse to hold the summits
            index += 1
            stage = _settled(replace(stage.point, contact=grids[index]), grids[index], None)
            continue
        finer = refined(grids, index, changes, stage, limit)
        index, changes = finer.index, finer.changes
        stage = _settled(finer.point, grids[index], finer.balance)
        error = grid_error(changes, stage, limit)
    return stage, grids[index], error


def _settled(point: OperatingPoint, whole: RoughContact, start: Balance | None) -> Stage:
    """The balance on the point's contact, a part of ``whole``, with the film level and tolerances that its sensitivity
    asks for; on all of it where the part is not enough."""
    for _ in range(ROUNDS):
        balance = balanced(point, start)
        if not _holds(point, whole, balance):
            point = replace(point, contact=whole)
            continue
        stage = judged(point, balance)
        settings = needed_settings(stage)
        if settings is None:
            break
        point, start = replace(point, settings=settings), balance
    whole.check(stage.balance.contact)
    return stage


def _holds(point: OperatingPoint, whole: RoughContact, balance: Balance) -> bool:
    if point.contact is whole:
        return True
    return whole.holds(point.contact, pressed_under(point.scene, balance.film, whole.x), balance.contact)


def _decision(stage: Stage) -> Decision:
    """What is known of the film of ``stage``."""
    numerics, settings, notes = stage.point.scene.numerics, stage.point.settings, ()
    if settings.level.numerical and stage.forces.quadrature > budget.SHEAR_SUM * numerics.tolerance:
        notes = (
            f"the film's friction is not resolved (a pressure spike?): estimated error "
            f"{100 * stage.forces.quadrature:.1g} % of f",
        )
    return Decision(
        film=settings.level.name,
        contact="",
        tolerance=numerics.tolerance,
        film_words=settings.level.words,
        left_out=stage.left_out,
        sensitivity=stage.forces.sensitivity,
        film_tolerance=settings.film_tolerance if settings.level.numerical else 0.0,
        heat=stage.forces.heat.text(numerics.tolerance),
        forced=_forced(numerics),
        notes=notes,
    )


def _decision_in_contact(stage: Stage, error: float, *, finest: bool) -> Decision:
    """The same with the contact and its grid, of estimated error ``error``; ``finest``: on the map's own."""
    decision, model = _decision(stage), stage.point.model
    grid, own = stage.point.contact.grid, model.contact.grid
    decision = replace(decision, contact=model.contact.name, grid_error=None if finest else error)
    if grid is not None and own is not None:
        dx, dy = (round(a / b) for a, b in zip(grid.spacing, own.spacing))
        decision = replace(decision, shape=grid.cells, coarsening=(dx, dy))
    if finest and decision.tolerance < error < math.inf:
        note = (
            f"the map is too coarse for its roughness: cells half as long would change f by about {100 * error:.1g} %"
        )
        decision = replace(decision, notes=(*decision.notes, note))
    return decision


def _forced(numerics) -> tuple[str, ...]:
    full = numerics.model == "full"
    return tuple(name for name in ("film_level", "contact_level", "grid") if full or getattr(numerics, name) != "auto")
