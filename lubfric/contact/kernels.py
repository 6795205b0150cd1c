"""Deflection of a half-space by cells of uniform pressure, exact: both axes free, a line, one axis periodic."""

import numpy as np

# Argument of K0 [-] beyond which it is below 1e-19. Chosen, as the next two, for the rounding error of double
# precision.
VANISHING_ARGUMENT = 42.0
# Step of the trapezoidal rule for the tail of ∫ K0: its error is below 1e-16. Chosen for rounding.
TAIL_STEP = 0.26
# Points of that rule: the next one adds less than 1e-16. Chosen for rounding.
TAIL_POINTS = 18


def love_coefficients(shape: tuple[int, int], spacing: tuple[float, float], e_prime: float) -> np.ndarray:
    """Return the deflection [m/Pa] at cell centres (i, j) cells away from a cell under 1 Pa; (i, j) < ``shape``.

    ``2/(pi E') ∬ dx' dy'/r`` over the cell, exact. With F(X, Y) = X ln(Y + r) + Y ln(X + r) it is the
    second difference of F over the corners (A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377-420,
    doi:10.1098/rsta.1929.0009). Deflection vanishes far away. spacing (dx, dy) [m], e_prime [Pa].
    """
    x = (np.arange(shape[0] + 1) - 0.5) * spacing[0]
    y = (np.arange(shape[1] + 1) - 0.5) * spacing[1]
    corner = x[:, None] * np.arcsinh(y[None, :] / np.abs(x)[:, None])
    corner += y[None, :] * np.arcsinh(x[:, None] / np.abs(y)[None, :])
    return 2 / (np.pi * e_prime) * np.diff(np.diff(corner, axis=0), axis=1)


def line_coefficients(count: int, spacing: float, e_prime: float, reference_length: float) -> np.ndarray:
    """Return the deflection [m/Pa] at ``count`` cell centres, 0, 1, ... cells away from a cell under 1 Pa.

    ``-(4/(pi E')) ∫ ln(|x - x'|/reference_length) dx'`` over the cell, exact; spacing [m], e_prime
    [Pa]. The half-space is unbounded, so u is known up to a constant: here u of a line load is zero
    at the distance ``reference_length`` [m]. Source: paper, Eq. (6).
    """
    edge = np.arange(count) + 0.5
    antiderivative = edge * (np.log(edge * (spacing / reference_length)) - 1)
    cells = np.diff(antiderivative, prepend=-antiderivative[0])
    return -4 / (np.pi * e_prime) * spacing * cells


def semiperiodic_coefficients(shape: tuple[int, int], spacing: tuple[float, float], e_prime: float) -> np.ndarray:
    """Return the deflection [m/Pa] (nx, ny//2 + 1): cells away along the free axis x, wavenumber index along y.

    ``(4/(pi E')) ∫ K0(|k_y (x - x')|) dx'`` over a cell of width dx, and for k_y = 0 the line kernel
    with u = 0 at the distance nx dx, the length of the box, from a line load. That gauge makes the
    operator positive definite for pressures inside the box. spacing (dx, dy) [m], e_prime [Pa].

    A Fourier series along the periodic axis y (exact for what the grid resolves, as in the fully periodic operator),
    exact cell integrals along the free axis x. Images of Love's cells would sum a slowly decaying tail and average the
    pressure over cells along y as well; the Bessel form needs no images, decays exponentially, and is exact along y.
    """
    (nx, ny) = shape
    (dx, dy) = spacing
    kernel = np.zeros((nx, ny // 2 + 1))
    kernel[:, 0] = line_coefficients(nx, dx, e_prime, reference_length=nx * dx)
    step = 2 * np.pi * np.arange(1, ny // 2 + 1) / (ny * dy) * dx  # k_y dx
    counts = np.minimum(nx, (VANISHING_ARGUMENT / step).astype(int) + 2)
    columns = np.repeat(np.arange(step.size), counts)
    rows = np.arange(columns.size) - np.repeat(np.cumsum(counts) - counts, counts)
    kernel[rows, 1 + columns] = 4 / (np.pi * e_prime) * dx * bessel_cells(rows, step[columns])
    return kernel


def bessel_cells(cell: np.ndarray, k: np.ndarray) -> np.ndarray:
    """Return ∫ K0(k|s|) ds over the unit cells around s = ``cell``, which counts 0, 1, ... for one ``k`` after the
    other; absolute error about 1e-16 times the number of the cell."""
    integrals = _integral(k * (cell + 0.5))
    integrals[1:] -= np.where(cell[1:] > 0, integrals[:-1], 0.0)
    return np.where(cell > 0, integrals, 2 * integrals) / k


def _integral(z: np.ndarray) -> np.ndarray:
    """Return ∫_0^z K0, z >= 0: up to 1 by its series, beyond it pi/2 less the tail ∫ exp(-z cosh t)/cosh t dt, t > 0,
    by the trapezoidal rule, which converges exponentially."""
    from scipy.special import iti0k0

    integral = np.empty(z.shape)
    short = z <= 1
    integral[short] = iti0k0(z[short])[1]
    far = z[~short]
    tail = 0.5 * TAIL_STEP * np.exp(-far)
    for growth in np.cosh(TAIL_STEP * np.arange(1, TAIL_POINTS)):
        tail += TAIL_STEP / growth * np.exp(-growth * far)
    integral[~short] = 0.5 * np.pi - tail
    return integral
