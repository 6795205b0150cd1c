"""The speeds between which a contact passes from boundary lubrication to a full film."""

from __future__ import annotations

import math

from scipy.optimize import brentq

from ..errors import InputError
from ..line_contact import LineContact
from ..prepared import Prepared

THIN, THICK = 0.02, 10.0  # Moes' film of the whole load over Sq at the ends
SLOWEST, FASTEST = 1e-9, 1e3  # m/s between which they are looked for


def span(prepared: Prepared) -> tuple[float, float]:
    """(lowest, highest) entrainment speed [m/s] of a curve: those of ``motion.speeds``, or else where the film that
    Moes' formula gives the whole load is 0.02 and 10 times Sq.

    Raises `InputError` for a smooth surface without speeds, which has no such range.
    """
    speeds = sorted({abs(u) for u in prepared.scene.motion.speeds if u != 0})
    if len(speeds) > 1:
        return speeds[0], speeds[-1]
    sq = prepared.surface.sq
    if sq <= 0:
        raise InputError(
            "speeds = 'auto' of a smooth surface (Sq = 0 m) needs a range; allowed: motion.speed_range in m/s"
        )

    bodies, lubricant = prepared.scene.bodies, prepared.scene.lubricant

    def excess(log_speed: float, ratio: float) -> float:
        line = LineContact(bodies.load / bodies.width, bodies.radius, bodies.e_prime, math.exp(log_speed), lubricant)
        return math.log(line.moes_film / (ratio * sq))

    ends = math.log(SLOWEST), math.log(FASTEST)
    if excess(ends[0], THIN) > 0 or excess(ends[1], THICK) < 0:
        raise InputError(
            "speeds = 'auto' finds no range from boundary lubrication to a full film; allowed: motion.speed_range"
        )
    low, high = (math.exp(brentq(excess, *ends, args=(ratio,), xtol=1e-6)) for ratio in (THIN, THICK))
    return low, high
