"""Newton steps that strips and patches at rest are expected to take, by closed forms.

Those of flooded and starved contacts follow from the number of columns of cells along x. Their constants are fitted to
286 solves of random patches of ``verification.campaigns.estimates``, on 2 to 6 lengths of cells each. Of 86 random
strips of Hertz pressures up to 1.5 GPa, with Hertz half-widths of 1 to 40 correlation lengths, 94 % take them within a
factor of 2, and 87 % on cells twice as long; those of 64 rows above 1 GPa take 55 and 122 steps where one place
resists. The constants of starved and soft strips are fitted to 34 with .15 to 1 of the film that would flow in, and 40
of E' 0.2 to 20 GPa and up to 60 MPa. Those without a solution count as 300 steps.
"""

import math
from dataclasses import dataclass

from ...film import LineContact
from ...scene import Scene
from ..shared import peak_hertz_pressure
from .counted_work import work_of_steps
from .problem import are_soft
from .solve import MOST_FACTORISATIONS

# Newton steps on one column of cells along x, which is not pressed [-]; times the columns to the power
# `STEPS_BY_COLUMNS`, and the exponential of `STEPS_BY_PRESSING` times how far a thin film is pressed between conforming
# bodies (`_pressed`). Fitted: the last 0.06 to patches alone, 0.1 with the times of runs at rest; a tenth of the
# patches takes 50 to 570 steps, most of all in films below 0.1 Sq, for which the first has 20 % more than the fit. It
# was 2.5; `state.STRONG_SUCTION_UPSTREAM` saves 6 % of the work of 38 random runs at rest.
COLUMN_STEPS = 2.35
STEPS_BY_COLUMNS = 0.29
STEPS_BY_PRESSING = 0.1

# Logarithm of the lambda ratio below which this pressing begins [-]: Λ 1.6. Fitted.
STEPS_BY_PRESSING_BELOW = 0.5

# Iterations of GMRES in such a step [-], at a pressure-viscosity coefficient times Hertz pressure of 1; times that to
# the first power, and the exponential of the second times the same pressing. Fitted to the same solves.
KRYLOV_ITERATIONS = 2.07
KRYLOV_BY_THICKENING = 0.35
KRYLOV_BY_PRESSING = 0.1

# Part of these steps that a solve takes which begins at a solution nearby [-], as at an end of the range of an input:
# 0.3 in the median, 0.4 in the mean of 171 ends of these strips. Measured.
AGAIN = 0.4

# Newton steps where a given film arrives over those of a flooded contact [-]: 1.7 in the median, 79 % within a factor
# of 3; the mean of such a normal distribution of the logarithm is 1.5 times the median. Fitted.
STARVED = 2.5

# Newton steps on a strip of soft bodies (`are_soft`) at Λ 1 and a pressure-viscosity coefficient times Hertz pressure
# of 1, where they are like others [-]. From the dry contact thin films converge in steps in time alone. 85 % within a
# factor of 3. Fitted.
SOFT_STEPS = 12.5

# Change of ln of these steps with ln Λ [-]: -.44 on longer cells, -.63 on the strip itself. Fitted.
SOFT_BY_FILM = -0.55

# Change of ln of these steps with ln of the pressure-viscosity coefficient times Hertz pressure [-]: -.27, -.14.
# Fitted.
SOFT_BY_THICKENING = -0.25

# The least of that product in the fitted contacts [-].
LEAST_THICKENED = 0.01

# Iterations of GMRES in a step of soft bodies [-]: 14 on longer cells, 19 on the strip itself. Measured.
SOFT_KRYLOV = 18.0

# Part of the steps that a neighbour of a solved strip of soft bodies takes [-]: 2 of 100 to all. Measured.
SOFT_AGAIN = 0.2


@dataclass(frozen=True, kw_only=True)
class ExpectedSteps:
    """Newton steps that are expected of a strip at rest: ``first``, from the dry contact or from longer cells,
    ``again``, from a solution nearby; ``krylov``: iterations of GMRES in each."""

    first: float
    again: float
    krylov: float

    def work(self, cells: float, steps: float) -> float:
        """Return the counted work [s] of so many ``steps`` on ``cells``."""
        return work_of_steps(cells, steps, steps * self.krylov)


def expected_steps(scene: Scene, sq: float, speed: float, columns: float) -> ExpectedSteps:
    """Return the steps on a surface of ``sq`` [m] whose roughness rests at ``speed`` [m/s], not 0, on so many
    ``columns`` of cells along x."""
    line = scene.line_contact(abs(speed))
    thickened = max(scene.lubricant.pressure_viscosity_coefficient * peak_hertz_pressure(scene), LEAST_THICKENED)
    if are_soft(line, sq):
        first = SOFT_STEPS * (line.moes_film / sq) ** SOFT_BY_FILM * thickened**SOFT_BY_THICKENING
        first = min(first, MOST_FACTORISATIONS)
        return ExpectedSteps(first=first, again=SOFT_AGAIN * first, krylov=SOFT_KRYLOV)
    arriving = scene.lubricant.inlet_film
    film = line.moes_film if arriving is None else min(arriving, line.moes_film)
    pressed = _pressed(line, sq, film)
    first = COLUMN_STEPS * columns**STEPS_BY_COLUMNS * math.exp(STEPS_BY_PRESSING * pressed)
    first = min(STARVED * first if film < line.moes_film else first, MOST_FACTORISATIONS)
    krylov = KRYLOV_ITERATIONS * thickened**KRYLOV_BY_THICKENING * math.exp(KRYLOV_BY_PRESSING * pressed)
    return ExpectedSteps(first=first, again=AGAIN * first, krylov=krylov)


def _pressed(line: LineContact, sq: float, film: float) -> float:
    """Return how far a ``film`` [m] on roughness of ``sq`` [m] is pressed between conforming bodies,
    ln(flattening/Sq)·(1/2 - ln Λ), each factor 0 at least; Λ: of the film that arrives."""
    flattening = line.half_width**2 / (2 * line.radius)
    return max(math.log(flattening / sq), 0.0) * max(STEPS_BY_PRESSING_BELOW - math.log(film / sq), 0.0)
