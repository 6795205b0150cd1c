"""Is this pressure a contact? Deflection, complementarity, load and gap are written anew, in double precision."""

import math

import numpy as np
from scipy import fft

import lubfric.contact
from lubfric.contact import ContactResult

from ...types import FloatArray


def deflection(
    pressure: np.ndarray, spacing: tuple[float, float], e_prime: float, boundary: tuple[str, str]
) -> np.ndarray:
    """Return u = K p [m].

    Where the contact is periodic it comes from the full complex transform, where it is free from sums of Love's cells
    over all pairs. Where it is mixed it comes from the library's operator, which its own tests hold against quadrature
    and image sums.
    """
    if boundary == ("periodic", "periodic"):
        kx, ky = (2 * np.pi * fft.fftfreq(n, d) for n, d in zip(pressure.shape, spacing))
        k = np.hypot(kx[:, None], ky[None, :])
        k[0, 0] = np.inf
        return fft.ifft2(fft.fft2(pressure) * 4 / (e_prime * k)).real
    if boundary == ("free", "free"):
        return _love_sum(pressure, spacing, e_prime)
    return lubfric.contact.half_space(pressure.shape, spacing, e_prime, boundary).apply(pressure)


def _love_sum(pressure: FloatArray, spacing: tuple[float, float], e_prime: float) -> np.ndarray:
    """Return Love's solution, summed row by row without a transform."""
    nx, ny = pressure.shape
    i = np.arange(1 - nx, nx)
    j = np.arange(1 - ny, ny)
    left, right = ((i - s / 2)[:, None] * spacing[0] for s in (1, -1))
    low, high = ((j - s / 2)[None, :] * spacing[1] for s in (1, -1))

    def corner(x: FloatArray, y: FloatArray) -> FloatArray:
        r = np.hypot(x, y)
        return x * np.log(y + r) + y * np.log(x + r)

    kernel = (
        2 / (math.pi * e_prime) * (corner(right, high) - corner(left, high) - corner(right, low) + corner(left, low))
    )
    table = kernel[(np.arange(nx)[:, None] - np.arange(nx)) + nx - 1]  # (nx, nx, 2 ny - 1)
    u = np.zeros_like(pressure)
    for column in range(ny):
        u += np.einsum("abj,b->aj", table[:, :, ny - 1 - column : 2 * ny - 1 - column], pressure[:, column])
    return u


def contact_deviations(
    result: ContactResult,
    gap0: FloatArray,
    spacing: float | tuple[float, float],
    e_prime: float,
    boundary: tuple[str, str],
    hardness: float | None = None,
    mean_pressure: float | None = None,
    mean_gap: float | None = None,
) -> dict[str, float]:
    """Return deviations of a `ContactResult`, without dimension.

    Lengths are measured by sum(p u')/sum(p), with u' = u less its least value under the contact, plus the mean gap.
    That is what is indented, and what is left open.

    - complementarity: load-weighted |gap| (only openings where yielded)
    - penetration: deepest overlap of cells that have not yielded
    - sign: tension, or excess over the hardness
    - fields: gap against gap0 - approach + K p
    - load or volume: against what was prescribed
    """
    p = result.pressure
    limit = math.inf if hardness is None else hardness
    dx, dy = (spacing, spacing) if isinstance(spacing, (int, float)) else spacing
    u = deflection(p, (dx, dy), e_prime, boundary)
    gap = gap0 + u
    gap = gap - result.approach
    total = p.sum()
    touching = p > 0
    yielded = p >= limit
    if mean_pressure == 0 or not touching.any():
        carried = 0.0 if mean_pressure in (None, 0) else 1.0
        return {"load": carried, "penetration": max(0.0, -gap.min()) / max(float(gap0.std()), 1e-300)}
    length = (p * (u - u[touching].min())).sum() / total + np.maximum(gap, 0).mean()
    length = max(length, 4 * p.mean() * min(dx, dy) / e_prime)
    misfit = np.where(yielded, np.maximum(gap, 0), np.abs(gap))
    results = {
        "complementarity": float((p * misfit).sum() / total / length),
        "penetration": float(max(0.0, -(np.where(yielded, 0, gap)).min()) / length),
        "sign": float(max(-p.min(), p.max() - limit if hardness else 0.0) / p.max()),
        "fields": float(np.abs(gap - result.gap).max() / (length + np.abs(gap0).max() * 1e-6)),
    }
    if mean_pressure is not None:
        results["load"] = abs(p.mean() / mean_pressure - 1)
    if mean_gap is not None:
        results["volume"] = abs(np.maximum(gap, 0).mean() / mean_gap - 1)
    return results
