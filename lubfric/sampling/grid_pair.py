"""The effect of the coarse cells of a line: one piece of surface is solved on its own cells and on every second,
fourth, ... of them."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..contact import ContactState
from ..film import Film
from ..sharing import OperatingPoint, thinned
from .influence import BlockError, add_errors, block_error, gap_influence, line_load, strip_gap
from .other_cells import half_again

SLOWEST, FASTEST = 0.75, 0.25  # ratio of successive changes
FEWEST = 3  # pieces too short for blocks
MOST_CELLS = 300_000  # of a piece, where a coarser one would do
BY_LOAD = 2.0  # what the change of the gap itself changes by with ln of the contact load, at most, over its size


@dataclass(frozen=True)
class GridStep:
    """The change when the cells of a line become finer, at the line's film and ``contact_load`` [N].

    - ``gap`` [m]: change of the mean gap beyond that of the mean film, whose columns change with the cells;
      ``error``: its standard error; ``rest`` [m]: estimated change still to come on the scene's own cells (0: they were
      reached).
    - ``film`` [m]: change of the mean film.
    - ``area``: factor on the contact area; ``area_error``: its relative standard error and the rest.
    - ``plastic``: to be added to the plastic area fraction.
    - ``moved``: |ln| of the load at which the change is used, over ``contact_load``.
    - ``beyond`` [m]: estimated change on cells half as long as the scene's own (`lubfric.sampling.other_cells`; NaN:
      own cells not reached).
    """

    gap: float
    error: BlockError
    rest: float
    beyond: float
    area: float
    area_error: float
    plastic: float
    contact_load: float
    moved: float = 0.0
    film: float = 0.0

    @property
    def area_left(self) -> float:
        """Relative error of ``area``: ``area_error``, and a change by the other load. That change was seen to be less
        than ``moved`` times the distance of ``area`` from 1."""
        return self.area_error + abs(1 - self.area) * self.moved

    def at_load(self, contact_load: float) -> GridStep:
        """The same step, used at another load [N]."""
        return replace(self, moved=abs(math.log(contact_load / self.contact_load)))


@dataclass(frozen=True)
class _Rows:
    """Values at every place along y, on the coarsest cells: influence on the mean gap beyond the mean film [m], share
    of A in contact, and plastic share of A."""

    gap: np.ndarray
    touching: np.ndarray
    plastic: float


def _ladder(factors) -> list[tuple[int, int]]:
    """Factors of the cells, from those of the line down to the scene's own, each half the one before."""
    steps = [factors]
    while steps[-1] != (1, 1):
        steps.append(tuple(max(1, f // 2) for f in steps[-1]))
    return steps


def grid_step(
    lines,
    index: int,
    length: float,
    point: OperatingPoint,
    film: Film,
    contact_load: float,
    gap_slope: float,
    enough: float,
) -> GridStep:
    """Compare one piece of ``lines``, about ``length`` [m] long, on finer and finer cells down to the scene's own.

    Where that takes more than `MOST_CELLS` cells, it ends when the rest is within ``enough`` [m]. ``point``, ``film``
    and ``contact_load`` [N] are the line's; ``gap_slope`` is dG/dP [m²/N]. The change is averaged over blocks along y,
    each with its influence on the mean gap (`influence`).
    """
    scene, surface, steps = lines.scene, lines.pair(index, length), _ladder(lines.cells.factors)
    rows, changes, films, rest, state = [], [], [], math.inf, None
    for factors in steps:
        if rest <= enough and surface.heights.size / math.prod(factors) > MOST_CELLS:
            break
        contact = thinned(scene, surface, lines.cells, factors)
        thickness, under = point.film_on(contact, film)
        state = contact.close(thickness, contact_load, state, under)
        rows.append(_by_row(contact, state, gap_slope, lines.cells.factors[1] // factors[1]))
        films.append(state.mean_film)
        if len(rows) > 1:
            changes.append(float(np.mean(rows[-1].gap) - np.mean(rows[-2].gap)))
            rest = remaining(changes)
    own = len(rows) == len(steps)
    step, correlation = lines.cells.coarse[1], lines.lengths[1]
    difference = rows[-1].gap - rows[0].gap
    area, area_error = _ratio(rows[-1].touching, rows[0].touching, step, correlation)
    return GridStep(
        gap=float(difference.mean()),
        error=block_error(difference, step, correlation),
        rest=0.0 if own else rest,
        beyond=half_again(changes[-1:-3:-1]) if own else math.nan,
        area=area,
        area_error=area_error
        if own
        else math.hypot(area_error, _ratio(rows[-1].touching, rows[-2].touching, step, correlation)[0] - 1),
        plastic=rows[-1].plastic - rows[0].plastic,
        contact_load=contact_load,
        film=films[-1] - films[0],
    )


def lost_summits(lines, surface, point: OperatingPoint, film: Film) -> float:
    """Height [m] that the cells of the ``lines`` take from the highest summit of ``surface``, which has the scene's own
    cells, measured by its distance to a ``film`` above it."""
    gaps = []
    for factors in ((1, 1), lines.cells.factors):
        contact = thinned(lines.scene, surface, lines.cells, factors)
        thickness, under = point.film_on(contact, film)
        gaps.append(contact.close(thickness, 0.0, None, under).mean_gap)
    return gaps[0] - gaps[1]


def _ratio(fine, coarse, step, correlation) -> tuple[float, float]:
    """Ratio of the means of two fields along y, and its relative standard error."""
    if not coarse.any() or not fine.any():
        return 1.0, math.nan
    ratio = float(fine.mean() / coarse.mean())
    return ratio, block_error(fine - ratio * coarse, step, correlation).error / float(fine.mean())


def mean_error(steps) -> BlockError:
    """Error [m] of the mean change of the gap over several pieces; zero if there are none to compare.

    If the pieces are too short for blocks, it follows from the differences between them. Fewer than three of these have
    no scatter: it is taken to be as large as the changes themselves.
    """
    if not steps:
        return BlockError(0.0, 1)
    if not all(math.isfinite(g.error.error) for g in steps):
        gaps = np.array([g.gap for g in steps])
        few = gaps.size < FEWEST
        scatter = float(np.sqrt(np.mean(gaps**2))) if few else float(np.std(gaps, ddof=1))
        return BlockError(scatter / math.sqrt(gaps.size), gaps.size if few else gaps.size - 1)
    found = add_errors(*(g.error for g in steps))
    return BlockError(found.error / len(steps), found.freedom)


def gap_left(steps) -> float:
    """Change of the gap [m] that may still come, averaged over several pieces: by finer cells, and because the pieces
    were solved at another load. The latter was seen to be less than 1.5 ``moved`` times the change and its standard
    error, on Gaussian and measured surfaces."""
    if not steps:
        return 0.0
    moved = BY_LOAD * steps[0].moved
    by_load = moved * (abs(mean_of(steps, "gap", 0.0)) + mean_error(steps).error) if moved else 0.0
    return mean_of(steps, "rest", 0.0) + by_load


def second_order(steps, split: float) -> float:
    """What is left open of the gap [m] by correcting it for the cells to first order: the correction times the change
    of ln(F_H/F_C) that it makes, with ``split`` [1/m] for `Response.split`. No more was seen, but for one of 25 scenes
    (1.4 times that, beside a scatter of 17 %)."""
    change = mean_of(steps, "gap", 0.0)
    return abs(split) * change**2


def mean_of(steps, name: str, without: float) -> float:
    """Mean of a field of `GridStep` over pieces; ``without`` if there are none."""
    return sum(getattr(g, name) for g in steps) / len(steps) if steps else without


def remaining(changes) -> float:
    """The change by further halvings of the cells: the rest of a geometric series, from the ratio of the last two
    changes (1/4 to 3/4; 1/2 if there is only one change)."""
    last = abs(changes[-1])
    before = abs(changes[-2]) if len(changes) > 1 else 0.0
    ratio = min(max(last / before, FASTEST), SLOWEST) if before > 0 else 0.5
    return last * ratio / (1 - ratio)


def _by_row(contact, state: ContactState, gap_slope: float, rows: int) -> _Rows:
    """Means over ``rows`` cells along y."""
    gap, load = strip_gap(contact, state), line_load(contact, state)
    pressure = np.zeros(contact.heights.shape) if state.pressure is None else state.pressure
    touching = contact.weight @ (pressure > 0) / contact.weight.sum()
    return _Rows(
        gap_influence(gap, load, gap_slope).reshape(-1, rows).mean(axis=1) - state.mean_film,
        touching.reshape(-1, rows).mean(axis=1),
        state.plastic_area_fraction,
    )
