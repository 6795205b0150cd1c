"""The rolling resistance where roughness moves: that of the smooth film, and its error.

The resistance is the moment of the load about the line of contact, over R. On a strip of moving roughness that moment
is the sum of large parts, in which the summits just passing leave several times its mean: on a needle roller of Λ = 0.4
-0.4 to +0.3 N on three strips, where the smooth film has 0.3 N. So the film without roughness gives it.
"""

import math
from dataclasses import replace

import numpy as np

from ...film import Effort, shear_force, solve_line_contact
from ...scene import Scene
from .heat import film_lubricant

# Relative model-form error of the rolling resistance of rough surfaces by the smooth film, at 95 %: OF_RESISTANCE/Λ²,
# between the bounds below. Compared with long marches of the deterministic model in pure rolling, the smooth film is
# off by -6.5 and +5.5 % at Λ of 0.70 and 0.31, and by at most 0.9 % from 1.7 to 15 (built-in contact and the bearing of
# docs/start.md).
OF_RESISTANCE = 0.08

# Least of these errors. A choice: twice what was seen.
LEAST_OF_RESISTANCE = 0.02

# Largest of these errors. A choice: more than twice what was seen.
MOST_OF_RESISTANCE = 0.15

# Power of the load of the film in its rolling resistance, with Johnson's modulus of Eq. (8) [-], at most: 0.22 to 0.28 at
# five points of a gear flank, 0.5 in the scene "paper" at 0.02 m/s. Measured.
RESISTANCE_BY_LOAD = 0.5

# Share of the load on the film, at least, at which its resistance is solved: below it, the resistance is too small to
# matter beside friction. A choice: a smaller value meets films that do not converge.
LEAST_FILM_SHARE = 1e-3

# Relative tolerance of the film. A choice, far below the error of this resistance.
RESISTANCE_TOLERANCE = 3e-3


def rolling_model_error(lambda_ratio: float) -> float:
    """Return the relative model-form error of the rolling resistance by the smooth film at a lambda ratio; 0 for smooth
    surfaces."""
    if lambda_ratio == math.inf:
        return 0.0
    if not lambda_ratio > 0:
        return MOST_OF_RESISTANCE
    return min(max(OF_RESISTANCE / lambda_ratio**2, LEAST_OF_RESISTANCE), MOST_OF_RESISTANCE)


def rolling_error_by_load(film_growth: float) -> float:
    """Return the relative error of the rolling resistance of a film that may carry ``film_growth`` times its load."""
    return float(film_growth**RESISTANCE_BY_LOAD) - 1.0


def smooth_rolling_resistance(scene: Scene, speed: float, film_load: float) -> tuple[float, float]:
    """Return the rolling resistance [N] of both surfaces together, against the entrainment at ``speed`` [m/s], by a
    smooth film that carries ``film_load`` [N], and its relative error.

    The film has Johnson's modulus, as in Eq. (8) (Akchurin et al. 2015, doi:10.1007/s11249-015-0536-z). Raises
    `ConvergenceError`.
    """
    bodies = scene.bodies
    share = max(film_load / bodies.load, LEAST_FILM_SHARE)
    line = replace(
        scene.line_contact(abs(speed)),
        load_per_width=share * bodies.load / bodies.width,
        e_prime=share * bodies.e_prime,
        lubricant=film_lubricant(scene, abs(speed)),
    )
    film = solve_line_contact(line, Effort(RESISTANCE_TOLERANCE, 0))
    shear = shear_force(
        film,
        line.lubricant,
        slide_roll_ratio=0.0,
        width=bodies.width,
        contact_fraction=lambda x: np.zeros(x.size - 1),
        warm=line.lubricant.viscosity,
    )
    _, error = film.rolling or (0.0, math.nan)
    return shear.resistance, 2.0 * bodies.width * error / shear.resistance
