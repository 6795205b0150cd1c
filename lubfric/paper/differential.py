"""`solve_differential_deflection`: the film by the method on which the load-sharing model was first built."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .._base import instance, integer, number
from ..errors import CONVERGED, InputError
from ..film import (
    Effort,
    EHLResult,
    LineContact,
    Problem,
    cubic,
    expected_rupture,
    make_problem,
    moes_film,
    rupture_guess,
)
from ..oil import Lubricant
from .differential_equations import load_row
from .differential_mesh import Mesh, convolve, make_mesh
from .differential_newton import Solution, newton
from .differential_result import assemble, grid_error

COARSEST, FINEST = 64, 32768  # cells
FEWEST = 3  # grids to judge an error by: two may agree by chance
RESOLVED = 0.7  # largest step of a first grid, relative to the length of the pressure rise


@dataclass(frozen=True)
class UniformEffort:
    """The accuracy asked ``on_a_grid``, the nodes (None: doubled until accurate), at most how many, and the
    bandwidth."""

    on_a_grid: Effort = Effort()
    nodes: int | None = None
    most_nodes: int = FINEST + 1
    bandwidth: int = 8

    def __post_init__(self):
        if self.nodes is not None:
            integer("nodes", self.nodes, minimum=COARSEST + 1)
        integer("most_nodes", self.most_nodes, minimum=COARSEST + 1)
        integer("bandwidth", self.bandwidth, minimum=0)


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
    start: EHLResult | None = None,
    max_iterations: int = 60,
    nodes: int | None = None,
    domain: tuple[float, float] | None = None,
    bandwidth: int = 8,
    most_nodes: int = FINEST + 1,
    raise_on_failure: bool = True,
) -> EHLResult:
    """Film of a smooth line contact by differential deflection, on a uniform grid.

    Problem and result are those of `lubfric.solve_ehl`. Reynolds' equation is coupled to the second difference of the
    film, whose weights decay like 1/k² with the distance k in nodes (`lubfric.paper` has sources, method
    and residuals). Stops when the largest residual is <= tolerance. Checked for M = 1e-3 to 1000, L = 0 to 20.

    Parameters
    ----------
    load_per_width, radius, e_prime, entrainment_speed, viscosity : as in `lubfric.solve_ehl`, SI units
    pressure_viscosity_coefficient, viscosity_law, density_law, tolerance, inlet_length : as in `lubfric.solve_ehl`
    start, max_iterations : a neighbouring result, used on the coarsest grid; Newton steps per grid
    nodes : at least 65; None: doubled until ``discretisation`` <= tolerance, to at most ``most_nodes``
    domain : (first, last) node in the direction of motion [m], the line of centres at 0; it must hold the dry contact.
        None: two Hertz half-widths and 20 inlet lengths sqrt(2 R h) upstream. Not together with inlet_length
    bandwidth : largest distance in nodes whose pressures are implicit, >= 0; it changes only the time
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
    lubricant = Lubricant(viscosity, pressure_viscosity_coefficient, viscosity_law, density_law)
    contact = LineContact(load_per_width, radius, e_prime, entrainment_speed, lubricant)
    effort = UniformEffort(Effort(tolerance, max_iterations=max_iterations), nodes, most_nodes, bandwidth)
    if start is not None:
        instance("start", start, EHLResult, "an EHLResult or None")
    if domain is not None and inlet_length is not None:
        raise InputError("domain and inlet_length both say where the grid begins; give one of them")
    problem = make_problem(contact, inlet_length)
    return solve_differential(problem, effort, domain_ends(problem, domain), start, raise_on_failure)


def solve_differential(
    problem: Problem,
    effort: UniformEffort,
    ends: tuple[float, float],
    start: EHLResult | None = None,
    raise_on_failure: bool = True,
) -> EHLResult:
    """`solve_differential_deflection` for a `Problem` on a grid between ``ends`` [units of x]."""
    levels: list[Solution] = []
    notes: tuple[str, ...] = ()
    if start is not None:
        levels = _ascend(problem, effort, ends, start)
        if levels[-1].status != CONVERGED:
            notes = ("the warm start failed; solved again from a cold start",)
    if not levels or levels[-1].status != CONVERGED:
        levels = _ascend(problem, effort, ends, None)
    result = assemble(problem, levels, effort.on_a_grid.tolerance, notes)
    if raise_on_failure:
        result.report.raise_if_failed(result)
    return result


def domain_ends(problem: Problem, domain) -> tuple[float, float]:
    """First and last node, in units of X."""
    b, unit = problem.half_width, problem.length_unit
    rise = math.sqrt(2.0 * problem.film_guess)
    if domain is not None:
        if np.shape(domain) != (2,):
            raise InputError(f"domain = {domain!r} is not a pair; give (first, last) in m")
        first = number("domain[0]", domain[0], "m", maximum=-b * unit) / unit
        return first, number("domain[1]", domain[1], "m", minimum=b * unit) / unit
    first = -2.0 * b - 20.0 * rise if problem.inlet_length is None else -problem.inlet_length / unit
    return first, rupture_guess(problem) + 0.2 * b + rise


def _cells(problem: Problem, effort: UniformEffort, ends: tuple[float, float]) -> list[int]:
    """Numbers of cells of the nested grids. If the finest resolves the rise of the pressure, the coarsest does too."""
    film, b = math.sqrt(2.0 * problem.film_guess), problem.half_width
    enough = max(COARSEST, (ends[1] - ends[0]) / (RESOLVED * film * (film / (film + b)) ** (1 / 3)))
    if effort.nodes is None:
        cells = [min(2 ** math.ceil(math.log2(enough)), effort.most_nodes - 1)]
        while 2 * cells[-1] < effort.most_nodes:
            cells.append(2 * cells[-1])
        return cells
    cells = [effort.nodes - 1]
    while cells[0] // 2 >= min(enough, max(COARSEST, (effort.nodes - 1) // 2)):
        cells.insert(0, cells[0] // 2)
    return cells


def _ascend(
    problem: Problem, effort: UniformEffort, ends: tuple[float, float], start: EHLResult | None
) -> list[Solution]:
    """Solutions on grids of doubling size, up to the nodes asked for, or until two of them agree to the tolerance."""
    cells, grid = _cells(problem, effort, ends), effort.on_a_grid
    levels: list[Solution] = []
    for n in cells:
        mesh = make_mesh(*ends, n + 1, effort.bandwidth, problem.inlet_length is None)
        if levels:
            P, H = _transfer(mesh, levels[-1].mesh.X, levels[-1].P, levels[-1].H)
        else:
            P, H = _cold(mesh, problem) if start is None else _warm(mesh, problem, start)
        levels.append(newton(mesh, problem, P, H, 1e-3 * grid.tolerance, grid.max_iterations))
        if levels[0].status != CONVERGED and n in cells[:2] and n < cells[-1]:
            levels.pop()  # too coarse to start on
            continue
        enough = effort.nodes is None and len(levels) >= FEWEST and grid_error(levels) <= grid.tolerance
        if levels[-1].status != CONVERGED or enough:
            break
    return levels


def _cold(mesh: Mesh, problem: Problem) -> tuple[np.ndarray, np.ndarray]:
    """A first guess: a semi-ellipse of the right load that ends at the expected rupture, and the expected film."""
    film = problem.film_guess
    width = math.hypot(problem.half_width, math.sqrt(2.0 * film))
    place = (mesh.X - rupture_guess(problem)) / width
    P = np.sqrt(np.maximum(0.0, 1.0 - (place + 1.0) ** 2))
    P /= load_row(mesh, problem) @ P
    gap = 0.5 * mesh.X**2 + convolve(mesh.log_transform, P)
    return P, gap - gap.min() + film


def _warm(mesh: Mesh, problem: Problem, start: EHLResult) -> tuple[np.ndarray, np.ndarray]:
    """Pressure and film of ``start``, stretched to the expected rupture and film and to the load."""
    M, L = start.contact.M, start.contact.L
    film_unit = start.load / (start.e_prime * M)
    X = start.x * math.copysign(1.0, start.entrainment_speed) / math.sqrt(start.radius * film_unit)
    order = np.argsort(X)
    X, P, H = X[order], start.pressure[order], start.film_thickness[order] / film_unit
    place = mesh.X * (expected_rupture(M, L) / expected_rupture(problem.M, problem.L))
    P = np.interp(place, X, P, left=0.0)
    H = np.interp(place, X, H - 0.5 * X**2) + 0.5 * place**2
    load = load_row(mesh, problem) @ P
    if not load > 0.0:  # no pressure on this mesh
        return _cold(mesh, problem)
    return P / load, H * (moes_film(problem.M, problem.L) / moes_film(M, L))


def _transfer(mesh: Mesh, X: np.ndarray, P: np.ndarray, H: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Pressure (linear) and film (cubic) on another mesh."""
    return np.interp(mesh.X, X, P), cubic(X, H - 0.5 * X**2, mesh.X) + 0.5 * mesh.X**2
