"""The third and fourth level: what cells half as long, and half of that, change."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..._base import limited_work, work_left
from ...errors import ConvergenceError, TooManyCellsError
from ...samples import Sample
from ...scene import has_moving_roughness
from ..shared import Prepared, StandardError, contact_on_piece, is_smooth_over_cells
from .cells_in_motion import cells_of_strips
from .counted_work import MOST_WORK_OF_POINT
from .ladder import (
    LEAST_STRIP_ERROR,
    UNSOLVED_FACTOR,
    EndOfCells,
    continued,
    end_before,
    end_by,
    error_of_strip,
    expected_work,
    pays,
)
from .pieces import LENGTH_OF_LAST_PIECE, Piece, piece_on_quarter_cells, pieces_of_third_level
from .problem import check_number_of_cells
from .rough_bodies import map_of_contact
from .strip import (
    StripSolution,
    cautious_changes,
    changes_of,
    changes_of_patch,
    error_by_cells,
    error_of_patch,
    solve_strip,
)
from .strip_on_two_grids import (
    StripOnTwoGrids,
    halved,
    sample_coarsening_of,
    shortened,
    surface_and_map_coarsening,
)

# The comments state how results change with half and with twice the value of a constant, on three points of the scene
# "paper" (`python -m verification.campaigns.constants lubfric.models.deterministic.shorter_cells`).

# LU factorisations of a patch on shorter cells, at most [-]: those from a state nearby and from the dry contact. Of 128
# such solves of random patches of `python -m verification.campaigns.estimates` one took more, in steps in time, of
# which others took 150 to 500. A choice: a larger value solves a few of them, for ten times the work.
FACTORISATIONS_OF_SHORTER_CELLS = 90

# LU factorisations of a short strip on shorter cells, at most, all from the solution on longer ones [-]: 11 to 36 on
# 33,000 to 67,000 cells of measured maps, where they converge. A choice: other starts take as many again, and led
# nowhere.
FACTORISATIONS_OF_LAST_LEVEL = 60

# Part of the change of f on a piece of that length by which it may be off the mean over the surface [-]. A convention.
ERROR_OF_SHORT_PIECE = 0.5

# Part of the remaining work of a point that its pieces may take [-]: the rest is for the ends of input ranges. Half and
# twice this value change nothing.
PIECES_SHARE = 0.6

# Relative error of f above which a short piece goes on to still shorter cells [-]: on a ground map of 78 µm they
# reduced 50 to 180 % to 2 to 4 % in 3 to 6 s, and 8 % by little in 40 s. A choice: such an f does not tell designs
# apart.
LARGE_ERROR = 0.1


@dataclass(frozen=True, kw_only=True)
class ShorterCells:
    """What the third and the fourth level show of the effect of shorter cells.

    Attributes
    ----------
    pieces : those of the third level; (): it is not needed, or not solved
    shortest : the piece of the fourth level; empty: it is not needed, or not solved
    strip : the first strip itself on the shortest cells, if the sample refines in place; None: it is not solved on them
    sampling_error : of the mean relative change of f on ``pieces``, from place to place
    change : expected relative change of the sliding part of f by short cells where roughness moves, which are not
        solved
    error : relative error of f that the last cells leave
    end : why there are no shorter ones
    """

    pieces: tuple[Piece, ...] = ()
    shortest: Piece = Piece()
    strip: StripSolution | None = None
    sampling_error: StandardError = StandardError(0.0, 1)
    change: float = 0.0
    error: float
    end: EndOfCells = EndOfCells.NOT_NEEDED

    def all_of_sample(self, pairs: Sequence[StripOnTwoGrids]) -> StripSolution | None:
        """Return the only one of ``pairs`` on its shortest cells, if it is itself the only piece, at its own speed: all
        numbers of the sample are then those of this solution. None where pieces are other parts of the surface, or
        there are none."""
        if len(pairs) != 1 or len(self.pieces) != 1:
            return None
        last = self.shortest or self.pieces[0]
        first = pairs[0].resolved.result
        is_strip = all(piece.on_cells_of_strips.result is first for piece in (*self.pieces, last))
        return last.on_shortest_cells if is_strip else None


# What `on_shorter_cells` returns where none are solved, and another model states the error by the cells.
NO_SHORTER_CELLS = ShorterCells(error=LEAST_STRIP_ERROR)


@dataclass(frozen=True, kw_only=True)
class _ThirdLevel:
    """The pieces of the third level, and what they leave to the fourth.

    Attributes
    ----------
    changes : relative changes of f: from longer cells to those of the strips, and on to those of the pieces
    error : relative error of f that the cells of the pieces leave
    halvings : of cells, from those of the strips to native ones
    spent : counted work [s] of strips and pieces
    most : counted work [s] that is left to shorter cells
    sampling_error : as of `ShorterCells`
    """

    pieces: tuple[Piece, ...]
    changes: tuple[float, float]
    error: float
    halvings: int
    spent: float
    most: float
    sampling_error: StandardError

    def alone(self, end: EndOfCells, factor: float = 1.0) -> ShorterCells:
        """Return what these pieces show, with an ``end`` at them and this ``factor`` on the error."""
        return ShorterCells(pieces=self.pieces, sampling_error=self.sampling_error, error=factor * self.error, end=end)


def on_shorter_cells(prepared: Prepared, speed: float, pairs: Sequence[StripOnTwoGrids]) -> ShorterCells:
    """Solve the third and fourth level for ``pairs``, as far as ``numerics.tolerance`` needs them, if the roughness
    rests; where it moves, the effect of shorter cells is the expected one (`CellsInMotion`).

    - The third level is needed where the estimated error by the cells of the strips is above the tolerance, or where
      the heights are not smooth over a cell. Where it is not solved, because it does not converge or has too many
      cells, the error is `UNSOLVED_FACTOR` times the estimate.
    - The fourth level is needed where the third leaves more than the tolerance, and solved where it pays (`pays`). What
      it estimates from one short piece may be off by half.
    - A single patch has one piece: all of it, on shorter and shorter cells (`_patch_on_shorter_cells`).
    """
    by_longer = sum(pair.change_by_cells for pair in pairs) / len(pairs)
    strips = [pair.resolved for pair in pairs]
    if has_moving_roughness(prepared.scene):
        cells = cells_of_strips(prepared, strips, by_longer)
        return ShorterCells(change=cells.change_of_sliding, error=max(cells.error, LEAST_STRIP_ERROR))
    is_patch = prepared.sample.refines_in_place
    if is_patch:
        by_cells = error_of_patch(changes_of_patch((pairs[0].longer, pairs[0].resolved)))
    else:
        by_cells = error_by_cells([by_longer])
    error = max(by_cells, error_of_strip(strips[0]))
    if _are_enough(prepared, error):
        return ShorterCells(error=error)
    if is_patch:
        return _patch_on_shorter_cells(prepared, speed, pairs[0], error)
    try:
        third = _third_level(prepared, speed, pairs)
    except (ConvergenceError, TooManyCellsError) as failure:
        return ShorterCells(error=UNSOLVED_FACTOR * error, end=end_by(failure))
    if third.error <= prepared.scene.numerics.tolerance or third.halvings < 2:
        return third.alone(EndOfCells.NOT_NEEDED)
    if _continues_strip(prepared):
        return _strip_on_shorter_cells(prepared, speed, third)
    return _fourth_level(prepared, speed, third, pairs[0].resolved.slope)


def _third_level(prepared: Prepared, speed: float, pairs: Sequence[StripOnTwoGrids]) -> _ThirdLevel:
    """Return the third level for ``pairs`` at ``speed`` [m/s]. Raises `ConvergenceError` and `TooManyCellsError`."""
    scene = prepared.scene
    sample = prepared.sample
    with limited_work(PIECES_SHARE * work_left()):
        pieces, scatter = pieces_of_third_level(prepared, speed, pairs)
    by_longer = sum(pair.change_by_cells for pair in pairs) / len(pairs)
    change = abs(float(np.mean([piece.change for piece in pieces])))  # its error is reported
    if _continues_strip(prepared):  # that of a short strip is not
        (by_longer, change) = cautious_changes((by_longer, *changes_of(pieces[0].last_two)))
    coarsening = (s * n for s, n in zip(sample_coarsening_of(scene, sample), sample.cells.coarsening))
    halvings = round(math.log2(max(coarsening)))
    by_cells = error_by_cells((by_longer, change), max(halvings - 1, 1))
    spent = sum(pair.resolved.work for pair in pairs) + sum(strip.work for piece in pieces for strip in piece)
    most = PIECES_SHARE * work_left()
    if scene.numerics.max_work is None:
        most = min(most, MOST_WORK_OF_POINT - spent)
    return _ThirdLevel(
        pieces=pieces,
        changes=(by_longer, change),
        error=max(by_cells, error_of_strip(pieces[0].on_shortest_cells)),
        halvings=halvings,
        spent=spent,
        most=most,
        sampling_error=scatter,
    )


def _fourth_level(prepared: Prepared, speed: float, third: _ThirdLevel, slope: float) -> ShorterCells:
    """Return what one short piece shows on still shorter cells than those of the ``third`` level, if it pays; the
    strips have this ``slope`` of friction over load [-]."""
    sample = prepared.sample
    tolerance = prepared.scene.numerics.tolerance
    expected = _work_of_last_level(sample, third.pieces[0])
    if not pays(
        tolerance, third.changes, spent=third.spent, expected=expected, most=third.most, left=third.halvings - 1
    ):
        return third.alone(end_before(expected, third.most))
    try:
        with limited_work(third.most):
            shortest = piece_on_quarter_cells(prepared, speed, slope)
    except (ConvergenceError, TooManyCellsError) as failure:
        return third.alone(end_by(failure), UNSOLVED_FACTOR)
    changes = (third.changes[1], shortest.last_change)
    spent = sum(strip.work for strip in shortest)
    ladder = continued(
        shortest,
        _coarsening_of(sample, shortest.on_shortest_cells),
        shorten=halved,
        solve=_solver_of_short_piece(prepared, speed),
        error=_error_of_short_piece(shortest, changes, max(third.halvings - 2, 1)),
        # shorter cells do not reduce the error by its length
        tolerance=max(tolerance, _error_of_its_length(shortest), LARGE_ERROR),
        spent=third.spent + spent,
        most=third.most - spent,
        has_end=True,
    )
    error = ladder.error
    if len(ladder.strips) > len(shortest):
        shortest = ladder.piece(slope)
        error = math.hypot(max(error, _error_of_its_length(shortest)), _scatter_of_last_change(shortest))
    return ShorterCells(
        pieces=third.pieces,
        shortest=shortest,
        sampling_error=third.sampling_error,
        error=error,
        end=ladder.end,
    )


def _error_of_short_piece(shortest: Piece, changes: Sequence[float], left: int) -> float:
    """Return the relative error of f that the cells of the ``shortest`` piece leave, after ``changes`` of f from cells
    to cells; ``left``: as of `error_by_cells`."""
    at_least = max(_error_of_its_length(shortest), error_of_strip(shortest.on_shortest_cells))
    return math.hypot(max(error_by_cells(changes, left), at_least), _scatter_of_last_change(shortest))


def _error_of_its_length(shortest: Piece) -> float:
    """Return the part of the change of f on the ``shortest`` piece, relative, by which it may be off the mean over the
    surface."""
    (before, after) = (strip.result.coefficient for strip in shortest.from_half_cells)
    return ERROR_OF_SHORT_PIECE * abs(1 - before / after)


def _scatter_of_last_change(piece: Piece) -> float:
    """Return the relative standard error of the last change of f, by its scatter over the places of ``piece``."""
    return math.sqrt(max(changes_of(piece.last_two)[0] ** 2 - piece.last_change**2, 0.0))


def _coarsening_of(sample: Sample, strip: StripSolution) -> tuple[int, int]:
    """Return the lengths of the cells of ``strip`` along x and y in native ones."""
    (along, across) = (round(cell / native) for cell, native in zip(strip.result.spacing, sample.cells.native_spacing))
    return along, across


def _solver_of_short_piece(
    prepared: Prepared, speed: float
) -> Callable[[tuple[int, int], StripSolution], StripSolution]:
    """Return the function that solves the first short piece at ``speed`` [m/s] on cells of a coarsening, from a
    solution on longer ones. Raises `ConvergenceError` and `TooManyCellsError`."""

    def solve(coarsening: tuple[int, int], start: StripSolution) -> StripSolution:
        contact = contact_on_piece(prepared, prepared.sample, 0, coarsening=coarsening, length=LENGTH_OF_LAST_PIECE)
        surface = map_of_contact(prepared, contact)
        check_number_of_cells(surface, start.problem.line, (1, 1))
        most = FACTORISATIONS_OF_LAST_LEVEL
        return solve_strip(
            prepared.scene, surface, speed, start=start, memo=prepared.memo, most=most, most_from_start=most
        )

    return solve


def _continues_strip(prepared: Prepared) -> bool:
    """Return whether the shortest cells are solved on the strip itself, because it is no longer than their piece."""
    has_cells_left = surface_and_map_coarsening(prepared, 0)[1] != (1, 1)
    return has_cells_left and prepared.sample.piece_is_strip(LENGTH_OF_LAST_PIECE)


def _work_of_last_level(sample: Sample, piece: Piece) -> float:
    """Return the expected work [s] of the last level, a part of the ``piece`` on all of its cells and on shorter
    ones."""
    last = piece.on_shortest_cells
    length = last.result.load_at.size * last.result.spacing[1]
    share = min(LENGTH_OF_LAST_PIECE * sample.correlation_lengths[1] / length, 1.0)  # a short map is all of both pieces
    return share * (sum(strip.work for strip in piece) + expected_work(last, 4.0))


def _strip_on_shorter_cells(prepared: Prepared, speed: float, third: _ThirdLevel) -> ShorterCells:
    """Return what shorter cells than those of the ``third`` level show on all of a short strip, which is its first
    piece."""
    strip = third.pieces[0]
    ladder = continued(
        strip,
        prepared.sample.cells.coarsening,
        shorten=halved,
        solve=_solver_of_short_piece(prepared, speed),
        error=third.error,
        tolerance=prepared.scene.numerics.tolerance,
        spent=third.spent,
        most=third.most,
        has_end=True,
    )
    is_continued = len(ladder.strips) > len(strip)
    return ShorterCells(
        pieces=third.pieces,
        shortest=ladder.piece(strip.on_cells_of_strips.slope) if is_continued else Piece(),
        sampling_error=third.sampling_error,
        error=ladder.error,
        end=ladder.end,
    )


def _patch_on_shorter_cells(prepared: Prepared, speed: float, pair: StripOnTwoGrids, error: float) -> ShorterCells:
    """Return what shorter cells show on all of a patch, whose cells so far (``pair``) leave this estimated relative
    ``error``.

    Its cells are `shortened` until the estimated error is within ``numerics.tolerance`` (`continued`), with
    ``numerics.grid = "given"`` down to the map's own; within `MOST_WORK_OF_POINT` in a scene without
    ``numerics.max_work``.
    """
    scene = prepared.scene
    has_all = scene.numerics.grid == "given"
    (surface, map_coarsening) = surface_and_map_coarsening(prepared, 0)
    spent = pair.resolved.work
    most = PIECES_SHARE * work_left()
    if scene.numerics.max_work is None and not has_all:
        most = min(most, MOST_WORK_OF_POINT - spent)

    def solve(coarsening: tuple[int, int], start: StripSolution) -> StripSolution:
        check_number_of_cells(surface, start.problem.line, coarsening)
        return solve_strip(
            scene,
            surface,
            speed,
            map_coarsening=coarsening,
            memo=prepared.memo,
            start=start,
            most=FACTORISATIONS_OF_SHORTER_CELLS,
        )

    ladder = continued(
        (pair.longer, pair.resolved),
        map_coarsening,
        shorten=partial(shortened, scene, prepared.sample),
        solve=solve,
        error=error,
        tolerance=0.0 if has_all else scene.numerics.tolerance,
        spent=spent,
        most=most,
        is_first_needed=True,
    )
    if len(ladder.strips) == 2:
        return ShorterCells(error=ladder.error, end=ladder.end)
    patch = ladder.piece(pair.resolved.slope)
    return ShorterCells(pieces=(patch,), strip=patch.on_shortest_cells, error=ladder.error, end=ladder.end)


def _are_enough(prepared: Prepared, error: float) -> bool:
    """Return whether the cells of the strips, with this estimated ``error`` of f, are short enough, or native."""
    scene = prepared.scene
    sample = prepared.sample
    if sample.cells.is_native and sample_coarsening_of(scene, sample) == (1, 1):
        return True
    if error > scene.numerics.tolerance:
        return False
    if scene.numerics.grid == "given":
        return False
    return sample.refines_in_place or is_smooth_over_cells(sample.strip(0).heights)
