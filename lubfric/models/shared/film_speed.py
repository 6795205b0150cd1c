"""How the expected film depends on load and speed, with closed forms."""

import math
from dataclasses import replace

from ...film import LineContact
from ...scene import Scene

NUDGE = 1e-3  # of a load or a speed, for exponents of Moes' film


def exponents(line: LineContact) -> tuple[float, float, float]:
    """The expected film h [m] of ``line``, and m and e of h ~ load^-m speed^e about it."""

    def change(other: LineContact) -> float:
        return math.log(other.expected_film / line.expected_film) / math.log1p(NUDGE)

    heavier = replace(line, load_per_width=(1 + NUDGE) * line.load_per_width)
    sliding = None if line.sliding is None else (1 + NUDGE) * line.sliding
    faster = replace(line, entrainment_speed=(1 + NUDGE) * line.entrainment_speed, sliding=sliding)
    return line.expected_film, -change(heavier), change(faster)


def speed_of(scene: Scene, film: float) -> float:
    """Speed [m/s] at which the expected film of the total load is ``film`` [m], to a per cent."""
    speed = 1.0
    for _ in range(30):
        line = scene.line_contact(speed)
        exponent = exponents(line)[2]
        step = math.log(film / line.expected_film) / exponent
        speed *= math.exp(step)
        if abs(step) < 1e-6:
            break
    return speed
