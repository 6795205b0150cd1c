"""One deterministic operating point on one grid: Newton's method, and other ways if it fails."""

import hashlib
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from ..._base import FloatArray, IntArray
from ...contact import BOUNDARY, ContactResult, solve_contact
from ...errors import CONVERGED, DIVERGED, ITERATION_LIMIT, Report, returned
from ..shared import DryContactKey, numbers_of_fields
from .linear import has_high_pressure
from .newton import NEWTON_PATIENCE, NewtonResult, Work, march, newton
from .problem import Problem, are_soft
from .result import DeterministicResult, assemble
from .state import FLUID, RUPTURED, State, evaluated, residuals

# The comments state how results change with half and with twice the value of a constant, on the counted work of eight
# films, light, heavy, soft and moving (`python -m verification.campaigns.newton_constants
# lubfric.models.deterministic.solve.`).

# The largest residual of a solution, unless another is given [-] (`residuals`): a convention; strips have their own.
SOLVE_RESIDUAL = 1e-5

# LU factorisations from a state nearby, at most [-]: a bound. Half and twice this value change nothing.
FACTORISATIONS_FROM_NEARBY = 40

# LU factorisations from the dry contact, at most [-]: a bound. Half and twice this value change nothing; a roller of 1
# GPa took up to 27.
FACTORISATIONS_FROM_DRY = 50

# LU factorisations of steps in time, at most [-]: a bound. Half and twice this value change nothing.
FACTORISATIONS_IN_TIME = 500

# LU factorisations of all ways together, unless another number is given [-]: a bound. Half and twice this value change
# nothing.
MOST_FACTORISATIONS = 800

# Speeds over that of the point [-] at which a start from the dry contact is tried where it fails at the speed itself. A
# choice: faster films converge more easily, and take more steps down. No film of the campaign needs it.
START_SPEEDS = (16.0, 256.0)

# Residual of solutions on the way [-]. No film of the campaign needs it. A choice, as in the tolerance of a strip.
RESIDUAL_ON_THE_WAY = 1e-3

# Factor of a step in ln(speed) after one that was solved [-]. No film of the campaign needs it. A choice: a larger
# value saves steps, and may fail.
SPEED_STEP_GROWTH = 1.5

# The least step in ln(speed) [-]: a bound. No film of the campaign needs it. A choice: a smaller value costs time
# before a film fails.
LEAST_SPEED_STEP = 0.05
FILM_ADVICE = "try longer cells or a higher speed"

# Limiting stress over the pressure of the fluid from which a Newtonian one starts [-]. No film of the campaign needs
# it; an oil has .05 to .1. A choice: a film of it converges more easily.
THIN_STRESS = 0.09

# Limiting stress of that fluid at ambient pressure [Pa]. No film of the campaign needs it. A choice: as `THIN_STRESS`.
THIN_OFFSET = 2e6

# Tolerance of the dry contact [-] (`lubfric.solve_contact`): a start only. Half and twice this value change the work by
# 1 % at most.
DRY_TOLERANCE = 1e-4

# Distance behind the middle over sqrt(2 R h), from which on a start has ruptured [-]: a little behind where a rigid
# film ruptures, 0.475. Half and twice this value change the work by 1 %, of one film by +31 and -13 %.
START_RUPTURE = 0.55

# Part of Moes' film by which the dry contact is lifted for a start where the pressure is high (`has_high_pressure`)
# [-]: a film under loaded asperities is thinner than Moes'. A roller of 1 GPa at 10, 3, 1, 0.3, 0.1, 0.03 m/s takes 12,
# 15, 14, 14, 16, 28 Newton steps with all of it, and 11, 11, 11, 10, 14, 20 with a half; light contacts take as many
# with a half as with all.
LIFT = 0.5

# Number of steps within which the residual has to fall in a start from the dry contact of soft bodies [-]. With a thin
# film it does not fall, neither from the dry contact nor from faster films: a roller of E' 19 GPa and film/Sq .05 took
# 160 factorisations, of which 70 led nowhere.
SOFT_PATIENCE = 8

# Parts of the expected film by which the dry contact is lifted, one after the other, where less film arrives than would
# flow in [-]: strips of 280 x 192 cells under 60 nm on 80 nm of roughness converge in 16 or 23 steps from some of these
# starts and not at all from others, without a rule; each is tried for half of `FACTORISATIONS_FROM_DRY`.
STARVED_LIFTS = (0.5, 0.33, 0.7)

# Parts of the expected film by which the dry contact is lifted where every other way has failed [-]. A bearing of 10 mm
# radius with 200 nm of roughness, 1e5 N/m and 1 mm/s, alone on 48 cells across, has no solution from .1, .33, .5, .7
# and 1, and one after 12 steps from .2, after 41 from 2.
LAST_LIFTS = (0.2, 2.0)

# Asperity load ratio [-], from which on a finer grid does not start from interpolated pressure: contacts are too sharp
# for that. Levels of a roller of 1 GPa with 0.011 and 0.023 take 16 and 10 Newton steps so, and 10 from sharp contacts.
SHARP_LOAD_RATIO = 0.02

# Ratio of the residuals of an interpolated start to those of the dry start, above which the interpolated one is not
# used [-]. A roller of 1 GPa at 1 m/s took 33 Newton steps from one whose residuals were some 20 times as large, and 14
# from the dry contact plus the change by the film (`_corrected_dry_start`).
WORSE = 2.0

# Asperity load ratio [-], up to which the change by the film on longer cells is added to the dry contact of shorter
# ones (`_corrected_dry_start`). Levels of a roller of 1 GPa take 7 Newton steps so where it is 0.05 to 0.09, and 12
# from the dry contact lifted by the film; where it is 0.19, 0.53 and 0.83, 20, 19 and 37 for 11, 13 and 16. Chosen by
# these.
WET_LOAD_RATIO = 0.1

# Part of the pressure of the film between the asperity contacts of the longer cells that a start from the dry contact
# has [-]. Last levels of a roller of 1 GPa at 0.3, 0.1, 0.03 m/s take 17, 27, 81 Newton steps from the dry contact with
# a half of Moes' film, 15, 21, 33 with 0, 12, 15, 21 with 0.12, 13, 14, 36 with 0.25, 21 (not solved), 13, 45 with 0.5.
FILM_PRESSURE_PART = 0.125

# Part of a Newton step [-], below which a `_corrected_dry_start` is given up: the solution follows by steps that are
# longer, or not at all (7 steps where it does, see `WET_LOAD_RATIO`). A choice: a larger value gives up sooner.
LEAST_CORRECTED_STEP = 0.3


def solve_point(
    problem: Problem,
    *,
    start: State | None = None,
    least: float = 0.0,
    tolerance: float = SOLVE_RESIDUAL,
    most: int = MOST_FACTORISATIONS,
    most_from_start: int = FACTORISATIONS_FROM_NEARBY,
) -> DeterministicResult:
    """Solve gap, pressure and friction of ``problem`` on its own grid.

    The `WAYS` are tried in turn until one converges; together they take at most ``most`` factorisations.
    ``report.notes`` says which one it was. From ``start``, a state on the same grid, Newton's method ends after
    ``most_from_start`` factorisations, or where a step is shorter than ``least``. Converged when the largest of
    `lubfric.models.deterministic.state.residuals` is <= tolerance. Raises `ConvergenceError` with report and result.
    """
    work = Work(most)
    tried: list[tuple[str, NewtonResult]] = []
    search = PointSearch(
        problem=problem, start=start, least=least, most_from_start=most_from_start, tolerance=tolerance, work=work
    )
    for attempt in _attempts(search):
        tried.append(attempt)
        if attempt[1].residual <= tolerance:
            break
    name, result = min(tried, key=lambda attempt: attempt[1].residual if attempt[1].residual >= 0 else math.inf)
    worst = result.residual if math.isfinite(result.residual) else math.inf
    status = ITERATION_LIMIT if worst < math.inf else DIVERGED
    if worst <= tolerance:
        status = CONVERGED
    ways = ", ".join(f"{way} ({ended.residual:.1e})" for way, ended in tried)
    spent = f"{work.factorisations} of {most} factorisations"
    report = Report(
        "deterministic mixed film",
        status=status,
        iterations=work.factorisations,
        residual=worst,
        tolerance=tolerance,
        residuals=result.residuals,
        history=tuple(work.history),
        evaluations=work.krylov,
        notes=(
            f"started {name}; {work.factorisations} factorisations, {work.krylov} iterations, {work.steps} "
            "steps in time",
        ),
        advice=f"starts that were tried in {spent}, each with its remaining residual: {ways}; {FILM_ADVICE}",
    )
    return returned(assemble(result.at, report))


@dataclass(frozen=True, kw_only=True)
class PointSearch:
    """What all ways to a solution have in common; arguments as of `solve_point`.

    Attributes
    ----------
    problem : to be solved
    start : a state on the same grid; None: there is none
    least : part of a Newton step from there [-], below which it is given up
    most_from_start : factorisations from there, at most
    tolerance : on the largest residual
    work : what all ways together have taken
    faster : solutions at higher speeds, by their speed over that of the problem, that one way leaves to a later one
    """

    problem: Problem
    start: State | None
    least: float
    most_from_start: int
    tolerance: float
    work: Work
    faster: dict[float, State] = field(default_factory=dict)

    @cached_property
    def is_soft(self) -> bool:
        """Whether the bodies are soft (`are_soft`)."""
        return are_soft(self.problem.line, float(self.problem.heights.std()))

    @property
    def patience(self) -> int:
        """Steps in which the residual has to fall."""
        return SOFT_PATIENCE if self.is_soft else NEWTON_PATIENCE

    @cached_property
    def dry(self) -> ContactResult:
        """The dry contact."""
        return dry_contact(self.problem)

    @property
    def lifted(self) -> State:
        """The dry contact, lifted by the part of the expected film that is tried first."""
        return dry_start(self.problem, self.dry, _lifts(self.problem)[0])


def _from_start(search: PointSearch) -> Iterator[NewtonResult]:
    """Yield the result of Newton's method from the given start."""
    assert search.start is not None
    yield newton(
        search.problem,
        search.start,
        search.work,
        tolerance=search.tolerance,
        most=search.most_from_start,
        least=search.least,
        patience=search.patience,
        ends_unsolved=search.is_soft,
    )


def _from_dry_contact(search: PointSearch) -> Iterator[NewtonResult]:
    """Yield the results from the dry contact, lifted by the film that is expected there or by parts of it
    (`_lifts`)."""
    most = FACTORISATIONS_FROM_DRY // 2 if is_starved(search.problem) else FACTORISATIONS_FROM_DRY
    yield from _from_lifts(search, _lifts(search.problem), most)


def _from_last_lifts(search: PointSearch) -> Iterator[NewtonResult]:
    """Yield the results from the dry contact, lifted by parts of the film that no other way tries."""
    yield from _from_lifts(search, LAST_LIFTS, FACTORISATIONS_FROM_DRY)


def _from_lifts(search: PointSearch, parts: tuple[float, ...], most: int) -> Iterator[NewtonResult]:
    """Yield the results from the dry contact, lifted by these ``parts`` of the expected film, with at most so many
    factorisations each."""
    for part in parts:
        yield newton(
            search.problem,
            dry_start(search.problem, search.dry, part),
            search.work,
            tolerance=search.tolerance,
            most=most,
            patience=search.patience,
            ends_unsolved=search.is_soft,
        )


def _in_time_from_dry_contact(search: PointSearch) -> Iterator[NewtonResult]:
    """Yield the result from the state that implicit steps in time reach from the dry contact."""
    yield _in_time(search.problem, search.lifted, search.tolerance, search.work)


def _in_time_from_start(search: PointSearch) -> Iterator[NewtonResult]:
    """Yield the result from the state that implicit steps in time reach from the given start."""
    assert search.start is not None
    yield _in_time(search.problem, search.start, search.tolerance, search.work)


def _from_limited_stress(search: PointSearch) -> Iterator[NewtonResult]:
    """Yield the result from the solution with a limiting shear stress, if there is one."""
    problem = search.problem
    limited = replace(problem.lubricant, limiting_stress_coefficient=THIN_STRESS, limiting_stress_offset=THIN_OFFSET)
    with_limit = replace(problem, line=replace(problem.line, lubricant=limited))
    helped = newton(with_limit, search.lifted, search.work, tolerance=search.tolerance, most=FACTORISATIONS_FROM_DRY)
    if helped.residual <= search.tolerance:
        yield newton(problem, helped.at.state, search.work, tolerance=search.tolerance, most=FACTORISATIONS_FROM_DRY)


def _from_first_faster_speed(search: PointSearch) -> Iterator[NewtonResult]:
    """Yield the result from the first of `START_SPEEDS` that is solved, as long as each step down leads there."""
    for times in START_SPEEDS:
        fast = search.problem.at_speed(times * search.problem.speed)
        helped = newton(
            fast,
            dry_start(fast, search.dry, _lifts(fast)[0]),
            search.work,
            tolerance=RESIDUAL_ON_THE_WAY,
            most=FACTORISATIONS_FROM_DRY,
        )
        if helped.residual <= RESIDUAL_ON_THE_WAY:
            search.faster[times] = helped.at.state
            yield _from_faster(search.problem, helped.at.state, times, search.tolerance, search.work, failures=0)
            return


def _from_faster_speed_in_short_steps(search: PointSearch) -> Iterator[NewtonResult]:
    """Yield the result from that faster speed, if it is solved, in steps as short as needed."""
    for times, state in search.faster.items():
        yield _from_faster(search.problem, state, times, search.tolerance, search.work, failures=MOST_FACTORISATIONS)


@dataclass(frozen=True, kw_only=True)
class Way:
    """A way to a solution.

    Attributes
    ----------
    name : as the report says it
    applies : whether it is tried
    results : does it, once or several times, or not at all
    """

    name: str
    applies: Callable[[PointSearch], bool] = lambda search: True
    results: Callable[[PointSearch], Iterator[NewtonResult]]


# The ways to a solution, in the order in which they are tried.
WAYS = (
    Way(
        name="from a neighbouring state",
        applies=lambda search: search.start is not None,
        results=_from_start,
    ),
    Way(
        name="from the dry contact",
        results=_from_dry_contact,
    ),
    Way(
        name="in time from the dry contact",
        applies=lambda search: search.start is None and search.is_soft,
        results=_in_time_from_dry_contact,
    ),
    Way(
        name="from a fluid with a limiting stress",
        applies=lambda search: search.problem.lubricant.has_unlimited_stress,
        results=_from_limited_stress,
    ),
    Way(
        name="in time from a neighbouring state",
        applies=lambda search: search.start is not None,
        results=_in_time_from_start,
    ),
    Way(
        name="step by step from a faster speed",
        results=_from_first_faster_speed,
    ),
    Way(
        name="in time from the dry contact",
        applies=lambda search: search.start is None and not search.is_soft,
        results=_in_time_from_dry_contact,
    ),
    Way(
        name="step by step from a faster speed",
        results=_from_faster_speed_in_short_steps,
    ),
    Way(
        name="from the dry contact",
        results=_from_last_lifts,
    ),
)


def _attempts(search: PointSearch) -> Iterator[tuple[str, NewtonResult]]:
    """Yield the results of all `WAYS` that apply, each with the name of its way."""
    for way in WAYS:
        if way.applies(search):
            for result in way.results(search):
                yield way.name, result


def dry_contact(problem: Problem, tolerance: float = DRY_TOLERANCE) -> ContactResult:
    """Press the rough bodies together without fluid under the total load. `Problem.memo` has it from then on."""
    gap = problem.rigid_gap
    mean_pressure = problem.load / (problem.x.size * problem.spacing[0])
    hardness = None if np.isinf(problem.hardness) else problem.hardness

    def make() -> ContactResult:
        return solve_contact(
            gap,
            problem.spacing,
            problem.e_prime,
            mean_pressure=mean_pressure,
            hardness=hardness,
            boundary=BOUNDARY,
            tolerance=tolerance,
            operator=problem.operator,
        )

    key = DryContactKey(
        rigid_gap=hashlib.sha256(gap.tobytes()).digest(),
        mean_pressure=mean_pressure,
        hardness=hardness,
        operator=problem.operator.identity,
        tolerance=tolerance,
    )
    return problem.memo.get(key, make, numbers_of_fields)


def _lifts(problem: Problem) -> tuple[float, ...]:
    """Return the parts of the expected film by which the dry contact is lifted for a start, one after another."""
    if is_starved(problem):
        return STARVED_LIFTS
    return (LIFT, 1.0) if has_high_pressure(problem) else (1.0,)


def is_starved(problem: Problem) -> bool:
    """Return whether a given film arrives that is thinner than the one that would flow in."""
    arriving = problem.lubricant.inlet_film
    return arriving is not None and arriving < problem.line.moes_film


def dry_start(problem: Problem, dry: ContactResult, lift: float = 1.0) -> State:
    """Return the pressure of the ``dry`` contact, and its gap plus the part ``lift`` of the film that is expected
    there. Behind contact and film the film has ruptured. Under a given film of 60 nm the start from all of it, or from
    half of Moes' film, took 50 and more factorisations, from half of what arrives 16."""
    p = dry.pressure
    film = problem.line.expected_film
    dent = np.where(p >= problem.hardness, np.maximum(-dry.gap, 0.0), 0.0)
    full = max(START_RUPTURE * math.sqrt(2 * problem.radius * film), problem.line.half_width)
    kind = np.where((p <= 0) & (problem.x > full)[:, None], RUPTURED, FLUID).astype(np.int8)
    return State(
        pressure=p.copy(),
        fill=np.ones_like(p),
        dent=dent,
        kind=kind,
        yielded=p >= problem.hardness,
        approach=lift * film - dry.approach,
    )


def _from_faster(
    problem: Problem, state: State, times: float, tolerance: float, work: Work, *, failures: int
) -> NewtonResult:
    """Follow the solution from so many ``times`` the speed of ``problem`` to it, through speeds in between, until more
    than so many ``failures`` of steps."""
    left = math.log(times)
    step = left / 2
    failed = 0
    while True:
        to = max(left - step, 0.0)
        goal = tolerance if to == 0 else max(tolerance, RESIDUAL_ON_THE_WAY)
        result = newton(
            problem.at_speed(math.exp(to) * problem.speed), state, work, tolerance=goal, most=FACTORISATIONS_FROM_NEARBY
        )
        if result.residual <= goal:
            left = to
            state = result.at.state
            step *= SPEED_STEP_GROWTH
        else:
            step = (left - to) / 2
            failed += 1
        if left == 0 or step < LEAST_SPEED_STEP or failed > failures:
            return result


def _in_time(problem: Problem, state: State, tolerance: float, work: Work) -> NewtonResult:
    marched = march(problem, state, work, tolerance=tolerance, most=FACTORISATIONS_IN_TIME)
    return newton(problem, marched, work, tolerance=tolerance, most=FACTORISATIONS_FROM_DRY)


@dataclass(frozen=True, kw_only=True)
class RefinedStart:
    """A ``state`` to start from, and the least Newton step to take from there [-]; 0: any."""

    state: State
    least_step: float = 0.0


def refined_start(coarse: Problem, problem: Problem, result: DeterministicResult) -> RefinedStart:
    """Return a start for ``problem`` from ``result``, a solution of ``coarse``, the same on longer cells, or on cells
    as long on a longer or shorter grid. The first of these that applies:

        start                              where
        `_interpolated_start`              the cells are as long; or asperities carry less than `SHARP_LOAD_RATIO`, and
                                           its residuals are at most `WORSE` times those of `dry_start`
        `_pressed_start`                   asperities carry more than `WET_LOAD_RATIO`
        `_corrected_dry_start`             otherwise
    """
    transfer = _transfer(coarse, problem, result)
    interpolated = _interpolated_start(transfer)
    if problem.spacing == coarse.spacing:
        return RefinedStart(state=interpolated)
    dry = dry_contact(problem)
    rubbing_share = result.split.rubbing / result.load
    if rubbing_share < SHARP_LOAD_RATIO:
        starts = (interpolated, dry_start(problem, dry))
        left, left_by_dry = (max(residuals(evaluated(problem, start)).values()) for start in starts)
        if left <= WORSE * left_by_dry:
            return RefinedStart(state=interpolated)
    dry_coarse = dry_contact(coarse)
    if rubbing_share > WET_LOAD_RATIO:
        return RefinedStart(state=_pressed_start(transfer, dry, dry_coarse))
    return RefinedStart(state=_corrected_dry_start(transfer, dry, dry_coarse), least_step=LEAST_CORRECTED_STEP)


@dataclass(frozen=True, kw_only=True)
class GridTransfer:
    """From a solution of ``coarse`` to the cells of ``problem``.

    Attributes
    ----------
    coarse, problem, result : what is solved, what is to be solved, and the solution
    along, across : places of the new cells along x and y, counted in old ones
    kind : of the new cells: that of the nearest old one; beyond the old grid fluid upstream, rupture downstream
    fill : of the new cells, linear between old ones
    """

    coarse: Problem
    problem: Problem
    result: DeterministicResult
    along: FloatArray
    across: FloatArray
    kind: IntArray
    fill: FloatArray

    def interpolated(self, field: FloatArray) -> np.ndarray:
        """Return a ``field`` of the old cells on the new ones, linear between cells, 0 beyond the old grid."""
        return _interpolated(field, self.along, self.across)

    def state(self, *, pressure: FloatArray, kind: IntArray, dent: FloatArray, approach: float) -> State:
        """Return the state of these fields, within the bounds of pressure and hardness."""
        ruptured = kind == RUPTURED
        pressure = np.where(ruptured, 0.0, np.clip(pressure, 0.0, self.problem.hardness))
        yielded = pressure >= self.problem.hardness
        return State(
            pressure=pressure,
            fill=np.where(ruptured, self.fill, 1.0),
            dent=np.where(yielded, dent, 0.0),
            kind=kind.astype(np.int8),
            yielded=yielded,
            approach=approach,
        )


def _transfer(coarse: Problem, problem: Problem, result: DeterministicResult) -> GridTransfer:
    """Return the way from the ``result`` on ``coarse`` cells to the finer ones of ``problem``: where these are among
    the coarse ones, and their kind and fill there."""
    old = result.state
    (ny,) = problem.heights.shape[1:]
    (nx_old, ny_old) = coarse.heights.shape
    along = (problem.x - coarse.x[0]) / coarse.spacing[0]
    across = (np.arange(ny) + 0.5) * (ny_old / ny) - 0.5
    nearest = old.kind[np.clip(np.rint(along).astype(int), 0, nx_old - 1)][:, np.rint(across).astype(int) % ny_old]
    return GridTransfer(
        coarse=coarse,
        problem=problem,
        result=result,
        along=along,
        across=across,
        kind=np.where((along < -0.5)[:, None], FLUID, np.where((along > nx_old - 0.5)[:, None], RUPTURED, nearest)),
        fill=_interpolated(old.fill, np.clip(along, 0, nx_old - 1), across),
    )


def _interpolated_start(transfer: GridTransfer) -> State:
    """Return the solution on the new cells, linear between old ones.

    h0 is corrected, because the half-space has its zero, u = 0, at the length of the grid from a line load.
    """
    problem = transfer.problem
    result = transfer.result
    old = result.state
    longer = (
        problem.heights.shape[0] * problem.spacing[0] / (transfer.coarse.heights.shape[0] * transfer.coarse.spacing[0])
    )
    moved = 4 * (result.load - result.inlet_load) / (math.pi * problem.e_prime) * math.log(longer)
    return transfer.state(
        pressure=transfer.interpolated(old.pressure),
        kind=transfer.kind,
        dent=transfer.interpolated(old.dent),
        approach=old.approach - moved,
    )


def _pressed_start(transfer: GridTransfer, dry: ContactResult, dry_coarse: ContactResult) -> State:
    """Return the ``dry`` contact of the new grid, raised by as much as the film raises the old solution above its own
    (``dry_coarse``), with the part `FILM_PRESSURE_PART` of the pressure of the film between the asperity contacts.

    Contacts that carry so much are too sharp to be interpolated to smaller cells.
    """
    film = transfer.interpolated(np.where(dry_coarse.pressure > 0, 0.0, transfer.result.state.pressure))
    return _on_dry_contact(
        transfer, dry, dry_coarse, pressure=np.where(dry.pressure > 0, dry.pressure, FILM_PRESSURE_PART * film)
    )


def _corrected_dry_start(transfer: GridTransfer, dry: ContactResult, dry_coarse: ContactResult) -> State:
    """Return the ``dry`` contact of the new grid plus what the film changes of ``dry_coarse``, that of the old one (as
    in a full approximation scheme: A. Brandt, Math. Comput. 31 (1977) 333-390, doi:10.1090/S0025-5718-1977-0431719-X).

    That has large residuals and yet is a few full Newton steps from the solution, or it leads nowhere.
    """
    change = transfer.interpolated(transfer.result.state.pressure - dry_coarse.pressure)
    return _on_dry_contact(transfer, dry, dry_coarse, pressure=dry.pressure + change)


def _on_dry_contact(
    transfer: GridTransfer, dry: ContactResult, dry_coarse: ContactResult, *, pressure: FloatArray
) -> State:
    """Return the state of this ``pressure`` at the approach of the old solution, changed by that of the dry
    contacts."""
    return transfer.state(
        pressure=pressure,
        kind=np.where((transfer.kind == RUPTURED) & (pressure <= 0), RUPTURED, FLUID),
        dent=np.maximum(-dry.gap, 0.0),
        approach=transfer.result.state.approach + dry_coarse.approach - dry.approach,
    )


def _interpolated(field: FloatArray, along: FloatArray, across: FloatArray) -> np.ndarray:
    """Return the linear interpolation at the cells ``along`` x (zero outside) and ``across`` y (periodic), counted in
    cells."""
    i = np.floor(along).astype(int)
    j = np.floor(across).astype(int)
    s = (along - i)[:, None]
    t = across - j
    padded = np.zeros((field.shape[0] + 2, field.shape[1]))
    padded[1:-1] = field
    i = np.clip(i + 1, 0, field.shape[0])
    j0 = j % field.shape[1]
    j1 = (j + 1) % field.shape[1]
    before = (1 - t) * padded[i][:, j0] + t * padded[i][:, j1]
    behind = (1 - t) * padded[i + 1][:, j0] + t * padded[i + 1][:, j1]
    return (1 - s) * before + s * behind
