"""A scene made ready: what every speed shares."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from .deterministic.takes import check_scene
from .errors import InputError
from .film.contract import FilmLevel
from .film.ladder import LEVELS
from .rough.contract import RoughContact
from .rough.height_map import contact_map
from .rough.make import rough_contact
from .scene import Scene
from .surface import Surface
from .validate import instance
from .validity.beforehand import beforehand
from .validity.entry import Validity


@dataclass(frozen=True)
class Model:
    """A scene made ready: its height map, the rough contact on it, and the film levels to choose from, simplest first.

    known: assumptions that bodies and map do not meet.

    Made by `prepare`, accepted wherever a scene is, and safe to share: nothing in it changes.
    """

    scene: Scene
    surface: Surface
    contact: RoughContact
    film_levels: tuple[FilmLevel, ...] = LEVELS
    known: tuple[Validity, ...] = ()


def prepare(
    scene: Scene,
    surface: Surface | None = None,
    *,
    like: Model | None = None,
    contact: RoughContact | None = None,
    film_levels: Sequence[FilmLevel] = LEVELS,
) -> Model:
    """Build what does not depend on the speed: the height map and the rough contact.

    ``surface``: a height map to use as it is, grid and all, instead of the scene's own; it is taken as periodic
    along y under a cylinder, along x and y when flat (`Surface.periodic` makes it so).
    ``like``: a model of the same map, bodies' E' and hardness, whose map and operator or curve serve again, for another
    load (a curve: no heavier one), lubricant, motion or tolerance (a curve: no tighter one).
    ``contact``, ``film_levels``: others than lubfric's own (`lubfric.rough.contract`, `lubfric.film.contract`).
    """
    instance("scene", scene, Scene, "a Scene, such as lubfric.load_scene returns")
    if scene.numerics.model == "deterministic":
        check_scene(scene)
    if like is not None:
        instance("like", like, Model, "what lubfric.prepare returned")
    levels = tuple(film_levels) if like is None else like.film_levels
    _check_levels(scene, levels)
    if like is not None:
        _check_likeness(scene, like.scene, surface, contact)
        surface, contact = like.surface, like.contact.again(scene, like.scene)
    else:
        surface = contact_map(scene, surface)
        contact = rough_contact(scene, surface) if contact is None else contact
    return Model(scene, surface, contact, levels, beforehand(scene, surface))


def scene_of(scene: Scene | Model) -> Scene:
    """The scene of a model, or the scene itself; anything else is an `InputError`."""
    if isinstance(scene, Model):
        return scene.scene
    instance("scene", scene, Scene, "what lubfric.load_scene or lubfric.prepare returned")
    return scene


def at_tolerance(scene: Scene | Model, tolerance: float | None, model: str | None) -> Model:
    """``scene`` made ready, its tolerance on f and its model ("auto" or "full") replaced where given."""
    changed = {name: value for name, value in (("tolerance", tolerance), ("model", model)) if value is not None}
    asked, ready = scene_of(scene).with_(numerics=changed), scene if isinstance(scene, Model) else None
    return ready if ready is not None and asked == ready.scene else prepare(asked, like=ready)


def _check_likeness(scene: Scene, old: Scene, surface, contact) -> None:
    if surface is not None or contact is not None:
        raise InputError("like = a model brings its own surface and contact; allowed: like, or surface and contact")
    for name, a, b in (
        ("surface", scene.surface, old.surface),
        ("counterface", scene.counterface, old.counterface),
        ("contact", scene.contact, old.contact),
        ("bodies.e_prime", scene.bodies.e_prime, old.bodies.e_prime),
        ("bodies.hardness", scene.bodies.hardness, old.bodies.hardness),
    ):
        if a != b:
            raise InputError(f"{name} = {a!r} is not that of the model to be used again; allowed: {b!r}")


def _check_levels(scene: Scene, levels: Sequence[FilmLevel]) -> None:
    names = [level.name for level in levels]
    if not names:
        raise InputError("film_levels is empty; allowed: at least one level (`lubfric.film.contract.FilmLevel`)")
    if scene.numerics.film_level not in ("auto", "none", *names):
        raise InputError(
            f"numerics.film_level = {scene.numerics.film_level!r} is none of the levels of this model; allowed: "
            f"{', '.join(map(repr, names))}"
        )
