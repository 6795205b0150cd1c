"""Where the asperities of a height map are, and how sharp: summits, or patches above a separation."""

from __future__ import annotations

import math

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


def _join_across_edges(label, count, periodic):
    """Give regions that touch across a periodic edge (also diagonally) one number."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    pairs = [np.zeros((2, 0), int)]
    for axis in range(2):
        if periodic[axis]:
            first, last = np.take(label, 0, axis), np.take(label, -1, axis)
            for shift in (-1, 0, 1):
                here, there = last.copy(), np.roll(first, shift)
                if shift and not periodic[1 - axis]:
                    there[0 if shift == 1 else -1] = 0
                both = (here > 0) & (there > 0)
                pairs.append(np.stack([here[both], there[both]]))
    a, b = np.concatenate(pairs, axis=1)
    if count == 0 or a.size == 0:
        return label, count
    graph = coo_matrix((np.ones(a.size), (a - 1, b - 1)), shape=(count, count))
    count, number = connected_components(graph, directed=False)
    return np.concatenate([[0], number + 1])[label], count


def ridges(heights, bearing: float, periodic) -> int:
    """How many patches have no ends: above the separation at which ``bearing`` of the map touches, they have a cell at
    every place along a periodic axis, and go on in the next period."""
    from scipy import ndimage

    touching = heights > np.quantile(heights, 1 - bearing)
    regions, count = ndimage.label(touching, np.ones((3, 3)))
    label, count = _join_across_edges(regions, count, periodic)
    i, j = np.nonzero(label)
    endless = np.zeros(count + 1, bool)
    for axis, place in enumerate((i, j)):
        if periodic[axis]:
            met = np.unique(label[i, j] * heights.shape[axis] + place) // heights.shape[axis]
            endless |= np.bincount(met, minlength=count + 1) == heights.shape[axis]
    return int(endless.sum())


FINDERS = {"summits": _summit_finder, "patches": _patch_finder}
