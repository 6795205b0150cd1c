"""The dry rough contact: the elastic half-space, its kernels and solver, and independent asperities."""

from .asperities import AsperityContact, asperities_under_cylinder
from .asperity import AsperityResult, asperity_contact, find_asperities
from .asperity_curve import asperity_curve
from .asperity_find import ridges
from .asperity_separation import separation_for_load
from .contact_curve import ContactCurve, contact_curve
from .flat import FlatContact, flat_contact
from .half_space import BOUNDARY, HalfSpaceContact, half_space_contact
from .height_map import check_grid, contact_map, extended, measured, rough_bodies, whole_map
from .hertz_strip import weighted_mean
from .kernels import semiperiodic_coefficients
from .operator import HalfSpace, _even_transform, half_space
from .problem import Problem, make_problem, starting_pressure
from .refine import refine
from .residual import contact_residuals, length_scale
from .result import ContactResult
from .rough_contract import ContactState, Grid, RoughContact
from .solve import solve_contact
from .strips import Strips, correlation_lengths, length_or_half, one_patch, strips_of

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
    "_even_transform",
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
    "AsperityContact",
    "asperities_under_cylinder",
    "flat_contact",
    "BOUNDARY",
    "Strips",
    "correlation_lengths",
    "length_or_half",
    "one_patch",
    "strips_of",
    "semiperiodic_coefficients",
    "separation_for_load",
    "solve_contact",
    "starting_pressure",
    "weighted_mean",
    "whole_map",
]
