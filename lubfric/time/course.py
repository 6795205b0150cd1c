"""From output to output: the loop over the steps of a run, its plan, and its report."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from .._base import validate
from ..errors import CONVERGED, ITERATION_LIMIT, STAGNATED, InputError, Report
from ..scene import History
from .bdf import Progress, Solver, advance

SHORTEST = 1e-11  # of the duration: below it a step has failed for good
ROUNDING = 1e-13  # relative: times that are closer are one time; below that of `lubfric.scene.history`


@dataclass(frozen=True)
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


def checked_times(times) -> np.ndarray:
    """Output times [s]: increasing, the first >= 0, the last > 0."""
    times = validate.array("times", times, "s", ndim=1)
    if times[0] < 0.0 or np.any(np.diff(times) <= 0.0) or times[-1] <= 0.0:
        raise InputError("times must increase from 0 s or later to a time above 0 s; allowed: 0 <= t1 < t2 < ... in s")
    return times


def plan_of(times: np.ndarray, histories: Iterable[History], first_step: float, tolerance: float) -> Plan:
    """The plan of a run up to the last of ``times`` [s] in which ``histories`` change. Times that differ only by
    rounding become one, because no step is as short as that."""
    histories, end = tuple(histories), float(times[-1])
    jumps = _onto(times, [t for h in histories for t in h.jumps(end)])
    stops = np.union1d(times, jumps)
    stops = np.union1d(stops, _onto(stops, [t for h in histories for t in h.stops(end)]))
    return Plan(times, tuple(stops.tolist()), frozenset(jumps.tolist()), first_step, tolerance)


def _onto(known: np.ndarray, found: list[float]) -> np.ndarray:
    """The times ``found`` [s], rising. One that differs only by rounding from one of ``known``, or from the one before
    it, is replaced by that."""
    times = np.unique(np.array(found, float))
    times = times[np.diff(times, prepend=-np.inf) > ROUNDING * np.abs(times)]
    right = np.clip(np.searchsorted(known, times), 1, max(known.size - 1, 1))
    for near in (known[right - 1], known[np.minimum(right, known.size - 1)]):
        times = np.where(np.abs(near - times) <= ROUNDING * np.abs(times), near, times)
    return np.unique(times)


def steps(solver: Solver, plan: Plan, now: Progress) -> Iterator[Progress]:
    """The progress after every step from ``now`` on, until the end or until the shortest step fails. (Then the last
    time is before ``plan.end``.) A run can continue from any progress, so the caller needs to keep nothing else."""
    for stop in plan.stops:
        while now.time < stop:
            found = advance(now, stop, solver, plan.tolerance, SHORTEST * plan.end)
            if found is None:
                return
            now = replace(found, at_output=found.time == stop and bool(np.any(plan.times == stop)))
            if now.time in plan.jumps:  # the same state without its past
                now = replace(now, levels=now.levels[-1:], step=plan.first_step)
            yield now


def report_of(solver: str, plan: Plan, now: Progress, cells: str, residuals: dict[str, float]) -> Report:
    """The report of a run: ``residuals``, each over its tolerance, and "step", the largest accepted local error."""
    residuals = {"step": now.worst} | residuals
    status = CONVERGED if now.time >= plan.end else STAGNATED
    if status == CONVERGED and not max(residuals.values()) <= 1.0:
        status = ITERATION_LIMIT
    notes = [f"{cells}, {now.rejected} steps rejected"]
    if status == STAGNATED:
        notes.append(f"stopped at t = {now.time:.6g} s: the shortest step failed")
    return Report(
        solver,
        status,
        now.steps,
        max(residuals.values()),
        1.0,
        residuals,
        evaluations=now.steps + now.rejected,
        notes=tuple(notes),
    )
