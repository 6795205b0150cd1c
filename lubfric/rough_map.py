"""The height map a scene asks for, on its contact grid, periodic where the contact is."""

from __future__ import annotations

from . import validate
from .errors import InputError
from .scene import Scene
from .surface import Surface, generate_surface, read_surface

REACH = 6.0        # length of a measured patch under a cylinder, in Hertz half-widths each side


def contact_map(scene: Scene) -> Surface:
    """Generate, or read, turn, scale, cut and close the heights of ``scene``.

    A measured map is mirrored along every axis on which the contact is periodic; under a cylinder
    it is cut to the length of ``contact.shape`` (default: 6 Hertz half-widths each side), centred.
    Everything done is in the notes of the surface.
    """
    return _measured(scene) if scene.surface.file is not None else _generated(scene)


def _generated(scene: Scene) -> Surface:
    rough, patch = scene.surface, scene.contact
    if patch.shape is None or patch.spacing is None:
        raise InputError("contact.shape and contact.spacing [m] are needed for a generated surface")
    spacing = validate.spacing("contact.spacing", patch.spacing)
    surface = generate_surface(tuple(rough.oversize * n for n in patch.shape), spacing, sq=rough.sq,
                               correlation_length=rough.correlation_length, acf=rough.acf,
                               decay_level=rough.decay_level, seed=rough.seed)
    if rough.oversize == 1:
        return surface
    surface = surface.cropped(patch.shape).periodic("mirror", axes=(patch.geometry == "flat", True))
    return surface.scaled(sq=rough.sq)


def _measured(scene: Scene) -> Surface:
    rough, patch, bodies = scene.surface, scene.contact, scene.bodies
    surface = read_surface(rough.file, spacing=rough.spacing)
    if rough.motion_axis == "y":
        surface = surface.transposed()
    if rough.sq is not None:
        surface = surface.scaled(sq=rough.sq)
    if patch.spacing is not None:
        surface = surface.resampled(spacing=patch.spacing)
    nx, ny = patch.shape or surface.shape
    if patch.shape is None and patch.geometry == "cylinder":
        nx = min(nx, 2 * int(REACH * bodies.half_width / surface.spacing[0]) + 1)
    return surface.cropped((nx, ny)).periodic("mirror", axes=(patch.geometry == "flat", True))
