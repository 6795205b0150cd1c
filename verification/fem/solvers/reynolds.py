"""Reynolds' equation by finite elements, on lines, triangles and quadrilaterals, for a given film.

    - div( rho h^3/(12 eta) grad p ) + d(rho U h)/dx = f,   p = 0 on the boundary,

The weak form is ``(rho h^3/(12 eta) grad p, grad v) - (rho U h, dv/dx) = (f, v)``, with U the entrainment speed (mean
of the two surface speeds). With cavitation, the outlet is that of Reynolds (Swift-Stieber): ``p >= 0``, weak residual
``>= 0``, product 0, node by node. One loop does both. It is Newton's method on the free nodes, with each step's active
set from the primal-dual method (Hintermueller, Ito & Kunisch 2002, doi:10.1137/S1052623401383558). The weak form is
written once, and its tangent is taken by a complex step.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
import skfem
from skfem import Basis, BilinearForm, Functional, LinearForm
from skfem.helpers import dot, grad

from ...types import BoolArray, ComplexArray, FloatArray, Option
from .fluid import STEP, Fluid, slope
from .report import CONVERGED, DIVERGED, ITERATION_LIMIT, SolveReport, require

if TYPE_CHECKING:
    from scipy.sparse import csc_matrix
    from skfem.assembly.form.form import FormExtraParams
    from skfem.element.discrete_field import DiscreteField


ELEMENTS = {
    ("MeshLine", 1): skfem.ElementLineP1,
    ("MeshLine", 2): skfem.ElementLineP2,
    ("MeshTri", 1): skfem.ElementTriP1,
    ("MeshTri", 2): skfem.ElementTriP2,
    ("MeshQuad", 1): skfem.ElementQuad1,
    ("MeshQuad", 2): skfem.ElementQuad2,
}
STABILISATIONS = ("none", "supg")
LARGEST_STEP = 3.0  # of ln(viscosity) at any node in one step


@dataclass(frozen=True, kw_only=True)
class ReynoldsProblem:
    """What is solved. Lengths in m, speeds in m/s.

    mesh : scikit-fem mesh of lines, triangles or quadrilaterals; x (first coordinate) is the direction of motion
    film : film thickness in m at coordinates x of shape (dim, ...)
    fluid : viscosity and density laws
    speed : entrainment speed U >= 0
    degree : 1 (P1, Q1) or 2 (P2, Q2)
    source : f in m/s (as rho is relative to the density at p = 0), for manufactured solutions; may be None
    open_boundary : of facet midpoints (dim, n): True where p is not set to 0 and no flow passes (a symmetry line, or
        the side of an infinitely wide pad); None: p = 0 all round
    given : pressure in Pa prescribed at points (dim, n), NaN where it is not (for asperity contacts); None: no
        prescribed pressure
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
    given: Callable[[np.ndarray], np.ndarray] | None = None
    cavitation: bool = False
    stabilisation: str = "none"

    def __post_init__(self) -> None:
        _ = self.element
        form = f"stabilisation = {self.stabilisation!r}"
        require(self.stabilisation in STABILISATIONS, form, str(STABILISATIONS))
        # the residual of its strong form drops second derivatives of p
        require(self.stabilisation != "supg" or self.degree == 1, f"{form}, degree = {self.degree}", "degree 1")
        require(0 <= self.speed < np.inf, f"speed = {self.speed} m/s", ">= 0")
        film = self.film(self.mesh.p)
        fits = bool(np.all(np.isfinite(film) & (film > 0)))
        require(fits, f"film_thickness has a minimum of {np.min(film)} m on the mesh", "> 0")

    @property
    def element(self) -> type[skfem.Element]:
        """Return the class of the element; refuse a mesh or a degree that has none."""
        names = [k for k in ELEMENTS if type(self.mesh).__name__.startswith(k[0]) and k[1] == self.degree]
        mesh = f"mesh {type(self.mesh).__name__}, degree = {self.degree}"
        require(bool(names), mesh, "lines, triangles or quadrilaterals, degree 1 or 2")
        return ELEMENTS[names[0]]


@dataclass(frozen=True, kw_only=True)
class ReynoldsSolution:
    """Pressure and how it was found.

    problem, report : what was solved; how it went
    basis : scikit-fem basis of the pressure
    pressure : values at the degrees of freedom (``basis.doflocs``), Pa
    reaction : weak residual at every degree of freedom, m^2/s on a line, m^3/s on a surface: on the boundary
        the flow that enters there, in the cavitated part the flow that is not carried on, zero elsewhere
    """

    problem: ReynoldsProblem
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
        """Return flow that enters through the boundary at this x, m^2/s or m^3/s (volume at p = 0)."""
        return float(self.reaction[np.abs(self.basis.doflocs[0] - x) < 1e-9 * np.ptp(self.basis.doflocs[0])].sum())

    def friction(self, sliding_speed: float) -> tuple[float, float]:
        """Return ``(integral eta Du/h, integral (h/2) dp/dx)`` over the part under pressure, N/m or N."""
        film = self.problem.film
        fluid = self.problem.fluid
        couette = Functional(lambda w: np.where(w.p > 0, fluid.eta(w.p) * sliding_speed / film(w.x), 0.0))
        rolling = Functional(lambda w: film(w.x) / 2 * grad(w.p)[0])
        p = self.basis.interpolate(self.pressure)
        return float(couette.assemble(self.basis, p=p)), float(rolling.assemble(self.basis, p=p))

    def error(self, exact: Callable[[np.ndarray], np.ndarray]) -> float:
        """Return L2 norm of ``p - exact(x)`` relative to that of ``exact``."""
        p = self.basis.interpolate(self.pressure)
        off = Functional(lambda w: (w.p - exact(w.x)) ** 2).assemble(self.basis, p=p)
        return float(np.sqrt(off / Functional(lambda w: exact(w.x) ** 2).assemble(self.basis)))


def weak_form(
    problem: ReynoldsProblem,
    p: ComplexArray | FloatArray,
    gradient: ComplexArray | FloatArray,
    w: dict[str, FloatArray],
) -> tuple[np.ndarray, np.ndarray]:
    """Return ``(a, b)`` of the weak form ``integral a v + b . grad v`` at the quadrature points.

    ``p`` and its ``gradient`` may be real or complex; ``w`` are the fields of `given_fields`.
    """
    h = w["film"]
    fluid = problem.fluid
    rho = fluid.rho(p)
    mobility = rho * h**3 / (12 * fluid.eta(p))
    flow = mobility * gradient
    flow[0] = flow[0] - problem.speed * rho * h
    if problem.stabilisation == "supg":
        flow[0] = flow[0] + upwind_flow(problem, p, gradient, mobility, w)
    return -w["f"] + 0 * p, flow


def upwind_flow(
    problem: ReynoldsProblem,
    p: ComplexArray | FloatArray,
    gradient: ComplexArray | FloatArray,
    mobility: ComplexArray | FloatArray,
    w: dict[str, FloatArray],
) -> np.ndarray:
    """Return what the streamline-upwind form adds to the flow: ``tau`` times wave speed times strong residual.

    Brooks & Hughes 1982, doi:10.1016/0045-7825(82)90071-8; tau of Shakib, Hughes & Johan 1991,
    doi:10.1016/0045-7825(91)90041-4. It vanishes where the pressure solves the equation, so the order stays.
    Laws and tau are taken at the real pressure: the tangent is that much short of exact.
    """
    fluid = problem.fluid
    real = np.real(p)
    steady = np.real(mobility)
    rho = fluid.rho(real)
    rho_slope = slope(fluid.rho, real)
    wave = problem.speed * w["film"] * rho_slope
    stiffening = rho_slope / rho - slope(fluid.log_viscosity, real)
    steepening = steady * (stiffening * gradient + 3 * w["film_gradient"] / w["film"])
    strong = (
        wave * gradient[0] + problem.speed * fluid.rho(p) * w["film_gradient"][0] - dot(steepening, gradient) - w["f"]
    )
    tau = 1 / np.sqrt((2 * wave / w["size"]) ** 2 + 9 * (4 * steady / w["size"] ** 2) ** 2)
    return tau * wave * strong


@LinearForm
def residual(v: DiscreteField, w: FormExtraParams) -> FloatArray:
    """Return the weak form itself."""
    return w.a * v + dot(w.b, grad(v))


@BilinearForm
def tangent(u: DiscreteField, v: DiscreteField, w: FormExtraParams) -> FloatArray:
    """Return the derivative of `residual`, from the derivatives of (a, b) by p and by each component of its
    gradient."""
    a = w.a_p * u + dot(w.a_g, grad(u))
    b = w.b_p * u + sum(slope * du for slope, du in zip(w.b_g, grad(u), strict=True))
    return a * v + dot(b, grad(v))


def linearised(
    problem: ReynoldsProblem, p: FloatArray, gradient: FloatArray, w: dict[str, FloatArray]
) -> dict[str, np.ndarray]:
    """Return derivatives of `weak_form` by a complex step, one for p and one for each component of its gradient."""

    def along(dp: float, dg: FloatArray) -> tuple[FloatArray, FloatArray]:
        a, b = weak_form(problem, p + 1j * STEP * dp, gradient + 1j * STEP * dg[:, None, None], w)
        return np.imag(a) / STEP, np.imag(b) / STEP

    unit = np.eye(len(gradient))
    a_p, b_p = along(1.0, 0.0 * unit[0])
    by_gradient = [along(0.0, direction) for direction in unit]
    return {
        "a_p": a_p,
        "b_p": b_p,
        "a_g": np.array([a for a, _ in by_gradient]),
        "b_g": np.array([b for _, b in by_gradient]),
    }


def solve_reynolds(
    problem: ReynoldsProblem,
    *,
    start: np.ndarray | None = None,
    tolerance: float = 1e-8,
    max_iterations: int = 100,
) -> ReynoldsSolution:
    """Solve for the pressure from ``start`` (at the degrees of freedom; None: 0).

    Stops when the largest of these is <= ``tolerance``:

    - mass: ``sum |r_i|/flow_i`` over free nodes, with r the weak residual and flow_i = U h (times the width of a
      surface mesh) there, or ``sum |(f, v_i)|`` where that is larger
    - tension: ``max(-p)/max |p|``, with cavitation
    - overlap: ``max p`` where p should be 0 because ``r_i/J_ii > p_i`` / ``max |p|``: pressure and lost flow
      together at one node
    - suction: ``sum max(-r_i, 0)/flow_i`` over nodes held at p = 0 by cavitation

    Raises `SolveError`, with report and last solution, where the residual stays too large.
    """
    basis = Basis(problem.mesh, problem.element(), intorder=2 * problem.degree + 4)
    held = boundary_dofs(problem, basis)
    fields = given_fields(problem, basis)
    p = np.zeros(basis.N) if start is None else np.array(start, dtype=float)
    p[held] = 0.0
    if problem.given is not None:
        prescribed = problem.given(basis.doflocs)
        known = np.isfinite(prescribed) & ~held
        p[known] = prescribed[known]
        held |= known
    flow = flow_scale(problem, basis, fields)
    history = []
    status = ITERATION_LIMIT
    for _ in range(max_iterations + 1):
        field = basis.interpolate(p)
        local = (np.asarray(field), np.asarray(grad(field)))
        a, b = weak_form(problem, *local, fields)
        r = residual.assemble(basis, a=a, b=b)
        matrix = tangent.assemble(basis, **linearised(problem, *local, fields)).tocsc()
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
        p = p + newton_step(problem, matrix, r, p, held, cavitated)
    steps = len(history) - 1
    report = SolveReport(
        solver="Reynolds finite elements",
        status=status,
        iterations=steps,
        tolerance=tolerance,
        residuals=residuals,
        history=tuple(history),
    )
    return report.checked(ReynoldsSolution(problem=problem, basis=basis, pressure=p, reaction=r, report=report))


def solve_refined(problem: ReynoldsProblem, refinements: int, **options: Option) -> list[ReynoldsSolution]:
    """Solve on ``problem.mesh`` and on each of its uniform refinements, each started from the one before.

    Besides giving a convergence study its meshes, this keeps the active set cheap: started from nothing, a
    cavitation boundary recedes one node a step. Options as for `solve_reynolds`.
    """
    solutions = [solve_reynolds(problem, **options)]
    for _ in range(refinements):
        coarse = solutions[-1]
        problem = replace(problem, mesh=problem.mesh.refined())
        solutions.append(solve_reynolds(problem, start=prolonged(coarse, problem), **options))
    return solutions


def prolonged(coarse: ReynoldsSolution, problem: ReynoldsProblem) -> np.ndarray:
    """Return the vertex values of ``coarse``, linear in each cell, at the degrees of freedom on the refined mesh."""
    old = coarse.problem.mesh
    new = problem.mesh
    values = np.concatenate(vertices_and_middles(old, coarse.at_vertices), axis=-1)
    fits = np.allclose(np.concatenate(vertices_and_middles(old, old.p), axis=-1), new.p)
    require(fits, "the mesh does not follow from that of the coarse solution", "its uniform refinement")
    basis = Basis(new, problem.element())
    start = basis.zeros()
    start[basis.nodal_dofs[0]] = values
    if problem.degree == 2:
        middles = vertices_and_middles(new, values)[1:]
        kinds = [d[0] for d in (basis.facet_dofs, basis.interior_dofs) if d.size]
        for dofs, value in zip(kinds, middles, strict=True):
            start[dofs] = value
    return start


def vertices_and_middles(mesh: skfem.Mesh, values: np.ndarray) -> list[np.ndarray]:
    """Return values at vertices, at the middles of edges (on surfaces), and of lines or quadrilaterals.

    In this order scikit-fem numbers the vertices of a refined mesh.
    """
    result = [values]
    if mesh.dim() > 1:
        result.append(values[..., mesh.facets].mean(axis=-2))
    if not type(mesh).__name__.startswith("MeshTri"):
        result.append(values[..., mesh.t].mean(axis=-2))
    return result


def boundary_dofs(problem: ReynoldsProblem, basis: Basis) -> np.ndarray:
    """Return true at the degrees of freedom where p = 0 is prescribed."""
    mesh = problem.mesh
    held = np.zeros(basis.N, dtype=bool)
    facets = mesh.boundary_facets()
    if problem.open_boundary is not None:
        middle = mesh.p[:, mesh.facets[:, facets]].mean(axis=1)
        facets = facets[~problem.open_boundary(middle)]
    held[basis.get_dofs(facets).all()] = True
    return held


def given_fields(problem: ReynoldsProblem, basis: Basis) -> dict[str, np.ndarray]:
    """Return film, its gradient and the source at the quadrature points."""
    x = basis.global_coordinates()
    fields = {"film": problem.film(np.asarray(x)), "f": 0.0 * x[0], "size": np.asarray(basis.mesh_parameters())}
    if problem.source is not None:
        fields["f"] = problem.source(np.asarray(x))
    if problem.stabilisation != "none":
        smooth = basis.with_element(ELEMENTS[next(k for k in ELEMENTS if ELEMENTS[k] is problem.element)[0], 2]())
        fields["film_gradient"] = np.asarray(grad(smooth.interpolate(problem.film(smooth.doflocs))))
    return fields


def flow_scale(problem: ReynoldsProblem, basis: Basis, fields: dict[str, np.ndarray]) -> np.ndarray:
    """Return what a residual is measured against at each degree of freedom, m^2/s or m^3/s; 1 when nothing moves."""
    width = float(np.ptp(problem.mesh.p[1])) if problem.mesh.dim() > 1 else 1.0
    made = np.abs(LinearForm(lambda v, w: w.f * v).assemble(basis, f=fields["f"])).sum()
    flow = np.maximum(problem.speed * problem.film(basis.doflocs) * width, made)
    return flow if flow.max() > 0 else np.ones(basis.N)


def measure(
    problem: ReynoldsProblem, p: FloatArray, r: FloatArray, held: BoolArray, cavitated: BoolArray, flow: FloatArray
) -> dict[str, float]:
    """Return the residuals the stopping test of `solve_reynolds` names."""
    free = ~(held | cavitated)
    results = {"mass": float(np.abs(r / flow)[free].sum())}
    if problem.cavitation:
        largest = np.abs(p).max() or 1.0
        results["tension"] = float(max(-p.min(), 0.0) / largest)
        results["overlap"] = float(p[cavitated].max(initial=0.0) / largest)
        results["suction"] = float(np.maximum(-r / flow, 0.0)[cavitated].sum())
    return results


def newton_step(
    problem: ReynoldsProblem, matrix: csc_matrix, r: FloatArray, p: FloatArray, held: BoolArray, cavitated: BoolArray
) -> np.ndarray:
    """Return the step to ``r = 0`` on free and ``p = 0`` on cavitated nodes, shortened where viscosity would run
    away."""
    step = np.where(cavitated & ~held, -p, 0.0)
    free = np.flatnonzero(~(held | cavitated))
    rhs = -(r + matrix @ step)[free]
    step[free] = skfem.solver_direct_scipy()(matrix[free][:, free].tocsc(), rhs)
    alpha = problem.fluid.pressure_viscosity_coefficient
    growth = alpha * np.abs(step).max() if problem.fluid.viscosity_law != "constant" else 0.0
    return step * min(1.0, LARGEST_STEP / growth) if growth > 0 else step
