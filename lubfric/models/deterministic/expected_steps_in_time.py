"""The counted work of a step in time that is expected of moving roughness, by a closed form.

Its constants are the fit of ``python -m verification.campaigns.rolling_work`` to the first steps of random contacts, on
the cells of the deterministic model and on long ones.
"""

import math
from dataclasses import dataclass

from ...scene import Scene, moving_bodies
from ..shared import peak_hertz_pressure
from .moving_strip import FAST_ROUGHNESS, SLOW_ROUGHNESS, TIGHT, effort_for

# ln of the work of a step over `work_of_step_in_time`, where all features are 0 [-]. Fitted.
LOG_WORK = -0.873

# Its changes with the features of `StepFacts` [-]. Fitted.
BY_THICKENING = 0.27
BY_RIDGES_ALONG = 0.128
BY_PART_OF_CELL = 0.835
BY_TIGHT_STEPS = 0.465
BY_APART = 0.903
BY_RIDGES_ACROSS = 0.265

# These in the order of `StepFacts.features` [-]. By definition.
COEFFICIENTS = (
    LOG_WORK,
    BY_THICKENING,
    BY_RIDGES_ALONG,
    BY_PART_OF_CELL,
    BY_TIGHT_STEPS,
    BY_APART,
    BY_RIDGES_ACROSS,
)

# The pressure-viscosity coefficient times Hertz pressure over Λ below which the work of a step changes with it no more
# [-]: about the least in the contacts of the fit. Measured there.
LEAST_THICKENING = 0.56

# Λ below which ridges along the motion change the work of a step [-]. A choice: between 1 and 4 the fit is as good.
THIN_ON_RIDGES = 2.0


@dataclass(frozen=True, kw_only=True)
class StepFacts:
    """What is known of the steps in time of a contact before anything is solved.

    Attributes
    ----------
    thickened : pressure-viscosity coefficient times Hertz pressure
    lambda_ratio : film of the smooth contact over Sq
    lay : correlation length along y over that along x
    moved : cells by which the roughness moves in a step, of two rough bodies in the mean
    tight : 1.0 if steps are `lubfric.models.deterministic.TIGHT`, else 0.0
    apart : cells by which each of two rough bodies moves in a step more or less than their mean; 0 of one
    """

    thickened: float
    lambda_ratio: float
    lay: float
    moved: float
    tight: float
    apart: float = 0.0

    @classmethod
    def of(cls, scene: Scene, *, sq: float, speed: float, lengths: tuple[float, float], cell: float) -> "StepFacts":
        """Return the facts of roughness of ``sq`` [m] and the correlation ``lengths`` [m] at ``speed`` [m/s], on cells
        [m] along x."""
        (lx, ly) = lengths
        line = scene.line_contact(abs(speed))
        (moved, apart) = _cells_in_a_step(scene)
        return cls(
            thickened=scene.lubricant.pressure_viscosity_coefficient * peak_hertz_pressure(scene),
            lambda_ratio=line.moes_film / sq,
            lay=ly / lx,
            moved=moved,
            tight=float(effort_for(line, sq, cell) is TIGHT),
            apart=apart,
        )

    @property
    def features(self) -> tuple[float, ...]:
        """What ln of the work of a step is a linear function of, in the order of `COEFFICIENTS`."""
        thickening = math.log(max(self.thickened / self.lambda_ratio, LEAST_THICKENING))
        on_ridges = max(math.log(THIN_ON_RIDGES / self.lambda_ratio), 0.0) if self.lay < 1.0 else 0.0
        part_of_cell = abs(self.moved - round(self.moved))
        loose_apart = self.apart * (1.0 - self.tight)  # no trend where steps are tight
        across = float(self.lay > 1.0)
        return 1.0, thickening, on_ridges, part_of_cell, self.tight, loose_apart, across

    @property
    def factor(self) -> float:
        """The expected work of a step over `lubfric.models.deterministic.moving_strip.work_of_step_in_time`."""
        return math.exp(sum(a * b for a, b in zip(COEFFICIENTS, self.features)))


def _cells_in_a_step(scene: Scene) -> tuple[float, float]:
    """Return `StepFacts.moved` and `StepFacts.apart`: a step is that in which the film passes a cell, or the fastest
    body (`SLOW_ROUGHNESS`, `FAST_ROUGHNESS`). Newton's method starts a step as far downstream as the bodies move in the
    mean; summits of bodies that move apart meet in that start."""
    ratios = [ratio for _, ratio in moving_bodies(scene)]
    fastest = max(abs(ratio) for ratio in ratios)
    in_step = 1.0 if SLOW_ROUGHNESS <= fastest <= FAST_ROUGHNESS else 1.0 / fastest
    mean = sum(ratios) / len(ratios)
    apart = max(abs(ratio - mean) for ratio in ratios)
    return max(0.0, in_step * mean), in_step * apart
