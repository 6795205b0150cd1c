"""Contact that a finite line misses by chance, where its film just clears its summits."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..._base import FloatArray
from ...surface import rms_slope
from .forces import Forces
from .scatter import SPOT

if TYPE_CHECKING:
    from ...contact import HalfSpaceContact
    from ...film import EHLResult
    from ...scene import Scene
    from ...surface import Surface


# Blocks below which nothing is known [-]. A choice: fewer have no scale.
FEWEST_BLOCKS = 4

# Blocks with which the scale of the extreme values is known: 14 blocks of `SPOT` correlation lengths are 25 of these. A
# choice: a larger value widens more intervals.
BLOCKS_FOR_SCALE = 14

# Factor on the scale that fewer blocks show. Not measured: that scale is known to 1/sqrt(2 (n - 1)), 40 % with four.
UNSURE_SCALE = 2.0

# Mean of (excess/scale)^1.5 of an exponential excess. It follows from ∫ x^1.5 exp(-x) dx = Γ(2.5).
OVERLAP = math.gamma(2.5)

# Relative effect on f below which contact on summits that a short line does not show is as good as none [-]. A choice:
# a tenth of the usual tolerance on f.
NEGLIGIBLE = 1e-3

# Euler's constant: the mean of the standard Gumbel distribution. By definition.
EULER = 0.5772156649


def undetected_contact(
    scene: Scene,
    rough_contact: HalfSpaceContact,
    *,
    film: EHLResult,
    forces: Forces,
    correlation_length: float,
    whole: Surface,
) -> float:
    """Return the relative effect of `undetected_load` on f. Where ``rough_contact`` has too few cells along y for that,
    it is that of `load_of_tail` of the ``whole`` map if it is below `NEGLIGIBLE`, because the film clears all summits
    that such heights have; else NaN."""
    if not forces.coefficient:
        return math.nan
    under = film.film_at(rough_contact.x)
    bodies = scene.bodies
    load = undetected_load(
        rough_contact.heights,
        rough_contact.spacing,
        thickness=under,
        e_prime=bodies.e_prime,
        width=bodies.width,
        correlation_length=correlation_length,
    )
    if math.isnan(load):
        step = rough_contact.spacing[0]
        load = load_of_tail(whole, thickness=under, step=step, e_prime=bodies.e_prime, width=bodies.width)
        effect = _effect_on_f(scene, load, forces)
        return effect if effect < NEGLIGIBLE else math.nan
    return _effect_on_f(scene, load, forces)


def load_of_tail(surface: Surface, *, thickness: FloatArray, step: float, e_prime: float, width: float) -> float:
    """Return the expected contact load [N] of the full ``width`` [m] under a film of ``thickness`` [m] (nx,), on
    columns ``step`` [m] wide, if the heights of all of it are distributed as those of the map ``surface``.

    On an area A of a Gaussian surface with the rms slopes s_x and s_y, A s_x s_y z exp(-z²/2)/(Sq² (2 π)^1.5) summits
    are expected to be higher than z Sq, for z well above 1 (R. J. Adler, The Geometry of Random Fields, Wiley 1981).
    Each is pressed in by an exponential excess of the scale Sq/z, as a sphere of the radius of the highest summit.
    Where the highest summit of the map is higher than that which is expected of a Gaussian map of its size, Sq is
    larger in proportion. Infinite where the film is thinner than the Sq of these summits.
    """
    if surface.sq == 0:
        return 0.0
    along, across, _ = rms_slope(surface)
    density = along * across / (surface.sq**2 * (2 * math.pi) ** 1.5)
    expected = math.sqrt(2 * math.log(max(density * surface.size[0] * surface.size[1], math.e)))
    heights = surface.heights - surface.heights.mean()
    sq = max(surface.sq, float(heights.max()) / expected)
    z = thickness / sq
    if z.min() <= 1:
        return math.inf
    summits = density * step * width * z * np.exp(-0.5 * z**2)
    radius = summit_radius(heights, surface.spacing)
    loads = 4 / 3 * 0.5 * e_prime * math.sqrt(radius) * (sq / z) ** 1.5 * OVERLAP
    return float(np.sum(summits * loads))


def undetected_load(
    heights: FloatArray,
    spacing: tuple[float, float],
    *,
    thickness: FloatArray,
    e_prime: float,
    width: float,
    correlation_length: float,
) -> float:
    """Return the expected contact load [N] of the full width on summits higher than the highest one of the line, to an
    order of magnitude.

    The least clearances of short blocks along y follow an extreme-value (Gumbel) distribution, which is fitted by its
    first two moments. It shows how many blocks lie below zero, exp(-...), and the scale a of their heights. Each
    carries as much as a sphere of the highest summit's radius r that is pressed in by an exponential excess of scale
    a: (4/3) (E'/2) sqrt(r) a^1.5 1.33. Fewer than 14 blocks may show too small a scale, so twice their scale is taken.
    """
    height = heights - thickness[:, None]
    step = spacing[1]
    size = max(1, round(SPOT * correlation_length / step))
    rows = height.max(axis=0)
    blocks = rows[: rows.size // size * size].reshape(-1, size).max(axis=1)
    if blocks.size < FEWEST_BLOCKS:
        return math.nan
    scale = (
        float(blocks.std(ddof=1)) * math.sqrt(6) / math.pi * (UNSURE_SCALE if blocks.size < BLOCKS_FOR_SCALE else 1.0)
    )
    place = float(blocks.mean()) - EULER * scale
    if scale == 0:
        return 0.0
    rate = -math.expm1(-math.exp(min(place / scale, 50.0)))  # of blocks that touch
    summit_load = _load_on_summit(heights, spacing, e_prime, scale) * OVERLAP
    return rate * summit_load / (size * step) * width


def hidden_contact(scene: Scene, rough_contact: HalfSpaceContact, forces: Forces, depth: float) -> float:
    """Return the relative effect on f of the highest summit of ``rough_contact``, a piece, that is pressed ``depth``
    [m] into a body, if every such piece has one."""
    bodies = scene.bodies
    length = rough_contact.heights.shape[1] * rough_contact.spacing[1]
    load = _load_on_summit(rough_contact.heights, rough_contact.spacing, bodies.e_prime, depth) / length * bodies.width
    return _effect_on_f(scene, load, forces)


def _effect_on_f(scene: Scene, load: float, forces: Forces) -> float:
    """Return the relative effect of a contact ``load`` [N] on f: by its own friction, where the surfaces slide, or by
    the load that the film loses, to whose friction that is at most in proportion."""
    bodies = scene.bodies
    f = abs(forces.coefficient)
    boundary_friction = bodies.boundary_friction_coefficient if scene.motion.slide_roll_ratio else 0.0
    return load / bodies.load * max(boundary_friction / f, 1.0) if f else math.inf


def _load_on_summit(heights: FloatArray, spacing: tuple[float, float], e_prime: float, depth: float) -> float:
    """Return the load [N] of the highest summit, as a sphere that is pressed in by ``depth`` [m]."""
    return 4 / 3 * 0.5 * e_prime * math.sqrt(summit_radius(heights, spacing)) * depth**1.5


def summit_radius(heights: FloatArray, spacing: tuple[float, float]) -> float:
    """Return the radius [m] of the highest summit that has neighbours on all sides, the geometric mean of both axes."""
    z = heights
    (dx, dy) = spacing
    i, j = np.unravel_index(int(z[1:-1].argmax()), z[1:-1].shape)
    i += 1
    columns = z.shape[1]
    along = (2 * z[i, j] - z[i - 1, j] - z[i + 1, j]) / dx**2
    across = (2 * z[i, j] - z[i, j - 1] - z[i, (j + 1) % columns]) / dy**2
    return 1.0 / math.sqrt(max(along, 1e-3) * max(across, 1e-3))
