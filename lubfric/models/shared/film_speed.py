"""How the expected film depends on load and speed, with closed forms."""

import math
from dataclasses import replace

from ..._base import secant_root
from ...film import LineContact
from ...scene import Scene

# Relative step of a load or a speed for the exponents of Moes' film; half and twice as much change nothing that a test
# of 1e-6 sees, because these exponents vary slowly.
NUDGE = 1e-3

# Relative accuracy of the speed that gives a film: of a start or of a reference point, which needs no more. A choice: a
# smaller value takes longer.
SPEED_ACCURACY = 1e-6


def film_and_exponents(line: LineContact) -> tuple[float, float, float]:
    """Return the expected film h [m] of ``line``, and m and e of h ~ load^-m speed^e about it."""

    def change(other: LineContact) -> float:
        return math.log(other.expected_film / line.expected_film) / math.log1p(NUDGE)

    heavier = replace(line, load_per_width=(1 + NUDGE) * line.load_per_width)
    sliding = None if line.sliding is None else (1 + NUDGE) * line.sliding
    faster = replace(line, entrainment_speed=(1 + NUDGE) * line.entrainment_speed, sliding=sliding)
    return line.expected_film, -change(heavier), change(faster)


def speed_of(scene: Scene, thickness: float) -> float:
    """Return the speed [m/s] at which the expected film of the total load is ``thickness`` [m]. Raises
    `ConvergenceError`."""

    def excess(log_speed: float) -> float:
        return math.log(scene.line_contact(math.exp(log_speed)).expected_film / thickness)

    return math.exp(secant_root(excess, 0.0, accuracy=SPEED_ACCURACY))
