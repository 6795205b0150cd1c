"""The power that a point takes: the friction forces on both surfaces times their speeds."""

import math
from dataclasses import replace

from ..models import Model
from ..scene import Scene
from .result import FrictionResult


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


def with_power_loss(scene: Scene, result: FrictionResult, model: Model) -> FrictionResult:
    """Return ``result`` of ``model`` with its power loss, and the 95 % interval and the relative error of that.

    The sliding part has the interval of f. The rolling part has twice the estimated error of the rolling resistance
    and its model-form error (`Model.rolling_error`); where one of these is not known, the relative width of the
    interval of f. What the pressure on the flanks of moving roughness adds to the force on one surface, it takes from
    that on the other.
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
    of_model = model.rolling_error(result.lambda_ratio)
    rolling = resistance * (speed - 0.5 * sliding)
    is_known = math.isfinite(known + of_model)
    ends = []
    for end in result.uncertainty.interval:
        by_sliding = (end - result.coefficient) * load * abs(sliding)
        of_rolling = math.hypot(2.0 * known, of_model) if is_known else abs(end / result.coefficient - 1.0)
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
