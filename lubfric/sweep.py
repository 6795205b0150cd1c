"""Stribeck curves: friction over speed, neighbours warm-started, nothing lost to a failing point."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from numbers import Real

import numpy as np

from . import validate
from .curve.choose import next_speed
from .curve.interpolate import Interpolant, knee_of
from .curve.span import span
from .errors import ConvergenceError, InputError, ValidityError
from .prepared import Prepared, at_tolerance, scene_of
from .report import CONVERGED, ITERATION_LIMIT, Report
from .result import FrictionResult
from .sampling.uncertainty import FIELDS, UncertaintyCurve, curve_of
from .scene import Scene
from .show import Shown
from .store import fingerprint
from .studies.adaptive import FEWEST, Search, run_adaptive, samples_of
from .studies.chain import Chain, make_chain
from .studies.journal import Journal
from .studies.solve import solve_chains
from .validity.entry import Validity
from .validity.gather import gathered

AUTO = "auto"
FAILED_SPEEDS = "the other speeds are in .result, the reason of each failed one in its .errors"
NOT_NUMBERS = (
    "report",
    "balance",
    "decision",
    "validity",
    "deterministic",
    "one_way",
    "uncertainty",
    "errors",
    "line",
)
QUANTITIES = tuple(f for f in FrictionResult.__dataclass_fields__ if f not in NOT_NUMBERS)


@dataclass(frozen=True, repr=False)
class StribeckResult(Shown):
    """Arrays over speed (in the order asked for), NaN where a point failed.

    Every number of `FrictionResult` is an array attribute of the same name. ``points`` holds the
    results themselves (None where failed), ``errors`` {index: the exception raised there}; that of a point outside the
    range of the model is a `ValidityError` with the point's result. ``validity``: what does not hold, gathered over the
    speeds; ``uncertainty``: arrays of the numbers of `Uncertainty` (`UncertaintyCurve`), ``field_errors`` {quantity:
    its relative errors, an array}. One line of the surface serves all speeds, so their errors go up and down together.
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
    uncertainty: UncertaintyCurve
    field_errors: dict[str, np.ndarray]

    def entries(self, index: int) -> tuple[Validity, ...]:
        """Assumptions that do not hold at a speed, refused or not."""
        point, error = self.points[index], self.errors.get(index)
        if point is None and isinstance(error, ValidityError) and error.result is not None:
            return error.result.validity
        return () if point is None else point.validity

    def at(self, speed) -> np.ndarray:
        """f at any speeds [m/s] between the slowest and the fastest, interpolated (`lubfric.curve.interpolate`)."""
        contact, film = self.parts_at(speed)
        return contact + film

    def parts_at(self, speed) -> tuple[np.ndarray, np.ndarray]:
        """(from the contact spots, from the film): the two parts of f at any speeds [m/s], as `at`."""
        curve = self._interpolant
        known = curve.samples.speed
        at = np.abs(validate.array("speed", np.atleast_1d(speed), "m/s", ndim=1))
        if at.min() < known[0] * (1 - 1e-9) or at.max() > known[-1] * (1 + 1e-9):
            raise InputError(
                f"speed = {speed!r} m/s; allowed: {known[0]:g} to {known[-1]:g} m/s, where the curve is known"
            )
        return curve.boundary(at).reshape(np.shape(speed)), curve.film(at).reshape(np.shape(speed))

    @property
    def lift_off(self) -> float | None:
        """The speed [m/s] at which the film lifts the surfaces off each other; None where the curve does not reach
        it."""
        return self._interpolant.lift_off

    @cached_property
    def _interpolant(self) -> Interpolant:
        points = [p for p in self.points if p is not None and p.speed != 0]
        if len(points) < FEWEST or len({abs(p.speed) for p in points}) < len(points):
            raise InputError(
                f"{len(points)} speeds are solved; allowed for a curve between them: {FEWEST} different ones"
            )
        samples = samples_of(points)
        return Interpolant(samples, knee_of(samples))

    def plot(self, ax=None, **style):
        """Friction over speed, with its parts, on ``ax`` or new axes, which are returned; ``style``: of the line."""
        from .show.axes import curve_axes

        return curve_axes(self, ax, **style)

    def _facts(self) -> dict[str, str]:
        facts = {"": f"{self.speed.size} speeds"}
        if self.speed.size > len(self.errors):
            good = np.isfinite(self.coefficient)
            facts |= {
                "U": f"{self.speed[good].min():.4g} to {self.speed[good].max():.4g} m/s",
                "f": f"{self.coefficient[good].min():.4g} to {self.coefficient[good].max():.4g}",
            }
        facts["failed"] = str(len(self.errors))
        facts["not held"] = str(len(self.validity))
        return facts

    @property
    def validity(self) -> tuple[str, ...]:
        """One sentence for each assumption that does not hold somewhere."""
        return gathered([(float(u), self.entries(i)) for i, u in enumerate(self.speed)])


def stribeck(
    scene: Scene | Prepared,
    speeds=None,
    executor=None,
    *,
    tolerance: float | None = None,
    model: str | None = None,
    fields=False,
    store=None,
    on_point=None,
    raise_on_failure: bool = True,
) -> StribeckResult:
    """The Stribeck curve of ``scene`` at entrainment ``speeds`` [m/s] (default: the scene's own).

    ``speeds="auto"`` chooses them (`lubfric.curve`), at most 25, so that ``curve.at(speed)`` is within the tolerance on
    f everywhere between the slowest and the fastest of the scene's speeds, or, where it has none, from boundary
    lubrication to a full film; the knee at lift-off, ``curve.lift_off``, is enclosed. These are solved one after the
    other. Speeds are solved from the fastest down, each started from its neighbour. ``executor``: any
    `concurrent.futures.Executor`; the speeds are then split into neighbouring runs, and those of a lost worker are
    solved again here. ``on_point(done, total, speed, outcome)`` is called as points end, the outcome a `FrictionResult`
    or an exception. ``tolerance``, ``model``: as in `lubfric.friction`. ``fields``: keep film and contact, on the
    scene's own contact grid, of every point (True) or of the speeds listed. ``store``: a folder that receives every
    point as it ends; the same call goes on from there, to the same bits (the folder is the caller's to remove).
    A failing point leaves NaN and its exception in ``errors``; the others are still solved, and then
    `ConvergenceError`, or `ValidityError` where all that failed is outside the range of the model, is raised with the
    whole curve as its ``result`` (``raise_on_failure=False`` returns it). A fault of the program, or an interrupt, goes
    through as it is, with the points so far as its ``result``.
    """
    if executor is not None and not hasattr(executor, "submit"):
        raise InputError(f"executor = {validate.shown(executor)}; allowed: None or a concurrent.futures.Executor")
    motion = scene_of(scene).motion
    if isinstance(speeds, str) and speeds == AUTO:
        return _auto(at_tolerance(scene, tolerance, model), fields, store, on_point, raise_on_failure)
    if speeds is None:
        speeds = motion.speeds or (motion.entrainment_speed,)
    if isinstance(speeds, (Real, np.number)):
        speeds = [speeds]
    speeds = validate.array("speeds", speeds, "m/s", ndim=1).copy()
    ready = at_tolerance(scene, tolerance, model)
    kept = speeds if fields is True else np.atleast_1d(np.asarray(fields or [], float))
    points: list[FrictionResult | None] = [None] * speeds.size
    errors: dict[int, Exception] = {}

    def keep(index, outcome):
        if isinstance(outcome, Exception):
            errors[index] = outcome
        else:
            points[index] = outcome
        if on_point:
            on_point(len(errors) + sum(p is not None for p in points), speeds.size, float(speeds[index]), outcome)

    try:
        solve_chains(ready, sweep_chains(ready, speeds, kept, executor is not None), executor, store, keep)
    except BaseException as fault:
        fault.result = _collect(speeds, points, errors)  # type: ignore[attr-defined]  # beside what it holds
        raise
    return _judged(_collect(speeds, points, errors), raise_on_failure)


def _judged(result: StribeckResult, raise_on_failure: bool) -> StribeckResult:
    """``result``, or the exception that says what failed in it."""
    errors = result.errors
    refused = [error for error in errors.values() if isinstance(error, ValidityError)]
    if raise_on_failure and errors and len(refused) == len(errors):
        raise ValidityError("; ".join(result.validity), tuple(e for error in refused for e in error.entries), result)
    if raise_on_failure and errors:
        raise ConvergenceError(result.report.message + "; first: " + str(errors[min(errors)]), result.report, result)
    if raise_on_failure:
        result.report.raise_if_failed(result)
    return result


def _auto(model: Prepared, fields, store, on_point, raise_on_failure) -> StribeckResult:
    """The curve at speeds of its own choice."""
    if fields is True:
        raise InputError("fields = True with speeds = 'auto'; allowed: the speeds in m/s whose fields are kept")
    low, high = span(model)
    wanted = tuple(float(abs(u)) for u in np.atleast_1d(np.asarray(fields or [], float)))
    search = Search(low, high, model.scene.numerics.tolerance, wanted, fingerprint(model))
    journal, found = (None if store is None else Journal(store)), {}
    try:
        for speed, outcome in run_adaptive(model, search, journal):
            found[speed] = outcome
            if on_point:
                on_point(len(found), len(found), speed, outcome)
    finally:
        if journal is not None:
            journal.close()
    speeds = np.array(sorted(found))
    outcomes = dict(enumerate(found[u] for u in speeds))
    errors = {i: o for i, o in outcomes.items() if isinstance(o, Exception)}
    result = _collect(speeds, [None if i in errors else o for i, o in outcomes.items()], errors)
    if len(speeds) - len(errors) >= FEWEST:
        result = replace(result, report=_with_interpolation(result, search.tolerance))
    return _judged(result, raise_on_failure)


def _with_interpolation(result: StribeckResult, tolerance: float) -> Report:
    """The report of an adaptive curve: its residual is the estimated error between the points."""
    error = next_speed(samples_of([p for p in result.points if p is not None]), tolerance)[1]
    status = result.report.status if error <= tolerance else ITERATION_LIMIT
    residuals = {"interpolation": error, "points": result.report.residual}
    advice = FAILED_SPEEDS if result.errors else "solve more speeds of your own, or loosen numerics.tolerance"
    return replace(
        result.report, status=status, residual=error, tolerance=tolerance, residuals=residuals, advice=advice
    )


def sweep_chains(model: Prepared, speeds, kept, spread: bool) -> list[tuple[Chain, np.ndarray]]:
    """The chains of a sweep, each with the indices of its speeds: one, or up to 8 where they are to be spread."""
    order = np.argsort(-np.abs(speeds), kind="stable")
    runs = np.array_split(order, min(order.size, 8)) if spread else [order]
    whole = fingerprint(model)
    return [(make_chain(whole, speeds[run], np.isin(speeds[run], kept)), run) for run in runs]


def _collect(speeds, points, errors) -> StribeckResult:
    columns = {name: np.array([np.nan if p is None else getattr(p, name) for p in points]) for name in QUANTITIES}
    columns["speed"] = speeds
    worst = max((p.report.residual for p in points if p is not None), default=np.inf)
    tolerance = max((p.report.tolerance for p in points if p is not None), default=0.0)
    status = ITERATION_LIMIT if errors else CONVERGED
    notes = tuple(f"speed {speeds[i]:g} m/s: {error}" for i, error in sorted(errors.items()))
    report = Report(
        "stribeck", status, speeds.size - len(errors), float(worst), float(tolerance), notes=notes, advice=FAILED_SPEEDS
    )
    return StribeckResult(
        **columns,
        points=tuple(points),
        errors=errors,
        report=report,
        uncertainty=curve_of([None if p is None else p.uncertainty for p in points]),
        field_errors=_field_errors(points),
    )


def _field_errors(points) -> dict[str, np.ndarray]:
    """Relative errors by quantity, NaN where a point failed."""
    return {name: np.array([np.nan if p is None else getattr(p.errors, name) for p in points]) for name in FIELDS}
