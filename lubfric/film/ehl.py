"""The film of any regime.

``solve_line_contact(LineContact(...), Effort(tolerance, least_cells), start=)`` returns an `EHLResult`;
`solve_ehl` is the same with plain numbers. A light film (Moes' M below 1) takes some 5 ms.
"""

import math
from dataclasses import replace

from .._base import increasing_root, validate, with_default_errors
from ..errors import returned
from ..oil import Lubricant
from .assemble import assemble
from .ehl_result import EHLResult
from .hertz import LineContact
from .nested import Effort, NestedSolutions, coarsest, first_state, is_sound, solved, warm
from .problem import FilmProblem, film_problem
from .reynolds import FilmSolution
from .start import FilmState, solution_state

# Flow over the flooded one [-] below which the flow of a starved film falls by steps. A choice: a smaller value saves
# films, and may fail.
FLOW_BY_STEPS = 0.5
# Flow of a step over that of the one before [-]. A choice: a smaller value needs fewer films, and may lose the way.
FLOW_OF_STEP = 0.6
# Effort of the films on the way. A choice: that of two grids (`TWO_GRIDS_TOLERANCE`), for a start.
EFFORT_ON_THE_WAY = Effort(5e-3)
# Distance of an inlet over the length on which a flooded film builds up [-] that counts as flooded. A choice, far
# beyond the distance of 1 that fills the inlet.
FURTHEST = 300.0


@with_default_errors
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
    inlet_film: float | None = None,
    sliding: float | None = None,
    eyring_stress: float | None = None,
    carreau: tuple[float, float] | None = None,
    start: EHLResult | None = None,
    least_cells: int = 0,
    max_iterations: int = 60,
    raise_on_failure: bool = True,
) -> EHLResult:
    """Return the film of a smooth line contact: Reynolds' equation, elastic half-spaces, a given load.

    The equations are d/dx(rho h³/(12 eta) dp/dx) = U d(rho h)/dx, with p = dp/dx = 0 at the rupture point
    (Swift-Stieber), h = h0 + x²/2R - (4/(pi E')) ∫ p ln|x - x'| dx', and ∫ p dx = load_per_width. They are solved by
    Newton's method on nested grids, and checked for Moes' M = 1e-12 to 1000, L = 0 to 20, and for nearly rigid bodies
    (L to 1e4 at M <= 0.01). The cells are doubled until the largest residual of the report is <= tolerance.

    Parameters
    ----------
    load_per_width : > 0 [N/m]
    radius, e_prime : R > 0 [m]; E' > 0 [Pa], 2/E' = sum (1 - nu²)/E
    entrainment_speed : U = (u1 + u2)/2 [m/s], not 0; a negative one mirrors the solution
    viscosity, pressure_viscosity_coefficient : eta0 at ambient pressure [Pa s]; alpha [1/Pa]
    viscosity_law, density_law : see `lubfric.Lubricant`, also for the ranges of the laws
    tolerance : relative error of min_film and flow_film from grid and domain, 1e-5 to 0.1
    inlet_length, inlet_film : where the lubricant begins, and the film that arrives [m] (`Lubricant`); None: fully
        flooded
    sliding, eyring_stress, carreau : u2 - u1 [m/s], with which shear thins the flow of the film, by the law of Ree and
        Eyring (tau_E [Pa]) or of Carreau ([G [Pa], n]); without all three the flow is Newtonian. A law of your own is
        one of the `Lubricant` of `lubfric.film.solve_line_contact`
    start : the result of a neighbouring load or speed; if the solve does not converge from it, a cold start is made,
        and noted
    least_cells, max_iterations : least cells before rupture (0 to 3072); Newton steps per grid
    raise_on_failure : False returns an unconverged result with its report

    Returns an `EHLResult`.

    Raises
    ------
    InputError : a value out of range, before any work
    ConvergenceError : residuals above tolerance; carries report and result
    """
    lubricant = Lubricant(
        viscosity,
        pressure_viscosity_coefficient,
        viscosity_law=viscosity_law,
        density_law=density_law,
        eyring_stress=eyring_stress,
        inlet_length=inlet_length,
        inlet_film=inlet_film,
        carreau=carreau,
    )
    line = LineContact(
        load_per_width=load_per_width,
        radius=radius,
        e_prime=e_prime,
        entrainment_speed=entrainment_speed,
        lubricant=lubricant,
        sliding=sliding,
    )
    effort = Effort(tolerance, least_cells, max_iterations)
    return solve_line_contact(line, effort, start=start, raise_on_failure=raise_on_failure)


def solve_line_contact(
    line: LineContact, effort: Effort = Effort(), *, start: EHLResult | None = None, raise_on_failure: bool = True
) -> EHLResult:
    """Return `solve_ehl` for a `LineContact`. ``effort``: tolerance and limits."""
    if start is not None:
        validate.instance("start", start, EHLResult, "an EHLResult or None")
    problem = film_problem(line)
    state = None if start is None else start.state
    arriving = line.lubricant.inlet_film
    if arriving is None:
        solutions = solved(problem, effort, state)
    else:
        solutions = _fed(problem, arriving / line.film_unit, effort, state)
    film = assemble(solutions.problem, solutions.on_grids, solutions.before, solutions.notes, effort.tolerance)
    return returned(film, raise_on_failure=raise_on_failure)


def _fed(full: FilmProblem, flow: float, effort: Effort, state: FilmState | None) -> NestedSolutions:
    """Return the film of a ``flow`` that arrives, or that of the ``full`` inlet where it takes no more. Nothing flows
    to the sides, so what arrives passes, and the lubricant begins where the flow is as much."""
    b = full.half_width
    furthest = full.inlet or 3.0 * b + FURTHEST * full.rise

    def fed_from(near: FilmState, aim: float, known: float = 1.0) -> tuple[FilmProblem, list[FilmSolution]]:
        there = near.problem
        assert near.inlet is not None
        law = full.inlet_of(aim / known) - b, there.inlet_of(near.flux / known) - there.half_width
        share = law[0] / law[1] if min(law) > 0 else aim / near.flux  # the law ends at the dry contact
        closer = (near.inlet - there.half_width) * share
        problem = replace(full, fed=aim, inlet=min(b + closer, furthest))
        return problem, warm(problem, effort if aim == flow else EFFORT_ON_THE_WAY, near)

    if state is not None and state.problem.fed is not None:
        problem, on_grids = fed_from(state, flow)
        if is_sound(on_grids) and -on_grids[-1].terms.X[0] <= furthest:
            return NestedSolutions(problem=problem, on_grids=on_grids)
    of_full = solved(full, effort, state)
    flooded = of_full.finest.terms.q
    if not is_sound(of_full.on_grids) or flooded <= flow:
        return of_full
    known = flooded / full.film_guess
    aim = max(flow, FLOW_BY_STEPS * flooded)
    there = replace(full, inlet=min(full.inlet_of(aim / known), furthest))
    near, closer = first_state(there, coarsest(full), effort.max_iterations)
    spent = of_full.before + of_full.on_grids + closer
    while True:
        problem, fed = fed_from(near, aim, known)
        if aim == flow or not is_sound(fed):
            break
        near = solution_state(problem, fed[-1], 0.0)
        aim = max(flow, FLOW_OF_STEP * aim)
        spent = spent + fed
    if is_sound(fed) or flow < FLOW_BY_STEPS * flooded:
        return NestedSolutions(problem=problem, on_grids=fed, before=spent, notes=of_full.notes)
    near = solution_state(full, of_full.finest, 0.0)
    solutions = _searched_inlet(problem, effort, near, furthest)
    return replace(solutions, before=spent + fed + solutions.before, notes=of_full.notes)


def _searched_inlet(problem: FilmProblem, effort: Effort, state: FilmState, furthest: float) -> NestedSolutions:
    """Return the solutions under a given flow by a search for the inlet. Where nearly as much arrives as the full inlet
    takes, the flow depends little on where the lubricant begins, and Newton's method for that place fails."""
    flow = problem.fed
    guess = problem.inlet
    b = problem.half_width
    assert flow is not None and guess is not None

    def surplus(log_distance: float, last: NestedSolutions | None) -> tuple[float, NestedSolutions]:
        there = replace(problem, fed=None, inlet=b + math.exp(log_distance))
        near = state
        closer = effort
        if last is not None:
            near = solution_state(there, last.finest, 0.0)
            closer = replace(effort, least_cells=max(effort.least_cells, last.finest.grid.n))
        solutions = solved(there, closer, near)
        return math.log(solutions.finest.terms.q / flow), solutions

    bounds = math.log(1e-3 * (guess - b)), math.log(furthest - b)
    root = increasing_root(surplus, math.log(guess - b), step=0.5, bounds=bounds, tolerance=1e-3 * effort.tolerance)
    solutions: NestedSolutions = root.payload
    takes_full_inlet = root.value < 0 and root.x == bounds[1]  # on these cells the full inlet takes no more
    fed = None if takes_full_inlet else flow
    return replace(solutions, problem=replace(solutions.problem, fed=fed), notes=())
