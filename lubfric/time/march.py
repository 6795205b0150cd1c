"""The march in time: variable-step BDF2 with a local error estimate, from one output time to the next.

BDF2 differentiates the parabola through the new value and the two before it. For one step this is backward Euler with
another memory: y' = rate (y - memory) (`Memory`). Its local error is d³y/dt³ τ²(τ+τ')²/(6(2τ+τ')), with the third
derivative from the divided difference of four values (τ' is the step before τ). A start, and every jump of a history,
takes one step as two halves and as one; the difference is the error.

A solver has the equations of one implicit step. ``solve(time, memory, z, payload)`` gives the `Step` that ends at
``time`` [s] with a `Memory`, from the unknowns ``z``. ``error_of(step, difference)`` gives the relative size of a
difference of films, which is compared with the tolerance of a step. The last unknown may have any sign; the others are
0 or positive, and keep that when the start of a step is extrapolated.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from .._base import validate
from ..errors import CONVERGED, ITERATION_LIMIT, STAGNATED, STOPPED, WORK_LIMIT, InputError, Report
from ..quantities import counted
from ..scene import History
from ..units import plain_number, worded

# Choices: larger steps are rejected more often, smaller steps are more numerous. BDF2 is stable for growth below 1 +
# √2.
TIME_STEP_SAFETY = 0.85  # next step over the step that the error allows
LEAST_TIME_STEP_RATIO = 0.2  # least ratio of a step to the one before
TIME_STEP_GROWTH = 2.0  # largest ratio of a step to the one before
FAILED = 0.25  # factor on the step after a solve that failed
LEAST_LEFT = 0.2  # least part of a positive unknown that extrapolation leaves
LEAST_TIME_STEP_PART = 1e-11  # part of the duration below which a step has failed finally
SKIPPED_REST = 0.01  # part of the time between two stops within which another stop is skipped
STOP_ROUNDING = 1e-13  # relative: times that are closer are one time; below that of `lubfric.scene.history`


@dataclass(frozen=True)
class Memory:
    """What an implicit step needs of the past: y' = rate (y - film), in 1/s; rate = 0: steady. Of BDF2 also the y
    ``then``, at the last step, and the length of the ``step`` [s]."""

    rate: float
    film: np.ndarray
    then: np.ndarray | None = None
    step: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Step:
    """One solved step: ``film`` is the y that the next step remembers, ``z`` the unknowns, ``payload`` whatever else
    the next solve starts from, ``terms`` what the solver can show of it. The run continues only from a ``status``
    of "converged". The march sets the ``time`` at its end [s]."""

    film: np.ndarray
    z: np.ndarray
    status: str = CONVERGED
    payload: Any = None
    terms: Any = None
    time: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Progress:
    """How far a run has come. It can continue from any progress.

    ``last_steps``: up to three steps, oldest first, since the last jump, of which film and unknowns are kept;
    ``next_step``: the length of the next [s]; ``payload``: what the solver returned in addition to its unknowns.
    ``steps`` taken and ``rejected``; ``worst``: largest local error so far, over the tolerance. Of the last step its
    ``solution``, its ``error``, and whether it ended at an output time.
    """

    last_steps: tuple[Step, ...]
    next_step: float
    payload: Any = None
    steps: int = 0
    rejected: int = 0
    worst: float = 0.0
    solution: Any = None
    error: float = 0.0
    at_output: bool = False

    @property
    def time(self) -> float:
        """Reached [s]."""
        return self.last_steps[-1].time


@dataclass(frozen=True, kw_only=True)
class Plan:
    """The times and the accuracy of a run: output ``times`` [s], ``stops`` (times at which a step ends, these among
    them), those that are ``jumps`` of a history, the step after a start or a jump [s], the largest local error of a
    step."""

    times: np.ndarray
    stops: tuple[float, ...]
    jumps: frozenset[float]
    first_step: float
    tolerance: float

    @property
    def end(self) -> float:
        """Last output [s]."""
        return float(self.times[-1])


def checked_times(times: ArrayLike) -> np.ndarray:
    """Return the output times [s]: increasing, the first >= 0, the last > 0."""
    times = validate.array("times", times, "s", ndim=1)
    if times[0] < 0.0 or np.any(np.diff(times) <= 0.0) or times[-1] <= 0.0:
        raise InputError("times must increase from 0 s or later to a time above 0 s; allowed: 0 <= t1 < t2 < ... in s")
    return times


def plan_of(
    times: np.ndarray, histories: Iterable[History], first_step: float, tolerance: float, more: Iterable[float] = ()
) -> Plan:
    """Return the plan of a run up to the last of ``times`` [s] in which ``histories`` change. Steps end at ``more`` [s]
    too, which rise, unless a stop is close. Times that differ only by rounding become one, because no step is as short
    as that."""
    histories = tuple(histories)
    end = float(times[-1])
    jumps = _onto(times, [t for h in histories for t in h.jumps(end)])
    stops = np.union1d(times, jumps)
    stops = np.union1d(stops, _onto(stops, [t for h in histories for t in h.stops(end)]))
    others = np.array([*more], float)
    apart = np.min(np.abs(others[:, None] - stops), axis=1, initial=math.inf)
    stops = np.union1d(stops, others[(apart > SKIPPED_REST * np.diff(others, prepend=0.0)) & (others < end)])
    return Plan(
        times=times,
        stops=tuple(stops.tolist()),
        jumps=frozenset(jumps.tolist()),
        first_step=first_step,
        tolerance=tolerance,
    )


def _onto(known: np.ndarray, candidates: list[float]) -> np.ndarray:
    """Return the times ``candidates`` [s], rising. One that differs only by rounding from one of ``known``, or from the
    one before it, is replaced by that."""
    times = np.unique(np.array(candidates, float))
    times = times[np.diff(times, prepend=-np.inf) > STOP_ROUNDING * np.abs(times)]
    right = np.clip(np.searchsorted(known, times), 1, max(known.size - 1, 1))
    for near in (known[right - 1], known[np.minimum(right, known.size - 1)]):
        times = np.where(np.abs(near - times) <= STOP_ROUNDING * np.abs(times), near, times)
    return np.unique(times)


def initial_progress(first: Step, plan: Plan) -> Progress:
    """Return the progress at t = 0 with the state ``first``."""
    last_steps = (_for_later_steps(first),)
    return Progress(last_steps=last_steps, next_step=plan.first_step, payload=first.payload, solution=first)


def _for_later_steps(step: Step) -> Step:
    """Return what later steps need of ``step``."""
    return replace(step, payload=None, terms=None)


class Solver(Protocol):
    """Solves the equations of a step, and states its error."""

    def solve(self, time: float, memory: Memory, z: np.ndarray, payload: Any, /) -> Step:
        """Return the step that ends at ``time`` [s], from the unknowns ``z`` and the ``payload`` of the last step."""

    def error_of(self, step: Step, difference: np.ndarray, /) -> float:
        """Return the relative error of a step from the ``difference`` of its films or masses by the order of the
        method."""


def steps(solver: Solver, plan: Plan, now: Progress) -> Iterator[Progress]:
    """Yield the progress after every step from ``now`` on, until the end or until the shortest step fails. (Then the
    last time is before ``plan.end``.) A run can continue from any progress, so the caller needs to keep nothing
    else."""
    for stop in plan.stops:
        while now.time < stop:
            advanced = advance(now, stop, solver, plan.tolerance, LEAST_TIME_STEP_PART * plan.end)
            if advanced is None:
                return
            now = replace(advanced, at_output=advanced.time == stop and bool(np.any(plan.times == stop)))
            if now.time in plan.jumps:  # the same state without its past
                now = replace(now, last_steps=now.last_steps[-1:], next_step=plan.first_step)
            yield now


@dataclass(frozen=True, kw_only=True)
class Residual:
    """A residual of a run, over its tolerance: its ``value``, and as text ``what`` is not balanced, ``where`` the
    value was found, and the ``advice`` that makes it smaller."""

    value: float
    what: str
    where: str = ""
    advice: str = "set a smaller transient.tolerance"


def grid_residual(value: float) -> Residual:
    """Return the residual of the grid of a steady start, ``value`` over its tolerance."""
    advice = "set a looser numerics.film_tolerance: the finest grid of a run in time is reached"
    return Residual(value=value, what="the error of the film by its grid", where="at the start", advice=advice)


def report_of(
    solver: str,
    plan: Plan,
    now: Progress,
    cells: str,
    residuals: dict[str, Residual],
    ended: str = "",
    most_work: float = math.inf,
) -> Report:
    """Return the report of a run with these ``residuals``, and "step", the largest accepted local error. Its summary
    names what was reached, and of a run that reached its end the largest residual and where it is. ``ended``: the
    status of a run that ended before, if not by a step that failed, and ``most_work`` [s] the limit of its work."""
    residuals = {"step": Residual(value=now.worst, what="the local error of a step")} | residuals
    worst = max(residuals.values(), key=lambda residual: residual.value)
    status = CONVERGED
    summary = ""
    advice = ""
    if now.time < plan.end:
        status = STAGNATED
        why = "The shortest step did not converge"
        advice = "make the histories change less abruptly there, or set a looser transient.tolerance"
        if ended == STOPPED:
            status = STOPPED
            why = "The run was interrupted"
            advice = ""
        elif ended == WORK_LIMIT:
            status = WORK_LIMIT
            why = f"The remaining time needs more work than numerics.max_work = {most_work:.4g} s allows"
            advice = (
                "raise numerics.max_work (a run with a checkpoint continues from there), or loosen transient.tolerance"
            )
        done = int(np.searchsorted(plan.times, now.time, side="right"))
        summary = (
            f"stopped at t = {worded(now.time, 's')} of {worded(plan.end, 's')}, {done} of {plan.times.size} outputs "
            f"are solved. {why}"
        )
    elif not worst.value <= 1.0:
        status = ITERATION_LIMIT
        summary = (
            f"all {plan.times.size} outputs are solved, but {worst.what} is {plain_number(worst.value)} times its "
            f"tolerance{worst.where and ' ' + worst.where}"
        )
        advice = worst.advice
    return Report(
        solver=solver,
        status=status,
        iterations=now.steps,
        residual=worst.value,
        tolerance=1.0,
        residuals={name: residual.value for name, residual in residuals.items()},
        evaluations=now.steps + now.rejected,
        notes=(f"{cells}, {counted(now.rejected, 'steps')} rejected",),
        summary=summary,
        advice=advice,
    )


def advance(now: Progress, until: float, solver: Solver, tolerance: float, shortest: float) -> Progress | None:
    """Take one step towards ``until`` [s]. It is halved if it would leave a tiny last step. If its solve fails, or its
    error is above ``tolerance``, it is repeated with a shorter step. None: even the shortest step [s] failed."""
    rejected = now.rejected
    step = now.next_step
    while step >= shortest:
        left = until - now.time
        planned = left if step >= left * (1 - 1e-9) else min(step, 0.5 * left)
        end = now.time + planned if planned < left else until
        attempt = (_bdf2 if len(now.last_steps) > 1 else _pair)(now, end, solver)
        if attempt is None:
            step = FAILED * planned
            rejected += 1
            continue
        last_steps, solution, error, order = attempt
        change = max(TIME_STEP_SAFETY * (tolerance / max(error, 1e-30)) ** (1 / (order + 1)), LEAST_TIME_STEP_RATIO)
        if error <= tolerance:
            step = planned * min(change, TIME_STEP_GROWTH)
            error = error / tolerance
            worst = max(now.worst, error)
            return Progress(
                last_steps=last_steps,
                next_step=step,
                payload=solution.payload,
                steps=now.steps + 1,
                rejected=rejected,
                worst=worst,
                solution=solution,
                error=error,
            )
        step = planned * min(change, 0.9)
        rejected += 1
    return None


Attempt = tuple[tuple[Step, ...], Step, float, int]  # the last steps after it, its solution, error, order


def _solved(solver: Solver, time: float, memory: Memory, z: np.ndarray, payload: Any) -> Step | None:
    solution = solver.solve(time, memory, z, payload)
    return replace(solution, time=time) if solution.status == CONVERGED else None


def _pair(now: Progress, end: float, solver: Solver) -> Attempt | None:
    """Take steps of backward Euler over the full step and over its halves."""
    start = now.last_steps[-1]
    step = end - start.time
    middle = start.time + 0.5 * step
    single = _solved(solver, end, Memory(1.0 / step, start.film), start.z, now.payload)
    first = single and _solved(solver, middle, Memory(2.0 / step, start.film), start.z, now.payload)
    second = first and _solved(solver, end, Memory(2.0 / step, first.film), first.z, first.payload)
    if single is None or first is None or second is None:
        return None
    return (
        (start, _for_later_steps(first), _for_later_steps(second)),
        second,
        solver.error_of(second, single.film - second.film),
        1,
    )


def _bdf2(now: Progress, end: float, solver: Solver) -> Attempt | None:
    """Take a step of BDF2 over the last two steps, from unknowns extrapolated along them, or from the last ones if
    that fails."""
    old, last = now.last_steps[-2:]
    step = end - last.time
    before = last.time - old.time
    ratio = step / before
    weight = ratio**2 / (1.0 + 2.0 * ratio)
    rate = (1.0 + 2.0 * ratio) / ((1.0 + ratio) * step)
    film = last.film + weight * (last.film - old.film)
    memory = Memory(rate, film, last.film, step)
    guess = last.z + ratio * (last.z - old.z)  # zeros stay zero, positive unknowns positive
    guess[:-1] = np.where(last.z[:-1] > 0.0, np.maximum(guess[:-1], LEAST_LEFT * last.z[:-1]), 0.0)
    solution = _solved(solver, end, memory, guess, now.payload) or _solved(solver, end, memory, last.z, now.payload)
    if solution is None:
        return None
    last_steps = (*now.last_steps, _for_later_steps(solution))
    if len(last_steps) < 4:
        return last_steps, solution, 0.0, 2
    curve = _divided([each.time for each in last_steps], [each.film for each in last_steps])
    error = solver.error_of(solution, curve * step**2 * (step + before) ** 2 / (2.0 * step + before))
    return last_steps[1:], solution, error, 2


def _divided(times: list[float], values: list[np.ndarray]) -> np.ndarray:
    """Return the highest divided difference."""
    for k in range(1, len(times)):
        values = [(b - a) / (times[i + k] - times[i]) for i, (a, b) in enumerate(zip(values, values[1:]))]
    return values[0]
