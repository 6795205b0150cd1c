"""Half of ∫ h dp, the resistance to rolling, from the gap of the undeformed bodies.

The kernel of the half-space is even, so a pressure does no work when it is shifted together with the deflection that it
causes: ∫ (K p) dp = 0. What is left of ∫ h dp is ∫ (x²/2R + imposed deflection) dp; without an imposed pressure this is
the first moment of the pressure, -∫ x p dx/R. The direct sum of h dp is a small difference at high pressure, and takes
ten times as many cells for the same error.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from .newton import Solution
from .problem import Problem


class Rolling(NamedTuple):
    """``force`` [N/m]: half of ∫ h dp over the nodes, along the motion; ``error``: estimated."""

    force: float
    error: float


def rolling_resistance(problem: Problem, levels: Sequence[Solution]) -> Rolling:
    """The rolling force on the last of ``levels``, solutions on ever finer grids; extrapolated to second order if there
    are two. The error is the step of the extrapolation, or a quarter of the one before if that is larger."""
    unit = problem.pressure_unit * problem.film_unit
    found = [unit * _half_work(problem, solution) for solution in levels[-3:]]
    steps = np.diff(found) / 3.0
    if not steps.size:
        return Rolling(found[-1], np.inf)
    return Rolling(
        float(found[-1] + steps[-1]), float(max(abs(steps[-1]), abs(steps[0]) / 4.0 if steps.size > 1 else 0.0))
    )


def _half_work(problem: Problem, solution: Solution) -> float:
    """∫ h dp/2 of a pressure that is linear between the nodes and zero upstream of the first."""
    t = solution.terms
    given = problem.imposed_deflection(t.X)[0]
    square = (t.X[1:] ** 2 + t.X[1:] * t.X[:-1] + t.X[:-1] ** 2) / 6.0
    inside = np.diff(t.P) @ (square + 0.5 * (given[1:] + given[:-1]))
    return 0.5 * float(inside - t.P[0] * (t.H[0] - 0.5 * t.X[0] ** 2 - given[0]))
