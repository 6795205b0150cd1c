"""Stribeck curves: friction over speed, neighbours warm-started, nothing lost to a failing point."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from . import validate
from .errors import ConvergenceError, InputError, ValidityError
from .model import Model, at_tolerance, scene_of
from .report import CONVERGED, ITERATION_LIMIT, Report
from .scene import Scene
from .steady import FrictionResult, friction
from .validity.entry import Validity
from .validity.gather import gathered

NOT_NUMBERS = ("report", "balance", "decision", "validity")
QUANTITIES = tuple(f for f in FrictionResult.__dataclass_fields__ if f not in NOT_NUMBERS)


@dataclass(frozen=True)
class StribeckResult:
    """Arrays over speed (in the order asked for), NaN where a point failed.

    Every number of `FrictionResult` is an array attribute of the same name. ``points`` holds the
    results themselves (None where failed), ``errors`` {index: the exception raised there}; that of a point outside the range
    of the model is a `ValidityError` with the point's result. ``validity``: what does not hold, gathered over the speeds.
    """

    speed: np.ndarray
    coefficient: np.ndarray
    contact_load: np.ndarray
    film_load: np.ndarray
    shear_force: np.ndarray
    couette_force: np.ndarray
    rolling_force: np.ndarray
    boundary_force: np.ndarray
    real_contact_area_fraction: np.ndarray
    real_contact_area: np.ndarray
    plastic_area_fraction: np.ndarray
    min_film: np.ndarray
    central_film: np.ndarray
    mean_gap: np.ndarray
    film_to_roughness_ratio: np.ndarray
    inlet_film_factor: np.ndarray
    flash_temperature_rise: np.ndarray
    film_temperature_rise: np.ndarray
    load_residual: np.ndarray
    volume_residual: np.ndarray
    seconds: np.ndarray
    points: tuple[FrictionResult | None, ...]
    errors: dict[int, Exception]
    report: Report

    def entries(self, index: int) -> tuple[Validity, ...]:
        """Assumptions that do not hold at a speed, refused or not."""
        point, error = self.points[index], self.errors.get(index)
        if point is None and isinstance(error, ValidityError) and error.result is not None:
            return error.result.validity
        return () if point is None else point.validity

    @property
    def validity(self) -> tuple[str, ...]:
        """One sentence for each assumption that does not hold somewhere."""
        return gathered([(float(u), self.entries(i)) for i, u in enumerate(self.speed)])


def stribeck(
    scene: Scene | Model,
    speeds=None,
    executor=None,
    *,
    tolerance: float | None = None,
    model: str | None = None,
    fields=False,
    on_point=None,
    raise_on_failure: bool = True,
) -> StribeckResult:
    """The Stribeck curve of ``scene`` at entrainment ``speeds`` [m/s] (default: the scene's own).

    Speeds are solved from the fastest down, each started from its neighbour. ``executor``: any
    `concurrent.futures.Executor`; the speeds are then split into neighbouring runs. ``on_point(done, total,
    speed, outcome)`` is called as points end, the outcome a `FrictionResult` or an exception. ``tolerance``, ``model``: as
    in `lubfric.friction`. ``fields``: keep film and contact, on the scene's own contact grid, of every point (True) or of
    the speeds listed.
    A failing point leaves NaN and its exception in ``errors``; the others are still solved, and then
    `ConvergenceError`, or `ValidityError` where all that failed is outside the range of the model, is raised with the whole curve
    as its ``result`` (``raise_on_failure=False`` returns it).
    """
    if executor is not None and not hasattr(executor, "submit"):
        raise InputError(f"executor = {executor!r}; allowed: None or a concurrent.futures.Executor")
    motion = scene_of(scene).motion
    if speeds is None:
        speeds = motion.speeds or (motion.entrainment_speed,)
    speeds = validate.array("speeds", [speeds] if np.ndim(speeds) == 0 else speeds, "m/s", ndim=1)
    model = at_tolerance(scene, tolerance, model)
    kept = speeds if fields is True else np.atleast_1d(np.asarray(fields or [], float))
    order = np.argsort(-np.abs(speeds), kind="stable")
    runs = [order] if executor is None else np.array_split(order, min(order.size, 8))
    points, errors = [None] * speeds.size, {}

    def keep(outcomes):
        for index, outcome in outcomes:
            (errors if isinstance(outcome, Exception) else points)[index] = outcome
            if on_point:
                on_point(len(errors) + sum(p is not None for p in points), speeds.size, float(speeds[index]), outcome)

    if executor is None:
        keep(_run(model, [(int(i), float(speeds[i])) for i in order], kept))
    else:
        _spread(executor, model, speeds, runs, kept, keep)
    result = _collect(speeds, points, errors)
    refused = [error for error in errors.values() if isinstance(error, ValidityError)]
    if raise_on_failure and errors and len(refused) == len(errors):
        raise ValidityError("; ".join(result.validity), tuple(e for error in refused for e in error.entries), result)
    if raise_on_failure and errors:
        raise ConvergenceError(result.report.message + "; first: " + str(errors[min(errors)]), result.report, result)
    return result


def _run(model, cases, fields):
    """Yield (index, FrictionResult or exception) along neighbouring speeds."""
    start = None
    for index, speed in cases:
        try:
            start = friction(model, speed, start=start, fields=speed in fields)
        except ValidityError as error:
            start = error.result if error.result.balance.film is not None else None
            yield index, ValidityError(error.message, error.entries, replace(error.result, balance=None))
        except Exception as error:  # kept in ``errors``; raised once every point is done
            start = None
            yield index, error
        else:
            yield index, start if speed in fields else replace(start, balance=None)
            start = start if start.balance.film is not None else None


def _run_list(model, cases, fields):
    return list(_run(model, cases, fields))


def _spread(executor, model, speeds, runs, fields, keep) -> None:
    from concurrent.futures import as_completed

    futures = {
        executor.submit(_run_list, model, [(int(i), float(speeds[i])) for i in run], fields): run for run in runs
    }
    for future in as_completed(futures):
        try:
            keep(future.result())
        except Exception as error:  # a lost worker fails its own speeds, not the sweep
            keep([(int(i), error) for i in futures[future]])


def _collect(speeds, points, errors) -> StribeckResult:
    columns = {name: np.array([np.nan if p is None else getattr(p, name) for p in points]) for name in QUANTITIES}
    columns["speed"] = speeds
    worst = max((p.report.residual for p in points if p is not None), default=np.inf)
    tolerance = max((p.report.tolerance for p in points if p is not None), default=0.0)
    status = ITERATION_LIMIT if errors else CONVERGED
    notes = tuple(f"speed {speeds[i]:g} m/s: {error}" for i, error in sorted(errors.items()))
    report = Report("stribeck", status, speeds.size - len(errors), float(worst), float(tolerance), notes=notes)
    return StribeckResult(**columns, points=tuple(points), errors=errors, report=report)
