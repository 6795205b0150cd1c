"""The coupled equations of the differential deflection method on a uniform grid, and Newton's method on them.

Unknowns are the pressures P and films H at all N nodes, in the variables of `lubfric.ehl.problem`. The
deflection of piecewise linear pressures (hat functions of width ``step``) enters through its second difference,

    H[i-1] - 2 H[i] + H[i+1] = step² + sum_k W[k] P[i-k],      W[k] = -(4/pi) step δ⁴(k² ln|k| /2),

exact, with weights that fall like 1/k² where those of the deflection grow like ln k. What the second difference
cannot see, a constant and a slope, are the films at both ends: one follows from the full integral, the other from the load.
(H. P. Evans, T. G. Hughes, Proc. IMechE C 214 (2000) 563-584; T. G. Hughes, C. D. Elcoate, H. P. Evans, ibid.
585-598; C. D. Elcoate, H. P. Evans, T. G. Hughes, R. W. Snidle, Proc. IMechE J 215 (2001) 319-337.)

In each Newton step the weights with |k| <= bandwidth are implicit, one banded factorisation; those of larger k are put right
by GMRES on the banded solve (the authors lag them), so that the step is that of the full integral.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..report import CONVERGED, DIVERGED, ITERATION_LIMIT
from .newton import FILM_STEP, VISCOSITY_STEP
from .problem import Problem
from .reynolds import log_mean_fluidity

KRYLOV_LIMIT = 40        # GMRES vectors in one Newton step
FORCING = 1e-2           # share of the far deflection that a Newton step may leave to the next one


@dataclass(frozen=True)
class Mesh:
    """X: node positions (N,), uniform; log_kernel, weights: of the deflection and of its second difference, by
    distance in nodes (N,); bandwidth: largest distance that is implicit; flooded: whether the inlet is."""

    X: np.ndarray
    step: float
    log_kernel: np.ndarray
    weights: np.ndarray
    bandwidth: int
    flooded: bool

    @property
    def size(self) -> int:
        """Number of nodes."""
        return self.X.size


def make_mesh(first: float, last: float, nodes: int, bandwidth: int, flooded: bool) -> Mesh:
    """``nodes`` positions from ``first`` to ``last`` with the weights of the deflection."""
    X, step = np.linspace(first, last, nodes, retstep=True)
    k = np.arange(nodes + 2.0)
    g = 0.5 * k * k * np.log(np.maximum(k, 1.0))
    bend = g[np.abs(np.arange(-1, nodes))] - 2.0 * g[:-1] + g[1:]            # δ² g at 0 .. nodes
    kernel = -4.0 / math.pi * step * (bend + math.log(step))
    weights = -4.0 / math.pi * step * (bend[np.abs(np.arange(-1, nodes - 1))] - 2.0 * bend[:-1] + bend[1:])
    return Mesh(X, step, kernel[:-1], weights, min(bandwidth, nodes - 2), flooded)


def convolve(kernel: np.ndarray, P: np.ndarray) -> np.ndarray:
    """sum_j kernel[|i-j|] P[j] at all nodes, by FFT."""
    from scipy.fft import irfft, next_fast_len, rfft

    n = P.size
    size = next_fast_len(2 * n, real=True)
    wrapped = np.zeros(size)
    wrapped[:n] = kernel
    wrapped[size - n + 1:] = kernel[:0:-1]
    return irfft(rfft(wrapped) * rfft(P, size), size)[:n]
