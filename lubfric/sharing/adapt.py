"""One operating point, modelled no further than the tolerance on f needs (docs/levels.md)."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ..contact import RoughContact
from ..errors import CONVERGED, ConvergenceError, Report
from ..film import Film, given_level, level_for
from .balance import Balance, drift, separated
from .decision import Decision, alone, dry, in_contact
from .forces import dry_forces
from .grids import coarser_grids, on_enough_cells
from .one_grid import Stage
from .operating_point import OperatingPoint, Settings
from .prepared import Prepared
from .tolerances import (
    allowed_left_out,
    felt_share,
    film_alone_tolerance,
    film_tolerance,
    first_film_tolerance,
    least_cells,
)

SAFE_FILM = 2.0  # times Moes' film: more than any film has
LIGHTLY = 0.3  # volume residual of a film with the whole load, up to which the contact carries little
LEFT_OUT = "the film is left out (numerics.film_level = 'none'): all contact"


@dataclass(frozen=True)
class Solved:
    """A balance, how far it was modelled, and the contact on which it was found: the scene's own contact, one on
    coarser cells, or a part of one."""

    balance: Balance
    decision: Decision
    contact: RoughContact


def solved(prepared: Prepared, speed: float, start: Balance | None = None, *, given_grid: bool = False) -> Solved:
    """Solve ``prepared`` at ``speed`` [m/s] with no more film, contact and cells than f needs.

    The film of the whole load is solved first. If it clears the summits, no contact is solved. Otherwise film and
    contact are solved on the coarsest grid, and then on finer ones until the estimated error is within its share.
    ``given_grid``: solve on the scene's own grid only.
    """
    numerics = prepared.scene.numerics
    if speed == 0 or numerics.film_level == "none":
        return _dry(prepared, speed)
    if numerics.contact_level == "none":
        return _film_alone(prepared, speed, start)
    notes: tuple[str, ...] = ()
    alone: Film | None = None
    if not _certainly_touching(prepared, speed):
        try:
            found = _film_alone(prepared, speed, start)
        except ConvergenceError as error:  # then a balance in contact, one of a kind, is what excludes separation
            notes = (f"the film of the whole load was not solved ({error})",)
        else:
            if found.decision.clearance is not None and found.decision.clearance >= 0:
                return found
            alone = found.balance.film
            if start is None or start.contact_load == 0:
                start = _first_touch(found.balance) or start
    found = _in_contact(prepared, speed, start, given_grid, alone)
    return replace(found, decision=replace(found.decision, notes=(*notes, *found.decision.notes)))


def _dry(prepared: Prepared, speed: float) -> Solved:
    """The point without film: the contact carries the whole load under the undeformed cylinder. At a ``speed`` other
    than 0 the film is left out."""
    scene, contact = prepared.scene, prepared.contact
    state = contact.close(contact.x**2 / (2 * scene.bodies.radius), scene.bodies.load)
    report = Report(
        "load sharing",
        CONVERGED,
        0,
        0.0,
        scene.numerics.tolerances.balance,
        residuals={"volume": 0.0, "load": 0.0},
        notes=("no entrainment: all contact" if speed == 0 else LEFT_OUT,),
    )
    balance = Balance(0.0, scene.bodies.load, None, state, report, dry_forces(scene), None)
    return Solved(balance, dry(prepared, speed), contact)


def _certainly_touching(prepared: Prepared, speed: float) -> bool:
    """Whether the summits touch for sure: they would even reach through twice Moes' film over an undeformed cylinder,
    which is thicker than any film."""
    x, radius = prepared.contact.x, prepared.scene.bodies.radius
    film = SAFE_FILM * prepared.scene.line_contact(speed).moes_film
    return prepared.contact.close(film + x**2 / (2 * radius), 0.0).volume_residual > 0


def _first_touch(alone: Balance) -> Balance | None:
    """A start for the contact from ``alone``, the film of the whole load, if it nearly clears the summits: then the
    film in contact carries nearly the same load and needs the same settings."""
    return alone if alone.contact.volume_residual < LIGHTLY else None


def _film_alone(prepared: Prepared, speed: float, start: Balance | None) -> Solved:
    """The film under the whole load, at the level and on the cells that the tolerance on f needs."""
    numerics, load = prepared.scene.numerics, prepared.scene.bodies.load
    settings = Settings(prepared.film_levels[0], film_alone_tolerance(numerics), numerics.tolerances.balance)
    point = OperatingPoint(prepared, speed, prepared.contact, settings)
    allowed = allowed_left_out(numerics, 1.0)
    level, left_out = level_for(prepared.film_levels, numerics, point.line(load), allowed)
    point, film = replace(point, settings=replace(settings, level=level)), start.film if start else None
    while True:
        balance = separated(point, film)
        cells = least_cells(numerics, point.settings, balance)
        if cells == point.settings.film_cells:
            break
        point, film = replace(point, settings=replace(point.settings, film_cells=cells)), balance.film
    return Solved(balance, alone(Stage(point, balance, left_out)), prepared.contact)


def _in_contact(
    prepared: Prepared, speed: float, start: Balance | None, given_grid: bool, alone: Film | None
) -> Solved:
    """Film and contact. The first solve has the level and tolerances of a neighbour or, without one, the simplest ones,
    which cost next to nothing and tell what is needed. ``alone``: the film of the whole load, where it is known."""
    numerics = prepared.scene.numerics
    level = given_level(prepared.film_levels, numerics) or prepared.film_levels[0]
    settings = Settings(level, first_film_tolerance(numerics), numerics.tolerances.balance)
    point = OperatingPoint(prepared, speed, prepared.contact, settings, alone)
    if start is not None and start.film is not None and (start.contact_load > 0 or start.contact.volume_residual > 0):
        share = felt_share(numerics, start)
        allowed, line = allowed_left_out(numerics, share), point.line(start.film_load)
        level, _ = level_for(prepared.film_levels, numerics, line, allowed)
        settings = replace(settings, level=level, film_tolerance=film_tolerance(numerics, share))
        point = replace(point, settings=settings)
    own = given_grid or numerics.grid == "given" or numerics.model == "full"
    grids = [prepared.contact] if own else coarser_grids(prepared.contact, prepared.surface.sq)
    stage, index, error = on_enough_cells(point, grids, start)
    decision = in_contact(stage, error, finest=index == len(grids) - 1)
    balance = stage.balance if start is None else replace(stage.balance, drift=drift(stage.point, start, stage.balance))
    return Solved(balance, decision, stage.point.contact)
