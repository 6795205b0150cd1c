"""The third and fourth level: what cells half as long, and half of that, change, seen on pieces of the surface.

Relative to f that change depends little on speed, far less than it scatters, unless the film is about as thick as the
boundary film (`SPEED_MATTERS`). So pieces are solved at the nearest of fixed speeds, on which neighbouring points of a
curve share them; these follow from the scene alone.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ..._base import limited_work, may_stay_unsolved, work_left
from ...errors import ConvergenceError, LubfricError, TooManyCellsError, WorkLimitError
from ...quantities import names_with
from ...samples import PIECE_LENGTH, Sample
from ...scene import has_moving_roughness
from ..shared import (
    Prepared,
    ShorterCellsKey,
    StandardError,
    block_error,
    contact_on_piece,
    is_smooth_over_cells,
    speed_of,
    with_divided_sliding,
)
from .cells_in_motion import cells_of_strips
from .counted_work import MOST_WORK_OF_POINT
from .problem import are_soft, check_number_of_cells
from .rough_bodies import map_of_contact
from .strip import (
    UNKNOWN_SLOPE,
    StripSolution,
    cautious_changes,
    changes_of,
    error_by_cells,
    expected_error_after,
    line_contact_of,
    solve_strip,
)
from .strip_on_two_grids import (
    MapCoarsening,
    StripOnTwoGrids,
    longer_than,
    numbers_of_strip,
    sample_coarsening_of,
    shortened,
    surface_and_map_coarsening,
)

# The effects of half and twice a constant are those on three points of the scene "paper" (`python -m
# verification.campaigns.constants lubfric.models.deterministic.shorter_cells`).

# Part of numerics.sampling_tolerance: standard error that the effect of the cells may leave [-]. Half takes 25 % more time
# and moves f by 0.8 %, within the stated error; twice widens the interval by 4 %.
PIECES_SAMPLING_SHARE = 0.7

# Pieces, at most [-]. Half and twice change nothing.
MOST_SOLVED_PIECES = 32

# Counted work [s] of pieces beyond which no more are solved: a quarter of `MOST_WORK_OF_POINT`. Half and twice change
# nothing.
PIECES_WORK = 30.0

# LU factorisations of a piece on longer cells, from which it starts, at most [-]. Half and twice change nothing.
FACTORISATIONS_OF_START = 100

# LU factorisations of a patch on shorter cells, at most [-]: those from a state nearby and from the dry contact. Of 128 such solves
# of random patches of `python -m verification.campaigns.estimates` one took more, in steps in time, of which others took 150 to
# 500. A choice: more solves a few of them, for ten times the work.
FACTORISATIONS_OF_SHORTER_CELLS = 90

# LU factorisations of a short strip on shorter cells, at most, all from the solution on longer ones [-]: 11 to 36 on 33,000 to
# 67,000 cells of measured maps, where they converge. A choice: other starts take as many again, and led nowhere.
FACTORISATIONS_OF_LAST_LEVEL = 60

# Relative error of f that the tolerance of a strip may leave [-]: twice the change of f by it (`strip.STRIP_RESIDUAL`).
# Half and twice change the interval by 0.02 %.
LEAST_STRIP_ERROR = 2e-3

# Length [correlation lengths] below which a strip serves as a piece. Half changes nothing, twice f by -0.3 %.
LENGTH_OF_SHORT_STRIP = 60.0

# Length [correlation lengths] of the piece on the shortest cells, those of the last level: a third of `PIECE_LENGTH`. Half and
# twice change nothing on these points, which do not need it.
LENGTH_OF_LAST_PIECE = 14.0

# Part of the change of f on a piece of that length by which it may be off the mean over the surface [-]. A convention.
ERROR_OF_SHORT_PIECE = 0.5

# Ratio of the expected films at neighbouring fixed speeds [-]. Twice moves f by 0.9 %, within the stated error. A
# choice: less takes more pieces.
FIXED_FILM_RATIO = 2.0

# Relative change of f by twice the boundary film [-] above which pieces are solved at the speed of the point itself: a
# soft roller whose film is just thicker (f 0.0037, 0.013 by twice) was corrected to 0.0111 by pieces at half the speed,
# whose film is not.
SPEED_MATTERS = 1.0

# Part of the work that a point has left, which its pieces may take [-]: the rest is for the ends of input
# ranges. Half and twice change nothing.
PIECES_SHARE = 0.6

# Factor on the estimated effect of shorter cells where these were not solved [-]. A convention.
UNSOLVED_FACTOR = 2.0

# Counted work of a Newton step on cells half as long over that on the longer ones and over the ratio of their numbers [-]: measured
# 1.1 to 1.9 on two measured maps.
FINER_WORK = 1.4

# Work of a solve on shorter cells over the expected, at which it ends [-]: .55 to 1.2 where it converges on the same. A choice.
MOST_OVER_EXPECTED = 2.5

# Counted work [s] of shorter cells that is done even where the error will be above the tolerance: they make it smaller. A choice
# between time and that error.
CHEAP_WORK = 15.0

# Relative error of f above which a short piece goes on to still shorter cells [-]: on a ground map of 78 µm they reduced 50 to 180 %
# to 2 to 4 % in 3 to 6 s, and 8 % by little in 40 s. A choice: such an f does not tell designs apart.
LARGE_ERROR = 0.1

# Newton steps that a solve on cells half as long is expected to take [-], or twice those on the longer ones if these are fewer:
# measured 11 to 24 on the same, 6 and 7 on a patch of 1 GPa.
STEPS_ON_FINER_CELLS = 16

# Error of f of soft bodies at rest over (cell along x over Hertz half-width)², at least [-]. Their film builds up in
# the Hertz strip itself, and changes of f from cells to cells may have either sign: 1.5, 3, 6 and 12 cells in the
# half-width of a roller of E' 19 GPa give f of .00652, .00682, .00590, .00574 at Λ 1.0, and .01114, .01029, .01001,
# .01000 at Λ 2.2. Chosen to cover these.
SOFT_CELL_ERROR = 1.5


class Piece(tuple[StripSolution, ...]):
    """A piece of the surface, solved on shorter and shorter cells: twice as long as those of the strips, as long, and half as
    long each time."""

    @property
    def on_cells_of_strips(self) -> StripSolution:
        """The piece on cells as long as those of the strips."""
        return self[1]

    @property
    def on_shortest_cells(self) -> StripSolution:
        """The piece on its shortest cells."""
        return self[-1]

    @property
    def last_two(self) -> tuple[StripSolution, StripSolution]:
        """The piece on cells twice as long as the shortest, and on these."""
        return self[-2], self[-1]

    @property
    def from_half_cells(self) -> tuple[StripSolution, StripSolution]:
        """The piece on cells half as long as those of the strips, and on the shortest."""
        return self[2], self[-1]

    @property
    def last_change(self) -> float:
        """Relative change of f by the last halving of the cells, without its sign."""
        (longer, shorter) = (strip.result.coefficient for strip in self.last_two)
        return abs(1 - longer / shorter)

    @property
    def change(self) -> float:
        """Relative change of f from the cells of the strips to the shortest."""
        return self.on_shortest_cells.result.coefficient / self.on_cells_of_strips.result.coefficient - 1


@dataclass(frozen=True, kw_only=True)
class ShorterCells:
    """What the third and the fourth level show of the effect of shorter cells.

    Attributes
    ----------
    pieces : those of the third level; (): it is not needed, or not solved
    shortest : the piece of the fourth level; empty: it is not needed, or not solved
    strip : the first strip itself on the shortest cells, if the sample refines in place; None: it is not solved on them
    sampling_error : of the mean relative change of f on ``pieces``, from place to place
    change : expected relative change of the sliding part of f by short cells where roughness moves, which are not solved
    error : relative error of f that the last cells leave
    has_unsolved : whether shorter cells were needed, and did not converge or would have taken too much work
    lacks_work : whether they would have taken more work than there is
    has_too_many : whether shorter cells were needed, and are more than `MOST_GRID_CELLS`
    has_ended : whether shorter cells were needed, and did not pay (`_pays`)
    """

    pieces: tuple[Piece, ...] = ()
    shortest: Piece = Piece()
    strip: StripSolution | None = None
    sampling_error: StandardError = StandardError(0.0, 1)
    change: float = 0.0
    error: float
    has_unsolved: bool = False
    lacks_work: bool = False
    has_too_many: bool = False
    has_ended: bool = False

    def all_of_sample(self, pairs: Sequence[StripOnTwoGrids]) -> StripSolution | None:
        """Return the only one of ``pairs`` on its shortest cells, if it is itself the only piece, at its own speed: all numbers
        of the sample are then those of this solution. None where pieces are other parts of the surface, or there are none."""
        if len(pairs) != 1 or len(self.pieces) != 1:
            return None
        last = self.shortest or self.pieces[0]
        first = pairs[0].resolved.result
        is_strip = all(piece.on_cells_of_strips.result is first for piece in (*self.pieces, last))
        return last.on_shortest_cells if is_strip else None


# What `on_shorter_cells` returns where none are solved, and another model states the error by the cells.
NO_SHORTER_CELLS = ShorterCells(error=LEAST_STRIP_ERROR)


def on_shorter_cells(prepared: Prepared, speed: float, pairs: Sequence[StripOnTwoGrids]) -> ShorterCells:
    """Solve the third and fourth level for ``pairs``, as far as ``numerics.tolerance`` needs them, if the roughness
    rests; where it moves, the effect of shorter cells is the expected one (`CellsInMotion`).

    - The third level is needed where the estimated error by the cells of the strips is above the tolerance, or where the
      heights are not smooth over a cell. Where it is not solved, because it does not converge or has too many cells, the
      error is `UNSOLVED_FACTOR` times the estimate.
    - The fourth level is needed where the third leaves more than the tolerance, and solved where it pays (`_pays`). What it
      estimates from one short piece may be off by half.
    - A single patch has one piece: all of it, on shorter and shorter cells (`_patch_on_shorter_cells`).
    """
    scene = prepared.scene
    sample = prepared.sample
    tolerance = scene.numerics.tolerance
    is_moving = has_moving_roughness(scene)
    by_longer = sum(pair.change_by_cells for pair in pairs) / len(pairs)
    strips = [pair.resolved for pair in pairs]
    if is_moving:
        cells = cells_of_strips(prepared, strips, by_longer)
        return ShorterCells(change=cells.change_of_sliding, error=max(cells.error, LEAST_STRIP_ERROR))
    error = max(error_by_cells([by_longer]), LEAST_STRIP_ERROR, error_of_soft_bodies(strips[0]))
    if _are_enough(prepared, error):
        return ShorterCells(error=error)
    if sample.refines_in_place:
        return _patch_on_shorter_cells(prepared, speed, pairs[0], error)
    try:
        with limited_work(PIECES_SHARE * work_left()):
            pieces, scatter = _third_level(prepared, speed, pairs)
    except ConvergenceError as failure:
        lacks_work = isinstance(failure, WorkLimitError)
        return ShorterCells(error=UNSOLVED_FACTOR * error, has_unsolved=True, lacks_work=lacks_work)
    except TooManyCellsError:
        return ShorterCells(error=UNSOLVED_FACTOR * error, has_too_many=True)
    change = abs(float(np.mean([piece.change for piece in pieces])))  # its error is reported
    if is_continued := _continues_strip(prepared):  # that of a short strip is not
        (by_longer, change) = cautious_changes((by_longer, *changes_of(pieces[0].last_two)))
    coarsening = (s * n for s, n in zip(sample_coarsening_of(scene, sample), sample.cells.coarsening))
    halvings = round(math.log2(max(coarsening)))  # from the cells of the strips to native ones
    floor = max(LEAST_STRIP_ERROR, error_of_soft_bodies(pieces[0].on_shortest_cells))
    error = max(error_by_cells((by_longer, change), max(halvings - 1, 1)), floor)
    if error <= tolerance or halvings < 2:
        return ShorterCells(pieces=pieces, sampling_error=scatter, error=error)
    spent = sum(pair.resolved.work for pair in pairs) + sum(strip.work for piece in pieces for strip in piece)
    most = PIECES_SHARE * work_left()
    if scene.numerics.max_work is None:
        most = min(most, MOST_WORK_OF_POINT - spent)
    if is_continued:
        return _strip_on_shorter_cells(prepared, speed, pieces, scatter, error=error, spent=spent, most=most)
    expected = _work_of_last_level(sample, pieces[0])
    if not _pays(tolerance, (by_longer, change), spent=spent, expected=expected, most=most, left=halvings - 1):
        lacks_work = expected > most
        return ShorterCells(pieces=pieces, sampling_error=scatter, error=error, has_ended=True, lacks_work=lacks_work)
    try:
        with limited_work(most):
            slope = pairs[0].resolved.slope
            shortest = _refined(prepared, speed, 0, slope=slope, times=4, length=LENGTH_OF_LAST_PIECE)
    except (ConvergenceError, TooManyCellsError) as failure:
        has_too_many = isinstance(failure, TooManyCellsError)
        return ShorterCells(
            pieces=pieces,
            sampling_error=scatter,
            error=UNSOLVED_FACTOR * error,
            has_unsolved=not has_too_many,
            lacks_work=isinstance(failure, WorkLimitError),
            has_too_many=has_too_many,
        )
    error = _error_of_short_piece(shortest, (change, shortest.last_change), max(halvings - 2, 1))
    spent_on_shortest = sum(strip.work for strip in shortest)
    ladder = _continued(
        shortest,
        _coarsening_of(sample, shortest.on_shortest_cells),
        shorten=_halved,
        solve=_solver_of_short_piece(prepared, speed),
        error=error,
        # shorter cells do not reduce the error by its length
        tolerance=max(tolerance, _error_of_its_length(shortest), LARGE_ERROR),
        spent=spent + spent_on_shortest,
        most=most - spent_on_shortest,
        has_end=True,
    )
    if len(ladder.strips) > len(shortest):
        shortest = ladder.piece(slope)
        error = math.hypot(max(ladder.error, _error_of_its_length(shortest)), _scatter_of_last_change(shortest))
    return ShorterCells(pieces=pieces, shortest=shortest, sampling_error=scatter, error=error)


def _error_of_short_piece(shortest: Piece, changes: Sequence[float], left: int) -> float:
    """Return the relative error of f that the cells of the ``shortest`` piece leave, after ``changes`` of f from cells to cells;
    ``left``: as of `error_by_cells`."""
    floor = max(LEAST_STRIP_ERROR, error_of_soft_bodies(shortest.on_shortest_cells))
    by_cells = max(error_by_cells(changes, left), _error_of_its_length(shortest), floor)
    return math.hypot(by_cells, _scatter_of_last_change(shortest))


def _error_of_its_length(shortest: Piece) -> float:
    """Return the part of the change of f on the ``shortest`` piece, relative, by which it may be off the mean over the surface."""
    (before, after) = (strip.result.coefficient for strip in shortest.from_half_cells)
    return ERROR_OF_SHORT_PIECE * abs(1 - before / after)


def _scatter_of_last_change(piece: Piece) -> float:
    """Return the relative standard error of the last change of f, by its scatter over the places of ``piece``."""
    return math.sqrt(max(changes_of(piece.last_two)[0] ** 2 - piece.last_change**2, 0.0))


def _coarsening_of(sample: Sample, strip: StripSolution) -> tuple[int, int]:
    """Return the lengths of the cells of ``strip`` along x and y in native ones."""
    (along, across) = (round(cell / native) for cell, native in zip(strip.result.spacing, sample.cells.native_spacing))
    return along, across


def _halved(coarsening: tuple[int, int]) -> tuple[int, int]:
    """Return half the ``coarsening``, at least 1."""
    return max(1, coarsening[0] // 2), max(1, coarsening[1] // 2)


def _solver_of_short_piece(
    prepared: Prepared, speed: float
) -> Callable[[tuple[int, int], StripSolution], StripSolution]:
    """Return the function that solves the first short piece at ``speed`` [m/s] on cells of a coarsening, from a solution on longer
    ones. Raises `ConvergenceError` and `TooManyCellsError`."""

    def solve(coarsening: tuple[int, int], start: StripSolution) -> StripSolution:
        contact = contact_on_piece(prepared, prepared.sample, 0, coarsening=coarsening, length=LENGTH_OF_LAST_PIECE)
        surface = map_of_contact(prepared, contact)
        check_number_of_cells(surface, start.problem.line, (1, 1))
        most = FACTORISATIONS_OF_LAST_LEVEL
        return solve_strip(
            prepared.scene, surface, speed, start=start, memo=prepared.memo, most=most, most_from_start=most
        )

    return solve


def _pays(
    tolerance: float,
    changes: Sequence[float],
    *,
    spent: float,
    expected: float,
    most: float,
    most_halvings: int = 1,
    left: float = math.inf,
) -> bool:
    """Return whether cells half as long are worth their ``expected`` work [s] after ``changes`` of f from cells to cells, on which a
    point has ``spent`` so much [s].

    They are solved within ``most`` of the work [s]: where they at most double the work of the point, or take no more than
    `CHEAP_WORK`, or where they, or up to ``most_halvings`` in all, lead to an error within ``tolerance``, if
    the changes go on to fall as the last two did. ``left``: as of `error_by_cells`, before them.
    """
    if expected > most:
        return False
    if expected <= max(spent, CHEAP_WORK):
        return True
    times_work = 4 * FINER_WORK
    return any(
        expected_error_after(changes, halvings, left) <= tolerance
        for halvings in range(1, most_halvings + 1)
        if expected * sum(times_work**k for k in range(halvings)) <= most
    )


def _continues_strip(prepared: Prepared) -> bool:
    """Return whether the shortest cells are solved on the strip itself, because it is no longer than their piece."""
    has_cells_left = surface_and_map_coarsening(prepared, 0)[1] != (1, 1)
    return has_cells_left and prepared.sample.piece_is_strip(LENGTH_OF_LAST_PIECE)


def _work_of_last_level(sample: Sample, piece: Piece) -> float:
    """Return the expected work [s] of the last level, a part of the ``piece`` on all of its cells and on shorter ones."""
    last = piece.on_shortest_cells
    length = last.result.load_at.size * last.result.spacing[1]
    share = min(LENGTH_OF_LAST_PIECE * sample.correlation_lengths[1] / length, 1.0)  # a short map is all of both pieces
    return share * (sum(strip.work for strip in piece) + _expected_work(last, 4.0))


def _expected_work(longer: StripSolution, times_cells: float) -> float:
    """Return the expected work [s] of a solve on so many ``times_cells`` as those of the strip on ``longer`` cells."""
    steps = max(longer.result.report.iterations, 1)
    return min(STEPS_ON_FINER_CELLS, 2 * steps) * FINER_WORK * times_cells * longer.work / steps


@dataclass(frozen=True, kw_only=True)
class Ladder:
    """A map on shorter and shorter ``strips``; other attributes as of `ShorterCells`."""

    strips: tuple[StripSolution, ...]
    error: float
    has_unsolved: bool = False
    lacks_work: bool = False
    has_too_many: bool = False
    has_ended: bool = False

    def piece(self, slope: float) -> Piece:
        """Return the strips as a piece, with this ``slope`` of friction over load [-]."""
        return Piece(replace(one, slope=slope) for one in self.strips)


def _continued(
    strips: Sequence[StripSolution],
    coarsening: tuple[int, int],
    *,
    shorten: Callable[[tuple[int, int]], tuple[int, int]],
    solve: Callable[[tuple[int, int], StripSolution], StripSolution],
    error: float,
    tolerance: float,
    spent: float,
    most: float,
    is_first_needed: bool = False,
    has_end: bool = False,
) -> Ladder:
    """Return a map on the cells of ``strips``, the last of which are as long as ``coarsening`` says, and on shorter and shorter ones,
    until the estimated ``error`` is within ``tolerance`` or shorter ones do not pay (`_pays`).

    Where they do not converge, are too many, or take more than ``most`` [s], those before count, and the error is `UNSOLVED_FACTOR`
    times the estimate from them.

    Parameters
    ----------
    shorten : returns the next ``coarsening``, or the same where there is none
    solve : solves on cells of a coarsening, from the solution on longer ones
    error : as estimated from ``strips``
    tolerance : 0: all cells are solved
    spent : counted work [s] of the point so far
    is_first_needed : whether the first of the shorter cells are solved in any case
    has_end : whether the answer is for the shortest cells (``left`` of `error_by_cells`)
    """
    ladder = list(strips)
    failure: LubfricError | None = None
    has_ended = False
    lacks_work = False
    with limited_work(most):
        while (shorter := shorten(coarsening)) != coarsening and (error > tolerance or is_first_needed):
            left = math.ceil(math.log2(max(coarsening)))
            expected = _expected_work(ladder[-1], math.prod(coarsening) / math.prod(shorter))
            has_ended = not (
                is_first_needed
                or tolerance == 0
                or _pays(
                    tolerance,
                    changes_of(ladder),
                    spent=spent,
                    expected=expected,
                    most=work_left(),
                    most_halvings=left,
                    left=left if has_end else math.inf,
                )
            )
            if has_ended:
                lacks_work = expected > work_left()
                break
            try:
                with limited_work(min(work_left(), MOST_OVER_EXPECTED * expected) if has_end else work_left()):
                    strip = solve(shorter, ladder[-1])
            except (ConvergenceError, TooManyCellsError) as exception:
                failure = exception
                break
            ladder.append(strip)
            coarsening = shorter
            spent += strip.work
            is_first_needed = False
            by_cells = error_by_cells(changes_of(ladder))
            if has_end:
                by_cells = error_by_cells(cautious_changes(changes_of(ladder)), max(left - 1, 1))
            error = max(by_cells, LEAST_STRIP_ERROR, error_of_soft_bodies(strip))
    has_too_many = isinstance(failure, TooManyCellsError)
    return Ladder(
        strips=tuple(ladder),
        error=error if failure is None else UNSOLVED_FACTOR * error,
        has_unsolved=failure is not None and not has_too_many,
        lacks_work=lacks_work or isinstance(failure, WorkLimitError),
        has_too_many=has_too_many,
        has_ended=has_ended,
    )


def _strip_on_shorter_cells(
    prepared: Prepared,
    speed: float,
    pieces: tuple[Piece, ...],
    scatter: StandardError,
    *,
    error: float,
    spent: float,
    most: float,
) -> ShorterCells:
    """Return what shorter cells show on all of a short strip, which is the first of the ``pieces``, with these estimated numbers;
    arguments as of `_continued`."""
    scene = prepared.scene
    sample = prepared.sample

    ladder = _continued(
        pieces[0],
        sample.cells.coarsening,
        shorten=_halved,
        solve=_solver_of_short_piece(prepared, speed),
        error=error,
        tolerance=scene.numerics.tolerance,
        spent=spent,
        most=most,
        has_end=True,
    )
    slope = pieces[0].on_cells_of_strips.slope
    is_continued = len(ladder.strips) > len(pieces[0])
    return ShorterCells(
        pieces=pieces,
        shortest=ladder.piece(slope) if is_continued else Piece(),
        sampling_error=scatter,
        error=ladder.error,
        has_unsolved=ladder.has_unsolved,
        lacks_work=ladder.lacks_work,
        has_too_many=ladder.has_too_many,
        has_ended=ladder.has_ended,
    )


def _patch_on_shorter_cells(prepared: Prepared, speed: float, pair: StripOnTwoGrids, error: float) -> ShorterCells:
    """Return what shorter cells show on all of a patch, whose cells so far (``pair``) leave this estimated relative ``error``.

    Its cells are `shortened` until the estimated error is within ``numerics.tolerance`` (`_continued`), with ``numerics.grid =
    "given"`` down to the map's own; within `MOST_WORK_OF_POINT` in a scene without ``numerics.max_work``.
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

    ladder = _continued(
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
    unsolved = ShorterCells(
        error=ladder.error,
        has_unsolved=ladder.has_unsolved,
        lacks_work=ladder.lacks_work,
        has_too_many=ladder.has_too_many,
        has_ended=ladder.has_ended,
    )
    if len(ladder.strips) == 2:
        return unsolved
    patch = ladder.piece(pair.resolved.slope)
    return replace(unsolved, pieces=(patch,), strip=patch.on_shortest_cells)


def error_of_soft_bodies(strip: StripSolution) -> float:
    """Return the relative error of f that the cells of a ``strip`` of soft bodies (`are_soft`) may leave at least, because
    they are long for the Hertz strip; 0 for other bodies."""
    problem = strip.problem
    if not are_soft(problem.line, float(problem.heights.std())):
        return 0.0
    return SOFT_CELL_ERROR * (problem.spacing[0] / problem.line.half_width) ** 2


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


def _third_level(
    prepared: Prepared, speed: float, pairs: Sequence[StripOnTwoGrids]
) -> tuple[tuple[Piece, ...], StandardError]:
    """Return the pieces of the third level, and the standard error of their mean relative change of f."""
    sample = prepared.sample
    is_short = sample.strip_length < LENGTH_OF_SHORT_STRIP * sample.correlation_lengths[1]
    if is_short and surface_and_map_coarsening(prepared, 0)[1] != (1, 1):
        return _pieces(prepared, speed, pairs[0])
    if _by_boundary_film([pair.resolved for pair in pairs]) > SPEED_MATTERS:
        return _pieces(prepared, speed, None)
    return _at_fixed_speed(prepared, speed)


def _by_boundary_film(strips: Sequence[StripSolution]) -> float:
    """Return the relative change of f by twice the boundary film."""
    results = [strip.result for strip in strips]
    return sum(abs(result.at_twice_film / result.coefficient - 1) for result in results) / len(results)


def changed_by_pieces(
    prepared: Prepared, numbers: dict[str, float], pieces: Sequence[tuple[StripSolution, StripSolution]]
) -> dict[str, float]:
    """Return ``numbers`` of a point as shorter cells change them: each by its ratio on ``pieces``, each on the longer
    and the shorter cells; the loads by that of their ratio, and the force of the film such that the forces add up to f."""
    if not pieces:
        return numbers
    rows = [[numbers_of_strip(prepared, strip.result) for strip in level] for level in zip(*pieces)]
    before, after = ({name: float(np.mean([row[name] for row in level])) for name in numbers} for level in rows)
    new = {
        name: value * after[name] / before[name] if before[name] else value + after[name]
        for name, value in numbers.items()
    }
    load = prepared.scene.bodies.load
    new |= {name: numbers[name] for name in names_with("is_left_by_cells")}
    load_ratio = new["contact_load"] / new["film_load"] if new["film_load"] > 0 else math.inf
    new["contact_load"] = load / (1 + 1 / load_ratio) if load_ratio else 0.0
    new["film_load"] = load - new["contact_load"]
    if numbers["contact_load"] > 0:
        new["boundary_force"] = numbers["boundary_force"] * new["contact_load"] / numbers["contact_load"]
    new = with_divided_sliding(new, numbers, load)
    if prepared.surface.sq > 0:
        new["film_to_roughness_ratio"] = new["central_film"] / prepared.surface.sq
    return new


def _at_fixed_speed(prepared: Prepared, speed: float) -> tuple[tuple[Piece, ...], StandardError]:
    """Return the pieces at the nearest fixed speed; at ``speed`` itself where a given film arrives at any speed, or
    where they cannot be solved there."""
    scene = prepared.scene
    sample = prepared.sample
    sq = prepared.surface.sq
    if scene.lubricant.inlet_film is not None:
        return _pieces(prepared, speed, None)
    step = round(math.log(scene.line_contact(abs(speed)).expected_film / sq, FIXED_FILM_RATIO))

    def make() -> tuple[tuple[Piece, ...], StandardError] | None:
        fixed_speed = math.copysign(speed_of(scene, sq * FIXED_FILM_RATIO**step), speed)
        try:
            return _pieces(prepared, fixed_speed, None)
        except WorkLimitError:  # not of that speed: a point with more work left solves it
            raise
        except LubfricError:  # at that speed: heat may leave no film there
            return None

    def cells(made: tuple[tuple[Piece, ...], StandardError] | None) -> int:
        return sum(one.problem.heights.size for piece in made[0] for one in piece) if made else 0

    pieces = prepared.memo.get(
        ShorterCellsKey(coarsening=sample.cells.coarsening, step=step, is_forward=speed > 0), make, cells
    )
    return pieces or _pieces(prepared, speed, None)


def _pieces(prepared: Prepared, speed: float, first: StripOnTwoGrids | None) -> tuple[tuple[Piece, ...], StandardError]:
    """Return the pieces at ``speed`` [m/s] until the standard error of their mean relative change of f is small;
    ``first``: the strip that is the first of them (None: all are pieces)."""
    sample = prepared.sample
    tolerance = PIECES_SAMPLING_SHARE * prepared.scene.numerics.sampling_tolerance
    pieces: list[Piece] = []
    error = StandardError(math.inf, 0)
    spent = 0.0
    while len(pieces) < min(sample.available_pieces, MOST_SOLVED_PIECES) and not (
        error.value <= tolerance or spent > PIECES_WORK
    ):
        if pieces:
            pieces.append(_refined(prepared, speed, len(pieces), slope=pieces[0].on_cells_of_strips.slope))
        else:
            pieces.append(_refined(prepared, speed, 0, first=first, find_slope=True))
        error = _error(pieces, sample)
        spent += sum(strip.work for strip in pieces[-1])
    return tuple(pieces), error


def _refined(
    prepared: Prepared,
    speed: float,
    index: int,
    *,
    first: StripOnTwoGrids | None = None,
    slope: float = UNKNOWN_SLOPE,
    find_slope: bool = False,
    times: int = 2,
    length: float = PIECE_LENGTH,
) -> Piece:
    """Return piece ``index`` of the surface, solved on cells twice as long as those of the strips, on cells as long,
    and then on cells half as long each time, down to so many ``times`` as short as those of the strips.

    Parameters
    ----------
    first : the strip that serves as the piece, solved on the first two lengths of cells; None: a piece is made
    slope : of friction over load [-], as another piece has it
    find_slope : whether it is found in its place: on the ``first`` strip, or by a second solve
    length : of a piece that is made, in correlation lengths

    Raises `ConvergenceError`, and `TooManyCellsError` before anything is solved.
    """
    scene = prepared.scene
    sample = prepared.sample
    surface, map_coarsening = surface_and_map_coarsening(prepared, index)
    if first is not None:
        check_number_of_cells(surface, first.resolved.problem.line, (1, 1))
        ladder = [first.longer, first.resolved]
    else:
        coarsening = tuple(m * n for m, n in zip(map_coarsening, sample.cells.coarsening))
        last = max(1, coarsening[0] // times), max(1, coarsening[1] // times)
        map_coarsening = MapCoarsening((coarsening[0] // last[0], coarsening[1] // last[1]))
        surface = map_of_contact(prepared, contact_on_piece(prepared, sample, index, coarsening=last, length=length))
        check_number_of_cells(surface, line_contact_of(scene, speed), (1, 1))
        longer: StripSolution | None = None
        solve = partial(solve_strip, scene, surface, speed, memo=prepared.memo)
        with may_stay_unsolved():  # it is a start only, and cells so long may have no solution
            longer = solve(map_coarsening=longer_than(surface, map_coarsening), most=FACTORISATIONS_OF_START)
        strip = solve(map_coarsening=map_coarsening, start=longer, find_slope=find_slope)
        ladder = [strip if longer is None else longer, strip]
    while map_coarsening != (1, 1):
        map_coarsening = MapCoarsening(_halved(map_coarsening))
        ladder.append(
            solve_strip(scene, surface, speed, map_coarsening=map_coarsening, start=ladder[-1], memo=prepared.memo)
        )
    slope = ladder[1].slope if find_slope else slope
    return Piece(replace(one, slope=slope) for one in ladder)


def _error(pieces: Sequence[Piece], sample: Sample) -> StandardError:
    """Return the standard error of the mean relative change of f from the cells of the second level to the last ones,
    from place to place."""
    changes = []
    for piece in pieces:
        base = piece.on_cells_of_strips
        last = piece.on_shortest_cells
        places = last.deviations.reshape(base.result.load_at.size, -1).mean(axis=1) - base.deviations
        changes.append((places + last.result.coefficient - base.result.coefficient) / abs(base.result.coefficient))
    dy = pieces[0].on_cells_of_strips.problem.spacing[1]
    return block_error(np.concatenate(changes), dy, sample.correlation_lengths[1])
