"""The smooth film of a line contact, its shear force and its heat.

There is one film, an `EHLResult`, and one solver: ``solve_line_contact(contact, effort, start=)`` for a
`LineContact`, or `solve_ehl` for plain numbers. It covers all regimes, from rigid bodies and constant viscosity to
heavy piezoviscous contacts. ``shear_force(film, lubricant, ...)`` is its force on surface 2, with the rolling
force that the film knows. The closed forms (`formulas`, `hertz`) are checks and starts.
"""

from .assemble import in_si, reported
from .ehl import solve_ehl, solve_line_contact
from .ehl_result import EHLResult, central_film, cubic, smallest
from .elastic_shear import ElasticContact, disc_compliance, elastic_shear
from .formulas import flooded_inlet, moes_film, smallest_film, starved_inlet
from .grid import UPWIND, face_weights, hat_kernel, node_positions, trapezoidal
from .heat import (
    FAST_PECLET_NUMBER,
    MOST_SLIDE_ROLL_RATIO_OF_INLET,
    MOST_THERMAL_LOADING,
    FilmHeat,
    InletHeat,
    Surroundings,
    heated_film,
    heated_stress,
    inlet_heat,
    isothermal_heat,
    viscosity_at,
)
from .hertz import HasLineContact, LineContact, composite_modulus, line_peak_pressure
from .nested import Effort
from .problem import FilmProblem, film_problem
from .reduced import true_pressure
from .reynolds import count_film_step, log_mean_fluidity, step_length
from .shear import ShearForce, above_carried, rolling_error, shear_force, spike_error
from .start import FilmState, rupture_guess
from .thinning import thinned
