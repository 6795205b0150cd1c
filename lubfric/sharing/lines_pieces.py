"""Rough contacts on pieces of a surface: on a line, and on a piece with fine cells that are then made coarser."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from ..contact import HalfSpaceContact, half_space_contact
from ..surface import Surface
from .lines_cells import Cells


def line_contact(scene, surface: Surface, others: Iterable[HalfSpaceContact] = ()) -> HalfSpaceContact:
    """The contact of ``surface`` under the cylinder of ``scene``. It uses the operator of one of ``others`` where
    the grids are equal."""
    grid = surface.shape, tuple(surface.spacing)
    operator = next((c.operator for c in others if (c.heights.shape, tuple(c.spacing)) == grid), None)
    return half_space_contact(scene, surface.heights - surface.heights.mean(), surface.spacing, operator)


def thinned(scene, surface: Surface, cells: Cells, factors: tuple[int, int]) -> HalfSpaceContact:
    """Every ``factors``-th cell of a fine ``surface``. The coarsest of them has the columns of a line of ``cells``."""
    fx, fy = factors
    first = cells.factors[0] // 2 % fx
    x = cells.axis()[0] + (np.arange(surface.shape[0]) - cells.factors[0] // 2) * cells.spacing[0]
    kept = replace(
        surface,
        heights=surface.heights[first::fx, fy // 2 :: fy],
        spacing=(surface.spacing[0] * fx, surface.spacing[1] * fy),
        mask=None,
    )
    return half_space_contact(scene, kept.heights - kept.heights.mean(), kept.spacing, x=x[first::fx])
