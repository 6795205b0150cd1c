"""The power that a point takes: the friction forces on both surfaces times their speeds."""

import math
from dataclasses import dataclass

from ..scene import Scene


def power_of_forces(force: float, resistance: float, entrainment: float, sliding: float) -> float:
    """Return the power [W] that keeps both surfaces moving.

    The friction forces on surfaces 1 and 2 are F_1 and F_2 along the motion, positive where they resist it. The power
    is F_1 u_1 + F_2 u_2 = F_2 (u_2 - u_1) + (F_1 + F_2) u_1. Their sum F_1 + F_2 is what rolling resists, because shear
    by sliding acts on the surfaces in opposite directions. The power equals what the film and the asperity contacts
    dissipate (docs/theory.md).

    Parameters
    ----------
    force : F_2 [N], on surface 2
    resistance : F_1 + F_2 [N]
    entrainment : U = (u_1 + u_2)/2 [m/s]
    sliding : u_2 - u_1 [m/s]
    """
    return force * sliding + resistance * (entrainment - 0.5 * sliding)


@dataclass(frozen=True, kw_only=True)
class PowerLoss:
    """The power loss of a point [W], its 95 % ``interval`` [W], its relative standard ``error``, and the 95 % interval
    of the rolling resistance [N]; NaN: not known."""

    value: float
    interval: tuple[float, float]
    error: float
    resistance_interval: tuple[float, float]


def power_loss_of(
    scene: Scene,
    *,
    speed: float,
    coefficient: float,
    interval: tuple[float, float],
    coefficient_error: float,
    resistance: float,
    resistance_error: float,
    resistance_model_error: float,
) -> PowerLoss:
    """Return the power loss at an entrainment ``speed`` [m/s], with its interval and its error.

    The sliding part has the interval of f. The rolling part has twice the estimated error of the rolling resistance
    and its model-form error (`Model.rolling_error`); where one of these is not known, the relative width of the
    interval of f. What the pressure on the flanks of moving roughness adds to the force on one surface, it takes from
    that on the other.

    Parameters
    ----------
    coefficient : f [-], with its 95 % ``interval`` and its relative standard error ``coefficient_error``
    resistance : rolling resistance [N], with its relative standard error ``resistance_error`` and its relative
        model-form error at 95 %, ``resistance_model_error``; NaN: not known
    """
    speed = abs(speed)
    ratio = scene.motion.slide_roll_ratio
    sense = -1.0 if ratio < 0 else 1.0
    sliding = ratio * speed
    load = scene.bodies.load
    loss = power_of_forces(sense * coefficient * load, resistance, speed, sliding)
    rolling = resistance * (speed - 0.5 * sliding)
    of_resistance = math.hypot(2.0 * resistance_error, resistance_model_error)
    distances = []
    for end in interval:
        by_sliding = (end - coefficient) * load * abs(sliding)
        of_rolling = of_resistance if math.isfinite(of_resistance) else abs(end / coefficient - 1.0)
        distances.append(math.hypot(by_sliding, of_rolling * rolling if rolling else 0.0))
    by_rolling = 0.5 * of_resistance * rolling if rolling else 0.0
    distance = of_resistance * abs(resistance)
    parts = (coefficient_error * abs(coefficient * load * sliding), by_rolling)
    return PowerLoss(
        value=loss,
        interval=(max(loss - distances[0], min(loss, 0.0)), loss + distances[1]),  # no contact delivers power
        error=math.hypot(*parts) / abs(loss) if loss else 0.0,
        resistance_interval=(resistance - distance, resistance + distance),
    )
