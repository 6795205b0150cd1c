"""Strips by the deterministic model on cells so long that a strip takes a second or less.

What such cells change of f is calibrated (`lubfric.models.quick.calibrated_error`). `features` are what that depends
on: they come from the same solves.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ..._base import may_stay_unsolved
from ...scene import Scene
from ...surface import Surface
from ..deterministic import (
    TIGHT,
    UNKNOWN_SLOPE,
    MovingEffort,
    RoughBody,
    SampleTarget,
    StripOnTwoGrids,
    StripSolution,
    effort_of,
    film_exponent_of,
    solve_moving_strip,
    solve_strip,
    strip_at_rest,
)
from ..shared import Memo

# Cells in a correlation length along x and along y, at least, where roughness rests: f differs from that on cells half
# as long by 1.4 % (median of 276 cases), and a strip takes .16 s. Measured by `verification.campaigns.calibration`; a
# choice between error and time.
CELLS_AT_REST = (2.5, 2.0)

# Cells in a correlation length along x and along y, at least, where roughness moves: f differs from that on cells half
# as long by 3.4 % (median of 198 cases), and a strip takes .7 s. Measured by `verification.campaigns.calibration`; a
# choice between error and time.
CELLS_IN_MOTION = (2.0, 1.25)

# Cells in a correlation length along x, in place of the first of `CELLS_IN_MOTION`, where f depends on the boundary
# film, because a film that long cells make too thin changes f most there: of 11 such cases cells twice as short along x
# explain half of the error, along y less. A step in time takes 1.5 times as long, and there are 1.5 times as many.
# Measured by `verification.campaigns.calibration`; a choice between error and time.
CELLS_OF_THIN_FILM = 3.0

# Change of f at rest by the boundary film, above which f counts as dependent on this film
# (`LongCellsInMotion.by_film`): with .2 the half-width where f depends on the film is 21 instead of 18 %, with .4 more;
# on the contacts of `verification.campaigns.calibration`.
THIN_BY_FILM = 0.05

# Cells in a correlation length along x and along y, and along x in the half-width, of the solved cases that move
# (verification/campaigns/calibration/case.py).
CELLS_OF_REFERENCES = (4.0, 2.5)

# Distance of f at rest from f_b, over f_b, below which f depends less on the boundary film the nearer it is to f_b [-]:
# with ten times as much the half-width where it does is 20 instead of 18 %, with none contacts whose asperities carry
# the load take twice as long; on the contacts of `verification.campaigns.calibration`.
NEAR_AT_REST = 0.03

# Effort in the place of `TIGHT`: steps end at ten times its residual, which goes into the next step. f of four rollers
# moves by up to 0.06 % at five times, their counted work falls by 15 to 25 %; ten times takes 2 to 18 % less than five,
# and f of ten rolling contacts moves by up to 0.23 %. A continuation discards as much as an economical one: then the
# ends of a range of the stress of an oil change f of two gear flanks by 20 to 43 % instead of 15 to 44 %. Chosen by
# these.
LOOSER_EFFORT = replace(TIGHT, residual=1e-3, carries_imbalance=True, linear=0.1, discarded_again=1.6)

# Cells in the Hertz half-width along x, at least, where roughness rests: as in the solved cases. Where it moves, there
# are as many as in a correlation length.
LONG_CELLS_OF_HALF_WIDTH = 2.0

# ln of f on cells twice as long, at most, that a feature takes as it is: beyond it, and where they have no solution,
# the change says only that it is large. A choice: a larger value lets single cases decide the fit.
MOST_BY_CELLS = 0.5

# Change of ln f on cells twice as long, at least, that a feature takes as it is: below, the solver's tolerance is as
# large. A choice: a smaller value lets the solver's error decide the fit.
LEAST_BY_CELLS = 0.01

# Change of ln f on cells twice as long at which the feature is 0. A convention.
MIDDLE_BY_CELLS = 0.05

# Relative length by which a cell may be longer than allowed: that of rounding. A choice: any number between rounding
# and a cell does.
ROUNDING = 1e-9

# Sliding part of f, at least, over which a change of f is taken. A choice, against a division by 0.
LEAST_SLIDING = 1e-9

# Change of f by the boundary film, from half to twice its thickness, that counts at most. A choice: a larger value lets
# single cases decide the fit.
MOST_BY_FILM = 4.0

# Change below which the cells of the boundary film are few and show little. Chosen with the features, by the
# likelihood.
LITTLE_BY_FILM = 0.1

# Distance of the sliding part of f from f_b, over f_b, at least: where f is f_b, no cell changes it. A choice: a
# smaller value lets the solver's error decide the fit.
LEAST_BELOW = 0.02

# Distance of the sliding part of f from f_b, over f_b, from which on it says nothing more in rolling. Chosen with the
# features, by the likelihood.
NEAR_FRICTION = 0.3

# What is added to it, so that its ln is finite. A choice: a smaller value lets the solver's error decide the fit.
LEAST_NEAR = 0.01

# Part of f by the gradient of the pressure over the sliding part that counts at most: f may be a small difference. A
# choice: a larger value lets single cases decide the fit.
MOST_ROLLING = 20.0

# Part of f by the gradient of the pressure over the sliding part, below which it says little of the scatter. Chosen by
# the likelihood of kinds that were left out: with the part itself in the place of the logarithm, eleven cases above 1
# had six times the scatter that they have.
LITTLE_ROLLING = 0.1


def map_coarsening_at_rest(
    scene: Scene, *, spacing: Sequence[float], rows: int, lengths: Sequence[float]
) -> tuple[int, int]:
    """Return the length of the long cells in those of a map of roughness at rest, of this ``spacing`` [m] and with so
    many ``rows`` along y, along both axes; ``lengths`` [m]: the correlation lengths. Along y it divides the map."""
    longest = min(lengths[0] / CELLS_AT_REST[0], scene.bodies.half_width / LONG_CELLS_OF_HALF_WIDTH)
    along = max(1, math.floor(longest / spacing[0] * (1 + ROUNDING)))
    return along, _divisor(rows, lengths[1] / CELLS_AT_REST[1] / spacing[1])


def _divisor(rows: int, most: float) -> int:
    """Return the largest divisor of ``rows`` that is no larger than ``most``, or 1."""
    largest = max(1, math.floor(most * (1 + ROUNDING)))
    return next(factor for factor in range(largest, 0, -1) if rows % factor == 0)


@dataclass(frozen=True, kw_only=True)
class LongCellsInMotion:
    """Rough bodies that move, on long cells.

    Attributes
    ----------
    bodies : their maps have the long cells along x, but not along y
    per_length : number of long cells along x in a correlation length
    map_coarsening : length of the long cells in those of these maps, (1, fy)
    effort : how accurately the film is followed
    rest : the strip at rest on these cells
    """

    bodies: tuple[RoughBody, ...]
    per_length: float
    map_coarsening: tuple[int, int]
    effort: MovingEffort
    rest: StripSolution

    @property
    def by_film(self) -> float:
        """The change of f at rest, from half to twice the boundary film, over its sliding part; less where that is near
        f_b, because no cell takes it beyond."""
        result = self.rest.result
        sliding = max(abs(result.coefficient - result.rolling / result.load), LEAST_SLIDING)
        below = max(1.0 - sliding / self.rest.problem.boundary_friction, 0.0)
        return abs(result.at_twice_film - result.at_half_film) / sliding * min(below / NEAR_AT_REST, 1.0)


def long_cells_in_motion(
    scene: Scene, bodies: Sequence[RoughBody], speed: float, lengths: Sequence[float]
) -> LongCellsInMotion:
    """Return rough ``bodies`` on the long cells for ``speed`` [m/s]: on those of `CELLS_IN_MOTION`, or, where f depends
    on the boundary film, on those of `CELLS_OF_THIN_FILM`. ``lengths`` [m]: the correlation lengths. Raises
    `ConvergenceError`."""
    cells = long_cells_of(scene, bodies, speed, lengths=lengths, per_length=CELLS_IN_MOTION[0])
    if cells.by_film <= THIN_BY_FILM:
        return cells
    return long_cells_of(scene, bodies, speed, lengths=lengths, per_length=CELLS_OF_THIN_FILM)


def long_cells_of(
    scene: Scene, bodies: Sequence[RoughBody], speed: float, *, lengths: Sequence[float], per_length: float
) -> LongCellsInMotion:
    """Return rough ``bodies`` on cells of which ``per_length`` along x are in a correlation length, and in the Hertz
    half-width; other arguments as of `long_cells_in_motion`."""
    (nx, ny) = bodies[0].surface.shape
    (along, across) = map_coarsening_in_motion(
        scene, spacing=bodies[0].surface.spacing, rows=ny, lengths=lengths, per_length=per_length
    )
    count = math.ceil(nx / along * (1 - ROUNDING))
    bodies = tuple(body._replace(surface=on_cells_along_x(body.surface, count)) for body in bodies)
    map_coarsening = (1, across)
    effort = effort_of(scene, bodies, speed, map_coarsening)
    effort = LOOSER_EFFORT if effort == TIGHT else effort
    rest = strip_at_rest(scene, bodies, speed, map_coarsening=map_coarsening, effort=effort)
    return LongCellsInMotion(
        bodies=bodies, per_length=per_length, map_coarsening=map_coarsening, effort=effort, rest=rest
    )


def map_coarsening_in_motion(
    scene: Scene, *, spacing: Sequence[float], rows: int, lengths: Sequence[float], per_length: float
) -> tuple[float, int]:
    """Return the length of the long cells where roughness moves, as `map_coarsening_at_rest` does at rest: along x they
    are as long as they may be, because the maps are laid out anew there. ``per_length``: as of `long_cells_of`."""
    longest = min(lengths[0], scene.bodies.half_width) / per_length
    return max(1.0, longest / spacing[0]), _divisor(rows, lengths[1] / CELLS_IN_MOTION[1] / spacing[1])


def on_cells_along_x(surface: Surface, count: int) -> Surface:
    """Return ``surface`` with so many cells along x in the same length, at whose centres its heights are read off its
    Fourier series, without smoothing. One that is not periodic is continued by its mirror image."""
    (nx, _) = surface.shape
    (dx, dy) = surface.spacing
    if count == nx:
        return surface
    heights = surface.heights
    if not surface.periodic_axes[0]:
        heights = np.concatenate([heights, heights[::-1]])
    period = heights.shape[0]
    waves = np.fft.rfft(heights, axis=0)
    waves[1 : (period + 1) // 2] *= 2.0  # those of negative frequency
    place = (np.arange(count) + 0.5) * nx / count - 0.5
    phases = np.exp(2j * np.pi * np.outer(place, np.fft.rfftfreq(period)))
    return replace(surface, heights=(phases @ waves).real / period, spacing=(nx * dx / count, dy), mask=None)


def solve_at_rest(
    scene: Scene,
    surface: Surface,
    speed: float,
    *,
    map_coarsening: tuple[int, int],
    slope: float = UNKNOWN_SLOPE,
    find_slope: bool = False,
    memo: Memo | None = None,
) -> StripOnTwoGrids:
    """Solve the strip ``surface`` at ``speed`` [m/s], not 0, on cells ``map_coarsening`` times as long as its own, and
    before on cells twice as long, where it has those and they have a solution (else both are the same). ``slope``: of
    friction over load, as another strip has it; ``find_slope``: it is found by a second solve in its place.
    ``memo``: as of `solve_strip`. Raises `ConvergenceError`."""
    (fx, fy) = map_coarsening
    solve = partial(solve_strip, scene, surface, speed, memo=memo)
    longer: StripSolution | None = None
    if surface.shape[1] % (2 * fy) == 0:
        with may_stay_unsolved():
            longer = solve(map_coarsening=(2 * fx, 2 * fy))
    strip = solve(map_coarsening=map_coarsening, start=longer, find_slope=find_slope)
    if not find_slope:
        strip = replace(strip, slope=slope)
    if longer is None:
        return StripOnTwoGrids.on_one_grid(strip)
    return StripOnTwoGrids(resolved=strip, longer=longer)


def solve_moving(
    scene: Scene, cells: LongCellsInMotion, speed: float, target: SampleTarget | None = None
) -> StripOnTwoGrids:
    """Solve the strip of rough bodies that move, at ``speed`` [m/s], not 0, on these ``cells``, until the ``target`` is
    reached (None: for a pass of the map). The second strip is at rest, from which the motion starts. Raises
    `ConvergenceError`."""
    strip = solve_moving_strip(
        scene,
        cells.bodies,
        speed,
        map_coarsening=cells.map_coarsening,
        target=target,
        effort=cells.effort,
        start=cells.rest,
    )
    return StripOnTwoGrids(resolved=strip, longer=strip.rest)


def numbers_for_features(pair: StripOnTwoGrids, length: float, *, is_smooth: bool) -> dict[str, float]:
    """Return the numbers of a strip by which `features` are found: parts of f, f at half and at twice the boundary
    film, and ln of the sliding part of f over that on longer cells, ``by_cells``, or, of moving roughness, at rest,
    ``by_motion`` (NaN: not known); ``coarse``, the cell along x over the correlation ``length`` [m], and ``smooth``, 1
    where heights are smooth over the cells of their map (`is_smooth_over_cells`), else 0."""
    result = pair.resolved.result
    is_moving = pair.resolved.moves
    longer = pair.longer.result
    rolling = result.rolling / result.load
    sliding = result.coefficient - rolling
    half = result.at_half_film
    twice = result.at_twice_film
    if is_moving:  # the gradient of pressure in cells that no longer rub is left out: it depends on which body is rough
        half = result.sliding_at_half_film + rolling
        twice = result.sliding_at_twice_film + rolling
    before = longer.coefficient - longer.rolling / longer.load
    is_known = sliding > 0 < before and not pair.is_on_one_grid
    change = math.log(sliding / before) if is_known else math.nan
    return {
        "coefficient": result.coefficient,
        "rolling": rolling,
        "at_half_film": half,
        "at_twice_film": twice,
        "by_cells": math.nan if is_moving else change,
        "by_motion": change if is_moving else math.nan,
        "coarse": pair.resolved.problem.spacing[0] / length,
        "smooth": float(is_smooth),
    }


def features(numbers: Mapping[str, float], boundary_friction: float) -> dict[str, float]:
    """Return what bias and σ may depend on, by name, for the ``numbers`` of a strip (`numbers_for_features`).

    ``boundary_friction``: f_b. The features are

    - "one"; "cells", by_cells between ± `MOST_BY_CELLS`, and "ln cells" of its size;
    - "film": c/(1 + c) of the change c of f by twice the boundary film instead of half of it, over the sliding part of
      f, and "ln film", ln(1 + c/`LITTLE_BY_FILM`);
    - "narrowed": change of ln of the sliding part of f with ln of the boundary film, between ± 1, times the square of
      the cell along x over that of `CELLS_OF_THIN_FILM`, where heights are smooth: long cells let too little lubricant
      into narrow gaps (`CellsInMotion`). "summits": that change where they are not, and shorter cells show new summits;
    - "ln rolling": ln(1 + r/`LITTLE_ROLLING`), with the part r of f by the gradient of the pressure over the sliding
      part;
    - "ln below": ln of how far the sliding part of f is below f_b, over f_b; "ln near": the same, to `NEAR_FRICTION`
      only.
    """
    sliding = max(numbers["coefficient"] - numbers["rolling"], LEAST_SLIDING)
    below = 1 - sliding / boundary_friction
    by_cells = numbers["by_cells"]
    size = MOST_BY_CELLS if math.isnan(by_cells) else min(abs(by_cells), MOST_BY_CELLS)
    by_film = min(abs(numbers["at_twice_film"] - numbers["at_half_film"]) / sliding, MOST_BY_FILM)
    half, twice = (numbers[f"at_{name}_film"] - numbers["rolling"] for name in ("half", "twice"))
    film_exponent = film_exponent_of(twice / half) if half > 0 < twice else 0.0
    return {
        "one": 1.0,
        "cells": 0.0 if math.isnan(by_cells) else math.copysign(size, by_cells),
        "ln cells": math.log(max(size, LEAST_BY_CELLS) / MIDDLE_BY_CELLS),
        "film": by_film / (1 + by_film),
        "ln film": math.log(1 + by_film / LITTLE_BY_FILM),
        "narrowed": film_exponent * (CELLS_OF_THIN_FILM * numbers["coarse"]) ** 2 * numbers["smooth"],
        "summits": film_exponent * (1.0 - numbers["smooth"]),
        "ln rolling": math.log(1 + min(abs(numbers["rolling"]) / sliding, MOST_ROLLING) / LITTLE_ROLLING),
        "ln below": math.log(max(below, LEAST_BELOW)),
        "ln near": math.log((min(max(below, 0.0), NEAR_FRICTION) + LEAST_NEAR) / NEAR_FRICTION),
    }
