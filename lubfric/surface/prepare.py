"""What is done to a measured map before it is used: form taken off, gaps filled, outliers found, waves filtered."""

import math
from collections.abc import Sequence

import numpy as np

from ..errors import InputError

_PLANE = ((0, 0), (1, 0), (0, 1))  # powers of x and y of a mean plane, by definition
# The powers of each form of the F-operation (ISO 25178-2); of several sets the one that leaves least.
FORM_POWERS = {
    "plane": (_PLANE,),
    "cylinder": ((*_PLANE, (2, 0)), (*_PLANE, (0, 2))),
    "quadratic": ((*_PLANE, (2, 0), (1, 1), (0, 2)),),
}
BETTER = (
    0.9  # ratio of the Sq that one form leaves to that of another, below which it is worth its terms. A convention.
)
MOST_MISSING = 0.5  # largest part of the points of a map that may be filled. A convention

# Residual of a fitted form on a map that has exactly this form, over the largest height [-]; chosen for rounding.
LEFT_BY_FORM = 1e-13

DEPENDENT = 1e-13  # least eigenvalue of the normal equations over the largest; chosen for rounding

# Robust deviations beyond which a point that stands alone is an outlier. A choice: 2 in 1e9 points of a Gaussian map.
OUTLIER_LIMIT = 6.0

WINDOW = 5  # points along each side of the window of which an outlier deviates; a choice: ridges of three points stay
CHUNK = 2**18  # points whose windows are held at once; a choice, for memory
GAUSSIAN = 1.4826  # standard deviation over median deviation; by definition of a normal distribution
ALPHA = math.sqrt(math.log(2) / math.pi)  # of a Gaussian filter, ISO 16610-61
FILTER_REACH = 6.0  # standard deviations of the weights of a filter that are summed; a choice: exp(-18) is left out


def fitted_form(
    heights: np.ndarray, mask: np.ndarray | None, spacing: tuple[float, float], form: str
) -> tuple[np.ndarray, tuple[float, float], tuple[float, float]]:
    """Fit a polynomial to the measured points by least squares. Returns it (nx, ny) [m], its slopes [-] and its
    curvatures [1/m] along x and y.

    "plane" is of first order, "quadratic" of second, with the mixed term; "cylinder" is a plane curved along x or along
    y, whichever leaves less. An axis of one point has no slope, one of two no curvature. Slopes are those at the middle
    of the map. If only rounding is left (`LEFT_BY_FORM` of the largest height), the form is the map itself. Raises
    `InputError` when the points do not determine the form.
    """
    valid = np.ones(heights.shape, bool) if mask is None else mask
    along = [((np.arange(n) - 0.5 * (n - 1)) / n)[:, None] ** np.arange(5) for n in heights.shape]
    z = np.where(valid, heights, 0.0)
    fits = []
    for powers in FORM_POWERS[form]:
        there = [(p, q) for p, q in powers if p < heights.shape[0] and q < heights.shape[1]]
        terms = _normal_solution(z, valid.astype(float), along, there)
        if terms is not None:
            fitted = _polynomial(terms, along)
            residual = np.where(valid, z - fitted, 0.0)
            fits.append((float(np.vdot(residual, residual)), float(np.abs(residual).max()), fitted, terms))
    if not fits:
        curve = "line" if form == "plane" else "line or conic"
        message = f"{np.count_nonzero(valid)} measured points lie on one {curve}"
        raise InputError(message, allowed=f"points that fix the {len(FORM_POWERS[form][0])} terms of the form {form!r}")
    _, most, fitted, terms = min(fits, key=lambda fit: fit[0])
    if most <= LEFT_BY_FORM * np.abs(z).max():
        fitted = np.where(valid, heights, fitted)
    length = [n * step for n, step in zip(heights.shape, spacing)]
    slopes = terms.get((1, 0), 0.0) / length[0], terms.get((0, 1), 0.0) / length[1]
    curvatures = 2 * terms.get((2, 0), 0.0) / length[0] ** 2, 2 * terms.get((0, 2), 0.0) / length[1] ** 2
    return fitted, slopes, curvatures


def advised_form(left: dict[str, float]) -> str:
    """Return the form of the fewest terms that leaves about as little Sq as any with more. ``left``: Sq [m] that each
    form leaves (`Surface.left_by`)."""
    forms = [form for form in FORM_POWERS if form in left]
    return next(form for form in forms if BETTER * left[form] <= min(left[f] for f in forms[forms.index(form) :]))


def _normal_solution(
    z: np.ndarray, weight: np.ndarray, along: list[np.ndarray], powers: Sequence[tuple[int, int]]
) -> dict[tuple[int, int], float] | None:
    """Return {powers: coefficient} of the weighted least squares, or None if they have no unique solution.

    The normal equations are used, because their sums need no array but ``z`` itself. They are solved twice, the second
    time for the remainder of the first solution.
    """
    moments = along[0].T @ weight @ along[1]
    matrix = np.array([[moments[p + r, q + s] for r, s in powers] for p, q in powers])
    values = np.linalg.eigvalsh(matrix)
    if values[0] <= DEPENDENT * values[-1]:
        return None
    coefficients = np.zeros(len(powers))
    residual = z
    for _ in range(2):
        right = along[0].T @ residual @ along[1]
        coefficients = coefficients + np.linalg.solve(matrix, np.array([right[p, q] for p, q in powers]))
        residual = np.where(weight > 0, z - _polynomial(dict(zip(powers, coefficients)), along), 0.0)
    return dict(zip(powers, coefficients.tolist()))


def _polynomial(terms: dict[tuple[int, int], float], along: list[np.ndarray]) -> np.ndarray:
    """Return the polynomial of the coefficients ``terms`` of the powers ``along`` x and y, (nx, ny)."""
    matrix = np.zeros((along[0].shape[1], along[1].shape[1]))
    for powers, coefficient in terms.items():
        matrix[powers] = coefficient
    return along[0] @ matrix @ along[1].T


def harmonic_fill(heights: np.ndarray, mask: np.ndarray, spacing: tuple[float, float]) -> np.ndarray:
    """Solve Laplace's equation (five points, no flux through the rim) at the points without a mask."""
    from scipy.sparse import csc_matrix
    from scipy.sparse.linalg import spsolve

    missing = ~mask
    if not missing.any():
        return heights
    fraction = np.count_nonzero(missing) / mask.size
    if fraction > MOST_MISSING:
        raise InputError(f" = {fraction:.3g} is out of range", "missing fraction", f"0 to {MOST_MISSING}")
    number = np.arange(mask.size).reshape(mask.shape)
    gone = missing.ravel()
    ends = [(number[:-1].ravel(), number[1:].ravel()), (number[:, :-1].ravel(), number[:, 1:].ravel())]
    pairs = [np.array(pair)[:, gone[pair[0]] | gone[pair[1]]] for pair in ends]  # neighbours that a gap touches
    steep = np.concatenate([np.full(pair.shape[1], 1 / step) for pair, step in zip(pairs, spacing)])
    row = np.tile(np.arange(steep.size), 2)
    entries = np.concatenate([-steep, steep]), (row, np.hstack(pairs).ravel())
    slopes = csc_matrix(entries, shape=(steep.size, mask.size))
    # the sum of their squares is least
    filled = heights.copy()
    unknown = slopes[:, gone]
    filled[missing] = spsolve((unknown.T @ unknown).tocsc(), -unknown.T @ (slopes[:, ~gone] @ heights[mask]))
    return filled


def outliers(heights: np.ndarray, mask: np.ndarray | None, periodic: tuple[bool, bool]) -> np.ndarray:
    """Return the deviations (nx, ny) by which each outlier of a filled, levelled map differs from its neighbours,
    negative below them; 0 elsewhere. Outliers of a measured map are points that are isolated, far from all their
    neighbours.

    The rule: a measured point is an outlier when it lies more than ``OUTLIER_LIMIT`` robust standard deviations both
    from the median of the complete map and from the median of the ``WINDOW`` x ``WINDOW`` points around it, on the same
    side. The robust deviation is 1.4826 times the median of |z - median(z)|. For a Gaussian map that is the standard
    deviation, and the outliers themselves change it little. Where it is zero (most of the map has one height) Sq is
    taken.

    `Surface.without_outliers` fills the outliers and searches the map again, until there are none. Ridges and grooves
    at least three points wide stay, however high. So do summits that are wide against the window. Dust, noise next to
    unmeasured points and the flares of optical instruments at steep edges go.

    heights : (nx, ny) [m], finite; unmeasured points (False in ``mask``) are in the windows as they are: fill them
        first.
    """
    measured = heights if mask is None else heights[mask]
    middle = float(np.median(measured))
    deviation = GAUSSIAN * float(np.median(np.abs(measured - middle))) or float(measured.std())
    deviations = np.zeros(heights.shape)
    if deviation == 0:
        return deviations
    far = np.abs(heights - middle) > OUTLIER_LIMIT * deviation
    where = np.nonzero(far if mask is None else far & mask)
    parts = [tuple(indices[i : i + CHUNK] for indices in where) for i in range(0, where[0].size, CHUNK)]
    padded = heights
    for axis, is_periodic in enumerate(periodic):  # wrapped where periodic, mirrored at open ends
        width = [(WINDOW // 2, WINDOW // 2) if axis == other else (0, 0) for other in range(2)]
        padded = np.pad(padded, width, mode="wrap" if is_periodic else "symmetric")
    windows = np.lib.stride_tricks.sliding_window_view(padded, (WINDOW, WINDOW))
    around = [np.median(windows[part], axis=(1, 2)) for part in parts]
    off = (heights[where] - np.concatenate([np.empty(0), *around])) / deviation
    same_side = np.sign(off) == np.sign(heights[where] - middle)
    deviations[where] = np.where((np.abs(off) > OUTLIER_LIMIT) & same_side, off, 0.0)
    return deviations


def gaussian_mean(
    heights: np.ndarray,
    mask: np.ndarray | None,
    spacing: tuple[float, float],
    periodic: tuple[bool, bool],
    index: float,
) -> np.ndarray:
    """Return the waviness (nx, ny) [m]: the weighted mean around each point, of the measured points (True in ``mask``)
    only.

    The areal Gaussian filter of ISO 16610-61: the weights are exp(-pi (r/(a L))^2) with a = sqrt(ln 2/pi), so that a
    wave as long as the nesting index L keeps half of its height. The filter is isotropic, so it works on one axis
    after the other. At open ends and next to unmeasured points the remaining weights are scaled to sum to one
    (regression of order zero). A periodic axis wraps around.

    ``index`` [m]: nesting index (cutoff). A point that has no measured one in reach keeps its height.
    """
    from scipy.ndimage import gaussian_filter1d

    weight = np.ones(heights.shape) if mask is None else mask.astype(float)
    total = np.where(weight > 0, heights, 0.0)
    for axis in range(2):
        deviation = ALPHA * index / spacing[axis] / math.sqrt(2 * math.pi)
        along = {"axis": axis, "mode": "wrap" if periodic[axis] else "constant", "truncate": FILTER_REACH}
        total, weight = (gaussian_filter1d(a, deviation, **along) for a in (total, weight))
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(weight > np.finfo(float).tiny, total / weight, heights)
