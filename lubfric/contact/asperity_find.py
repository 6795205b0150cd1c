"""Where the asperities of a height map are, and how sharp: summits, or patches above a separation."""

from __future__ import annotations

import math
from collections import defaultdict

import numpy as np


def _summit_finder(heights, spacing, periodic):
    """The summits are found once; find(flat) -> (index, overlap, radius) of those that touch."""
    inside = np.ones(heights.shape, bool)
    for axis in range(2):
        if not periodic[axis]:
            rim: list = [slice(None)] * 2
            rim[axis] = [0, -1]
            inside[tuple(rim)] = False
    for step in ((0, 1), (1, -1), (1, 0), (1, 1)):  # of equal neighbours the later one is the summit
        inside &= heights >= np.roll(heights, (-step[0], -step[1]), (0, 1))
        inside &= heights > np.roll(heights, step, (0, 1))
    index = np.argwhere(inside)
    i, j = index.T
    nx, ny = heights.shape
    along_x = 2 * heights[i, j] - heights[(i + 1) % nx, j] - heights[i - 1, j]
    along_y = 2 * heights[i, j] - heights[i, (j + 1) % ny] - heights[i, j - 1]
    radius = 2 / (along_x / spacing[0] ** 2 + along_y / spacing[1] ** 2)

    def find(flat):
        overlap = heights[i, j] - flat[i, j]
        touching = overlap > 0
        return index[touching], overlap[touching], radius[touching]

    return find


def _patch_finder(heights, spacing, periodic):
    """find(flat) -> (index of the largest overlap, that overlap, equivalent radius) of every region."""
    from scipy import ndimage

    def find(flat):
        overlap = heights - flat
        regions, count = ndimage.label(overlap > 0, np.ones((3, 3)))
        label, count = _join_across_edges(regions, count, periodic)
        if count == 0:
            return np.zeros((0, 2), int), np.zeros(0), np.zeros(0)
        cells = np.flatnonzero(label)
        order = np.lexsort((overlap.ravel()[cells], label.ravel()[cells]))
        cells = cells[order]
        sizes = np.bincount(label.ravel()[cells])[1:]
        highest = cells[np.cumsum(sizes) - 1]
        delta = overlap.ravel()[highest]
        radius = sizes * spacing[0] * spacing[1] / (2 * math.pi * delta)
        return np.stack(np.unravel_index(highest, heights.shape), axis=1), delta, radius

    return find


def _crossings(label, periodic):
    """Regions that touch across a periodic edge, also diagonally: pairs (n, 2) of their numbers, and by how many
    periods the second lies ahead along each axis (n, 2)."""
    pairs, ahead = [np.zeros((0, 2), int)], [np.zeros((0, 2), int)]
    for axis in range(2):
        if periodic[axis]:
            first, last = np.take(label, 0, axis), np.take(label, -1, axis)
            for shift in (-1, 0, 1):
                there, periods = np.roll(first, shift), np.zeros((first.size, 2), int)
                periods[:, axis] = 1
                if shift:
                    end = 0 if shift == 1 else -1
                    periods[end, 1 - axis] = -shift
                    there[end] *= bool(periodic[1 - axis])
                both = (last > 0) & (there > 0)
                pairs.append(np.stack([last[both], there[both]], axis=1))
                ahead.append(periods[both])
    return np.concatenate(pairs), np.concatenate(ahead)


def _join_across_edges(label, count, periodic):
    """Give regions that touch across a periodic edge (also diagonally) one number."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    a, b = _crossings(label, periodic)[0].T
    if count == 0 or a.size == 0:
        return label, count
    graph = coo_matrix((np.ones(a.size), (a - 1, b - 1)), shape=(count, count))
    count, number = connected_components(graph, directed=False)
    return np.concatenate([[0], number + 1])[label], count


def ridges(heights, bearing: float, periodic) -> int:
    """How many patches have no ends: above the separation at which ``bearing`` of the map touches, a way along them
    leads to the same cell of another period."""
    from scipy import ndimage

    regions, _ = ndimage.label(heights > np.quantile(heights, 1 - bearing), np.ones((3, 3)))
    ways = defaultdict(list)
    for a, b, i, j in np.unique(np.hstack(_crossings(regions, periodic)), axis=0).tolist():
        ways[a].append((b, i, j))
        ways[b].append((a, -i, -j))
    period: dict[int, tuple[int, int]] = {}
    count = 0
    for region in ways:
        if region in period:
            continue
        period[region], reached, endless = (0, 0), [region], False
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


FINDERS = {"summits": _summit_finder, "patches": _patch_finder}
