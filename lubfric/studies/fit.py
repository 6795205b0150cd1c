"""`fit`: bounded least squares of a scene to a measured curve, and how well the data determine its parameters."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .._base import instance, number
from ..errors import CONVERGED, ITERATION_LIMIT, InputError, Report
from ..scene import Scene
from ..sharing import scene_of
from .fit_parameters import Parameters, parameters_of
from .fit_predict import Curve, Predictor, jacobian, predictor
from .fit_result import FitResult
from .measured import SLIP, Measured
from .spread import checked_executor

STEP = 0.04  # of the bounds, of the differences, which are believed as far away: above the scatter of the solves
CLOSE = 2e-3  # of the bounds: a last move of the parameters that ends the search
RATIO = {"motion.slide_roll_ratio", "motion.slip_percent"}
LEAST_ERROR, LEAST_SLOPE = 1e-6, 1e-9  # of f, relative: that may be told; and by a parameter, over its bounds
MOST = 30  # curves on the way, beside those of the differences


def fit(scene: Scene, measured: Measured, parameters, *, start=None, executor=None, on_progress=None) -> FitResult:
    """Find the values of ``parameters`` with which the friction of a scene is nearest to a measured curve.

    The fit minimises ``sum ((f - measured)/deviation)²``, with relative deviations if none are given. The method is a
    trust region within the bounds (`scipy.optimize.least_squares`, "trf"). Its derivatives are differences over 4 % of
    the bounds, which stay above the tolerance on f. They are computed anew when the parameters have moved by more than
    4 % of their bounds. The search stops when a step moves the parameters by <= 0.2 % of their bounds, or changes the
    sum by <= 1e-4 of it. Each point starts from the same point of an earlier curve. `FitResult` says how sure the
    values are, and `lubfric.explain_fit` says beforehand how long a fit will take.

    Parameters
    ----------
    scene : what is known, with the numerics to be used
    measured : from `lubfric.read_measured`, or `lubfric.Measured(speeds, coefficients)`
    parameters : {"section.key": (lowest, highest)}, numbers of the scene to be found between bounds, in SI units
    start : {"section.key": value} to begin with; default: the scene's own if they lie within the bounds, else the
        middle
    executor : any `concurrent.futures.Executor`, for the points of a curve; the same bits on each
    on_progress : called as on_progress(curve, done, total) when ``done`` of the ``total`` points of a curve are solved;
        curves count from 1

    Returns a `FitResult`.

    Raises
    ------
    InputError : before any work
    ConvergenceError : the search does not end, or a curve fails; carries the result
    """
    from scipy.optimize import least_squares

    if scene_of(scene) is not scene:
        raise InputError("a fit changes a scene; give what lubfric.load_scene returned, not what lubfric.prepare did")
    instance("measured", measured, Measured, "lubfric.read_measured(...) or lubfric.Measured(x, coefficient)")
    found = parameters_of(scene, parameters)
    if measured.over == SLIP and (given := RATIO.intersection(found.keys)):
        raise InputError(f"parameters: {', '.join(given)} is measured, not fitted; name another number of the scene")
    if measured.x.size <= len(found.keys):
        raise InputError(f"{measured.x.size} measured points for {len(found.keys)} parameters; give more points")
    begin = _begin(scene, found, {} if start is None else start)
    told = None if on_progress is None else _told(on_progress, measured.x.size)
    predict = predictor(scene, measured, found, checked_executor(executor), told)
    scale = measured.coefficient if measured.deviation is None else measured.deviation
    walk = Walk(predict)
    search = least_squares(
        lambda unit: (walk.at(unit).coefficient - measured.coefficient) / scale,
        begin,
        lambda unit: walk.slopes(unit) / scale[:, None],
        bounds=(0.0, 1.0),
        xtol=CLOSE,
        ftol=1e-4,
        gtol=1e-12,
        max_nfev=MOST,
    )
    result = _result(predict, scale, search, walk.at(search.x))
    result.report.raise_if_failed(result)
    return result


def _begin(scene: Scene, found: Parameters, start: dict) -> np.ndarray:
    values = []
    for key, low, high in zip(found.keys, found.low, found.high):
        section, _, name = key.partition(".")
        if key in start:
            values.append(number(f"start[{key!r}]", start[key], "(of the key)", minimum=low, maximum=high))
            continue
        value = vars(getattr(scene, section)).get(name)  # a short form has none there
        inside = isinstance(value, (int, float)) and low < value < high
        values.append(float(value) if inside else np.nan)
    for key in start:
        if key not in found.keys:
            raise InputError(f"start holds {key!r}, which is no parameter; allowed: {', '.join(found.keys)}")
    middle = found.values(np.full(len(values), 0.5))
    return np.clip(found.unit(np.where(np.isnan(values), middle, values)), 0.02, 0.98)


def _told(on_progress: Callable, total: int) -> Callable[[int], None]:
    """``on_progress`` with the number of the curve, for the points of one curve after the other."""
    curves = [1]

    def on_points(done: int) -> None:
        on_progress(curves[0], done, total)
        curves[0] += done == total

    return on_points


class Walk:
    """The curves of a search. Two are kept: the one with the last derivatives, from which the others start, and the
    last."""

    def __init__(self, predict: Predictor):
        self._predict = predict
        self._base: Curve | None = None
        self._last: Curve | None = None
        self._slopes = np.empty((0, 0))

    def at(self, unit: np.ndarray) -> Curve:
        """The curve at positions between the bounds."""
        if self._last is None or not np.array_equal(self._last.unit, unit):
            self._last = self._predict.at(unit, self._base)
        return self._last

    def slopes(self, unit: np.ndarray) -> np.ndarray:
        """df/d(unit), (n, p), by differences at the curve there, or the last ones if these were computed near by."""
        if self._base is None or np.abs(unit - self._base.unit).max() > STEP:
            self._base = self.at(unit)
            self._slopes = jacobian(self._predict, self._base, STEP)
        return self._slopes


def _numerical_variance(predict: Predictor, curve: Curve, relative: np.ndarray) -> float:
    """Mean square of the numerical error of f, which hides from the data what changes f by less. ``relative``: f over
    the scale of the residuals. Where the error of a point is not known it is the tolerance."""
    told = np.array([point.uncertainty.numerical for point in curve.points])
    known = np.maximum(np.where(np.isfinite(told), told, predict.tolerance), LEAST_ERROR)
    return float(np.mean((known * relative) ** 2))


def _result(predict: Predictor, scale, search, curve: Curve) -> FitResult:
    """The result of a ``search`` whose derivatives were computed where it ended, or near by. ``curve``: where it
    ended."""
    residuals, slopes = search.fun, search.jac * scale[:, None]
    f, unit = residuals * scale + predict.measured.coefficient, np.clip(search.x, 0.0, 1.0)
    n, p = slopes.shape
    squares = float(residuals @ residuals)
    variance = squares / (n - p) if predict.measured.deviation is None else 1.0
    variance += _numerical_variance(predict, curve, f / scale)
    _, singular, axes = np.linalg.svd(slopes / scale[:, None], full_matrices=False)
    known = np.maximum(singular, max(1e-8 * singular[0], LEAST_SLOPE))  # a direction without effect: a huge variance
    covariance = variance * (axes.T / known**2) @ axes
    status = CONVERGED if search.status > 0 else ITERATION_LIMIT
    move = 0.0 if status == CONVERGED else 1.0
    advice = "give start = {...} closer to the answer, narrower bounds, or fewer parameters"
    squared = {"sum of squares": squares}
    report = Report("fit, trust region", status, int(search.nfev), move, CLOSE, squared, advice=advice)
    known, entries = predict.parameters, tuple(point.validity for point in curve.points)
    sampling = np.array([point.uncertainty.sampling for point in curve.points])
    measured = predict.measured
    return FitResult(predict.scene, measured, known, unit, covariance, f, slopes, scale, report, entries, sampling)
