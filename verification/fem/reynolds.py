"""Reynolds equation by finite elements, on lines, triangles and quadrilaterals, for a given film.

    - div( rho h^3/(12 eta) grad p ) + d(rho U h)/dx = f,   p = 0 on the boundary,

weakly: ``(rho h^3/(12 eta) grad p, grad v) - (rho U h, dv/dx) = (f, v)``, with U the entrainment speed
(mean of the two surface speeds). Where cavitation is asked for, with Reynolds' (Swift-Stieber) outlet:
``p >= 0``, weak residual ``>= 0``, product 0, node by node. One loop does both: Newton on the free nodes,
each step with the active set of the primal-dual method (Hintermueller, Ito & Kunisch 2003,
doi:10.1137/S1052623401383558). The tangent is exact: the integrand is written once, and
differentiated by a complex step.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import skfem
from skfem import Basis, BilinearForm, Functional, LinearForm
from skfem.helpers import dot, grad

from .fluid import STEP, Fluid, slope
from .report import CONVERGED, DIVERGED, ITERATION_LIMIT, InputError, SolveReport

ELEMENTS = {
    ("MeshLine", 1): skfem.ElementLineP1, ("MeshLine", 2): skfem.ElementLineP2,
    ("MeshTri", 1): skfem.ElementTriP1, ("MeshTri", 2): skfem.ElementTriP2,
    ("MeshQuad", 1): skfem.ElementQuad1, ("MeshQuad", 2): skfem.ElementQuad2,
}
STABILISATIONS = ("none", "supg")
LARGEST_STEP = 3.0


@dataclass(frozen=True)
class Problem:
    """What is solved. Lengths in m, speeds in m/s.

    Attributes
    ----------
    mesh : scikit-fem mesh of lines, triangles or quadrilaterals; x (first coordinate) is the direction of motion
    film : film thickness in m at coordinates x of shape (dim, ...)
    fluid : viscosity and density laws
    speed : entrainment speed U >= 0
    degree : 1 (P1, Q1) or 2 (P2, Q2)
    source : f in m/s (as rho is relative to the density at p = 0), for manufactured solutions; may be None
    open_boundary : of facet midpoints (dim, n): True where p is not set to 0 and no flow passes (a symmetry
        line, or the side of an infinitely wide pad); None: p = 0 all round
    cavitation : complementarity p >= 0, else p may be of any sign
    stabilisation : "none" (Galerkin) or "supg", degree 1 only, for a density that depends on pressure
    """

    mesh: skfem.Mesh
    film: Callable[[np.ndarray], np.ndarray]
    fluid: Fluid
    speed: float
    degree: int = 1
    source: Callable[[np.ndarray], np.ndarray] | None = None
    open_boundary: Callable[[np.ndarray], np.ndarray] | None = None
    cavitation: bool = False
    stabilisation: str = "none"

    def __post_init__(self):
        if self.element is None:
            raise InputError(f"mesh {type(self.mesh).__name__}, degree = {self.degree}; allowed: lines, triangles "
                             "or quadrilaterals, degree 1 or 2")
        if self.stabilisation not in STABILISATIONS:
            raise InputError(f"stabilisation = {self.stabilisation!r}; allowed: {STABILISATIONS}")
        if self.stabilisation == "supg" and self.degree != 1:
            raise InputError("stabilisation = 'supg' needs degree = 1: its residual drops second derivatives of p")
        if not 0 <= self.speed < np.inf:
            raise InputError(f"speed = {self.speed} m/s; allowed: >= 0")
        film = self.film(self.mesh.p)
        if not np.all(np.isfinite(film) & (film > 0)):
            raise InputError(f"film_thickness has a minimum of {np.min(film)} m on the mesh; allowed: > 0")

    @property
    def element(self):
        """The element class, or None."""
        names = [k for k in ELEMENTS if type(self.mesh).__name__.startswith(k[0]) and k[1] == self.degree]
        return ELEMENTS[names[0]] if names else None


@dataclass(frozen=True)
class Solution:
    """Pressure and how it was found.

    Attributes
    ----------
    problem, report : what was solved; how it went
    basis : scikit-fem basis of the pressure
    pressure : values at the degrees of freedom (``basis.doflocs``), Pa
    reaction : weak residual at every degree of freedom, m^2/s on a line, m^3/s on a surface: on the boundary
        the flow that enters there, in the cavitated part the flow that is not carried on, zero elsewhere
    """

    problem: Problem
    basis: Basis
    pressure: np.ndarray
    reaction: np.ndarray
    report: SolveReport

    @property
    def at_vertices(self) -> np.ndarray:
        """Pressure at the vertices of the mesh, Pa."""
        return self.pressure[self.basis.nodal_dofs[0]]

    @property
    def load(self) -> float:
        """``integral p``: N/m on a line, N on a surface."""
        return float(Functional(lambda w: w.p).assemble(self.basis, p=self.pressure))

    def inflow(self, x: float) -> float:
        """Flow that enters through the boundary at this x, m^2/s or m^3/s (volume at p = 0)."""
        return float(self.reaction[np.abs(self.basis.doflocs[0] - x) < 1e-9 * np.ptp(self.basis.doflocs[0])].sum())

    def friction(self, sliding_speed: float) -> tuple[float, float]:
        """``(integral eta Du/h, integral (h/2) dp/dx)`` over the part under pressure, N/m or N."""
        film, fluid = self.problem.film, self.problem.fluid
        couette = Functional(lambda w: np.where(w.p > 0, fluid.eta(w.p) * sliding_speed / film(w.x), 0.0))
        rolling = Functional(lambda w: film(w.x) / 2 * grad(w.p)[0])
        p = self.basis.interpolate(self.pressure)
        return float(couette.assemble(self.basis, p=p)), float(rolling.assemble(self.basis, p=p))

    def error(self, exact: Callable[[np.ndarray], np.ndarray]) -> float:
        """L2 norm of ``p - exact(x)`` relative to that of ``exact``."""
        p = self.basis.interpolate(self.pressure)
        off = Functional(lambda w: (w.p - exact(w.x)) ** 2).assemble(self.basis, p=p)
        return float(np.sqrt(off / Functional(lambda w: exact(w.x) ** 2).assemble(self.basis)))


def integrand(problem: Problem, p, gradient, v, w):
    """The weak form at a point for pressure ``p`` and its ``gradient``, both real or both complex."""
    h, fluid = np.asarray(w.film), problem.fluid
    rho = fluid.rho(p)
    mobility = rho * h**3 / (12 * fluid.eta(p))
    form = mobility * dot(gradient, grad(v)) - problem.speed * rho * h * grad(v)[0] - w.f * v
    if problem.stabilisation == "none":
        return form
    # streamline-upwind Petrov-Galerkin: strong residual, weighted against the wave speed of p (Brooks & Hughes
    # 1982, doi:10.1016/0045-7825(82)90071-8); tau of Shakib, Hughes & Johan 1991, doi:10.1016/0045-7825(91)90041-4
    real = np.real(p)
    rho_slope = slope(fluid.rho, real)
    wave = problem.speed * h * rho_slope
    slope_of_mobility = rho_slope / np.real(rho) - slope(fluid.log_viscosity, real)
    steepening = np.real(mobility) * (slope_of_mobility * gradient + 3 * w.film_gradient / h)
    strong = wave * gradient[0] + problem.speed * rho * w.film_gradient[0] - dot(steepening, gradient) - w.f
    tau = 1 / np.sqrt((2 * wave / w.h) ** 2 + 9 * (4 * np.real(mobility) / w.h**2) ** 2)
    return form + tau * wave * grad(v)[0] * strong


def tangent(problem: Problem) -> BilinearForm:
    """Derivative of the weak form by a complex step."""
    return BilinearForm(lambda u, v, w: np.imag(integrand(
        problem, w.p + 1j * STEP * u, grad(w.p) + 1j * STEP * grad(u), v, w)) / STEP)


def residual(problem: Problem) -> LinearForm:
    """The weak form itself."""
    return LinearForm(lambda v, w: integrand(problem, np.asarray(w.p), grad(w.p), v, w))


def solve_reynolds(problem: Problem, *, start: np.ndarray | None = None, tolerance: float = 1e-7,
                   max_iterations: int = 100, raise_on_failure: bool = True) -> Solution:
    """Solve for the pressure.

    Stops when the largest of these is <= ``tolerance``:

    - mass: ``sum |r_i|`` over free nodes / flow, with r the weak residual and flow = U min(h) (times the width
      of a surface mesh), or ``sum |(f, v_i)|`` where that is larger
    - tension: ``max(-p)/max |p|``, with cavitation
    - overlap: ``max p`` where p should be 0 because ``r_i/J_ii > p_i`` / ``max |p|``: pressure and lost flow
      together at one node
    - suction: ``sum max(-r_i, 0)`` over nodes held at p = 0 by cavitation / flow

    Parameters
    ----------
    start : first pressure at the degrees of freedom, default 0
    raise_on_failure : raise `SolveError` (with report and last solution) rather than return an unconverged one
    """
    basis = Basis(problem.mesh, problem.element(), intorder=2 * problem.degree + 4)
    held = boundary_dofs(problem, basis)
    fields = given_fields(problem, basis)
    p = np.zeros(basis.N) if start is None else np.array(start, dtype=float)
    p[held] = 0.0
    flow = flow_scale(problem, basis, fields)
    history, status = [], ITERATION_LIMIT
    for _ in range(max_iterations + 1):
        r = residual(problem).assemble(basis, p=p, **fields)
        matrix = tangent(problem).assemble(basis, p=p, **fields).tocsc()
        cavitated = np.zeros(basis.N, dtype=bool)
        if problem.cavitation:
            cavitated = ~held & (p <= r / matrix.diagonal())
        residuals = measure(problem, p, r, held, cavitated, flow)
        history.append(max(residuals.values()))
        if not np.isfinite(history[-1]):
            status = DIVERGED
            break
        if history[-1] <= tolerance:
            status = CONVERGED
            break
        if len(history) > max_iterations:
            break
        p = p + newton_step(problem, matrix, r, p, held | cavitated)
    report = SolveReport("Reynolds finite elements", status, len(history) - 1, history[-1], tolerance, residuals,
                         tuple(history), len(history) - 1)
    solution = Solution(problem, basis, p, r, report)
    if raise_on_failure:
        report.raise_if_failed(solution)
    return solution


def solve_refined(problem: Problem, refinements: int, **options) -> list[Solution]:
    """Solve on ``problem.mesh`` and on each of its uniform refinements, each started from the one before.

    Besides giving a convergence study its meshes, this keeps the active set cheap: started from nothing, a
    cavitation boundary recedes one node a step. Options as for `solve_reynolds`.
    """
    solutions = [solve_reynolds(problem, **options)]
    for _ in range(refinements):
        coarse = solutions[-1]
        problem = replace(problem, mesh=problem.mesh.refined())
        finer = Basis(problem.mesh, problem.element())
        start = coarse.basis.interpolator(coarse.pressure)(finer.doflocs)
        solutions.append(solve_reynolds(problem, start=start, **options))
    return solutions


def boundary_dofs(problem: Problem, basis: Basis) -> np.ndarray:
    """True at the degrees of freedom where p = 0 is prescribed."""
    mesh, held = problem.mesh, np.zeros(basis.N, dtype=bool)
    facets = mesh.boundary_facets()
    if problem.open_boundary is not None:
        middle = mesh.p[:, mesh.facets[:, facets]].mean(axis=1)
        facets = facets[~problem.open_boundary(middle)]
    held[basis.get_dofs(facets).all()] = True
    return held


def given_fields(problem: Problem, basis: Basis) -> dict:
    """Film, its gradient and the source at the quadrature points."""
    x = basis.global_coordinates()
    fields = {"film": problem.film(np.asarray(x)), "f": 0.0 * x[0]}
    if problem.source is not None:
        fields["f"] = problem.source(np.asarray(x))
    if problem.stabilisation != "none":
        smooth = basis.with_element(ELEMENTS[next(k for k in ELEMENTS if ELEMENTS[k] is problem.element)[0], 2]())
        fields["film_gradient"] = np.asarray(grad(smooth.interpolate(problem.film(smooth.doflocs))))
    return fields


def flow_scale(problem: Problem, basis: Basis, fields: dict) -> float:
    """The flow the residuals are measured against, m^2/s or m^3/s; 1 when nothing moves."""
    width = float(np.ptp(problem.mesh.p[1])) if problem.mesh.dim() > 1 else 1.0
    made = np.abs(LinearForm(lambda v, w: w.f * v).assemble(basis, f=fields["f"])).sum()
    return max(problem.speed * float(np.min(fields["film"])) * width, made) or 1.0


def measure(problem: Problem, p, r, held, cavitated, flow: float) -> dict[str, float]:
    """The residuals the stopping test of `solve_reynolds` names."""
    found = {"mass": float(np.abs(r[~(held | cavitated)]).sum() / flow)}
    if problem.cavitation:
        largest = np.abs(p).max() or 1.0
        found["tension"] = float(max(-p.min(), 0.0) / largest)
        found["overlap"] = float(p[cavitated].max(initial=0.0) / largest)
        found["suction"] = float(np.maximum(-r[cavitated], 0.0).sum() / flow)
    return found


def newton_step(problem: Problem, matrix, r, p, fixed) -> np.ndarray:
    """Step to ``r = 0`` on free nodes and ``p = 0`` on fixed ones, shortened where viscosity would run away."""
    step = np.where(fixed, -p, 0.0)
    free = np.flatnonzero(~fixed)
    rhs = -(r + matrix @ step)[free]
    step[free] = skfem.solver_direct_scipy()(matrix[free][:, free].tocsc(), rhs)
    alpha = problem.fluid.pressure_viscosity_coefficient
    growth = alpha * np.abs(step).max() if problem.fluid.viscosity_law != "constant" else 0.0
    return step * min(1.0, LARGEST_STEP / growth) if growth > 0 else step
