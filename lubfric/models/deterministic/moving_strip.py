"""A strip of surface whose roughness moves through the film: how accurately it is followed, how long, and the means
over time."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from itertools import islice
from typing import Any, get_type_hints

import numpy as np

from ..._base.progress import report_progress
from ...errors import TooCostlyError
from ...film import LineContact
from ...oil import FLOW_LAWS, LIMIT_LAWS, Lubricant
from ...scene import HARDNESS_KEY, Scene, value_of
from ...surface import Surface
from ...units import worded
from .linear import GMRES_RESIDUAL
from .moving import (
    EXTRAPOLATED,
    EXTRAPOLATED_TOGETHER,
    SAME_CELLS,
    SAME_STEP,
    STEP_ORDERS,
    Moment,
    Past,
    RoughBody,
    film_half_width,
    moments,
    travelling,
)
from .problem import HERTZ_INLET, HERTZ_OUTLET, Problem, reach
from .result import DeterministicResult, LoadSplit, change_with_oil, share_moved_by_hardness
from .state import State
from .strip import StripSolution, change_of_places, problem_of, solve_strip, work_of_steps
from .summits import SummitControl, summits_over_time
from .time_and_place import TimeAndPlace, mean_over_blocks

# The comments state how results change with half and with twice the value of a constant, on a roller of 0.55 GPa whose
# roughness moves (`python -m verification.campaigns.constants lubfric.models.deterministic.moving`). Where f moves
# there, other moments count.

# Cells in the Hertz half-width [-], from which on steps may be loose. On fewer, one cell that changed its kind moved
# the asperity load ratio by 0.013 (verification/campaigns/moving_effort).
CELLS_FOR_LOOSE_STEPS = 8

# LU factorisations in a step in time [-], for the estimate of the work: 3.0 to 4.1 on four contacts of
# verification/campaigns/moving_coverage.
FACTORISATIONS_IN_A_STEP = 4.0

# GMRES iterations in a step in time [-], for the estimate of the work: measured 23 to 34 on the contacts of
# `FACTORISATIONS_IN_A_STEP`.
KRYLOV_IN_A_STEP = 25.0

# Film of the smooth contact over Sq [-], above which the waves of the film are small, and steps have to be tight. A
# convention: loose steps were compared with tight ones up to this film (verification/campaigns/moving_effort).
SMALL_WAVES = 3.0

# Mean square height below which a body is smooth [m²]. A convention.
SMALLEST_SQUARE = 1e-30

# Speed of the roughness over U [-]. Where all roughness is slower, a step lasts until the fastest body has passed one
# cell, otherwise until the lubricant has. At this speed steps of the lubricant are twice as many as the roughness
# needs; `moving` has what slower roughness would gain. A choice between time and the error by steps.
SLOW_ROUGHNESS = 0.5

# Speed of the roughness over U [-]. Where a rough body is faster, a step lasts until this body has passed one cell. A
# choice between time and the error by steps.
FAST_ROUGHNESS = 2.0

# Distance that the lubricant travels in the moments on longer cells that are compared with those of a strip
# [half-widths]. The change of f on a needle roller is 4.8 % after 0.4, 3.8 % after 1.0, 3.0 % after 2.0 and 2.6 % after
# 10. Half and twice this value change the interval by 1 and 4 %; twice this value takes 11 % more time.
COMPARED_WAY = 1.0

# Distance that the lubricant travels in the moments of a continuation that count [half-widths]. Half and twice this
# value change nothing where only the shear stress has a range.
CONTINUED_WAY = 0.4

# Moments of a continuation that count, at least [-]. Half and twice this value change nothing where only the shear
# stress has a range.
FEWEST_CONTINUED = 8

# Distance that the roughness travels in the moments that count before the error of the mean is known first
# [half-widths]: half of a block of time (`TIME_BLOCK`). A choice: a smaller value judges by too few moments, a larger
# one may be in vain.
PILOT_WAY = 1.5

# Factors by which the moments that count may grow from one check of that error to the next [-]. A convention: more
# than a few checks cost nothing, and an error from few blocks is too uncertain to grow by more.
MOMENTS_GROWTH = (1.25, 2.5)

# Steps in time that forecast the work of a strip, at most [-]. A choice: the mean of so many is within a factor of 1.2
# of that of the complete strip in most of 30 random contacts of ``verification.campaigns.estimates``, 1.5 at most.
FORECAST_STEPS = 10

# Steps in time before these [-]: the first steps from rest take more work. A choice, above `moving.STEPS_FROM_REST`.
STEPS_BEFORE = 3

# Counted work [s] of the steps in time after which a forecast uses the steps solved so far. A choice: a twelfth of
# `MOST_WORK_OF_POINT`.
ENOUGH_WORK = 10.0

# Factor on the number of moments that the error needs [-]. A convention.
MOMENTS_SPARE = 1.1

# Numbers of a strip that are kept at every moment; the counted work of its step is one.
SERIES = ("coefficient", "share", "mean_gap", "central_gap", "min_gap", "flow_film", "work")

# Inputs that change the shear stress of a film, but very little its pressure and gap (`MovingStripSolution.with_oils`).
OF_SHEAR = tuple(f"lubricant.{law.key}" for law in (*FLOW_LAWS, *LIMIT_LAWS))

# Fields of a `DeterministicResult` of which a strip has the means over time: all numbers, and three of every place
# along y.
_TYPES = get_type_hints(DeterministicResult)
AT_PLACES = ("load_at", "friction_at", "couette_at")
AVERAGED = (*(f.name for f in fields(DeterministicResult) if _TYPES[f.name] is float), *AT_PLACES)


@dataclass(frozen=True, kw_only=True)
class MovingEffort:
    """How accurately the film under moving roughness is followed (docs/deterministic.md has what each value changes).

    - ``residual``: at which a step ends (`residuals`), for each column of cells along x; ``carries_imbalance``: whether
      the mass that it leaves out of balance goes into the next step; ``linear``: residual of GMRES, relative.
    - ``inlet``, ``outlet``: lengths of the grid up and down stream, at least, in Hertz half-widths.
    - ``discarded``: distance that the lubricant travels before anything counts, in half-widths; ``discarded_again``:
      the same in a continuation with other inputs, which begins nearer.
    """

    residual: float
    carries_imbalance: bool
    linear: float
    inlet: float
    outlet: float
    discarded: float
    discarded_again: float


# Both efforts are choices between work and error; docs/deterministic.md has what each value changes.
TIGHT = MovingEffort(
    residual=1e-4,
    carries_imbalance=False,
    linear=GMRES_RESIDUAL,
    inlet=HERTZ_INLET,
    outlet=HERTZ_OUTLET,
    discarded=2.5,  # from 1.5 half-widths before the middle of the contact to one behind it
    discarded_again=2.5,
)
ECONOMICAL = MovingEffort(
    residual=2e-3,
    carries_imbalance=True,
    linear=0.1,
    inlet=1.8,
    outlet=1.3,
    # f of four needle rollers rises by 13 % from rest: 6 % are missing after 1.7 half-widths, 1 % after 2.4
    discarded=2.4,
    discarded_again=1.6,
)


@dataclass(frozen=True, kw_only=True)
class ExpectedCourse:
    """What the estimate of the work expects of a strip of moving roughness.

    - ``rest``: steps in time that the strip at rest is worth. ``way``: distance that the roughness travels in the
      moments that count, in Hertz half-widths; infinite: all of the map passes.
    - ``on_longer``: work of a step on cells twice as long along y over that on the shorter ones; 0: it is not followed
      there.
    """

    rest: float
    way: float
    on_longer: float


# Where a strip is solved on two lengths of cells. Measured by verification/campaigns/moving_coverage. The strip at rest
# took 3 to 6 steps on the contacts of `FACTORISATIONS_IN_A_STEP`, and more on a light contact whose asperities carry the
# load (the bodies of the scene "paper" at 0.01 m/s). The roughness travelled 2 to 3 half-widths in a bearing, 6 on a gear
# flank and 10 in a needle roller. A step on longer cells took 0.49 (gear flank) and 0.52 (needle roller) of the work.
EXPECTED_COURSE = ExpectedCourse(rest=12.0, way=5.0, on_longer=0.5)

# On the long cells of the quick model: 1 to 11 steps, 3 in the median, and 1.5 to 10 half-widths, 2 in the median, of
# 12 random contacts of verification/campaigns/estimates.
COURSE_ON_LONG_CELLS = ExpectedCourse(rest=3.0, way=2.0, on_longer=0.0)


@dataclass(frozen=True, kw_only=True)
class SampleTarget:
    """When a strip has moved long enough: the standard error of f over f is ``relative_error``, by its blocks of time
    and place.

    ``correlation_length`` [m]: of the roughness along y; ``control``: what its friction scatters with.
    """

    relative_error: float
    correlation_length: float
    control: SummitControl


@dataclass(frozen=True, kw_only=True)
class ContinuedMoments:
    """The moments of a strip that `continued_strip` solves with other inputs: the last ones that it certainly has.

    Attributes
    ----------
    begun : number of the moment after which they begin; 0: from rest
    discarded, counted : numbers of those that are discarded, and that count
    past : what the steps after that moment need
    result : the means over those of the strip itself that count
    """

    begun: int
    discarded: int
    counted: int
    past: Past
    result: DeterministicResult


@dataclass(frozen=True, kw_only=True)
class MovingStripSolution(StripSolution):
    """A strip whose roughness moved through the film; ``result`` has the means over time, and the fields of the last
    moment.

    - ``rest``: the same strip at rest, from which it started. ``times`` [s] (n,): all moments after it, the first
      ``discarded`` of which count nothing: the film had not passed the contact yet. ``series``: of each the numbers
      `SERIES`: ``share``, of the load that rubs with f_b.
    - ``bodies``: the rough bodies that moved.
    - ``places``: friction and load of all places at the moments that count, with the control of the `SampleTarget`.
    - ``to_continue``: where `continued_strip` starts. ``effort`` and ``ends`` [m], of the grid up and down stream: with
      which the strip was solved.
    - ``with_oils``: f if the films of all moments that count were sheared as the oils at both ends of the range of an
      input (`OF_SHEAR`), by its name. ``moved``: share of the load that moves at each end of the range of the hardness
      [Pa] (`share_moved_by_hardness`), mean over all moments that count.
    """

    rest: StripSolution
    bodies: tuple[RoughBody, ...] = field(repr=False)
    times: np.ndarray
    discarded: int
    series: dict[str, np.ndarray] = field(repr=False)
    places: TimeAndPlace = field(repr=False)
    effort: MovingEffort
    ends: tuple[float, float]
    to_continue: ContinuedMoments = field(repr=False)
    with_oils: dict[str, tuple[float, ...]] = field(default_factory=dict)
    moved: dict[float, float] = field(default_factory=dict)

    @property
    def moves(self) -> bool:
        return True

    @property
    def at_rest(self) -> StripSolution:
        return self.rest

    @property
    def places_over_time(self) -> TimeAndPlace:
        return self.places

    @property
    def moment_in_words(self) -> str:
        return "the last moment of its motion"

    def change_from(self, longer: StripSolution) -> float:
        """Return the change of f from this strip on ``longer`` cells to this one: over the same moments, each followed
        from rest; at rest, where it was not followed on the longer cells."""
        if not isinstance(longer, MovingStripSolution):
            return self.rest.change_from(longer)
        moments = min(self.places.friction.shape[0], longer.places.friction.shape[0])
        return change_of_places(longer.places.places(moments), self.places.places(moments), self.places.mean_load)

    def coefficient_with_oil(self, name: str, end: int) -> float | None:
        return self.with_oils[name][end] if name in self.with_oils else None

    def at_inputs(self, scene: Scene, speed: float, make_map: Callable[[], Surface]) -> DeterministicResult:
        """Return the means over time of a `continued_strip` at the inputs of another ``scene``."""
        return continued_strip(scene, speed, self)[0]

    @property
    def compared_result(self) -> DeterministicResult:
        return self.to_continue.result

    @property
    def follows_lubricant(self) -> bool:
        return abs(self.problem.speed * float(self.times[0]) / self.problem.spacing[0] - 1.0) < SAME_STEP

    def share_moved(self, hardness: float, other: float) -> float:
        return self.moved[other]


def solve_moving_strip(
    scene: Scene,
    bodies: Sequence[RoughBody],
    speed: float,
    *,
    map_coarsening: tuple[int, int] = (1, 1),
    start: StripSolution | None = None,
    effort: MovingEffort | None = None,
    most_steps: int | None = None,
    target: SampleTarget | None = None,
    most_work: float = math.inf,
) -> MovingStripSolution:
    """Move the rough ``bodies`` through the film at U = ``speed`` [m/s], by the length of the fastest map, or until the
    ``target`` is reached. Their speeds are along the motion.

    What follows until the film has passed the contact (`MovingEffort.discarded`, in Hertz half-widths, or in those of
    the smooth film where that is wider) is discarded. Raises `InputError`, `ConvergenceError`, and `TooCostlyError`.

    Parameters
    ----------
    map_coarsening, start : as in `solve_strip`, for the roughness at rest, from which the motion starts
    effort : None: `effort_for` the contact
    most_steps : moments that count, at most (None: a complete pass of the map)
    target : None: the complete map passes
    most_work : counted work [s] that its first steps in time (`forecast_work`) may forecast
    """
    effort = effort_of(scene, bodies, speed, map_coarsening) if effort is None else effort
    near = None if start is None else start.at_rest
    rest = strip_at_rest(scene, bodies, speed, map_coarsening=map_coarsening, start=near, effort=effort)
    cell = rest.problem.spacing[0]
    planned = steps_in_time(
        scene, bodies, speed, cell=cell, effort=effort, has_target=target is not None, most_counted=most_steps
    )
    step = planned.step
    discarded = planned.discarded
    required = planned.least_counted
    travelled = _travelled(bodies, speed, step, film_half_width(rest.problem.line))
    summits_at = _summits(rest.problem, bodies, speed, target)
    ends = InputEnds(oils=oils_at_ends(scene), hardness=hardness_at_ends(scene))
    no_ends = InputEnds(oils={}, hardness=())
    records: list[MomentRecord] = []
    (begun, discarded_again, counted) = _moments_to_continue(
        planned, rest.problem.line, cell, abs(speed) * step, effort
    )
    forecast: float | None = None
    passing = _passing(rest.problem, bodies, speed, step=step, effort=effort, start=rest.result.state, begun=0.0)
    for number, moment in enumerate(passing):
        if number == begun:
            past = moment.past
        if number == 0:
            continue
        records.append(_recorded(moment, summits_at(number * step), ends if number > discarded else no_ends))
        report_progress("moving roughness", number, discarded + required)
        if forecast is None and number < discarded + required:
            works = [record.numbers["work"] for record in records]
            forecast = forecast_work(works, steps=discarded + required, rest=rest.work)
            if forecast is not None and forecast > most_work:
                raise TooCostlyError(_too_costly_in_words(number, forecast, most_work))
        if number == begun + discarded_again + counted:
            compared = _mean([record.numbers for record in records[-counted:]], moment.result)
        if number == discarded + required:
            places = _places_of(records[discarded:], moment.result, travelled)
            enough = required if target is None else _required_moments(places, target, required, planned.most_counted)
            if enough == required:
                break
            required = enough
    result = _mean([record.numbers for record in records[discarded:]], moment.result)
    note = _note_of_motion(records, bodies, step=step, discarded=discarded, rest=rest)
    return MovingStripSolution(
        problem=moment.at.problem,
        result=replace(result, report=replace(result.report, notes=(note,))),
        slope=rest.slope,
        work=rest.work + sum(record.numbers["work"] for record in records),
        rest=rest,
        bodies=tuple(bodies),
        times=step * np.arange(1, 1 + len(records)),
        discarded=discarded,
        places=places,
        series={name: np.array([record.numbers[name] for record in records]) for name in SERIES},
        effort=effort,
        ends=_ends(scene, bodies, speed, effort),
        to_continue=ContinuedMoments(
            begun=begun, discarded=discarded_again, counted=counted, past=past, result=compared
        ),
        with_oils={
            name: tuple(np.mean([record.with_oils[name] for record in records[discarded:]], axis=0).tolist())
            for name in ends.oils
        },
        moved=dict(zip(ends.hardness, np.mean([record.moved for record in records[discarded:]], axis=0).tolist())),
    )


def forecast_work(works: Sequence[float], *, steps: int, rest: float) -> float | None:
    """Return the counted work [s] of a strip of so many ``steps`` in time, as its first ones forecast it, whose
    ``works`` [s] are known; ``rest``: that of the strip at rest. None where more of them have to be seen:
    `FORECAST_STEPS` after `STEPS_BEFORE`, or fewer that take `ENOUGH_WORK`."""
    seen = works[STEPS_BEFORE:]
    if not seen or (len(seen) < FORECAST_STEPS and sum(works) <= ENOUGH_WORK):
        return None
    return rest + sum(works) + float(np.mean(seen)) * max(0, steps - len(works))


@dataclass(frozen=True, kw_only=True)
class StepsInTime:
    """The steps in time of `solve_moving_strip`.

    Attributes
    ----------
    step : length [s] of each
    discarded : number of the first ones that are discarded
    least_counted : number of those after them that count, at least
    most_counted : the same, at most
    """

    step: float
    discarded: int
    least_counted: int
    most_counted: int

    @property
    def least(self) -> int:
        """The number of all steps, at least."""
        return self.discarded + self.least_counted


def steps_in_time(
    scene: Scene,
    bodies: Sequence[RoughBody],
    speed: float,
    *,
    cell: float,
    effort: MovingEffort,
    has_target: bool,
    most_counted: int | None = None,
) -> StepsInTime:
    """Return the steps in time of `solve_moving_strip` on cells [m] along x; ``has_target``: whether it ends when its
    `SampleTarget` is reached; ``most_counted``: number of moments that count, at most (None: a complete pass of the
    map)."""
    line = scene.line_contact(abs(speed))
    fastest = max(bodies, key=lambda body: abs(body.speed))
    (step, discarded, of_pass) = _steps(line, cell, fastest.speed, fastest.surface.size[0], effort)
    most = of_pass if most_counted is None else min(of_pass, most_counted)
    least = min(most, _pilot(line, bodies, step)) if has_target else most
    return StepsInTime(step=step, discarded=discarded, least_counted=least, most_counted=most)


def _too_costly_in_words(number: int, forecast: float, most: float) -> str:
    """Return that the first steps in time, so many (``number``), ``forecast`` more work [s] than the ``most`` that is
    allowed."""
    return (
        f"the roughness moves, and by its first {number} steps in time one strip would take at least "
        f"{float(f'{forecast:.2g}'):g} s of "
        f"counted work, more than {most:g} s; set numerics.model = 'deterministic' to solve it"
    )


def moments_after_rest(
    rest: StripSolution, bodies: Sequence[RoughBody], speed: float, *, step: float, effort: MovingEffort
) -> Iterator[Moment]:
    """Yield the moments of `solve_moving_strip` after ``rest``, the strip at rest, in steps of ``step`` [s], without
    end."""
    passing = _passing(rest.problem, bodies, speed, step=step, effort=effort, start=rest.result.state, begun=0.0)
    return islice(passing, 1, None)


@dataclass(frozen=True, kw_only=True)
class InputEnds:
    """Ends of the ranges of inputs at which f follows from the moments: ``oils``, both lubricants by the name of the
    input, and ``hardness`` [Pa]."""

    oils: Mapping[str, Sequence[Lubricant]]
    hardness: Sequence[float]


@dataclass(frozen=True, kw_only=True)
class MomentRecord:
    """What is kept of a moment: its ``numbers`` by name (`_row`); f `with_oils` at the ends of inputs, by name; the
    share of the load that ``moved`` at each end of the hardness."""

    numbers: dict[str, Any]
    with_oils: dict[str, list[float]]
    moved: list[float]


def _recorded(moment: Moment, summits: np.ndarray, ends: InputEnds) -> MomentRecord:
    """Return the record of a ``moment`` whose places have the control ``summits`` [m] (ny,)."""
    problem = moment.at.problem
    pressure = moment.at.state.pressure
    return MomentRecord(
        numbers=_row(moment) | {"summits_at": summits},
        with_oils=with_oils(moment.result, problem.sliding, ends.oils),
        moved=[share_moved_by_hardness(pressure, problem.hardness, end) for end in ends.hardness],
    )


def _note_of_motion(
    records: Sequence[MomentRecord], bodies: Sequence[RoughBody], *, step: float, discarded: int, rest: StripSolution
) -> str:
    """Return what moved, how many steps of ``step`` [s] count, and f of the same surfaces at ``rest``, as text."""
    speeds = " and ".join(f"{body.speed:.4g}" for body in bodies)
    lower = sum(record.numbers["order"] < STEP_ORDERS[0] for record in records)
    by_lower = f"; {lower} step{'s' if lower > 1 else ''} with a method of lower order" if lower else ""
    return (
        f"the roughness moves at {speeds} m/s: mean over {len(records) - discarded} steps of {worded(step, 's')}, "
        f"after {discarded} "
        f"discarded ones; the same surfaces at rest, for comparison: f = {rest.result.coefficient:.4g}{by_lower}"
    )


def hardness_at_ends(scene: Scene) -> tuple[float, ...]:
    """Return the hardness [Pa] at both ends of its range in ``scene``; () without one."""
    return tuple(value_of(end, name) for name, *ends in scene.at_ends() if name == HARDNESS_KEY for end in ends)


def oils_at_ends(scene: Scene) -> dict[str, tuple[Lubricant, ...]]:
    """Return the lubricants of ``scene`` at both ends of the ranges of `OF_SHEAR`, by name."""
    if scene.lubricant.has_unlimited_stress:
        return {}
    return {name: tuple(end.lubricant for end in ends) for name, *ends in scene.at_ends() if name in OF_SHEAR}


def with_oils(
    result: DeterministicResult, sliding: float, oils: Mapping[str, Sequence[Lubricant]]
) -> dict[str, list[float]]:
    """Return f of ``result``, which slides at ``sliding`` [m/s], if its films were sheared as the ``oils``, by their
    names."""
    return {
        name: [result.coefficient + change_with_oil(result, sliding, oil) for oil in both]
        for name, both in oils.items()
    }


def continued_strip(scene: Scene, speed: float, strip: MovingStripSolution) -> tuple[DeterministicResult, float]:
    """Return the means over time of ``strip`` with the inputs of another ``scene`` that has the same bodies and motion,
    and the counted work [s].

    It solves moments of the strip once more (`MovingStripSolution.to_continue`), and counts when the film with these
    inputs has passed the contact (`continued_moments`). It is compared with the strip itself in the same moments
    (`MovingStripSolution.compared_result`), in which the roughness is in the same places: the ratio of both does not
    depend on the few places that pass in that time. Raises `ConvergenceError`.
    """
    rest = strip.rest
    bodies = strip.bodies
    cell = rest.problem.spacing[0]
    (dx, dy) = bodies[0].surface.spacing
    map_coarsening = (round(cell / dx), round(rest.problem.spacing[1] / dy))
    surface, upper = _combined(bodies)
    problem = problem_of(scene, surface, speed, map_coarsening=map_coarsening, upper=upper, ends=strip.ends)
    step = float(strip.times[0])
    again = strip.to_continue
    passing = _passing(
        problem, bodies, speed, step=step, effort=strip.effort, start=again.past, begun=again.begun * step
    )
    rows = []
    for number, moment in enumerate(islice(passing, 1, 1 + again.discarded + again.counted), 1):
        rows.append(_row(moment))
        report_progress("moving roughness at an end of an input range", number, again.discarded + again.counted)
    return _mean(rows[-again.counted :], moment.result), sum(row["work"] for row in rows)


def _required_moments(places: TimeAndPlace, target: SampleTarget, required: int, most: int) -> int:
    """Return the number of moments that shall count, of ``most``: ``required``, those of the ``places``, if its error
    is within the ``target``.

    The error is itself known to 1/sqrt(2 nu) only, with nu degrees of freedom. So 1 + 1/sqrt(nu) times the error has to
    be within it: a march that ended where blocks happen to scatter little would state too small an error.
    """
    friction = mean_over_blocks([places], "friction", target.correlation_length, target.control)
    reached = friction.error.cautious / abs(friction.value)  # infinite without a degree of freedom
    if reached <= target.relative_error:
        return required
    times = MOMENTS_SPARE * (reached / target.relative_error) ** 2
    return min(most, math.ceil(required * min(max(times, MOMENTS_GROWTH[0]), MOMENTS_GROWTH[1])))


def _pilot(line: LineContact, bodies: Sequence[RoughBody], step: float) -> int:
    """Return the number of steps [s] in which the fastest of ``bodies`` passes `PILOT_WAY` half-widths."""
    return math.ceil(PILOT_WAY * film_half_width(line) / (max(abs(body.speed) for body in bodies) * step))


def _travelled(bodies: Sequence[RoughBody], speed: float, step: float, half_width: float) -> float:
    """Return the ``half_width`` [m] s that the film, or the slowest of ``bodies``, passes in a ``step`` [s]."""
    return min(abs(speed), *(abs(body.speed) for body in bodies)) * step / half_width


def _summits(
    problem: Problem, bodies: Sequence[RoughBody], speed: float, target: SampleTarget | None
) -> Callable[[float], np.ndarray]:
    """Return the function of a time [s] that gives the control of the ``target`` at each place; zeros where there is
    none."""
    if target is None:
        return lambda time: np.zeros(problem.heights.shape[1])
    return summits_over_time(problem, _as_seen(bodies, speed), target.control)


def _places_of(records: Sequence[MomentRecord], result: DeterministicResult, travelled: float) -> TimeAndPlace:
    """Return the places of the moments of ``records``; ``result``: of the last."""

    def over_time(name: str) -> np.ndarray:
        return np.array([record.numbers[name] for record in records])

    return TimeAndPlace(
        friction=over_time("friction_at"),
        load=over_time("load_at"),
        contact_load=over_time("contact_load_at"),
        couette=over_time("couette_at"),
        summits=over_time("summits_at"),
        travelled=travelled,
        spacing=result.spacing[1],
        mean_load=result.load,
    )


def compared_moments(strip: MovingStripSolution) -> int:
    """Return the number of moments of ``strip`` that are compared with those on longer cells (`COMPARED_WAY`)."""
    way = abs(strip.problem.speed) * float(strip.times[0])
    return min(strip.times.size - strip.discarded, math.ceil(COMPARED_WAY * film_half_width(strip.problem.line) / way))


def continued_moments(line: LineContact, cell: float, way: float, effort: MovingEffort) -> tuple[int, int]:
    """Return the numbers of moments of a continuation that are discarded, and that count, on cells [m] along x; ``way``
    [m]: that the lubricant travels in a step."""
    width = film_half_width(line)
    return math.ceil(effort.discarded_again * width / way), max(
        FEWEST_CONTINUED, math.ceil(CONTINUED_WAY * width / cell)
    )


def _moments_to_continue(
    planned: StepsInTime, line: LineContact, cell: float, way: float, effort: MovingEffort
) -> tuple[int, int, int]:
    """Return `ContinuedMoments.begun`, ``discarded`` and ``counted`` of a strip whose steps in time are ``planned``;
    other arguments as of `continued_moments`. A strip with fewer moments is continued from rest, and fewer count."""
    (discarded, counted) = continued_moments(line, cell, way, effort)
    counted = min(counted, planned.least_counted)
    begun = max(0, planned.least - discarded - counted)
    return begun, planned.least - begun - counted, counted


def strip_at_rest(
    scene: Scene,
    bodies: Sequence[RoughBody],
    speed: float,
    *,
    map_coarsening: tuple[int, int] = (1, 1),
    start: StripSolution | None = None,
    effort: MovingEffort | None = None,
) -> StripSolution:
    """Solve the strip of `solve_moving_strip` with its roughness at rest, unchanged at time 0."""
    surface, upper = _combined(bodies)
    effort = effort_of(scene, bodies, speed, map_coarsening) if effort is None else effort
    ends = _ends(scene, bodies, speed, effort)
    return solve_strip(scene, surface, speed, map_coarsening=map_coarsening, start=start, upper=upper, ends=ends)


def _combined(bodies: Sequence[RoughBody]) -> tuple[Surface, Surface | None]:
    """Return the sum of the maps, and the part of it that is surface 2 (None: that is smooth)."""
    heights = np.sum([body.surface.heights for body in bodies], axis=0)
    upper = next((body.surface for body in bodies if body.upper), None)
    return replace(bodies[0].surface, heights=heights, mask=None), upper


def _ends(scene: Scene, bodies: Sequence[RoughBody], speed: float, effort: MovingEffort) -> tuple[float, float]:
    """Return the lengths [m] of the grid up and down stream of the line of contact."""
    line = scene.line_contact(abs(speed))
    return reach(line, _combined(bodies)[0].sq, inlet=effort.inlet, outlet=effort.outlet)


def _passing(
    problem: Problem,
    bodies: Sequence[RoughBody],
    speed: float,
    *,
    step: float,
    effort: MovingEffort,
    start: State | Past,
    begun: float,
) -> Iterator[Moment]:
    """Yield the moments of ``problem`` from ``start`` on, with the roughness where it is at the time ``begun`` [s];
    for a negative ``speed`` in the mirror."""
    bodies = _as_seen(bodies, speed)
    cell = problem.spacing[0]
    heights_at = travelling(problem, bodies)
    shift = cells_in_a_step(bodies, step, cell)
    part_of_cell = max(abs(body.speed * step / cell - shift) for body in bodies)
    return moments(
        lambda time: heights_at(begun + time),
        step,
        start=start,
        tolerance=effort.residual * problem.x.size,
        carries_imbalance=effort.carries_imbalance,
        linear_accuracy=effort.linear,
        shift=shift,
        extrapolated=EXTRAPOLATED_TOGETHER if part_of_cell <= SAME_CELLS else EXTRAPOLATED,
    )


def cells_in_a_step(bodies: Sequence[RoughBody], step: float, cell: float) -> float:
    """Return the number of cells [m] by which the roughness of ``bodies`` moves downstream in a ``step`` [s], negative
    where it moves upstream: with the mean of their speeds, each with the weight of its mean square height.

    Pressure and cells of both bodies start a step there. With the speed of the fastest, 2 cells instead of 1, a gear
    flank of 1.1 GPa with two equal maps and a slide-roll ratio of 1.28 took 25 instead of 5 Newton steps for a step in
    time. With a ratio of 2 the maps move by 0 and 2 cells. Then summits of both meet in the start: 160 to 210 of 6,528
    cells touch from the start, Newton steps are 0.1 to 0.5 of their length, and a step in time takes 12 to 25. Pressing
    such cells apart first took a third more. At three moments near the nose of a cam, where the roughness moves
    upstream, a start upstream takes 8, 18 and 38 % less work than one where it was.
    """
    weights = [body.surface.sq**2 for body in bodies]
    mean = sum(weight * body.speed for weight, body in zip(weights, bodies)) / max(sum(weights), SMALLEST_SQUARE)
    return mean * step / cell


def _as_seen(bodies: Sequence[RoughBody], speed: float) -> Sequence[RoughBody]:
    """Return ``bodies`` as the problem sees them: turned for a negative ``speed``."""
    if speed > 0:
        return bodies
    return [body._replace(surface=replace(body.surface, heights=body.surface.heights[::-1])) for body in bodies]


def _row(moment: Moment) -> dict[str, Any]:
    """Return the numbers of a moment, by name, and the counted work that it took."""
    result = moment.result
    row = {name: getattr(result, name) for name in AVERAGED} | vars(result.split)
    return row | {
        "share": result.split.rubbing / result.load,
        "contact_load_at": (result.pressure * result.rubbing).sum(axis=0) * result.spacing[0],
        "order": moment.order,
        "work": work_of_steps(moment.at.gap.size, moment.work.factorisations, moment.work.krylov),
    }


def _mean(rows: Sequence[dict[str, Any]], last: DeterministicResult) -> DeterministicResult:
    """Return the result of the ``last`` moment with the means over ``rows`` instead of its numbers."""
    mean = {name: np.mean([row[name] for row in rows], axis=0) for name in rows[0]}
    split = LoadSplit(**{f.name: float(mean[f.name]) for f in fields(LoadSplit)})
    parts: dict[str, Any] = {name: mean[name] if mean[name].ndim else float(mean[name]) for name in AVERAGED}
    return replace(last, **parts, split=split)


def effort_of(
    scene: Scene, bodies: Sequence[RoughBody], speed: float, map_coarsening: tuple[int, int] = (1, 1)
) -> MovingEffort:
    """Return the `effort_for` the contact of ``scene`` at ``speed`` [m/s], on cells ``map_coarsening`` times as long as
    those of the maps."""
    surface, _ = _combined(bodies)
    return effort_for(scene.line_contact(abs(speed)), surface.sq, map_coarsening[0] * surface.spacing[0])


def effort_for(line: LineContact, sq: float, cell: float) -> MovingEffort:
    """Return the `MovingEffort` for roughness of ``sq`` [m] in a smooth ``line``, on cells [m] along x.

    It is `ECONOMICAL` where f keeps within 0.5 % of the tight one, and the asperity load ratio within 0.005
    (verification/campaigns/moving_effort has the table). It is `TIGHT`

    - where less lubricant arrives than a full inlet takes: the grid must hold where the gap fills;
    - where the smooth film is wider than the Hertz strip, in whose length the grid and the discarded way are counted;
    - where the roughness is small compared with the film: what a loose step leaves may be as large as the waves;
    - where the Hertz strip has few cells: a cell that changes its kind moves a per cent of the load (0.013 was seen).
    """
    oil = line.lubricant
    starved = oil.inlet_film is not None or oil.inlet_length is not None
    light = film_half_width(line) > line.half_width
    smooth = line.moes_film > SMALL_WAVES * sq
    narrow = line.half_width < CELLS_FOR_LOOSE_STEPS * cell
    return TIGHT if starved or light or smooth or narrow else ECONOMICAL


def _steps(
    line: LineContact, cell: float, fastest: float, length: float, effort: MovingEffort
) -> tuple[float, int, int]:
    """Return the length [s] of a step, and the numbers of steps that are discarded and that count, for cells [m] along
    x and a ``fastest`` body [m/s] whose map has this ``length`` [m]."""
    speed = line.entrainment_speed
    step = cell / (speed if SLOW_ROUGHNESS <= abs(fastest) / speed <= FAST_ROUGHNESS else abs(fastest))
    discarded = math.ceil(effort.discarded * film_half_width(line) / (speed * step))
    return step, discarded, max(1, round(length / (abs(fastest) * step)))


def moving_work(
    line: LineContact,
    sq: float,
    *,
    cell: float,
    fastest: float,
    length: float,
    cells: float,
    continuations: float = 0.0,
    course: ExpectedCourse = EXPECTED_COURSE,
    factor: float = 1.0,
) -> float:
    """Estimate the counted work [s of a usual core] of `solve_moving_strip` on so many ``cells``, and of so many
    `continued_strip`; on cells [m] along x, for a ``fastest`` body [m/s] whose map has this ``length`` [m]. Of a step
    in time it is `work_of_step_in_time` times the ``factor``."""
    effort = effort_for(line, sq, cell)
    step, discarded, count = _steps(line, cell, fastest, length, effort)
    once_more = sum(continued_moments(line, cell, line.entrainment_speed * step, effort))
    count = math.ceil(min(count, course.way * film_half_width(line) / (abs(fastest) * step)))
    compared = min(count, math.ceil(COMPARED_WAY * film_half_width(line) / (line.entrainment_speed * step)))
    steps = discarded + count + continuations * once_more + course.on_longer * (discarded + compared)
    return (course.rest + factor * steps) * work_of_step_in_time(cells)


def work_of_step_in_time(cells: float) -> float:
    """Return the counted work [s] of a step in time on so many ``cells``, of a contact of which nothing else is
    known."""
    return work_of_steps(cells, FACTORISATIONS_IN_A_STEP, KRYLOV_IN_A_STEP)
