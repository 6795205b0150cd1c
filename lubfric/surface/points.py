"""A list of points x y z as a map on a uniform grid; points that lie a little off it are interpolated."""

import numpy as np

from ..errors import InputError
from .prepare import harmonic_fill

# Choices, between the rounding of printed coordinates and the steps of a grid.
NEXT_LINE = 0.1  # of the largest gap between coordinates: a larger one leads to the next grid line
NEXT_LINE_JITTERED = 0.3  # the same where the points lie up to `JITTER` off their lines, and single lines are missing
FARTHEST_POINT = 1e9  # m
EVEN = 0.02  # of the step: a coordinate may be as far off its grid line and is taken to be on it (rounded in print)
JITTER = 0.15  # of the step: the most a coordinate may be off its grid line; between both, heights are interpolated
INTERPOLATION_ROUNDS = 30  # of the interpolation; the remainder falls by a factor of 3 or more each
LAST_REMAINDER = 1e-6  # of Sq: a remainder that ends it
LEAST_GIVEN_SHARE = 0.25  # of the grid points that must be given


def gridded(name: str, table: np.ndarray) -> tuple[np.ndarray, tuple[float, float], tuple[str, ...]]:
    """Return heights[ix, iy], NaN where no point is, in the unit of the third column, (dx, dy) [m], and notes.

    Points up to `JITTER` of the step off a uniform grid are interpolated: the heights on the grid are those whose cubic
    spline passes through all points. ``name``: of the file, for messages.
    """
    if not (np.abs(table[:, :2]) <= FARTHEST_POINT).all():
        raise InputError(
            f": x or y is NaN, infinite or beyond {FARTHEST_POINT:g} m", f"file {name}", "finite coordinates"
        )
    lines = [grid_lines(axis, table[:, column]) for column, axis in enumerate("xy")]
    (i, nx, dx, off_x), (j, ny, dy, off_y) = lines
    if nx * ny > len(table) / LEAST_GIVEN_SHARE:
        message = f": {len(table)} points on a grid of {nx} x {ny}"
        raise InputError(message, f"file {name}", "a uniform grid with most of its points")
    heights = np.full((nx, ny), np.nan)
    count = np.zeros((nx, ny), int)
    np.add.at(count, (i, j), 1)
    if count.max() > 1:
        message = f": {np.count_nonzero(count > 1)} grid points are given more than once"
        raise InputError(message, f"file {name}", recommendation="give each once")
    heights[i, j] = table[:, 2]
    off = float(max(np.abs(off_x).max(), np.abs(off_y).max()))
    notes: tuple[str, ...] = ()
    if off > EVEN:
        heights = _interpolated(heights, (i, j), (i + off_x, j + off_y), (dx, dy))
        notes = (f"points lie up to {100 * off:.2g} % of the spacing off a uniform grid: interpolated on it",)
    return heights, (dx, dy), notes


def grid_lines(name: str, coordinate: np.ndarray) -> tuple[np.ndarray, int, float, np.ndarray]:
    """Return (index of each point, number of lines, step, steps off its line) of one coordinate. Raise `InputError`
    where the lines are not uniform."""
    ordered = np.sort(coordinate)
    gaps = np.diff(ordered)
    if gaps.size == 0 or gaps.max() <= 0:
        raise InputError(f"{name} has one value only ({coordinate[0]:g}); allowed: a grid of at least 2 x 2 points")
    worst = np.inf
    for threshold in (NEXT_LINE, NEXT_LINE_JITTERED):
        starts = np.flatnonzero(np.concatenate([[True], gaps > threshold * gaps.max()]))
        lines = np.add.reduceat(ordered, starts) / np.diff(np.append(starts, ordered.size))
        if lines.size < 2:
            continue
        steps = np.diff(lines)
        number = np.concatenate([[0], np.cumsum(np.rint(steps / np.median(steps)))])  # whole lines may be missing
        step, origin = np.polyfit(number, lines, 1)
        position = (coordinate - origin) / step
        index = np.rint(position).astype(int)
        off = position - index
        worst = min(worst, float(np.abs(off).max()))
        if np.abs(off).max() <= JITTER and index.min() == 0:
            return index, int(index.max()) + 1, float(step), off
    message = f"spacing along {name} is not uniform: a point is {worst:.2g} steps off its grid line"
    raise InputError(message, allowed=f"at most {JITTER:g} of the step")


def _interpolated(
    heights: np.ndarray,
    index: tuple[np.ndarray, np.ndarray],
    position: tuple[np.ndarray, np.ndarray],
    spacing: tuple[float, float],
) -> np.ndarray:
    """Return the heights on the grid whose cubic spline has the given ones at the points: a fixed-point iteration, of
    which each round adds what the spline misses at each point to the grid point of that point."""
    from scipy.ndimage import map_coordinates

    measured = np.isfinite(heights)
    target = heights[index]
    there = np.isfinite(target)
    level = float(np.mean(target[there]))
    scale = float(np.std(target[there]))
    grid = np.where(measured, heights - level, 0.0)
    points = [part[there] for part in position]
    nodes = tuple(part[there] for part in index)
    for _ in range(INTERPOLATION_ROUNDS):
        full = grid if measured.all() else harmonic_fill(grid, measured, spacing)
        remainder = target[there] - level - map_coordinates(full, points, order=3, mode="mirror")
        grid[nodes] += remainder
        if np.sqrt(np.mean(remainder**2)) <= LAST_REMAINDER * scale:
            break
    else:
        raise InputError(
            f"heights of points off a uniform grid: interpolation misses them by {np.sqrt(np.mean(remainder**2)):.2g}",
            recommendation="resample the points on a uniform grid first",
        )
    return np.where(measured, grid + level, np.nan)
