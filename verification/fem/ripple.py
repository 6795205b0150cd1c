"""Waves of infinitesimal height at rest under a moving smooth body: how far the film of `ehl` follows them.

The film is H = H0 + X²/2 - u_z - z. To first order in z the changes of displacement, pressure and approach solve the
tangent of the whole system (`ehl_newton`) at the smooth solution, with ``-by_H z`` for its right side. The rupture
point stays, as pressure and its slope vanish there.
"""

from dataclasses import dataclass

import numpy as np

from .ehl import Solution
from .ehl_film import assemble
from .ehl_newton import load_weights, solve, tangent


@dataclass(frozen=True)
class Ripple:
    """Film [m/m] and pressure [Pa/m] of a wave exp(i k x) over its height, complex, at the dofs of the line."""

    film: np.ndarray
    pressure: np.ndarray


def ripple(at: Solution, wavelength: float) -> Ripple:
    """The response of the smooth solution to a wave of ``wavelength`` [m] across the motion."""
    body, contact = at.body, at.contact
    wave = np.exp(2j * np.pi * body.x * contact.half_width / wavelength)
    flow, weights = assemble(at.film, at.P, at.H), load_weights(body)
    free = np.flatnonzero(at.P > 0)
    by_H = flow.by_H[free]
    matrix = tangent(body, flow.by_P[free][:, free], by_H, free, weights)
    right = np.concatenate([np.zeros(at.displacement.size), by_H @ wave, [0.0]])
    change = solve(matrix, np.stack([right.real, right.imag], axis=1), body.order) @ np.array([1.0, 1j])
    u, p, approach = change[: at.displacement.size], change[at.displacement.size : -1], change[-1]
    pressure = np.zeros(at.P.size, dtype=complex)
    pressure[free] = p
    return Ripple(approach - body.trace @ u - wave, pressure * contact.hertz_pressure / contact.film_unit)
