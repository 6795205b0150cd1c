"""`solve_differential_deflection`: the film by the method that the load-sharing model was first built on."""

from __future__ import annotations

import math

import numpy as np

from ...analytic.film import moes_film
from ...errors import InputError
from ...lubricant import Lubricant
from ...report import CONVERGED
from ...validate import integer, number, positive
from ..problem import Problem
from ..result import EHLResult, cubic
from ..start import expected_rupture
from .equations import load_row
from .mesh import Mesh, convolve, make_mesh
from .newton import Solution, newton
from .result import assemble, grid_error

COARSEST, FINEST = 64, 32768  # cells
FEWEST = 3  # grids to judge an error by: two may agree by chance
STARVED = 0.1  # film of a badly starved contact, relative to inlet_length²
RESOLVED = 0.7  # largest step of a first grid, relative to the length of the pressure rise


def solve_differential_deflection(
    *,
    load_per_width: float,
    radius: float,
    e_prime: float,
    entrainment_speed: float,
    viscosity: float,
    pressure_viscosity_coefficient: float,
    viscosity_law: str = "roelands",
    density: str = "constant",
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

    The same problem and result as `lubfric.solve_ehl`: Reynolds' equation, coupled to the second difference
    of the film, whose weights on the pressures decay like 1/k² with the distance k in nodes. Those within
    ``bandwidth`` are implicit, the rest is exact by FFT, and the two constants that the difference loses come
    from the full integral at the ends, so that the answer is that of the full integral for any bandwidth
    (`lubfric.ehl.differential.equations`). A step costs O(N log N + N bandwidth²).

    Sources: H. P. Evans, T. G. Hughes, Proc. IMechE C 214 (2000) 563-584; T. G. Hughes, C. D. Elcoate,
    H. P. Evans, Proc. IMechE C 214 (2000) 585-598; C. D. Elcoate, H. P. Evans, T. G. Hughes, R. W. Snidle,
    Proc. IMechE J 215 (2001) 319-337. The far pressures are not lagged: GMRES adds them to each Newton step.

    Parameters beyond those of `lubfric.solve_ehl`
    ----------
    nodes : at least 65, or None: doubled until ``discretisation`` <= tolerance, to at most ``most_nodes``
    domain : (first, last) node in the direction of motion [m], the line of centres at 0; it must hold the dry
        contact. None: two Hertz half-widths and 20 inlet lengths sqrt(2 R h) upstream, to somewhat
        behind the expected rupture. Not together with inlet_length, which says where the lubricant begins.
    bandwidth : largest distance in nodes whose pressures are implicit, >= 0; changes only the time
    max_iterations : Newton steps per grid; start : used on the coarsest grid; its x, pressure and film

    report.residuals, all relative, must be <= tolerance:
    discretisation : largest change of min_film, central_film and flow_film against the grid of half the
        cells, or a quarter of the change before that
    domain : estimated effect of the finite inlet on flow_film (0 with inlet_length)
    mass : largest |flux through a face before rupture/q - 1|; load : |∫ p dx/load - 1|
    film : largest |h - full integral|/h
    complementarity : largest of -p/p_max and of 1 - flux/q behind rupture
    (the last four are <= 1e-3 tolerance where Newton's method converged)
    report.evaluations counts banded solves, each with one convolution.

    Raises
    ------
    InputError : a value out of range, before any work
    ConvergenceError : residuals above tolerance, with report and result; not if raise_on_failure is False

    ``x`` in the result is the uniform grid with the rupture point added as a node. Checked for M = 1e-3 to
    1000, L = 0 to 20. A uniform grid must resolve the rise of the pressure at the edge of the contact: it
    needs about 50 times the nodes of a graded one at M = 1000.
    """
    problem = _problem(
        load_per_width,
        radius,
        e_prime,
        entrainment_speed,
        inlet_length,
        Lubricant(viscosity, pressure_viscosity_coefficient, viscosity_law, density),
    )
    tolerance = number("tolerance", tolerance, "", minimum=1e-5, maximum=0.1)
    max_iterations = integer("max_iterations", max_iterations, minimum=1)
    bandwidth = integer("bandwidth", bandwidth, minimum=0)
    nodes = None if nodes is None else integer("nodes", nodes, minimum=COARSEST + 1)
    if start is not None and not isinstance(start, EHLResult):
        raise InputError(f"start = {type(start).__name__} is not an EHLResult; allowed: an EHLResult or None")
    most_nodes = integer("most_nodes", most_nodes, minimum=COARSEST + 1)
    ends = _domain(problem, domain)

    levels, notes = [], ()
    if start is not None:
        levels = _ascend(problem, ends, (nodes, most_nodes), bandwidth, tolerance, max_iterations, start)
        if levels[-1].status != CONVERGED:
            notes = ("the warm start failed; solved again from a cold start",)
    if not levels or levels[-1].status != CONVERGED:
        levels = _ascend(problem, ends, (nodes, most_nodes), bandwidth, tolerance, max_iterations, None)
    result = assemble(problem, levels, tolerance, math.copysign(1.0, entrainment_speed), notes)
    if raise_on_failure:
        result.report.raise_if_failed(result)
    return result


def _problem(load, radius, e_prime, speed, inlet_length, lubricant: Lubricant) -> Problem:
    speed = number("entrainment_speed", speed, "m/s")
    if speed == 0.0:
        raise InputError("entrainment_speed = 0 m/s carries no steady film; allowed: any other finite speed")
    return Problem(
        positive("load_per_width", load, "N/m"),
        positive("radius", radius, "m"),
        positive("e_prime", e_prime, "Pa"),
        abs(speed),
        lubricant,
        None if inlet_length is None else positive("inlet_length", inlet_length, "m"),
    )


def _film(problem: Problem) -> float:
    """Expected film, less where the lubricant begins within the length on which a flooded film builds up."""
    film = moes_film(problem.M, problem.L)
    if problem.inlet_length is None:
        return film
    return min(film, STARVED * (problem.inlet_length / problem.length_unit) ** 2)


def _rupture(problem: Problem) -> float:
    return min(expected_rupture(problem.M, problem.L), problem.half_width + math.sqrt(2.0 * _film(problem)))


def _domain(problem: Problem, domain) -> tuple[float, float]:
    """First and last node in units of X."""
    b, unit = problem.half_width, problem.length_unit
    rise = math.sqrt(2.0 * _film(problem))
    first = -2.0 * b - 20.0 * rise
    last = _rupture(problem) + 0.2 * b + rise
    if problem.inlet_length is not None:
        if domain is not None:
            raise InputError("domain and inlet_length both say where the grid begins; allowed: one of them")
        first = -problem.inlet_length / unit
        if -first <= b:
            raise InputError(
                f"inlet_length = {problem.inlet_length:g} m lies inside the dry contact; "
                f"allowed: more than its half-width {b * unit:.4g} m"
            )
    if domain is not None:
        if np.shape(domain) != (2,):
            raise InputError(f"domain = {domain!r} is not a pair; allowed: (first, last) in m")
        first = number("domain[0]", domain[0], "m", maximum=-b * unit) / unit
        last = number("domain[1]", domain[1], "m", minimum=b * unit) / unit
    return first, last


def _cells(problem: Problem, ends: tuple[float, float], nodes: int | None, most_nodes: int) -> list[int]:
    """Cells of the nested grids; the coarsest resolves the rise of the pressure if the finest does."""
    film, b = math.sqrt(2.0 * _film(problem)), problem.half_width
    enough = max(COARSEST, (ends[1] - ends[0]) / (RESOLVED * film * (film / (film + b)) ** (1 / 3)))
    if nodes is None:
        cells = [min(2 ** math.ceil(math.log2(enough)), most_nodes - 1)]
        while 2 * cells[-1] < most_nodes:
            cells.append(2 * cells[-1])
        return cells
    cells = [nodes - 1]
    while cells[0] // 2 >= min(enough, max(COARSEST, (nodes - 1) // 2)):
        cells.insert(0, cells[0] // 2)
    return cells


def _ascend(problem, ends, counts, bandwidth, tolerance, max_steps, start: EHLResult | None) -> list[Solution]:
    """Solutions on grids of doubling size; ``counts`` (nodes, most_nodes): without nodes until they agree to ``tolerance``."""
    nodes, most_nodes = counts
    cells = _cells(problem, ends, nodes, most_nodes)
    levels: list[Solution] = []
    for n in cells:
        mesh = make_mesh(*ends, n + 1, bandwidth, problem.inlet_length is None)
        if levels:
            P, H = _transfer(mesh, levels[-1].mesh.X, levels[-1].P, levels[-1].H)
        else:
            P, H = _cold(mesh, problem) if start is None else _warm(mesh, problem, start)
        levels.append(newton(mesh, problem, P, H, 1e-3 * tolerance, max_steps))
        if levels[0].status != CONVERGED and n in cells[:2] and n < cells[-1]:
            levels.pop()  # too coarse to start on
            continue
        enough = nodes is None and len(levels) >= FEWEST and grid_error(levels) <= tolerance
        if levels[-1].status != CONVERGED or enough:
            break
    return levels


def _cold(mesh: Mesh, problem: Problem) -> tuple[np.ndarray, np.ndarray]:
    """A semi-ellipse of the right load that ends at the expected rupture, over the expected film."""
    film = _film(problem)
    width = math.hypot(problem.half_width, math.sqrt(2.0 * film))
    place = (mesh.X - _rupture(problem)) / width
    P = np.sqrt(np.maximum(0.0, 1.0 - (place + 1.0) ** 2))
    P /= load_row(mesh, problem) @ P
    gap = 0.5 * mesh.X**2 + convolve(mesh.log_transform, P)
    return P, gap - gap.min() + film


def _warm(mesh: Mesh, problem: Problem, start: EHLResult) -> tuple[np.ndarray, np.ndarray]:
    """Pressure and film of ``start``, stretched to the expected rupture and film and to the load."""
    M, L = start.load_number, start.material_number
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
