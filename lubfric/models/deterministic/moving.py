"""Roughness that moves through the film: implicit steps in time, each with the mass that the film stores.

    div( U rho θ h - rho h³ Φ/(12 eta) grad p ) + d(rho θ h)/dt = 0

Steps are BDF2, of second order: (3 m - 4 m' + m'')/(2 dt), with m' and m'' the mass rho θ h of the last two moments,
limited where a summit closes a cell (`state.stored`). In a step the lubricant passes one cell, and m' and m'' are those
of the one and two cells before: along the way of the lubricant both first terms are one, d(rho θ h)/dt. Waves that go
with it lose nothing, and of a film at rest that is second-order upwind, as of the steady one. (In steps and cells that
stand still, waves of 12 cells lost half of their height in a half-width.)

Where all roughness is slower than U/2, or some is faster than 2 U, the fastest rough body moves by one cell in a step,
m' and m'' are of the cell itself, and the first step is implicit Euler.

f is that of surface 2, the upper one, against its sliding u2 - u1, or against U in pure rolling (`Problem.sense`).
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from itertools import islice
from typing import Any, NamedTuple

import numpy as np
from scipy.ndimage import uniform_filter1d

from ...errors import CONVERGED, ITERATION_LIMIT, Report
from ...film import LineContact
from ...scene import Scene
from ...surface import Surface
from .linear import ACCURACY
from .newton import Work, newton
from .point import Strip, solve_strip, work_of_steps
from .problem import HERTZ_INLET, HERTZ_OUTLET, Problem, reach, shifted
from .result import DeterministicResult, LoadSplit, assemble
from .solve import solve_point
from .state import RUPTURED, TOUCHING, Iterate, State, TimeHistory, evaluated, extrapolated_mass, residuals

EXACT = 1e-3  # the residual of a step (`residuals`), unless another is given
MOST = 160  # LU factorisations of a step, at most
PARTS = 4  # Euler steps that lead to a step that Newton's method does not solve
RESOLVED = 8  # cells in the Hertz half-width, from which on the pressure is moved with the roughness as a start
SMOOTH = 0.4  # half-widths over which the pressure is smoothed to tell what goes with the roughness
STEPS = 4.0  # LU factorisations in a step in time, about: for the estimate of the work
KRYLOV = 25.0  # GMRES iterations in a step in time, about
SLOW = 0.5  # of U: where all roughness is slower, the fastest passes one cell in a step; else the lubricant does
FAST = 2.0  # of U: where some roughness is faster, it passes one cell in a step
SAME = 1e-9  # relative: the lubricant passes one cell in a step
SERIES = "coefficient", "share", "mean_gap", "central_gap", "min_gap", "flow_film", "peak_pressure"
AVERAGED = tuple(f.name for f in fields(DeterministicResult) if f.type is float) + ("load_at", "friction_at")


@dataclass(frozen=True, kw_only=True)
class MovingEffort:
    """How accurately the film under moving roughness is followed (docs/deterministic.md has what each value changes).

    - ``residual``: at which a step ends (`residuals`), for each column of cells along x; ``carries_imbalance``: whether
      the mass that it leaves out of balance goes into the next step; ``linear``: residual of GMRES, relative.
    - ``inlet``, ``outlet``: lengths of the grid up and down stream, at least, in Hertz half-widths.
    - ``discarded``: distance that the lubricant travels before anything counts, in half-widths.
    """

    residual: float
    carries_imbalance: bool
    linear: float
    inlet: float
    outlet: float
    discarded: float


TIGHT = MovingEffort(
    residual=1e-4,
    carries_imbalance=False,
    linear=ACCURACY,
    inlet=HERTZ_INLET,
    outlet=HERTZ_OUTLET,
    discarded=2.5,  # from 1.5 half-widths before the middle of the contact to one behind it
)
ECONOMICAL = MovingEffort(
    residual=2e-3,
    carries_imbalance=True,
    linear=0.1,
    inlet=1.8,
    outlet=1.3,
    discarded=1.6,
)


@dataclass(frozen=True)
class Moment:
    """The film ``at`` a ``time`` [s] since the roughness began to move; ``work``: what this step took."""

    time: float
    at: Iterate
    work: Work

    @cached_property
    def result(self) -> DeterministicResult:
        """Its fields and forces."""
        left = residuals(self.at)
        worst = max(left.values())
        steps = self.work.factorisations
        cost = self.work.krylov
        name = "film under moving roughness"
        return assemble(self.at, Report(name, CONVERGED, steps, worst, worst, left, evaluations=cost))


def moments(
    problem_at: Callable[[float], Problem],
    step: float,
    *,
    start: State | None = None,
    tolerance: float = EXACT,
    carries_imbalance: bool = False,
    linear_accuracy: float = ACCURACY,
    shift: int = 0,
) -> Iterator[Moment]:
    """Yield the film from moment to moment, without end, while the heights of its surfaces change with time.

    Parameters
    ----------
    problem_at : of a time [s], from 0 on, the `Problem` then: its ``heights`` [m] (nx, ny) are those of both bodies.
        Load and speed may change too, the grid may not
    step : [s]. If the lubricant passes one cell in it, the mass is followed along
    start : the state at time 0; None: the steady film there, as if the roughness were at rest
    tolerance : of the residuals of a step (`lubfric.models.deterministic.state.residuals`); small waves need 1e-6 and
        less
    carries_imbalance : whether the mass that a step leaves out of balance is added to that of the next step. Then it
        does not add up over the steps, and a ``tolerance`` as large as 0.5 will do for the mean friction
    linear_accuracy : of GMRES (`System.solve`)
    shift : cells by which the roughness moves in a step. Newton's method begins with its pressure there; the result
        does not depend on it

    The first is time 0 itself. Raises `ConvergenceError` where a step is not solved.
    """
    problem = problem_at(0.0)
    count = 0
    imbalance: np.ndarray | None = None
    at = before = evaluated(problem, solve_point(problem).state if start is None else start)
    smooth = max(1, round(SMOOTH * half_width(problem.contact) / problem.spacing[0]))
    yield Moment(0.0, at, Work(0))
    while True:
        count += 1
        work = Work(MOST)
        problem = problem_at(count * step)
        history = _history(problem, at, before, step, imbalance)
        how: dict[str, Any] = {"tolerance": tolerance, "most": MOST // 4, "linear_accuracy": linear_accuracy}
        near = (_moved(at.state, before.state, shift, smooth),) if shift else ()
        for state in (*near, at.state):
            result = newton(problem, state, work, history=history, **how)
            if result.residual <= tolerance:
                break
        else:
            nearby = _in_parts(problem_at, at, (count - 1) * step, step, work, how)
            result = newton(problem, nearby, work, history=history, **how)
        if not result.residual <= tolerance:
            name = f"film under moving roughness, step {count} of {step:.3g} s"
            advice = "shorter cells make the step shorter, and a higher speed the film thicker"
            cost = work.factorisations
            left = result.residuals
            Report(name, ITERATION_LIMIT, cost, result.residual, tolerance, left, advice=advice).raise_if_failed()
        before = at
        at = result.at
        if carries_imbalance:
            imbalance = np.where(at.state.kind == TOUCHING, 0.0, at.residual)
        yield Moment(count * step, at, work)


def _history(
    problem: Problem, at: Iterate, before: Iterate, step: float, imbalance: np.ndarray | None = None
) -> TimeHistory:
    """Return the history of the step from ``at`` to ``problem``; ``before``: the moment a step earlier, or ``at``
    itself where there is none; ``imbalance`` [m/s]: what the last step left in each cell."""
    cell = problem.spacing[0]
    lost = 0.0 if imbalance is None else step * imbalance
    if max(abs(end.speed * step - cell) for end in (problem, at.problem)) > SAME * cell:
        if at is before:
            return TimeHistory(extrapolated=at.mass, step=step)
        return TimeHistory(extrapolated=extrapolated_mass(at.mass, before.mass) - lost, step=step, last=at.mass)

    def upstream(mass):
        """Return the mass of the cell before each cell; before the first one by the parabola."""
        return np.concatenate([mass[:1] - problem.x[0] / problem.radius * cell, mass[:-1]])

    last = upstream(at.mass)
    left = extrapolated_mass(at.mass, upstream(before.mass)) - lost
    extrapolated = np.concatenate([0.0 * left[:1], left[:-1]])  # what enters has no history
    return TimeHistory(extrapolated=extrapolated, step=step, last=last, follows_lubricant=True)


def _in_parts(problem_at, at: Iterate, time: float, step: float, work: Work, how: dict[str, Any]) -> State:
    """Return the state after the step after ``time`` in `PARTS` Euler steps, as far as they are solved: a start only,
    because they do not keep the mass that the steps of second order keep."""
    for part in range(1, PARTS + 1):
        problem = problem_at(time + part * step / PARTS)
        history = TimeHistory(extrapolated=at.mass, step=step / PARTS)
        result = newton(problem, at.state, work, history=history, **how)
        if not result.residual <= how["tolerance"]:
            break
        at = result.at
    return at.state


def _moved(state: State, before: State, cells: int, smooth: int) -> State:
    """Return ``state`` with all that goes with the roughness moved by so many ``cells`` along x: dents, kinds of cells, and
    what the pressure has beside its mean over y and ``smooth`` cells along x. Half of its change since the moment
    ``before`` is added."""

    def moved(values, times=1):
        return np.concatenate([np.repeat(values[:1], times * cells, axis=0), values[: -times * cells]])

    mean, old = (uniform_filter1d(one.pressure.mean(axis=1, keepdims=True), smooth, axis=0) for one in (state, before))
    rough = 1.5 * moved(state.pressure - mean) - 0.5 * moved(before.pressure - old, 2)
    kind = moved(state.kind)
    return replace(
        state,
        pressure=np.where(kind == RUPTURED, 0.0, np.maximum(mean + rough, 0.0)),
        fill=np.where(kind == RUPTURED, moved(state.fill), 1.0),
        dent=moved(state.dent),
        kind=kind,
        yielded=moved(state.yielded),
    )


class RoughBody(NamedTuple):
    """The map of a body that moves at a ``speed`` [m/s] along x, all on the same cells; ``upper``: it is surface 2, and
    the map as seen from surface 1."""

    surface: Surface
    speed: float
    upper: bool = False


def travelling(problem: Problem, bodies: Sequence[RoughBody]) -> Callable[[float], Problem]:
    """Of a time [s], ``problem`` with the heights of ``bodies`` then.

    A map is laid out as by `lay_out`, and `shifted`."""
    shifts = [shifted(problem, body.surface) for body in bodies]

    def at(time: float) -> Problem:
        heights = [shift(body.speed * time) for shift, body in zip(shifts, bodies)]
        upper = [z for z, body in zip(heights, bodies) if body.upper]
        return replace(problem, heights=np.sum(heights, axis=0), upper=upper[0] if upper else None)

    return at


@dataclass(frozen=True)
class MovingStrip(Strip):
    """A strip whose roughness moved through the film; ``result`` has the means over time, and the fields of the last
    moment.

    ``rest``: the same strip at rest, from which it started. ``times`` [s] (n,): all moments after it, the first
    ``discarded`` of which count nothing: the film had not passed the contact yet. ``series``: of each the numbers
    `SERIES`: ``share``, of the load that rubs with f_b, ``peak_pressure`` [Pa] of any cell.
    """

    rest: Strip
    times: np.ndarray
    discarded: int
    series: dict[str, np.ndarray] = field(repr=False)

    @property
    def peak_pressure(self) -> float:
        return max(self.rest.peak_pressure, float(self.series["peak_pressure"].max()))


def solve_moving_strip(
    scene: Scene,
    bodies: Sequence[RoughBody],
    speed: float,
    *,
    factors: tuple[int, int] = (1, 1),
    start: Strip | None = None,
    slope: bool = False,
    effort: MovingEffort | None = None,
    most_steps: int | None = None,
) -> MovingStrip:
    """Move the rough ``bodies`` through the film at U = ``speed`` [m/s], by the length of the fastest map. Their speeds
    are along the motion.

    ``factors``, ``start``, ``slope``: as in `solve_strip`, for the roughness at rest, from which the motion starts.
    What follows until the film has passed the contact (`MovingEffort.discarded`, in Hertz half-widths, or in those of
    the smooth film where that is wider) is discarded. ``effort``: None: `effort_for` the contact. ``most_steps``: that
    count, at most (None: a whole pass of the map). Raises `InputError` and `ConvergenceError`.
    """
    heights = np.sum([body.surface.heights for body in bodies], axis=0)
    surface = replace(bodies[0].surface, heights=heights, mask=None)
    line = scene.line_contact(abs(speed))
    effort = effort_for(line, surface.sq) if effort is None else effort
    ends = reach(line, surface.sq, inlet=effort.inlet, outlet=effort.outlet)
    near = start.rest if isinstance(start, MovingStrip) else start
    upper = next((body.surface for body in bodies if body.upper), None)
    rest = solve_strip(scene, surface, speed, factors=factors, start=near, slope=slope, upper=upper, ends=ends)
    if speed < 0:
        bodies = [body._replace(surface=replace(body.surface, heights=body.surface.heights[::-1])) for body in bodies]
    fastest = max(bodies, key=lambda body: abs(body.speed))
    cell = rest.problem.spacing[0]
    step, discarded, count = _steps(line, cell, fastest.speed, fastest.surface.size[0], effort)
    count = count if most_steps is None else min(count, most_steps)
    moved = max(1, round(abs(fastest.speed) * step / cell))
    moving = moments(
        travelling(rest.problem, bodies),
        step,
        start=rest.result.state,
        tolerance=effort.residual * rest.problem.x.size,
        carries_imbalance=effort.carries_imbalance,
        linear_accuracy=effort.linear,
        shift=moved if line.half_width > RESOLVED * cell else 0,
    )
    rows: list[dict[str, Any]] = []
    for moment in islice(moving, 1, 1 + discarded + count):
        result = moment.result
        rows.append({name: getattr(result, name) for name in AVERAGED} | vars(result.split))
        rows[-1]["share"] = result.split.spots / result.load
        rows[-1]["peak_pressure"] = float(moment.at.state.pressure.max())
        rows[-1]["work"] = work_of_steps(moment.at.gap.size, moment.work.factorisations, moment.work.krylov)
    mean = {name: np.mean([row[name] for row in rows[discarded:]], axis=0) for name in rows[0]}
    split = LoadSplit(*(float(mean[f.name]) for f in fields(LoadSplit)))
    parts: dict[str, Any] = {name: mean[name] if mean[name].ndim else float(mean[name]) for name in AVERAGED}
    speeds = " and ".join(f"{body.speed:.4g}" for body in bodies)
    note = (
        f"the roughness moved at {speeds} m/s, by {count} steps of {step:.3g} s after {discarded} that do not count; "
        f"at rest f = {rest.result.coefficient:.4g}"
    )
    return MovingStrip(
        moment.at.problem,
        replace(result, **parts, split=split, report=replace(result.report, notes=(note,))),
        rest.slope,
        rest.work + sum(row["work"] for row in rows),
        rest,
        step * np.arange(1, 1 + len(rows)),
        discarded,
        {name: np.array([row[name] for row in rows]) for name in SERIES},
    )


def effort_for(contact: LineContact, sq: float) -> MovingEffort:
    """Return the `MovingEffort` for roughness of ``sq`` [m] in a smooth ``contact``."""
    return TIGHT


def _steps(
    contact: LineContact, cell: float, fastest: float, length: float, effort: MovingEffort
) -> tuple[float, int, int]:
    """Return the length [s] of a step, and the numbers of steps that are discarded and that count, for cells [m] along
    x and a ``fastest`` body [m/s] whose map has this ``length`` [m]."""
    speed = contact.entrainment_speed
    step = cell / (speed if SLOW <= abs(fastest) / speed <= FAST else abs(fastest))
    discarded = math.ceil(effort.discarded * half_width(contact) / (speed * step))
    return step, discarded, max(1, round(length / (abs(fastest) * step)))


def half_width(contact: LineContact) -> float:
    """Return the half-width of the Hertz strip [m], or that of the smooth film where that is wider."""
    return max(contact.half_width, math.sqrt(2 * contact.radius * contact.moes_film))


def moving_work(contact: LineContact, sq: float, cell: float, fastest: float, length: float, cells: float) -> float:
    """Estimate the counted work [s of a usual core] of so many ``cells`` in all the steps of `solve_moving_strip`."""
    _, discarded, count = _steps(contact, cell, fastest, length, effort_for(contact, sq))
    return (discarded + count) * work_of_steps(cells, STEPS, KRYLOV)
