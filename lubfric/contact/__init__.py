"""The dry rough contact: the elastic half-space, its kernels and solver, and independent asperities."""

from .asperity import AsperityResult, asperity_contact, find_asperities, separation_for_load
from .asperity_curve import asperity_curve
from .asperity_find import ridges
from .contact_curve import ContactCurve, contact_curve
from .flat import FlatContact
from .half_space import HalfSpaceContact, half_space_contact
from .height_map import check_grid, contact_map, extended, measured, rough_bodies, whole_map
from .hertz_strip import weighted_mean
from .kernels import semiperiodic_coefficients
from .make import rough_contact
from .operator import HalfSpace, half_space
from .problem import Problem, make_problem, starting_pressure
from .result import ContactResult, contact_residuals, length_scale
from .rough_contract import ContactState, Grid, RoughContact
from .rounds import refine
from .solve import solve_contact
from .transforms import even_transform

__all__ = [
    "AsperityResult",
    "ContactCurve",
    "ContactResult",
    "ContactState",
    "FlatContact",
    "Grid",
    "HalfSpace",
    "HalfSpaceContact",
    "Problem",
    "RoughContact",
    "even_transform",
    "asperity_contact",
    "asperity_curve",
    "check_grid",
    "contact_curve",
    "contact_map",
    "contact_residuals",
    "extended",
    "find_asperities",
    "half_space",
    "half_space_contact",
    "length_scale",
    "make_problem",
    "measured",
    "refine",
    "ridges",
    "rough_bodies",
    "rough_contact",
    "semiperiodic_coefficients",
    "separation_for_load",
    "solve_contact",
    "starting_pressure",
    "weighted_mean",
    "whole_map",
]
