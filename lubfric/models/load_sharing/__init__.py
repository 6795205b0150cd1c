"""Load sharing, Eq. (8) of the paper: film and contact carry one load.

`prepared` makes a scene ready; `point` solves film and contact, each at its share of the load; `balance` finds the
division at which they agree; `forces` and `heat` give the friction; `response` tells how strongly all that depends on
an error of the gap. `checks` are the assumptions of the model.
"""

from .balance import Balance, solve_balance
from .checks import (
    judged,
    of_deflection,
    of_ends,
    of_error,
    of_film,
    of_heat,
    of_inlet,
    of_motion,
    of_pressure,
    of_thickness,
    of_typical_heat,
)
from .checks_before import expected
from .forces import Forces, forces
from .heat import Heat, film_lubricant, inlet_at, peclet_at, point_heat, surroundings, typical_heat
from .lacks import Lack, lack_in_words, lacking
from .point import Point, exponents
from .prepared import Prepared, at_speed, at_tolerance, on_piece, on_stack, on_strip, prepare, scene_of
from .response import Response, Slopes, divided, grown, quantities, touched_length
from .validity import Validity, entries_of, gathered, in_a_cell, refused
