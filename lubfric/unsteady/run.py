"""Friction in time: `transient`."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .. import __version__, validate
from ..ehl.bdf import Level, March, advance, restarted
from ..ehl.transient import SHORTEST, stops_and_jumps
from ..errors import InputError
from ..mixed import Model
from ..patch import Closure
from ..report import CONVERGED, ITERATION_LIMIT, STAGNATED, Report
from ..scene import Scene
from .checkpoint import Checkpoint
from .history import Transient
from .row import UNITS, moment
from .sharing import Contact
from .start import Run, begin, first_level


@dataclass(frozen=True)
class TransientResult:
    """Arrays over time (nt,), one per name of `lubfric.unsteady.row.UNITS`, also as attributes:
    ``result.coefficient``.

    time [s]; x [m] (nx,); pressure [Pa] and film_thickness [m] (nt, nx): of the smooth film at the output
    times. coefficient: tangential force on the upper surface in the direction in which it slides over the
    lower one, over F_T; friction_force and its parts [N] along +x. mean_film, mean_gap: both sides of Eq.
    (8). wet_from, wet_to [m]: ends of the pressurised film. net_inflow, stored, cavity_growth [m²/s]: the
    lubricant's balance over the last step, per unit width. time_error: local error of the last step, of
    the tolerance.
    """

    columns: dict[str, np.ndarray]
    x: np.ndarray
    pressure: np.ndarray
    film_thickness: np.ndarray
    report: Report

    def __getattr__(self, name):
        columns = self.__dict__.get("columns", {})
        if name in columns:
            return columns[name]
        raise AttributeError(f"TransientResult has no attribute {name!r}{validate.nearest(name, columns)}")


def transient(
    scene: Scene | Model, times=None, *, checkpoint=None, on_step=None, raise_on_failure: bool = True
) -> TransientResult:
    """Film, load sharing and friction of ``scene`` while speed, load, radius or viscosity change in time.

    The film obeys Eq. (6) with its squeeze term (`lubfric.ehl.squeeze`: Swift-Stieber complementarity,
    either side may rupture, no entrainment needed), marched by variable-step BDF2 with error control
    (`lubfric.ehl.bdf`); at every step film and rough contact share the load of that moment and close the
    volume of Eq. (8) over A, the strip of ``bodies.load`` (Akchurin et al. 2015,
    doi:10.1007/s11249-015-0536-z).

    Parameters
    ----------
    scene : with a `lubfric.unsteady.history.Transient` in ``scene.transient`` (or, with ``times``, without: then
    nothing changes)
    times : output times [s], increasing, >= 0; a step ends at each. None: the scene's own
    checkpoint : folder that receives the state after every step; an interrupted run of the same scene and
        times goes on from there. Removed when the run ends well
    on_step : called as on_step(time, duration, row) after every step, ``row`` the numbers of an output or
        None

    Returns a `TransientResult`. Stops a step when max(residuals of `lubfric.ehl.active_set.measure`) <=
    1e-7 and |gap - film|/(gap + film) <= volume tolerance; accepts it when the root mean square of the
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
    store = None if checkpoint is None else Checkpoint(checkpoint, [base, plan, list(times), __version__])
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


@dataclass
class _Progress:
    """What grows while a run goes on."""

    march: March
    rows: list
    fields: list
    steps: int = 0
    rejected: int = 0
    worst: float = 0.0


def _run(run: Run, times, store, on_step) -> TransientResult:
    plan = run.plan
    now = _resume(run, store) or _Progress(
        March((first_level(run),), run.first_step, run.start.payload), [], []
    )
    if not now.rows and times[0] == 0.0:
        _keep(run, now, store, 0.0, run.start, None)
    stops, jumps = stops_and_jumps(run.histories, times, plan.duration)
    for stop in stops:
        while now.march.time < stop:
            advanced = advance(
                now.march, stop, run.solve, run.error_of, run.tolerance, SHORTEST * plan.duration
            )
            if advanced is None:
                return _collect(run, now, STAGNATED)
            now.march, now.steps, now.rejected = (
                advanced.march,
                now.steps + 1,
                now.rejected + advanced.rejected,
            )
            now.worst = max(now.worst, advanced.error)
            output = now.march.time == stop and bool(np.any(times == stop))
            if output:
                _keep(run, now, store, stop, advanced.solution, advanced)
            if now.march.time in jumps:
                now.march = restarted(now.march, run.first_step)
            if store:
                store.save(_state(run, now))
            if on_step:
                on_step(now.march.time, plan.duration, dict(zip(UNITS, now.rows[-1])) if output else None)
    return _collect(run, now, CONVERGED)


def _keep(run: Run, now: _Progress, store, time, solution, advanced) -> None:
    row = moment(
        run.sharing,
        time,
        run.sliding_speed(time),
        run.model.scene.bodies.boundary_friction_coefficient,
        solution,
        solution.payload,
        advanced,
        now.steps,
    )
    now.rows.append(np.array(list(row.values()), dtype=float))
    now.fields.append(np.concatenate([solution.terms.P, solution.terms.H]))
    if store:
        store.append(now.rows[-1], now.fields[-1])


def _state(run: Run, now: _Progress) -> dict:
    contact, closure = now.march.payload, now.march.payload.closure
    pressure = getattr(closure.contact, "pressure", closure.contact)
    return {
        "outputs": len(now.rows),
        "row_size": len(UNITS),
        "field_size": 2 * (run.sharing.setting.grid.n + 1),
        "steps": np.array([now.steps, now.rejected, now.worst, now.march.step]),
        "level_times": np.array([level.time for level in now.march.levels]),
        "level_films": np.array([level.film for level in now.march.levels]),
        "level_z": np.array([level.z for level in now.march.levels]),
        "contact": np.array(
            [
                contact.load,
                contact.softness,
                closure.mean_gap,
                closure.mean_film,
                closure.real_contact_area_fraction,
                closure.plastic_area_fraction,
            ]
        ),
        "contact_fraction": closure.contact_fraction,
        "contact_pressure": np.zeros((0, 0)) if pressure is None else pressure,
    }


def _resume(run: Run, store) -> _Progress | None:
    found = store.load() if store else None
    if found is None:
        return None
    state, rows, fields = found
    steps, rejected, worst, step = state["steps"]
    load, softness, gap, film, real, plastic = (float(v) for v in state["contact"])
    pressure = state["contact_pressure"]
    closure = Closure(
        gap,
        film,
        run.sharing.patch.x,
        state["contact_fraction"],
        real,
        plastic,
        pressure if pressure.size else None,
    )
    levels = tuple(
        Level(float(t), y, z) for t, y, z in zip(state["level_times"], state["level_films"], state["level_z"])
    )
    return _Progress(
        March(levels, float(step), Contact(load, closure, softness)),
        list(rows),
        list(fields),
        int(steps),
        int(rejected),
        float(worst),
    )


def _collect(run: Run, now: _Progress, status: str) -> TransientResult:
    setting, scene = run.sharing.setting, run.model.scene
    p, n = setting.problem, setting.grid.n + 1
    table = np.array(now.rows).reshape(len(now.rows), len(UNITS))
    columns = dict(zip(UNITS, table.T))
    fields = np.array(now.fields).reshape(len(now.fields), 2 * n)
    worst = {
        "step": now.worst,
        "mass": float(np.max(columns["mass_residual"], initial=0.0)) / 1e-3,
        "volume": float(np.max(np.abs(columns["volume_residual"]), initial=0.0)) / run.sharing.tolerance,
    }
    if not np.isnan(run.grid_error):
        worst["grid"] = run.grid_error / scene.numerics.film_tolerance
    if status == CONVERGED and not max(worst.values()) <= 1.0:
        status = ITERATION_LIMIT
    notes = (f"{setting.grid.n} cells, {now.rejected} steps rejected",)
    if status == STAGNATED:
        notes += (f"stopped at t = {now.march.time:.6g} s: the shortest step failed",)
    report = Report(
        "transient, BDF2",
        status,
        now.steps,
        max(worst.values()),
        1.0,
        worst,
        evaluations=now.steps + now.rejected,
        notes=notes,
    )
    return TransientResult(
        columns,
        setting.grid.x * p.length_unit,
        fields[:, :n] * p.pressure_unit,
        fields[:, n:] * p.film_unit,
        report,
    )
