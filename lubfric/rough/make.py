"""The rough contact that a scene asks for."""

from __future__ import annotations

from ..errors import InputError
from ..scene import Scene
from ..surface import Surface
from .asperities import asperities_under_cylinder
from .contract import RoughContact
from .flat import flat_contact
from .half_space import half_space_contact


def rough_contact(scene: Scene, surface: Surface) -> RoughContact:
    """The contact of ``scene`` on ``surface``, periodic along y, and along x too where the contact is flat."""
    flat, level = scene.contact.geometry == "flat", scene.numerics.contact_level
    if flat and level == "semi-periodic":
        raise InputError(
            "numerics.contact_level = 'semi-periodic' needs contact.geometry = 'cylinder'; a flat contact is "
            "periodic both ways"
        )
    if flat or level == "flat":
        make = flat_contact
    else:
        make = half_space_contact if scene.contact.model == "half-space" else asperities_under_cylinder
    return make(scene, surface.heights - surface.heights.mean(), surface.spacing)
