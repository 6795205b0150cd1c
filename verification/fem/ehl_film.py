"""Reynolds' equation on the surface of the body, in Hertz variables: weak residual and tangent.

    d/dX( rho H - m dP/dX ) = 0,   m = rho H^3/(eta lambda),   lambda = 12 eta0 U R^2/(b^3 p_h)

with rho and eta relative to their values at p = 0. Weakly ``-(q, v') - q_in v(inlet)``, q = rho H - m P' the flux. Far
upstream the gap is a parabola and the oil Newtonian, so that P falls like |X|^-3: there ``P' = 3 P/|X|``.

Under high pressure m vanishes and ``(rho H)'`` is left, a Hilbert transform of the pressure that Galerkin sees no
better than convection: it rings. Local projection (Becker & Braack 2001, doi:10.1007/s10092-001-8180-4; Matthies,
Skrzypacz & Tobiska 2007, doi:10.1051/m2an:2007038) adds ``tau (k(rho H)', k v')`` with k what is left of a function after
its mean in the cell is taken off: for P2 a term of third order in the cell length, so the element keeps its order.
It holds no viscosity; a residual-based (SUPG) form does, and was found to have several solutions where the pressure
spike is not resolved. First-order upwinding, ``tau ((rho H)', v')``, is for first guesses.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from skfem import Basis, BilinearForm, LinearForm

from .fluid import STEP, Fluid, slope

NEAR = 1e-5  # of p_h, for a slope that a complex step can pass through


@dataclass(frozen=True)
class Film:
    """The flow on a line.

    Attributes
    ----------
    line : P2 with second derivatives
    fluid : viscosity and density laws
    hertz_pressure : Pa per unit of P
    speed_parameter : lambda
    projection : share of the local projection term, 1 or (plain Galerkin) 0
    upwind : share of first-order upwinding
    piezo : share of ln(eta/eta0), 1 but in continuation
    """

    line: Basis
    fluid: Fluid
    hertz_pressure: float
    speed_parameter: float
    projection: float = 1.0
    upwind: float = 0.0
    piezo: float = 1.0

    def log_viscosity(self, P):
        """ln(eta/eta0); below zero, where only iterates are, the tangent at zero."""
        return self.piezo * extended(self.fluid.log_viscosity, P * self.hertz_pressure)

    def density(self, P):
        """rho/rho0, likewise."""
        return extended(self.fluid.rho, P * self.hertz_pressure)

    def mobility(self, P, H):
        """m."""
        return self.density(P) * H**3 * np.exp(-self.log_viscosity(P)) / self.speed_parameter

    def flux(self, P, P1, P2, H, H1, H2, size, offset):
        """q, stabilised, from P and H with their derivatives (1, 2) at a point ``offset`` from the middle of a cell of
        length ``size``; real or complex."""
        m, rho = self.mobility(P, H), self.density(P)
        wave = (self.density(P + NEAR) - self.density(P - NEAR)) / (2 * NEAR) * H
        tau = size / 2 / np.sqrt(1 + (6 * m / size / (1 + wave)) ** 2)
        added = self.projection * offset * (rho * H2 + wave * P2) + self.upwind * (rho * H1 + wave * P1)
        return rho * H - m * P1 - tau * added

    def inflow(self, P, H, inlet: float):
        """q at the inlet."""
        return self.density(P) * H - self.mobility(P, H) * 3 * P / abs(inlet)


def extended(law: Callable, p):
    """``law`` continued below p = 0 by its tangent."""
    above = np.real(p) > 0
    return np.where(above, law(np.where(above, p, 0.0)), law(0.0) + slope(law, 0.0) * p)


def partials(function: Callable, *values) -> tuple[np.ndarray, list[np.ndarray]]:
    """A function and its derivatives by each of its arguments, by complex steps."""
    slopes = [np.imag(function(*(v + 1j * STEP * (i == k) for i, v in enumerate(values)))) / STEP
              for k in range(len(values))]
    return function(*values), slopes


@LinearForm
def flux_form(v, w):
    """``-(q, v')``."""
    return -w.q * v.grad[0]


@BilinearForm
def flux_tangent(u, v, w):
    """Its derivative."""
    return -(w.by_value * u + w.by_slope * u.grad[0] + w.by_bend * u.hess[0, 0]) * v.grad[0]


@dataclass(frozen=True)
class Flow:
    """Weak residual on the line (mass that is lost at a degree of freedom), its derivatives, and the flux that enters."""

    residual: np.ndarray
    by_P: sp.csr_matrix
    by_H: sp.csr_matrix
    inflow: float


def assemble(film: Film, P: np.ndarray, H: np.ndarray) -> Flow:
    """The flow for pressure and film at the degrees of freedom of the line."""
    line = film.line
    p, h = line.interpolate(P), line.interpolate(H)
    x = np.asarray(line.global_coordinates()[0])
    offset = x - x.mean(axis=1, keepdims=True)
    size = np.abs(np.diff(line.mesh.p[0][line.mesh.t], axis=0)).T + 0 * x
    local = (np.asarray(p), p.grad[0], p.hess[0, 0], np.asarray(h), h.grad[0], h.hess[0, 0])
    q, (p0, p1, p2, h0, h1, h2) = partials(lambda *a: film.flux(*a, size, offset), *local)
    r = flux_form.assemble(line, q=q)
    by_P = flux_tangent.assemble(line, by_value=p0, by_slope=p1, by_bend=p2)
    by_H = flux_tangent.assemble(line, by_value=h0, by_slope=h1, by_bend=h2)

    first = int(np.argmin(line.doflocs[0]))
    inflow, slopes = partials(lambda a, b: film.inflow(a, b, line.doflocs[0, first]), P[first], H[first])
    r[first] -= inflow
    there = sp.csr_matrix(([1.0], ([first], [first])), shape=by_P.shape)
    return Flow(r, by_P - slopes[0] * there, by_H - slopes[1] * there, float(inflow))
