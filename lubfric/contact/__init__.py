"""The dry rough contact: the elastic half-space, its kernels and solver, and independent asperities."""

from .asperities_under_cylinder import AsperityContact, asperities_under_cylinder
from .asperity import AsperityResult, asperity_contact, find_asperities, separation_for_load
from .asperity_find import ridges
from .cylinder import LoadedCylinder
from .dents import dent_by_pass, operator_under
from .flat import FlatContact, asperity_curve, contact_curve, flat_contact
from .half_space import BOUNDARY, HalfSpaceContact, half_space_contact
from .kernels import bessel_cells, line_coefficients, love_coefficients, semiperiodic_coefficients
from .operator import HalfSpace, half_space
from .problem import ContactProblem, TrialContact, contact_problem, on_grid
from .refinement import ContactResult, SearchResult, contact_result, evaluate, length_scale, refine, trial_contact
from .rough_contract import ContactState, RoughContact, centred_axis, weighted_mean
from .solve import solve_contact
from .wear import Passage, archard_compliance, passage
