"""First guesses: without any solution, from a coarser grid, and from a solution of a neighbouring problem."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .grid import Grid
from .problem import FilmProblem
from .reynolds import FilmSolution, elastic_film


@dataclass(frozen=True, kw_only=True)
class FilmState:
    """Solution in Moes' variables, kept with a result so that it can start another solve.

    problem: of which it is a solution; pressure: at the n nodes before rupture; film: at all n + 1 nodes; flux: q;
    rupture: e; grid_error: estimated relative discretisation error on these n cells;
    inlet: where the lubricant begins, if it does (of ``problem`` it may be a guess); nodes (n + 1,) from the rupture.
    """

    problem: FilmProblem
    pressure: np.ndarray
    film: np.ndarray
    flux: float
    rupture: float
    grid_error: float
    inlet: float | None = None
    nodes: np.ndarray | None = None


def _expected_rupture(problem: FilmProblem) -> float:
    """Return the rupture point of the guess, in units of x, of a flooded film."""
    film = problem.flooded_film
    b = problem.half_width
    return b + 0.8 * film / (np.sqrt(2.0 * film) + b)


def rupture_guess(problem: FilmProblem) -> float:
    """Return the rupture point of the guess, in units of x: nearer to the centre if a starved film is thin."""
    expected = _expected_rupture(problem)
    if problem.inlet is None:
        return expected
    return min(expected, problem.half_width + np.sqrt(2.0 * problem.film_guess))


def cold_start(grid: Grid, problem: FilmProblem) -> tuple[np.ndarray, np.ndarray]:
    """Return (z, H): a semi-ellipse of the right load that ends at the rupture point, and the expected film."""
    film = problem.film_guess
    e = rupture_guess(problem)
    width = np.hypot(problem.half_width, np.sqrt(2.0 * film))
    P = np.sqrt(np.maximum(0.0, 1.0 - (grid.xi / width + 1.0) ** 2))
    P[-1] = 0.0
    P *= problem.M / (grid.weights @ P)
    z = np.append(P[:-1], [0.0, film, e])
    gap, *_ = elastic_film(grid, z)
    z[-3] = film - gap.min()
    return z, gap + z[-3]


def solution_state(problem: FilmProblem, solution: FilmSolution, error: float) -> FilmState:
    """Return the `FilmState` of a solution, ``error`` its estimated discretisation error."""
    t = solution.terms
    rupture = float(solution.z[-1])
    inlet = None if problem.inlet is None else -float(t.X[0])
    return FilmState(
        problem=problem,
        pressure=t.P[:-1],
        film=t.H,
        flux=float(t.q),
        rupture=rupture,
        grid_error=error,
        inlet=inlet,
        nodes=solution.grid.xi,
    )


def refined_start(solution: FilmSolution) -> tuple[np.ndarray, np.ndarray]:
    """Return (z, H) on a grid of twice the cells. The pressure is interpolated linearly, so that a sharp spike does not
    oscillate."""
    P = solution.terms.P
    fine = np.empty(2 * P.size - 2)
    fine[::2] = P[:-1]
    fine[1::2] = 0.5 * (P[:-1] + P[1:])
    return np.append(fine, solution.z[-3:]), with_midpoints(solution.terms.H)


def warm_start(grid: Grid, problem: FilmProblem, state: FilmState) -> tuple[np.ndarray, np.ndarray]:
    """Return (z, H): pressure and film of ``state``, which may be of another problem, node by node, scaled to the load
    and by Moes' formula; where the lubricant begins somewhere, place by place."""
    P = np.append(state.pressure, 0.0)
    H = state.film
    ratio = problem.film_guess / state.problem.film_guess if problem.fed is None else problem.fed / state.flux
    if problem.inlet is not None and state.nodes is not None and not 0.8 < state.nodes[0] / grid.xi[0] < 1.25:
        bend = np.interp(grid.xi, state.nodes, H - 0.5 * state.nodes**2)
        P = np.append(0.0, np.interp(grid.xi[1:], state.nodes, P, left=0.0))
        H = (bend + 0.5 * grid.xi**2 + (ratio - 1.0) * state.flux) / ratio
    while H.size > grid.n + 1:
        P = P[::2]
        H = H[::2]
    while H.size < grid.n + 1:
        P = with_midpoints(P)
        H = with_midpoints(H)
    e = state.rupture * (_expected_rupture(problem) / _expected_rupture(state.problem))
    P = P * (problem.M / (grid.weights @ P))
    z = np.append(P[:-1], [0.0, state.flux * ratio, e])
    gap, *_ = elastic_film(grid, z)
    z[-3] = state.film.min() * ratio - gap.min()
    return z, H * ratio


def with_midpoints(values: np.ndarray) -> np.ndarray:
    """Return nonnegative nodal values with midpoints between them, cubic in the index where that is positive."""
    mean = 0.5 * (values[:-1] + values[1:])
    bend = np.diff(values, 2)
    middle = mean - 0.0625 * (np.append(bend[:1], bend) + np.append(bend, bend[-1:]))
    fine = np.empty(2 * values.size - 1)
    fine[::2] = values
    fine[1::2] = np.where(middle > 0.0, middle, mean)
    return fine
