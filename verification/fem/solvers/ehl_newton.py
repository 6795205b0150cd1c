"""Newton's method for all unknowns of the line contact at once, on one mesh.

    elasticity   K u + B P = 0
    Reynolds     r(P, H) = 0 where P > 0, P = 0 where r > 0 (Swift-Stieber outlet; primal-dual active set)
    load         integral P + |X_in| P_in/2 = pi/2, the second term the tail upstream of the inlet

The unknowns are u, P and H0, with H = H0 + X^2/2 - u_z. The matrix of all of it is factorised by sparse LU in every
step. The order of elimination comes from the stiffness, once for a mesh.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu
from skfem import LinearForm

from ...types import FloatArray
from .ehl_body import Body
from .ehl_film import FilmEquations, Flow, assemble
from .report import CONVERGED, DIVERGED, ITERATION_LIMIT, SolveReport

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix


HERTZ_LOAD = math.pi / 2
LARGEST_GROWTH = 3.0  # of ln(eta) at any point in one step
SMALLEST_SHARE = 0.3  # of the film at any point that one step leaves


@dataclass(frozen=True)
class Iterate:
    """Displacement, pressure and approach. ``held`` are the degrees of freedom that were set to P = 0."""

    u: np.ndarray
    P: np.ndarray
    H0: float
    held: np.ndarray


@dataclass(frozen=True)
class Imbalance:
    """Residuals of an iterate: forces on the body, flow on the line, and relative load."""

    H: np.ndarray
    force: np.ndarray
    flow: Flow
    load: float


def film_thickness(body: Body, it: Iterate) -> np.ndarray:
    """Return H at the degrees of freedom of the line."""
    return it.H0 + body.x**2 / 2 - body.trace @ it.u


def load_weights(body: Body) -> np.ndarray:
    """Return weights of P in the load."""
    weights = LinearForm(lambda v, w: 1.0 * v).assemble(body.line)
    first = int(np.argmin(body.x))
    weights[first] += abs(body.x[first]) / 2
    return weights


def newton(
    body: Body, film: FilmEquations, start: Iterate, tolerance: float, max_iterations: int
) -> tuple[Iterate, float, SolveReport]:
    """Return the last iterate, the flow q and a report whose residuals are those of `measure`."""
    weights = load_weights(body)
    it = start
    history = []
    status = ITERATION_LIMIT
    while True:
        at = imbalance(body, film, it, weights)
        residuals = measure(body, it, at)
        history.append(max(residuals.values()))
        if not math.isfinite(history[-1]):
            status = DIVERGED
        elif history[-1] <= tolerance:
            status = CONVERGED
        if status != ITERATION_LIMIT or len(history) > max_iterations:
            break
        it = step(body, film, it, at, weights)
    steps = len(history) - 1
    solver = "full-system finite-element EHL"
    return (
        it,
        at.flow.inflow,
        SolveReport(
            solver=solver,
            status=status,
            iterations=steps,
            tolerance=tolerance,
            residuals=residuals,
            history=tuple(history),
        ),
    )


def imbalance(body: Body, film: FilmEquations, it: Iterate, weights: np.ndarray) -> Imbalance:
    """Return residuals of all equations."""
    H = film_thickness(body, it)
    force = body.stiffness @ it.u + body.traction @ it.P
    return Imbalance(H, force, assemble(film, it.P, H), float(weights @ it.P / HERTZ_LOAD - 1))


def measure(body: Body, it: Iterate, at: Imbalance) -> dict[str, float]:
    """Return what the stopping test looks at, each without dimension.

    - elasticity: largest force out of balance at a node, in loads
    - load: relative
    - mass: flow lost on the way to the rupture point (sum over nodes of |r|), in q
    - tension: largest -P in largest P
    - suction: flow that appears from nothing at nodes held at P = 0, in q
    - overlap: largest -H, in q
    """
    r = at.flow.residual
    scale = abs(at.flow.inflow)
    inner = it.held & (body.x < body.x.max())
    return {
        "elasticity": float(np.abs(at.force).max() / HERTZ_LOAD),
        "load": abs(at.load),
        "mass": float(np.abs(r[~it.held]).sum() / scale),
        "tension": float(max(-it.P.min(), 0.0) / np.abs(it.P).max()),
        "suction": float(np.maximum(-r[inner], 0.0).sum() / scale),
        "overlap": float(max(-at.H.min(), 0.0) / scale),
    }


def step(body: Body, film: FilmEquations, it: Iterate, at: Imbalance, weights: np.ndarray) -> Iterate:
    """Return one step of the complete system, shortened where viscosity or film would change too much."""
    held = np.where(it.held, at.flow.residual > 0, it.P < 0)
    held[np.argmax(body.x)] = True
    free = np.flatnonzero(~held)
    dP = np.where(held, -it.P, 0.0)
    scale = 1 / abs(at.flow.inflow)
    by_P = scale * at.flow.by_P[free]
    by_H = scale * at.flow.by_H[free]
    lost = scale * at.flow.residual[free] + by_P @ dP
    load = at.load + weights @ dP / HERTZ_LOAD
    rhs = -np.concatenate([at.force + body.traction @ dP, lost, [load]])
    change = solve(tangent(body, by_P[:, free], by_H, free, weights), rhs, body.order)
    du = change[: it.u.size]
    dH0 = change[-1]
    dP[free] = change[it.u.size : -1]
    share = step_length(film, it.P, dP, at.H, dH0 - body.trace @ du)
    return Iterate(it.u + share * du, it.P + share * dP, it.H0 + share * dH0, held)


def tangent(body: Body, by_P: csr_matrix, by_H: csr_matrix, free: np.ndarray, weights: np.ndarray) -> sp.csc_matrix:
    """Return the matrix of the complete system for changes of u, of P at the ``free`` degrees of freedom, and of H0."""
    return sp.bmat(
        [
            [body.stiffness, body.traction[:, free], None],
            [-by_H @ body.trace, by_P, sp.csr_matrix(by_H.sum(axis=1))],
            [None, sp.csr_matrix(weights[free] / HERTZ_LOAD), None],
        ],
        format="csc",
    )


def solve(matrix: sp.csc_matrix, rhs: np.ndarray, order: np.ndarray) -> np.ndarray:
    """Return sparse LU that eliminates the first unknowns in ``order`` and the others after them."""
    order = np.concatenate([order, np.arange(order.size, len(rhs))])
    factors = splu(matrix[order][:, order].tocsc(), permc_spec="NATURAL", diag_pivot_thresh=0.1)
    change = np.empty_like(rhs)
    change[order] = factors.solve(rhs[order])
    return change


def step_length(film: FilmEquations, P: FloatArray, dP: FloatArray, H: FloatArray, dH: FloatArray) -> float:
    """Return the share of a step after which no viscosity has changed, and no film has shrunk, by more than the limits
    say."""
    growth = np.abs(film.log_viscosity(np.maximum(P + dP, 0)) - film.log_viscosity(np.maximum(P, 0))).max()
    shrinking = float(np.max(-dH[H > 0] / H[H > 0], initial=0.0))
    most = 1 - SMALLEST_SHARE
    return float(min(1.0, LARGEST_GROWTH / max(growth, LARGEST_GROWTH), most / max(shrinking, most)))
