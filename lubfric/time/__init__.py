"""What changes in time: histories, the march, films and contacts in time."""

from .bdf import Level, Memory, Progress, advance, started
from .checkpoint import STATE
from .course import Plan, checked_times, plan_of, report_of, steps
from .film import TransientFilm, solve_transient_ehl
from .film_grid import make_fixed_grid, symmetric_nodes
from .film_setting import FIRST_STEP, WET, ContactHistory, make_setting, parabola
from .moment import UNITS
from .result import TransientResult
from .run import transient

__all__ = [
    "ContactHistory",
    "FIRST_STEP",
    "Level",
    "Memory",
    "Plan",
    "Progress",
    "STATE",
    "TransientFilm",
    "TransientResult",
    "UNITS",
    "WET",
    "advance",
    "checked_times",
    "make_fixed_grid",
    "make_setting",
    "parabola",
    "plan_of",
    "report_of",
    "solve_transient_ehl",
    "started",
    "steps",
    "symmetric_nodes",
    "transient",
]
