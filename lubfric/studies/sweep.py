"""Stribeck curves: friction over speed."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .._base import validate, write_whole
from ..errors import ITERATION_LIMIT, InputError, Report
from ..quantities import ESTIMATED, PointQuantities, described_in_doc
from ..sampling import FrictionResult
from ..scene import FASTEST, Scene
from ..sharing import Prepared
from .choose import AUTO, next_speed, span, tolerance_between
from .curve import CurveResult, columns_of, csv_bytes, judged, report_of
from .draw import curve_axes
from .executor import checked_executor, spread
from .interpolate import FEWEST, Interpolant, through
from .points import Outcome, Piece, key_of, made_ready, solved
from .store import opened


@described_in_doc
@dataclass(frozen=True, repr=False, kw_only=True)
class StribeckResult(PointQuantities[np.ndarray], CurveResult):
    """Arrays over the speeds, in the order asked for; NaN where a point failed.

    Every number of `FrictionResult` is an array attribute of the same name and unit, (n,).

    Attributes
    ----------
    points : the results themselves (None where failed)
    errors : {index: the exception raised there}. The `ValidityError` of a point outside the range of the model carries
        the point's result
    validity : the assumptions that do not hold, gathered over the speeds
    uncertainty : arrays of the numbers of `Uncertainty`; ``interval`` is (n, 2)
    field_errors : {quantity: its relative errors, (n,)}
    report : whether all speeds were solved
    """

    SWEPT = "speed", "U", "m/s", "speeds"

    points: tuple[FrictionResult | None, ...]
    errors: dict[int, Exception]
    report: Report

    @property
    def field_errors(self) -> dict[str, np.ndarray]:
        """Relative errors of the other numbers, arrays (n,) by name."""
        return {n: np.array([np.nan if p is None else getattr(p.errors, n) for p in self.points]) for n in ESTIMATED}

    def at(self, speed) -> np.ndarray:
        """f at any speeds [m/s] between the slowest and the fastest, interpolated (`lubfric.studies.interpolate`). They
        have the direction of the curve: a finite piece of a surface slides differently back and forth."""
        contact, film = self.parts_at(speed)
        return contact + film

    def parts_at(self, speed) -> tuple[np.ndarray, np.ndarray]:
        """(from the contact spots, from the film): the two parts of f at any speeds [m/s], as `at`."""
        curve, at = self._curve, validate.array("speed", validate.listed(speed), "m/s", ndim=1)
        if not curve.within(at).all():
            low, high = curve.range
            raise InputError(f"speed = {speed!r} m/s; allowed: {low:g} to {high:g} m/s, where the curve is known")
        at = curve.sense * at
        return curve.boundary(at).reshape(np.shape(speed)), curve.film(at).reshape(np.shape(speed))

    @property
    def lift_off(self) -> float | None:
        """The speed [m/s], in the direction of the curve, at which the film lifts the surfaces off each other; None if
        the curve does not reach it."""
        return None if self._curve.lift_off is None else self._curve.lifted

    @cached_property
    def _curve(self) -> Interpolant:
        return through(columns_of(self.points))

    def plot(self, ax=None, **style):
        """Friction over speed, with its parts, on ``ax`` or new axes, which are returned; ``style``: of the line."""
        return curve_axes(self, ax, **style)

    def to_csv(self, path) -> None:
        """The table that ``lubfric run`` writes as stribeck.csv: one row a speed, the unit in the heading."""
        write_whole(path, csv_bytes(self))


def stribeck(
    scene: Scene | Prepared,
    speeds=None,
    executor=None,
    *,
    tolerance: float | None = None,
    model: str | None = None,
    fields=False,
    store=None,
    start=None,
    on_point=None,
    raise_on_failure: bool = True,
) -> StribeckResult:
    """The Stribeck curve of a scene: friction over the entrainment speed.

    Every point is solved from the scene alone, as `lubfric.friction` does it, so a curve has the same bits whatever
    other speeds it has. A point that fails leaves NaN, and its exception in ``errors``. A fault of the program is
    raised as it is, with the points so far as its ``result``.

    Parameters
    ----------
    scene : from `lubfric.load_scene` or `lubfric.prepare`
    speeds : entrainment speeds [m/s], (n,); None: the scene's own; "auto": at most 25, so that ``curve.at(speed)`` is
        within the tolerance on f everywhere between, and ``curve.lift_off`` is enclosed. On strips of the surface that
        is the root sum of squares of the tolerance and the sampling tolerance
    executor : any `concurrent.futures.Executor`
    tolerance, model, fields : as in `lubfric.friction`; or fields: the speeds [m/s] whose film and contact are kept
    store : a folder that receives every point as it ends. The same call, or one with other speeds, goes on from there
    start : no longer taken
    on_point : called as on_point(done, total, speed, outcome), with a result or an exception, as points end
    raise_on_failure : False returns a curve with failed points

    Returns a `StribeckResult`. Raises `InputError`, and, with the curve, `ConvergenceError` or `ValidityError`.
    """
    if start is not None:
        raise InputError("start: every point is solved from the scene alone; leave start out")
    validate.instance("scene", scene, (Scene, Prepared), "what lubfric.load_scene or lubfric.prepare returned")
    asked, kept = _asked(speeds, fields, scene.scene if isinstance(scene, Prepared) else scene)
    executor, prepared = checked_executor(executor), made_ready(scene, tolerance, model)
    if not asked:
        span(prepared.scene, prepared.surface.sq)  # raises where there is no range to choose from
    found: dict[float, Outcome] = {}
    try:
        with opened(store) as folder:
            piece = Piece(prepared, key_of(prepared), (), frozenset(kept), folder.root)
            pieces = [replace(piece, speeds=(u,)) for u in dict.fromkeys(asked)] or [piece]
            for _, speed, outcome in spread(executor, solved, pieces):
                if outcome is None:  # the end of a curve that chose its speeds
                    break
                found[speed] = outcome
                if on_point:
                    on_point(len(found), len(set(asked)) or len(found), speed, outcome)
    except BaseException as fault:
        fault.result = _collected(asked, found, prepared)  # type: ignore[attr-defined]  # beside what it holds
        raise
    return judged(_collected(asked, found, prepared), raise_on_failure)


def _asked(speeds, fields, scene: Scene) -> tuple[list[float], list[float]]:
    """The speeds [m/s] that were asked for, one or many, or those of the scene (none: chosen ones); and those whose
    film and contact are kept."""
    kept = []
    if not isinstance(fields, (bool, type(None))) and np.size(fields):
        kept = validate.numbers("fields", fields, "m/s", FASTEST).tolist()
    if isinstance(speeds, str) and speeds == AUTO:
        if fields is True:
            raise InputError("fields = True with speeds = 'auto'; give the speeds in m/s whose fields are kept")
        return [], np.abs(kept).tolist()
    if speeds is None:
        speeds = scene.motion.speeds or (scene.motion.entrainment_speed,)
    asked = validate.numbers("speeds", speeds, "m/s", FASTEST).tolist()
    if not set(kept) <= set(asked):
        raise InputError(
            f"fields = {fields!r} m/s are not all among the speeds of the curve; give some of them, or fields = True"
        )
    return asked, asked if fields is True else kept


def _collected(asked: list[float], found: dict[float, Outcome], prepared: Prepared) -> StribeckResult:
    """The curve of the outcomes ``found`` at the speeds ``asked`` for [m/s], or at chosen ones (none). Those that are
    missing have neither point nor error."""
    outcomes = [found.get(speed) for speed in asked or sorted(found)]
    points = [outcome if isinstance(outcome, FrictionResult) else None for outcome in outcomes]
    errors: dict[int, Exception] = {i: o for i, o in enumerate(outcomes) if isinstance(o, Exception)}
    speeds = np.array(asked or sorted(found))
    report = report_of("stribeck", [f"speed {u:g} m/s" for u in speeds], "speeds", points, errors)
    columns = columns_of(points) | {"speed": speeds}
    curve = StribeckResult(**columns, points=tuple(points), errors=errors, report=report)
    if asked or len(points) - len(errors) < FEWEST:
        return curve
    return replace(curve, report=_with_interpolation(curve, tolerance_between(prepared)))


def _with_interpolation(curve: StribeckResult, tolerance: float) -> Report:
    """The report of a curve that chose its speeds: its residual is the estimated error between the points."""
    report, error = curve.report, next_speed(through(columns_of(curve.points)), tolerance)[1]
    return replace(
        report,
        status=report.status if error <= tolerance else ITERATION_LIMIT,
        residual=error,
        tolerance=tolerance,
        residuals={"interpolation": error, "points": report.residual},
        advice=report.advice if curve.errors else "solve more speeds of your own, or loosen numerics.tolerance",
    )
