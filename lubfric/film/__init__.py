"""The smooth film of a line contact: closed forms, EHL, heat."""

from .conjunction import FilmHeat, Surroundings, heated_film, isothermal_heat
from .contract import Film, FilmLevel, LeftOut
from .ehl import Effort, make_problem, solve_ehl, solve_line_contact
from .ehl_result import EHLResult, cubic, smallest
from .flash import FAST
from .formulas import moes_film
from .grid import node_positions, trapezoidal
from .heated_stress import heated_stress
from .hertz import composite_modulus
from .inlet_heat import LARGEST, SLIDING, InletHeat, inlet_heat
from .kernel import hat_kernel
from .levels import LEVELS, given_level, higher, level_for, lowest_level
from .limiter import step_length
from .line_contact import LineContact, OfLineContact
from .problem import Problem
from .reynolds import log_mean_fluidity
from .rigid import reduced_pressure, true_pressure
from .shear import ShearForce, rolling_error, shear_force, spike_error
from .start import State, expected_rupture, rupture_guess

__all__ = [
    "EHLResult",
    "Effort",
    "FAST",
    "Film",
    "FilmHeat",
    "FilmLevel",
    "InletHeat",
    "LARGEST",
    "LEVELS",
    "LeftOut",
    "LineContact",
    "OfLineContact",
    "Problem",
    "SLIDING",
    "ShearForce",
    "State",
    "Surroundings",
    "composite_modulus",
    "cubic",
    "expected_rupture",
    "given_level",
    "hat_kernel",
    "heated_film",
    "heated_stress",
    "higher",
    "inlet_heat",
    "isothermal_heat",
    "level_for",
    "log_mean_fluidity",
    "lowest_level",
    "make_problem",
    "moes_film",
    "node_positions",
    "reduced_pressure",
    "rolling_error",
    "rupture_guess",
    "shear_force",
    "smallest",
    "solve_ehl",
    "solve_line_contact",
    "spike_error",
    "step_length",
    "trapezoidal",
    "true_pressure",
]
