"""Reynolds' equation on the surface of the body, in Hertz variables: weak residual and tangent.

    d/dX( rho H - m dP/dX ) = 0,   m = rho H^3/(eta lambda),   lambda = 12 eta0 U R^2/(b^3 p_h)

rho and eta are relative to their values at p = 0. The weak form is ``-(q, v') - q_in v(inlet)`` with the flux q = rho H
- m P'. Far upstream the gap is a parabola and the oil is Newtonian, so P falls like |X|^-3. There ``P' = 3 P/|X|``.

Under high pressure m vanishes, and ``(rho H)'`` is left. It is a Hilbert transform of the pressure, which Galerkin sees
no better than convection: it rings. Interior penalty (Burman & Hansbo 2004, doi:10.1016/j.cma.2003.12.032) charges the
jumps of slope between cells, ``sum gamma size^2 [(rho H)'][v']`` over the vertices. For P2 this term is of higher order
than the element's own error, and it holds no viscosity. A residual-based (SUPG) form does hold viscosity, and was found
to have several solutions where the pressure spike is not resolved. First-order upwinding, ``(size/2) ((rho H)', v')``,
serves first guesses. Both fade where pressure diffuses in less than a cell.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp
from skfem import Basis, BilinearForm, LinearForm

from ...types import ComplexArray, FloatArray, Numbers
from .fluid import STEP, Fluid, slope

if TYPE_CHECKING:
    from skfem.assembly.form.form import FormExtraParams
    from skfem.element.discrete_field import DiscreteField


NEAR = 1e-5  # of p_h, for a slope that a complex step can pass through
PENALTY = 0.03  # gamma of the interior penalty on jumps of the slope; above 0.1 it rings in its own way


@dataclass(frozen=True, kw_only=True)
class FilmEquations:
    """The flow on a line.

    line : P2
    fluid : viscosity and density laws
    hertz_pressure : Pa per unit of P
    speed_parameter : lambda
    penalty : gamma; 0: plain Galerkin. Above 0.1 it rings in its own way
    upwind : share of first-order upwinding
    piezo : share of ln(eta/eta0), 1 but in continuation
    shear : eta0 |u1 - u2| R/(b^2 tau_E), which thins an Eyring fluid along the sliding: eta_eff is d tau/d rate of its
        law (Hooke 2006, doi:10.1243/13506501JET146, eq. 35); 0: Newtonian
    """

    line: Basis
    fluid: Fluid
    hertz_pressure: float
    speed_parameter: float
    penalty: float = PENALTY
    upwind: float = 0.0
    piezo: float = 1.0
    shear: float = 0.0

    def log_viscosity(self, P: complex | ComplexArray | FloatArray) -> complex | ComplexArray | FloatArray:
        """Return ln(eta/eta0). Below zero, where only iterates are, it goes on by its tangent at zero."""
        return self.piezo * extended(self.fluid.log_viscosity, P * self.hertz_pressure)

    def density(self, P: Numbers) -> np.ndarray:
        """Return rho/rho0, which also goes on by its tangent below zero."""
        return extended(self.fluid.rho, P * self.hertz_pressure)

    def mobility(
        self, P: complex | ComplexArray | FloatArray, H: complex | ComplexArray | FloatArray
    ) -> complex | ComplexArray | FloatArray:
        """Return the mobility m."""
        fluidity = np.exp(-self.log_viscosity(P))
        if self.shear:
            fluidity = np.sqrt(fluidity**2 + (self.shear / H) ** 2)
        return self.density(P) * H**3 * fluidity / self.speed_parameter

    def wave(self, P: ComplexArray | FloatArray, H: ComplexArray | FloatArray) -> ComplexArray | FloatArray:
        """Return d(rho H)/dP at constant H."""
        return (self.density(P + NEAR) - self.density(P - NEAR)) / (2 * NEAR) * H

    def carried(
        self, P: ComplexArray | FloatArray, H: ComplexArray | FloatArray, size: FloatArray
    ) -> ComplexArray | FloatArray:
        """Return 1 where pressure goes with the flow, falling to 0 where it diffuses in less than a cell."""
        return 1 / np.sqrt(1 + (6 * self.mobility(P, H) / size / (1 + self.wave(P, H))) ** 2)

    def flux(
        self,
        P: ComplexArray | FloatArray,
        P1: ComplexArray | FloatArray,
        H: ComplexArray | FloatArray,
        H1: ComplexArray | FloatArray,
        size: FloatArray,
    ) -> ComplexArray | FloatArray:
        """Return the flux q, with upwinding, real or complex.

        P and H have the slopes P1 and H1 in a cell of length ``size``.
        """
        rho = self.density(P)
        q = rho * H - self.mobility(P, H) * P1
        if self.upwind:
            q = q - self.upwind * size / 2 * self.carried(P, H, size) * (rho * H1 + self.wave(P, H) * P1)
        return q

    def charge(
        self,
        P: ComplexArray | FloatArray,
        P_jump: ComplexArray | FloatArray,
        H: ComplexArray | FloatArray,
        H_jump: ComplexArray | FloatArray,
        size: FloatArray,
    ) -> ComplexArray | FloatArray:
        """Return what a jump of v' is multiplied with at a vertex where P' and H' jump."""
        return self.penalty * size**2 * self.carried(P, H, size) * (self.density(P) * H_jump + self.wave(P, H) * P_jump)

    def inflow(self, P: Numbers, H: Numbers, inlet: float) -> np.ndarray:
        """Return the flux q at the inlet."""
        return self.density(P) * H - self.mobility(P, H) * 3 * P / abs(inlet)


def extended(law: Callable[[Numbers], np.ndarray], p: Numbers) -> np.ndarray:
    """Return ``law`` continued below p = 0 by its tangent."""
    p = np.asarray(p)
    above = p.real > 0
    return np.where(above, law(np.where(above, p, 0.0)), law(0.0) + slope(law, 0.0) * p)


def partials(function: Callable[..., np.ndarray], *values: float | FloatArray) -> tuple[np.ndarray, list[np.ndarray]]:
    """Return a function and its derivatives by each of its arguments, by complex steps."""
    slopes = [
        np.imag(function(*(v + 1j * STEP * (i == k) for i, v in enumerate(values)))) / STEP for k in range(len(values))
    ]
    return function(*values), slopes


@lru_cache(maxsize=4)
def slope_jumps(line: Basis) -> tuple[np.ndarray, np.ndarray, sp.csr_matrix]:
    """Return degrees of freedom at inner vertices, mean length of the cells there, the matrix of the slope's jumps:
    once for a line."""
    mesh = line.mesh
    size = np.abs(np.diff(mesh.p[0][mesh.t], axis=0)[0])
    slopes_inwards = np.array([[-3.0, -1.0, 4.0], [-1.0, -3.0, 4.0]])  # at either end, times size
    jumps = sum(
        sp.csr_matrix(
            (np.outer(weights, 1 / size).ravel(), (np.tile(vertex, 3), line.element_dofs.ravel())),
            shape=(mesh.nvertices, line.N),
        )
        for vertex, weights in zip(mesh.t, slopes_inwards, strict=True)
    )
    inner = np.flatnonzero(np.bincount(mesh.t.ravel()) == 2)
    mean = np.bincount(mesh.t.ravel(), np.tile(size, 2)) / 2
    return line.nodal_dofs[0, inner], mean[inner], jumps.tocsr()[inner]


@LinearForm
def flux_form(v: DiscreteField, w: FormExtraParams) -> FloatArray:
    """Return ``-(q, v')``."""
    return -w.q * v.grad[0]


@BilinearForm
def flux_tangent(u: DiscreteField, v: DiscreteField, w: FormExtraParams) -> FloatArray:
    """Return the derivative of `flux_form`."""
    return -(w.by_value * u + w.by_slope * u.grad[0]) * v.grad[0]


@dataclass(frozen=True)
class Flow:
    """The weak residual on the line (flow lost at a degree of freedom), its derivatives, and the flux that enters."""

    residual: np.ndarray
    by_P: sp.csr_matrix
    by_H: sp.csr_matrix
    inflow: float


def assemble(film: FilmEquations, P: np.ndarray, H: np.ndarray) -> Flow:
    """Return the flow for pressure and film at the degrees of freedom of the line."""
    parts = [inside(film, P, H)] + ([penalty(film, P, H)] if film.penalty else [])
    r, by_P, by_H = (sum(terms[1:], terms[0]) for terms in zip(*parts, strict=True))
    first = int(np.argmin(film.line.doflocs[0]))
    inflow, slopes = partials(lambda a, b: film.inflow(a, b, film.line.doflocs[0, first]), P[first], H[first])
    r[first] -= inflow
    there = sp.csr_matrix(([1.0], ([first], [first])), shape=by_P.shape)
    return Flow(r, by_P - slopes[0] * there, by_H - slopes[1] * there, float(inflow))


def inside(film: FilmEquations, P: FloatArray, H: FloatArray) -> tuple[np.ndarray, sp.csr_matrix, sp.csr_matrix]:
    """Return ``-(q, v')`` and its derivatives by P and H."""
    line = film.line
    p = line.interpolate(P)
    h = line.interpolate(H)
    size = np.abs(np.diff(line.mesh.p[0][line.mesh.t], axis=0)).T
    q, (p0, p1, h0, h1) = partials(
        lambda P, P1, H, H1: film.flux(P, P1, H, H1, size), np.asarray(p), p.grad[0], np.asarray(h), h.grad[0]
    )
    return (
        flux_form.assemble(line, q=q),
        flux_tangent.assemble(line, by_value=p0, by_slope=p1),
        flux_tangent.assemble(line, by_value=h0, by_slope=h1),
    )


def penalty(film: FilmEquations, P: FloatArray, H: FloatArray) -> tuple[np.ndarray, sp.csr_matrix, sp.csr_matrix]:
    """Return ``sum gamma size^2 [(rho H)'][v']`` and its derivatives by P and H."""
    at, size, jump = slope_jumps(film.line)
    c, (p0, p1, h0, h1) = partials(
        lambda P, P1, H, H1: film.charge(P, P1, H, H1, size), P[at], jump @ P, H[at], jump @ H
    )
    pick = sp.csr_matrix((np.ones(at.size), (np.arange(at.size), at)), shape=jump.shape)
    return (
        jump.T @ c,
        jump.T @ (sp.diags_array(p0) @ pick + sp.diags_array(p1) @ jump),
        jump.T @ (sp.diags_array(h0) @ pick + sp.diags_array(h1) @ jump),
    )
