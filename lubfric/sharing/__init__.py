"""Load sharing, Eq. (8) of the paper: film and contact carry one load."""

from .adapt import Solved, solved
from .balance import Balance, Lubricated, balanced, separated
from .decision import Decision
from .deflection import solved_as_deflected
from .forces import Forces, forces
from .heat import Heat, film_lubricant, inlet_at, point_heat
from .judge import judged_validity
from .lines_cells import Cells
from .lines_contract import Lines
from .lines_generated import lengths_of
from .lines_length import LONGEST, MOST, MOST_CELLS, PAIR, PILOT, next_length
from .lines_make import first_line, lines_of, takes_line
from .lines_outlook import piece_cells, pilot_length
from .lines_pieces import line_contact, thinned
from .lines_windows import length_or_half
from .operating_point import OperatingPoint, Settings, Start, Trial
from .outlook import outlook
from .prepared import Prepared, at_tolerance, on_cells_of, on_halved_cells, prepare, scene_of
from .split import divided, growth
from .validity import Validity, entries_of, gathered, in_a_cell, refused
from .validity_solution import of_deflection, of_ends, of_error, of_film, of_motion, of_pressure, of_shear, of_thickness

__all__ = [
    "Balance",
    "Cells",
    "Decision",
    "Forces",
    "Heat",
    "LONGEST",
    "Lines",
    "Lubricated",
    "MOST",
    "MOST_CELLS",
    "OperatingPoint",
    "PAIR",
    "PILOT",
    "Prepared",
    "Settings",
    "Solved",
    "Start",
    "Trial",
    "Validity",
    "at_tolerance",
    "balanced",
    "divided",
    "entries_of",
    "film_lubricant",
    "first_line",
    "forces",
    "gathered",
    "growth",
    "in_a_cell",
    "inlet_at",
    "judged_validity",
    "length_or_half",
    "lengths_of",
    "line_contact",
    "lines_of",
    "next_length",
    "of_deflection",
    "of_ends",
    "of_error",
    "of_film",
    "of_motion",
    "of_pressure",
    "of_shear",
    "of_thickness",
    "on_cells_of",
    "on_halved_cells",
    "outlook",
    "piece_cells",
    "pilot_length",
    "point_heat",
    "prepare",
    "refused",
    "scene_of",
    "separated",
    "solved",
    "solved_as_deflected",
    "takes_line",
    "thinned",
]
