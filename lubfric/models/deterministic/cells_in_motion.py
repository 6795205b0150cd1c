"""The effect of the cells on f where roughness moves: expected from measurements, because no shorter cells are
solved."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from ...quantities import names_with
from ...samples import Sample
from ..shared import Prepared, is_smooth_over_cells, with_rest_rolling
from .moving import film_half_width
from .result import DeterministicResult
from .rough_bodies import map_of_strip
from .strip import StripSolution

# The constants of the effect of the cells where roughness moves are fitted to `verification.campaigns.moving_cells`: f
# of narrow strips of random contacts on cells half as long along both axes, extrapolated by second order. They are
# judged by `verification.campaigns.moving_coverage`, on other contacts and surfaces. Shorter cells let more lubricant
# into the narrow gaps, by a part of their height that falls with the square of the cells: f changes as by a boundary
# film that is thinner. So the effect is in proportion to d ln f/d ln(boundary film).

# Part by which the narrow gaps are too small, over (cell/correlation length)² along x and along y [-]. Fitted to
# `verification.campaigns.moving_cells`.
NARROW_GAPS = (1.4, 0.35)

# Part of the effect of the narrow gaps by which single contacts differ from it, at 95 % [-]. On 12 of 13 Gaussian
# strips where ln f changes by more than 0.1 with ln of the film the root mean square is 0.42, narrow strips' own
# scatter included; 2.7 on one.
SCATTER_BY_CELLS = 0.7

# Relative error of f, at 95 %, that does not depend on the boundary film, over (cell along x/correlation length)² [-]:
# by steps of second order, and by steps along the lubricant, of third order. Nine contacts that depend on it little
# differ by 0.1 to 0.9 %.
ALONG_X = (0.3, 0.08)

# Relative error of f, at 95 %, that does not depend on the boundary film, over (cell along y/correlation length)² [-]:
# nine contacts with names differ by 0.02 to 0.4 %.
ALONG_Y = 0.016

# Relative error of f, at 95 %, because the pressure has few cells, over (cell along x/half-width) to the power of the
# order of the steps [-]: of second order, and along the lubricant of third. Between 6 and 12 cells in the half-width f
# of a separated contact changes by 3.2 %, between 7 and 14 by 2.7 %. The half-width is that of the smooth film where it
# is wider than the Hertz strip: of the scene "paper", Gaussian, at a slide-roll ratio of .1, f changes by .4 % and .7 %
# from 25 and 14 cells in that of the film (2.5 in the Hertz strip) to twice as many, at .1 and .03 m/s.
IN_HALF_WIDTH = (3.0, 14.0)

# Factor on the errors by ALONG_X and ALONG_Y where heights change from cell to cell (`is_smooth_over_cells`) [-].
# Measured with the next one.
UNSMOOTH = 5.0

# Factor on the effect of the narrow gaps there, and change of ln f with ln of the boundary film up to which the effect
# grows with it [-]: shorter cells show new summits, which act against it, and nothing is expected. Of twelve exponential
# surfaces on cells of 0.25 and 0.5 correlation lengths f changes by 5, 5 and 8 % where the latter is 0.05 to 0.12, by
# 19, 25, 1, 11, 20 and 13 % at 0.15 to 0.25, and by 9, 6 and 21 % at 0.30, 0.42 and 0.72.
UNSMOOTH_NARROWED = 10.0
STEEPEST_UNSMOOTH = 0.15

# Factor on the change of f from cells twice as long along y [-]: by second order a third of it is left. It follows from
# 1/(2² - 1), Richardson's extrapolation.
BY_LONGER = 1 / 3

# Change of ln f with ln of the boundary film, at most [-]: boundary friction in proportion to it has 1. It follows from
# boundary friction as the only sliding part.
STEEPEST = 1.0

# Factor on the part of the load that the film carries [-], by which the error by its cells is less where that is small.
# One map of a needle roller at .05, .3 and 1 m/s, whose film carries .07, .57 and 2.6 % of the load: f changes by .002,
# .07 and .32 % on cells half as long along x. With this factor the error is .2, 1.6 and 7.5 %, without it 9.3 %. A
# choice: a film may also change its load more.
OF_FILM_LOAD = 30.0

# Error by the cells on cells half as long along y, over that on the others, up to which these are solved [-]. A
# convention: the work is more than twice as much.
HALVED_ERROR = 0.8


@dataclass(frozen=True, kw_only=True)
class CellsInMotion:
    """What is known of the cells on which roughness moves, and their expected effect on f.

    Attributes
    ----------
    film_ratio : sliding part of f with twice the boundary film over that with half of it
    coarse_x, coarse_y : length of the cells over the correlation length
    coarse_b : length of the cells along x over the half-width of the Hertz strip, or of the smooth film where that is
        wider
    by_longer : relative change of f from cells twice as long along y
    follows_lubricant : whether steps were of third order along the lubricant
    is_smooth : whether the heights are smooth over the cells
    unlike : largest ratio of a correlation length to that by which the cells are judged (`unlikeness`)
    sliding_share : sliding part of f over f; the rest is the gradient of the pressure, which the film does not change
    film_share : part of the load on film that does not rub with f_b; 1: not known
    """

    film_ratio: float
    coarse_x: float
    coarse_y: float
    coarse_b: float
    follows_lubricant: bool
    is_smooth: bool
    by_longer: float = 0.0
    unlike: float = 1.0
    sliding_share: float = 1.0
    film_share: float = 1.0

    @classmethod
    def on_cells(
        cls,
        cell: tuple[float, float],
        *,
        lengths: tuple[float, float],
        half_width: float,
        film_ratio: float,
        follows_lubricant: bool,
        is_smooth: bool,
        by_longer: float = 0.0,
        unlike: float = 1.0,
        sliding_share: float = 1.0,
        film_share: float = 1.0,
    ) -> CellsInMotion:
        """Return what is known of cells of the lengths ``cell`` [m] along x and y, of roughness with the correlation
        ``lengths`` [m] in a contact of this ``half_width`` [m] (`film_half_width`); the others are fields."""
        return cls(
            film_ratio=film_ratio,
            coarse_x=cell[0] / lengths[0],
            coarse_y=cell[1] / lengths[1],
            coarse_b=cell[0] / half_width,
            follows_lubricant=follows_lubricant,
            is_smooth=is_smooth,
            by_longer=by_longer,
            unlike=unlike,
            sliding_share=sliding_share,
            film_share=film_share,
        )

    @property
    def film_exponent(self) -> float:
        """The change of ln of the sliding part of f with ln of the boundary film (`film_exponent_of`)."""
        return film_exponent_of(self.film_ratio)

    @property
    def of_narrow_gaps(self) -> float:
        """The relative change of the sliding part of f by a boundary film that is thicker by as much as the narrow gaps
        are too small."""
        return self._part_of_narrow_gaps * self.film_exponent

    @property
    def _error_of_narrow_gaps(self) -> float:
        """The relative error of the sliding part of f by the narrow gaps."""
        if self.is_smooth:
            return SCATTER_BY_CELLS * self.unlike * self.of_narrow_gaps
        exponent = min(abs(self.film_exponent), STEEPEST_UNSMOOTH)
        return UNSMOOTH_NARROWED * self._part_of_narrow_gaps * exponent

    @property
    def _part_of_narrow_gaps(self) -> float:
        """The part by which the narrow gaps are too small."""
        (along_x, along_y) = NARROW_GAPS
        return along_x * self.coarse_x**2 + along_y * self.coarse_y**2

    @property
    def change_of_sliding(self) -> float:
        """The expected relative change of the sliding part of f from the cells of an answer to short ones."""
        return math.expm1(-self.of_narrow_gaps) if self.is_smooth else 0.0

    @property
    def change(self) -> float:
        """The expected relative change of f."""
        return self.sliding_share * self.change_of_sliding

    @property
    def error(self) -> float:
        """The relative error of f after this change, at 95 %. Where nearly all of the load rubs with f_b, the sliding
        part of f depends little on the film, whose cells these are (`OF_FILM_LOAD`)."""
        of_film = 1.0 - self.sliding_share + self.sliding_share * min(1.0, OF_FILM_LOAD * self.film_share)
        of_roughness = ALONG_X[self.follows_lubricant] * self.coarse_x**2 + ALONG_Y * self.coarse_y**2
        return math.hypot(
            of_film * of_roughness * (1.0 if self.is_smooth else UNSMOOTH),
            of_film * IN_HALF_WIDTH[self.follows_lubricant] * self.coarse_b ** (3 if self.follows_lubricant else 2),
            self.sliding_share * self._error_of_narrow_gaps,
            BY_LONGER * self.by_longer,
        )

    def shorter_ones_pay(self, tolerance: float) -> bool:
        """Return whether the error is above ``tolerance``, and on cells half as long along y smaller by the part that
        pays (`HALVED_ERROR`)."""
        halved = replace(self, coarse_y=self.coarse_y / 2, by_longer=self.by_longer / 4)
        reduces = halved.error <= HALVED_ERROR * self.error
        return self.is_smooth and self.error > tolerance and reduces  # else shorter cells show new summits, along x too


def cells_in_motion(
    prepared: Prepared,
    strips: Sequence[StripSolution],
    cell: tuple[float, float],
    *,
    is_smooth: bool,
    by_longer: float = 0.0,
) -> CellsInMotion:
    """Return what is known of cells of the lengths ``cell`` [m] along x and y, where the roughness of ``strips`` moves;
    ``is_smooth``, ``by_longer``: fields."""
    results = [strip.result for strip in strips]
    return CellsInMotion.on_cells(
        cell,
        lengths=prepared.sample.lengths_by_slopes,
        unlike=unlikeness(prepared.sample),
        half_width=film_half_width(strips[0].problem.line),
        film_ratio=film_ratio_of(results),
        follows_lubricant=all(strip.follows_lubricant for strip in strips),
        is_smooth=is_smooth,
        by_longer=by_longer,
        sliding_share=sliding_share_of(results),
        film_share=1.0 - sum(result.split.rubbing / result.load for result in results) / len(results),
    )


def unlikeness(sample: Sample) -> float:
    """Return the largest ratio of the correlation lengths of ``sample`` along x and y to those by which cells are
    judged [-].

    Narrow gaps are as sharp as the slopes are steep. Where two bodies have unlike lengths, the sample has the longer
    ones, and the shorter ones make the slopes. By the longer ones 0.6, 0.6 and 1.5 % were expected on three narrow strips
    whose f was too high by 4.4, 3.5 and 9.8 %; by the slopes 1.8, 1.4 and 5.4 %.
    """
    return max(length / by_slopes for length, by_slopes in zip(sample.correlation_lengths, sample.lengths_by_slopes))


def cells_of_strips(prepared: Prepared, strips: Sequence[StripSolution], by_longer: float) -> CellsInMotion:
    """Return what is known of the cells that ``strips`` are solved on; ``by_longer``: as of `CellsInMotion`."""
    is_smooth = is_smooth_over_cells(map_of_strip(prepared, 0).heights)
    return cells_in_motion(prepared, strips, strips[0].problem.spacing, is_smooth=is_smooth, by_longer=by_longer)


def film_exponent_of(film_ratio: float) -> float:
    """Return the change of ln of the sliding part of f with ln of the boundary film, between ± `STEEPEST`, where that
    part changes by the factor ``film_ratio`` from half of the film to twice the film; 0 where it changes its sign."""
    slope = math.log(film_ratio) / math.log(4.0) if film_ratio > 0 else 0.0
    return min(max(slope, -STEEPEST), STEEPEST)


def film_ratio_of(results: Sequence[DeterministicResult]) -> float:
    """Return the sliding part of f with twice the boundary film over that with half of it, of these ``results``
    together; 1 where f does not slide."""
    half = sum(result.sliding_at_half_film for result in results)
    twice = sum(result.sliding_at_twice_film for result in results)
    return twice / half if half else 1.0


def sliding_share_of(results: Sequence[DeterministicResult]) -> float:
    """Return the sliding part of f over f, of these ``results`` together; 1 where f is 0."""
    f = sum(result.coefficient for result in results)
    rolling = sum(result.rolling / result.load for result in results)
    return 1.0 - rolling / f if f else 1.0


def changed_as_expected(numbers: dict[str, float], change: float, rolling: float) -> dict[str, float]:
    """Return ``numbers`` of a point with the sliding part of f, its forces and the asperity load changed by this
    relative ``change``; where the load does not suffice for that, the film's force has all of it. ``rolling`` [N]: the
    part of f on the strips that does not slide."""
    if not change:
        return numbers
    load = numbers["film_load"] + numbers["contact_load"]
    sliding = load * numbers["coefficient"] - rolling
    changed = numbers | {"coefficient": numbers["coefficient"] + change * sliding / load}
    if (1.0 + change) * numbers["contact_load"] > load:
        return with_rest_rolling(changed | {"couette_force": numbers["couette_force"] + change * sliding}, load)
    changed |= {name: (1.0 + change) * numbers[name] for name in names_with("follows_sliding")}
    changed["film_load"] = load - changed["contact_load"]
    return with_rest_rolling(changed, load)
