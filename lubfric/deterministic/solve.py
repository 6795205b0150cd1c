"""One deterministic operating point on one grid: Newton's method, and the ways out where it fails."""

from __future__ import annotations

import math
from dataclasses import replace

from ..analytic import hertz
from ..ehl.start import moes_film
from ..report import CONVERGED, DIVERGED, ITERATION_LIMIT, STAGNATED, Report
from .march import march
from .newton import Found, newton
from .problem import Problem
from .result import DeterministicResult, assemble
from .start import dry_contact, dry_start
from .state import State

TOLERANCE = 1e-5
DIRECT, MARCHED = 50, 250  # LU factorisations from a start, and in time
HELPER = {"limiting_stress_coefficient": 0.09, "limiting_stress_offset": 2e6}


def solve_point(
    problem: Problem, *, start: State | None = None, film: float, tolerance=TOLERANCE, raise_on_failure=True
) -> DeterministicResult:
    """Gap, pressure and friction of ``problem``; ``film`` [m]: about that of smooth surfaces, to start from.

    Tried in turn: Newton's method from ``start`` (a neighbouring state on the same grid), from the dry contact lifted by
    ``film``, and from where implicit steps in time lead from there. Converged when the largest of
    `lubfric.deterministic.state.residuals` is <= tolerance. Raises `ConvergenceError` with report and result.
    """
    work = _Work()
    found = _attempt(problem, start, film, tolerance, work)
    report = work.report(found, tolerance)
    half_width = hertz.line_half_width(problem.load, problem.radius, problem.e_prime)
    result = assemble(problem, found.look, report, half_width)
    if raise_on_failure:
        report.raise_if_failed(result)
    return result
