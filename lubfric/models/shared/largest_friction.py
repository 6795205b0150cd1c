"""The largest friction coefficient that the limits of the shear stress allow.

At no place is the shear stress larger than both f_b p, that of a boundary film, and the stress of the oil in the
thinnest film above a boundary film. So the sliding part of f is at most the mean of the larger of both over the load.
"""

import math
from dataclasses import replace

import numpy as np

from ...oil import Lubricant, shear_stress
from ...scene import Scene, value_of
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


def largest_sliding_friction(scene: Scene, speed: float) -> float:
    """Return the largest sliding part of f [-] of ``scene`` at ``speed`` [m/s], with its inputs at those ends of their
    ranges that allow the most; infinite in pure rolling, where no stress is at a limit by sliding."""
    sliding = abs(scene.motion.slide_roll_ratio * speed)
    return largest_at_load(at_largest_ends(scene, sliding), scene.bodies.load, sliding)


def at_largest_ends(scene: Scene, sliding: float) -> Scene:
    """Return ``scene`` with each input that has a range at that end of it that allows the largest f, where the surfaces
    slide at ``sliding`` [m/s]."""
    most = {}
    for name, *ends in scene.at_ends():
        end = max((scene, *ends), key=lambda each: largest_at_load(each, each.bodies.load, sliding))
        most[name] = value_of(end, name)
    return replace(scene, ranges=()).with_keys(most) if most else scene


def largest_at_load(scene: Scene, load: float, sliding: float) -> float:
    """Return the `largest_of_oil` of ``scene``, whose ranges do not count, under a ``load`` [N] that slides at
    ``sliding`` [m/s]; infinite where it does not slide."""
    if sliding == 0:
        return math.inf
    bodies = scene.bodies
    film = THINNEST_FILM if bodies.boundary_film is None else bodies.boundary_film
    peak = peak_hertz_pressure(scene) * math.sqrt(load / bodies.load)
    return largest_of_oil(scene.lubricant, bodies.boundary_friction_coefficient, peak, sliding, film)
