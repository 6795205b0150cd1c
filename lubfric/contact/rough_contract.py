"""What every rough contact under a film must offer: all that you need to know to write one.

`RoughContact` is the contract. `x`, `weight`, `name` and `close` have to be written; the rest has defaults.
`lubfric.prepare` takes one from outside (``contact``), and the balance needs nothing else. Means are taken over the
area A of Eq. (8), by weights.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, field

import numpy as np

from ..errors import InputError
from .refinement import ContactResult


@dataclass(frozen=True, kw_only=True)
class ContactState:
    """A rough contact at one division of the load: where it touches, and both sides of the volume balance, Eq. (8).

    - ``mean_gap`` [m]: lubricant volume per area of A between the rough surfaces; ``mean_film`` [m]: the same between
      the smooth ones.
    - ``contact_fraction`` (nx,): share of the width in contact at each ``x`` [m]; ``real_contact_area_fraction``,
      ``plastic_area_fraction``: of the area A.
    - ``fields``: pressure and gap on the contact grid, (nx, ny) (None: separated, or the contact has none); ``y`` [m]
      (ny,): of their cells.
    - ``gap_error`` [m]: estimated error of ``mean_gap`` by its solver or by interpolation; ``area_error`` [-]: of
      ``real_contact_area_fraction``, where it is interpolated.
    """

    mean_gap: float
    mean_film: float
    x: np.ndarray
    contact_fraction: np.ndarray
    real_contact_area_fraction: float
    plastic_area_fraction: float
    fields: ContactResult | None = None
    y: np.ndarray | None = field(default=None, repr=False)
    gap_error: float = 0.0
    area_error: float = 0.0

    def touching(self, x: np.ndarray) -> np.ndarray:
        """Return the share of the width in contact (n - 1,), averaged over each cell between neighbouring ``x`` (n,)
        [m], either way. (The columns of the contact are finer than the cells of a film, and vary from one to the
        next.)"""
        step = self.x[1] - self.x[0] if self.x.size > 1 else 0.0
        edges = np.append(self.x - 0.5 * step, self.x[-1] + 0.5 * step)
        touched = np.append(0.0, np.cumsum(self.contact_fraction) * step)
        return np.diff(np.interp(x, edges, touched)) / np.diff(x)


class RoughContact(ABC):
    """A rough contact under a film, immutable. Loads are in N on the full width of the line.

    ``name``: a property, for `Decision.text`; ``x`` [m] (nx,): where the contact needs the film, around the line of
    contact; ``weight`` (nx,): the part of each cell that is inside the area A of Eq. (8).
    """

    x: np.ndarray
    weight: np.ndarray

    @property
    @abstractmethod
    def name(self) -> str:
        """Return the contact as text."""

    @abstractmethod
    def close(
        self, film: np.ndarray, load: float, start: ContactState | None = None, shape: np.ndarray | None = None
    ) -> ContactState:
        """Return the contact that carries ``load`` [N] (0: first touch) under ``film`` [m] (nx,).

        ``shape`` [m] (nx,): what the surface is pressed under, up to a constant, if it is not the film itself;
        ``start``: a neighbour's state, on this grid or another. Raises `ConvergenceError` if it cannot be solved.
        """

    def over_strip(self, half_width: float, before: float) -> RoughContact:
        """Return the same contact where the area A is the Hertz strip of ``half_width`` [m], in place of that of
        ``before`` [m]: for a run in time whose load or radius changes. Raises `InputError` for a kind of contact that
        does not define it."""
        message = f"a contact of type {type(self).__name__} has one area A, and the Hertz strip of this run changes"
        raise InputError(message, recommendation=f"define {type(self).__name__}.over_strip(half_width, before)")

    @property
    def capacity(self) -> float:
        """Return the largest load [N] that it can carry under any film; infinite if `close` determines it."""
        return math.inf

    @property
    def grid(self) -> tuple[int, int] | None:
        """Its cells (nx, ny); None if it has none on which f depends."""
        return None

    @property
    def adjustable_tolerance(self) -> float | None:
        """Return the tolerance of the gap, relative to ``fields.length``, that `tightened` changes (None: nothing)."""
        return None

    def tightened(self, tolerance: float) -> RoughContact:
        """Return the same contact, solved to ``tolerance``."""
        return self

    def on_the_ends(self, state: ContactState) -> float:
        """Return the share of the load on the edge columns, whose ends cut a contact off; ``state`` is on this
        contact."""
        return 0.0


def centred_axis(count: int, step: float) -> np.ndarray:
    """Return the cell centres [m] of ``count`` cells around zero."""
    return (np.arange(count) - 0.5 * (count - 1)) * step


def area_weight(region: str, half_width: float, x: np.ndarray, step: float) -> np.ndarray:
    """Return the part of each cell, ``step`` [m] long around ``x`` [m] (nx,), that lies in the area A of Eq. (8).

    ``region``: "box", the complete patch, or "hertz", the strip of ``half_width`` [m]. Cells that the edge of the
    strip cuts count by the part inside. Raises `InputError` if the strip contains no part of any cell.
    """
    if region == "box":
        return np.ones(x.size)
    inside = np.minimum(x + step / 2, half_width) - np.maximum(x - step / 2, -half_width)
    weight = np.clip(inside / step, 0.0, 1.0)
    if not weight.any():
        raise InputError(
            f"contact.spacing: no cell of the contact grid lies in the Hertz strip of half-width {half_width:g} m; "
            "give finer ones"
        )
    return weight


def weighted_mean(values: np.ndarray, weight: np.ndarray) -> float:
    """Return the mean of ``values`` over the area A, by ``weight``."""
    return float(np.dot(values, weight) / weight.sum())
