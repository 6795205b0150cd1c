"""Which sample of its rough surface a scene is solved on."""

from ..contact import RoughContact
from ..scene import Scene
from ..surface import Surface
from .cells import correlation_lengths, length_or_half
from .contract import Sample
from .maps import contact_maps, is_measured, rough_bodies
from .patch import UnresolvedSample, single_patch
from .strips import strips_of


def requests_patch(scene: Scene) -> bool:
    """Return whether ``scene`` requests one patch of its surface in place of strips, which have a sampling error."""
    return scene.numerics.sampling == "patch"


def takes_strips(scene: Scene) -> bool:
    """Return whether ``scene`` is solved on strips: it has a rough half-space under a cylinder, and requests no
    patch."""
    is_rough = any(rough.sq != 0.0 for rough, _ in rough_bodies(scene))
    return not requests_patch(scene) and _is_resolved(scene) and is_rough


def sample_of(
    scene: Scene,
    maps: tuple[Surface, ...] = (),
    *,
    contact: RoughContact | None = None,
    read: tuple[Surface, ...] = (),
) -> Sample:
    """Return the sample of ``scene``, on native cells if ``numerics.grid`` is "given".

    ``maps``: heights given to `lubfric.prepare`, of all and of each body; ``contact``: given to it; None: lubfric's
    own; ``read``: the maps of the scene, if `whole_maps` read them before.
    """
    sample = _on_chosen_cells(scene, maps, contact, read)
    return sample.native() if scene.numerics.grid == "given" else sample


def _on_chosen_cells(
    scene: Scene, maps: tuple[Surface, ...], contact: RoughContact | None, read: tuple[Surface, ...]
) -> Sample:
    """Return the sample on the cells that its kind takes first; arguments as of `sample_of`."""
    if not maps and contact is None and takes_strips(scene):
        return strips_of(scene, read)
    surface, *bodies = contact_maps(scene, maps, read=read)
    if contact is not None or not _is_resolved(scene):
        return UnresolvedSample(surface=surface, given_contact=contact)
    return single_patch(scene, _lengths(scene, surface, has_given_map=bool(maps)), surface, tuple(bodies))


def _is_resolved(scene: Scene) -> bool:
    return scene.contact.geometry == "cylinder" and scene.contact.model == "half-space"


def _lengths(scene: Scene, surface: Surface, *, has_given_map: bool) -> tuple[float, float]:
    """Return the correlation lengths [m] of a patch: those of the scene, or of the map itself."""
    if is_measured(scene) or has_given_map:
        return length_or_half(surface, 0), length_or_half(surface, 1)
    along_x, along_y = zip(*(correlation_lengths(rough) for rough, _ in rough_bodies(scene)))
    return max(along_x), max(along_y)
