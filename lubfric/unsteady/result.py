"""What a run gives: `TransientResult`, with its report."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import validate
from ..report import CONVERGED, ITERATION_LIMIT, STAGNATED, Report
from .progress import Progress
from .row import UNITS
from .setup import Run


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


def collect(run: Run, now: Progress, status: str) -> TransientResult:
    """The result of the rows and fields so far."""
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
