"""The effect of the coarse cells of a sample: pieces of the surface are solved on the same cells and on finer ones,
down to the scene's own, under the same film and load.

What a piece shows is a change of the mean gap. The response of the balance turns it into a change of f.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...contact import ContactState, HalfSpaceContact
from ...samples import Sample
from ...scene import budget
from ..shared import Prepared, StandardError, add_errors, block_error, contact_on_piece, ratio_of_changes
from .balance import Balance
from .closure import gap_under
from .point import Point
from .response import contact_length
from .scatter import gap_influence, hertz_mean_gap, line_load

# Ratio of successive changes with which a series of halvings is continued, at least and at most [-]: second order; and,
# not measured, more than the sqrt(1/2) by which heights of an exponential correlation change from halving to halving.
SERIES_RATIOS = (0.25, 0.75)

# Ratio of the next change to the last one, at least and at most [-]: smooth heights, of second order and better; and
# detail at every scale. They follow from 2^-3 and 2^-1, by choice of the orders.
NEXT_RATIOS = (0.125, 0.5)

# Ratio of successive changes where there is one change only [-]. A choice: the larger of `NEXT_RATIOS`.
UNKNOWN_CHANGE_RATIO = 0.5

# Next change over the last but one, at least [-], in case the last one is small by chance. Not measured.
LEAST_NEXT_RATIO = 1 / 32

# Pieces that state a scatter where each is too short for blocks. A choice: two degrees of freedom.
FEWEST_PIECES = 3

# Pieces, at most: 504 correlation lengths. Not measured: it bounds the work, and the error that is left is reported.
MOST_COMPARED_PIECES = 12

# Cells of a piece, at most, where a coarser one would do: memory and time. A choice. Half and twice this value change f
# by less than .1 % and the work by up to 6 % less (constants.csv).
MOST_PIECE_CELLS = 300_000

# Part of the sampling tolerance that the scatter between pieces may take. A choice: the error of the pieces is added to
# that of the strips.
PIECE_SHARE = 0.5

# Change of the gap's change over its size, per ln of the contact load, at most: less than 1.5 was seen on Gaussian and
# measured surfaces. A choice above it.
BY_LOAD = 2.0


@dataclass(frozen=True, kw_only=True)
class CellStep:
    """The change when the cells of a piece become native, at one film and one contact load.

    Attributes
    ----------
    gap_change : of the mean gap beyond that of the mean film, whose columns change with the cells [m]
    error : standard error of ``gap_change`` [m]
    remaining_change : estimated change of the gap still to come on native cells [m]; 0: they were reached
    finer_grid_change : estimated change of the gap on cells half as long as native ones [m]; NaN: these were not
        reached
    film_change : of the mean film [m]
    area_factor : factor on the contact area fraction of A
    area_error : relative standard error of ``area_factor``, and what may still come
    length_factor : factor on the contact area of the complete line, which may touch beyond A
    plastic_change : to be added to the plastic area fraction
    edge_load_share : share of the load on the edge columns
    """

    gap_change: float = 0.0
    error: StandardError = StandardError(0.0, 1)
    remaining_change: float = 0.0
    finer_grid_change: float = math.nan
    film_change: float = 0.0
    area_factor: float = 1.0
    area_error: float = 0.0
    length_factor: float = 1.0
    plastic_change: float = 0.0
    edge_load_share: float = 0.0


@dataclass(frozen=True, kw_only=True)
class CellEffect(CellStep):
    """The mean `CellStep` of several pieces, which were solved at ``contact_load`` [N]; by default no change."""

    contact_load: float = 0.0

    def at_load(self, contact_load: float) -> CellEffect:
        """Return the effect, used at another load: what that may change of it was seen to be less than 1.5 |ln| of the
        ratio of loads times the change and its standard error, on Gaussian and measured surfaces."""
        if not self.contact_load:
            return self
        moved = abs(math.log(contact_load / self.contact_load))
        remaining_change = self.remaining_change + BY_LOAD * moved * (abs(self.gap_change) + self.error.value)
        return replace(
            self, remaining_change=remaining_change, area_error=self.area_error + abs(1 - self.area_factor) * moved
        )


def effect_of_cells(prepared: Prepared, point: Point, balance: Balance, sample: Sample) -> CellEffect:
    """Compare pieces of ``sample`` until the scatter between them is a small part of the sampling tolerance."""
    response = balance.response
    numerics = prepared.scene.numerics
    if sample.cells.is_native or balance.film is None or response is None:
        return CellEffect()
    enough = response.gap_for("coefficient", budget.CONTACT_GRID * numerics.tolerance)
    scatter = response.gap_for("coefficient", PIECE_SHARE * numerics.sampling_tolerance)
    steps: list[CellStep] = []
    while not _are_enough(steps, min(MOST_COMPARED_PIECES, sample.available_pieces), scatter):
        steps.append(_step(prepared, point, balance, sample, index=len(steps), enough=enough))
    error = mean_error(steps) if sample.represents_more else StandardError(0.0, 1)

    def mean(name: str) -> float:
        return sum(getattr(step, name) for step in steps) / len(steps)

    names = (
        "gap_change",
        "remaining_change",
        "finer_grid_change",
        "film_change",
        "area_factor",
        "length_factor",
        "plastic_change",
        "edge_load_share",
    )
    values = {name: mean(name) for name in names}
    return CellEffect(error=error, area_error=_error_of_area(steps), contact_load=balance.contact_load, **values)


def _error_of_area(steps: Sequence[CellStep]) -> float:
    """Return the relative error of the mean factor on the contact area; from the differences between pieces where they
    are too short for blocks (NaN: too few of them)."""
    within = sum(step.area_error for step in steps) / len(steps) / math.sqrt(len(steps))
    if math.isfinite(within):
        return within
    factors = np.array([step.area_factor for step in steps])
    return (
        float(factors.std(ddof=1) / factors.mean() / math.sqrt(factors.size))
        if factors.size >= FEWEST_PIECES
        else math.nan
    )


def _are_enough(steps: Sequence[CellStep], most: float, scatter: float) -> bool:
    """Return whether these pieces are enough: the error of their mean is within ``scatter`` [m], there are no more
    pieces, or there are three that are too short for blocks."""
    are_too_short = len(steps) >= FEWEST_PIECES and not math.isfinite(steps[0].error.value)
    return len(steps) > 0 and (are_too_short or len(steps) >= most or mean_error(steps).value <= scatter)


def _step(prepared: Prepared, point: Point, balance: Balance, sample: Sample, *, index: int, enough: float) -> CellStep:
    """Solve piece number ``index`` on finer and finer cells. Where that takes more than `MOST_PIECE_CELLS` cells, it
    ends when the rest is within ``enough`` [m]. The change is averaged over blocks along y, each with its influence on
    the mean gap."""
    assert balance.film is not None and balance.response is not None
    slope = balance.response.slopes.gap
    ladder = sample.cells.coarsenings()
    coarse = sample.cells
    places: list[tuple[np.ndarray, np.ndarray]] = []
    changes: list[float] = []
    states: list[ContactState] = []
    remaining_change = math.inf
    for coarsening in ladder:
        rough_contact = contact_on_piece(prepared, sample, index, coarsening=coarsening)
        if remaining_change <= enough and rough_contact.heights.size > MOST_PIECE_CELLS:
            break
        start = states[-1] if states else None
        states.append(point.pressed(rough_contact, balance.film, balance.contact_load, start))
        places.append(_along_y(rough_contact, states[-1], slope, coarse.coarsening[1] // coarsening[1]))
        if len(places) > 1:
            changes.append(float(np.mean(places[-1][0]) - np.mean(places[-2][0])))
            remaining_change = remaining(changes)
    reached_native = len(places) == len(ladder)
    step = coarse.spacing[1]
    length = sample.correlation_lengths[1]
    difference = places[-1][0] - places[0][0]
    area, area_error = _ratio(places[-1][1], places[0][1], step, length)
    if not sample.represents_more:
        area_error = 0.0
    if not reached_native:
        area_error = math.hypot(area_error, _ratio(places[-1][1], places[-2][1], step, length)[0] - 1)
    return CellStep(
        gap_change=float(difference.mean()),
        error=block_error(difference, step, length),
        remaining_change=0.0 if reached_native else remaining_change,
        finer_grid_change=predicted_next_change(changes[-1:-3:-1]) if reached_native else math.nan,
        film_change=states[-1].mean_film - states[0].mean_film,
        area_factor=area,
        area_error=area_error,
        length_factor=contact_length(states[-1]) / contact_length(states[0]),
        plastic_change=states[-1].plastic_area_fraction - states[0].plastic_area_fraction,
        edge_load_share=rough_contact.on_the_ends(states[-1]),
    )


def _along_y(
    rough_contact: HalfSpaceContact, contact_state: ContactState, slope: float, rows: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return the influence on the mean gap beyond the mean film [m], and share of A in contact, means over ``rows``
    cells along y."""
    assert contact_state.fields is not None
    gap = gap_influence(
        hertz_mean_gap(rough_contact, contact_state), line_load(rough_contact, contact_state), slope
    ) - gap_under(contact_state.mean_film)
    area = rough_contact.weight @ (contact_state.fields.pressure > 0) / rough_contact.weight.sum()
    return gap.reshape(-1, rows).mean(axis=1), area.reshape(-1, rows).mean(axis=1)


def _ratio(fine: np.ndarray, coarse: np.ndarray, step: float, correlation: float) -> tuple[float, float]:
    """Return the ratio of the means of two fields along y, and its relative standard error."""
    if not coarse.any() or not fine.any():
        return 1.0, math.nan
    ratio = float(fine.mean() / coarse.mean())
    return ratio, block_error(fine - ratio * coarse, step, correlation).value / float(fine.mean())


def mean_error(steps: Sequence[CellStep]) -> StandardError:
    """Return the error [m] of the mean change of the gap over several pieces.

    If the pieces are too short for blocks, it follows from the differences between them. Fewer than three of these have
    no scatter: it is taken to be as large as the changes themselves.
    """
    if all(math.isfinite(step.error.value) for step in steps):
        within = add_errors(*(step.error for step in steps))
        return StandardError(within.value / len(steps), within.freedom)
    gaps = np.array([step.gap_change for step in steps])
    few = gaps.size < FEWEST_PIECES
    scatter = float(np.sqrt(np.mean(gaps**2))) if few else float(np.std(gaps, ddof=1))
    return StandardError(scatter / math.sqrt(gaps.size), gaps.size if few else gaps.size - 1)


def remaining(changes: Sequence[float]) -> float:
    """Return the change by further halvings of the cells: the rest of a geometric series, from the ratio of the last
    two changes (1/4 to 3/4; 1/2 if there is only one change)."""
    last = abs(changes[-1])
    before = abs(changes[-2]) if len(changes) > 1 else 0.0
    ratio = ratio_of_changes(last, before, SERIES_RATIOS, UNKNOWN_CHANGE_RATIO)
    return last * ratio / (1 - ratio)


def predicted_next_change(changes: Sequence[float]) -> float:
    """Return the change by the next halving, from the ``changes`` d1 (and d2) by the last halvings, the last first.

    It is d1 r with r = d1/d2, kept between 1/8 (smooth, second order and better) and 1/2 (detail at every scale; also
    if there is no d2). It is at least d2/32, in case d1 is small by chance.
    """
    d1 = abs(changes[0])
    d2 = abs(changes[1]) if len(changes) > 1 else 0.0
    return max(d1 * ratio_of_changes(d1, d2, NEXT_RATIOS, UNKNOWN_CHANGE_RATIO), LEAST_NEXT_RATIO * d2)


def lost_summits(prepared: Prepared, point: Point, balance: Balance, sample: Sample) -> float:
    """Return the height [m] that the cells of ``sample`` take from the highest summit of the first piece, measured by
    its distance to the film above it."""
    assert balance.film is not None
    native, coarse = (
        point.pressed(contact_on_piece(prepared, sample, 0, coarsening=coarsening), balance.film, 0.0, None).mean_gap
        for coarsening in ((1, 1), sample.cells.coarsening)
    )
    return native - coarse
