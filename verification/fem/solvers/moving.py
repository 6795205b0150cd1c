"""A wave of finite height moves through the full-system film of `ehl`: implicit steps in time, second order (BDF2).

    d(rho H)/dT + d/dX( rho H - m dP/dX ) = 0,   H = H0(T) + X²/2 - u_z - z(X, T),   T = U t/b

The body is linear, so its displacement is eliminated once and for all (`Body.compliance`, the Schur complement on the
line). A step then solves for pressure and approach alone, by Newton's method with the active set of `ehl_newton`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from skfem import LinearForm

from ...types import BoolArray, FloatArray
from .ehl import EHLSolution
from .ehl_body import Body
from .ehl_film import assemble
from .ehl_newton import HERTZ_LOAD, load_weights, step_length
from .report import SolveError, require
from .ripple import stored

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix
    from skfem.assembly.form.form import FormExtraParams
    from skfem.element.discrete_field import DiscreteField


BDF2 = (1.5, -2.0, 0.5)
EULER = (1.0, -1.0, 0.0)


@LinearForm
def gained(v: DiscreteField, w: FormExtraParams) -> FloatArray:
    """Return ``(c, v)``."""
    return w.c * v


class Moment(NamedTuple):
    """Time b/U, pressure p_h and film b²/R at the degrees of freedom of the line."""

    time: float
    P: np.ndarray
    H: np.ndarray


def march(
    at: EHLSolution,
    waves: Callable[[FloatArray, float], FloatArray],
    step: float,
    *,
    tolerance: float = 1e-7,
    max_iterations: int = 30,
) -> Iterator[Moment]:
    """Moments that are ``step`` [b/U] apart, without end, from the smooth solution on.

    waves : z [b²/R] at positions X and a time T; 0 at T = 0. The first step is implicit Euler
    tolerance : on lost flow over the inflow, and on the load

    Raises `SolveError` where a step does not converge.
    """
    require(step > 0, f"step = {step} b/U", "> 0")
    body = at.body
    film = at.film
    line = body.line
    x = body.x
    weights = load_weights(body)
    compliance = body.compliance
    P = at.P
    H0 = at.approach
    last = int(np.argmax(x))
    held = at.P <= 0
    now = content(at, at.P, at.H)
    before = now
    time = 0.0
    while True:
        a = BDF2 if time else EULER
        time += step
        shape = x**2 / 2 - waves(x, time)
        for _ in range(max_iterations + 1):
            H = H0 + shape + compliance @ P
            flow = assemble(film, P, H)
            then = content(at, P, H)
            lost = flow.residual + gained.assemble(line, c=(a[0] * then + a[1] * now + a[2] * before) / step)
            load = float(weights @ P / HERTZ_LOAD - 1)
            error = max(np.abs(lost[~held]).sum() / abs(flow.inflow), abs(load), -P.min())
            new = np.where(held, lost > 0, P < 0)
            new[last] = True
            if error <= tolerance and not (new != held).any():
                break
            held = new
            stored_P, stored_H = stored(film, P, H)
            by_P = flow.by_P + a[0] / step * stored_P
            by_H = flow.by_H + a[0] / step * stored_H
            dP, dH0 = newton_change(body, P, held, lost, load, by_P, by_H)
            share = step_length(film, P, dP, H, dH0 + compliance @ dP)
            P = P + share * dP
            H0 = H0 + share * dH0
        else:
            raise SolveError(f"wave in time: T = {time:g} b/U, error {error:.1e} after {max_iterations} steps")
        before, now = now, then
        yield Moment(time, P, H)


def content(at: EHLSolution, P: FloatArray, H: FloatArray) -> FloatArray:
    """Return rho H at the points of quadrature."""
    line = at.body.line
    return at.film.density(np.asarray(line.interpolate(P))) * np.asarray(line.interpolate(H))


def newton_change(
    body: Body, P: FloatArray, held: BoolArray, lost: FloatArray, load: float, by_P: csr_matrix, by_H: csr_matrix
) -> tuple[np.ndarray, float]:
    """Return change of pressure and approach by one step of Newton's method: ``lost`` and ``load`` to 0, ``held`` P to
    0."""
    free = np.flatnonzero(~held)
    weights = load_weights(body)
    dP = np.where(held, -P, 0.0)
    full = by_P[free].toarray() + by_H[free] @ body.compliance
    matrix = np.zeros((free.size + 1, free.size + 1))
    matrix[:-1, :-1] = full[:, free]
    matrix[:-1, -1] = np.asarray(by_H[free].sum(axis=1)).ravel()
    matrix[-1, :-1] = weights[free] / HERTZ_LOAD
    right = -np.append(lost[free] + full @ dP, load + weights @ dP / HERTZ_LOAD)
    change = np.linalg.solve(matrix, right)
    dP[free] = change[:-1]
    return dP, change[-1]
