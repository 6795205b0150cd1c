"""First guesses: from nothing, from a coarser grid, from a solution of a neighbouring problem."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .grid import Grid
from .problem import Problem, expected_film


@dataclass(frozen=True)
class State:
    """Solution in Moes' variables, kept with a result so that it can start another solve.

    pressure: at the n nodes before rupture; film: the smallest; flux, rupture: q and e;
    grid_error: estimated relative discretisation error on these n cells.
    """

    M: float
    L: float
    pressure: np.ndarray
    film: float
    flux: float
    rupture: float
    grid_error: float


def expected_rupture(problem: Problem) -> float:
    """Rupture point of the guess, in units of x."""
    film = expected_film(problem.M, problem.L)
    b = problem.half_width
    return b + 0.8 * film / (np.sqrt(2.0 * film) + b)


def cold_start(grid: Grid, problem: Problem) -> np.ndarray:
    """A semi-ellipse of the right load that ends at the rupture point, over the expected film."""
    film = expected_film(problem.M, problem.L)
    e = expected_rupture(problem)
    width = np.hypot(problem.half_width, np.sqrt(2.0 * film))
    X = grid.xi + e
    P = np.sqrt(np.maximum(0.0, 1.0 - ((X - e + width) / width) ** 2))
    P[-1] = 0.0
    P *= problem.M / (grid.weights @ P)
    gap = 0.5 * X * X + grid.kernel @ P
    middle = np.abs(X) < 0.5 * width
    return np.concatenate([P[:-1], [film - gap[middle].mean(), film, e]])


def refine(pressure: np.ndarray) -> np.ndarray:
    """Pressures (n, rupture node left out) on a grid of twice the cells: cubic midpoints, even in the index."""
    P = np.append(pressure, 0.0)
    padded = np.concatenate([[2 * P[0] - P[1]], P, [P[-2]]])
    middle = (9.0 * (P[:-1] + P[1:]) - padded[:-3] - padded[3:]) / 16.0
    fine = np.empty(2 * pressure.size)
    fine[::2] = pressure
    fine[1::2] = np.where(middle > 0.0, middle, 0.5 * (P[:-1] + P[1:]))
    return fine


def coarsen(pressure: np.ndarray) -> np.ndarray:
    """Every second node."""
    return pressure[::2]


def warm_start(grid: Grid, problem: Problem, state: State) -> np.ndarray:
    """The pressures of ``state`` node by node, scaled to the load, over a film scaled by Moes' formula."""
    P = state.pressure
    while P.size > grid.n:
        P = coarsen(P)
    while P.size < grid.n:
        P = refine(P)
    ratio = expected_film(problem.M, problem.L) / expected_film(state.M, state.L)
    shift = expected_rupture(problem) / _rupture_of(state.M, state.L)
    P = np.append(P, 0.0) * (problem.M / (grid.weights[:-1] @ P))
    e = state.rupture * shift
    X = grid.xi + e
    gap = 0.5 * X * X + grid.kernel @ P
    return np.concatenate([P[:-1], [state.film * ratio - gap.min(), state.flux * ratio, e]])


def _rupture_of(M: float, L: float) -> float:
    film, b = expected_film(M, L), np.sqrt(8.0 * M / np.pi)
    return b + 0.8 * film / (np.sqrt(2.0 * film) + b)
