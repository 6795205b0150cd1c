"""Nested dissection: an order in which a sparse LU eliminates the cells of a grid with little fill-in.

A line of cells cuts the grid in two and comes last. Each half is cut again, and so on (A. George, SIAM J. Numer. Anal.
10 (1973) 345-363, doi:10.1137/0710032). A cell depends on two cells upstream, so a cut across x is two cells wide. y is
periodic, and is cut twice first. The order follows from the grid at no cost. It fills in less than a minimum degree
order that is found anew for every matrix.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

SMALL = 24  # cells that are not cut again


@lru_cache(maxsize=8)
def nested_dissection(nx: int, ny: int) -> np.ndarray:
    """Numbers of the cells (i ny + j) of a grid (nx, ny), free along x and periodic along y, in the order of
    elimination."""
    number = np.arange(nx * ny).reshape(nx, ny)
    order = np.concatenate(_ring(number))
    order.flags.writeable = False
    return order


def _ring(cells: np.ndarray) -> list[np.ndarray]:
    """The order for a part that is periodic along y. It is cut across x while it is longer than wide, then twice
    along x."""
    nx, ny = cells.shape
    if nx > ny and nx > 3:
        middle = nx // 2
        return [*_ring(cells[: middle - 1]), *_ring(cells[middle + 1 :]), cells[middle - 1 : middle + 1].T.ravel()]
    if ny < 4:
        return _box(cells)
    half = ny // 2
    return [*_box(cells[:, :half]), *_box(cells[:, half + 1 : -1]), cells[:, half], cells[:, -1]]


def _box(cells: np.ndarray) -> list[np.ndarray]:
    nx, ny = cells.shape
    if cells.size <= SMALL:
        return [cells.ravel()]
    if nx >= 2 * ny:
        middle = nx // 2
        return [*_box(cells[: middle - 1]), *_box(cells[middle + 1 :]), cells[middle - 1 : middle + 1].T.ravel()]
    middle = ny // 2
    return [*_box(cells[:, :middle]), *_box(cells[:, middle + 1 :]), cells[:, middle]]
