"""The height map of a scene on its contact grid, periodic along the axes on which the contact is."""

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.fft import next_fast_len

from .._base import validate
from ..errors import InputError
from ..quantities import KEYS
from ..scene import Bodies, ContactDomain, LongestContact, Roughness, Scene, longest_contact, named
from ..surface import Surface, check_slopes, generate_surface, outliers, read_surface
from ..units import converted, worded
from .cells import length_of_rough_contact, no_cells

# Hertz half-widths on each side to which a measured patch is cut. Not measured: at the lightest loads of rough
# contacts the contact is wider than the Hertz strip by a factor of this order.
PATCH_HALF_WIDTHS = 6.0


def contact_maps(
    scene: Scene, given: tuple[Surface, ...] = (), *, read: tuple[Surface, ...] = ()
) -> tuple[Surface, ...]:
    """Generate the heights of ``scene``, or read, turn, scale and cut them and make them periodic; those of both
    bodies become one map, which each body follows alone (`combined_maps`). Maps that are ``given`` are used unchanged.

    Under a cylinder a measured map is cut, about its middle, to the length of ``contact.shape`` (default: 6 Hertz
    half-widths on each side), and is used unchanged along y, like a given one. A flat contact is periodic along both
    axes, and mirrors it. The notes of the surface state everything that was done. ``read``: what `whole_maps`
    returned, if that was called before.
    """
    whole = given or read or whole_maps(scene)
    maps = whole
    if not given and is_measured(scene):
        maps = tuple(_cut_to_contact(scene, surface) for surface in whole)
    if not np.isfinite(maps[0].heights).all():
        missing = f"{100 * maps[0].missing_fraction:.3g} % of the heights are unmeasured (NaN)"
        raise InputError(f"surface: {missing}; call level() and fill() first")
    check_map(scene, maps[0], whole[0])
    return maps


def rough_bodies(scene: Scene) -> list[tuple[Roughness, str]]:
    """Return the roughness of each body that has one, and its section of the scene."""
    bodies = [(scene.surface, "surface"), (scene.counterface, "counterface")]
    return [(rough, name) for rough, name in bodies if rough is not None]


def is_measured(scene: Scene) -> bool:
    """Return whether any of its maps comes from a file."""
    return any(rough.file is not None for rough, _ in rough_bodies(scene))


def limiting_map(scene: Scene, surface: Surface, axis: int) -> tuple[str, str]:
    """Return the section and the file of the measured map that limits ``surface``, made of all maps of the ``scene``,
    along ``axis``; "surface" and no file where none is measured."""
    measured = [(name, str(rough.file)) for rough, name in rough_bodies(scene) if rough.file is not None]
    limiting = surface.limited_by[axis]
    return next((each for each in measured if each[0] == limiting), measured[0] if measured else ("surface", ""))


def way_to_longer_line(scene: Scene, surface: Surface) -> str:
    """Return how the ``surface`` of ``scene`` becomes longer across the motion, as text."""
    if not is_measured(scene):
        return "a contact.shape or a map that is longer along y"
    (name, file) = limiting_map(scene, surface, 1)
    return (
        f"a map of [{name}] that is longer across the motion{_axis_of_file(scene, name, 1)}, in place of "
        f"{Path(file).name}"
    )


def way_to_longer_patch(scene: Scene, surface: Surface) -> str:
    """Return how the patch ``surface`` of ``scene`` becomes longer along the motion, as text."""
    if not is_measured(scene):
        needed = math.ceil(length_of_rough_contact(scene, surface.sq) / surface.spacing[0])
        cells = f" of at least {needed} cells" if needed > surface.shape[0] else " that is longer"
        return f"a contact.shape{cells} along x"
    (name, _) = limiting_map(scene, surface, 0)
    mirror = f"{name}.extension = 'mirror', which continues the map by its mirror image"
    return f"{mirror}, or a map that is longer along the motion{_axis_of_file(scene, name, 0)}"


def _axis_of_file(scene: Scene, name: str, axis: int) -> str:
    """Return which axis of the file of section ``name`` lies along ``axis`` of the scene, as text; "" where it is the
    same one."""
    turned = getattr(scene, name).motion_axis == "y"
    return f" (its file is turned: {'yx'[axis]} of the file)" if turned else f" ({'xy'[axis]} of its file)"


def is_extended(scene: Scene) -> bool:
    """Return whether a map that is too short is continued by its mirror image."""
    return any(rough.extension == "mirror" for rough, _ in rough_bodies(scene))


def whole_maps(scene: Scene) -> tuple[Surface, ...]:
    """Return the heights of both bodies `combined_maps`, or of the only one: measured ones whole and on their own grid,
    generated ones on the contact grid. A generated one that faces a measured one is made as large as that. If it were
    repeated instead, a few of its summits would represent all."""
    bodies = rough_bodies(scene)
    domain = scene.contact
    maps_by_body = {}
    for rough, name in bodies:
        if rough.file is not None:
            with named(name):
                maps_by_body[name] = measured_map(rough, name)
            domain = domain_over(maps_by_body[name], scene.contact)
    for rough, name in bodies:
        if rough.file is None:
            with named(name):
                maps_by_body[name] = generated_map(rough, domain, name)
    maps = [maps_by_body[name] for _, name in bodies]
    return (maps[0],) if len(maps) == 1 else combined_maps(maps[0], _facing(scene, maps[1]))


def combined_maps(first: Surface, second: Surface) -> tuple[Surface, ...]:
    """Return the maps of two bodies as one (`Surface.combined`), and each alone as part of that, with the other one
    flat."""
    flat = [replace(surface, heights=np.zeros(surface.shape)) for surface in (first, second)]
    return first.combined(second), first.combined(flat[1]), flat[0].combined(second)


def _facing(scene: Scene, second: Surface) -> Surface:
    """Return the map of the ``second`` body, mirrored in y if that of the first is a mirror image.

    A map whose axes were exchanged (`measured_map`) is the mirror image of its body in y. For one map, or for two
    mirrored ones, that changes no friction. If only one of two is mirrored, the other has to be mirrored too: else
    oblique ridges that cross would run side by side.
    """
    axes = [rough.motion_axis for rough, _ in rough_bodies(scene) if rough.file is not None]
    if set(axes) != {"x", "y"}:
        return second
    mask = None if second.mask is None else second.mask[:, ::-1]
    note = "mirrored in y: one of the two maps has its axes exchanged"
    return replace(second, heights=second.heights[:, ::-1], mask=mask, notes=(*second.notes, note))


# What may be wrong where the Hertz strip has an unlikely width.
CHECK_LOAD = "check the load: it is that of the whole width, in N"


def domain_over(surface: Surface, domain: ContactDomain) -> ContactDomain:
    """Return ``domain`` with a grid that covers ``surface``, on the spacing of ``domain`` or, if it has none, of
    ``surface``."""
    spacing = surface.spacing if domain.spacing is None else validate.spacing("contact.spacing", domain.spacing)
    nx, ny = (next_fast_len(math.ceil(a / d * (1 - 1e-9))) for a, d in zip(surface.size, spacing))
    return replace(domain, shape=(nx, ny), spacing=spacing)


def check_map(scene: Scene, surface: Surface, whole: Surface) -> None:
    """Raise `InputError` for slopes that no surface has, for cells too coarse for the Hertz strip, and for a patch too
    small for it. ``surface``: what is solved of the ``whole`` map."""
    check_slopes(surface)
    if scene.contact.geometry == "flat":
        return
    half_width = scene.bodies.half_width
    step = surface.spacing[0]
    if step > half_width:
        error = InputError(
            f" = {worded(step, 'm')} along x does not resolve the Hertz strip: {load_in_words(scene.bodies)}",
            "contact.spacing",
            f"at most the half-width, {worded(half_width, 'm')}",
            CHECK_LOAD,
            also=("bodies.load",),
        )
        error.hint(_load_in_kilonewtons(scene, step), asks=True)
        raise error
    length = surface.size[0]
    longest = longest_contact(scene)
    needed = 2 * longest.bodies.half_width
    if length < needed:
        (name, file) = limiting_map(scene, surface, 0)
        what = "the patch (contact.shape x contact.spacing)"
        ways = "a larger contact.shape"
        if file and whole.size[0] < needed:
            length = whole.size[0]
            what = f"the map of the {name} ({file})"
            ways = f"{_way_to_other_axis(scene, whole, name, needed)}a longer map, {_ways_with_short_map(name)}"
        raise InputError(
            f"{what} is {worded(length, 'm')} long in x, the direction of motion; allowed: at least the Hertz strip, "
            f"{worded(needed, 'm')}: {ways}; {_longest_in_words(longest)}; {CHECK_LOAD}"
        )


def _longest_in_words(longest: LongestContact) -> str:
    """Return the load, and the half-width that it gives, of the ``longest`` contact of a scene; in a run in time with
    its moment, as text."""
    bodies = longest.bodies
    if longest.time is None:
        return load_in_words(bodies)
    return (
        f"the contact is longest at t = {worded(longest.time, 's')}, under {worded(bodies.load, 'N')} at a reduced "
        f"radius of {worded(bodies.radius, 'm')}, with a Hertz half-width of {worded(bodies.half_width, 'm')}"
    )


def _way_to_other_axis(scene: Scene, whole: Surface, name: str, needed: float) -> str:
    """Return that the ``whole`` map, too short along x for the ``needed`` length [m], is long enough along its other
    axis, as text; "" where it is not. ``name``: the section of its file."""
    across = whole.size[1]
    if across < needed:
        return ""
    other = "x" if getattr(scene, name).motion_axis == "y" else "y"
    return f"{name}.motion_axis = {other!r} (if the motion is along {other} of the file, {worded(across, 'm')} long), "


def _load_in_kilonewtons(scene: Scene, step: float) -> str:
    """Return the question whether the load of ``scene`` was meant in kN: cells of ``step`` [m] then resolve the Hertz
    strip, under a usual Hertz pressure; "" where they do not."""
    bodies = scene.bodies
    meant = replace(bodies, load=converted(bodies.load, "kN", "N"))
    peak, meant_peak = (4 / math.pi * each.mean_hertz_pressure for each in (bodies, meant))
    low, high = KEYS["bodies.hertz_pressure"].usual
    if step > meant.half_width or not low <= meant_peak <= high:
        return ""
    return (
        f"bodies.load = {worded(bodies.load, 'N')} gives a peak Hertz pressure of {worded(peak, 'Pa')}; did you mean "
        f"{bodies.load:.4g} kN, which gives {worded(meant_peak, 'Pa')}?"
    )


def load_in_words(bodies: Bodies) -> str:
    """Return which Hertz half-width the load gives, and that load per width, as text."""
    return (
        f"bodies.load = {worded(bodies.load, 'N')} on bodies.width = {worded(bodies.width, 'm')} is "
        f"{worded(bodies.load / bodies.width, 'N/m')}, with a Hertz half-width of {worded(bodies.half_width, 'm')}"
    )


def _ways_with_short_map(name: str) -> str:
    """Return what a scene may state if the map of its section ``name`` is too short."""
    return (
        f"{name}.extension = 'mirror' (continues the map by its mirror image) or contact.geometry = 'flat' (its "
        "roughness spread over the strip)"
    )


def generated_map(rough: Roughness, domain: ContactDomain, name: str = "surface") -> Surface:
    """Return a generated map on the grid of ``domain``. The counterface draws other random numbers from the same
    seed."""
    if domain.shape is None or domain.spacing is None:
        raise no_cells([rough], name=name)
    surface = generate_surface(
        (rough.oversize * domain.shape[0], rough.oversize * domain.shape[1]),
        validate.spacing("contact.spacing", domain.spacing),
        **statistics(rough),
        seed=rough.seed if name == "surface" else other_seed(rough.seed),
    )
    if rough.oversize == 1:
        return surface
    surface = surface.cropped(domain.shape).periodic(axes=(domain.geometry == "flat", True))
    return surface if rough.sq is None else surface.scaled(sq=rough.sq)


def statistics(rough: Roughness) -> dict[str, Any]:
    """Return the arguments of `generate_surface` for a roughness."""
    honed = ("sk", "spk", "svk", "honing_angle", "groove_width")
    return {name: getattr(rough, name) for name in ("sq", "correlation_length", "acf", "decay_level", *honed)}


def other_seed(seed: int) -> int:
    """Return a seed whose random numbers are independent of those of ``seed``, and of those of its neighbours."""
    return int.from_bytes(np.random.SeedSequence([seed, 1]).generate_state(4).tobytes(), "little")


def measured_map(rough: Roughness, name: str = "surface") -> Surface:
    """Return a map from a file, prepared as ``rough`` says: form removed, outliers treated, filtered, filled, turned
    and scaled."""
    surface = read_surface(
        rough.file,
        spacing=rough.spacing,
        unit=rough.unit,
        form=rough.form,
        decimal=rough.decimal,
        missing_value=rough.missing_value,
        fill=False,
    )
    if rough.outliers == "mask":
        surface = surface.without_outliers().level(rough.form)
    elif rough.outliers == "refuse":
        refuse_outliers(surface, name)
    surface = surface.filtered(s=rough.s_filter, l=rough.l_filter).fill()
    if rough.motion_axis == "y":
        surface = surface.transposed()
    return surface if rough.sq is None else surface.scaled(sq=rough.sq)


def refuse_outliers(surface: Surface, name: str) -> None:
    """Raise `InputError` for points that are isolated above their neighbours: they are no roughness, and would carry
    the load."""
    off = outliers(surface.fill().heights, surface.mask, surface.periodic_axes)
    worst = tuple(int(i) for i in np.unravel_index(off.argmax(), off.shape))
    if off[worst] > 0:
        z = (surface.heights[worst] - surface.measured.mean()) / surface.sq
        count = np.count_nonzero(off > 0)
        alone = "1 isolated point is above its" if count == 1 else f"{count} isolated points are above their"
        masked = surface.without_outliers()
        raise InputError(
            f"surface {surface.source}: {alone} neighbours and would carry the load, the worst at (ix, iy) = {worst}, "
            f"{z:.3g} Sq high; give {name}.outliers = 'mask' to take all outliers for unmeasured "
            f"({masked.notes[-1]}), 'keep' if they are real (docs/inputs.md has the rule)"
        )


def _cut_to_contact(scene: Scene, surface: Surface) -> Surface:
    """Return the middle of a map, cut to the contact grid, and made periodic on the axes on which the contact is."""
    domain = scene.contact
    cylinder = scene.contact.geometry == "cylinder"
    mirrored = is_extended(scene)
    reach = PATCH_HALF_WIDTHS * longest_contact(scene).bodies.half_width
    if domain.spacing is not None:
        surface = surface.resampled(spacing=domain.spacing)
    if mirrored and (domain.shape or cylinder):
        surface = surface.continued(domain.shape[0] * surface.spacing[0] if domain.shape else 2 * reach)
    nx, ny = domain.shape or surface.shape
    if domain.shape is None and cylinder:
        nx = min(nx, 2 * int(reach / surface.spacing[0]) + 1)
    if nx > surface.shape[0] or ny > surface.shape[1]:
        (name, _) = limiting_map(scene, surface, 0)
        raise InputError(
            f"contact.shape = {nx} x {ny} cells of {surface.spacing[0]:.3g} x {surface.spacing[1]:.3g} m is larger "
            f"than the map; allowed: up to {surface.shape[0]} x {surface.shape[1]}, or leave contact.shape out"
            f"{'' if mirrored or nx <= surface.shape[0] else '; ' + _ways_with_short_map(name)}"
        )
    cut = surface.cropped((nx, ny))
    if not cylinder:
        return cut.periodic()
    notes = cut.notes if cut.periodic_axes[1] else (*cut.notes, "taken as periodic along y, across the motion")
    return replace(cut, periodic_axes=(cut.periodic_axes[0], True), notes=notes)
