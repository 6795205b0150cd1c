"""Free along one axis, periodic along the other: the kernel of a cylinder with a periodic roughness.

Fourier series along the periodic axis y (exact for what the grid resolves, as in the fully periodic
operator), exact cell integrals along the free axis x. Images of Love's cells would sum a slowly
decaying tail and average the pressure over cells along y as well; the Bessel form needs no images,
decays exponentially, and is exact along y.
"""

from __future__ import annotations

import numpy as np

from .line import line_coefficients

FAR = 42.0  # K0 beyond it is below 1e-19
NEAR_CELLS, LONG_CELL = 4, 6.0  # from there on few points do, unless k times the cell exceeds LONG_CELL
NEAR_RULE, FAR_RULE = np.polynomial.legendre.leggauss(24), np.polynomial.legendre.leggauss(7)


def semiperiodic_coefficients(shape, spacing, e_prime: float) -> np.ndarray:
    """Deflection [m/Pa] (nx, ny//2 + 1): cells away along the free axis x, wavenumber index along y.

    ``(4/(pi E')) ∫ K0(|k_y (x - x')|) dx'`` over a cell of width dx, and for k_y = 0 the line kernel
    with u = 0 at the distance nx dx, the length of the box, from a line load. That gauge makes the
    operator positive definite for pressures inside the box. spacing (dx, dy) [m], e_prime [Pa].
    """
    (nx, ny), (dx, dy) = shape, spacing
    kernel = np.zeros((nx, ny // 2 + 1))
    kernel[:, 0] = line_coefficients(nx, dx, e_prime, reference_length=nx * dx)
    step = 2 * np.pi * np.arange(1, ny // 2 + 1) / (ny * dy) * dx  # k_y dx
    counts = np.minimum(nx, (FAR / step).astype(int) + 2)
    columns = np.repeat(np.arange(step.size), counts)
    rows = np.arange(columns.size) - np.repeat(np.cumsum(counts) - counts, counts)
    kernel[rows, 1 + columns] = 4 / (np.pi * e_prime) * dx * bessel_cells(rows, step[columns])
    return kernel


def bessel_cells(cell: np.ndarray, k: np.ndarray) -> np.ndarray:
    """∫ K0(k|s|) ds over the unit cells around s = ``cell`` = 0, 1, ...; absolute error about 1e-15.

    The cell around zero, with the logarithm, from ∫_0^z K0; the others by Gauss-Legendre points,
    more of them close to the logarithm and where the exponential falls fast.
    """
    from scipy.special import iti0k0

    found = np.empty(cell.shape)
    zero = cell == 0
    found[zero] = 2 / k[zero] * iti0k0(k[zero] / 2)[1]
    near = ~zero & ((cell < NEAR_CELLS) | (k > LONG_CELL))
    far = ~zero & ~near
    found[near] = _gauss_cells(cell[near], k[near], NEAR_RULE)
    found[far] = _gauss_cells(cell[far], k[far], FAR_RULE)
    return found


def _gauss_cells(cell: np.ndarray, k: np.ndarray, rule) -> np.ndarray:
    from scipy.special import k0

    total = np.zeros(cell.shape)
    for node, weight in zip(*rule):
        total += 0.5 * weight * k0(k * (cell + 0.5 * node))
    return total
