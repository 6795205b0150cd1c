"""From solutions of the differential deflection method to errors, report and result."""

from __future__ import annotations

import math

import numpy as np

from ..errors import CONVERGED, STAGNATED, Report
from ..film import EHLResult, Problem, State, cubic, moes_film, node_positions, smallest
from .differential_newton import Solution

STATE_CELLS = 96


def grid_error(levels: list[Solution]) -> float:
    """Largest relative change of minimum, central and flow film between the last two grids, or a quarter of the change
    before that. This is some three times the error, because the rupture point is always at a node, which makes the
    error uneven."""
    films = np.array([[smallest(s.mesh.X, s.H), _at_centre(s), s.terms.q] for s in levels[-3:]])
    if len(films) < 2:
        return math.inf
    changes = np.max(np.abs(np.diff(films, axis=0) / films[-1]), axis=1)
    return float(max(changes[-1], changes[0] / 4 ** (changes.size - 1)))


def _at_centre(solution: Solution) -> float:
    X = solution.mesh.X
    return float(cubic(X, solution.H - 0.5 * X**2, np.zeros(1))[0])


def _domain_error(problem: Problem, solution: Solution) -> float:
    """The estimated effect of the finite inlet: the tail's share of the load times its departure from the parabola."""
    if problem.inlet_length is not None:
        return 0.0
    a = -solution.mesh.X[0]
    return float(0.5 * a * solution.P[0] / problem.M * abs(2.0 * solution.H[0] / a**2 - 1.0))


def _report(problem: Problem, levels: list[Solution], tolerance: float, notes: tuple) -> Report:
    last = levels[-1]
    residuals = {"discretisation": grid_error(levels), "domain": _domain_error(problem, last)}
    residuals |= last.residuals
    residual = max(residuals.values()) if np.all(np.isfinite(list(residuals.values()))) else math.inf
    status = last.status
    if status == CONVERGED and not residual <= tolerance:
        status = STAGNATED
    history = tuple(e for level in levels for e in level.history)
    first, end = last.mesh.X[[0, -1]] / problem.half_width
    notes += (f"{last.mesh.size} nodes from {first:.4g} to {end:.4g} half-widths",)
    if last.terms.last >= last.mesh.size - 2:
        notes += ("the film did not rupture inside the domain",)
    return Report(
        "line-contact EHL, differential deflection",
        status,
        len(history) - len(levels),
        residual,
        tolerance,
        residuals,
        history,
        sum(level.solves for level in levels),
        notes,
    )


def _with_rupture(solution: Solution) -> tuple[float, np.ndarray, np.ndarray, np.ndarray]:
    """The rupture point, where the film is that of the flow, and X, P, H with a node added there."""
    X, P, H, last, q = solution.mesh.X, solution.P, solution.H, solution.terms.last, solution.terms.q
    if last >= X.size - 2:  # none: reported
        return float(X[last]), X, P, H
    before, behind = 0.5 * (H[last] + H[last + 1]), 0.5 * (H[last + 1] + H[last + 2])
    share = np.clip((q - before) / (behind - before), 0.0, 1.0) if behind > before else 0.5
    e = X[last] + (0.5 + float(share)) * solution.mesh.step
    i = int(np.searchsorted(X, e))
    if min(abs(X[i] - e), abs(X[i - 1] - e)) < 1e-3 * solution.mesh.step:
        return float(X[i] if X[i] - e < e - X[i - 1] else X[i - 1]), X, P, H
    film = cubic(X, H - 0.5 * X**2, np.array([e]))[0] + 0.5 * e * e
    return e, np.insert(X, i, e), np.insert(P, i, 0.0), np.insert(H, i, film)


def _state(problem: Problem, solution: Solution, rupture: float, error: float) -> State:
    """The `State` from which `solve_ehl` can start: the solution on the graded grid of `solve_ehl`."""
    xi = node_positions(problem.half_width, moes_film(problem.M, problem.L), STATE_CELLS)
    X = xi + rupture
    P = np.interp(X, solution.mesh.X, solution.P, left=0.0)
    H = np.interp(X, solution.mesh.X, solution.H - 0.5 * solution.mesh.X**2) + 0.5 * X**2
    return State(problem.M, problem.L, P[:-1], H, solution.terms.q, rupture, error)


def assemble(problem: Problem, levels: list[Solution], tolerance: float, notes: tuple[str, ...]) -> EHLResult:
    """The result in SI units, seen along +x."""
    last, contact = levels[-1], problem.contact
    sign = math.copysign(1.0, contact.entrainment_speed)
    rupture, X, P, H = _with_rupture(last)
    mesh, q = last.mesh, last.terms.q
    b, length, film = problem.half_width, problem.length_unit, problem.film_unit
    constant = last.H[0] - 0.5 * mesh.X[0] ** 2 - mesh.log_kernel @ last.P
    order = slice(None) if sign > 0 else slice(None, None, -1)
    report = _report(problem, levels, tolerance, notes)
    return EHLResult(
        x=(sign * X * length)[order],
        pressure=(P * problem.pressure_unit)[order],
        film_thickness=(H * film)[order],
        viscosity=contact.lubricant.viscosity * np.exp(problem.log_viscosity(P)[0])[order],
        density_ratio=problem.density(P)[0][order],
        min_film=smallest(mesh.X, last.H) * film,
        central_film=_at_centre(last) * film,
        flow_film=q * film,
        flux=q * film * contact.entrainment_speed,
        rupture=rupture * length * sign,
        approach=float(constant - 4.0 / math.pi * mesh.step * last.P.sum() * math.log(b)) * film,
        half_width=b * length,
        hertz_pressure=2.0 * problem.M / (math.pi * b) * problem.pressure_unit,
        contact=contact,
        report=report,
        state=_state(problem, last, rupture, report.residuals["discretisation"]),
    )
