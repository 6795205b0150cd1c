"""Checks of what a `lubfric.Surface` is made from."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .._base import validate
from ..errors import InputError

MOST_POINTS = 2**26  # of any map, 512 MiB of heights


def mask(given: Any, heights: Any, shape: tuple[int, ...]) -> np.ndarray | None:
    """A copy of the mask ``given``, without the points that a masked array masks. None where every point is
    measured."""
    found = np.ones(shape, bool) if given is None else np.array(given)
    if found.dtype.kind != "b" or found.shape != shape:
        raise InputError(
            f"mask has shape {found.shape} and type {found.dtype}; allowed: true (measured) and false in shape {shape}"
        )
    if np.ma.is_masked(heights):
        found &= ~np.ma.getmaskarray(heights)
    if found.size and not found.any():
        raise InputError(f"mask has 0 measured points of {found.size}; allowed: at least 1")
    return None if found.all() else found


def points(name: str, shape: tuple[int, ...]) -> None:
    """Check that a grid of that many points fits into memory."""
    if math.prod(shape) > MOST_POINTS:
        raise InputError(
            f"{name} = {validate.shown(shape)} has {float(math.prod(shape)):.3g} points; "
            f"allowed: up to {MOST_POINTS:.3g}"
        )


def two_booleans(name: str, value: Any) -> tuple[bool, bool]:
    """A pair of true and false, for x and y."""
    several = isinstance(value, (tuple, list)) or isinstance(value, np.ndarray) and value.ndim == 1
    if not several or len(value) != 2:
        raise InputError(f"{name} = {validate.shown(value)}; allowed: a pair of true and false, for x and y")
    return validate.boolean(f"{name}[0]", value[0]), validate.boolean(f"{name}[1]", value[1])
