"""Friction in time: `transient`."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .. import validate
from ..ehl.transient.bdf import March, advance, restarted
from ..ehl.transient.solve import SHORTEST, stops_and_jumps
from ..errors import InputError
from ..history.plan import Transient
from ..model import Model
from ..report import CONVERGED, STAGNATED
from ..scene import Scene
from .checkpoint import Checkpoint
from .progress import Progress, keep, resume, state_of
from .result import TransientResult, collect
from .row import UNITS
from .setup import Run, begin, first_level


def transient(
    scene: Scene | Model, times=None, *, checkpoint=None, on_step=None, raise_on_failure: bool = True
) -> TransientResult:
    """Film, load sharing and friction of ``scene`` while speed, load, radius or viscosity change in time.

    The film obeys Eq. (6) with its squeeze term (`lubfric.ehl.transient.squeeze`: Swift-Stieber
    complementarity, either side may rupture, no entrainment needed), marched by variable-step BDF2 with error
    control (`lubfric.ehl.transient.bdf`); at every step film and rough contact share the load of that moment
    and close the volume of Eq. (8) over A, the strip of ``bodies.load`` (Akchurin et al. 2015,
    doi:10.1007/s11249-015-0536-z).

    Parameters
    ----------
    scene : with a `lubfric.Transient` in ``scene.transient`` (or, with ``times``, without: then nothing
        changes)
    times : output times [s], increasing, >= 0; a step ends at each. None: the scene's own
    checkpoint : folder that receives the state after every step; an interrupted run of the same scene and
        times goes on from there. Removed when the run ends well
    on_step : called as on_step(time, duration, row) after every step, ``row`` the numbers of an output or
        None

    Returns a `TransientResult`. Stops a step when max(residuals of `lubfric.ehl.transient.active_set.measure`)
    <= 1e-7 and |gap - film|/(gap + film) <= volume tolerance; accepts it when the root mean square of the
    local error over the pressurised film, relative to the film, <= transient.tolerance. report.residuals:
    "step" the largest accepted local error over that tolerance, "mass" and "volume", the largest at an
    output, relative to their tolerances, "grid" the discretisation error of the steady start over the film
    tolerance (where it starts steady).

    Raises `InputError` before any work; `ConvergenceError`, with the rows so far as its result, when the
    shortest step fails.
    """
    base = scene.scene if isinstance(scene, Model) else scene
    plan, times = _plan(base, times)
    run = begin(scene, plan)
    store = None if checkpoint is None else Checkpoint(checkpoint, [run.model, plan, times])
    result = _run(run, times, store, on_step)
    if raise_on_failure:
        result.report.raise_if_failed(result)
    if store is not None and result.report.converged:
        store.clear()
    return result


def _plan(scene: Scene, times) -> tuple[Transient, np.ndarray]:
    plan = scene.transient
    if times is None:
        if plan is None:
            raise InputError("scene has no [transient] table; allowed: one, or output times in s")
        return plan, np.linspace(0.0, plan.duration, plan.outputs + 1)
    times = validate.array("times", times, "s", ndim=1)
    if times[0] < 0.0 or np.any(np.diff(times) <= 0.0):
        raise InputError("times must increase and not be negative; allowed: 0 <= t1 < t2 < ... in s")
    last = float(times[-1])
    if last <= 0.0:
        raise InputError(f"times end at {last:g} s; allowed: > 0 s")
    plan = Transient(last) if plan is None else replace(plan, duration=last)
    return plan, times


def _run(run: Run, times, store, on_step) -> TransientResult:
    plan = run.plan
    now = resume(run, store) or Progress(March((first_level(run),), run.first_step, run.start.payload), [], [])
    if not now.rows and times[0] == 0.0:
        keep(run, now, store, 0.0, run.start, None)
    stops, jumps = stops_and_jumps(run.histories, times, plan.duration)
    for stop in stops:
        while now.march.time < stop:
            advanced = advance(now.march, stop, run.solve, run.error_of, run.tolerance, SHORTEST * plan.duration)
            if advanced is None:
                return collect(run, now, STAGNATED)
            now.march, now.steps, now.rejected = (
                advanced.march,
                now.steps + 1,
                now.rejected + advanced.rejected,
            )
            now.worst = max(now.worst, advanced.error)
            output = now.march.time == stop and bool(np.any(times == stop))
            if output:
                keep(run, now, store, stop, advanced.solution, advanced)
            if now.march.time in jumps:
                now.march = restarted(now.march, run.first_step)
            if store:
                store.save(state_of(run, now))
            if on_step:
                on_step(now.march.time, plan.duration, dict(zip(UNITS, now.rows[-1])) if output else None)
    return collect(run, now, CONVERGED)
