"""Dry contact of a rough half-space: `solve_contact`."""

from __future__ import annotations

import math

import numpy as np

from ..errors import CONVERGED, ITERATION_LIMIT, Report
from .control import gap_controlled
from .nested import load_controlled
from .problem import check_control, make_problem, starting_pressure
from .residual import volume
from .result import ContactResult


def solve_contact(
    gap0,
    spacing,
    e_prime,
    *,
    mean_pressure=None,
    mean_gap=None,
    hardness=None,
    boundary=("periodic", "periodic"),
    tolerance=1e-6,
    start=None,
    operator=None,
    max_iterations=2000,
    raise_on_failure=True,
) -> ContactResult:
    """Pressure and gap of two rough bodies pressed together, without friction or adhesion.

    The conditions are ``p >= 0``, ``gap = gap0 - approach + K p >= 0``, ``p gap = 0``. With a hardness H also
    ``p <= H``, and cells at p = H may overlap (A. Akchurin et al., Tribol. Lett. 59:19 (2015), Eqs. 1-3,
    doi:10.1007/s11249-015-0536-z). The solve has converged when the largest residual of the report is <= tolerance
    (`ContactResult` has the formulas).

    Parameters
    ----------
    gap0 : (nx, ny) undeformed gap of the pair [m], up to a constant; x is axis 0
    spacing : cell size [m], one number or (dx, dy)
    e_prime : E' [Pa], 2/E' = sum (1 - nu²)/E
    mean_pressure : load per area of the whole array [Pa], or
    mean_gap : volume between the bodies per area of the whole array [m]; overlapping cells count as zero
    hardness : limit of the pressure [Pa]; None: elastic
    boundary : "periodic" or "free" for each axis, see `lubfric.contact.half_space`
    tolerance : largest residual accepted
    start : an earlier `ContactResult`, or a pressure field [Pa], to start from
    operator : a `HalfSpace` built before for this grid, to share between solves
    max_iterations, raise_on_failure : number of iterations after which the solve ends; False returns the unconverged
        result

    Returns
    -------
    ContactResult

    Raises
    ------
    InputError : a value out of range, before any work
    ConvergenceError : the tolerance was not met; carries report and result
    """
    problem = make_problem(gap0, spacing, e_prime, hardness, boundary, tolerance, operator, max_iterations)
    check_control(problem, mean_pressure, mean_gap)
    start = starting_pressure(problem, start)
    touching = float(problem.gap0.mean())
    if mean_pressure == 0 or (mean_gap is not None and mean_gap >= touching):
        return _separated(problem, touching if mean_gap is None else mean_gap)
    if mean_gap is None:
        found = load_controlled(problem, float(mean_pressure), start)
    else:
        found = gap_controlled(problem, float(mean_gap), start)
    result = _finish(problem, found, mean_pressure, mean_gap)
    if raise_on_failure:
        result.report.raise_if_failed(result)
    return result


def _separated(problem, mean_gap) -> ContactResult:
    approach = float(problem.gap0.mean() - mean_gap)
    zero = np.zeros_like(problem.gap0)
    report = Report(
        "none",
        CONVERGED,
        0,
        0.0,
        problem.tolerance,
        notes=("the bodies carry no load",),
        residuals={"complementarity": 0.0, "penetration": 0.0, "load": 0.0},
    )
    return ContactResult(
        zero, problem.gap0 - approach, zero.copy(), approach + problem.offset, 0.0, float(mean_gap), 0.0, 0.0, report
    )


def _finish(problem, found, mean_pressure, mean_gap) -> ContactResult:
    state = found.state
    pressure, gap, scale = state.pressure, state.gap, state.scale
    carried = float(pressure.mean())
    mean = volume(gap)
    residuals = dict(state.residuals)
    if mean_gap is None:
        residuals["load"] = abs(carried - mean_pressure) / mean_pressure
    else:
        residuals["volume"] = abs(mean - mean_gap) / min(scale, mean_gap)
    worst = max(residuals.values())
    status = (
        CONVERGED if worst <= problem.tolerance else (found.status if found.status != CONVERGED else ITERATION_LIMIT)
    )
    report = Report(
        found.solver,
        status,
        found.iterations,
        worst if math.isfinite(worst) else math.inf,
        problem.tolerance,
        residuals,
        tuple(found.history),
        found.convolutions,
        tuple(found.notes),
    )
    saturated = (
        np.count_nonzero(pressure >= problem.hardness) / pressure.size if math.isfinite(problem.hardness) else 0.0
    )
    return ContactResult(
        pressure,
        gap,
        state.displacement,
        float(state.approach) + problem.offset,
        carried,
        mean,
        np.count_nonzero(pressure) / pressure.size,
        saturated,
        report,
    )
