"""The power that a point takes: the friction forces on both surfaces times their speeds."""

import math
from dataclasses import replace

from ..scene import Scene
from .result import FrictionResult

# Relative model-form error of the rolling resistance of rough surfaces by load sharing, at 95 %: OF_ROLLING/Λ², between
# these bounds. Load sharing has that of the smooth film. Compared with the deterministic model on moving roughness, it
# is off by -6.5 and +5.5 % at Λ of 0.70 and 0.31, and by at most 0.9 % from 1.7 to 15 (built-in contact and the bearing of
# docs/start.md in pure rolling).
OF_ROLLING = 0.08

# Least of these errors.
LEAST_OF_ROLLING = 0.02

# Largest of these errors.
MOST_OF_ROLLING = 0.15


def rolling_model_error(lambda_ratio: float) -> float:
    """Return the relative model-form error of the rolling resistance by load sharing at a lambda ratio; 0 for smooth
    surfaces."""
    if lambda_ratio == math.inf:
        return 0.0
    if not lambda_ratio > 0:
        return MOST_OF_ROLLING
    return min(max(OF_ROLLING / lambda_ratio**2, LEAST_OF_ROLLING), MOST_OF_ROLLING)


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


def with_power_loss(scene: Scene, result: FrictionResult) -> FrictionResult:
    """Return ``result`` with its power loss, and the 95 % interval and the relative error of that.

    The sliding part has the interval of f. The rolling part has twice the estimated error of the rolling resistance,
    and by load sharing its model-form error (`rolling_model_error`); where the first is not known, the relative width of
    the interval of f. What the pressure on the flanks of moving
    roughness adds to the force on one surface, it takes from that on the other.
    """
    speed = abs(result.speed)
    ratio = scene.motion.slide_roll_ratio
    sense = -1.0 if ratio < 0 else 1.0
    sliding = ratio * speed
    load = scene.bodies.load

    def power(coefficient: float, resistance: float) -> float:
        return power_of_forces(sense * coefficient * load, resistance, speed, sliding)

    resistance = result.rolling_resistance
    loss = power(result.coefficient, resistance)
    known = result.errors.rolling_resistance
    of_model = 0.0 if result.decision.model == "deterministic" else rolling_model_error(result.lambda_ratio)
    rolling = resistance * (speed - 0.5 * sliding)
    ends = []
    for end in result.uncertainty.interval:
        by_sliding = (end - result.coefficient) * load * abs(sliding)
        of_rolling = math.hypot(2.0 * known, of_model) if math.isfinite(known) else abs(end / result.coefficient - 1.0)
        ends.append(math.hypot(by_sliding, of_rolling * rolling if rolling else 0.0))
    errors = result.errors
    of_resistance = math.hypot(known, 0.5 * of_model)
    parts = (errors.coefficient * abs(result.coefficient * load * sliding), of_resistance * rolling if rolling else 0.0)
    relative = math.hypot(*parts) / abs(loss) if loss else 0.0
    return replace(
        result,
        power_loss=loss,
        power_loss_interval=(loss - ends[0], loss + ends[1]),
        errors=replace(errors, power_loss=relative),
    )
