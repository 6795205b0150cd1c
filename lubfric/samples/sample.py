"""Which sample of its rough surface a scene is solved on: strips of it, or one patch."""

from ..scene import Scene
from ..surface import Surface
from .cells import (
    correlation_lengths,
    length_or_half,
)
from .maps import (
    contact_maps,
    measured,
    rough_bodies,
)
from .strips import (
    Strips,
    one_patch,
    strips_of,
)


def takes_strips(scene: Scene) -> bool:
    """Whether ``scene`` is solved on strips of its roughness: it has a rough half-space under a cylinder, and does not
    ask for one patch."""
    numerics = scene.numerics
    contact = scene.contact
    modelled = contact.geometry == "cylinder" and contact.model == "half-space"
    return numerics.sampling != "patch" and modelled and any(rough.sq != 0.0 for rough, _ in rough_bodies(scene))


def sample_of(scene: Scene, maps: tuple[Surface, ...] = (), own: bool = True) -> tuple[Surface, Strips | None]:
    """The map that is solved first, and the sample that it belongs to, if the rough contact is lubfric's ``own``, with
    cells under a cylinder. ``maps``: `_given`."""
    if own and not maps and takes_strips(scene):
        strips = strips_of(scene)
        return strips.stack(strips.first), strips
    surface, *bodies = contact_maps(scene, maps)
    if own and scene.contact.geometry == "cylinder" and scene.contact.model == "half-space":
        return surface, one_patch(scene, _lengths(scene, surface, bool(maps)), surface, *bodies)
    return surface, None


def _lengths(scene: Scene, surface: Surface, given: bool) -> tuple[float, float]:
    """Correlation lengths [m] of a patch: those of the scene, or of the map itself."""
    if measured(scene) or given:
        return length_or_half(surface, 0), length_or_half(surface, 1)
    along_x, along_y = zip(*(correlation_lengths(rough) for rough, _ in rough_bodies(scene)))
    return max(along_x), max(along_y)
