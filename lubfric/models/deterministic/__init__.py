"""The deterministic mixed-lubrication model: the film between rough surfaces in its own gap (docs/deterministic.md)."""

from .answer import answer_of, violations_by_correction
from .cells_in_motion import (
    CellsInMotion,
    cells_in_motion,
    cells_of_strips,
    changed_as_expected,
    film_exponent_of,
)
from .deterministic_model import DeterministicModel, DeterministicSolution
from .estimated_work import expected_way, moving_point_work, work_of_fine_fields, work_on_long_cells
from .expected_friction import expected_friction
from .expected_steps_in_time import COEFFICIENTS, StepFacts
from .flow import derivatives, mass_balance
from .heat_of_strip import heat_of_strips, strip_heat
from .levels import Levels, levels_of, two_levels
from .linear import System, gmres, nested_dissection
from .moving import Moment, RoughBody, moments, moved_downstream, travelling
from .moving_strip import (
    ECONOMICAL,
    FACTORISATIONS_IN_A_STEP,
    FORECAST_STEPS,
    KRYLOV_IN_A_STEP,
    STEPS_BEFORE,
    TIGHT,
    MovingEffort,
    MovingStripSolution,
    SampleTarget,
    cells_in_a_step,
    compared_moments,
    continued_moments,
    continued_strip,
    effort_for,
    effort_of,
    forecast_work,
    solve_moving_strip,
    strip_at_rest,
    work_of_step_in_time,
)
from .newton import Work, march, newton
from .pictures import animate_moments, plot_moments, plot_passing
from .problem import BOUNDARY_FILM, FLOOR, Problem, lay_out, reach, shifted
from .result import DeterministicResult, assemble
from .rheology import mean_fluidity, thinning
from .rough_bodies import bodies_of, map_of_strip, maps_of_bodies
from .solve import dry_contact, solve_point
from .state import FLUID, RUPTURED, TOUCHING, Iterate, State, TimeHistory, admissible, evaluated, residuals
from .strip import UNKNOWN_SLOPE, StripSolution, change_by_flow, changes_of, error_by_cells, solve_strip, work_of_steps
from .strip_on_two_grids import (
    MapCoarsening,
    StripOnTwoGrids,
    numbers_of_strip,
    sample_coarsening_of,
    sample_target,
    surface_and_map_coarsening,
)
from .summits import SummitControl, attenuated, control_of
from .time_and_place import TimeAndPlace, least_blocks, mean_over_blocks
from .violations_of_strips import error_by_gap
