"""One contact problem, checked before any work."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from .._base import validate
from ..errors import InputError
from .operator import HalfSpace, half_space

COARSEST = 24  # cells along an axis below which it is not halved
COARSE_TOLERANCE = 1e-2  # coarse grids only give a start
COARSE_ITERATIONS = 60
ABSURD = 1e6  # times E': no start has such a pressure


@dataclass(frozen=True)
class Problem:
    """One contact problem: gap0 [m] (nx, ny) with its minimum at zero and its rms ``roughness`` [m], deflection
    operator, hardness [Pa] (inf: elastic), and when to stop.

    ``offset`` [m] was subtracted from the caller's gap0: heights around zero keep the most digits near first touch.
    """

    gap0: np.ndarray
    offset: float
    roughness: float
    operator: HalfSpace
    hardness: float
    tolerance: float
    max_iterations: int

    def coarsened(self) -> Problem | None:
        """The same problem on cells twice as long (mean gap0) along every axis that can be halved; None if there is
        none."""
        operator = self.operator
        fx, fy = (
            2 if kept % 2 == 0 and padded % 4 == 0 and kept >= 2 * COARSEST else 1
            for kept, padded in zip(operator.shape, operator.padded)
        )
        if fx == fy == 1:
            return None
        parts = [self.gap0[i::fx, j::fy] for i in range(fx) for j in range(fy)]
        return replace(
            self,
            gap0=np.mean(parts, axis=0),
            operator=operator.coarsened((fx, fy)).single,
            tolerance=COARSE_TOLERANCE,
            max_iterations=COARSE_ITERATIONS,
        )


def make_problem(gap0, spacing, e_prime, hardness, boundary, tolerance, operator, max_iterations) -> Problem:
    """Check a problem; builds the operator if none is given, else checks that it fits."""
    if hasattr(gap0, "heights"):
        raise InputError(
            "gap0 is a height map, not an array; give gap0 = -surface.heights in m (heights point out of "
            "the body: the gap is smallest at summits), plus the shape of bodies that are not flat"
        )
    gap0 = validate.array("gap0", gap0, "m", ndim=2)
    hardness = math.inf if hardness is None else validate.positive("hardness", hardness, "Pa")
    tolerance = validate.number("tolerance", tolerance, "(-)", minimum=1e-14, maximum=0.1)
    max_iterations = validate.integer("max_iterations", max_iterations, minimum=0)
    if operator is None:
        operator = half_space(gap0.shape, spacing, e_prime, boundary)
    else:
        asked = {
            "shape": gap0.shape,
            "spacing": validate.spacing("spacing", spacing),
            "e_prime": validate.positive("e_prime", e_prime, "Pa"),
            "boundary": (boundary, boundary) if isinstance(boundary, str) else tuple(boundary),
        }
        for name, value in asked.items():
            if (built := getattr(operator, name)) != value:
                raise InputError(
                    f"operator was built for {name} = {built}, the contact has {value}; they must be the same"
                )
    offset = float(gap0.min())
    gap0 = gap0 - offset if offset else gap0
    return Problem(gap0, offset, float(gap0.std()), operator, hardness, tolerance, max_iterations)


def starting_pressure(problem: Problem, start) -> np.ndarray | None:
    """Pressure field [Pa] of an earlier result (or the field itself), limited to the hardness."""
    if start is None:
        return None
    pressure = validate.array("start", getattr(start, "pressure", start), "Pa", ndim=2)
    if pressure.shape != problem.gap0.shape:
        raise InputError(f"start has shape {pressure.shape}; allowed: {problem.gap0.shape}, the shape of gap0")
    limit = ABSURD * problem.operator.e_prime
    if pressure.min() < 0 or pressure.max() > limit:
        raise InputError(
            f"start has pressures from {pressure.min():g} to {pressure.max():g} Pa; allowed: 0 to {limit:g} Pa"
        )
    return np.ascontiguousarray(np.minimum(pressure, problem.hardness))  # the solver writes through ravel()
