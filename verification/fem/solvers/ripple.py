"""Waves of infinitesimal height through the film of `ehl`: the response of the film, linear and in steps of time.

The film is H = H0 + X²/2 - u_z - z with waves z = A cos(k (X - v T)), where T = U t/b and v is the speed of the rough
surface over the entrainment speed U: 0 at rest, 1 in pure rolling, 2 where the smooth body rests. Reynolds' equation
has the term d(rho H)/dT.

To first order in A the changes of displacement, pressure and approach are complex amplitudes of exp(-i k v T). They
solve the tangent of the complete system (`ehl_newton`) at the smooth solution, with the term above, and ``-by_H z`` as
its right side. The rupture point does not move, because pressure and its slope vanish there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from skfem import BilinearForm

from ...types import FloatArray
from .ehl import EHLSolution
from .ehl_film import FilmEquations, assemble
from .ehl_newton import load_weights, solve, tangent

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix
    from skfem.assembly.form.form import FormExtraParams
    from skfem.element.discrete_field import DiscreteField


@BilinearForm
def mass(u: DiscreteField, v: DiscreteField, w: FormExtraParams) -> FloatArray:
    """Return ``(c u, v)``."""
    return w.c * u * v


def stored(film: FilmEquations, P: FloatArray, H: FloatArray) -> tuple[csr_matrix, csr_matrix]:
    """Return derivatives of ``(rho H, v)`` by P and by H."""
    line = film.line
    p = np.asarray(line.interpolate(P))
    h = np.asarray(line.interpolate(H))
    return mass.assemble(line, c=film.wave(p, h)), mass.assemble(line, c=film.density(p))


def ripple(at: EHLSolution, wavelength: float, speed: float = 0.0) -> np.ndarray:
    """Return change of the smooth film per height of a wave exp(i k x) of ``wavelength`` [m] at one moment, complex, at
    the dofs of the line. ``speed``: of the waves, over the entrainment speed."""
    body = at.body
    contact = at.contact
    k = 2 * np.pi * contact.half_width / wavelength
    wave = np.exp(1j * k * body.x)
    flow = assemble(at.film, at.P, at.H)
    weights = load_weights(body)
    stored_P, stored_H = stored(at.film, at.P, at.H)
    free = np.flatnonzero(at.P > 0)
    by_P = (flow.by_P - 1j * k * speed * stored_P)[free]
    by_H = (flow.by_H - 1j * k * speed * stored_H)[free]
    matrix = tangent(body, by_P[:, free], by_H, free, weights)
    right = np.concatenate([np.zeros(at.displacement.size), by_H @ wave, [0.0]])
    change = solve(matrix, right, body.order)
    return change[-1] - body.trace @ change[: at.displacement.size] - wave
