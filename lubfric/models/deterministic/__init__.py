"""One gap and one pressure: the film between rough surfaces in its own gap (docs/deterministic.md)."""

from .moving import Moment, RoughBody, moments, travelling
from .moving_strip import (
    ECONOMICAL,
    KRYLOV,
    STEPS,
    TIGHT,
    MovingEffort,
    MovingStrip,
    continued_strip,
    effort_for,
    moving_work,
    solve_moving_strip,
    strip_at_rest,
)
from .newton import Work, newton
from .pictures import animate_moments, plot_moments, plot_passing
from .point import (
    Strip,
    change_by_flow,
    change_of,
    changes_of,
    estimate,
    solve_strip,
    thinned_less,
    work_of,
    work_of_steps,
)
from .problem import BOUNDARY_FILM, Problem, lay_out, reach, shifted
from .result import DeterministicResult, assemble
from .solve import dry_contact, solve_point
from .state import RUPTURED, TOUCHING, Iterate, State, TimeHistory, evaluated, residuals
