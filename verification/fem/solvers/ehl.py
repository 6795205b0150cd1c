"""Full-system finite-element solution of the elastohydrodynamic line contact.

Displacement of an elastic body, pressure on a part of its surface and the approach are the unknowns of one Newton
iteration on one sparse system (Habchi, Eyheramendy, Vergne & Morales-Espejel 2008, doi:10.1115/1.2842246). `ehl_body`,
`ehl_film` and `ehl_newton` hold the parts. All is in Hertz variables: X = x/b, P = p/p_h, H = h R/b^2. Meshes are
nested. On the coarsest one a first-order upwind solution comes first, from a Hertz pressure. Every solution, film
included, starts the next finer one.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from skfem import Basis

from ...types import Keywords
from .ehl_body import Body, Layout, graded_mesh, make_body, refined_displacement
from .ehl_film import PENALTY, FilmEquations
from .ehl_newton import Iterate, film_thickness, newton
from .fluid import Fluid
from .report import SolveReport, require

ROUGH = 1e-2  # tolerance of the first guess
RAISING = (0.25, 0.5, 0.75, 1.0)  # shares of ln(eta/eta0)


@dataclass(frozen=True, kw_only=True)
class LineContact:
    """What is solved, in SI units.

    load_per_width : N/m
    radius : reduced radius R, m
    e_prime : E' in Pa, ``2/E' = sum (1 - nu^2)/E``
    entrainment_speed : U = (u1 + u2)/2 > 0, m/s
    fluid : viscosity and density laws; its Eyring stress thins the flow where there is sliding
    sliding_speed : |u1 - u2|, m/s
    """

    load_per_width: float
    radius: float
    e_prime: float
    entrainment_speed: float
    fluid: Fluid
    sliding_speed: float = 0.0

    def __post_init__(self) -> None:
        for name, unit in (("load_per_width", "N/m"), ("radius", "m"), ("e_prime", "Pa"), ("entrainment_speed", "m/s")):
            value = getattr(self, name)
            require(0 < value < math.inf, f"{name} = {value} {unit}", "a finite number > 0")

    @classmethod
    def of(cls, case: Keywords, sliding_speed: float = 0.0) -> "LineContact":
        """Return the contact and its fluid (`Fluid.of`) from the arguments of ``lubfric.solve_ehl``."""
        sizes = {name: case[name] for name in ("load_per_width", "radius", "e_prime", "entrainment_speed")}
        return cls(**sizes, fluid=Fluid.of(case), sliding_speed=sliding_speed)

    @property
    def half_width(self) -> float:
        """Hertz half-width b, m."""
        return math.sqrt(8 * self.load_per_width * self.radius / (math.pi * self.e_prime))

    @property
    def hertz_pressure(self) -> float:
        """p_h, Pa."""
        return 2 * self.load_per_width / (math.pi * self.half_width)

    @property
    def film_unit(self) -> float:
        """b^2/R, m."""
        return self.half_width**2 / self.radius

    @property
    def speed_parameter(self) -> float:
        """lambda = 12 eta0 U R^2/(b^3 p_h)."""
        drag = 12 * self.fluid.viscosity * self.entrainment_speed * self.radius**2
        return drag / (self.half_width**3 * self.hertz_pressure)

    @property
    def shear(self) -> float:
        """The Newtonian stress eta0 |u1 - u2|/h at h = b^2/R, over the Eyring stress."""
        return self.fluid.viscosity * self.sliding_speed / (self.film_unit * self.fluid.eyring_stress)

    @property
    def load_number(self) -> float:
        """Moes' M; lambda = 3 pi^2/(8 M^2)."""
        return math.pi * math.sqrt(3 / (8 * self.speed_parameter))

    @property
    def material_number(self) -> float:
        """Moes' L, 0 for a constant viscosity; alpha p_h = L sqrt(M/2 pi)."""
        if self.fluid.viscosity_law == "constant":
            return 0.0
        alpha = self.fluid.pressure_viscosity_coefficient
        return alpha * self.hertz_pressure * math.sqrt(2 * math.pi / self.load_number)

    @property
    def moes_film(self) -> float:
        """The film that is 1 in Moes' units, m."""
        return math.pi / (8 * self.load_number) * self.film_unit


@dataclass(frozen=True, kw_only=True)
class EHLSolution:
    """A film and the report of its solve. Arrays on the line have the order of its degrees of freedom ``body.x``,
    which is not ascending.

    contact, layout, body, film, report : what was solved, on which mesh, with which flow; how it went
    displacement : at the free degrees of freedom of the body, b^2/R
    P, H : pressure in p_h and film in b^2/R on the line
    approach : H0 in b^2/R
    flow_film : mass flow/(rho0 U), m
    """

    contact: LineContact
    layout: Layout
    body: Body
    film: FilmEquations
    displacement: np.ndarray
    P: np.ndarray
    H: np.ndarray
    approach: float
    flow_film: float
    report: SolveReport

    @property
    def min_film(self) -> float:
        """Smallest film [m], that of the parabolas in the cells."""
        left, right, middle = self.H[self.body.line.element_dofs]
        slope = (right - left) / 2
        bend = (left + right) / 2 - middle
        lowest = np.clip(-slope / np.where(bend > 0, 2 * bend, 1.0), -1, 1)
        inside = np.where(bend > 0, middle + slope * lowest + bend * lowest**2, np.inf)
        return float(min(inside.min(), self.H.min())) * self.contact.film_unit

    @property
    def cell_length(self) -> float:
        """Smallest cell of the line, m."""
        return float(np.diff(np.sort(self.body.line.mesh.p[0])).min()) * self.contact.half_width

    @property
    def rolling(self) -> float:
        """1/2 ∫ h dp [N/m] of one surface. Upstream of the line p falls like |x|^-3 under a parabola."""
        line = self.body.line
        c = self.contact
        first = int(np.argmin(self.body.x))
        upstream = 1.5 * self.P[first] * self.body.x[first] ** 2
        within = np.sum(np.asarray(line.interpolate(self.H)) * line.interpolate(self.P).grad[0] * line.dx)
        return float(within + upstream) / 2 * c.hertz_pressure * c.film_unit

    def at(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return pressure (Pa) and film (m) at positions x (m) between inlet and outlet."""
        probe = self.body.line.probes(np.atleast_2d(np.asarray(x) / self.contact.half_width))
        return probe @ self.P * self.contact.hertz_pressure, probe @ self.H * self.contact.film_unit


def solve_ehl(
    contact: LineContact,
    *,
    refinements: int = 2,
    fineness: float = 0.7,
    side: float = 240.0,
    between: float = math.inf,
    penalty: float = PENALTY,
    tolerance: float = 1e-8,
    max_iterations: int = 40,
) -> list[EHLSolution]:
    """Solve on a graded mesh and on its uniform refinements; the solutions, coarsest first.

    Parameters
    ----------
    refinements : each halves the cells and costs about five times the one before
    fineness : of the coarsest mesh, see `make_layout`
    side : of the body in units of sqrt(b^2 + 2 R h), h the film expected; >= 50 holds the inlet
    between : longest cell of the film under the contact, in half-widths, on the coarsest mesh
    penalty : of the stabilisation (`ehl_film`), 0: plain Galerkin
    tolerance : on the largest of the residuals that `ehl_newton.measure` defines
    max_iterations : Newton steps on a mesh

    Raises `SolveError` with report and solution of the mesh that failed.

    Found to converge for M = 0.001 to 1000 and L = 0 to 15, to 9 GPa; from L = 18 on at M = 5 to 30, where
    the pressure spike is several p_h high, it may not.
    """
    require(refinements >= 0, f"refinements = {refinements}", ">= 0")
    require(50 <= side < math.inf, f"side = {side}", ">= 50")
    require(min(fineness, between, tolerance) > 0, f"{fineness = }, {between = }, {tolerance = }", "> 0")
    require(penalty >= 0 and max_iterations >= 1, f"{penalty = }, {max_iterations = }", ">= 0, >= 1")
    mesh, layout = graded_mesh(replace(make_layout(contact, fineness, side), between=between))
    solutions: list[EHLSolution] = []
    for level in range(refinements + 1):
        mesh = mesh.refined() if level else mesh
        body = make_body(mesh, layout)
        film = film_of(contact, body.line, penalty)
        start = refined(solutions[-1], body) if level else first_guess(contact, body, film, max_iterations)
        end, flow, report = newton(body, film, start, tolerance, max_iterations)
        if level and not report.converged:
            start, _, _ = newton(body, replace(film, upwind=1.0), start, ROUGH, max_iterations)
            end, flow, report = newton(body, film, start, tolerance, max_iterations)
        solutions.append(report.checked(solution_of(contact, layout, body, film, end, flow=flow, report=report)))
    return solutions


def solution_of(
    contact: LineContact,
    layout: Layout,
    body: Body,
    film: FilmEquations,
    end: Iterate,
    *,
    flow: float,
    report: SolveReport,
) -> EHLSolution:
    """Return the solution at the last iterate of a solve, with its mass ``flow`` in units of rho0 U b^2/R."""
    return EHLSolution(
        contact=contact,
        layout=layout,
        body=body,
        film=film,
        displacement=end.u,
        P=end.P,
        H=film_thickness(body, end),
        approach=end.H0,
        flow_film=flow * contact.film_unit,
        report=report,
    )


def film_of(contact: LineContact, line: Basis, penalty: float = PENALTY) -> FilmEquations:
    """Return the flow of a contact on a line."""
    return FilmEquations(
        line=line,
        fluid=contact.fluid,
        hertz_pressure=contact.hertz_pressure,
        speed_parameter=contact.speed_parameter,
        penalty=penalty,
        shear=contact.shear,
    )


def make_layout(contact: LineContact, fineness: float, side: float) -> Layout:
    """Return the layout of the mesh.

    Everything scales with b and with l = sqrt(2 R h), h the film expected: at light load l is many times b.
    """
    film = film_estimate(contact.load_number, contact.material_number) * contact.moes_film / contact.film_unit
    l = math.sqrt(2 * film)
    edge = math.hypot(1, 0.475 * l)
    return Layout(
        side=side * math.hypot(1, l),
        inlet=-(3 + 20 * l),
        outlet=2 + 2 * l,
        edges=(-edge, edge),
        fine=0.5 * l * (l / (1 + l)) ** (1 / 3) / fineness,
        growth=0.5 / fineness,
    )


def film_estimate(M: float, L: float) -> float:
    """Return flow film in Moes' units by the regression of H. Moes, Wear 159 (1992) 57-66 (within some 10 %).

    Only the mesh and the first guess are made from it.
    """
    rigid = 3 / M
    elastic = 2.621 * M**-0.2
    isoviscous = (rigid ** (7 / 3) + elastic ** (7 / 3)) ** (3 / 7)
    if L < 0.01:
        return float(isoviscous)
    piezo = ((1.287 * L ** (2 / 3)) ** -3.5 + (1.311 * M**-0.125 * L**0.75) ** -3.5) ** (-2 / 7)
    s = (7 + 8 * math.exp(-2 * elastic / rigid)) / 5
    smaller, larger = sorted((isoviscous, piezo))
    return float(larger * (1 + (smaller / larger) ** s) ** (1 / s))


def first_guess(contact: LineContact, body: Body, film: FilmEquations, max_iterations: int) -> Iterate:
    """Return a first-order upwind solution. Where Newton's method does not find it from a Hertz pressure, the viscosity
    is raised in steps.

    It need not have converged. What counts is whether the solution that starts from it has.
    """
    for shares in ((1.0,), RAISING):
        guess = hertz_start(contact, body, shares[0])
        for share in shares:
            guess, _, report = newton(body, replace(film, upwind=1.0, piezo=share), guess, ROUGH, max_iterations)
        if report.converged:
            break
    return guess


def hertz_start(contact: LineContact, body: Body, piezo: float) -> Iterate:
    """Return Hertz pressure, spread to the width of the film where that is wider, and the film expected at X = 0."""
    film = film_estimate(contact.load_number, piezo * contact.material_number) * contact.moes_film / contact.film_unit
    width = math.sqrt(1 + 2 * film)
    P = np.sqrt(np.maximum(1 - (body.x / width) ** 2, 0)) / width
    u = body.displacement(P)
    centre = int(np.argmin(np.abs(body.x)))
    return Iterate(u, P, film + float((body.trace @ u)[centre]), P <= 0)


def refined(coarse: EHLSolution, body: Body) -> Iterate:
    """Return a solution taken to the next finer mesh, film included (that of the interpolated pressure is rougher)."""
    P = coarse.body.line.probes(body.x[None]) @ coarse.P
    return Iterate(refined_displacement(coarse.body, body, coarse.displacement), P, coarse.approach, P <= 0)
