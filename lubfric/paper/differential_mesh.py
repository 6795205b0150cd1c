"""Uniform grid and convolutions of the differential-deflection method.

The pressures are piecewise linear (hat functions of width ``step``). In the variables of `lubfric.film.problem` their
film is H00 + X²/2 + sum_k log_kernel[k] P[i-k], and its second difference is

    H[i-1] - 2 H[i] + H[i+1] = step² + sum_k weights[k] P[i-k],  weights[k] = -(4/pi) step δ⁴(k² ln|k|/2),

without any error of discretisation. The weights fall like 1/k², while those of the deflection grow like ln k.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

NEAR = 20


@dataclass(frozen=True)
class Mesh:
    """A uniform grid with its kernels.

    Attributes
    ----------
    X : (N,) positions of the nodes
    log_kernel, weights : (N,) of the film and of its second difference, by distance in nodes
    bandwidth : largest distance in nodes that counts as near
    log_transform, far_transform : Fourier transforms of log_kernel, and of the weights beyond the bandwidth
    flooded : whether the pressure goes on upstream of the first node
    """

    X: np.ndarray
    step: float
    log_kernel: np.ndarray
    weights: np.ndarray
    bandwidth: int
    log_transform: np.ndarray
    far_transform: np.ndarray
    flooded: bool

    @property
    def size(self) -> int:
        """Number of nodes."""
        return self.X.size


def make_mesh(first: float, last: float, nodes: int, bandwidth: int, flooded: bool) -> Mesh:
    """``nodes`` positions from ``first`` to ``last`` with the kernels between them."""
    X, step = np.linspace(first, last, nodes, retstep=True)
    second = _second_difference(nodes + 1)
    log_kernel = -4.0 / math.pi * step * (second[:-1] + math.log(step) - 1.5)
    weights = -4.0 / math.pi * step * np.diff(np.append(second[1], second), 2)
    far = weights.copy()
    far[: bandwidth + 1] = 0.0
    return Mesh(
        X, step, log_kernel, weights, min(bandwidth, nodes - 1), _transform(log_kernel), _transform(far), flooded
    )


def convolve(transform: np.ndarray, P: np.ndarray) -> np.ndarray:
    """sum_j kernel[|i-j|] P[j] at all nodes."""
    from scipy.fft import irfft, rfft

    size = _padded(P.size)
    return irfft(transform * rfft(P, size), size)[: P.size]


def _second_difference(n: int) -> np.ndarray:
    """The second difference of g = k² ln|k|/2 at k = 0 .. n - 1.

    From k = NEAR on it is Taylor's series with g'' = ln k + 3/2, because the differences lose their digits there.
    """
    k = np.arange(-1.0, NEAR + 1)
    g = 0.5 * k * k * np.log(np.maximum(np.abs(k), 1.0))
    x = 1.0 / np.arange(NEAR, max(n, NEAR + 1)) ** 2.0
    series = -0.5 * np.log(x) + 1.5 - x * (1 / 12 + x * (1 / 60 + x / 168))
    return np.append(np.diff(g, 2), series)[:n]


def _padded(n: int) -> int:
    from scipy.fft import next_fast_len

    return next_fast_len(2 * n, real=True)


def _transform(kernel: np.ndarray) -> np.ndarray:
    from scipy.fft import rfft

    wrapped = np.zeros(_padded(kernel.size))
    wrapped[: kernel.size] = kernel
    wrapped[-kernel.size + 1 :] = kernel[:0:-1]
    return rfft(wrapped)
