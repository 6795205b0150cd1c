"""A scene is made ready for its speeds: `prepare` checks it, chooses its sample and makes the first contact."""

from dataclasses import replace
from functools import partial
from typing import Any

from .._base import validate, with_default_errors, work_apart_from_limit
from ..contact import RoughContact
from ..errors import InputError
from ..samples import Sample, check_map, combined_maps, sample_of
from ..scene import Bodies, Scene, hint_unusual_values, longest_contact
from ..surface import Surface
from .registry import check_by_model
from .shared import (
    JoinedKey,
    Memo,
    Prepared,
    beforehand,
    cells_of_contact,
    is_of_map_alone,
    operator_on,
    scene_of,
    violations_by_form,
    violations_by_strips,
)


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
    counterface : the map of the other body, heights pointing out of it, for a scene whose [counterface] is rough
        (`Surface.combined`). Without it, ``surface`` is the sum of the roughness of both bodies
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
    check_by_model(
        scene,
        has_one_map_for_all_bodies=len(maps) == 1 or isinstance(like, Prepared) and like.has_one_map_for_all_bodies,
    )
    if like is not None:
        validate.instance("like", like, Prepared, "what lubfric.prepare returned")
        _check_likeness(scene, like.scene, maps, contact)
        if _has_same_contact(scene, like.scene):
            of_map = filter(is_of_map_alone, like.violations)
            prepared = replace(like, scene=scene, violations=(*beforehand(scene, like.sample, like.surface), *of_map))
            prepared.memo.share_surface_of(like.memo)
            return prepared
        maps = (like.surface, *like.sample.bodies) if like.is_given else ()
        contact = like.rough_contact if like.has_given_contact else None
    with hint_unusual_values(scene):
        sample = sample_of(scene, maps, contact=contact)
        has_given_map = bool(maps) if like is None else like.has_given_map
        return _on_sample(scene, sample, has_given_map=has_given_map, has_given_contact=contact is not None)


def prepare_on_maps(scene: Scene, read: tuple[Surface, ...]) -> Prepared:
    """Return ``scene`` made ready on the maps that `lubfric.samples.whole_maps` ``read`` for it, which are not read
    again."""
    check_by_model(scene, has_one_map_for_all_bodies=False)
    with hint_unusual_values(scene):
        return _on_sample(scene, sample_of(scene, read=read), has_given_map=False, has_given_contact=False)


def prepare_on_sample(scene: Scene, sample: Sample) -> Prepared:
    """Return ``scene`` made ready on its ``sample``, which `lubfric.samples.sample_of` made of its own maps and which
    is not made again."""
    check_by_model(scene, has_one_map_for_all_bodies=False)
    return _on_sample(scene, sample, has_given_map=False, has_given_contact=False)


def _on_sample(scene: Scene, sample: Sample, *, has_given_map: bool, has_given_contact: bool) -> Prepared:
    """Return ``scene`` made ready on ``sample``, with the contact on its first strips."""
    surface = sample.stated_map()
    check_map(scene, surface, sample.maps_before_extension[0])
    memo = Memo()
    (rough_contact, contact_work) = work_apart_from_limit(
        lambda: sample.contact(scene, sample.first_strips, partial(operator_on, memo, scene))
    )
    first_strips = JoinedKey(sample.cells.coarsening, sample.first_strips)
    memo.put(first_strips, rough_contact, cells_of_contact(rough_contact), contact_work)
    by_form = (
        *violations_by_form(scene, sample.maps_before_extension, has_given_map=has_given_map),
        *violations_by_strips(*sample.sq_deviation(surface)),
    )
    prepared = Prepared(
        scene=scene,
        surface=surface,
        rough_contact=rough_contact,
        contact_work=contact_work,
        sample=sample,
        violations=(*beforehand(scene, sample, surface), *by_form),
        has_given_map=has_given_map,
        has_given_contact=has_given_contact,
    )
    prepared.memo.share_surface_of(memo)
    return prepared


def _given(scene: Scene, surface: Surface | None, counterface: Surface | None) -> tuple[Surface, ...]:
    """Return the maps that were given to `prepare`, `combined_maps`."""
    for name, one in (("surface", surface), ("counterface", counterface)):
        if one is not None:
            validate.instance(name, one, Surface, "a lubfric.Surface")
    if counterface is None:
        return () if surface is None else (surface,)
    if surface is None or scene.counterface is None or scene.counterface.sq == 0:
        raise InputError("counterface needs surface as well (the maps of both bodies), and a rough [counterface]")
    return combined_maps(surface, counterface)


def prepared_with(scene: Scene | Prepared, tolerance: float | None, model_name: str | None) -> Prepared:
    """Return ``scene`` made ready, with another tolerance on f and another model if they are given."""
    changed = {name: value for name, value in (("tolerance", tolerance), ("model", model_name)) if value is not None}
    if not changed and isinstance(scene, Prepared):
        return scene
    requested = scene_of(scene).with_(numerics=changed)
    ready = scene if isinstance(scene, Prepared) else None
    return ready if ready is not None and requested == ready.scene else prepare(requested, like=ready)


def with_boundary_friction_at(prepared: Prepared, speed: float) -> Prepared:
    """Return ``prepared`` with the f_b that it has at ``speed`` [m/s]; itself where f_b does not depend on the
    speed."""
    scene = prepared.scene.at_speed(speed)
    return prepared if scene == prepared.scene else prepare(scene, like=prepared)


def _has_same_contact(scene: Scene, old: Scene) -> bool:
    """Return whether contact and cells of both scenes are the same to the bit."""
    names = "tolerance", "contact_tolerance", "workers", "sampling", "grid", "model"
    same = all(getattr(scene.numerics, name) == getattr(old.numerics, name) for name in names)
    same_length = longest_contact(scene).bodies == longest_contact(old).bodies
    return same and same_length and _without_friction(scene.bodies) == _without_friction(old.bodies)


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
