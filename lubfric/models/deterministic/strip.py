"""A rough surface under the bodies of a scene at one speed: a strip of it on one grid, and on finer and finer grids,
with an estimate of the error that is left."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..._base import may_stay_unsolved
from ...film import LineContact
from ...oil import Lubricant
from ...scene import Scene, check_resolved_gap, moving_bodies
from ...surface import Surface
from ..shared import Memo, film_lubricant, ratio_of_changes
from .counted_work import work_of_steps
from .problem import BOUNDARY_FILM, Problem, lay_out, shifted
from .result import DeterministicResult, assemble, share_moved_by_hardness
from .solve import FACTORISATIONS_FROM_NEARBY, MOST_FACTORISATIONS, refined_start, solve_point
from .state import evaluated
from .time_and_place import Places, TimeAndPlace

# The comments state how results change with half and with twice the value of a constant, on three points of the scene
# "paper" (`python -m verification.campaigns.constants lubfric.models.deterministic.strip.`).

# Tolerance of a strip's residuals [-]. A choice: a smaller value takes more steps. Half and twice this value change f
# by up to .3 % and the work by up to 8 % (constants.csv).
STRIP_RESIDUAL = 3e-3

# The `StripSolution.slope` of a strip where it is not known: none was looked for.
UNKNOWN_SLOPE = math.nan

# Tolerance of the residuals on longer cells, from which a strip starts [-]. Half and twice this value change nothing.
LONGER_CELLS_RESIDUAL = 1e-2

# Cells from which a strip is solved on longer ones first [-]. A choice: fewer cells converge from the dry contact.
MANY_CELLS = 12_000

# Load of the second solve, for the slope, over that of the first [-]. Far from 1 the slope is a secant: 2.06 changes f
# by 3 %, because more strips are solved then. A choice: nearer to 1 the tolerance of a solve has an effect.
SECOND_LOAD = 1.03

# Ratios of successive changes from grid to grid between which they are taken to fall [-]. Half this value changes
# nothing, twice this value changes the interval by .2 %.
CHANGE_RATIOS = (0.25, 0.75)

# The least of these ratios with which the changes on a patch are continued, which is solved completely on every grid
# [-]. A choice: with it the error covers f on the cells of the map in 143 of 146 solves of 109 random patches that end
# before these, at tolerances of .5 to 4 %.
LEAST_RATIO_OF_PATCH = 0.6

# Ratio of successive changes from grid to grid of a single strip [-], below which the last may be small by chance. A
# choice: on the ridges of a measured map f changes by -5.2, +.3 and +.5 %.
LEAST_FALL = 0.1

# Ratio of successive changes from grid to grid, at most, where their series ends at native cells [-]: 1.7 to 2.2 was
# seen at 110 N on cells from 1.8 to 0.45 µm. A choice between these.
GROWING = 2.0

# Ratio of successive changes from grid to grid where there is one change only [-]: as measured on cells of 3.6, 1.8 and
# 0.9 µm of the built-in surface.
UNKNOWN_RATIO = 0.6

# Columns of the coarser of two grids in a part of the strip that changes independently [-]. Half and twice this value
# change the interval by .01 %.
COLUMNS_OF_A_PLACE = 2


@dataclass(frozen=True, kw_only=True)
class StripSolution:
    """A strip that is solved by the deterministic model: at rest, or moving (`MovingStripSolution`), under one
    contract.

    Attributes
    ----------
    problem, result : what was solved, and its fields and forces
    slope : dF/dw of friction and load at one h0 [-], from a second solve at a load 3 % larger (`solve_strip` with
        ``find_slope``), or of another strip; `UNKNOWN_SLOPE`: not known
    work : counted work of all its solves [s] (`work_of`)
    """

    problem: Problem
    result: DeterministicResult
    slope: float
    work: float

    def share_moved(self, hardness: float, other: float) -> float:
        """Return the `share_moved_by_hardness` from a ``hardness`` [Pa] to the ``other`` one."""
        return share_moved_by_hardness(self.result.pressure, hardness, other)

    @property
    def moves(self) -> bool:
        """Whether its roughness moved through the film, so that its numbers are means over time."""
        return False

    @property
    def at_rest(self) -> StripSolution:
        """This strip with its roughness at rest."""
        return self

    @property
    def places_over_time(self) -> TimeAndPlace | None:
        """Friction and load of all places at all moments that count; None where the roughness rests."""
        return None

    @property
    def follows_lubricant(self) -> bool:
        """Whether the lubricant passed one cell in a step in time, so that the steps are of third order along it."""
        return False

    @property
    def moment_in_words(self) -> str:
        """Which moment its fields are of, as text; "" where nothing moves."""
        return ""

    def change_from(self, longer: StripSolution) -> float:
        """Return the change of f (`change_of_places`) from this strip on ``longer`` cells, at rest, to this one."""
        return change_of(longer.result, self.result)

    def coefficient_with_oil(self, name: str, end: int) -> float | None:
        """Return f if the films were sheared as the oil at an ``end``, 0 or 1, of the range of the input of this
        ``name``; None where that is not known without a solve."""
        return None

    def at_inputs(self, scene: Scene, speed: float, make_map: Callable[[], Surface]) -> DeterministicResult:
        """Return the result at the inputs of another ``scene`` with the same surface and motion, from this solution on.

        ``make_map``: makes the map of this strip, if it is needed. Raises `ConvergenceError`.
        """
        strip = make_map()
        dx, dy = self.problem.spacing
        map_coarsening = (round(dx / strip.spacing[0]), round(dy / strip.spacing[1]))
        return solve_strip(
            scene, strip, speed, map_coarsening=map_coarsening, start=self, memo=self.problem.memo
        ).result

    @property
    def compared_result(self) -> DeterministicResult:
        """The result of this strip that `at_inputs` is compared with."""
        return self.result

    @property
    def deviations(self) -> np.ndarray:
        """(F_i - slope (w_i - w) - F)/w of every column i along y (ny,), with a mean of 0: what f of places deviates by
        if the load is balanced."""
        friction = self.result.friction_at
        load = self.result.load_at
        return (friction - friction.mean() - self.slope * (load - load.mean())) / self.result.load


def solve_strip(
    scene: Scene,
    surface: Surface,
    speed: float,
    *,
    map_coarsening: tuple[int, int] = (1, 1),
    start: StripSolution | None = None,
    find_slope: bool = False,
    tolerance: float = STRIP_RESIDUAL,
    upper: Surface | None = None,
    ends: tuple[float, float] | None = None,
    most: int = MOST_FACTORISATIONS,
    most_from_start: int = FACTORISATIONS_FROM_NEARBY,
    memo: Memo | None = None,
) -> StripSolution:
    """Solve ``surface``, a strip that is periodic along y, under the bodies of ``scene`` at ``speed`` [m/s], not 0.

    The cells are those of the map, or ``map_coarsening`` (fx, fy) times as long: they take every fx-th and fy-th height
    where it is, so that strips of different coarsening are the same strip. ``start``: the same strip at another speed,
    on these cells or on longer ones. Without it, strip and speed alone decide the result; many cells then start from
    cells twice as long. ``find_slope``: solve it a second time, for `StripSolution.slope`. ``tolerance``: of the
    residuals (`lubfric.models.deterministic.state.residuals`). ``upper``: the part of ``surface`` that is surface 2,
    where both bodies are rough. ``ends`` [m]: of the grid, up and down stream (None: `reach`). ``most``: LU
    factorisations, at most; ``most_from_start``: of these from ``start``. ``memo``: what the bodies' other problems
    share (`Problem`).

    Raises `InputError` and `ConvergenceError`.
    """
    check_resolved_gap(scene)
    problem = problem_of(scene, surface, speed, map_coarsening=map_coarsening, upper=upper, ends=ends, memo=memo)
    work = 0.0
    slope = UNKNOWN_SLOPE
    longer = (2 * map_coarsening[0], 2 * map_coarsening[1])
    if start is None and problem.heights.size > MANY_CELLS and surface.shape[1] % longer[1] == 0:
        with may_stay_unsolved():
            start = solve_strip(
                scene,
                surface,
                speed,
                map_coarsening=longer,
                tolerance=LONGER_CELLS_RESIDUAL,
                upper=upper,
                ends=ends,
                memo=memo,
            )
            work = start.work
    if start is None:
        result = solve_point(problem, tolerance=tolerance, most=most)
    else:
        near = refined_start(start.problem, problem, start.result)
        result = solve_point(
            problem,
            start=near.state,
            least=near.least_step,
            tolerance=tolerance,
            most=most,
            most_from_start=most_from_start,
        )
    work += work_of(result)
    if find_slope:
        heavier = problem.at_load(SECOND_LOAD * problem.load)
        second = solve_point(heavier, start=result.state, tolerance=tolerance)
        work += work_of(second)
        slope = (second.coefficient * second.load - result.coefficient * result.load) / (second.load - result.load)
    return StripSolution(problem=problem, result=result, slope=slope, work=work)


def change_by_flow(strip: StripSolution, lubricant: Lubricant) -> float:
    """Return the relative change of f of ``strip`` if another ``lubricant`` flowed in its film, with the shear stress
    that it has. Raises `ConvergenceError`."""
    problem = strip.problem
    result = strip.result
    if lubricant == problem.lubricant:
        return 0.0
    other = replace(problem, line=replace(problem.line, lubricant=lubricant))
    solution = solve_point(other, start=result.state, tolerance=STRIP_RESIDUAL)
    return assemble(evaluated(problem, solution.state), solution.report).coefficient / result.coefficient - 1


def thinned_less(lubricant: Lubricant) -> Lubricant:
    """Return ``lubricant``, the limit of its stress, if it has one, twice as high: it thins the flow half as much. How
    fast a sheared oil at its limit flows is not known well."""
    return lubricant if lubricant.limit is None else replace(lubricant, **lubricant.limit.twice())


def work_of(result: DeterministicResult) -> float:
    """Return the counted work of a solve in seconds of a usual core: from its cells and steps alone, never from a
    clock."""
    return work_of_steps(result.pressure.size, result.report.iterations, result.report.evaluations)


def problem_of(
    scene: Scene,
    surface: Surface,
    speed: float,
    *,
    map_coarsening: tuple[int, int] = (1, 1),
    upper: Surface | None = None,
    ends: tuple[float, float] | None = None,
    memo: Memo | None = None,
) -> Problem:
    """Return the problem of ``surface`` under the bodies of ``scene`` at ``speed`` [m/s], not 0, on its own cells or on
    cells ``map_coarsening`` times as long (`lay_out`). For a negative speed the maps are turned. ``upper``: the part of
    it that is surface 2 (all of it where only the counterface is rough). The lubricant flows with the viscosity of its
    heated inlet. ``memo``: as of `Problem`."""
    film = scene.bodies.boundary_film
    ratio = scene.motion.slide_roll_ratio
    line = line_contact_of(scene, speed)
    if [name for name, _ in moving_bodies(scene)] == ["counterface"]:
        upper = surface

    def turned(one: Surface) -> Surface:
        return replace(one, heights=one.heights[::-1], mask=None) if speed < 0 else one

    problem = lay_out(
        turned(surface),
        line,
        sliding=abs(ratio * speed),
        boundary_friction=scene.bodies.boundary_friction_coefficient,
        hardness=scene.bodies.hardness,
        boundary_film=BOUNDARY_FILM if film is None else film,
        map_coarsening=map_coarsening,
        ends=ends,
        memo=memo,
    )
    heights = None if upper is None else shifted(problem, turned(upper))(0.0)
    return replace(
        problem,
        sense=-1.0 if ratio < 0 else 1.0,
        upper=problem.heights if upper is surface else heights,
        sheared=None if line.lubricant is scene.lubricant else scene.lubricant,
    )


def line_contact_of(scene: Scene, speed: float) -> LineContact:
    """Return the line contact of ``scene`` at ``speed`` [m/s], whose lubricant flows with the viscosity of its heated
    inlet."""
    return replace(scene.line_contact(abs(speed)), lubricant=film_lubricant(scene, speed))


def error_by_cells(changes: Sequence[float], left: float = math.inf) -> float:
    """Return the relative error of f on the last of several grids, each twice as fine as the one before, by its
    ``changes`` from grid to grid (`change_of`).

    It is the geometric series of the last change, with the ratio q of the last two kept within 1/4 and 3/4 (0.6 from
    one change). ``left``: how often the cells can be halved until they are those that the answer is for. The series
    ends there, with twice that ratio, since two changes determine it poorly, and up to 2: on exponential surfaces
    under heavy loads the changes grow down to those cells.
    """
    before = changes[-2] if len(changes) > 1 else 0.0
    if math.isinf(left):
        ratio = ratio_of_changes(changes[-1], before, CHANGE_RATIOS, UNKNOWN_RATIO)
        return changes[-1] * (ratio / (1 - ratio))
    ratio = ratio_of_changes(2.0 * changes[-1], before, (CHANGE_RATIOS[0], GROWING), UNKNOWN_RATIO)
    return changes[-1] * sum(ratio ** (k + 1) for k in range(int(left)))


def error_of_patch(changes: Sequence[float]) -> float:
    """Return the relative error of f on the last of several grids, on each of which all of a patch is solved, by its
    ``changes`` from grid to grid (`changes_of_patch`).

    One of them may be small by chance, where effects of opposite sign cancel. So the last counts as the least ratio of
    `CHANGE_RATIOS` times the one before at least, as if f converged with second order. The geometric series of it has
    the ratio of both, from `LEAST_RATIO_OF_PATCH` to the largest of `CHANGE_RATIOS`; the largest from one change.
    """
    (least, most) = CHANGE_RATIOS
    before = changes[-2] if len(changes) > 1 else 0.0
    last = max(changes[-1], least * before)
    ratio = ratio_of_changes(last, before, (LEAST_RATIO_OF_PATCH, most), most)
    return last * ratio / (1 - ratio)


def cautious_changes(changes: Sequence[float]) -> tuple[float, float]:
    """Return the last two of the ``changes`` of f from grid to grid of a single strip, as its `error_by_cells` takes
    them.

    The last is `LEAST_FALL` of the one before at least, since two effects may cancel in it by chance; the one before is
    no larger than makes their ratio the least that is expected (`CHANGE_RATIOS`).
    """
    last = max(changes[-1], LEAST_FALL * changes[-2])
    return min(changes[-2], last / CHANGE_RATIOS[0]), last


def expected_error_after(changes: Sequence[float], halvings: int, left: float = math.inf) -> float:
    """Return the expected relative error of f after so many ``halvings`` of the last of several grids, if its
    ``changes`` from grid to grid go on to fall as the last two did (`CHANGE_RATIOS`; `UNKNOWN_RATIO` from one change).
    ``left``: as of `error_by_cells`, before these halvings."""
    ratio = UNKNOWN_RATIO
    if len(changes) > 1 and changes[-2] > 0:
        ratio = min(max(changes[-1] / changes[-2], CHANGE_RATIOS[0]), CHANGE_RATIOS[1])
    series = ratio / (1 - ratio)
    if math.isfinite(left):
        series = sum(ratio**k for k in range(1, max(int(left) - halvings, 1) + 1))
    return changes[-1] * ratio**halvings * series


def changes_of(strips: Sequence[StripSolution]) -> list[float]:
    """Return the `change_of` f from each of ``strips`` to the next."""
    return [change_of(coarse.result, fine.result) for coarse, fine in zip(strips[:-1], strips[1:])]


def changes_of_patch(strips: Sequence[StripSolution]) -> list[float]:
    """Return the `change_of` f from each of ``strips`` to the next, or that of f with twice the boundary film, relative
    to it, where that is larger: effects that cancel by chance in one mean over the fields do not in the other."""
    twice = [strip.result.at_twice_film for strip in strips]
    others = [abs(1 - coarse / fine) for coarse, fine in zip(twice[:-1], twice[1:])]
    return [max(both) for both in zip(changes_of(strips), others)]


def change_of(coarse: DeterministicResult, fine: DeterministicResult) -> float:
    """Return the `change_of_places` from a ``coarse`` to a ``fine`` grid."""
    before, after = (Places(result.coefficient, result.friction_at, result.load_at) for result in (coarse, fine))
    return change_of_places(before, after, fine.load)


def change_of_places(coarse: Places, fine: Places, mean_load: float) -> float:
    """Return the relative change of f from a ``coarse`` to a ``fine`` grid, with the standard error of its mean over
    places, whose ``mean_load`` [N/m] is that of both.

    Places change by themselves, some up and some down. On a short map the mean may be small by chance; the scatter of
    the places shows by how much. Friction that goes with a place's load is omitted, since their mean load is kept.
    """
    count = max(coarse.load.size // COLUMNS_OF_A_PLACE, 2)
    load = _blocks(fine.load, count) - _blocks(coarse.load, count)
    friction = _blocks(fine.friction, count) - _blocks(coarse.friction, count)
    unexplained = friction - load * ((friction @ load) / max(load @ load, 1e-300))
    scatter = float(np.std(unexplained)) / math.sqrt(count - 1) / mean_load
    return math.hypot(fine.coefficient - coarse.coefficient, scatter) / abs(fine.coefficient)


def _blocks(values: np.ndarray, count: int) -> np.ndarray:
    """Return the means of ``values`` over ``count`` equal parts of their length."""
    sums = np.append(0.0, np.cumsum(values)) / values.size
    ends = np.interp(np.linspace(0, 1, count + 1), np.linspace(0, 1, values.size + 1), sums)
    return np.diff(ends) * count
