"""The film by differential deflection, the method on which the load-sharing model was first built."""

import math

import numpy as np

from .._base import validate, with_default_errors
from ..errors import CONVERGED, STAGNATED, InputError, Report, returned
from ..film import (
    Effort,
    EHLResult,
    FilmProblem,
    FilmState,
    LineContact,
    central_film,
    cubic,
    film_problem,
    in_si,
    moes_film,
    node_positions,
    reported,
    rupture_guess,
    smallest,
)
from ..oil import Lubricant
from .differential_equations import Mesh, convolve, load_row, make_mesh
from .differential_newton import DifferentialSolution, newton

# Cells of the first grid, at least. A choice: a smaller value may not converge.
FIRST_GRID_CELLS = 64
# Cells of the last grid, at most. A choice, for time.
LAST_GRID_CELLS = 32768
# Grids by which an error is judged: two may agree by chance. A choice: a larger value takes longer.
FEWEST_GRIDS = 3
# Largest step of a first grid over the length of the pressure rise [-]. A choice: a larger value may not converge.
MOST_FIRST_STEP = 0.7
# Cells of the graded grid from which `lubfric.solve_ehl` may start. A choice: a larger value takes longer, and is a
# start alone.
STATE_CELLS = 96


@with_default_errors
def solve_differential_deflection(
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
    max_iterations: int = 60,
    nodes: int | None = None,
    domain: tuple[float, float] | None = None,
    most_nodes: int = LAST_GRID_CELLS + 1,
    raise_on_failure: bool = True,
) -> EHLResult:
    """Return the film of a smooth line contact by differential deflection, on a uniform grid.

    Problem and result are those of `lubfric.solve_ehl`. Reynolds' equation is coupled to the second difference of the
    film, whose weights decay like 1/k² with the distance k in nodes (`lubfric.paper` has sources, method
    and residuals). Stops when the largest residual is <= tolerance. Checked for M = 1e-3 to 1000, L = 0 to 20.

    Parameters
    ----------
    load_per_width, radius, e_prime, entrainment_speed, viscosity : as in `lubfric.solve_ehl`, SI units
    pressure_viscosity_coefficient, viscosity_law, density_law, tolerance, inlet_length : as in `lubfric.solve_ehl`
    max_iterations : Newton steps per grid
    nodes : at least 65; None: doubled until ``discretisation`` <= tolerance, to at most ``most_nodes``
    domain : (first, last) node in the direction of motion [m], the line of centres at 0; it must hold the dry contact.
        None: two Hertz half-widths and 20 inlet lengths sqrt(2 R h) upstream. Not together with inlet_length
    most_nodes : largest number of nodes that is tried
    raise_on_failure : False returns an unconverged result with its report

    Returns
    -------
    EHLResult : its ``x`` is the uniform grid with the rupture point added as a node

    Raises
    ------
    InputError : a value out of range, before any work
    ConvergenceError : residuals above tolerance; carries report and result
    """
    oil = Lubricant(
        viscosity,
        pressure_viscosity_coefficient,
        viscosity_law=viscosity_law,
        density_law=density_law,
        inlet_length=inlet_length,
    )
    Effort(tolerance, 0, max_iterations)  # checks both
    if nodes is not None:
        validate.integer("nodes", nodes, minimum=FIRST_GRID_CELLS + 1)
    validate.integer("most_nodes", most_nodes, minimum=FIRST_GRID_CELLS + 1)
    problem = film_problem(
        LineContact(
            load_per_width=load_per_width,
            radius=radius,
            e_prime=e_prime,
            entrainment_speed=entrainment_speed,
            lubricant=oil,
        )
    )
    ends = domain_ends(problem, domain)
    cells = _cells(problem, ends, nodes, most_nodes)
    on_grids = _ascend(problem, ends, cells, tolerance, max_iterations, doubled=nodes is None)
    result = assemble(problem, on_grids, tolerance)
    return returned(result, raise_on_failure=raise_on_failure)


def domain_ends(problem: FilmProblem, domain: tuple[float, float] | None) -> tuple[float, float]:
    """Return the first and last node, in units of X."""
    b = problem.half_width
    unit = problem.length_unit
    rise = math.sqrt(2.0 * problem.film_guess)
    if domain is not None:
        if problem.inlet is not None:
            raise InputError("domain and inlet_length both say where the grid begins; give one of them")
        if np.shape(domain) != (2,):
            raise InputError(f"domain = {domain!r} is not a pair; give (first, last) in m")
        first = validate.number("domain[0]", domain[0], "m", maximum=-b * unit) / unit
        return first, validate.number("domain[1]", domain[1], "m", minimum=b * unit) / unit
    first = -2.0 * b - 20.0 * rise if problem.inlet is None else -problem.inlet
    return first, rupture_guess(problem) + 0.2 * b + rise


def _cells(problem: FilmProblem, ends: tuple[float, float], nodes: int | None, most_nodes: int) -> list[int]:
    """Return the numbers of cells of the nested grids. If the finest resolves the rise of the pressure, the coarsest
    does too."""
    film = math.sqrt(2.0 * problem.film_guess)
    b = problem.half_width
    enough = max(FIRST_GRID_CELLS, (ends[1] - ends[0]) / (MOST_FIRST_STEP * film * (film / (film + b)) ** (1 / 3)))
    if nodes is None:
        cells = [min(2 ** math.ceil(math.log2(enough)), most_nodes - 1)]
        while 2 * cells[-1] < most_nodes:
            cells.append(2 * cells[-1])
        return cells
    cells = [nodes - 1]
    while cells[0] // 2 >= min(enough, max(FIRST_GRID_CELLS, (nodes - 1) // 2)):
        cells.insert(0, cells[0] // 2)
    return cells


def _ascend(
    problem: FilmProblem,
    ends: tuple[float, float],
    cells: list[int],
    tolerance: float,
    max_iterations: int,
    *,
    doubled: bool,
) -> list[DifferentialSolution]:
    """Return the solutions on grids of as many ``cells``; if these are ``doubled``, until two grids agree to the
    tolerance."""
    on_grids: list[DifferentialSolution] = []
    for n in cells:
        mesh = make_mesh(*ends, n + 1, flooded=problem.inlet is None)
        P, H = cold_start(mesh, problem)
        if on_grids:  # pressure (linear) and film (cubic) of the mesh before
            X = on_grids[-1].mesh.X
            last = on_grids[-1]
            P = np.interp(mesh.X, X, last.P)
            H = cubic(X, last.H - 0.5 * X**2, mesh.X) + 0.5 * mesh.X**2
        on_grids.append(newton(mesh, problem, P, H, 1e-3 * tolerance, max_iterations))
        if on_grids[0].status != CONVERGED and n in cells[:2] and n < cells[-1]:
            on_grids.pop()  # too coarse to start on
            continue
        enough = doubled and len(on_grids) >= FEWEST_GRIDS and grid_error(on_grids) <= tolerance
        if on_grids[-1].status != CONVERGED or enough:
            break
    return on_grids


def cold_start(mesh: Mesh, problem: FilmProblem) -> tuple[np.ndarray, np.ndarray]:
    """Return a first guess: a semi-ellipse of the right load that ends at the expected rupture, and the expected
    film."""
    film = problem.film_guess
    width = math.hypot(problem.half_width, math.sqrt(2.0 * film))
    place = (mesh.X - rupture_guess(problem)) / width
    P = np.sqrt(np.maximum(0.0, 1.0 - (place + 1.0) ** 2))
    P /= load_row(mesh, problem) @ P
    gap = 0.5 * mesh.X**2 + convolve(mesh.log_transform, P)
    return P, gap - gap.min() + film


def grid_error(on_grids: list[DifferentialSolution]) -> float:
    """Return the largest relative change of minimum, central and flow film between the last two grids, or a quarter of
    the change before that. This is some three times the error, because the rupture point is always at a node, which
    makes the error uneven."""
    films = np.array([[smallest(s.mesh.X, s.H), central_film(s.mesh.X, s.H), s.terms.q] for s in on_grids[-3:]])
    if len(films) < 2:
        return math.inf
    changes = np.max(np.abs(np.diff(films, axis=0) / films[-1]), axis=1)
    return float(max(changes[-1], changes[0] / 4 ** (changes.size - 1)))


def _report(problem: FilmProblem, on_grids: list[DifferentialSolution], tolerance: float) -> Report:
    last = on_grids[-1]
    a = -last.mesh.X[0]  # of a finite inlet: the tail's share of the load times its departure from a parabola
    tail = float(0.5 * a * last.P[0] / problem.M * abs(2.0 * last.H[0] / a**2 - 1.0))
    residuals = {"discretisation": grid_error(on_grids), "domain": tail if problem.inlet is None else 0.0}
    residuals |= last.residuals
    first, end = last.mesh.X[[0, -1]] / problem.half_width
    notes: tuple[str, ...] = (f"{last.mesh.size} nodes from {first:.4g} to {end:.4g} half-widths",)
    if last.terms.last >= last.mesh.size - 2:
        notes += ("the film did not rupture inside the domain",)
    solver = "line-contact EHL, differential deflection"
    solves = sum(solution.solves for solution in on_grids)
    return reported(solver, on_grids, residuals, tolerance, notes, STAGNATED, solves)


def _with_rupture(solution: DifferentialSolution) -> tuple[float, np.ndarray, np.ndarray, np.ndarray]:
    """Return the rupture point, where the film is that of the flow, and X, P, H with a node added there."""
    X = solution.mesh.X
    P = solution.P
    H = solution.H
    last = solution.terms.last
    q = solution.terms.q
    if last >= X.size - 2:  # none: reported
        return float(X[last]), X, P, H
    before = 0.5 * (H[last] + H[last + 1])
    behind = 0.5 * (H[last + 1] + H[last + 2])
    share = np.clip((q - before) / (behind - before), 0.0, 1.0) if behind > before else 0.5
    e = X[last] + (0.5 + float(share)) * solution.mesh.step
    i = int(np.searchsorted(X, e))
    if min(abs(X[i] - e), abs(X[i - 1] - e)) < 1e-3 * solution.mesh.step:
        return float(X[i] if X[i] - e < e - X[i - 1] else X[i - 1]), X, P, H
    film = cubic(X, H - 0.5 * X**2, np.array([e]))[0] + 0.5 * e * e
    return e, np.insert(X, i, e), np.insert(P, i, 0.0), np.insert(H, i, film)


def _state(problem: FilmProblem, solution: DifferentialSolution, rupture: float, error: float) -> FilmState:
    """Return the `FilmState` from which `solve_ehl` can start: the solution on the graded grid of `solve_ehl`."""
    xi = node_positions(problem.half_width, moes_film(problem.M, problem.L), STATE_CELLS)
    X = xi + rupture
    P = np.interp(X, solution.mesh.X, solution.P, left=0.0)
    H = np.interp(X, solution.mesh.X, solution.H - 0.5 * solution.mesh.X**2) + 0.5 * X**2
    return FilmState(problem=problem, pressure=P[:-1], film=H, flux=solution.terms.q, rupture=rupture, grid_error=error)


def assemble(problem: FilmProblem, on_grids: list[DifferentialSolution], tolerance: float) -> EHLResult:
    """Return the result in SI units, seen along +x."""
    last = on_grids[-1]
    rupture, *nodes = _with_rupture(last)
    report = _report(problem, on_grids, tolerance)
    mesh = last.mesh
    return in_si(
        problem,
        nodes,
        load=mesh.step * last.P.sum(),
        films=(smallest(mesh.X, last.H), central_film(mesh.X, last.H)),
        flow=last.terms.q,
        rupture=rupture,
        constant=float(last.H[0] - 0.5 * mesh.X[0] ** 2 - mesh.log_kernel @ last.P),
        report=report,
        state=_state(problem, last, rupture, report.residuals["discretisation"]),
    )
