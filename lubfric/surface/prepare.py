"""Levelling, filling, closing and resampling of height maps: plain functions on arrays."""

from __future__ import annotations

import numpy as np

from .._base import validate
from ..errors import InputError

FORMS = ("plane", "quadratic")
EDGES = ("mirror", "window")
BLEND = 0.1  # share of a map's length that the window blends
MOST_MISSING = 0.5
FLAT = 1e-13  # of the largest height: what a fitted form leaves of a map that has it exactly
DEPENDENT = 1e-13  # least eigenvalue of the normal equations, of the largest


def pair(name, value) -> tuple[int, int]:
    """Two whole numbers >= 1."""
    if np.ndim(value) != 1 or len(value) != 2:
        raise InputError(f"{name} = {value!r} must be a pair (nx, ny) of whole numbers >= 1")
    nx, ny = (validate.integer(f"{name}[{i}]", n, minimum=1) for i, n in enumerate(value))
    return nx, ny


def fitted_form(heights, mask, spacing, form) -> tuple[np.ndarray, tuple[float, float], tuple[float, float]]:
    """Fit a polynomial to the measured points by least squares. Returns it (nx, ny) [m], its slopes [-] and its
    curvatures [1/m] along x and y.

    "plane" is of first order, "quadratic" of second, with the mixed term. An axis of one point has no slope, one of two
    no curvature. Slopes are those at the middle of the map. If only rounding is left (`FLAT` of the largest height),
    the form is the map itself. Raises `InputError` when the points do not determine the form.
    """
    order = 1 + FORMS.index(form)
    valid = np.ones(heights.shape, bool) if mask is None else mask
    powers = [
        (p, q) for p in range(order + 1) for q in range(order + 1 - p) if p < heights.shape[0] and q < heights.shape[1]
    ]
    along = [
        ((np.arange(n) - 0.5 * (n - 1)) / n)[:, None] ** np.arange(2 * order + 1) for n in heights.shape
    ]  # columns: powers of the place
    z = np.where(valid, heights, 0.0)
    terms = _normal_solution(z, valid.astype(float), along, powers)
    if terms is None:
        curve = "line" if order == 1 else "line or conic"
        raise InputError(
            f"{np.count_nonzero(valid)} measured points lie on one {curve}; allowed: points that fix the "
            f"{len(powers)} terms of the form {form!r}"
        )
    fitted = _polynomial(terms, along)
    if np.abs(z - fitted, where=valid, out=np.zeros(z.shape)).max() <= FLAT * np.abs(z).max():
        fitted = np.where(valid, heights, fitted)
    length = [n * step for n, step in zip(heights.shape, spacing)]
    slopes = terms.get((1, 0), 0.0) / length[0], terms.get((0, 1), 0.0) / length[1]
    curvatures = 2 * terms.get((2, 0), 0.0) / length[0] ** 2, 2 * terms.get((0, 2), 0.0) / length[1] ** 2
    return fitted, slopes, curvatures


def _normal_solution(z, weight, along, powers) -> dict[tuple[int, int], float] | None:
    """{powers: coefficient} of the weighted least squares, or None if they have no unique solution.

    The normal equations are used, because their sums need no array but ``z`` itself. They are solved twice, the second
    time for the remainder of the first solution.
    """
    moments = along[0].T @ weight @ along[1]
    matrix = np.array([[moments[p + r, q + s] for r, s in powers] for p, q in powers])
    values = np.linalg.eigvalsh(matrix)
    if values[0] <= DEPENDENT * values[-1]:
        return None
    found, rest = np.zeros(len(powers)), z
    for _ in range(2):
        right = along[0].T @ rest @ along[1]
        found = found + np.linalg.solve(matrix, np.array([right[p, q] for p, q in powers]))
        rest = np.where(weight > 0, z - _polynomial(dict(zip(powers, found)), along), 0.0)
    return dict(zip(powers, found.tolist()))


def _polynomial(terms, along) -> np.ndarray:
    """The polynomial of the coefficients ``terms`` of the powers ``along`` x and y, (nx, ny)."""
    matrix = np.zeros((along[0].shape[1], along[1].shape[1]))
    for powers, coefficient in terms.items():
        matrix[powers] = coefficient
    return along[0] @ matrix @ along[1].T


def harmonic_fill(heights, mask, spacing) -> np.ndarray:
    """Solve Laplace's equation (five points, no flux through the rim) at the points without a mask."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.linalg import spsolve

    missing = ~mask
    if not missing.any():
        return heights
    if np.count_nonzero(missing) > MOST_MISSING * mask.size:
        raise InputError(
            f"missing fraction = {np.count_nonzero(missing) / mask.size:.3g} is out of range; "
            f"allowed: [0, {MOST_MISSING}] (-)"
        )
    number = np.cumsum(missing.ravel()).reshape(mask.shape) - 1
    count = int(np.count_nonzero(missing))
    diagonal, right, rows, columns, entries = np.zeros(count), np.zeros(count), [], [], []
    for axis in range(2):
        weight = 1 / spacing[axis] ** 2
        for here, there in _neighbours(axis):
            from_missing = missing[here]
            row, other = number[here][from_missing], missing[there][from_missing]
            np.add.at(diagonal, row, weight)
            np.add.at(right, row[~other], weight * heights[there][from_missing][~other])
            rows.append(row[other])
            columns.append(number[there][from_missing][other])
            entries.append(np.full(np.count_nonzero(other), -weight))
    index = np.arange(count)
    where = np.concatenate([index, *rows]), np.concatenate([index, *columns])
    matrix = coo_matrix((np.concatenate([diagonal, *entries]), where), shape=(count, count))
    filled = heights.copy()
    filled[missing] = spsolve(matrix.tocsc(), right)
    return filled


def _neighbours(axis):
    """Slices of each point that has a neighbour before or after it along ``axis``, and of that neighbour."""
    first, last = [slice(None)] * 2, [slice(None)] * 2
    first[axis], last[axis] = slice(None, -1), slice(1, None)
    return (tuple(first), tuple(last)), (tuple(last), tuple(first))


def points_to_close(count: int, edge: str) -> int:
    """How many points of an open map make ``count`` points of a closed one."""
    return (count + 1) // 2 if edge == "mirror" else count + _blend_width(count)


def _blend_width(count: int) -> int:
    return max(1, round(BLEND * count / (1 - BLEND)))


def close_axis(heights, axis, edge, count=None) -> np.ndarray:
    """Make an open array periodic along ``axis``; ``count`` points come out (default: see below).

    "mirror": n points followed by their mirror image, 2 n points (2 n - 1 when ``count`` is odd).
    "window": the last w points are laid over the first w with weights cos and sin of an angle
    rising from 0 to pi/2 (their squares add to 1), n - w points with w one tenth of n.
    """
    z = np.moveaxis(heights, axis, 0)
    if edge == "mirror":
        closed = np.concatenate([z, z[::-1]])
        closed = closed if count is None else closed[:count]
    else:
        width = max(1, round(BLEND * len(z))) if count is None else len(z) - count
        if 2 * width > len(z):
            raise InputError(f"{len(z)} points along axis {axis} are too few to blend; allowed: at least 2")
        angle = (0.5 * np.pi / width * np.arange(width))[:, None]
        mean, closed = z.mean(), z[:-width].copy()
        closed[:width] = mean + np.sin(angle) * (z[:width] - mean) + np.cos(angle) * (z[-width:] - mean)
    return np.moveaxis(closed, 0, axis)


def close_mask(mask, axis, edge, count=None) -> np.ndarray:
    """The measured points of a closed map. A blended point counts where both of its heights were measured."""
    m = np.moveaxis(mask, axis, 0)
    if edge == "mirror":
        closed = np.concatenate([m, m[::-1]])[:count]
    else:
        width = max(1, round(BLEND * len(m))) if count is None else len(m) - count
        closed = m[:-width].copy()
        closed[:width] &= m[-width:]
    return np.moveaxis(closed, 0, axis)


def resample_axis(heights, axis, count, ratio, periodic) -> np.ndarray:
    """``count`` cells of ``ratio`` old cells each along ``axis``, from the start of the map.

    Periodic: the Fourier series at the new cell centres. Open: heights are taken as cell averages;
    a cubic spline through their running integral gives the averages over the new cells, coarser or
    finer. It conserves the integral and changes nothing at ratio 1.
    """
    z = np.moveaxis(heights, axis, 0)
    if periodic:
        new = _fourier(z, count)
    else:
        from scipy.interpolate import CubicSpline

        integral = np.concatenate([np.zeros((1, z.shape[1])), np.cumsum(z, axis=0)])
        edges = np.minimum(ratio * np.arange(count + 1), len(z))
        new = np.diff(CubicSpline(np.arange(len(z) + 1), integral)(edges), axis=0) / ratio
    return np.moveaxis(new, 0, axis)


def _fourier(z, count) -> np.ndarray:
    """Fourier series of n cell centres evaluated at ``count`` cell centres of the same period."""
    from scipy import fft

    n, keep = len(z), min(len(z), count) // 2 + 1
    spectrum = np.zeros((count // 2 + 1, z.shape[1]), complex)
    spectrum[:keep] = fft.rfft(z, axis=0)[:keep]
    shift = 0.5 * (n / count - 1) / n  # from old to new cell centres, in periods
    spectrum *= np.exp(2j * np.pi * shift * np.arange(len(spectrum)))[:, None]
    even = min(n, count)
    if even % 2 == 0 and n != count:  # the highest mode is shared by +k and -k
        spectrum[even // 2] *= 2.0 if count < n else 0.5
    return fft.irfft(spectrum, count, axis=0) * (count / n)
