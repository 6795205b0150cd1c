"""The speeds between which a contact passes from boundary lubrication to full film, and the first ones to solve."""

from __future__ import annotations

import math

from scipy.optimize import brentq

from ..errors import InputError
from ..scene import Scene

THIN, THICK = 0.02, 10.0  # Moes' film of the whole load over Sq at the ends
MIXED = (0.5, 1.5, 4.5)  # the same where the contact carries about 0.9, 0.5 and nothing of the load
FEWEST = 5  # speeds to begin with
SLOWEST, FASTEST = 1e-9, 1e3  # m/s between which they are looked for


def span(scene: Scene, sq: float) -> tuple[float, float]:
    """(lowest, highest) entrainment speed [m/s] of a curve: those of ``motion.speeds``. Without these, the speeds at
    which Moes' film of the whole load is 0.02 and 10 times Sq.

    Raises `InputError` for negative speeds, and for a smooth surface without speeds, which has no such range.
    """
    if any(u < 0 for u in scene.motion.speeds):
        raise InputError(
            "speeds = 'auto' runs forwards, and motion.speeds backwards; give motion.speed_range, or speeds in m/s"
        )
    speeds = sorted({u for u in scene.motion.speeds if u != 0})
    if len(speeds) > 1:
        return speeds[0], speeds[-1]
    if sq <= 0:
        raise InputError("speeds = 'auto' of a smooth surface (Sq = 0 m) needs a range; give motion.speed_range in m/s")
    if film_ratio(scene, sq, SLOWEST) > THIN or film_ratio(scene, sq, FASTEST) < THICK:
        raise InputError(
            "speeds = 'auto' finds no range from boundary lubrication to a full film; give motion.speed_range"
        )
    return _speed_of(scene, sq, THIN, SLOWEST, FASTEST), _speed_of(scene, sq, THICK, SLOWEST, FASTEST)


def first_speeds(scene: Scene, sq: float) -> tuple[float, ...]:
    """The first speeds [m/s], fastest first, at least 5: both ends of `span`, and where Moes' film under the whole load
    is 0.5, 1.5 and 4.5 times Sq, because there rough line contacts pass from boundary lubrication to full film."""
    low, high = span(scene, sq)
    found = [low, high]
    if sq > 0:
        inside = [
            ratio
            for ratio in MIXED
            if film_ratio(scene, sq, low) < 0.9 * ratio and 1.1 * ratio < film_ratio(scene, sq, high)
        ]
        found += [_speed_of(scene, sq, ratio, low, high) for ratio in inside]
    while len(found) < FEWEST:
        found.sort()
        _, at = max((math.log(b / a), i) for i, (a, b) in enumerate(zip(found, found[1:])))
        found.append(math.sqrt(found[at] * found[at + 1]))
    return tuple(sorted(found, reverse=True))


def film_ratio(scene: Scene, sq: float, speed: float) -> float:
    """Moes' film of the whole load over Sq."""
    return scene.line_contact(speed).moes_film / sq


def _speed_of(scene: Scene, sq: float, ratio: float, low: float, high: float) -> float:
    """The speed [m/s] between ``low`` and ``high`` at which `film_ratio` is ``ratio``."""

    def excess(log_speed: float) -> float:
        return math.log(film_ratio(scene, sq, math.exp(log_speed)) / ratio)

    return math.exp(brentq(excess, math.log(low), math.log(high), xtol=1e-6))
