"""The start of Newton's method: the dry contact of the whole load, lifted by the smooth film."""

from __future__ import annotations

import math

import numpy as np

from ..contact import ContactResult, solve_contact
from .problem import Problem
from .state import FLUID, RUPTURED, State

DRY_TOLERANCE = 1e-4
RUPTURE = 0.55  # of sqrt(2 R h): a little behind where a rigid film ruptures, 0.475


def dry_contact(problem: Problem, start=None, tolerance=DRY_TOLERANCE) -> ContactResult:
    """The rough bodies pressed together without fluid under the whole load."""
    return solve_contact(
        problem.rigid_gap,
        problem.spacing,
        problem.e_prime,
        mean_pressure=problem.load / (problem.x.size * problem.spacing[0]),
        hardness=None if np.isinf(problem.hardness) else problem.hardness,
        boundary=("free", "periodic"),
        tolerance=tolerance,
        operator=problem.operator,
        start=start,
    )


def dry_start(problem: Problem, dry: ContactResult, film: float) -> State:
    """The pressure of the ``dry`` contact, and its gap plus ``film`` [m]. Behind contact and film the film has
    ruptured."""
    p = dry.pressure
    dent = np.where(p >= problem.hardness, np.maximum(-dry.gap, 0.0), 0.0)
    full = max(RUPTURE * math.sqrt(2 * problem.radius * film), problem.contact.half_width)
    kind = np.where((p <= 0) & (problem.x > full)[:, None], RUPTURED, FLUID).astype(np.int8)
    return State(p.copy(), np.ones_like(p), dent, kind, p >= problem.hardness, film - dry.approach)
