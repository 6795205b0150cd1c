"""Where the asperities of a height map are, and how sharp: summits, or patches above a separation."""

import math
from collections import defaultdict
from collections.abc import Callable
from typing import Any

import numpy as np

from .._base import BoolArray, FloatArray, IntArray

# Steps [cells] to one of each pair of opposite neighbours. By definition of a neighbour.
AHEAD = ((0, 1), (1, -1), (1, 0), (1, 1))


def _summit_finder(
    heights: FloatArray, spacing: tuple[float, float], periodic: tuple[bool, bool]
) -> Callable[..., Any]:
    """Return find(flat) -> (index, overlap, radius) of the summits that touch."""
    inside = np.ones(heights.shape, bool)
    for axis in range(2):
        if not periodic[axis]:
            np.moveaxis(inside, axis, 0)[[0, -1]] = False
    for step in AHEAD:  # of equal neighbours the later one is the summit
        inside &= heights >= np.roll(heights, (-step[0], -step[1]), (0, 1))
        inside &= heights > np.roll(heights, step, (0, 1))
    index = np.argwhere(inside)
    i, j = index.T
    nx, ny = heights.shape
    along_x = 2 * heights[i, j] - heights[(i + 1) % nx, j] - heights[i - 1, j]
    along_y = 2 * heights[i, j] - heights[i, (j + 1) % ny] - heights[i, j - 1]
    radius = 2 / (along_x / spacing[0] ** 2 + along_y / spacing[1] ** 2)

    def find(flat: FloatArray) -> tuple[IntArray, FloatArray, FloatArray]:
        overlap = heights[i, j] - flat[i, j]
        touching = overlap > 0
        return index[touching], overlap[touching], radius[touching]

    return find


def _patch_finder(heights: FloatArray, spacing: tuple[float, float], periodic: tuple[bool, bool]) -> Callable[..., Any]:
    """Return find(flat) -> (index of the largest overlap, that overlap, equivalent radius) of every region."""

    def find(flat: FloatArray) -> tuple[IntArray, FloatArray, FloatArray]:
        overlap = (heights - flat).ravel()
        label = _joined(_labelled(heights > flat), periodic).ravel()
        cells = np.flatnonzero(label)
        cells = cells[np.lexsort((overlap[cells], label[cells]))]
        sizes = np.bincount(label[cells])[1:]
        highest = cells[np.cumsum(sizes) - 1]
        radius = sizes * spacing[0] * spacing[1] / (2 * math.pi * overlap[highest])
        return np.stack(np.unravel_index(highest, heights.shape), axis=1), overlap[highest], radius

    return find


FINDERS = {"summits": _summit_finder, "patches": _patch_finder}


def _labelled(touching: BoolArray) -> np.ndarray:
    """Return the number of the region of every touching cell, from 1 on; 0 elsewhere. Neighbours touch diagonally
    too."""
    from scipy import ndimage

    return ndimage.label(touching, np.ones((3, 3)))[0]


def _crossings(label: IntArray, periodic: tuple[bool, bool]) -> np.ndarray:
    """Return the regions that touch across a periodic edge, also diagonally: rows (region, region, by how many periods
    the second lies ahead along each axis)."""
    cells = np.argwhere(label)
    pairs = []
    for step in AHEAD:
        periods, there = np.divmod(cells + step, label.shape)
        across = periods.any(axis=1) & ((periods == 0) | periodic).all(axis=1)
        pair = (label[tuple(part[across].T)] for part in (cells, there))
        pairs.append(np.column_stack([*pair, periods[across]]))
    rows = np.concatenate(pairs)
    return rows[rows[:, 1] > 0]


def _joined(label: IntArray, periodic: tuple[bool, bool]) -> np.ndarray:
    """Return ``label`` with one number for regions that touch across a periodic edge (also diagonally)."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    a, b = _crossings(label, periodic)[:, :2].T
    if not a.size:
        return label
    count = label.max()
    graph = coo_matrix((np.ones(a.size), (a - 1, b - 1)), shape=(count, count))
    return np.concatenate([[0], connected_components(graph, directed=False)[1] + 1])[label]


def ridges(heights: np.ndarray, bearing: float, periodic: tuple[bool, bool]) -> int:
    """Return how many patches have no ends: above the separation at which ``bearing`` of the map touches, a way along
    them leads to the same cell of another period."""
    label = _labelled(heights > np.quantile(heights, 1 - bearing))
    ways = defaultdict(list)
    for a, b, i, j in np.unique(_crossings(label, periodic), axis=0).tolist():
        ways[a].append((b, i, j))
        ways[b].append((a, -i, -j))
    period: dict[int, tuple[int, int]] = {}
    count = 0
    for region in ways:
        if region in period:
            continue
        period[region] = (0, 0)
        reached = [region]
        endless = False
        while reached:
            here = reached.pop()
            for there, i, j in ways[here]:
                met = period[here][0] + i, period[here][1] + j
                if there not in period:
                    period[there] = met
                    reached.append(there)
                endless |= period[there] != met
        count += endless
    return count
