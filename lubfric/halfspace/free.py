"""Free in both axes: deflection of a half-space by uniform rectangular cells of pressure."""

from __future__ import annotations

import numpy as np


def love_coefficients(shape, spacing, e_prime: float) -> np.ndarray:
    """Deflection [m/Pa] at cell centres (i, j) cells away from a cell under 1 Pa; (i, j) < ``shape``.

    ``2/(pi E') ∬ dx' dy'/r`` over the cell, exact. With F(X, Y) = X ln(Y + r) + Y ln(X + r) it is the
    second difference of F over the corners (A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377-420,
    doi:10.1098/rsta.1929.0009). Deflection vanishes far away. spacing (dx, dy) [m], e_prime [Pa].
    """
    x = (np.arange(shape[0] + 1) - 0.5) * spacing[0]
    y = (np.arange(shape[1] + 1) - 0.5) * spacing[1]
    corner = x[:, None] * np.arcsinh(y[None, :] / np.abs(x)[:, None])
    corner += y[None, :] * np.arcsinh(x[:, None] / np.abs(y)[None, :])
    return 2 / (np.pi * e_prime) * np.diff(np.diff(corner, axis=0), axis=1)
