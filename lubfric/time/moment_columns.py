"""The columns of a moment that do not depend on the model: its motion, its power loss, the ends of its film."""

import math

import numpy as np

from ..estimate import power_of_forces
from ..scene import Scene
from .march import Progress
from .scene_in_time import transient_of


def sense_of(speed: float) -> float:
    """Return the sense of a ``speed``: 1 or -1, and 1 at rest."""
    return -1.0 if speed < 0 else 1.0


def sense_of_friction(scene: Scene, sliding: float) -> float:
    """Return the sense in which f is positive: that of ``sliding`` [m/s], or of the entrainment of ``scene`` where
    nothing slides."""
    return sense_of(sliding if sliding != 0 else scene.motion.entrainment_speed)


def motion_columns(
    now: Progress, scene: Scene, *, sliding: float, force: float, rolling_resistance: float
) -> dict[str, float]:
    """Return the columns of the moment that a run has reached, at which ``scene`` holds: its motion, its power loss,
    and the step that ended there.

    ``sliding``: the sliding speed [m/s]; ``force``: the friction force [N] on surface 2, positive along -x;
    ``rolling_resistance`` [N]: against the entrainment.
    """
    speed = scene.motion.entrainment_speed
    return {
        "time": now.time,
        "angle_of_rotation": transient_of(scene).angle_at(now.time),
        "entrainment_speed": speed,
        "sliding_speed": sliding,
        "load": scene.bodies.load,
        "friction_force": force,
        "rolling_resistance": rolling_resistance,
        "power_loss": power_of_forces(force, sense_of(speed) * rolling_resistance, speed, sliding),
        "time_error": now.error,
        "steps": now.steps,
    }


def ends_of_film(wet: np.ndarray) -> dict[str, float]:
    """Return the columns with the ends of the pressurised film, whose nodes are at ``wet`` [m], rising; NaN without a
    film."""
    if not wet.size:
        return {"wet_from": math.nan, "wet_to": math.nan}
    return {"wet_from": wet[0], "wet_to": wet[-1]}
