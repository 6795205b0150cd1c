"""The height map a scene asks for, on its contact grid, periodic where the contact is."""

from __future__ import annotations

from .. import validate
from ..errors import InputError
from ..scene import Scene
from ..surface import Surface, generate_surface, read_surface, rms_slope
from .strip import check_strip

REACH = 6.0  # length of a measured patch under a cylinder, in Hertz half-widths each side
STEEPEST = 3.0  # rms slope beyond which heights and spacing cannot be in the same unit


def contact_map(scene: Scene, surface: Surface | None = None) -> Surface:
    """Generate, or read, turn, scale, cut and close the heights of ``scene``, or take those of ``surface`` as they are.

    A measured map is mirrored along every axis on which the contact is periodic; under a cylinder
    it is cut to the length of ``contact.shape`` (default: 6 Hertz half-widths each side), centred.
    Everything done is in the notes of the surface.
    """
    if surface is None:
        surface = _measured(scene) if scene.surface.file is not None else _generated(scene)
    check_grid(scene, surface)
    if scene.numerics.contact_level == "flat" and scene.contact.geometry != "flat":
        surface = surface.periodic("mirror", axes=(True, False))
    return surface


def check_grid(scene: Scene, surface: Surface) -> None:
    """Raise `InputError` for slopes no surface has, a strip that the cells do not resolve, a patch that does not hold it."""
    slope = rms_slope(surface)[2] if min(surface.shape) > 1 else 0.0
    if slope > STEEPEST:
        raise InputError(
            f"surface: rms slope = {slope:.3g} of heights with Sq {surface.sq:.3g} m on a spacing of "
            f"{surface.spacing[0]:.3g} m; allowed: up to {STEEPEST:g} (are both in m?)"
        )
    if scene.contact.geometry == "flat":
        return
    check_strip(scene, surface.spacing[0], surface.size[0])


def _generated(scene: Scene) -> Surface:
    rough, patch = scene.surface, scene.contact
    if patch.shape is None or patch.spacing is None:
        raise InputError("contact.shape and contact.spacing [m] are needed for a generated surface")
    spacing = validate.spacing("contact.spacing", patch.spacing)
    surface = generate_surface(
        tuple(rough.oversize * n for n in patch.shape),
        spacing,
        sq=rough.sq,
        correlation_length=rough.correlation_length,
        acf=rough.acf,
        decay_level=rough.decay_level,
        seed=rough.seed,
    )
    if rough.oversize == 1:
        return surface
    surface = surface.cropped(patch.shape).periodic("mirror", axes=(patch.geometry == "flat", True))
    return surface.scaled(sq=rough.sq)


def _measured(scene: Scene) -> Surface:
    rough, patch, bodies = scene.surface, scene.contact, scene.bodies
    surface = read_surface(rough.file, spacing=rough.spacing, unit=rough.unit, form=rough.form, decimal=rough.decimal)
    if rough.motion_axis == "y":
        surface = surface.transposed()
    if rough.sq is not None:
        surface = surface.scaled(sq=rough.sq)
    if patch.spacing is not None:
        surface = surface.resampled(spacing=patch.spacing)
    nx, ny = patch.shape or surface.shape
    if patch.shape is None and patch.geometry == "cylinder":
        nx = min(nx, 2 * int(REACH * bodies.half_width / surface.spacing[0]) + 1)
    if nx > surface.shape[0] or ny > surface.shape[1]:
        raise InputError(
            f"contact.shape = {nx} x {ny} cells of {surface.spacing[0]:.3g} x {surface.spacing[1]:.3g} m is larger "
            f"than the map; allowed: up to {surface.shape[0]} x {surface.shape[1]}, or leave contact.shape out"
        )
    return surface.cropped((nx, ny)).periodic("mirror", axes=(patch.geometry == "flat", True))
