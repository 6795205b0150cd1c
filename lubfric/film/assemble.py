"""From solutions on nested grids to errors, report and result."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from .._base import FloatArray
from ..errors import CONVERGED, ITERATION_LIMIT, Report, worst
from .ehl_result import EHLResult, central_film, smallest
from .grid import hat_kernel
from .problem import FilmProblem
from .reynolds import FilmSolution
from .start import solution_state


def grid_error(on_grids: list[FilmSolution]) -> float:
    """Return the relative discretisation error of the last solution; the formula is in `solve_ehl`.

    Second order would allow c1/3. At random M, L and laws the formula bounds the error in nine cases of ten, and in
    the rest mostly within a factor of two. It also covers central_film, unless the pressure spike sits at x = 0 (M
    near 2, L above 12): then no grid converges central_film, and a note shows its change.
    """
    films = np.array([[smallest(s.terms.X, s.terms.H), s.terms.q] for s in on_grids[-3:]])
    if len(films) < 2:
        return math.inf
    changes = np.max(np.abs(np.diff(films, axis=0) / films[-1]), axis=1)
    return float(changes[0] / 1.5 if changes.size == 1 else max(changes[1], changes[0] / 3.0) / 2.0)


def domain_error(problem: FilmProblem, solution: FilmSolution) -> float:
    """Return the effect of the next order of the inlet condition: the tail's share of the load times 4 (q + |H -
    X²/2|)/(X²/2). It was tested against longer domains."""
    if problem.inlet is not None:
        return 0.0
    t = solution.terms
    a = -t.X[0]
    departure = 2.0 * t.q / a**2 + abs(2.0 * t.H[0] / a**2 - 1.0)
    return float(4.0 * departure * 0.5 * a * t.P[0] / problem.M)


def complementarity(solution: FilmSolution, outlet_film: np.ndarray) -> float:
    """Return the largest tension before rupture (over the largest pressure), or largest film deficit behind it (over
    h)."""
    P = solution.terms.P
    H = solution.terms.H
    return max(0.0, -float(P.min()) / float(P.max()), 1.0 - float(outlet_film.min() / H[-1]))


def _outlet(problem: FilmProblem, solution: FilmSolution) -> tuple[np.ndarray, np.ndarray]:
    """Return the nodes behind the rupture point, graded like those before it, and the film there."""
    xi = solution.grid.xi
    reach = 2.0 * problem.half_width + 3.0 * math.sqrt(2.0 * solution.terms.q)
    mirrored = -xi[-2::-1]
    behind = mirrored[: max(8, int(np.searchsorted(mirrored, reach)) + 1)][1::2]
    X = behind + solution.z[-1]
    return X, solution.z[-3] + 0.5 * X * X + hat_kernel(behind, xi) @ solution.terms.P


def rolling_resistance(problem: FilmProblem, on_grids: list[FilmSolution]) -> tuple[float, float]:
    """Return the half of ∫ h dp, the resistance to rolling [N/m], from the gap of the undeformed bodies, and its
    estimated error.

    The kernel of the half-space is even, so a pressure does no work when it is shifted together with the deflection
    that it causes: ∫ (K p) dp = 0. What is left of ∫ h dp is ∫ (x²/2R) dp, the first moment of the pressure, -∫ x p
    dx/R. The direct sum of h dp is a small difference at high pressure, and takes ten times as many cells for the same
    error.

    It is extrapolated to second order from the last two of the solutions ``on_grids``, ever finer ones. The error is
    the step of the extrapolation, or a quarter of the one before if that is larger.
    """
    unit = problem.pressure_unit * problem.film_unit
    works = [unit * _half_work(solution) for solution in on_grids[-3:]]
    steps = np.diff(works) / 3.0
    if not steps.size:
        return works[-1], math.inf
    before = abs(steps[0]) / 4.0 if steps.size > 1 else 0.0
    return float(works[-1] + steps[-1]), float(max(abs(steps[-1]), before))


def _half_work(solution: FilmSolution) -> float:
    """Return ∫ h dp/2 of a pressure that is linear between the nodes and zero upstream of the first."""
    t = solution.terms
    square = (t.X[1:] ** 2 + t.X[1:] * t.X[:-1] + t.X[:-1] ** 2) / 6.0
    return 0.5 * float(np.diff(t.P) @ square - t.P[0] * (t.H[0] - 0.5 * t.X[0] ** 2))


def reported(
    solver: str,
    solutions: Sequence[Any],
    residuals: dict[str, float],
    tolerance: float,
    notes: tuple[str, ...],
    failed: str = ITERATION_LIMIT,
    solves: int | None = None,
) -> Report:
    """Return the report of ``solutions``, the last of which counts; ``failed``: its status if it has converged and a
    residual is still above the ``tolerance``; ``solves``: their number (None: one a step)."""
    history = tuple(e for solution in solutions for e in solution.history)
    steps = len(history) - len(solutions)
    residual = worst(residuals)
    status = solutions[-1].status
    status = failed if status == CONVERGED and residual > tolerance else status
    evaluations = steps if solves is None else solves
    return Report(
        solver,
        status,
        iterations=steps,
        residual=residual,
        tolerance=tolerance,
        residuals=residuals,
        history=history,
        evaluations=evaluations,
        notes=notes,
    )


def _report(
    problem: FilmProblem,
    on_grids: list[FilmSolution],
    first: list[FilmSolution],
    tolerance: float,
    residuals: dict[str, float],
    notes: tuple[str, ...],
) -> Report:
    last = on_grids[-1]
    inlet = last.terms.X[0] / problem.half_width
    centre = [central_film(solution.terms.X, solution.terms.H) for solution in on_grids[-2:]]
    change = abs(centre[0] / centre[-1] - 1.0)
    if change > 2.0 * tolerance:
        notes += (f"central_film changed by {change:.1e} between the last two grids",)
    notes += (f"{last.grid.n} cells before rupture; inlet at {inlet:.4g} half-widths",)
    return reported("line-contact EHL, Newton on nested grids", first + on_grids, residuals, tolerance, notes)


def assemble(
    problem: FilmProblem,
    on_grids: list[FilmSolution],
    first: list[FilmSolution],
    notes: tuple[str, ...],
    tolerance: float,
) -> EHLResult:
    """Return the result in SI units from solutions on nested grids, seen along +x."""
    last = on_grids[-1]
    M = problem.M
    t = last.terms
    X_out, H_out = _outlet(problem, last)
    X = np.concatenate([t.X, X_out])
    H = np.concatenate([t.H, H_out])
    P = np.concatenate([t.P, np.zeros_like(X_out)])
    error = grid_error(on_grids)
    tail = 0.5 * -t.X[0] * t.P[0] if problem.inlet is None else 0.0
    residuals = {
        "discretisation": error,
        "domain": domain_error(problem, last),
        "mass": float(np.max(np.abs(t.flux / t.q - 1.0))),
        "load": abs((last.grid.weights @ t.P + tail) / M - 1.0),
        "complementarity": complementarity(last, H_out),
    }
    if problem.fed is not None:
        residuals["supply"] = abs(t.q / problem.fed - 1.0)
    return in_si(
        problem,
        (X, P, H),
        load=last.grid.weights @ t.P,
        films=(smallest(X, H), central_film(X, H)),
        flow=float(t.q),
        rupture=float(last.z[-1]),
        constant=float(last.z[-3]),
        report=_report(problem, on_grids, first, tolerance, residuals, notes),
        state=solution_state(problem, last, error),
        rolling=rolling_resistance(problem, on_grids),
    )


def in_si(
    problem: FilmProblem,
    at: Sequence[FloatArray],
    *,
    load: float,
    films: tuple[float, float],
    flow: float,
    rupture: float,
    constant: float,
    **known: Any,
) -> EHLResult:
    """Return the result in SI units, seen along +x. ``at``: (X, P, H) at the nodes; ``load``: ∫ P dX between them;
    ``films``: the smallest, and that at X = 0; ``constant``: H00; ``known``: what has no unit to change."""
    (X, P, H) = at
    line = problem.line
    b = problem.half_width
    sign = math.copysign(1.0, line.entrainment_speed)
    length = problem.length_unit
    film = problem.film_unit
    with np.errstate(over="ignore"):  # Barus far above its range: infinite beyond e^709
        viscosity = line.lubricant.viscosity * np.exp(problem.log_viscosity(P)[0])
    order = slice(None) if sign > 0 else slice(None, None, -1)
    return EHLResult(
        x=(sign * X * length)[order],
        pressure=(P * problem.pressure_unit)[order],
        film_thickness=(H * film)[order],
        viscosity=viscosity[order],
        density_ratio=problem.density(P)[0][order],
        min_film=films[0] * film,
        central_film=films[1] * film,
        flow_film=flow * film,
        flux=flow * film * line.entrainment_speed,
        rupture=rupture * length * sign,
        approach=(constant - 4.0 / math.pi * load * math.log(b)) * film,
        half_width=b * length,
        hertz_pressure=2.0 * problem.M / (math.pi * b) * problem.pressure_unit,
        line=line,
        **known,
    )
