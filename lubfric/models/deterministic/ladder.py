"""One map on shorter and shorter cells, until the change of f is small or still shorter cells do not pay."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from enum import Enum

from ..._base import limited_work, work_left
from ...errors import ConvergenceError, TooManyCellsError, WorkLimitError
from .pieces import Piece
from .problem import are_soft
from .strip import (
    StripSolution,
    cautious_changes,
    changes_of,
    changes_of_patch,
    error_by_cells,
    error_of_patch,
    expected_error_after,
)

# The comments state how results change with half and with twice the value of a constant, on three points of the scene
# "paper" (`python -m verification.campaigns.constants lubfric.models.deterministic.ladder`).

# Relative error of f that the tolerance of a strip may leave [-]: twice the change of f by it (`strip.STRIP_RESIDUAL`).
# Half and twice this value change the interval by 0.02 %.
LEAST_STRIP_ERROR = 2e-3

# Factor on the estimated effect of shorter cells where these were not solved [-]. A convention.
UNSOLVED_FACTOR = 2.0

# Counted work of a Newton step on cells half as long over that on the longer ones and over the ratio of their numbers
# [-]: measured 1.1 to 1.9 on two measured maps.
FINER_WORK = 1.4

# Work of a solve on shorter cells over the expected work, at which the solve ends [-]: .55 to 1.2 where it converged on
# these maps. A choice.
MOST_OVER_EXPECTED = 2.5

# Counted work [s] of shorter cells that is done even where the error will remain above the tolerance: shorter cells
# reduce it. A choice between time and that error.
CHEAP_WORK = 15.0

# Newton steps that a solve on cells half as long is expected to take [-], or twice those on the longer ones if these
# are fewer: measured 11 to 24 on these maps, 6 and 7 on a patch of 1 GPa.
STEPS_ON_FINER_CELLS = 16

# Error of f of soft bodies at rest over (cell along x over Hertz half-width)², at least [-]. Their film builds up in
# the Hertz strip itself, and changes of f from cells to cells may have either sign: 1.5, 3, 6 and 12 cells in the
# half-width of a roller of E' 19 GPa give f of .00652, .00682, .00590, .00574 at Λ 1.0, and .01114, .01029, .01001,
# .01000 at Λ 2.2. Chosen to cover these.
SOFT_CELL_ERROR = 1.5


class EndOfCells(Enum):
    """Why no cells shorter than the last ones are solved."""

    NOT_NEEDED = "the error is within the tolerance, or there are none"
    UNSOLVED = "they did not converge"
    UNSOLVED_WITHIN_WORK = "they did not converge within the work of the point"
    TOO_MANY = "they are more than are solved at most"
    NOT_WORTHWHILE = "they would leave the error above the tolerance"
    TOO_MUCH_WORK = "they would take more work than the point has"

    @property
    def is_failure(self) -> bool:
        """Whether shorter cells were begun without a solution."""
        return self in (EndOfCells.UNSOLVED, EndOfCells.UNSOLVED_WITHIN_WORK, EndOfCells.TOO_MANY)

    @property
    def lacks_work(self) -> bool:
        """Whether a point with more work would have them."""
        return self in (EndOfCells.UNSOLVED_WITHIN_WORK, EndOfCells.TOO_MUCH_WORK)


def end_by(failure: ConvergenceError | TooManyCellsError) -> EndOfCells:
    """Return the end that this ``failure`` of a solve on shorter cells is."""
    if isinstance(failure, TooManyCellsError):
        return EndOfCells.TOO_MANY
    if isinstance(failure, WorkLimitError):
        return EndOfCells.UNSOLVED_WITHIN_WORK
    return EndOfCells.UNSOLVED


def end_before(expected: float, work: float) -> EndOfCells:
    """Return the end that cells which are not begun are, with ``expected`` [s] of the ``work`` [s] that there is."""
    return EndOfCells.TOO_MUCH_WORK if expected > work else EndOfCells.NOT_WORTHWHILE


@dataclass(frozen=True, kw_only=True)
class Ladder:
    """A map on shorter and shorter cells.

    Attributes
    ----------
    strips : the solutions, on the longest cells first
    error : relative error of f that the last cells leave
    end : why there are no shorter ones
    """

    strips: tuple[StripSolution, ...]
    error: float
    end: EndOfCells

    def piece(self, slope: float) -> Piece:
        """Return the strips as a piece, with this ``slope`` of friction over load [-]."""
        return Piece(replace(one, slope=slope) for one in self.strips)


def continued(
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
    """Return a map on the cells of ``strips``, the last of which are as long as ``coarsening`` says, and on shorter and
    shorter ones, until the estimated ``error`` is within ``tolerance`` or shorter ones do not pay (`pays`).

    Where they do not converge, are too many, or take more than ``most`` [s], those before count, and the error is
    `UNSOLVED_FACTOR` times the estimate from them.

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
    end = EndOfCells.NOT_NEEDED
    is_needed = is_first_needed or tolerance == 0
    with limited_work(most):
        while (shorter := shorten(coarsening)) != coarsening and (error > tolerance or is_needed):
            left = math.ceil(math.log2(max(coarsening)))
            expected = expected_work(ladder[-1], math.prod(coarsening) / math.prod(shorter))
            is_worthwhile = is_needed or pays(
                tolerance,
                changes_of(ladder),
                spent=spent,
                expected=expected,
                most=work_left(),
                most_halvings=left,
                left=left if has_end else math.inf,
            )
            if not is_worthwhile:
                end = end_before(expected, work_left())
                break
            left_to_point = work_left()
            most_of_solve = min(left_to_point, MOST_OVER_EXPECTED * expected) if has_end else left_to_point
            try:
                with limited_work(most_of_solve):
                    strip = solve(shorter, ladder[-1])
            except WorkLimitError:
                is_of_point = most_of_solve == left_to_point  # else more than a solve that converges takes
                end = EndOfCells.UNSOLVED_WITHIN_WORK if is_of_point else EndOfCells.UNSOLVED
                break
            except (ConvergenceError, TooManyCellsError) as failure:
                end = end_by(failure)
                break
            ladder.append(strip)
            coarsening = shorter
            spent += strip.work
            is_needed = tolerance == 0
            if has_end:
                by_cells = error_by_cells(cautious_changes(changes_of(ladder)), max(left - 1, 1))
            else:
                by_cells = error_of_patch(changes_of_patch(ladder))
            error = max(by_cells, error_of_strip(strip))
    if end.is_failure:
        error *= UNSOLVED_FACTOR
    return Ladder(strips=tuple(ladder), error=error, end=end)


def pays(
    tolerance: float,
    changes: Sequence[float],
    *,
    spent: float,
    expected: float,
    most: float,
    most_halvings: int = 1,
    left: float = math.inf,
) -> bool:
    """Return whether cells half as long are worth their ``expected`` work [s] after ``changes`` of f from cells to
    cells, on which a point has ``spent`` so much [s].

    They are solved within ``most`` of the work [s]: where they at most double the work of the point, or take no more
    than `CHEAP_WORK`, or where they, or up to ``most_halvings`` in all, lead to an error within ``tolerance``, if the
    changes go on to fall as the last two did. ``left``: as of `error_by_cells`, before them.
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


def expected_work(longer: StripSolution, times_cells: float) -> float:
    """Return the expected work [s] of a solve on so many ``times_cells`` as those of the strip on ``longer`` cells."""
    steps = max(longer.result.report.iterations, 1)
    return min(STEPS_ON_FINER_CELLS, 2 * steps) * FINER_WORK * times_cells * longer.work / steps


def error_of_soft_bodies(strip: StripSolution) -> float:
    """Return the relative error of f that the cells of a ``strip`` of soft bodies (`are_soft`) may leave at least,
    because they are long for the Hertz strip; 0 for other bodies."""
    problem = strip.problem
    if not are_soft(problem.line, float(problem.heights.std())):
        return 0.0
    return SOFT_CELL_ERROR * (problem.spacing[0] / problem.line.half_width) ** 2


def error_of_strip(strip: StripSolution) -> float:
    """Return the relative error of f that the tolerance of a ``strip``, and its cells if the bodies are soft, leave at
    least."""
    return max(LEAST_STRIP_ERROR, error_of_soft_bodies(strip))
