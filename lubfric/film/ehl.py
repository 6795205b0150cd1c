"""The film of any regime, on nested grids from a warm or a cold start.

``solve_line_contact(LineContact(...), Effort(tolerance, least_cells), imposed=, start=)`` returns an `EHLResult`;
`solve_ehl` is the same with plain numbers. A light film (Moes' M below 1) takes some 5 ms.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from .._base import instance, integer, number, positive
from ..errors import CONVERGED, InputError
from ..oil import Lubricant
from .assemble import assemble, grid_error
from .ehl_result import EHLResult
from .grid import FAR_INLET, LinePressure, line_pressure, make_grid, node_positions
from .hertz import LineContact
from .problem import Problem
from .reynolds import Solution, newton
from .start import State, cold_start, on_seats, refined_start, rupture_guess, solution_state, warm_start

COARSEST, STARTS, FINEST = 48, 5, 3072  # cells; a cold start has COARSEST, or up to STARTS - 1 times doubled
WIDE = 2000.0  # of M: beyond it COARSEST cells do not hold the inlet
COARSE_TOLERANCE = 5e-3  # from here on two grids are enough for a cold start
DOUBLINGS = 8  # of the speed, to begin with a film too thick to feel an imposed pressure
EASY, STAGE = 4.0, 1.4  # Newton's method starts safely at L <= EASY; L may grow by STAGE between solutions


@dataclass(frozen=True)
class Effort:
    """The accuracy asked for and the effort allowed: relative ``tolerance`` of the films (1e-5 to 0.1), cells before
    rupture that are used even if the films need fewer, and Newton steps per grid."""

    tolerance: float = 3e-3
    least_cells: int = 0
    max_iterations: int = 60

    def __post_init__(self):
        number("tolerance", self.tolerance, "", minimum=1e-5, maximum=0.1)
        integer("least_cells", self.least_cells, minimum=0)
        integer("max_iterations", self.max_iterations, minimum=1)


def solve_ehl(
    *,
    load_per_width: float,
    radius: float,
    e_prime: float,
    entrainment_speed: float,
    viscosity: float,
    pressure_viscosity_coefficient: float,
    viscosity_law: str = "roelands",
    density_law: str = "constant",
    tolerance: float = 3e-3,
    inlet_length: float | None = None,
    imposed_pressure=None,
    start: EHLResult | None = None,
    least_cells: int = 0,
    max_iterations: int = 60,
    raise_on_failure: bool = True,
) -> EHLResult:
    """Film of a smooth line contact: Reynolds' equation, elastic half-spaces, a given load.

    The equations are d/dx(rho h³/(12 eta) dp/dx) = U d(rho h)/dx, with p = dp/dx = 0 at the rupture point
    (Swift-Stieber), h = h0 + x²/2R - (4/(pi E')) ∫ p ln|x - x'| dx', and ∫ p dx = load_per_width. They are solved by
    Newton's method on nested grids (`lubfric.film.reynolds`), and checked for Moes' M = 1e-12 to 1000, L = 0 to 20, and
    for nearly rigid bodies (L to 1e4 at M <= 0.01). The cells are doubled until the largest residual of the report
    (`EHLResult`) is <= tolerance.

    Parameters
    ----------
    load_per_width : > 0 [N/m]
    radius, e_prime : R > 0 [m]; E' > 0 [Pa], 2/E' = sum (1 - nu²)/E
    entrainment_speed : U = (u1 + u2)/2 [m/s], not 0; a negative one mirrors the solution
    viscosity, pressure_viscosity_coefficient : eta0 at ambient pressure [Pa s]; alpha [1/Pa]
    viscosity_law, density_law : see `lubfric.Lubricant`, also for the ranges of the laws
    tolerance : relative error of min_film and flow_film from grid and domain, 1e-5 to 0.1
    inlet_length : None: fully flooded, the pressure decays to -infinity; or the distance [m] upstream of the line of
        centres at which the lubricant begins (starved)
    imposed_pressure : None, or (x [m], pressure [Pa]), (m,) each, x ascending, pressure >= 0: a line pressure, linear
        between the x and zero outside, that deflects the film in addition to p, and carries no load (kinks cost cells)
    start : the result of a neighbouring load or speed; if it leads nowhere, a cold start is made, and noted
    least_cells, max_iterations : least cells before rupture (0 to 3072); Newton steps per grid
    raise_on_failure : False returns an unconverged result with its report

    Returns
    -------
    EHLResult

    Raises
    ------
    InputError : a value out of range, before any work
    ConvergenceError : residuals above tolerance; carries report and result
    """
    lubricant = Lubricant(viscosity, pressure_viscosity_coefficient, viscosity_law, density_law)
    return solve_line_contact(
        LineContact(load_per_width, radius, e_prime, entrainment_speed, lubricant),
        Effort(tolerance, least_cells, max_iterations),
        inlet_length=inlet_length,
        imposed=imposed_pressure,
        start=start,
        raise_on_failure=raise_on_failure,
    )


def solve_line_contact(
    contact: LineContact,
    effort: Effort = Effort(),
    *,
    inlet_length: float | None = None,
    imposed=None,
    start: EHLResult | None = None,
    raise_on_failure: bool = True,
) -> EHLResult:
    """`solve_ehl` for a `LineContact`. ``effort``: tolerance and limits; ``imposed``: as ``imposed_pressure`` there, or
    a `LinePressure`."""
    problem = make_problem(contact, inlet_length, line_pressure(imposed))
    if start is not None:
        instance("start", start, EHLResult, "an EHLResult or None")
    seated = on_seats(problem)
    levels: list[Solution] = []
    first: list[Solution] = []
    notes: tuple[str, ...] = ()
    if start is not None:
        alike = [p for p in seated if (p.seat_modulus < 1.0) == (start.state.problem.seat_modulus < 1.0)]
        problem = (alike or seated)[0]
        levels = _warm(problem, effort, start.state)
        if not _sound(levels):
            notes = ("the warm start failed; solved again from a cold start",)
    if not _sound(levels):
        problem, levels, first, retries = _cold(seated, effort)
        notes += retries
    result = assemble(problem, levels, first, effort.tolerance, notes)
    if raise_on_failure:
        result.report.raise_if_failed(result)
    return result


def make_problem(contact: LineContact, inlet_length: float | None, imposed: LinePressure | None = None) -> Problem:
    """The contact in Moes' units, along its motion. Raises `InputError` if the lubricant begins inside the dry
    contact."""
    if imposed is not None and contact.entrainment_speed < 0:
        imposed = imposed.mirrored()
    problem = Problem(contact, inlet_length, imposed)
    half_width = problem.flat_half_width * problem.length_unit
    if inlet_length is not None and positive("inlet_length", inlet_length, "m") <= half_width:
        raise InputError(
            f"inlet_length = {inlet_length:g} m lies inside the dry contact; "
            f"allowed: more than its half-width {half_width:.4g} m"
        )
    return problem


def _warm(problem: Problem, effort: Effort, state: State) -> list[Solution]:
    """Two grids; the finer one is at least as fine as the error of ``state`` demands."""
    n = _coarsest(problem)
    needed = max(effort.least_cells, state.pressure.size * min(4.0, math.sqrt(state.grid_error / effort.tolerance)))
    while 2 * n < min(needed, FINEST):
        n *= 2
    return _ascend(problem, effort, state, n, 2)


def _cold(
    seated: tuple[Problem, ...], effort: Effort
) -> tuple[Problem, list[Solution], list[Solution], tuple[str, ...]]:
    """A solution from a cold start on grids from the coarsest up; if that fails, from another start or on a finer grid.

    Returns the problem on its seat with its solutions, the solutions that led there, and notes.
    """
    spent: list[Solution] = []
    notes: tuple[str, ...] = ()
    coarsest = _coarsest(seated[0])
    grids = sorted((COARSEST * 2**k for k in range(STARTS)), key=lambda n: n != coarsest)
    beginnings = [(problem, 0) for problem in seated] + [(seated[0], DOUBLINGS)] * (len(seated) > 1)
    for n, (problem, doublings) in product(grids, beginnings):
        if spent:
            notes += (f"the cold start failed; tried again from {n} cells",)
        state, first = _first_state(problem, n, effort.max_iterations, doublings)
        levels = _ascend(problem, effort, state, n, 2 if effort.tolerance >= COARSE_TOLERANCE else 3)
        if _sound(levels):
            return problem, levels, spent + first, notes
        spent += first + levels
        if levels[0].status == CONVERGED and levels[-1].grid.n >= COARSEST * 2 ** (STARTS - 1):
            break  # it is not the start that fails
    return problem, levels, spent[: -len(levels)], notes


def _coarsest(problem: Problem) -> int:
    """Cells of the coarsest grid: more if the inlet is far narrower than the contact."""
    return COARSEST * 2 ** min(max(0, math.ceil(math.log(problem.M / WIDE, 4))), STARTS - 1)


def _ascend(problem: Problem, effort: Effort, state: State, n: int, fewest: int) -> list[Solution]:
    """Solutions on grids of n, 2n, ... cells, at least ``fewest`` of them, until they are as accurate as asked."""
    rupture = rupture_guess(problem)
    levels: list[Solution] = []
    while True:
        grid = make_grid(problem_nodes(problem, n, rupture))
        z, H = refined_start(levels[-1]) if levels else warm_start(grid, problem, state)
        levels.append(newton(grid, problem, z, H, 1e-3 * effort.tolerance, effort.max_iterations))
        if not _sound(levels) or n >= FINEST:
            return levels
        if len(levels) >= fewest and n >= effort.least_cells and grid_error(levels) <= effort.tolerance:
            return levels
        rupture = levels[-1].z[-1]
        n *= 2


def _first_state(problem: Problem, n: int, max_steps: int, doublings: int = 0) -> tuple[State, list[Solution]]:
    """The first state, and the chain of rough solutions on n cells that leads there, each started from the one before.

    alpha rises from the value at which L = EASY. With an imposed pressure this is done for the cylinder of the seat
    alone, at a speed that is doubled so many times, because a thick film bridges any gap that an imposed pressure
    leaves. Then the speed is halved again and again.
    """
    slower = [_faster(problem, 2.0**k) for k in range(doublings, 0, -1)]
    alone = (slower or [problem])[0].alone()
    shares = [min(1.0, EASY / max(alone.L, EASY))]
    while shares[-1] < 1.0:
        shares.append(min(1.0, STAGE * shares[-1]))
    states: list[State] = []
    solutions: list[Solution] = []
    for stage in [alone.softened(share) for share in shares] + slower:
        grid = make_grid(problem_nodes(stage, n, rupture_guess(stage)))
        z, H = warm_start(grid, stage, states[-1]) if states else cold_start(grid, stage)
        solutions.append(newton(grid, stage, z, H, 0.03, max_steps))
        states.append(solution_state(stage, solutions[-1], 0.0))
        if not np.isfinite(solutions[-1].error):
            break
    return states[-1], solutions


def _faster(problem: Problem, factor: float) -> Problem:
    """The same contact at ``factor`` times its speed, on the likelier seat there."""
    contact = replace(problem.contact, entrainment_speed=problem.contact.entrainment_speed * factor)
    return on_seats(replace(problem, contact=contact))[0]


def problem_nodes(problem: Problem, n: int, rupture: float) -> np.ndarray:
    """Nodes (n + 1) relative to the rupture point, which is expected at ``rupture``."""
    distance = None
    if problem.inlet_length is not None:
        distance = problem.inlet_length / problem.length_unit + rupture
    elif problem.imposed is not None:
        distance = 3.0 * problem.flat_half_width + FAR_INLET * math.sqrt(2.0 * problem.film_guess) + rupture
    return node_positions(problem.seat_half_width, problem.film_guess * problem.seat_radius, n, distance)


def _sound(levels: list[Solution]) -> bool:
    """Whether a solution has converged, and is not a root with tension in the film or with the inlet on the wrong
    side."""
    if not levels or levels[-1].status != CONVERGED:
        return False
    P, X = levels[-1].terms.P, levels[-1].terms.X
    return bool(X[0] < 0.0 and X[-1] < -X[0] and P.min() >= -1e-3 * P.max())
