"""Friction in time: `transient`, and its state on disk after every step, so that a kill loses nothing."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from .._base import clear_checked, read_checked, validate, write_checked
from ..deterministic import State
from ..errors import InputError
from ..scene import Scene, Transient, resolves_gap
from ..sharing import Prepared, Validity, refused, scene_of
from ..studies import classes_of, decode, encode, fingerprint
from .begin import begin
from .march import Plan, Progress, Step, begun, checked_times, plan_of, steps
from .moment import moment
from .one_gap import OneGap, begin_one_gap, moment_of_gap
from .result import Output, Solver, TransientResult, collect
from .sharing import Contact, changes

STATE, OUTPUTS = "state.bin", "output_*.bin"  # of a checkpoint
CLASSES = classes_of(Progress, Contact, Validity, State)  # that a state or an output may hold


def transient(
    scene: Scene | Prepared, times=None, *, checkpoint=None, on_step=None, raise_on_failure: bool = True
) -> TransientResult:
    """Film, load sharing and friction of a scene while speed, load, radius or viscosity change in time.

    The film obeys Eq. (6) with its squeeze term (`lubfric.time.film_equations`: Swift-Stieber complementarity, either
    side may rupture, no entrainment needed). It is integrated in time by variable-step BDF2 with error control
    (`lubfric.time`). At every step film and rough contact share the load of that moment, and close the volume of Eq.
    (8) over A, the strip of ``bodies.load`` (Akchurin et al. 2015, doi:10.1007/s11249-015-0536-z).

    Parameters
    ----------
    scene : with a `lubfric.Transient` in ``scene.transient``; or, with ``times``, without one: then nothing changes
    times : output times [s], increasing, >= 0; a step ends at each. None: the scene's own
    checkpoint : folder that receives the state after every step. An interrupted run of the same scene and times
        continues from there. It is removed when the run ends well
    on_step : called as on_step(time, duration, row) after every step; ``row`` holds the numbers of an output, or is
        None
    raise_on_failure : False returns what was computed, with its report

    Returns
    -------
    TransientResult

    Raises
    ------
    InputError : before any work
    ConvergenceError : the shortest step failed; carries the rows so far as its result
    ValidityError : at some time an assumption is violated so badly that f means nothing, and ``numerics.accept`` is
        false; carries the whole result

    Notes
    -----
    Film and surfaces are as hot as in steady motion at the speeds of the moment (``numerics.heat``).

    A step is solved when the largest residual of `lubfric.time.film_equations` is <= 1e-7 and |gap - film|/(gap +
    film) <= the volume tolerance. It is accepted when the root mean square of the local error over the pressurised
    film, relative to the film, is <= transient.tolerance. The residuals of the report are:

    - step: the largest accepted local error over that tolerance
    - mass, volume: the largest at an output, relative to their tolerances
    - grid: the discretisation error of the steady start over the film tolerance (if it starts steady)
    """
    scene, times = _with_plan(scene, times)
    folder = None if checkpoint is None else _folder(checkpoint)
    solver, start, grid_error = (begin_one_gap if resolves_gap(scene_of(scene)) else begin)(scene)
    scene, plan = solver.scene, changes(solver.scene)
    store = None if folder is None else Checkpoint(folder, solver.prepared, plan, times)
    tolerance = plan.tolerance or solver.time_error
    course = plan_of(times, plan.histories, solver.first_step, tolerance, solver.stops)
    now, outputs = _marched(solver, start, course, store, on_step)
    result = collect(solver, grid_error, course, now, outputs)
    if raise_on_failure:
        result.report.raise_if_failed(result)
        severe = sorted((e for entries in result.entries for e in entries if e.severe), key=lambda e: e.value)
        worst = {entry.what: entry for entry in severe}  # of each kind
        refused(tuple(worst.values()), scene.numerics.accept, result)
    if store is not None and result.report.converged:
        store.clear()
    return result


def _marched(
    solver: Solver, start: Step, plan: Plan, store: Checkpoint | None, on_step
) -> tuple[Progress, list[Output]]:
    def put_out(now: Progress) -> None:
        outputs.append(_output(solver, now))
        if store is not None:
            store.append(outputs[-1])

    now, outputs = (store and store.load()) or (begun(start, plan), [])
    if not outputs and plan.times[0] == 0.0:
        put_out(now)
    for now in steps(solver, plan, now):
        if now.at_output:
            put_out(now)
        if store is not None:
            store.save(_state(now))
        if on_step is not None:
            on_step(now.time, plan.end, outputs[-1][0] if now.at_output else None)
    return now, outputs


def _output(solver: Solver, now: Progress) -> Output:
    """Numbers and fields after the last step."""
    terms = now.solution.terms
    if isinstance(solver, OneGap):
        back = 1 if terms.problem.x[0] == solver.x[0] else -1
        fields = (field.mean(axis=1)[::back] for field in (terms.state.pressure, terms.balance.film))
        return (*moment_of_gap(solver, now), *fields)
    p = solver.setting.problem
    return (*moment(solver, now), terms.P * p.pressure_unit, terms.H * p.film_unit)


def _state(now: Progress) -> Progress:
    """All that a resumed run needs to give the same bits: ``now``, of the contact the pressure, from which the next one
    is solved, and not what the next step computes again."""
    if isinstance(now.payload, State):
        return replace(now, solution=None)
    state = now.payload.state
    fields = state.fields and replace(state.fields, gap=np.empty(0), displacement=np.empty(0))
    return replace(now, payload=replace(now.payload, state=replace(state, fields=fields, y=None)), solution=None)


def _with_plan(scene: Scene | Prepared, times) -> tuple[Scene | Prepared, np.ndarray]:
    """The scene with what changes until the last output, and the output times [s]."""
    base = scene_of(scene)
    plan = base.transient
    if times is None:
        if plan is None:
            raise InputError("scene has no [transient] table; give one, or output times in s")
        return scene, np.linspace(0.0, plan.duration, plan.outputs + 1)
    times = checked_times(times)
    last = float(times[-1])
    base = replace(base, transient=Transient(last) if plan is None else replace(plan, duration=last))
    return (replace(scene, scene=base) if isinstance(scene, Prepared) else base), times


class Checkpoint:
    """A folder that holds the state of one run: files with checksums, each replaced as a whole. The state carries a
    fingerprint of the problem and the number of outputs so far, which are written before it.

    ``description``: everything that decides the result, for `lubfric.studies.fingerprint`: the prepared scene with its
    heights and spacing, the histories, the output times.
    """

    def __init__(self, folder: Path, *description):
        self.folder, self.fingerprint = folder, fingerprint(*description)
        self._count = 0

    def load(self) -> tuple[Any, list[Any]] | None:
        """The state and the outputs of an interrupted run of the same problem, or None if there is none.

        Raises `InputError` for the state of another problem, and for files that were cut off or overwritten.
        """
        if not (self.folder / STATE).is_file():
            return None
        content = _content(self.folder / STATE)
        try:
            kept = decode(content, CLASSES)
        except ValueError:  # of another version
            kept = {"fingerprint": None}
        if kept["fingerprint"] != self.fingerprint:
            raise InputError(
                f"checkpoint in {self.folder} belongs to another run (scene, height map, times or version differ); "
                "run the same scene, or give an empty folder"
            )
        self._count = kept["outputs"]
        return kept["state"], [decode(_content(self._output(number)), CLASSES) for number in range(self._count)]

    def append(self, output) -> None:
        """Add one output: like the state, of dataclasses of this package, dicts, numbers and arrays."""
        write_checked(self._output(self._count), *encode(output))
        self._count += 1

    def save(self, state) -> None:
        """Replace the state."""
        kept = {"fingerprint": self.fingerprint, "outputs": self._count, "state": state}
        write_checked(self.folder / STATE, *encode(kept))

    def clear(self) -> None:
        """Remove the files of a finished run, and its folder if it is empty then."""
        clear_checked(self.folder, STATE, OUTPUTS)

    def _output(self, number: int) -> Path:
        return self.folder / OUTPUTS.replace("*", f"{number:07d}")


def _folder(given) -> Path:
    """The folder of a checkpoint. Raises `InputError` where a file of somebody else has its name, or that of one of its
    own."""
    folder = validate.folder("checkpoint", given)
    if folder.exists() and not folder.is_dir():
        raise InputError(f" = {str(folder)!r} is a file", "checkpoint", "a folder, existing or not")
    for path in (*folder.glob(STATE), *folder.glob(OUTPUTS)):
        _content(path)
    return folder


def _content(path: Path) -> bytes:
    content = read_checked(path) if path.is_file() and not path.is_symlink() else None
    if content is None:
        raise InputError(
            f"checkpoint file {path} is damaged (cut or overwritten), or not of lubfric; give an empty folder to begin "
            "again"
        )
    return content
