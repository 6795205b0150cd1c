"""Stribeck curves, friction over the speed; and traction curves, friction over the slide-roll ratio at one speed."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import nullcontext
from dataclasses import dataclass, replace
from functools import cached_property, partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .._base import validate, with_default_errors, write_whole
from .._base.jobs import parts_on
from .._base.processes import checked_executor, checked_workers, pool, spread
from ..errors import ITERATION_LIMIT, InputError, Report
from ..estimate import FrictionResult
from ..models import prepared_with
from ..models.shared import Prepared, percent, scene_of
from ..quantities import PointQuantities, described_in_doc
from ..scene import FASTEST, LARGEST_RATIO, Scene, check_ratios
from .choose import alike, between, each_once, requested_speeds, span, tolerance_between
from .curve import CurveResult, checked_curve, columns_of, csv_bytes, parted, points_of_interpolation, report_of
from .curve_axes import curve_axes
from .interpolate import FEWEST_SPEEDS, Interpolant, Minimum, through
from .law import MORE_SPEEDS, Law, conditions_of, law_of
from .points import Outcome, at_ratios, key_of, solved
from .store import opened
from .tables import DRAWN_ERROR
from .traction_gaps import Gap, gaps_of


@described_in_doc
@dataclass(frozen=True, repr=False, kw_only=True)
class StribeckResult(PointQuantities[np.ndarray], CurveResult):
    """Arrays over the requested speeds, in their order; NaN where a point failed.

    Every number of `FrictionResult` is an array attribute of the same name and unit, (n,).

    Attributes
    ----------
    points : the results themselves (None where failed)
    errors : {index: the exception raised there}. The `ValidityError` of a point outside the range of the model carries
        the point's result
    validity : the assumptions that do not hold, gathered over the speeds
    uncertainty : arrays of the numbers of `Uncertainty`; ``interval`` is (n, 2)
    report : whether all speeds were solved
    scene : that was solved
    """

    SWEPT = "speed", "U", "m/s", "speeds"

    points: tuple[FrictionResult | None, ...]
    errors: dict[int, Exception]
    report: Report
    scene: Scene

    plot = curve_axes

    @property
    def slide_roll_ratios(self) -> np.ndarray:
        return np.full(len(self.points), self.scene.motion.slide_roll_ratio)

    def at(self, speed: ArrayLike) -> np.ndarray:
        """Return f at any speeds [m/s] between the slowest and the fastest, interpolated
        (`lubfric.studies.interpolate`). They have the direction of the curve: the friction of a finite piece of a
        surface differs between both directions."""
        contact, film = self.parts_at(speed)
        return contact + film

    def parts_at(self, speed: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        """Return the two parts of f, from the asperity contacts and from the film, at any speeds [m/s], as `at`."""
        curve = self._curve
        speeds = validate.array("speed", validate.listed(speed), "m/s", ndim=1)
        if not curve.within(speeds).all():
            low, high = curve.range
            raise InputError(f"speed = {speeds} m/s; allowed: {low:g} to {high:g} m/s, where the curve is known")
        speeds = curve.sense * speeds
        return curve.boundary(speeds).reshape(np.shape(speed)), curve.film(speeds).reshape(np.shape(speed))

    @property
    def lift_off(self) -> float | None:
        """The lift-off speed [m/s], in the direction of the curve, above which the film separates the surfaces; None if
        the curve does not reach it. NaN where the solved speeds around it differ by more than a factor of 2, or where
        the numerical error of f there is above 20 %: see ``lift_off_range``."""
        return None if self._curve.lift_off is None else self._curve.lifted

    @property
    def lift_off_range(self) -> tuple[float, float]:
        """(lowest, highest) speed [m/s] at which ``lift_off`` may lie, by the interpolation between the points, without
        the sampling error; the solved speeds around it where ``lift_off`` is NaN, or the clearance of the film is not
        computed; NaN where there is none."""
        low, high = sorted(self._curve.sense * end for end in self._curve.lift_off_range)
        return low, high

    @property
    def numerical_at_lift_off(self) -> float:
        """The largest relative numerical error of f at the solved speeds around lift-off; 0 where there is none."""
        return self._curve.numerical_at_lift_off

    @cached_property
    def minimum(self) -> Minimum:
        """The least f between the solved speeds, with its 95 % interval: it combines the error of the interpolation
        with the wider interval of the two solved points beside it."""
        least = self._curve.minimum()
        f = self.coefficient
        beside = _around(self.speed, f, least.speed)
        (low, high) = self.uncertainty.interval[beside].T
        below = np.hypot(np.max((f[beside] - low) / f[beside]), 1.0 - least.interval[0] / least.coefficient)
        above = np.hypot(np.max((high - f[beside]) / f[beside]), least.interval[1] / least.coefficient - 1.0)
        interval = least.coefficient * (1.0 - below), least.coefficient * (1.0 + above)
        return replace(least, interval=(float(min(interval)), float(max(interval))))

    @cached_property
    def between(self) -> float:
        """The largest relative error that `at` is estimated to have between the points."""
        return between(self._curve)

    @cached_property
    def _curve(self) -> Interpolant:
        return through(points_of_interpolation(self.points))

    def law(self) -> Law:
        """Return the curve as a formula for system simulations, `lubfric.studies.law`: at one temperature and pressure;
        ``lubfric.study(...).law()`` has more of them. Raises `InputError` where f is not interpolated between the
        speeds within 5 %, or the numerical error of a point is above 20 %."""
        if self.between > DRAWN_ERROR:
            limit = f"a formula needs at most {percent(DRAWN_ERROR)}"
            error = percent(self.between) if np.isfinite(self.between) else "not known"
            message = f"the estimated error of f between the solved speeds is {error}, and {limit}"
            raise InputError(message, recommendation=MORE_SPEEDS)
        low, high = self.uncertainty.interval.T
        curves = [(conditions_of(self.scene), self._curve)]
        return law_of(self.scene, curves, self.coefficient, low, high, self.uncertainty.model)

    def to_csv(self, path: str | Path) -> None:
        """Write the table that ``lubfric run`` writes as stribeck.csv: one row a speed, the unit in the heading."""
        write_whole(path, csv_bytes(self))


def _around(speeds: np.ndarray, f: np.ndarray, place: float) -> np.ndarray:
    """Return the indices of the two solved points, of those with an ``f``, between whose ``speeds`` a ``place`` [m/s]
    lies."""
    solved = np.flatnonzero(np.isfinite(f) & (speeds != 0))
    solved = solved[np.argsort(np.abs(speeds[solved]))]
    right = np.searchsorted(np.abs(speeds[solved]), abs(place)).clip(1, solved.size - 1)
    around: np.ndarray = solved[[right - 1, right]]
    return around


@with_default_errors
def stribeck(
    scene: Scene | Prepared,
    speeds: str | ArrayLike | None = None,
    executor: Any = None,
    *,
    tolerance: float | None = None,
    model: str | None = None,
    fields: bool | str | ArrayLike | Mapping[Any, Any] = False,
    fine_fields: bool = False,
    store: str | Path | None = None,
    on_point: Callable[..., Any] | None = None,
    raise_on_failure: bool = True,
    workers: int = 1,
) -> StribeckResult:
    """Solve the Stribeck curve of a scene: friction over the entrainment speed.

    Every point depends on the scene and its own speed alone, as in `lubfric.friction`: other speeds change no bit of
    it. A point that fails leaves NaN, and its exception in ``errors``. A fault of the program is
    raised unchanged, with the points so far as its ``result``.

    Parameters
    ----------
    scene : from `lubfric.load_scene` or `lubfric.prepare`
    speeds : entrainment speeds [m/s], (n,); None: the scene's own ``motion.speeds``, without
        ``motion.entrainment_speed``, which ``lubfric run`` adds as the operating point of its report; "auto": at most
        25, so that ``curve.at(speed)`` is within the tolerance on f everywhere between, and ``curve.lift_off`` is
        enclosed. On strips of the surface that is the root sum of squares of the tolerance and the sampling tolerance
    executor : any `concurrent.futures.Executor`
    tolerance, model, fields : as in `lubfric.friction`; or fields: the speeds [m/s] whose film and contact are kept
    fine_fields : whether the kept fields are solved again on cells fine enough for a picture, as ``fields="fine"`` of
        `lubfric.friction`
    store : a folder that receives every point as it ends. The same call, or one with other speeds, continues from
        there
    on_point : called as on_point(done, total, speed, outcome), with a result or an exception, as points end
    raise_on_failure : False returns a curve with failed points
    workers : processes of this machine that share the speeds, or the parts of each point where there are fewer speeds;
        instead of an executor. A script that requests more than one needs ``if __name__ == "__main__":``

    Returns a `StribeckResult`. Raises `InputError`, and, with the curve, `ConvergenceError` or `ValidityError`.
    """
    validate.called_back("on_point", on_point, "done, total, speed, outcome")
    requested, kept = _requested(speeds, fields, scene_of(scene))
    executor = checked_executor(executor)
    prepared = prepared_with(scene, tolerance, model)
    if not requested:
        span(prepared.scene, prepared.surface.sq)  # raises where there is no range to choose from
    if checked_workers(workers, executor) > 1:
        options: dict[str, Any] = {
            "fields": fields,
            "fine_fields": fine_fields,
            "store": store,
            "on_point": on_point,
            "raise_on_failure": raise_on_failure,
        }
        with pool(workers) as processes:
            apart = len(requested) >= workers
            with parts_on(None if apart else processes):
                return stribeck(prepared, speeds, processes if apart else None, **options)
    outcomes: dict[float, Outcome] = {}
    try:
        with opened(store) as folder:
            batches: list[tuple[float, ...]] = [(u,) for u in dict.fromkeys(requested)] or [()]
            solve = partial(
                solved,
                prepared,
                key_of(prepared),
                kept=frozenset(kept),
                folder=folder.root,
                fine_fields=fine_fields,
            )
            for _, speed, outcome in spread(executor, [partial(solve, speeds=batch) for batch in batches]):
                if outcome is None:  # the end of a curve that chose its speeds
                    break
                outcomes[speed] = outcome
                if on_point:
                    on_point(len(outcomes), len(set(requested)) or len(outcomes), speed, outcome)
    except BaseException as fault:
        fault.result = _collected(requested, outcomes, prepared)  # type: ignore[attr-defined]  # beside what it holds
        raise
    return checked_curve(_collected(requested, outcomes, prepared), raise_on_failure=raise_on_failure)


def _requested(speeds: str | ArrayLike | None, fields: Any, scene: Scene) -> tuple[list[float], list[float]]:
    """Return the requested speeds [m/s], one or many, or those of the scene (none: chosen ones); and those whose
    film and contact are kept."""
    kept = []
    if not isinstance(fields, (bool, type(None))) and np.size(fields):
        kept = validate.numbers("fields", fields, "m/s", FASTEST).tolist()
    requested = list(requested_speeds(scene, speeds))
    if not requested:
        if fields is True:
            raise InputError("fields = True with speeds = 'auto'; give the speeds in m/s whose fields are kept")
        return [], np.abs(kept).tolist()
    kept = [alike(speed, requested) for speed in kept]
    if not set(kept) <= set(requested):
        message = f" = {fields!r} m/s are not all among the speeds of the curve"
        raise InputError(message, "fields", recommendation="give some of them, or fields = True")
    return requested, requested if fields is True else kept


def _collected(requested: list[float], outcomes: dict[float, Outcome], prepared: Prepared) -> StribeckResult:
    """Return the curve of the ``outcomes`` at the ``requested`` speeds [m/s], or at chosen ones (none). Those that are
    missing have neither point nor error."""
    curve = curve_of(requested or sorted(outcomes), outcomes, prepared.scene)
    if requested or len(curve.points) - len(curve.errors) < FEWEST_SPEEDS:
        return curve
    report = curve.report
    error = curve.between
    tolerance = tolerance_between(prepared)
    is_close_enough = error <= tolerance
    report_between = replace(  # its residual is the estimated error between the points
        report,
        status=report.status if is_close_enough else ITERATION_LIMIT,
        residual=error,
        tolerance=tolerance,
        residuals={"interpolation": error, "points": report.residual},
        advice=report.advice
        or ("" if is_close_enough else "solve more speeds of your own, or loosen numerics.tolerance"),
    )
    return replace(curve, report=report_between)


def curve_of(speeds: list[float], outcomes: Mapping[float, Outcome], scene: Scene) -> StribeckResult:
    """Return the curve of the ``outcomes`` at these ``speeds`` [m/s]."""
    points, errors = parted([outcomes.get(speed) for speed in speeds])
    report = report_of("stribeck", [f"speed {u:g} m/s" for u in speeds], "speeds", points, errors)
    numbers = columns_of(points) | {"speed": np.array(speeds)}
    return StribeckResult(**numbers, points=points, errors=errors, report=report, scene=scene)


@dataclass(frozen=True, repr=False, kw_only=True)
class TractionResult(CurveResult):
    """Friction over the requested slide-roll ratios, in their order; NaN where a point failed.

    Attributes
    ----------
    ratio : slide-roll ratios [-], (n,)
    speed : entrainment speed [m/s]
    points : the results, without fields (None where failed). ``result["contact_load"]`` gives one of their numbers
    errors : {index: exception}
    report : the largest residual of the points over its tolerance
    """

    SWEPT = "ratio", "S", "", "slide-roll ratios"

    ratio: np.ndarray
    speed: float
    points: tuple[FrictionResult | None, ...]
    errors: dict[int, Exception]
    report: Report

    @property
    def coefficient(self) -> np.ndarray:
        """Friction coefficient [-]. It holds the rolling part of the film's force, which does not vanish with the slip;
        ``without_rolling`` is f without it."""
        return self["coefficient"]

    @property
    def slide_roll_ratios(self) -> np.ndarray:
        return self.ratio

    @property
    def gaps(self) -> list[Gap]:
        """Neighbouring points between which f is not known (`lubfric.studies.Gap`): more ratios between them determine
        it."""
        ends = [(np.nan, np.nan) if point is None else point.uncertainty.interval for point in self.points]
        low, high = np.array(ends).reshape(-1, 2).T
        return gaps_of(self.ratio, self.coefficient, 0.5 * (high - low))


@with_default_errors
def traction(
    scene: Scene | Prepared,
    ratios: str | ArrayLike,
    *,
    speed: float | None = None,
    executor: Any = None,
    tolerance: float | None = None,
    model: str | None = None,
    store: str | Path | None = None,
    on_point: Callable[..., Any] | None = None,
    raise_on_failure: bool = True,
    workers: int = 1,
) -> TractionResult:
    """Solve the traction curve of a scene: friction over the slide-roll ratio, at one entrainment speed.

    The ratio changes the shear of the film, its heat, and the heat of the inlet. f contains the rolling part of
    the film's force, which remains without slip. ``curve.without_rolling`` is f without it, as measured by rigs that
    average over both signs of slip. A point that fails leaves NaN, and its exception in ``errors``; the others are
    still solved.

    Parameters
    ----------
    scene : from `lubfric.load_scene` or `lubfric.prepare`
    ratios : slide-roll ratios (u2 - u1)/U [-], (n,), or with a unit, ["5 %"]; refused if all of them look like
        percentages
    speed : entrainment speed [m/s]; None: the scene's own
    tolerance, model : as in `lubfric.friction`
    executor, store, workers : as in `lubfric.stribeck`, of the ratios
    on_point : called as on_point(done, total, ratio, outcome) as points end
    raise_on_failure : False returns a curve with failed points

    Returns
    -------
    TractionResult

    Raises
    ------
    InputError : before any work
    ConvergenceError : at the end, if a point failed; the complete curve is its ``result``
    ValidityError : the same, if all points that failed were refused as invalid
    """
    validate.called_back("on_point", on_point, "done, total, ratio, outcome")
    check_ratios("ratios", ratios)
    ratios = np.array(each_once(validate.numbers("ratios", ratios, "(-)", LARGEST_RATIO).tolist()))
    if speed is not None:
        speed = validate.number("speed", speed, "m/s", minimum=-FASTEST, maximum=FASTEST)
    executor = checked_executor(executor)
    base = prepared_with(scene, tolerance, model)
    speed = base.scene.motion.entrainment_speed if speed is None else speed
    count = checked_workers(workers, executor)
    apart = ratios.size >= count
    outcomes: dict[float, Outcome] = {}
    try:
        with pool(count) if count > 1 else nullcontext() as processes, nullcontext() if apart else parts_on(processes):
            done_by = processes if apart and processes is not None else executor
            for ratio, outcome in _solved_ratios(base, ratios.tolist(), float(speed), done_by, store):
                outcomes[ratio] = outcome
                if on_point:
                    on_point(len(outcomes), ratios.size, ratio, outcome)
    except BaseException as fault:
        fault.result = traction_of(ratios, outcomes, speed)  # type: ignore[attr-defined]  # beside what it holds
        raise
    return checked_curve(traction_of(ratios, outcomes, speed), raise_on_failure=raise_on_failure)


def _solved_ratios(
    base: Prepared, ratios: list[float], speed: float, executor: Any, store: str | Path | None
) -> Iterator[tuple[float, Outcome]]:
    """Yield each of the ``ratios`` with its outcome at ``speed`` [m/s], as they end; those that ``store`` has come from
    there."""
    models = at_ratios(base, ratios)
    by_key = dict(zip(map(key_of, models), ratios))
    with opened(store) as folder:
        jobs = [partial(solved, model, key, (speed,), folder=folder.root) for model, key in zip(models, by_key)]
        for key, _, outcome in spread(executor, jobs):
            yield by_key[key], outcome


def traction_of(ratios: ArrayLike, outcomes: Mapping[float, Outcome], speed: float) -> TractionResult:
    """Return the curve of the ``outcomes`` at these slide-roll ``ratios`` and one ``speed`` [m/s]."""
    values = np.array(ratios)
    points, errors = parted([outcomes.get(ratio) for ratio in values.tolist()])
    report = report_of("traction", [f"slide-roll ratio {ratio:g}" for ratio in values], "ratios", points, errors)
    return TractionResult(ratio=values, speed=float(speed), points=points, errors=errors, report=report)
