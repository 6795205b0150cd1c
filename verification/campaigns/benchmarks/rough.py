"""Seeded rough surfaces of the benchmarks of the dry contact."""

from __future__ import annotations

import numpy as np

E_PRIME = 231e9  # Pa


def surface(
    kind: str, shape: tuple[int, int], spacing: float, length: float, sigma: float, seed: int = 0
) -> np.ndarray:
    """Return periodic Gaussian heights [m]: exponential or Gaussian autocorrelation, or self-affine with H = 0.8."""
    kx, ky = (2 * np.pi * np.fft.fftfreq(n, spacing) for n in shape)
    k = np.hypot(kx[:, None], ky[: shape[1] // 2 + 1])
    power = {
        "exponential": (1 + (k * length) ** 2) ** -1.5,
        "gaussian": np.exp(-((k * length) ** 2) / 4),
        "self-affine": np.maximum(k * length, 2 * np.pi) ** -3.6,
    }[kind]
    white = np.random.default_rng(seed).standard_normal(shape)
    z = np.fft.irfft2(np.sqrt(power) * np.fft.rfft2(white), s=shape)
    z -= z.mean()
    return z * (sigma / z.std())
