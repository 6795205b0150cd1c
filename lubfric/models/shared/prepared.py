"""A scene made ready: all that its speeds share."""

import math
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any, cast

import numpy as np

from ..._base import FieldsOnly, Shown, validate, with_default_errors
from ...contact import BOUNDARY, AsperityContact, FlatContact, HalfSpace, HalfSpaceContact, RoughContact, half_space
from ...errors import InputError
from ...samples import (
    PIECE,
    Sample,
    half_space_contact_of,
    sample_of,
    together,
)
from ...samples import check_grid as check_map
from ...scene import Bodies, Scene, check_resolved_gap, warn_unusual_values
from ...surface import Surface
from .checks_before import beforehand
from .memo import Memo, OperatorKey, PieceKey, PieceMapKey, StackKey, StripKey
from .validity import Validity

OWN = HalfSpaceContact, FlatContact, AsperityContact


@dataclass(frozen=True, repr=False, kw_only=True)
class Prepared(FieldsOnly, Shown):
    """A scene prepared by `prepare`. It is accepted wherever a scene is, and safe to share: only what it remembers
    (`Memo`) changes, and that changes no result.

    Attributes
    ----------
    scene : the scene
    surface : the height map that is solved first
    contact : the rough contact on it
    known : assumptions of the model that bodies and map violate
    sample : what represents the infinite rough line contact
    given : whether a map or a contact was given to `prepare`, so that there is no more of it
    """

    scene: Scene
    surface: Surface
    contact: RoughContact
    sample: Sample
    known: tuple[Validity, ...] = ()
    given: bool = False

    @property
    def own(self) -> bool:
        """Whether the rough contact is one of lubfric's own."""
        return isinstance(self.contact, OWN)

    @property
    def joint(self) -> bool:
        """Whether one map was given for all bodies, and nobody knows what of it is whose."""
        return self.given and not self.sample.bodies

    @cached_property
    def memo(self) -> Memo:
        """What is remembered between speeds; neither compared nor pickled."""
        return Memo()

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
    """Prepare a scene: its height map and its rough contact, which all speeds share.

    Parameters
    ----------
    scene : from `lubfric.load_scene`
    surface : a height map to use unchanged, with its grid, instead of the scene's own. Under a cylinder it is taken as
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
            prepared = replace(like, scene=scene, known=beforehand(scene, like.surface))
            prepared.memo.keep_surface_of(like.memo)
            return prepared
        maps = (like.surface, *like.sample.bodies) if like.given else ()
        contact = None if like.own else like.contact
    with warn_unusual_values(scene):
        sample = sample_of(scene, maps, contact=contact)
        return _on_sample(scene, sample, is_given=bool(maps) or contact is not None)


def prepare_on_maps(scene: Scene, read: tuple[Surface, ...]) -> Prepared:
    """Return ``scene`` made ready on the maps that `lubfric.samples.whole_maps` ``read`` for it, which are not read
    again."""
    if scene.numerics.model == "deterministic":
        check_resolved_gap(scene)
    with warn_unusual_values(scene):
        return _on_sample(scene, sample_of(scene, read=read), is_given=False)


def _on_sample(scene: Scene, sample: Sample, *, is_given: bool) -> Prepared:
    """Return ``scene`` made ready on ``sample``, with the contact on its first strips."""
    surface = sample.first_map()
    check_map(scene, surface)
    memo = Memo()
    contact = sample.contact(scene, sample.first, partial(_operator, memo, scene))
    memo.put(StackKey(sample.cells.coarsening, sample.first), contact, _cells(contact))
    prepared = Prepared(
        scene=scene, surface=surface, contact=contact, sample=sample, known=beforehand(scene, surface), given=is_given
    )
    prepared.memo.keep_surface_of(memo)
    return prepared


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


def no_rough_film(prepared: Prepared, speed: float) -> str:
    """Return why no film flows between rough surfaces on cells at ``speed`` [m/s], as text; "" if one does."""
    if speed == 0:
        return "nothing is entrained"
    if not prepared.sample.is_resolved:
        return "the contact has no cells to solve strip by strip"
    return "the surfaces are smooth" if prepared.surface.sq == 0 else ""


def contact_on(prepared: Prepared, sample: Sample, count: int) -> RoughContact:
    """Return the contact on the first ``count`` strips of ``sample``; of an unresolved one the only contact."""

    def make() -> RoughContact:
        return contact_of(prepared, sample, count, prepared.scene)

    return prepared.memo.get(StackKey(sample.cells.coarsening, count), make, _cells)


def contact_of(prepared: Prepared, sample: Sample, count: int, scene: Scene) -> RoughContact:
    """Return the contact of ``scene``, which differs from the prepared one in inputs only, on the first ``count`` strips
    of ``sample``."""
    return sample.contact(scene, count, partial(_operator, prepared.memo, prepared.scene))


def on_stack(prepared: Prepared, sample: Sample, count: int) -> HalfSpaceContact:
    """Return the contact on the first ``count`` strips of ``sample``, which is resolved."""
    return cast(HalfSpaceContact, contact_on(prepared, sample, count))


def on_strip(prepared: Prepared, sample: Sample, index: int) -> HalfSpaceContact:
    """Return the contact on strip ``index`` of ``sample`` alone."""

    def make() -> HalfSpaceContact:
        surface = sample.strip(index)
        return _contact(prepared, surface.heights, surface.spacing, sample.cells.axis())

    return prepared.memo.get(StripKey(sample.cells.coarsening, index), make, lambda contact: contact.heights.size)


def on_piece(
    prepared: Prepared, sample: Sample, index: int, cells: tuple[int, int], length: float = PIECE
) -> HalfSpaceContact:
    """Return the contact on piece ``index`` of ``sample`` (`Sample.piece`), on ``cells`` so many native ones long."""
    coarsening = sample.cells.coarsening

    def make() -> HalfSpaceContact:
        surface = prepared.memo.get(PieceMapKey(coarsening, index, length), lambda: sample.piece(index, length))
        heights = sample.cells.thinned(surface.heights, cells)
        spacing = surface.spacing[0] * cells[0], surface.spacing[1] * cells[1]
        return _contact(prepared, heights, spacing, sample.cells.axis(cells))

    return prepared.memo.get(PieceKey(coarsening, index, length, cells), make, lambda contact: contact.heights.size)


def _contact(prepared: Prepared, heights: np.ndarray, spacing: tuple[float, float], x: np.ndarray) -> HalfSpaceContact:
    scene = prepared.scene
    (nx, ny) = heights.shape
    operator = _operator(prepared.memo, scene, (nx, ny), spacing)
    return half_space_contact_of(scene, heights - heights.mean(), spacing, operator=operator, x=x)


def _operator(memo: Memo, scene: Scene, shape: tuple[int, int], spacing: tuple[float, float]) -> HalfSpace:
    """Return the half-space operator of ``scene`` on a grid, made once for ``memo``."""
    return memo.get(
        OperatorKey(shape, (spacing[0], spacing[1])),
        lambda: half_space(shape, spacing, scene.bodies.e_prime, BOUNDARY, workers=scene.numerics.workers),
        lambda operator: operator.symbol.size,
    )


def _cells(contact: RoughContact) -> int:
    """Return the number of cells that a contact holds."""
    return math.prod(contact.grid or (0,))


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
    requested = scene_of(scene).with_(numerics=changed)
    ready = scene if isinstance(scene, Prepared) else None
    return ready if ready is not None and requested == ready.scene else prepare(requested, like=ready)


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


def _check_likeness(scene: Scene, old: Scene, maps: tuple[Any, ...], contact: RoughContact | None) -> None:
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
