"""A scene made ready: all that its speeds share."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from .._base import Shown, instance
from ..contact import RoughContact, check_grid, contact_map, rough_contact
from ..errors import InputError
from ..film import LEVELS, FilmLevel
from ..scene import Scene, check_resolved_gap, resolves_gap, told_doubts
from ..surface import Surface
from .lines_cells import Cells
from .lines_contract import Lines
from .lines_make import lines_of, pilot, takes_line
from .validity import Validity
from .validity_beforehand import beforehand


@dataclass(frozen=True, repr=False)
class Prepared(Shown):
    """A scene made ready by `prepare`. It is accepted wherever a scene is, and safe to share: nothing in it changes.

    Attributes
    ----------
    scene : the scene
    surface : its height map
    contact : the rough contact on it
    film_levels : the film levels to choose from, the simplest first
    known : assumptions of the model that bodies and map violate
    lines : makes further lines, if ``surface`` is a line of the scene's roughness; else None
    given : True: the map was given to `prepare`, and there is no more of it
    """

    scene: Scene
    surface: Surface
    contact: RoughContact
    film_levels: tuple[FilmLevel, ...] = LEVELS
    known: tuple[Validity, ...] = ()
    lines: Lines | None = None
    given: bool = False

    def _facts(self) -> dict[str, str]:
        return {"": self.scene.name, "map": self.surface.describe()}


def prepare(
    scene: Scene,
    surface: Surface | None = None,
    *,
    like: Prepared | None = None,
    contact: RoughContact | None = None,
    film_levels: Sequence[FilmLevel] = LEVELS,
) -> Prepared:
    """Make a scene ready: build its height map and its rough contact, which all speeds share.

    Parameters
    ----------
    scene : from `lubfric.load_scene`
    surface : a height map to use as it is, with its grid, instead of the scene's own. Under a cylinder it is taken as
        periodic along y, for a flat contact along x and y (`Surface.periodic` makes it so). Without one, a scene with
        ``numerics.sampling = "line"`` gets a long line of its roughness (docs/uncertainty.md)
    like : another prepared scene with the same map, E' and hardness. Its map, and its operator or contact curve, are
        used again for another load, lubricant, motion or tolerance. A curve suits no heavier load and no tighter
        tolerance
    contact : a rough contact other than lubfric's own (`lubfric.contact.rough_contract`)
    film_levels : films other than lubfric's own, the simplest first (`lubfric.film.contract`)

    Returns
    -------
    Prepared : accepted wherever a scene is

    Raises
    ------
    InputError : the map does not fit the scene, or ``like`` does not
    """
    instance("scene", scene, Scene, "a Scene, such as lubfric.load_scene returns")
    if resolves_gap(scene):
        check_resolved_gap(scene)
    if like is not None:
        instance("like", like, Prepared, "what lubfric.prepare returned")
    levels = _levels(film_levels) if like is None else like.film_levels
    _check_levels(scene, levels)
    if like is not None:
        _check_likeness(scene, like.scene, surface, contact)
        return _another(scene, like)
    given = surface is not None or contact is not None
    with told_doubts(scene):
        if not given and takes_line(scene):
            return _on_a_line(scene, levels)
        surface = contact_map(scene, surface)
        contact = rough_contact(scene, surface) if contact is None else contact
        return Prepared(scene, surface, contact, levels, beforehand(scene, surface), given=given)


def _another(scene: Scene, like: Prepared) -> Prepared:
    """Make ``scene`` ready on the map of ``like``. Its lines are used too, unless the scene asks for another sampling
    or other cells."""
    lines = None
    if not like.given and (like.lines is not None or takes_line(scene)):
        lines = like.lines.again(scene) if like.lines is not None and takes_line(scene) else None
        if lines is None:
            return prepare(scene, film_levels=like.film_levels)
    contact = like.contact.again(scene, like.scene)
    return replace(like, scene=scene, contact=contact, known=beforehand(scene, like.surface), lines=lines)


def _on_a_line(scene: Scene, levels: tuple[FilmLevel, ...]) -> Prepared:
    lines = lines_of(scene)
    surface, contact = pilot(scene, lines)
    check_grid(scene, surface)
    return Prepared(scene, surface, contact, levels, beforehand(scene, surface), lines)


def on_halved_cells(prepared: Prepared) -> Prepared:
    """``prepared`` with lines on cells half as long, no shorter than the scene's own."""
    if prepared.lines is None:
        raise ValueError("a model of one patch has no lines")
    lines = prepared.lines.halved()
    surface, contact = pilot(prepared.scene, lines)
    return replace(prepared, surface=surface, contact=contact, lines=lines)


class OnCells(Protocol):
    """What was solved on lines: their ``cells``."""

    @property
    def cells(self) -> Cells: ...


def on_cells_of(prepared: Prepared, line: OnCells | None) -> Prepared:
    """``prepared`` with lines on the cells of a point's ``line``, which may be halved; itself on one patch (None)."""
    while line and prepared.lines and any(a > b for a, b in zip(prepared.lines.cells.factors, line.cells.factors)):
        prepared = on_halved_cells(prepared)
    return prepared


def scene_of(scene: Scene | Prepared) -> Scene:
    """The scene that was prepared, or the scene itself; anything else is an `InputError`."""
    if isinstance(scene, Prepared):
        return scene.scene
    instance("scene", scene, Scene, "what lubfric.load_scene or lubfric.prepare returned")
    return scene


def at_tolerance(scene: Scene | Prepared, tolerance: float | None, model: str | None) -> Prepared:
    """``scene`` made ready, with another tolerance on f and another model ("auto", "full", "deterministic") if they are
    given."""
    changed = {name: value for name, value in (("tolerance", tolerance), ("model", model)) if value is not None}
    if not changed and isinstance(scene, Prepared):
        return scene
    asked, ready = scene_of(scene).with_(numerics=changed), scene if isinstance(scene, Prepared) else None
    return ready if ready is not None and asked == ready.scene else prepare(asked, like=ready)


def _check_likeness(scene: Scene, old: Scene, surface, contact) -> None:
    if surface is not None or contact is not None:
        raise InputError("like brings its own surface and contact; give like, or surface and contact, not both")
    for name, a, b in (
        ("surface", scene.surface, old.surface),
        ("counterface", scene.counterface, old.counterface),
        ("contact", scene.contact, old.contact),
        ("bodies.e_prime", scene.bodies.e_prime, old.bodies.e_prime),
        ("bodies.hardness", scene.bodies.hardness, old.bodies.hardness),
    ):
        if a != b:
            raise InputError(f"{name} = {a!r} is not that of the prepared scene to be used again; allowed: {b!r}")


def _levels(given) -> tuple[FilmLevel, ...]:
    levels = given if isinstance(given, (list, tuple)) else [given]
    for i, level in enumerate(levels):
        instance(f"film_levels[{i}]", level, FilmLevel, "an object of a class that inherits from it")
    return tuple(levels)


def _check_levels(scene: Scene, levels: Sequence[FilmLevel]) -> None:
    names = [level.name for level in levels]
    if not names:
        raise InputError("film_levels is empty; give at least one level (`lubfric.film.contract.FilmLevel`)")
    if scene.numerics.film_level not in ("auto", "none", *names):
        raise InputError(
            f"numerics.film_level = {scene.numerics.film_level!r} is none of the levels there are; allowed: "
            f"{', '.join(map(repr, names))}"
        )
