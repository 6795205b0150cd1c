"""Friction in time: `transient`, and its state on disk after every step, so that a kill loses nothing."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .._base import limited_work, unlimited_work, validate, with_default_errors
from .._base.processor_time import processor_time
from ..errors import STOPPED, WORK_LIMIT, InputError, WorkLimitError
from ..estimate import most_work_of_estimate
from ..models.shared import Prepared, Violation, refused, scene_of
from ..scene import Scene, Transient
from ..studies import Store, classes_of, digest, fingerprint_without_files, opened
from .march import Plan, Progress, Step, checked_times, initial_progress, plan_of, steps
from .model import Output, TimeModel
from .registry import RUNS, estimated_run, run_model_of
from .result import TransientResult, collect
from .scene_in_time import transient_of

# Classes that a state or an output of a run may hold.
RUN_CLASSES = classes_of(Progress, Output, Violation, *(run.state_class for run in RUNS.values()))
# What is kept of a run: how many outputs there are, its progress, and the processor time until then [s].
STATE = tuple[int, Progress, float]


@with_default_errors
def transient(
    scene: Scene | Prepared,
    times: ArrayLike | None = None,
    *,
    checkpoint: str | Path | None = None,
    on_step: Callable[[float, float, dict[str, float] | None], None] | None = None,
    raise_on_failure: bool = True,
) -> TransientResult:
    """Solve film, load sharing and friction of a scene while speed, load, radius or viscosity change in time.

    The film obeys Eq. (6) with its squeeze term (`lubfric.time.film_equations`: Swift-Stieber complementarity, either
    side may rupture, no entrainment needed), by variable-step BDF2 with error control. At every step film and rough
    contact share the load of that moment, and satisfy the balance of volume, Eq. (8), over A, the strip of
    ``bodies.load`` (Akchurin et al. 2015, doi:10.1007/s11249-015-0536-z). In the deterministic model, film and contact
    have one rough gap.

    Parameters
    ----------
    scene : with a `lubfric.Transient` in ``scene.transient``; or, with ``times``, without one: then nothing changes
    times : output times [s], increasing, >= 0; a step ends at each. None: the scene's own
    checkpoint : folder that receives the state after every step, a store as that of `lubfric.study`. An interrupted run
        of the same scene and times continues from there; states of other runs are not changed. The saved state is
        removed when the run ends without error
    on_step : called as on_step(time, duration, row) after every step; ``row``: the numbers of an output, or None
    raise_on_failure : False returns what was computed, with its report

    Returns
    -------
    TransientResult

    Raises
    ------
    InputError : before any work
    ConvergenceError : the shortest step failed; carries the rows so far as its result
    ValidityError : at some time an assumption is violated so strongly that f has no meaning, and ``numerics.accept`` is
        false; carries the complete result

    Notes
    -----
    Film and surfaces are as hot as in steady motion at the speeds of the moment (``numerics.heat``).

    A step is solved when the largest residual of `lubfric.time.film_equations` is <= 1e-7 and |gap - film|/(gap +
    film) <= the volume tolerance. It is accepted when the root mean square of the local error over the pressurised
    film, relative to the film, is <= transient.tolerance. The residuals of the report are:

    - step: the largest accepted local error over that tolerance
    - mass, volume: the largest at an output, relative to their tolerances
    - grid: the discretisation error of the steady start over the film tolerance (if it starts steady)

    A run ends at ``numerics.max_work`` [s] of counted work (None: ten times the estimate, at least 120 s), with the
    outputs so far and the status "work_limit". The same run with a ``checkpoint`` and a larger limit continues from
    there.
    """
    result, keys = run_in_time(scene, times, checkpoint=checkpoint, on_step=on_step)
    if raise_on_failure:
        raise_if_failed(result, accept=scene_of(scene).numerics.accept)
    if result.report.converged:
        with opened(checkpoint, RUN_CLASSES, "checkpoint") as store:
            store.clear(keys)
    return result


def raise_if_failed(result: TransientResult, *, accept: bool) -> None:
    """Raise `ConvergenceError` where the run did not end, and `ValidityError` where f means nothing at some time,
    unless ``accept``. Both carry the ``result``."""
    result.report.raise_if_failed(result)
    severe = sorted((e for violations in result.violations for e in violations if e.severe), key=lambda e: e.value)
    worst = {violation.what: violation for violation in severe}  # of each kind
    refused(tuple(worst.values()), accept=accept, result=result)


@with_default_errors
def run_in_time(
    scene: Scene | Prepared,
    times: ArrayLike | None = None,
    *,
    checkpoint: str | Path | None = None,
    on_step: Callable[[float, float, dict[str, float] | None], None] | None = None,
    on_begin: Callable[[float, float], None] | None = None,
    on_interrupt: Callable[[KeyboardInterrupt], None] | None = None,
) -> tuple[TransientResult, list[str]]:
    """Return the run of `transient`, whether it ended well or not, and the keys of its states and outputs, which the
    ``checkpoint`` keeps. ``on_begin``: called before the first step as on_begin(time, seconds), with the time [s] from
    which the run continues, and the processor time of the calls that solved it until there. ``on_interrupt``: takes
    an interrupt after the first output; then the outputs so far are returned, with the status "interrupted"."""
    begun = processor_time()
    validate.called_back("on_step", on_step, "time, duration, row")
    scene, times = _with_times(scene, times)
    limit = scene_of(scene).numerics.max_work or math.inf
    with limited_work(limit) as counted:
        start = run_model_of(scene_of(scene)).start(scene)
    model = start.model
    section = transient_of(model.scene)
    tolerance = section.tolerance or model.time_error
    plan = plan_of(times, section.histories, model.first_step, tolerance, model.stops)
    key = fingerprint_without_files(without_work_limit(replace(model.prepared, scene=model.scene)), section, times)
    if math.isinf(limit):
        seconds = estimated_run(model.scene, model.prepared.sample, model.prepared.surface).seconds
        limit = most_work_of_estimate(seconds)
    with opened(checkpoint, RUN_CLASSES, "checkpoint") as store:
        progress, outputs, ended = _marched(
            model,
            start.state,
            plan,
            store,
            key,
            on_begin=on_begin,
            on_step=on_step,
            most_work=limit - counted.spent,
            begun=begun,
            on_interrupt=on_interrupt,
        )
    result = collect(model, start.grid_error, plan, progress, outputs, ended, limit)
    return result, [key, *_output_keys(key, len(outputs))]


def without_work_limit(prepared: Prepared) -> Prepared:
    """Return ``prepared`` without the limit of its counted work, on which no number of a run in time depends."""
    scene = prepared.scene
    return replace(prepared, scene=replace(scene, numerics=replace(scene.numerics, max_work=None)))


def _output_keys(key: str, count: int) -> list[str]:
    return [digest([key, number]) for number in range(count)]


def _marched(
    model: TimeModel,
    start: Step,
    plan: Plan,
    store: Store,
    key: str,
    *,
    on_begin: Callable[..., Any] | None,
    on_step: Callable[..., Any] | None,
    most_work: float,
    begun: float,
    on_interrupt: Callable[[KeyboardInterrupt], None] | None,
) -> tuple[Progress, list[Output], str]:
    """Return the last progress of a run, its outputs, and the status with which ``most_work`` [s] of counted work or an
    interrupt ended it; "" where it ended by itself. The run continues from where the ``store`` has it under ``key``, if
    it does: from its state, with all outputs that the state counts, which were stored before it. ``begun``: the processor time [s] at the begin of the call."""
    count, progress, earlier = store.get(key, STATE) or (0, initial_progress(start, plan), 0.0)
    outputs: list[Output] = [*store.known(_output_keys(key, count), Output).values()]
    if len(outputs) < count:  # one was damaged, which the store has reported
        progress = initial_progress(start, plan)
        outputs = []

    def record(progress: Progress) -> None:
        outputs.append(model.record(progress))
        store.add(_output_keys(key, len(outputs))[-1], outputs[-1], sync=True)

    if on_begin is not None:
        on_begin(progress.time, earlier)
    if not outputs and plan.times[0] == 0.0:
        record(progress)
    try:
        with limited_work(most_work):
            for progress in steps(model, plan, progress):
                with unlimited_work():  # of a step that is solved
                    if progress.at_output:
                        record(progress)
                    if store.folder is not None:
                        spent = earlier + processor_time() - begun
                        store.add(key, (len(outputs), model.resumable(progress), spent), sync=True)
                    if on_step is not None:
                        on_step(progress.time, plan.end, outputs[-1].numbers if progress.at_output else None)
    except WorkLimitError:
        return progress, outputs, WORK_LIMIT
    except KeyboardInterrupt as interrupt:
        if on_interrupt is None or not outputs:
            raise
        on_interrupt(interrupt)
        return progress, outputs, STOPPED
    return progress, outputs, ""


def _with_times(scene: Scene | Prepared, times: ArrayLike | None) -> tuple[Scene | Prepared, np.ndarray]:
    """Return the scene with what changes until the last output, and the output times [s]."""
    base = scene_of(scene)
    section = base.transient
    if times is None:
        if section is None:
            raise InputError("scene has no [transient] table; give one, or output times in s")
        return scene, section.output_times
    times = checked_times(times)
    last = float(times[-1])
    until_last = Transient(last) if section is None else replace(section, duration=last, first_output=0.0)
    base = replace(base, transient=until_last)
    return (replace(scene, scene=base) if isinstance(scene, Prepared) else base), times
