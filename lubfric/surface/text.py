"""Height maps as text: a matrix of heights, or a list of points x y z."""

from __future__ import annotations

import re

import numpy as np

from .._base import validate
from ..errors import InputError
from .table import read_table

NEXT_LINE = 0.1  # of the largest gap between coordinates: a larger one leads to the next grid line
FARTHEST = 1e15  # in the unit of the file
UNEVEN = 0.02  # of the spacing: the most a coordinate may be off its grid line


def _lines(path) -> tuple[list[str], list[tuple[int, str]]]:
    """(comment lines, data lines with their number in the file) of a UTF-8 text file."""
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except UnicodeDecodeError:
        raise InputError(f"path = {str(path)!r} is not text (UTF-8)") from None
    except OSError as problem:
        raise InputError(f"path = {str(path)!r} cannot be read ({problem})") from None
    text = [(number, line.strip()) for number, line in enumerate(lines, 1) if line.strip()]
    return [line for _, line in text if line[0] == "#"], [pair for pair in text if pair[1][0] != "#"]


def read_matrix(path, decimal=None, unit=None) -> tuple[np.ndarray, tuple[float, float] | None, tuple[str, ...]]:
    """heights[ix, iy] with one x per line, the spacing [m] of a ``# spacing = dx dy`` line, notes."""
    comments, lines = _lines(path)
    spacing = None
    for line in comments:
        if not re.match(r"#\s*spacing\s*[=:]", line):
            continue
        found = re.fullmatch(r"#\s*spacing\s*[=:]\s*(\S+)(?:[\s,;]+(\S+))?(?:\s+m)?\s*", line)
        words = [] if found is None else [word for word in found.groups() if word not in (None, "m")]
        try:
            pair = [float(word) for word in words or ("none",)]
        except ValueError:  # no match, no numbers
            raise InputError(
                f"spacing in {path.name}: {validate.shown(line)}; allowed: '# spacing = dx dy' in m"
            ) from None
        spacing = validate.spacing("spacing", pair if len(pair) == 2 else pair[0])
    heights, notes = read_table(path, lines, decimal, unit)
    return heights, spacing, notes


def read_points(path, decimal=None, unit=None) -> tuple[np.ndarray, tuple[float, float], tuple[str, ...]]:
    """heights[ix, iy], NaN where no point is, and (dx, dy), all in the unit of the file; notes."""
    table, notes = read_table(path, _lines(path)[1], decimal, unit)
    if table.shape[1] != 3:
        raise InputError(f"path = {str(path)!r} has {table.shape[1]} columns; allowed: exactly 3 (x y z)")
    if not (np.abs(table[:, :2]) <= FARTHEST).all():
        raise InputError(
            f"path = {str(path)!r}: x or y is NaN, infinite or beyond {FARTHEST:g}; allowed: finite coordinates"
        )
    (i, nx, dx), (j, ny, dy) = (_grid_lines(name, table[:, column]) for column, name in enumerate("xy"))
    if nx * ny > 4 * len(table):
        raise InputError(
            f"path = {str(path)!r}: {len(table)} points on a grid of {nx} x {ny}; allowed: "
            "a uniform grid with most of its points"
        )
    heights, count = np.full((nx, ny), np.nan), np.zeros((nx, ny), int)
    np.add.at(count, (i, j), 1)
    if count.max() > 1:
        raise InputError(
            f"path = {str(path)!r}: {np.count_nonzero(count > 1)} grid points are given more than once; give each once"
        )
    heights[i, j] = table[:, 2]
    return heights, (dx, dy), notes


def _grid_lines(name, coordinate) -> tuple[np.ndarray, int, float]:
    """(index of each point, number of lines, step) of one coordinate; uniform or an error."""
    ordered = np.sort(coordinate)
    gaps = np.diff(ordered)
    if gaps.size == 0 or gaps.max() <= 0:
        raise InputError(f"{name} has one value only ({coordinate[0]:g}); allowed: a grid of at least 2 x 2 points")
    starts = np.flatnonzero(np.concatenate([[True], gaps > NEXT_LINE * gaps.max()]))
    lines = np.add.reduceat(ordered, starts) / np.diff(np.append(starts, ordered.size))
    steps = np.diff(lines)
    count = 1 + int(np.rint(steps / np.median(steps)).sum())  # whole lines may be missing
    step = (ordered[-1] - ordered[0]) / (count - 1)
    position = (coordinate - ordered[0]) / step
    index = np.rint(position).astype(int)
    off = np.abs(position - index).max()
    if off > UNEVEN:
        raise InputError(
            f"spacing along {name} is not uniform: a point is {off:.2g} steps off its grid "
            f"line; allowed: at most {UNEVEN:g} of the step {step:g}"
        )
    return index, count, float(step)
