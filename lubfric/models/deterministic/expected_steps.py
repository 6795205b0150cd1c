"""Newton steps that strips at rest are expected to take, by closed forms.

The constants are fitted to 113 random strips at rest of usual ranges (those of ``verification.campaigns.estimates``): 39
flooded, the same 34 with .15 to 1 of the film that would flow in, and 40 of E' 0.2 to 20 GPa and up to 60 MPa, each on two
lengths of cells. Strips without a solution count as 300 steps.
"""

import math
from dataclasses import dataclass

from ...film import LineContact
from ...scene import Scene
from ..shared import peak_hertz_pressure
from .counted_work import work_of_steps
from .problem import are_soft
from .solve import MOST_FACTORISATIONS

# Newton steps on a strip, about [-]: 6 on longer cells, 8 on the strip itself. 90 % within a factor of 3 with
# `STEPS_BY_PRESSING`. Fitted.
STRIP_STEPS = 9

# Newton steps on a strip whose neighbour is solved [-]: at an end of the range of an input. Measured.
AGAIN = 4

# Iterations of GMRES in a step over the pressure-viscosity coefficient times Hertz pressure [-]: 1.4, 4.4, 10 at 1.1,
# 3.4, 11. Fitted.
KRYLOV_BY_THICKENING = 1.2

# Iterations of GMRES in a step that are expected, at most [-]. Measured.
MOST_KRYLOV_ITERATIONS = 9.0

# Newton steps on a strip where a given film arrives [-]: 9 on longer cells, 16 on the strip itself. 79 % within a
# factor of 3 with `STEPS_BY_PRESSING`. Fitted.
STARVED_STEPS = 15.0

# Change of ln of these steps with how far a thin film is pressed between conforming bodies, ln(flattening/Sq)·(1/2 - ln
# Λ), each factor 0 at least [-]: .30 on longer cells, .24 on the strip itself, .25 and .27 where flooded. Λ: of the
# film that arrives. Fitted.
STEPS_BY_PRESSING = 0.25

# Logarithm of the lambda ratio below which that begins [-]: Λ 1.6. Fitted.
STEPS_BY_PRESSING_BELOW = 0.5

# Newton steps on a patch of one column of cells along x, which is not pressed [-]; times the columns to the power
# `PATCH_BY_COLUMNS`, and the exponential of `PATCH_BY_PRESSING` times the exponent of `STEPS_BY_PRESSING`. Fitted to 286 solves of
# random patches of ``verification.campaigns.estimates``, on 2 to 6 lengths of cells each: 90 % within a factor of 2; a tenth takes
# 50 to 570 steps, most of all in films below 0.1 Sq, for which the first has 20 % more than the fit.
PATCH_STEPS = 2.5
PATCH_BY_COLUMNS = 0.29
PATCH_BY_PRESSING = 0.06

# Iterations of GMRES in such a step [-], at a pressure-viscosity coefficient times Hertz pressure of 1; times that to the first
# power, and the exponential of the second times the same exponent. Fitted to the same solves.
PATCH_KRYLOV = 2.07
PATCH_KRYLOV_BY_THICKENING = 0.35
PATCH_KRYLOV_BY_PRESSING = 0.1

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


def expected_steps(scene: Scene, sq: float, speed: float) -> ExpectedSteps:
    """Return the steps on a surface of ``sq`` [m] at ``speed`` [m/s], not 0."""
    line = scene.line_contact(abs(speed))
    thickened = scene.lubricant.pressure_viscosity_coefficient * peak_hertz_pressure(scene)
    if are_soft(line, sq):
        first = (
            SOFT_STEPS * (line.moes_film / sq) ** SOFT_BY_FILM * max(thickened, LEAST_THICKENED) ** SOFT_BY_THICKENING
        )
        first = min(first, MOST_FACTORISATIONS)
        return ExpectedSteps(first=first, again=SOFT_AGAIN * first, krylov=SOFT_KRYLOV)
    krylov = min(KRYLOV_BY_THICKENING * thickened, MOST_KRYLOV_ITERATIONS)
    (unpressed, film) = _unpressed_steps(scene, line)
    first = min(unpressed * math.exp(STEPS_BY_PRESSING * _pressed(line, sq, film)), MOST_FACTORISATIONS)
    return ExpectedSteps(first=first, again=AGAIN * first / STRIP_STEPS, krylov=krylov)


def expected_steps_of_patch(scene: Scene, sq: float, speed: float, columns: float) -> ExpectedSteps:
    """Return the steps on a patch of so many ``columns`` of cells along x, whose roughness of ``sq`` [m] rests at ``speed`` [m/s]: those of
    `expected_steps` where the bodies are soft."""
    line = scene.line_contact(abs(speed))
    usual = expected_steps(scene, sq, speed)
    if are_soft(line, sq):
        return usual
    thickened = scene.lubricant.pressure_viscosity_coefficient * peak_hertz_pressure(scene)
    (unpressed, film) = _unpressed_steps(scene, line)
    pressed = _pressed(line, sq, film)
    first = PATCH_STEPS * columns**PATCH_BY_COLUMNS * math.exp(PATCH_BY_PRESSING * pressed) * unpressed / STRIP_STEPS
    krylov = (
        PATCH_KRYLOV
        * max(thickened, LEAST_THICKENED) ** PATCH_KRYLOV_BY_THICKENING
        * math.exp(PATCH_KRYLOV_BY_PRESSING * pressed)
    )
    return ExpectedSteps(first=first, again=AGAIN * first / STRIP_STEPS, krylov=krylov)


def _unpressed_steps(scene: Scene, line: LineContact) -> tuple[float, float]:
    """Return the steps on a strip where nothing is pressed, and the film [m] that arrives in ``line``."""
    arriving = scene.lubricant.inlet_film
    if arriving is not None and arriving < line.moes_film:
        return STARVED_STEPS, arriving
    return STRIP_STEPS, line.moes_film


def _pressed(line: LineContact, sq: float, film: float) -> float:
    """Return how far a ``film`` [m] on roughness of ``sq`` [m] is pressed between conforming bodies
    (`STEPS_BY_PRESSING`)."""
    flattening = line.half_width**2 / (2 * line.radius)
    return max(math.log(flattening / sq), 0.0) * max(STEPS_BY_PRESSING_BELOW - math.log(film / sq), 0.0)
