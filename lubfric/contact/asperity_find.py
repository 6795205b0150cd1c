"""Where the asperities of a height map are, and how sharp: summits, or patches above a separation."""

import math

import numpy as np

AHEAD = ((0, 1), (1, -1), (1, 0), (1, 1))  # one of each pair of opposite neighbours


def _summit_finder(heights, spacing, periodic):
    """The summits are found once; find(flat) -> (index, overlap, radius) of those that touch."""
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

    def find(flat):
        overlap = heights[i, j] - flat[i, j]
        touching = overlap > 0
        return index[touching], overlap[touching], radius[touching]

    return find


def _patch_finder(heights, spacing, periodic):
    """find(flat) -> (index of the largest overlap, that overlap, equivalent radius) of every region."""

    def find(flat):
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


def _labelled(touching) -> np.ndarray:
    """Number of the region of every touching cell, from 1 on; 0 elsewhere. Neighbours touch diagonally too."""
    from scipy import ndimage

    return ndimage.label(touching, np.ones((3, 3)))[0]


def _joined(label, periodic) -> np.ndarray:
    """Regions that touch across a periodic edge (also diagonally) get one number."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    around, (nx, ny) = label, label.shape
    for axis, closed in enumerate(periodic):
        width = [(1, 1) if axis == other else (0, 0) for other in range(2)]
        around = np.pad(around, width, mode="wrap" if closed else "constant")
    pairs = [np.stack([label, around[1 + i : 1 + i + nx, 1 + j : 1 + j + ny]]).reshape(2, -1) for i, j in AHEAD]
    a, b = np.concatenate(pairs, axis=1)
    joins = (a > 0) & (b > 0) & (a != b)
    count = label.max()
    graph = coo_matrix((np.ones(np.count_nonzero(joins)), (a[joins] - 1, b[joins] - 1)), shape=(count, count))
    return np.concatenate([[0], connected_components(graph, directed=False)[1] + 1])[label]


def ridges(heights, bearing: float, periodic) -> int:
    """How many patches have no ends: above the separation at which ``bearing`` of the map touches, a way along them
    leads to the same cell of another period. (As a way that does not cross itself goes round at least one axis an odd
    number of times, it leads to the same cell of two maps side by side.)"""
    touching, (nx, ny) = heights > np.quantile(heights, 1 - bearing), heights.shape
    copies = [2 if closed else 1 for closed in periodic]
    twice = _joined(_labelled(np.tile(touching, copies)), periodic)
    endless = np.zeros(heights.shape, bool)
    for i, j in list(np.ndindex(*copies))[1:]:
        endless |= twice[:nx, :ny] == np.roll(twice, (i * nx, j * ny), (0, 1))[:nx, :ny]
    return np.unique(_joined(_labelled(touching), periodic)[endless & touching]).size
