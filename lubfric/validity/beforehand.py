"""What can be said of a scene and its map before anything is solved."""

from __future__ import annotations

from ..errors import InputError
from ..plausible import doubts
from ..surface import correlation_length, rms_slope
from .bodies import of_bodies, of_map
from .entry import Validity


def beforehand(scene, surface) -> tuple[Validity, ...]:
    """Entries for values far from the usual, for the bodies and for the map."""
    unusual = [
        Validity(d.name, d.value, d.limit, d.unit, "unusual", d.meant or "check the value and its unit")
        for d in doubts(scene)
    ]
    return (*unusual, *of_bodies(scene.bodies), *of_map(rms_slope(surface)[2], _lengths_across(surface)))


def _lengths_across(surface) -> float | None:
    """Width of the map over its correlation length across the motion. None where it has no such length: a lay along
    the motion, or a flat map."""
    ny = surface.shape[1]
    if ny < 8 or surface.sq == 0:
        return None
    try:
        return ny * surface.spacing[1] / correlation_length(surface, 1)
    except InputError:
        return None
