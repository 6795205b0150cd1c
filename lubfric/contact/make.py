"""The rough contact that a scene asks for."""

from __future__ import annotations

from ..errors import InputError
from ..scene import Scene
from ..surface import Surface
from .asperities import asperities_under_cylinder
from .flat import flat_contact
from .half_space import half_space_contact
from .rough_contract import RoughContact


def rough_contact(scene: Scene, surface: Surface) -> RoughContact:
    """The contact of ``scene`` on ``surface``, periodic along y, and along x too where the contact is flat."""
    flat, level = scene.contact.geometry == "flat", scene.numerics.contact_level
    if flat and level == "semi-periodic":
        raise InputError(
            "numerics.contact_level = 'semi-periodic' needs contact.geometry = 'cylinder'; a flat contact is "
            "periodic both ways"
        )
    heights = surface.heights - surface.heights.mean()
    if flat or level == "flat":
        return flat_contact(scene, heights, surface.spacing)
    if scene.contact.model == "half-space":
        return half_space_contact(scene, heights, surface.spacing)
    return asperities_under_cylinder(scene, heights, surface.spacing)
