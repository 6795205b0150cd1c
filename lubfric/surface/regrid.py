"""A map on other points: made periodic, resampled, cut or repeated, one axis at a time; the sum of two maps.

Functions of a `lubfric.Surface` return a new one.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from .._base import validate
from ..errors import InputError
from ..units import worded

Surface = Any  # `lubfric.Surface`, which is built of these functions

MOST_MAP_POINTS = 2**26  # of any map, 512 MiB of heights; a choice, for memory
EQUAL_LENGTHS = 1e-9  # relative difference of lengths that are equal; a choice: printed with nine digits


def pair(name: str, value: Any) -> tuple[int, int]:
    """Return two integers >= 1; one represents both."""
    return validate.pair(name, value, partial(validate.integer, minimum=1), "a whole number >= 1")


def points(name: str, shape: tuple[int, ...]) -> None:
    """Check that a grid of that many points fits into memory."""
    if math.prod(shape) > MOST_MAP_POINTS:
        message = (
            f" = {validate.shown(shape)} has some 1e{math.log10(math.prod(shape)):.0f} points"  # of any whole number
        )
        raise InputError(message, name, f"up to {MOST_MAP_POINTS:.3g}")


def changed(
    surface: Surface,
    axis: int,
    heights: np.ndarray,
    note: str,
    *,
    step: float | None = None,
    is_periodic: bool | None = None,
    mask: np.ndarray | None = None,
) -> Surface:
    """Return a copy with new heights along one axis, and whatever else changes with them."""
    spacing = list(surface.spacing)
    periodic = list(surface.periodic_axes)
    notes = (*surface.notes, note)
    spacing[axis] = spacing[axis] if step is None else step
    periodic[axis] = periodic[axis] if is_periodic is None else is_periodic
    return replace(
        surface,
        heights=heights,
        mask=mask,
        notes=notes,
        spacing=(spacing[0], spacing[1]),
        periodic_axes=(periodic[0], periodic[1]),
    )


def mirrored(surface: Surface, axis: int) -> Surface:
    """Return ``surface`` made periodic along ``axis``: its points, followed by their mirror image."""
    heights = np.concatenate([surface.heights, np.flip(surface.heights, axis)], axis)
    mask = None if surface.mask is None else np.concatenate([surface.mask, np.flip(surface.mask, axis)], axis)
    return changed(surface, axis, heights, f"made periodic along {'xy'[axis]}: mirror", is_periodic=True, mask=mask)


def resampled(surface: Surface, axis: int, count: int | None, step: float | None) -> Surface:
    """Return ``surface`` on ``count`` points along ``axis``, or on points ``step`` [m] apart; see `resample_axis`."""
    n = surface.shape[axis]
    old = surface.spacing[axis]
    is_periodic = surface.periodic_axes[axis]
    if count is None:
        assert step is not None  # one of the two is given
        exact = n * old / step
        count = int(np.floor(min(exact, 1e15) * (1 + 1e-9)))
        is_periodic = is_periodic and abs(exact - round(exact)) < 1e-6
    else:
        step = n * old / count
    if count < 1:
        raise InputError(f"spacing[{axis}] = {step:g} m is longer than the map; allowed: up to {n * old:g} m")
    points(f"points along {'xy'[axis]} and the other axis", (count, surface.shape[1 - axis]))
    if count == n and abs(step / old - 1) < 1e-9:
        return surface
    heights = resample_axis(surface.heights, axis, count, step / old, periodic=is_periodic)
    note = f"resampled along {'xy'[axis]} from {n} points at {old:.4e} m to {count} at {step:.4e} m"
    if surface.mask is not None:
        note += f" (mask dropped, {100 * surface.missing_fraction:.3g} % was unmeasured)"
    return changed(surface, axis, heights, note, step=step, is_periodic=is_periodic)


def fitted(surface: Surface, axis: int, count: int) -> Surface:
    """Return ``surface`` on exactly ``count`` points of its own spacing along ``axis``: repeated where periodic, else
    cut."""
    n = surface.shape[axis]
    if count == n:
        return surface
    if surface.periodic_axes[axis]:
        pick = np.arange(count) % n
        mask = None if surface.mask is None else np.take(surface.mask, pick, axis)
        note = f"{'repeated' if count > n else 'cut'} along {'xy'[axis]} from {n} to {count} points"
        return changed(surface, axis, np.take(surface.heights, pick, axis), note, is_periodic=count % n == 0, mask=mask)
    if count > n:
        extent = f"{count} points along {'xy'[axis]} ({count * surface.spacing[axis]:g} m)"
        allowed = f"up to {n} ({surface.size[axis]:g} m), or a periodic map"
        raise InputError(f"patch of {extent} needs as many of the map", allowed=allowed)
    shape = list(surface.shape)
    shape[axis] = count
    return surface.cropped(shape)


def combined(first: Surface, second: Surface) -> Surface:
    """Return two rough surfaces that face each other as one map.

    It is z1(x, y) + z2(x, -y), on the finer of both spacings along each axis, over the length that both have.

    The gap between them is h - z1 - z2 with both heights measured outwards, so that one rigid smooth body against the
    sum is the same contact (half-spaces: E' already holds both bodies). The second body is turned over about x, the
    direction of motion: its x stays and its y runs backwards.

    If both are periodic along an axis with the same length, the sum is periodic too. Otherwise the shorter length
    counts, cut around the middle, and the sum is open. (A periodic map is repeated to reach the length of an open one.)
    The heights are taken about their means. Raises `InputError` for maps with unmeasured points: level and fill first.
    """
    for name, surface in (("first", first), ("second", second)):
        if not np.isfinite(surface.heights).all():
            raise InputError(f"{name} surface has unmeasured points (NaN); call level() and fill() first")
    turned = None if second.mask is None else second.mask[:, ::-1]
    second = replace(second, heights=second.heights[:, ::-1], mask=turned)
    spacing = (min(first.spacing[0], second.spacing[0]), min(first.spacing[1], second.spacing[1]))
    parts = [_cut_to_common(pair_of, spacing) for pair_of in ((first, second), (second, first))]
    _check_size(parts, spacing)
    parts = [surface.resampled(spacing=spacing) for surface in parts]
    shape, periodic_axes = zip(*(_common(axis, *parts) for axis in range(2)))
    limited_by = (_shorter(0, *parts), _shorter(1, *parts))
    parts = [part.patch(shape) for part in parts]
    heights = sum(part.heights - part.heights.mean() for part in parts)
    mask = np.logical_and(*(np.ones(shape, bool) if part.mask is None else part.mask for part in parts))
    sources = list(dict.fromkeys(surface.source or "a map" for surface in (first, second)))
    source = " and ".join(sources) if len(sources) > 1 else f"both {sources[0]}"
    names = ("surface", "counterface")
    notes = [f"{name}: {note}" for name, part in zip(names, parts) for note in part.notes]
    both = f"Sq {worded(first.sq, 'm')} and {worded(second.sq, 'm')}"
    notes.append(f"sum of surface and counterface, {both}, the counterface turned over about x")
    used = [_part_in_words(name, whole, part) for name, whole, part in zip(names, (first, second), parts)]
    notes += used
    notes += [f"the length along {'xy'[axis]} is that of the {name}" for axis, name in enumerate(limited_by) if name]
    return replace(
        parts[0],
        heights=heights,
        mask=mask,
        periodic_axes=periodic_axes,
        source=source,
        notes=tuple(notes),
        used_parts=(*(f"{name}: {note}" for name, part in zip(names, parts) for note in part.used_parts), *used),
        limited_by=limited_by,
    )


def _cut_to_common(pair_of: tuple[Surface, Surface], spacing: tuple[float, float]) -> Surface:
    """Return the first map of a pair, cut around its middle along each axis where finer cells of ``spacing`` [m] are
    made of it and the other map is shorter: two cells longer than the sum."""
    surface, other = pair_of
    shape = list(surface.shape)
    for axis in range(2):
        step = surface.spacing[axis]
        if surface.periodic_axes[axis] or other.periodic_axes[axis] or step <= spacing[axis] * (1 + EQUAL_LENGTHS):
            continue
        shape[axis] = min(shape[axis], math.ceil(other.size[axis] / step) + 2)
    return surface if tuple(shape) == surface.shape else surface.cropped(shape)


def _check_size(parts: list[Surface], spacing: tuple[float, float]) -> None:
    """Raise `InputError` where a map of a sum has too many points on the finer cells of both, of ``spacing`` [m]."""
    for surface in parts:
        shape = tuple(math.floor(length / step * (1 + EQUAL_LENGTHS)) for length, step in zip(surface.size, spacing))
        if math.prod(shape) > MOST_MAP_POINTS:
            name = surface.source or "a map"
            cells = f"{name} on the finer cells of both maps, {worded(spacing[0], 'm')} x {worded(spacing[1], 'm')}"
            ways = (
                "coarser cells of the finer map, surface.resampled(spacing=...), or a smaller part of the larger map, "
            )
            raise InputError(
                f": {shape[0]} x {shape[1]} points of {cells}",
                "sum of two maps",
                f"up to {MOST_MAP_POINTS:.3g} points",
                f"give {ways}surface.cropped(...)",
            )


def _shorter(axis: int, first: Surface, second: Surface) -> str:
    """Return which body has the map that limits the sum along ``axis``; "" where none does."""
    lengths = {
        name: s.size[axis] for name, s in (("surface", first), ("counterface", second)) if not s.periodic_axes[axis]
    }
    names = sorted(lengths, key=lambda name: lengths[name])
    equal = len(names) == 2 and lengths[names[1]] <= lengths[names[0]] * (1 + EQUAL_LENGTHS)
    return "" if equal or not names else names[0]


def _part_in_words(name: str, whole: Surface, part: Surface) -> str:
    """Return the note how much of the map ``whole`` of the body ``name`` is in the sum, as its ``part``."""
    used = _lengths_in_words(part.size)
    all_of_it = _lengths_in_words(whole.size)
    text = f"{name}: all of its {used} µm used"
    if used != all_of_it:
        text = f"{name}: {used} of its {all_of_it} µm used"
    if part.spacing != whole.spacing:
        cells = _lengths_in_words(whole.spacing)
        text += f", interpolated from cells of {cells} µm to {_lengths_in_words(part.spacing)} µm"
    return text


def _lengths_in_words(lengths: tuple[float, float]) -> str:
    """Return two lengths [m] along x and y as text, in µm."""
    return f"{lengths[0] * 1e6:.4g} x {lengths[1] * 1e6:.4g}"


def _common(axis: int, first: Surface, second: Surface) -> tuple[int, bool]:
    """Return (points, whether periodic) of the sum along ``axis``; both maps have the same spacing here."""
    lengths = [s.size[axis] for s in (first, second)]
    are_periodic = [s.periodic_axes[axis] for s in (first, second)]
    same = abs(lengths[0] / lengths[1] - 1) < EQUAL_LENGTHS
    if all(are_periodic) and same:
        return first.shape[axis], True
    open_lengths = [length for length, periodic in zip(lengths, are_periodic) if not periodic]
    return int(min(open_lengths or lengths) / first.spacing[axis] * (1 + EQUAL_LENGTHS)), False


def resample_axis(heights: np.ndarray, axis: int, count: int, ratio: float, *, periodic: bool) -> np.ndarray:
    """Return ``count`` cells of ``ratio`` old cells each along ``axis``, from the start of the map.

    Periodic: the Fourier series at the new cell centres. Open: heights are taken as cell averages;
    a cubic spline through their running integral gives the averages over the new cells, coarser or
    finer. It conserves the integral and changes nothing at ratio 1.
    """
    z = np.moveaxis(heights, axis, 0)
    if periodic:
        from scipy import fft

        n = len(z)
        keep = min(len(z), count) // 2 + 1
        spectrum = np.zeros((count // 2 + 1, z.shape[1]), complex)
        spectrum[:keep] = fft.rfft(z, axis=0)[:keep]
        shift = 0.5 * (n / count - 1) / n  # from old to new cell centres, in periods
        spectrum *= np.exp(2j * np.pi * shift * np.arange(len(spectrum)))[:, None]
        even = min(n, count)
        if even % 2 == 0 and n != count:  # the highest mode is shared by +k and -k
            spectrum[even // 2] *= 2.0 if count < n else 0.5
        new = fft.irfft(spectrum, count, axis=0) * (count / n)
    else:
        from scipy.interpolate import CubicSpline

        integral = np.concatenate([np.zeros((1, z.shape[1])), np.cumsum(z, axis=0)])
        edges = np.minimum(ratio * np.arange(count + 1), len(z))
        new = np.diff(CubicSpline(np.arange(len(z) + 1), integral)(edges), axis=0) / ratio
    return np.moveaxis(new, 0, axis)
