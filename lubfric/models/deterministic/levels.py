"""Friction of an infinite line contact by the deterministic model, from levels of cost.

    f = mean over strips of (f by the deterministic model - control)              levels 1 and 2
      * mean f on cells half as long / mean f on the cells of the strips          level 3
      * mean f on cells a quarter as long / mean f on cells half as long          level 4

    level   what is solved                      where
    1       the control, by Eq. (8)             many strips, joined
    2       the deterministic model             a few of these strips
    3       the same on cells half as long      pieces, half as long as a strip (`pieces`)
    4       the same on a quarter               one piece, a sixth as long as a strip

The control is by how much each strip differs from the many strips that Eq. (8) joins
(`lubfric.models.load_sharing.differences_of_strips`). Its mean over the few strips is the part of theirs that is
chance. Few strips are enough where both models scatter alike, as they do near the lift-off speed on most surfaces.
Where they do not, the control is omitted. The strips that are solved show whether fewer are needed with the control or
without it (M. B. Giles, Oper. Res. 56 (2008) 607-617, doi:10.1287/opre.1070.0496). Where roughness moves there is level
2 alone, with the control of its summits (`summits`) and a factor for the cells (`cells_in_motion`).
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ..._base import forecast_limit, may_stay_unsolved, work_left
from ..._base.jobs import map_parts
from ...quantities import names_with
from ...scene import Scene, has_moving_roughness
from ..shared import (
    ControlVariate,
    Prepared,
    StandardError,
    add_errors,
    half_width_of_error,
    is_near_zero,
    strips_for_error,
    student,
    with_divided_sliding,
    with_rest_rolling,
)
from .cells_in_motion import cells_of_strips, changed_as_expected
from .counted_work import MOST_WORK_OF_POINT
from .errors_of_parts import errors_of_numbers
from .ladder import EndOfCells
from .pieces import Piece, changed_by_pieces
from .result import DeterministicResult
from .rough_bodies import summit_control
from .scatter import samples_over_time, scatter_of_f
from .shorter_cells import NO_SHORTER_CELLS, on_shorter_cells
from .strip import StripSolution, change_by_flow, thinned_less
from .strip_on_two_grids import (
    StripOnTwoGrids,
    numbers_of_strip,
    on_halved_cells,
    solve_pair,
    surface_and_map_coarsening,
)
from .time_and_place import mean_over_blocks

# The comments state how results change with half and with twice the value of a constant, on three points of the scene
# "paper" (`python -m verification.campaigns.constants lubfric.models.deterministic.levels`). Where f moves, more or
# fewer strips are solved: it moves by up to 3 %, within the sampling error that is stated with it.

# Part of numerics.model_tolerance that the half-width by the scatter of the difference may take [-]; the rest is for
# what is added to it. Half: twice the time. A choice: a smaller value takes more strips. Half and twice this value
# change f by up to 2.8 %, its interval by up to 12 % and the work by up to 120 % (constants.csv).
DIFFERENCE_SHARE = 0.95

# Bias of strips that balance the load each by itself, over (scatter of f between strips)² [-]: .5 to 1 % near the
# lift-off speed (docs/uncertainty.md). Half and twice this value change the interval by up to 1 %.
BALANCED = 1.3

# Factors by which the number of strips may grow, the first time and later [-] (`strips_for_error`). A choice: a larger
# value may solve strips in vain, a smaller one takes more rounds. Half and twice this value change f by up to 3.2 %,
# its interval by up to 9.3 % and the work by up to 41 % (constants.csv).
STRIPS_GROWTH = (4.0, 2.0)

# Factor on the strips that an error needs, and least growth [-] (`strips_for_error`). A choice, as in `STRIPS_GROWTH`.
STRIPS_SPARE = (1.1, 1.2)

# Work of a strip on these cells over that on both lengths before [-]: measured 2.3 on a needle roller at 2 m/s, after
# those.
HALVED_WORK = 2.5

# Part of the remaining work of a point that these cells may take [-]: the rest is for the ends of input ranges. A
# choice: a larger value leaves less to the ends of ranges.
PART_OF_WORK_LEFT = 0.5

CORRECTED_BY_SUMMITS = (
    "f is corrected by {:+.2g} %, because the summits of the sample differ from those of the infinite surface"
)
CORRECTED_BY_CELLS = "f is corrected by {:+.2g} % for shorter cells, estimated from its change by the boundary film"
OTHER_FILMS = ("at_half_film", "at_twice_film")  # f, with another boundary film


@dataclass(frozen=True, kw_only=True)
class Levels:
    """What all levels say of one operating point.

    Attributes
    ----------
    numbers : of the deterministic model on an infinite line contact, by name
    errors : their relative standard errors, by name
    rolling_of_strips : rolling part of the friction force [N], mean of the strips; what f has beside it are its sliding
        parts
    by_film : relative changes of f by half and by twice the boundary film
    by_flow : relative change of f by another law of the flow
    by_inlet : relative change of f without the heat of the inlet
    control_strips : number of strips of the first level, the control; 0: it was omitted
    pairs : the strips of the second level
    pieces : those of the third, each on shorter and shorter cells
    shortest : the piece of the fourth; empty: there is none
    finest : the first strip, on the shortest cells that it is solved on
    sampling_error : relative, of f, by the number of strips
    difference_error : relative standard error of f, by the difference between the models
    numerical : relative error of f, by the cells of the last level
    length : of all strips [m]
    end_of_cells : why there are no shorter cells
    note : how f was corrected by the summits and the cells of moving roughness, as text; "": not at all
    by_summits : the correction of f by the summits, relative to the f of this estimate
    """

    numbers: dict[str, float]
    errors: dict[str, float]
    rolling_of_strips: float
    by_film: tuple[float, ...]
    by_flow: float
    by_inlet: float
    control_strips: int
    pairs: tuple[StripOnTwoGrids, ...]
    pieces: tuple[Piece, ...]
    shortest: Piece
    finest: StripSolution
    sampling_error: StandardError
    difference_error: StandardError
    numerical: float
    end_of_cells: EndOfCells
    length: float
    note: str = ""
    by_summits: float = 0.0


@dataclass(frozen=True, kw_only=True)
class TwoLevelEstimate:
    """f and the other numbers by the first two levels.

    Attributes
    ----------
    control_strips, numbers, note, by_summits : as in `Levels`
    error_of_f : standard error of f [-], not over it
    difference_error_of_f : the same of the difference between the models, where the line has strips without end [-]
    left_to_control : part of the strips of the first level that the second leaves out [-]
    between : standard deviation of f between strips [-]
    """

    control_strips: int
    numbers: dict[str, float]
    error_of_f: StandardError
    difference_error_of_f: StandardError
    between: float
    left_to_control: float = 0.0
    note: str = ""
    by_summits: float = 0.0

    def strips_for_tolerances(self, *, sampling_tolerance: float, model_tolerance: float, count: int, most: int) -> int:
        """Return the number of strips of the second level, at most ``most``, that the tolerances need; there are
        ``count``. ``model_tolerance`` counts with the first level alone."""
        f = abs(self.numbers["coefficient"])
        of_sampling = f * sampling_tolerance
        targets = [(self.error_of_f, of_sampling)]
        if self.control_strips:
            of_difference = f * DIFFERENCE_SHARE * model_tolerance / student(self.difference_error_of_f.freedom)
            targets = [
                (self.error_of_f, math.hypot(of_sampling, of_difference)),
                (self.difference_error_of_f, of_difference),
            ]
        return max(
            strips_for_error(
                error, target, count=count, first=1, available=most, growth=STRIPS_GROWTH, spare=STRIPS_SPARE
            )
            for error, target in targets
        )


def solve_pairs(
    prepared: Prepared, speed: float, count: int, *, solved: Sequence[StripOnTwoGrids] = ()
) -> tuple[StripOnTwoGrids, ...]:
    """Solve the first ``count`` strips at ``speed`` [m/s], not 0, each on two grids; ``solved``: the first of them,
    where these are solved already."""
    first = tuple(solved) or (_first_pair(prepared, speed),)
    solve = partial(solve_pair, slope=first[0].resolved.slope, has_halved_cells=first[0].has_halved_cells)
    return (*first, *map_parts(solve, range(len(first), count), prepared, speed))


def _first_pair(prepared: Prepared, speed: float) -> StripOnTwoGrids:
    """Solve the first strip; where roughness moves, once more on cells half as long along y if the error by the cells
    is above ``numerics.model_tolerance`` and the shorter ones reduce it (`CellsInMotion.shorter_ones_pay`), where as
    many strips as the sample needs stay within `MOST_WORK_OF_POINT`. Raises `TooCostlyError` where its first steps
    forecast more than the caller allows (`limited_forecast`)."""
    pair = solve_pair(prepared, speed, 0, find_slope=True, most_work=forecast_limit())
    if not has_moving_roughness(prepared.scene) or surface_and_map_coarsening(prepared, 0)[1][1] % 2:
        return pair
    cells = cells_of_strips(prepared, [pair.resolved], pair.change_by_cells)
    if not cells.shorter_ones_pay(prepared.scene.numerics.model_tolerance):
        return pair
    (_, wanted) = two_levels(prepared, (pair,), None)
    if wanted * HALVED_WORK * pair.resolved.work > min(MOST_WORK_OF_POINT, PART_OF_WORK_LEFT * work_left()):
        return pair
    with may_stay_unsolved():  # then the error by the cells is that of the longer ones
        return on_halved_cells(prepared, speed, pair)
    return pair


def two_levels(
    prepared: Prepared,
    pairs: Sequence[StripOnTwoGrids],
    control: ControlVariate | None,
    *,
    sampling_tolerance: float | None = None,
) -> tuple[TwoLevelEstimate, int]:
    """Return the estimate from these strips that needs fewer of them in all, and how many: with a ``control``, or as
    the mean of the strips alone.

    Strips are needed until the standard error of f is within the ``sampling_tolerance``, relative (None: that of the
    scene). With the first level, the difference of the models may leave a half-width of `DIFFERENCE_SHARE` times
    ``numerics.model_tolerance`` beside it. No more are wanted than `MOST_WORK_OF_POINT` allows.
    """
    numerics = prepared.scene.numerics
    tolerance = numerics.sampling_tolerance if sampling_tolerance is None else sampling_tolerance
    count = len(pairs)
    most = max(1, min(prepared.sample.available_strips, int(MOST_WORK_OF_POINT / pairs[0].resolved.work)))

    def required(estimate: TwoLevelEstimate) -> int:
        return estimate.strips_for_tolerances(
            sampling_tolerance=tolerance, model_tolerance=numerics.model_tolerance, count=count, most=most
        )

    if pairs[0].resolved.moves:
        estimate = _estimate_in_motion(prepared, pairs)
        return estimate, max(required(estimate), count)
    alone = _estimate_at_rest(prepared, pairs, None)
    required_alone = required(alone)
    if control is not None and count <= control.count:
        estimate = _estimate_at_rest(prepared, pairs, control)
        load = prepared.scene.bodies.load
        contact_load = estimate.numbers["contact_load"]
        has_possible_load = 0 <= contact_load <= load
        if has_possible_load and (required_with_control := required(estimate)) <= min(required_alone, control.count):
            controlled = estimate.numbers | {"film_load": load - contact_load}
            numbers = with_divided_sliding(controlled, alone.numbers, load)
            return replace(estimate, numbers=numbers), max(required_with_control, count)
    return alone, max(required_alone, count)


def levels_of(
    prepared: Prepared,
    speed: float,
    pairs: Sequence[StripOnTwoGrids],
    estimate: TwoLevelEstimate,
    *,
    with_shorter_cells: bool = True,
) -> Levels:
    """Return what all levels say at ``speed`` [m/s]: the ``estimate`` from these strips, changed by shorter cells if
    the change of f from longer ones is not within ``numerics.tolerance``; without ``with_shorter_cells`` the error by
    the cells is for others to state. Raises `ConvergenceError`."""
    shorter = on_shorter_cells(prepared, speed, pairs) if with_shorter_cells else NO_SHORTER_CELLS
    results = [pair.resolved.result for pair in pairs]
    rolling = mean(result.rolling for result in results) * prepared.scene.bodies.width
    as_expected = changed_as_expected(estimate.numbers, shorter.change, rolling)
    last = None if estimate.control_strips else shorter.all_of_sample(pairs)
    if last is None:
        of_third_level = [(piece.on_cells_of_strips, piece.on_shortest_cells) for piece in shorter.pieces]
        third = changed_by_pieces(prepared, as_expected, of_third_level)
        fourth = changed_by_pieces(prepared, third, [shorter.shortest.from_half_cells] if shorter.shortest else [])
        numbers = with_divided_contact_load(prepared.scene, fourth, results)
    else:
        numbers = numbers_of_strip(prepared, last.result)
    f = abs(numbers["coefficient"])
    of_strips = add_errors(estimate.error_of_f, replace(shorter.sampling_error, value=shorter.sampling_error.value * f))
    of_difference = math.sqrt(estimate.left_to_control) * estimate.difference_error_of_f.value
    difference_error = StandardError(min(of_difference, of_strips.value) / f, estimate.difference_error_of_f.freedom)
    by_chance = math.sqrt((of_strips.value / f) ** 2 - difference_error.value**2)
    sampling_error = replace(of_strips, value=math.hypot(by_chance, BALANCED * (estimate.between / f) ** 2))
    films = tuple(mean(getattr(result, name) - result.coefficient for result in results) / f for name in OTHER_FILMS)
    errors = errors_of_numbers(prepared, pairs, shorter, numbers)
    errors["coefficient"] = math.hypot(
        *(e for e in (sampling_error.value, difference_error.value, shorter.error) if math.isfinite(e))
    )
    first = pairs[0].resolved
    at_rest = first.at_rest
    notes = [estimate.note] if estimate.note else []
    if shorter.change:
        change = as_expected["coefficient"] / estimate.numbers["coefficient"] - 1
        notes += [CORRECTED_BY_CELLS.format(100 * change)] if change else []
    return Levels(
        numbers=numbers,
        errors=errors,
        rolling_of_strips=rolling,
        by_film=films,
        by_flow=change_by_flow(at_rest, thinned_less(at_rest.problem.lubricant)),
        by_inlet=change_by_flow(at_rest, prepared.scene.lubricant),
        control_strips=estimate.control_strips,
        pairs=tuple(pairs),
        pieces=shorter.pieces,
        shortest=shorter.shortest,
        finest=shorter.strip or first,
        sampling_error=sampling_error,
        difference_error=difference_error,
        numerical=shorter.error,
        end_of_cells=shorter.end,
        length=prepared.sample.line_length(max(estimate.control_strips, len(pairs))),
        note="; ".join(notes),
        by_summits=estimate.by_summits,
    )


def with_divided_contact_load(
    scene: Scene, numbers: dict[str, float], results: Sequence[DeterministicResult]
) -> dict[str, float]:
    """Return ``numbers`` with the asperity load divided into boundary film and saturated film as on the strips, of
    which the ``results`` are. The control and shorter cells change the load itself.

    How shorter cells change the division depends on the speed, and pieces are solved at another one: on the patch of
    the scene "paper" the saturated film falls from 12 to 0.4 % of the load at 0.01 m/s, and grows from 43 to 55 % at
    0.015 m/s. The bounds by the unknown limit of the oil rest on the same division. With a shear law a film at its
    limiting stress is part of the film load.
    """
    thin = mean(result.split.thin for result in results)
    capped = mean(result.split.capped for result in results)
    if thin + capped == 0:
        return numbers
    share = thin / (thin + capped)
    parts = {"boundary_film_load": share * numbers["contact_load"]}
    if scene.lubricant.has_unlimited_stress:
        parts["saturated_film_load"] = (1 - share) * numbers["contact_load"]
    return numbers | parts


def _estimate_at_rest(
    prepared: Prepared, pairs: Sequence[StripOnTwoGrids], control: ControlVariate | None
) -> TwoLevelEstimate:
    """Return the estimate from strips whose roughness rests; ``control``: the first level (None: without it)."""
    rows = [numbers_of_strip(prepared, pair.resolved.result) for pair in pairs]
    count = len(pairs)
    numbers = {name: mean(row[name] for row in rows) for name in rows[0]}
    if control is None:
        error = scatter_of_f(pairs, prepared.sample)
        return TwoLevelEstimate(
            control_strips=0,
            numbers=numbers,
            error_of_f=error,
            difference_error_of_f=StandardError(0.0, 1),
            between=error.value * math.sqrt(count),
        )
    for name, differences in control.numbers.items():
        numbers[name] -= mean(differences[:count])
    unsolved = 1 - count / control.count
    others = replace(
        control.sampling_error, value=math.sqrt(unsolved) * control.sampling_error.value * abs(numbers["coefficient"])
    )
    error = add_errors(scatter_of_f(pairs, prepared.sample, control, unsolved), others)
    between = float(np.std(control.numbers["coefficient"]))
    return TwoLevelEstimate(
        control_strips=control.count,
        numbers=numbers,
        error_of_f=error,
        difference_error_of_f=scatter_of_f(pairs, prepared.sample, control, 1.0),
        between=between,
        left_to_control=unsolved,
    )


def _estimate_in_motion(prepared: Prepared, pairs: Sequence[StripOnTwoGrids]) -> TwoLevelEstimate:
    """Return the mean over strips whose roughness moves, with the control of their summits (`summits`).

    It corrects f, the asperity load and the sliding part of the film's force each by its own dependence on the summits,
    which for f is the sum of those of its parts. The rest is of the rolling part: the pressure on the flanks of surface
    2 scatters most where asperities carry the load. A part whose corrected value is not possible is that of the strips.
    """
    rows = [numbers_of_strip(prepared, pair.resolved.result) for pair in pairs]
    numbers = {name: mean(row[name] for row in rows) for name in rows[0]}
    samples = samples_over_time(pairs)
    control = summit_control(prepared)
    width = prepared.sample.correlation_lengths[1]
    friction = mean_over_blocks(samples, "friction", width, control)
    rubbing = mean_over_blocks(samples, "contact_load", width, control)
    couette = mean_over_blocks(samples, "couette", width, control)
    load = prepared.scene.bodies.load
    if numbers["contact_load"] > 0 and 0 < rubbing.value < 1:  # else too little rubs: the mean of the strips
        contact_load = rubbing.value * load
        times = contact_load / numbers["contact_load"]
        for name in names_with("follows_asperity_load"):
            numbers[name] *= times
        numbers["film_load"] = load - contact_load
    if couette.value > 0:
        numbers["couette_force"] = couette.value * load
    numbers["coefficient"] = friction.value
    numbers = with_rest_rolling(numbers, load)
    between = friction.plain.value * math.sqrt(len(pairs))
    by_summits = friction.correction / friction.value
    of_sample = half_width_of_error(friction.error.value, friction.error.freedom)
    is_relative = not is_near_zero(friction.value, max(of_sample, abs(by_summits)))
    return TwoLevelEstimate(
        control_strips=0,
        numbers=numbers,
        error_of_f=friction.error,
        difference_error_of_f=StandardError(0.0, 1),
        between=between,
        note=CORRECTED_BY_SUMMITS.format(100 * by_summits) if by_summits and is_relative else "",
        by_summits=by_summits,
    )


def mean(values: Iterable[float]) -> float:
    """Return the mean of any iterable."""
    return float(np.mean(list(values)))
