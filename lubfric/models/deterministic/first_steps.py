"""What a strip of moving roughness takes, measured on its first steps in time.

A closed form knows the work of a step within a factor of 2 for nine of ten contacts (`StepFacts`). The first steps of the strip itself
know it better, and what the processor does with it.
"""

import math
import time
from dataclasses import dataclass, replace

from ..._base import limited_work
from ...errors import ConvergenceError
from ..shared import Prepared
from .moving import film_half_width
from .moving_strip import effort_of, solve_moving_strip, strip_at_rest, work_of_step_in_time
from .rough_bodies import bodies_of
from .strip_on_two_grids import longer_than, surface_and_map_coarsening

# Steps in time that are measured [-]. A choice: the mean of so many is within a factor of 1.2 of that of the complete strip in most
# of 30 random contacts of ``verification.campaigns.estimates``, 1.5 at most.
MEASURED_STEPS = 10

# Steps in time before them [-]: the first ones from rest take more. A choice, above `moving.STEPS_FROM_REST`.
STEPS_BEFORE = 3

# Counted work [s] of the measurement, at most. A choice: a twelfth of `MOST_WORK_OF_POINT`.
MOST_WORK_OF_MEASUREMENT = 10.0


@dataclass(frozen=True, kw_only=True)
class FirstSteps:
    """What the first steps of a strip took.

    Attributes
    ----------
    factor : counted work of a step in time over `work_of_step_in_time`
    rest : counted work of the strip at rest, from which the motion begins, over the same
    pace : processor time over counted work
    seconds : processor time [s] of the measurement
    """

    factor: float
    rest: float
    pace: float
    seconds: float


def first_steps(prepared: Prepared, speed: float) -> FirstSteps | None:
    """Solve the first strip of moving roughness at ``speed`` [m/s] at rest and for its first steps in time, as a point does; None
    where these are not solved within `MOST_WORK_OF_MEASUREMENT`."""
    scene = prepared.scene
    surface, map_coarsening = surface_and_map_coarsening(prepared, 0)
    bodies = bodies_of(prepared, 0, speed)
    cell = map_coarsening[0] * surface.spacing[0]
    way = STEPS_BEFORE * cell / film_half_width(scene.line_contact(abs(speed)))
    effort = replace(effort_of(scene, bodies, speed, map_coarsening), discarded=way)
    longer_cells = longer_than(surface, map_coarsening, is_moving=True)
    begun = time.process_time()
    try:
        with limited_work(MOST_WORK_OF_MEASUREMENT):
            longer = strip_at_rest(scene, bodies, speed, map_coarsening=longer_cells)
            strip = solve_moving_strip(
                scene,
                bodies,
                speed,
                map_coarsening=map_coarsening,
                start=longer,
                effort=effort,
                most_steps=MEASURED_STEPS,
            )
    except ConvergenceError:
        return None
    seconds = time.process_time() - begun
    usual = work_of_step_in_time(strip.result.pressure.size)
    of_steps = float(strip.series["work"][strip.discarded :].mean())
    spent = strip.work + longer.work
    if not math.isfinite(of_steps) or spent <= 0 or of_steps <= 0:
        return None
    return FirstSteps(
        factor=of_steps / usual,
        rest=(strip.rest.work + longer.work) / usual,
        pace=seconds / spent,
        seconds=seconds,
    )
