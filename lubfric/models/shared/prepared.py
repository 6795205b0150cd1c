"""A scene made ready: all that its speeds share."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from ..._base import FieldsOnly, Shown, validate, with_default_errors
from ...contact import (
    BOUNDARY,
    AsperityContact,
    FlatContact,
    HalfSpaceContact,
    RoughContact,
    half_space,
)
from ...errors import InputError
from ...samples import (
    Strips,
    flat_contact_of,
    half_space_contact_of,
    independent_asperities_of,
    sample_of,
    together,
)
from ...samples import check_grid as check_map
from ...scene import Bodies, Scene, check_resolved_gap, told_doubts
from ...surface import Surface
from .checks_before import beforehand
from .validity import Validity

OWN = HalfSpaceContact, FlatContact, AsperityContact
# strips, pieces, operators and reference points; cells of all but the last
REMEMBERED = 64
MOST_CELLS = 8_000_000


@dataclass(frozen=True, repr=False)
class Prepared(FieldsOnly, Shown):
    """A scene made ready by `prepare`. It is accepted wherever a scene is, and safe to share: nothing in it changes.

    Attributes
    ----------
    scene : the scene
    surface : the height map that is solved first
    contact : the rough contact on it
    known : assumptions of the model that bodies and map violate
    strips : the sample of the surface; None for a contact that has no cells under a cylinder
    given : True: the map was given to `prepare`, and there is no more of it
    """

    scene: Scene
    surface: Surface
    contact: RoughContact
    known: tuple[Validity, ...] = ()
    strips: Strips | None = None
    given: bool = False

    @property
    def own(self) -> bool:
        """Whether the rough contact is one of lubfric's own."""
        return isinstance(self.contact, OWN)

    @property
    def joint(self) -> bool:
        """Whether one map was given for all bodies, and nobody knows what of it is whose."""
        return self.given and not (self.strips and self.strips.bodies)

    @cached_property
    def memo(self) -> dict[Any, Any]:
        """What was `remembered`; neither compared nor pickled."""
        return {}

    def remembered(self, key: Any, make: Callable[[], Any], cells: Callable[[Any], int] = lambda made: 0) -> Any:
        """What ``make`` gives, made once for ``key`` and kept as long as there is room for it and its ``cells``. It
        depends on scene and key alone, so that results do not depend on what is kept."""
        try:
            return self.memo[key][0]
        except KeyError:
            made = make()
        self.memo[key] = made, cells(made)
        kept = list(self.memo.items())
        while len(kept) > REMEMBERED or sum(size for _, (_, size) in kept[:-1]) > MOST_CELLS:
            self.memo.pop(kept.pop(0)[0], None)
        return made

    def _facts(self) -> dict[str, str]:
        return {"": self.scene.name, "map": self.surface.describe()}


@with_default_errors
def prepare(
    scene: Scene,
    surface: Surface | None = None,
    *,
    counterface: Surface | None = None,
    like: Prepared | None = None,
    contact: RoughContact | None = None,
) -> Prepared:
    """Make a scene ready: its height map and its rough contact, which all speeds share.

    Parameters
    ----------
    scene : from `lubfric.load_scene`
    surface : a height map to use as it is, with its grid, instead of the scene's own. Under a cylinder it is taken as
        periodic along y, for a flat contact along x and y (`Surface.periodic` makes it so). Without one, a scene with
        ``numerics.sampling = "strips"`` gets strips of its roughness (docs/uncertainty.md)
    counterface : the map of the other body, measured out of it, for a scene whose [counterface] is rough
        (`Surface.combined`). Without it, ``surface`` is what the roughness of both bodies makes up
    like : another prepared scene with the same surface, contact and E', whose map is used again
    contact : a rough contact other than lubfric's own (`lubfric.contact.RoughContact`)

    Returns
    -------
    Prepared : accepted wherever a scene is

    Raises
    ------
    InputError : the map does not fit the scene, or ``like`` does not
    """
    validate.instance("scene", scene, Scene, "a Scene, such as lubfric.load_scene returns")
    maps = _given(scene, surface, counterface)
    if scene.numerics.model == "deterministic":
        check_resolved_gap(scene, len(maps) == 1 or isinstance(like, Prepared) and like.joint)
    if like is not None:
        validate.instance("like", like, Prepared, "what lubfric.prepare returned")
        _check_likeness(scene, like.scene, maps, contact)
        if _same_contact(scene, like.scene):
            kept = {key: value for key, value in like.memo.items() if key[0] != "reference"}
            strips = None if like.strips is None else replace(like.strips, scene=scene)
            made = replace(like, scene=scene, known=beforehand(scene, like.surface), strips=strips)
            made.memo.update(kept)
            return made
        maps = (like.surface, *(like.strips.bodies if like.strips else ())) if like.given else ()
        contact = None if like.own else like.contact
    given = bool(maps) or contact is not None
    with told_doubts(scene):
        surface, strips = sample_of(scene, maps, own=contact is None)
        if strips is not None:
            return _on_strips(scene, surface, strips, given)
        if contact is not None:
            return Prepared(scene, surface, contact, beforehand(scene, surface), given=given)
        heights = surface.heights - surface.heights.mean()
        flat = scene.contact.geometry == "flat"
        contact = (flat_contact_of if flat else independent_asperities_of)(scene, heights, surface.spacing)
        return Prepared(scene, surface, contact, beforehand(scene, surface), given=given)


def _given(scene: Scene, surface: Surface | None, counterface: Surface | None) -> tuple[Surface, ...]:
    """The maps that were given to `prepare`, `together`."""
    for name, one in (("surface", surface), ("counterface", counterface)):
        if one is not None:
            validate.instance(name, one, Surface, "a lubfric.Surface")
    if counterface is None:
        return () if surface is None else (surface,)
    if surface is None or scene.counterface is None or scene.counterface.sq == 0:
        raise InputError("counterface needs a surface beside it, the maps of both bodies, and a rough [counterface]")
    return together(surface, counterface)


def on_stack(prepared: Prepared, strips: Strips, count: int) -> HalfSpaceContact:
    """The contact on the first ``count`` of ``strips``."""

    def make() -> HalfSpaceContact:
        surface = strips.stack(count)
        return _contact(prepared, surface.heights, surface.spacing, strips.cells.axis())

    return prepared.remembered(("stack", strips.cells.coarsening, count), make, lambda made: made.heights.size)


def on_strip(prepared: Prepared, strips: Strips, index: int) -> HalfSpaceContact:
    """The contact on number ``index`` of ``strips`` alone."""

    def make() -> HalfSpaceContact:
        surface = strips.strip(index)
        return _contact(prepared, surface.heights, surface.spacing, strips.cells.axis())

    return prepared.remembered(("strip", strips.cells.coarsening, index), make, lambda made: made.heights.size)


def on_piece(prepared: Prepared, strips: Strips, index: int, factors: tuple[int, int], **length) -> HalfSpaceContact:
    """The contact on every ``factors``-th cell of a piece of ``strips`` (`Strips.piece`)."""
    own = "piece", strips.cells.coarsening, index, *length.values()

    def make() -> HalfSpaceContact:
        surface = prepared.remembered(own, lambda: strips.piece(index, **length))
        heights = strips.cells.thinned(surface.heights, factors)
        spacing = surface.spacing[0] * factors[0], surface.spacing[1] * factors[1]
        return _contact(prepared, heights, spacing, strips.cells.axis(factors))

    return prepared.remembered((*own, factors), make, lambda made: made.heights.size)


def _contact(prepared: Prepared, heights: np.ndarray, spacing, x: np.ndarray) -> HalfSpaceContact:
    scene = prepared.scene
    operator = prepared.remembered(
        ("operator", heights.shape, tuple(spacing)),
        lambda: half_space(heights.shape, spacing, scene.bodies.e_prime, BOUNDARY, workers=scene.numerics.workers),
    )
    return half_space_contact_of(scene, heights - heights.mean(), spacing, operator=operator, x=x)


def _on_strips(scene: Scene, surface: Surface, strips: Strips, given: bool) -> Prepared:
    check_map(scene, surface)
    first = strips.stack(strips.first) if strips.is_single_patch else surface
    heights = first.heights - first.heights.mean()
    contact = half_space_contact_of(scene, heights, first.spacing, x=strips.cells.axis())
    made = Prepared(scene, surface, contact, beforehand(scene, surface), strips, given)
    made.memo[("stack", strips.cells.coarsening, strips.first)] = contact, contact.heights.size
    made.memo[("operator", first.heights.shape, tuple(first.spacing))] = contact.operator, contact.operator.symbol.size
    return made


def scene_of(scene: Scene | Prepared) -> Scene:
    """The scene that was prepared, or the scene itself; anything else is an `InputError`."""
    if isinstance(scene, Prepared):
        return scene.scene
    validate.instance("scene", scene, Scene, "what lubfric.load_scene or lubfric.prepare returned")
    return scene


def at_tolerance(scene: Scene | Prepared, tolerance: float | None, model: str | None) -> Prepared:
    """``scene`` made ready, with another tolerance on f and another model if they are given."""
    changed = {name: value for name, value in (("tolerance", tolerance), ("model", model)) if value is not None}
    if not changed and isinstance(scene, Prepared):
        return scene
    asked = scene_of(scene).with_(numerics=changed)
    ready = scene if isinstance(scene, Prepared) else None
    return ready if ready is not None and asked == ready.scene else prepare(asked, like=ready)


def at_speed(prepared: Prepared, speed: float) -> Prepared:
    """``prepared`` with the f_b that it has at ``speed`` [m/s]."""
    scene = prepared.scene.at_speed(speed)
    return prepared if scene == prepared.scene else prepare(scene, like=prepared)


def _same_contact(scene: Scene, old: Scene) -> bool:
    """Whether contact and cells of both scenes are the same to the bit."""
    names = "tolerance", "contact_tolerance", "workers", "sampling", "grid", "model"
    same = all(getattr(scene.numerics, name) == getattr(old.numerics, name) for name in names)
    return same and _without_friction(scene.bodies) == _without_friction(old.bodies)


def _without_friction(bodies: Bodies) -> Bodies:
    return replace(bodies, boundary_friction_coefficient=0.0, boundary_friction_table=None)


def _check_likeness(scene: Scene, old: Scene, maps, contact) -> None:
    if maps or contact is not None:
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
