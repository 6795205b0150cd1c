"""First guesses: without any solution, from a coarser grid, and from a solution of a neighbouring problem."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .grid import Grid
from .imposed import Seat
from .newton import Solution
from .problem import Problem, seated_film
from .reynolds import elastic_film


@dataclass(frozen=True)
class State:
    """Solution in Moes' variables, kept with a result so that it can start another solve.

    pressure: at the n nodes before rupture; film: at all n + 1 nodes; flux: q; rupture: e, from the centre of the seat;
    grid_error: estimated relative discretisation error on these n cells; seat: of `Problem`.
    """

    M: float
    L: float
    pressure: np.ndarray
    film: np.ndarray
    flux: float
    rupture: float
    grid_error: float
    seat: Seat = Seat()


def expected_rupture(M: float, L: float, seat: Seat = Seat()) -> float:
    """Rupture point of the guess, in units of x, from the centre of the seat."""
    film, b = seated_film(M, L, seat) * seat.radius, np.sqrt(8.0 * M * seat.radius / (np.pi * seat.modulus))
    return b + 0.8 * film / (np.sqrt(2.0 * film) + b)


def rupture_guess(problem: Problem) -> float:
    """`expected_rupture`, but nearer to the centre if a starved film is thin."""
    expected = problem.seat_centre + expected_rupture(problem.M, problem.L, problem.seat)
    if problem.inlet_length is None:
        return expected
    return min(expected, problem.seat_centre + problem.seat_half_width + np.sqrt(2.0 * problem.film_guess))


def cold_start(grid: Grid, problem: Problem) -> tuple[np.ndarray, np.ndarray]:
    """(z, H): a semi-ellipse of the right load that ends at the rupture point, and the expected film."""
    film = problem.film_guess
    e = rupture_guess(problem)
    width = np.hypot(problem.half_width, np.sqrt(2.0 * film))
    P = np.sqrt(np.maximum(0.0, 1.0 - (grid.xi / width + 1.0) ** 2))
    P[-1] = 0.0
    P *= problem.M / (grid.weights @ P)
    z = np.append(P[:-1], [0.0, film, e])
    gap, _ = elastic_film(grid, problem, z)
    z[-3] = film - gap.min()
    return z, gap + z[-3]


def solution_state(problem: Problem, solution: Solution, error: float) -> State:
    """The `State` of a solution, ``error`` its estimated discretisation error."""
    t = solution.terms
    return State(
        problem.M,
        problem.L,
        t.P[:-1],
        t.H,
        float(t.q),
        float(solution.z[-1]) - problem.seat_centre,
        error,
        problem.seat,
    )


def from_alone(problem: Problem, state: State) -> State:
    """A state of ``problem.alone()``, in the units of ``problem``, as a state of ``problem``."""
    other = problem.alone()
    pressure, film = other.pressure_unit / problem.pressure_unit, other.film_unit / problem.film_unit
    return State(
        problem.M,
        problem.L,
        state.pressure * pressure,
        state.film * film,
        state.flux * film,
        state.rupture * (other.length_unit / problem.length_unit),
        state.grid_error,
        problem.seat,
    )


def refined_start(solution: Solution) -> tuple[np.ndarray, np.ndarray]:
    """(z, H) on a grid of twice the cells. The pressure is interpolated linearly, so that a sharp spike does not
    oscillate."""
    P = solution.terms.P
    fine = np.empty(2 * P.size - 2)
    fine[::2], fine[1::2] = P[:-1], 0.5 * (P[:-1] + P[1:])
    return np.append(fine, solution.z[-3:]), refine(solution.terms.H)


def warm_start(grid: Grid, problem: Problem, state: State) -> tuple[np.ndarray, np.ndarray]:
    """(z, H): pressure and film of ``state`` node by node, scaled to the load and by Moes' formula."""
    P, H = np.append(state.pressure, 0.0), state.film
    while H.size > grid.n + 1:
        P, H = P[::2], H[::2]
    while H.size < grid.n + 1:
        P, H = refine(P), refine(H)
    new, old = (problem.M, problem.L, problem.seat), (state.M, state.L, state.seat)
    ratio = seated_film(*new) / seated_film(*old)
    e = problem.seat_centre + state.rupture * (expected_rupture(*new) / expected_rupture(*old))
    P = P * (problem.M / (grid.weights @ P))
    z = np.append(P[:-1], [0.0, state.flux * ratio, e])
    gap, _ = elastic_film(grid, problem, z)
    z[-3] = state.film.min() * ratio - gap.min()
    return z, H * ratio


def refine(values: np.ndarray) -> np.ndarray:
    """Nonnegative nodal values with midpoints between them, cubic in the index where that is positive."""
    mean = 0.5 * (values[:-1] + values[1:])
    bend = np.diff(values, 2)
    middle = mean - 0.0625 * (np.append(bend[:1], bend) + np.append(bend, bend[-1:]))
    fine = np.empty(2 * values.size - 1)
    fine[::2] = values
    fine[1::2] = np.where(middle > 0.0, middle, mean)
    return fine
