"""`solve_ehl`: checks, nested grids, error estimate, report."""

from __future__ import annotations

import math

import numpy as np

from ..errors import InputError
from ..lubricant import Lubricant
from ..report import CONVERGED, ITERATION_LIMIT, Report
from ..validate import integer, number, positive
from .grid import make_grid, node_positions
from .kernel import hat_kernel
from .newton import Solution, newton
from .problem import Problem, expected_film
from .result import EHLResult, cubic, smallest
from .start import State, cold_start, expected_rupture, refined_start, warm_start

COARSEST, FINEST = 48, 3072
ORDER = 2


def solve_ehl(*, load_per_width: float, radius: float, e_prime: float, entrainment_speed: float, viscosity: float,
              pressure_viscosity_coefficient: float, viscosity_law: str = "roelands", density: str = "constant",
              tolerance: float = 3e-3, inlet_length: float | None = None, start: EHLResult | None = None,
              max_iterations: int = 60, raise_on_failure: bool = True) -> EHLResult:
    """Film of a smooth line contact: Reynolds, elastic half-spaces, load.

    Solves d/dx(rho h³/(12 eta) dp/dx) = U d(rho h)/dx with p = dp/dx = 0 at the rupture point
    (Swift-Stieber), h = h0 + x²/2R - (4/(pi E')) ∫ p ln|x - x'| dx' and ∫ p dx = load_per_width, by Newton's method on
    nested grids that move with the rupture point (`lubfric.ehl.reynolds`).

    Parameters
    ----------
    load_per_width : > 0 [N/m]; radius : reduced radius R > 0 [m]
    e_prime : reduced modulus E' > 0 [Pa], 2/E' = sum (1 - nu²)/E
    entrainment_speed : U = (u1 + u2)/2 [m/s], not 0; negative mirrors the solution
    viscosity : eta0 [Pa s]; pressure_viscosity_coefficient : alpha [1/Pa]; viscosity_law, density : see
        `lubfric.lubricant.Lubricant`, also for the ranges of the laws
    tolerance : relative error of min_film and flow_film from grid and domain, 1e-5 to 0.1
    inlet_length : None: fully flooded, the pressure decays to -infinity; or the distance [m]
        upstream of the line of centres at which the lubricant begins (starved)
    start : the result of a neighbouring load or speed. A start that does not lead to a solution is dropped for a
        cold one, which report.notes tells.
    max_iterations : Newton steps per grid

    The cells are doubled until ``discretisation`` <= tolerance. report.residuals, all relative:
    discretisation : largest change of min_film, central_film and flow_film against the grid of half the cells,
        or a quarter of the change before that, divided by 3 (second order)
    domain : estimated effect of the finite inlet on flow_film
    mass : largest |flux through a face/q - 1|; load : |∫ p dx/load - 1|; both <= 1e-3 tolerance
    complementarity : largest of -p/p_max before rupture and of 1 - h/h_rupture behind it

    Raises
    ------
    InputError : a value out of range, before any work
    ConvergenceError : residuals above tolerance, with report and result; not if raise_on_failure is False

    Similarity solution in M and L; checked for M = 1e-6 to 1000, L = 0 to 20.
    """
    speed = number("entrainment_speed", entrainment_speed, "m/s")
    if speed == 0.0:
        raise InputError("entrainment_speed = 0 m/s carries no steady film; allowed: any other finite speed")
    lubricant = Lubricant(viscosity, pressure_viscosity_coefficient, viscosity_law, density)
    problem = Problem(positive("load_per_width", load_per_width, "N/m"), positive("radius", radius, "m"),
                      positive("e_prime", e_prime, "Pa"), abs(speed), lubricant,
                      None if inlet_length is None else positive("inlet_length", inlet_length, "m"))
    tolerance = number("tolerance", tolerance, "", minimum=1e-5, maximum=0.1)
    max_iterations = integer("max_iterations", max_iterations, minimum=1)
    if start is not None and not isinstance(start, EHLResult):
        raise InputError(f"start = {type(start).__name__} is not an EHLResult; allowed: an EHLResult or None")

    levels, notes = None, ()
    if start is not None:
        levels = _ascend(problem, tolerance, max_iterations, start.state)
        if not _sound(levels):
            notes = ("warm start failed; solved again from a cold start",)
    if levels is None or not _sound(levels):
        levels = _ascend(problem, tolerance, max_iterations, None)
    result = _result(problem, levels, tolerance, math.copysign(1.0, speed), notes)
    if raise_on_failure:
        result.report.raise_if_failed(result)
    return result


def _ascend(problem: Problem, tolerance: float, max_steps: int, state: State | None) -> list[Solution]:
    """Solutions on grids of doubling size until two neighbours agree to ``tolerance``."""
    n = COARSEST
    if state is not None:
        needed = state.pressure.size * math.sqrt(state.grid_error / tolerance)
        while 2 * n < needed and 2 * n < FINEST:
            n *= 2
    rupture = expected_rupture(problem.M, problem.L)
    levels: list[Solution] = []
    while True:
        grid = make_grid(_positions(problem, n, rupture))
        if levels:
            z, H = refined_start(levels[-1].z, levels[-1].terms.H)
        else:
            z, H = cold_start(grid, problem) if state is None else warm_start(grid, problem, state)
        levels.append(newton(grid, problem, z, H, 1e-3 * tolerance, max_steps))
        if levels[-1].status != CONVERGED or n >= FINEST:
            return levels
        if len(levels) > 1 and grid_error(levels) <= tolerance:
            return levels
        rupture = levels[-1].z[-1]
        n *= 2


def _positions(problem: Problem, n: int, rupture: float) -> np.ndarray:
    distance = None
    if problem.inlet_length is not None:
        distance = problem.inlet_length / problem.length_unit + rupture
    return node_positions(problem.half_width, expected_film(problem.M, problem.L), n, distance)


def grid_error(levels: list[Solution]) -> float:
    """Relative discretisation error of the last solution: second-order extrapolation of the changes of smallest, central
    and flow film between the last two grids, or, if larger, a quarter of the change before that."""
    films = np.array([[smallest(s.terms.X, s.terms.H), _at_centre(s), s.terms.q] for s in levels[-3:]])
    if len(films) < 2:
        return math.inf
    changes = np.max(np.abs(np.diff(films, axis=0) / films[-1]), axis=1)
    return float(max(changes[-1], changes[0] / 2 ** (ORDER * (changes.size - 1))) / (2**ORDER - 1))


def _at_centre(solution: Solution) -> float:
    t = solution.terms
    return float(cubic(t.X, t.H - 0.5 * t.X**2, np.zeros(1))[0])


def domain_error(problem: Problem, solution: Solution) -> float:
    """Effect of the tail's next-order term: its share of the load times the departure from the bare parabola."""
    if problem.inlet_length is not None:
        return 0.0
    t = solution.terms
    a = -t.X[0]
    return 0.5 * a * t.P[0] / problem.M * abs(2.0 * t.H[0] / a**2 - 1.0)


def complementarity(solution: Solution, outlet_film: np.ndarray) -> float:
    """Largest tension before rupture (share of the largest pressure) and film deficit behind it (share of h)."""
    P, H = solution.terms.P, solution.terms.H
    return max(0.0, -float(P.min()) / float(P.max()), 1.0 - float(outlet_film.min() / H[-1]))


def _sound(levels: list[Solution]) -> bool:
    P = levels[-1].terms.P
    return levels[-1].status == CONVERGED and bool(P.min() >= -1e-3 * P.max())


def _outlet(problem: Problem, solution: Solution) -> tuple[np.ndarray, np.ndarray]:
    """Nodes behind the rupture point, graded like those before it, and the film there."""
    xi = solution.grid.xi
    reach = 2.0 * problem.half_width + 3.0 * math.sqrt(2.0 * solution.terms.q)
    mirrored = -xi[-2::-1]
    behind = mirrored[: max(8, int(np.searchsorted(mirrored, reach)) + 1)][1::2]
    X = behind + solution.z[-1]
    H = solution.z[-3] + 0.5 * X * X + hat_kernel(behind, xi) @ solution.terms.P
    return X, H


def _report(problem, levels, tolerance, residuals, notes) -> Report:
    last = levels[-1]
    history = tuple(e for level in levels for e in level.history)
    residual = max(residuals.values())
    status = last.status
    if status == CONVERGED and not residual <= tolerance:
        status = ITERATION_LIMIT
    notes += (f"{last.grid.n} cells before rupture; inlet at {last.terms.X[0] / problem.half_width:.4g} half-widths",)
    return Report("line-contact EHL, Newton on nested grids", status, len(history) - len(levels), residual, tolerance,
                  residuals, history, len(history) - len(levels), notes)


def _result(problem: Problem, levels: list[Solution], tolerance: float, sign: float, notes: tuple) -> EHLResult:
    last = levels[-1]
    t, M = last.terms, problem.M
    X_out, H_out = _outlet(problem, last)
    n = last.grid.n
    X, H = np.concatenate([t.X, X_out]), np.concatenate([t.H, H_out])
    P = np.concatenate([t.P, np.zeros_like(X_out)])
    error = grid_error(levels)
    tail = 0.5 * -t.X[0] * t.P[0] if problem.inlet_length is None else 0.0
    residuals = {"discretisation": error, "domain": domain_error(problem, last),
                 "mass": float(np.max(np.abs(t.flux / t.q - 1.0))),
                 "load": abs((last.grid.weights @ t.P + tail) / M - 1.0),
                 "complementarity": complementarity(last, H_out)}
    report = _report(problem, levels, tolerance, residuals, notes)
    b, length, film = problem.half_width, problem.length_unit, problem.film_unit
    nodal_load = last.grid.weights @ t.P
    bend = H - 0.5 * X * X
    order = slice(None) if sign > 0 else slice(None, None, -1)
    lubricant = problem.lubricant
    pressure = (P * problem.pressure_unit)[order]
    state = State(M, problem.L, t.P[:n], t.H, float(t.q), float(last.z[-1]), error)
    return EHLResult(
        x=(sign * X * length)[order], pressure=pressure, film_thickness=(H * film)[order],
        viscosity=lubricant.viscosity * np.exp(problem.log_viscosity(P)[0])[order],
        density_ratio=problem.density(P)[0][order], min_film=smallest(X, H) * film,
        central_film=float(cubic(X, bend, np.zeros(1))[0]) * film, flow_film=float(t.q) * film,
        flux=float(t.q) * film * problem.speed * sign, rupture=float(last.z[-1]) * length * sign,
        approach=(float(last.z[-3]) - 4.0 / math.pi * nodal_load * math.log(b)) * film, half_width=b * length,
        hertz_pressure=2.0 * M / (math.pi * b) * problem.pressure_unit, load=problem.load, radius=problem.radius,
        e_prime=problem.e_prime, entrainment_speed=sign * problem.speed, load_number=M,
        material_number=problem.L, report=report, state=state)
