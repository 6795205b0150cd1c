"""The largest friction coefficient that the limits of the shear stress allow.

At no place is the shear stress larger than both f_b p, that of a boundary film, and the stress of the oil in the
thinnest film above a boundary film. So the sliding part of f is at most the mean of the larger of both over the load.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from ...oil import Lubricant, shear_stress
from ...scene import BOUNDARY_FRICTION_KEY, Scene, value_of
from .checks import peak_hertz_pressure
from .unknown_limit import LIMIT_RANGE

# Thinnest film [m] where the scene gives no boundary film: half of lubfric's own value, as in the error of f.
THINNEST_FILM = 10e-9

# Pressure [Pa] of films between asperities, up to which the stress of an oil over the pressure counts: above it,
# deterministic films were seen on few cells only. A convention.
MOST_PRESSURE = 3e9

# Pressures between the mean Hertz pressure and the largest at which the stress is evaluated: it is smooth there. A
# convention.
PRESSURES = 30

# Points of the Hertz pressure, at equal steps of the angle: the mean of a smooth stress is known to 1e-3. A convention.
HERTZ_POINTS = 60


def largest_of_oil(oil: Lubricant, boundary_friction: float, peak: float, sliding: float, thickness: float) -> float:
    """Return the largest sliding part of f [-] for an ``oil`` and f_b = ``boundary_friction``, under the Hertz pressure
    ``peak`` [Pa] that slides at ``sliding`` [m/s], where the thinnest film is ``thickness`` [m].

    The mean of the larger of both stresses is taken over the Hertz pressure, and the ratio of that of the oil to the
    pressure from the mean pressure to `MOST_PRESSURE`. A film without a limit of its own is limited to f_b p or, if
    that is more and the oil's limit is not stated, to the upper end of `LIMIT_RANGE` times p.
    """
    if oil.has_unlimited_stress:
        return boundary_friction if oil.is_limited_by_boundary_friction else max(boundary_friction, LIMIT_RANGE[1])
    angle = (np.arange(HERTZ_POINTS) + 0.5) * math.pi / HERTZ_POINTS
    hertz = peak * np.sin(angle)
    higher = np.geomspace(math.pi / 4 * peak, max(MOST_PRESSURE, peak), PRESSURES)
    with np.errstate(over="ignore"):
        of_hertz, of_higher = (shear_stress(oil, pressure, sliding / thickness) for pressure in (hertz, higher))
    weight = np.sin(angle)  # of the place x = -a cos(angle)
    mean = float(np.sum(np.maximum(of_hertz, boundary_friction * hertz) * weight) / np.sum(hertz * weight))
    return max(mean, float(np.max(of_higher / higher)))


@dataclass(frozen=True, kw_only=True)
class Sliding:
    """What the largest f depends on beside the inputs of a scene: ``load`` [N], reduced ``radius`` [m], and ``speed``
    [m/s] of sliding, its magnitude."""

    load: float
    radius: float
    speed: float


def largest_sliding_friction(scene: Scene, speed: float) -> float:
    """Return the largest sliding part of f [-] of ``scene`` at ``speed`` [m/s], with its inputs at those ends of their
    ranges that allow the most; infinite in pure rolling, where no stress is at a limit by sliding."""
    sliding = abs(scene.motion.slide_roll_ratio * speed)
    return largest_of_each(scene, [Sliding(load=scene.bodies.load, radius=scene.bodies.radius, speed=sliding)])[0]


def beside_asperities(largest: float, boundary_friction: float, film_load_ratio: float) -> float:
    """Return the largest sliding part of f [-] where the film carries at most ``film_load_ratio`` of the load and
    asperities carry the rest, at no more than f_b = ``boundary_friction``; ``largest``: that where it may be either."""
    if not boundary_friction < largest < math.inf:
        return largest
    return boundary_friction + (largest - boundary_friction) * film_load_ratio


def largest_boundary_friction(scene: Scene) -> float:
    """Return f_b [-] of ``scene``, at the upper end of its range if it has one."""
    return _at_largest_boundary_friction(scene).bodies.boundary_friction_coefficient


def largest_of_each(scene: Scene, moments: list[Sliding]) -> list[float]:
    """Return the largest sliding part of f [-] of ``scene`` at each of the ``moments``, infinite where it does not
    slide.

    The inputs that have a range are at those ends that allow the most at that moment. f_b is always at its upper end:
    where the stress of the oil is the larger, f_b does not change the bound.
    """
    at_f_b = _at_largest_boundary_friction(scene)
    nominal = replace(at_f_b, ranges=())
    candidates = {name: (nominal, *ends) for name, *ends in at_f_b.at_ends()}
    scenes: dict[tuple[float, ...], Scene] = {}
    largest = []
    for moment in moments:
        best = {
            name: value_of(max(each, key=lambda end: _largest_at(end, moment)), name)
            for name, each in candidates.items()
        }
        values = tuple(best.values())
        if values not in scenes:
            scenes[values] = nominal.with_keys(best) if best else nominal
        largest.append(_largest_at(scenes[values], moment))
    return largest


def _at_largest_boundary_friction(scene: Scene) -> Scene:
    """Return ``scene`` with f_b at the upper end of its range, if it has one; the other ranges are kept."""
    ends = [most for name, _, most in scene.ranges if name == BOUNDARY_FRICTION_KEY]
    return scene.with_keys({BOUNDARY_FRICTION_KEY: ends[0]}) if ends else scene


def _largest_at(scene: Scene, moment: Sliding) -> float:
    """Return the `largest_of_oil` of ``scene``, whose ranges do not count, at a ``moment``; infinite where it does not
    slide."""
    if moment.speed == 0:
        return math.inf
    bodies = scene.bodies
    film = THINNEST_FILM if bodies.boundary_film is None else bodies.boundary_film
    load_over_radius = moment.load / bodies.load * bodies.radius / moment.radius
    peak = peak_hertz_pressure(scene) * math.sqrt(load_over_radius)
    return largest_of_oil(scene.lubricant, bodies.boundary_friction_coefficient, peak, moment.speed, film)
