"""Runs in time: the march, the film of smooth bodies in time, and two models of the mixed contact."""

from .checks_before_run import expected_violations_of_run
from .effects import (
    LEAST_SHARE_OF_F,
    EffectOverTime,
    EffectsOfMoment,
    effects_of_run,
    expected_effects_of_run,
    first_largest,
    largest_over_time,
    without_steady_film,
)
from .estimated import RunEstimate, periods
from .film import solve_transient_ehl
from .film_equations import Spring, StepEquations, outside, outside_shear
from .film_grid import make_fixed_grid, symmetric_nodes
from .film_setting import CreepingEnds, LineHistory, make_setting
from .intervals_to_zero import IntervalsToZero, intervals_to_zero
from .load_sharing_solver import ContactStep
from .march import Memory, Progress, Step, advance, plan_of, report_of, steps
from .model import Start, TimeModel
from .registry import check_run, estimated_run, may_move_roughness, run_model_of
from .result import (
    PARTS_NOT_IN_TIME,
    TransientResult,
    add_angle_axis,
    band_label,
    counts_in_average,
    errors_in_time,
    friction_over_time,
    in_motion,
    rolls,
    sense_of_friction_over_time,
    time_scale,
)
from .roughness_in_motion import way_to_motion_in_time
from .run import raise_if_failed, run_in_time, transient, without_work_limit
from .scene_in_time import fastest_of_run, has_steady_film, scene_at
from .start import speeds_of_run, strip_of_run
from .transient_deterministic import make_deterministic, start_deterministic
from .transient_load_sharing import STANDS_STILL, TransientLoadSharing
