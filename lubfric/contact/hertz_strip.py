"""The Hertz strip on a contact grid: cell centres, and the part of each cell that counts."""

from __future__ import annotations

import numpy as np

from .._base import validate
from ..errors import InputError
from ..scene import Scene

TOO_SHORT = (
    "surface.extension = 'mirror' (continues the map by its mirror image) or contact.geometry = 'flat' (its roughness "
    "spread over the strip)"
)


def centred_axis(count: int, step: float) -> np.ndarray:
    """Cell centres [m] of ``count`` cells around zero."""
    return (np.arange(count) - 0.5 * (count - 1)) * step


def strip_weight(x: np.ndarray, step: float, half_width: float) -> np.ndarray:
    """Part of each cell within |x| <= half_width; cells that its edge cuts count by their share."""
    inside = np.minimum(x + step / 2, half_width) - np.maximum(x - step / 2, -half_width)
    weight = np.clip(inside / step, 0.0, 1.0)
    if not weight.any():
        raise InputError(
            "contact.spacing: no cell of the contact grid lies in the Hertz strip of half-width "
            f"{validate.positive('half_width', half_width, 'm'):g} m; give finer ones"
        )
    return weight


def check_strip(scene: Scene, step: float, length: float) -> None:
    """Raise `InputError` if cells of ``step`` [m] do not resolve the strip, or a patch of ``length`` [m] does not
    contain it."""
    half_width = scene.bodies.half_width
    if step > half_width:
        raise InputError(
            f"contact.spacing = {step:.3g} m along x does not resolve the Hertz strip; allowed: at most "
            f"its half-width {half_width:.3g} m"
        )
    if length < 2 * half_width:
        generated = scene.surface.file is None
        what = "the patch (contact.shape x contact.spacing)" if generated else "the map"
        ways = "a larger contact.shape" if generated else f"a longer map, {TOO_SHORT}"
        raise InputError(
            f"{what} is {length:.3g} m long in x, the direction of motion; allowed: at least the Hertz strip, "
            f"{2 * half_width:.3g} m: {ways}"
        )


def area_weight(scene: Scene, x: np.ndarray, step: float) -> np.ndarray:
    """Part of each cell inside the area A of Eq. (8) that the scene asks for."""
    half_width = area_half_width(scene)
    return np.ones(x.size) if half_width is None else strip_weight(x, step, half_width)


def area_half_width(scene: Scene) -> float | None:
    """Half-width [m] of the area A; None: the whole patch."""
    return None if scene.contact.region == "box" else scene.bodies.half_width


def weighted_mean(values, weight) -> float:
    """Mean over the area A."""
    return float(np.dot(values, weight) / weight.sum())
