"""Pieces of the surface on shorter and shorter cells: what short cells change of f, without all strips on them.

Relative to f that change depends little on speed, far less than it scatters, unless the film is about as thick as the
boundary film (`SPEED_MATTERS`). So pieces are solved at the nearest of fixed speeds, on which neighbouring points of a
curve share them; these follow from the scene alone.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from ..._base import may_stay_unsolved
from ...errors import LubfricError, WorkLimitError
from ...quantities import names_with
from ...samples import PIECE_LENGTH, Sample
from ..shared import (
    Prepared,
    ShorterCellsKey,
    StandardError,
    block_error,
    contact_on_piece,
    speed_of,
    with_divided_sliding,
    with_forces_of_film,
)
from .problem import check_number_of_cells
from .rough_bodies import map_of_contact
from .strip import UNKNOWN_SLOPE, StripSolution, line_contact_of, solve_strip
from .strip_on_two_grids import (
    MapCoarsening,
    StripOnTwoGrids,
    halved,
    longer_than,
    numbers_of_strip,
    surface_and_map_coarsening,
)

# The comments state how results change with half and with twice the value of a constant, on three points of the scene
# "paper" (`python -m verification.campaigns.constants lubfric.models.deterministic.pieces`).

# Part of numerics.sampling_tolerance: standard error that the effect of the cells may leave [-]. Half this value takes
# 25 % more time and moves f by 0.8 %, within the stated error; twice this value widens the interval by 4 %.
PIECES_SAMPLING_SHARE = 0.7

# Pieces, at most [-]. Half and twice this value change nothing.
MOST_SOLVED_PIECES = 32

# Counted work [s] of pieces beyond which no more are solved: a quarter of `MOST_WORK_OF_POINT`. Half and twice this
# value change nothing.
PIECES_WORK = 30.0

# LU factorisations of a piece on longer cells, from which it starts, at most [-]. Half and twice this value change
# nothing.
FACTORISATIONS_OF_START = 100

# Length [correlation lengths] below which a strip serves as a piece. Half this value changes nothing, twice this value
# changes f by -0.3 %.
LENGTH_OF_SHORT_STRIP = 60.0

# Length [correlation lengths] of the piece on the shortest cells, those of the last level: a third of `PIECE_LENGTH`.
# Half and twice this value change nothing on these points, which do not need it.
LENGTH_OF_LAST_PIECE = 14.0

# Ratio of the expected films at neighbouring fixed speeds [-]. Twice moves f by 0.9 %, within the stated error. A
# choice: a smaller value takes more pieces.
FIXED_FILM_RATIO = 2.0

# The parts of the shear force of the film that shorter cells change.
PARTS_OF_FILM = ("couette_force", "rolling_force")

# Relative change of f by twice the boundary film [-] above which pieces are solved at the speed of the point itself: a
# soft roller whose film is just thicker (f 0.0037, 0.013 by twice) was corrected to 0.0111 by pieces at half the speed,
# whose film is not.
SPEED_MATTERS = 1.0


class Piece(tuple[StripSolution, ...]):
    """A piece of the surface, solved on shorter and shorter cells: twice as long as those of the strips, as long, and
    half as long each time."""

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


def pieces_of_third_level(
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
        map_coarsening = MapCoarsening(halved(map_coarsening))
        ladder.append(
            solve_strip(scene, surface, speed, map_coarsening=map_coarsening, start=ladder[-1], memo=prepared.memo)
        )
    slope = ladder[1].slope if find_slope else slope
    return Piece(replace(one, slope=slope) for one in ladder)


def piece_on_quarter_cells(prepared: Prepared, speed: float, slope: float) -> Piece:
    """Return one short piece at ``speed`` [m/s], down to cells a quarter as long as those of the strips, which have
    this ``slope``. Raises `ConvergenceError` and `TooManyCellsError`."""
    return _refined(prepared, speed, 0, slope=slope, times=4, length=LENGTH_OF_LAST_PIECE)


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


def changed_by_pieces(
    prepared: Prepared, numbers: dict[str, float], pieces: Sequence[tuple[StripSolution, StripSolution]]
) -> dict[str, float]:
    """Return ``numbers`` of a point as shorter cells change them: each by its ratio on ``pieces``, each on the longer
    and the shorter cells; the loads by that of their ratio. The film has the force that is left of f, in parts that
    have the ratios of the pieces too (`_with_parts_of_film`). The smallest film is the least of all cells: a ratio
    would make it thinner than the gap of touching cells."""
    if not pieces:
        return numbers
    rows = [[numbers_of_strip(prepared, strip.result) for strip in level] for level in zip(*pieces)]
    before, after = ({name: float(np.mean([row[name] for row in level])) for name in numbers} for level in rows)
    new = {
        name: value * after[name] / before[name] if before[name] else value + after[name]
        for name, value in numbers.items()
    }
    load = prepared.scene.bodies.load
    load_ratio = new["contact_load"] / new["film_load"] if new["film_load"] > 0 else math.inf
    new["contact_load"] = load / (1 + 1 / load_ratio) if load_ratio else 0.0
    new["film_load"] = load - new["contact_load"]
    if numbers["contact_load"] > 0:
        new["boundary_force"] = numbers["boundary_force"] * new["contact_load"] / numbers["contact_load"]
    of_pieces = {name: new[name] for name in PARTS_OF_FILM}
    new |= {name: numbers[name] for name in names_with("is_left_by_cells")}
    new["min_film"] = min(numbers["min_film"], after["min_film"])
    new = _with_parts_of_film(new, of_pieces, load) or with_divided_sliding(new, numbers, load)
    if prepared.surface.sq > 0:
        new["film_to_roughness_ratio"] = new["central_film"] / prepared.surface.sq
    return new


def _with_parts_of_film(numbers: dict[str, float], parts: dict[str, float], load: float) -> dict[str, float] | None:
    """Return ``numbers`` whose forces add up to ``coefficient`` times the ``load`` [N], the force of the film in
    proportion to its ``parts`` (`PARTS_OF_FILM`) on pieces; None where one of these is against this force.

    Shorter cells move load from the film to asperities, and both parts of its force with it. On a roller of 0.6 GPa and
    Sq 0.6 µm at 1.16 m/s the rolling part falls from 6.2 to 1.9 N, the sliding one from 18 to 4.6 N. With the rolling
    part of the longer cells 0.03 N would be left to slide, and at half the speed the asperity load would be 772 N for
    932 N.
    """
    changed = with_forces_of_film(numbers, load)
    force = changed["shear_force"]
    if not all(force * part > 0 for part in parts.values()):
        return None
    share = force / sum(parts.values())
    return changed | {name: share * part for name, part in parts.items()}
