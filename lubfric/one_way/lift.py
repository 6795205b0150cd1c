"""Spots of asperities keep a film under them, and it lifts the whole gap: the condition of Ertel and Grubin, spot by
spot.

The gap keeps the shape of the dry contact and is lifted by one height δ, the film on the spots. Ahead of a spot the
flow builds up a reduced pressure Q; the thinner the film, the larger Q. The film carries a spot when Q reaches the
reduced pressure at which the film would rub like the contact (`limit`), or comes close to the largest Q of the
lubricant. δ is the height at which the two are equal. Q is the largest on each spot, averaged over the spots by their
loads.

Source: the condition of a smooth contact as in J. A. Greenwood, Lubricants 8 (2020) 51, doi:10.3390/lubricants8050051.
It is not known for spots of a rough contact; docs/model-error.md tells how good it is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import label

from .._base import increasing_root
from ..deterministic import Problem
from ..film import reduced_pressure
from .film import GapFilm, Kept, gap_film
from .limit import pressure_limit

TOLERANCE = 0.005  # of Q, which moves the film on the spots by some .3 % of itself, and its load by a part of that
HIGHEST = 1e-4  # m
GUESS = 0.1  # of the smooth film, to begin with
STEP, MOST = 0.5, 2.0  # of ln δ at first; |ln| of the ratio of Q, beyond which it tells nothing
SLOPE = 1.5  # of one over the other, roughly: Q falls with the film to the power of 11/8 ahead of a smooth line contact


@dataclass(frozen=True)
class Spots:
    """Spots of a dry contact: cells (indices in C order), the spot to which each belongs, and the loads of the
    spots."""

    cells: np.ndarray
    spot: np.ndarray
    load: np.ndarray

    def mean_of_largest(self, field) -> float:
        """The largest value of ``field`` (nx, ny) on every spot, averaged over the spots by their loads."""
        largest = np.zeros(self.load.size)
        np.maximum.at(largest, self.spot, field.ravel()[self.cells])
        return float(self.load @ largest / self.load.sum())


def spots_of(pressure) -> Spots:
    """Connected cells of ``pressure`` > 0 [Pa] (nx, ny), periodic along y."""
    found, count = label(pressure > 0)
    name = np.arange(count + 1)
    both = (found[:, 0] > 0) & (found[:, -1] > 0)
    for one, other in zip(found[both, 0], found[both, -1]):
        name[name == name[other]] = name[one]
    cells = np.flatnonzero(found)
    _, spot = np.unique(name[found.ravel()[cells]], return_inverse=True)
    return Spots(cells, spot, np.bincount(spot, weights=pressure.ravel()[cells]))


@dataclass(frozen=True)
class Lifted:
    """A gap [m] (nx, ny) with its film, and the height [m] by which the gap was lifted."""

    gap: np.ndarray
    film: GapFilm
    height: float


def lifted(problem: Problem, gap, spots: Spots, near: float | None = None, kept: Kept | None = None) -> Lifted:
    """``gap`` [m], 0 on the ``spots``, lifted by the film that these keep. ``near`` [m] and ``kept``: those of a
    neighbour.

    Stops when both reduced pressures agree to `TOLERANCE`. The film is never thinner than the floor. It is at the floor
    if the flow cannot carry the spots (behind the rupture of the film), and for a constant viscosity.
    """

    def at(log_height: float, last: Lifted | None) -> tuple[float, Lifted]:
        height = math.exp(log_height)
        film = gap_film(problem, gap + height, kept if last is None else last.film.kept)
        return surplus(problem, spots, height, film), Lifted(gap + height, film, height)

    lowest = math.log(problem.floor)
    if problem.lubricant.viscosity_law == "constant":
        return at(lowest, None)[1]
    return increasing_root(
        at,
        math.log(GUESS * problem.contact.moes_film if near is None else near),
        step=STEP,
        bounds=(lowest, math.log(HIGHEST)),
        tolerance=TOLERANCE,
        slope=SLOPE,
    ).payload


def surplus(problem: Problem, spots: Spots, height: float, film: GapFilm) -> float:
    """ln(Q needed/Q built up): of the reduced pressure that carries the ``spots`` under a film of ``height`` [m], over
    the one that ``film`` builds up. Negative: the film is too thin for its flow."""
    lubricant = problem.lubricant
    limit = pressure_limit(lubricant, height, problem.sliding, problem.boundary_friction)
    built_up = max(spots.mean_of_largest(film.reduced), 1e-300)
    with np.errstate(divide="ignore"):
        return float(np.clip(np.log(reduced_pressure(lubricant)(limit) / built_up), -MOST, MOST))
