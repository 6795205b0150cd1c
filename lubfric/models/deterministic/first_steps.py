"""What a strip of moving roughness takes, measured on its first steps in time.

A closed form knows the work of a step within a factor of 2 for nine of ten contacts (`StepFacts`). The first steps of
the strip itself know it better, and what the processor does with it.
"""

import time
from dataclasses import dataclass

from ..._base import limited_work
from ...errors import ConvergenceError
from ..shared import Prepared
from .moving_strip import (
    STEPS_BEFORE,
    effort_of,
    forecast_work,
    moments_after_rest,
    steps_in_time,
    strip_at_rest,
    work_of_step_in_time,
)
from .rough_bodies import bodies_of
from .strip_on_two_grids import MOVING_SAMPLE, longer_than, sample_target, surface_and_map_coarsening

# Counted work [s] of the measurement, at most. A choice: four times as much, for a strip at rest that takes long.
MOST_WORK_OF_MEASUREMENT = 40.0


@dataclass(frozen=True, kw_only=True)
class FirstSteps:
    """What the first steps of a strip took.

    Attributes
    ----------
    steps : number of steps in time that count
    factor : counted work of a step in time over `work_of_step_in_time`
    rest : counted work of the strip at rest, from which the motion begins, over the same
    forecast : counted work [s] of the strip at least (`forecast_work`)
    pace : processor time over counted work
    seconds : processor time [s] of the measurement
    """

    steps: int
    factor: float
    rest: float
    forecast: float
    pace: float
    seconds: float


def first_steps(prepared: Prepared, speed: float) -> FirstSteps | None:
    """Solve the first strip of moving roughness at ``speed`` [m/s] at rest and for its first steps in time, as a point
    does; None where one of these is not solved within `MOST_WORK_OF_MEASUREMENT`."""
    scene = prepared.scene
    surface, map_coarsening = surface_and_map_coarsening(prepared, 0)
    bodies = bodies_of(prepared, 0, speed)
    effort = effort_of(scene, bodies, speed, map_coarsening)
    longer_cells = longer_than(surface, map_coarsening, is_moving=True)
    works: list[float] = []
    begun = time.process_time()
    try:
        with limited_work(MOST_WORK_OF_MEASUREMENT) as meter:
            longer = strip_at_rest(scene, bodies, speed, map_coarsening=longer_cells)
            rest = strip_at_rest(scene, bodies, speed, map_coarsening=map_coarsening, start=longer, effort=effort)
            of_rest = meter.spent
            spent = of_rest
            has_target = sample_target(prepared, MOVING_SAMPLE * scene.numerics.sampling_tolerance) is not None
            cell = rest.problem.spacing[0]
            planned = steps_in_time(scene, bodies, speed, cell=cell, effort=effort, has_target=has_target)
            forecast: float | None = None
            for _ in moments_after_rest(rest, bodies, speed, step=planned.step, effort=effort):
                works.append(meter.spent - spent)
                spent = meter.spent
                forecast = forecast_work(works, steps=planned.least, rest=rest.work)
                if forecast is not None:
                    break
    except ConvergenceError:
        return None
    if forecast is None:  # it took all that a measurement may
        return None
    seconds = time.process_time() - begun
    usual = work_of_step_in_time(rest.result.pressure.size)
    counted = works[STEPS_BEFORE:]
    return FirstSteps(
        steps=len(counted),
        factor=sum(counted) / len(counted) / usual,
        rest=of_rest / usual,
        forecast=forecast,
        pace=seconds / spent,
        seconds=seconds,
    )
