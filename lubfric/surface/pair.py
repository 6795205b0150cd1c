"""Two rough surfaces that face each other, as one map.

The gap between them is h - z1 - z2 with both heights measured outwards, so that one rigid smooth body against the sum
is the same contact (half-spaces: E' already holds both bodies). The second body is turned over about x, the direction
of motion: its x stays and its y runs backwards.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..errors import InputError

SAME = 1e-9  # relative difference of lengths that are equal


def combined(first, second):
    """z1(x, y) + z2(x, -y), on the finer of both spacings along each axis, over the length that both have.

    If both are periodic along an axis with the same length, the sum is periodic too. Otherwise the shorter length
    counts, cut around the middle, and the sum is open. (A periodic map is repeated to reach the length of an open one.)
    The heights are taken about their means. Raises `InputError` for maps with unmeasured points: level and fill first.
    """
    for name, surface in (("first", first), ("second", second)):
        if not np.isfinite(surface.heights).all():
            raise InputError(f"{name} surface has unmeasured points (NaN); call level() and fill() first")
    second = replace(
        second, heights=second.heights[:, ::-1], mask=None if second.mask is None else second.mask[:, ::-1]
    )
    spacing = tuple(min(a, b) for a, b in zip(first.spacing, second.spacing))
    parts = [surface.resampled(spacing=spacing) for surface in (first, second)]
    shape, closed = zip(*(_common(axis, *parts) for axis in range(2)))
    parts = [part.patch(shape) for part in parts]
    masks = [np.ones(shape, bool) if part.mask is None else part.mask for part in parts]
    names = [surface.source or "a map" for surface in (first, second)]
    return replace(
        parts[0],
        heights=sum(part.heights - part.heights.mean() for part in parts),
        mask=masks[0] & masks[1],
        periodic_axes=closed,
        source=" and ".join(names),
        notes=(
            *(f"first: {note}" for note in parts[0].notes),
            *(f"second: {note}" for note in parts[1].notes),
            f"combined: Sq {first.sq:.4e} m and {second.sq:.4e} m, the second turned over about x",
        ),
    )


def _common(axis: int, first, second) -> tuple[int, bool]:
    """(points, whether periodic) of the sum along ``axis``; both maps have the same spacing here."""
    lengths, closed = [s.size[axis] for s in (first, second)], [s.periodic_axes[axis] for s in (first, second)]
    same = abs(lengths[0] / lengths[1] - 1) < SAME
    if all(closed) and same:
        return first.shape[axis], True
    open_lengths = [length for length, periodic in zip(lengths, closed) if not periodic]
    return int(min(open_lengths or lengths) / first.spacing[axis] * (1 + SAME)), False
