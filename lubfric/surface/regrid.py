"""One axis of a `lubfric.Surface` on other points: made periodic, resampled, cut or repeated. Every function returns a
new map."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .._base import validate
from ..errors import InputError
from . import checks, prepare


def changed(surface, axis, heights, note, *, step=None, closed=None, mask=None):
    """A copy with new heights along one axis, and whatever else changes with them."""
    spacing, periodic = list(surface.spacing), list(surface.periodic_axes)
    spacing[axis] = spacing[axis] if step is None else step
    periodic[axis] = periodic[axis] if closed is None else closed
    return replace(
        surface,
        heights=heights,
        spacing=tuple(spacing),
        mask=mask,
        periodic_axes=tuple(periodic),
        notes=(*surface.notes, note),
    )


def closed(surface, axis: int, edge: str, count: int | None = None):
    """``surface`` made periodic along ``axis``; see `prepare.close_axis`."""
    heights = prepare.close_axis(surface.heights, axis, edge, count)
    mask = None if surface.mask is None else prepare.close_mask(surface.mask, axis, edge, count)
    note = f"made periodic along {'xy'[axis]}: {edge}"
    return changed(surface, axis, heights, note, closed=True, mask=mask)


def resampled(surface, axis: int, count: int | None, step: float | None):
    """``surface`` on ``count`` points along ``axis``, or on points ``step`` [m] apart; see `prepare.resample_axis`."""
    n, old = surface.shape[axis], surface.spacing[axis]
    closed = surface.periodic_axes[axis]
    if count is None:
        exact = n * old / step
        count = int(np.floor(min(exact, 1e15) * (1 + 1e-9)))
        closed = closed and abs(exact - round(exact)) < 1e-6
    else:
        step = n * old / count
    if count < 1:
        raise InputError(f"spacing[{axis}] = {step:g} m is longer than the map; allowed: up to {n * old:g} m")
    checks.points(f"points along {'xy'[axis]} and the other axis", (count, surface.shape[1 - axis]))
    if count == n and abs(step / old - 1) < 1e-9:
        return surface
    heights = prepare.resample_axis(surface.heights, axis, count, step / old, closed)
    note = f"resampled along {'xy'[axis]} from {n} points at {old:.4e} m to {count} at {step:.4e} m"
    if surface.mask is not None:
        note += f" (mask dropped, {100 * surface.missing_fraction:.3g} % was unmeasured)"
    return changed(surface, axis, heights, note, step=step, closed=closed)


def fitted(surface, axis: int, count: int, edge: str | None):
    """``surface`` on exactly ``count`` points of its own spacing along ``axis``: repeated where periodic, else cut."""
    if edge is not None:
        validate.choice("edge", edge, prepare.EDGES)
    n = surface.shape[axis]
    if count == n and (edge is None or surface.periodic_axes[axis]):
        return surface
    if surface.periodic_axes[axis] and (edge is None or count % n == 0):
        pick = np.arange(count) % n
        mask = None if surface.mask is None else np.take(surface.mask, pick, axis)
        return changed(
            surface,
            axis,
            np.take(surface.heights, pick, axis),
            closed=count % n == 0,
            mask=mask,
            note=f"{'repeated' if count > n else 'cut'} along {'xy'[axis]} from {n} to {count} points",
        )
    need = count if edge is None else prepare.points_to_close(count, edge)
    if need > n:
        raise InputError(
            f"patch of {count} points along {'xy'[axis]} needs {need} points of the map "
            f"({need * surface.spacing[axis]:g} m); allowed: up to {n} "
            f"({surface.size[axis]:g} m), or a periodic map"
        )
    shape = list(surface.shape)
    shape[axis] = need
    cut = surface.cropped(shape)
    return cut if edge is None else closed(cut, axis, edge, count)
