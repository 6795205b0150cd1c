"""`fit`: bounded least squares of a scene to a measured curve, and how well the data determine its parameters."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from .._base import instance, number
from ..errors import CONVERGED, ITERATION_LIMIT, ConvergenceError, InputError, Report
from ..sampling import FrictionResult, friction
from ..scene import Scene
from ..sharing import Prepared, prepare
from .executor import checked_executor, spread
from .explain import curve_seconds, in_words
from .fit_input import SLIP, SPEED, Measured, Parameters, parameters_of
from .fit_result import FitResult

STEP = 0.04  # of the bounds, of the differences, which are believed as far away: above the scatter of the solves
CLOSE = 2e-3  # of the bounds: a last move of the parameters that ends the search
RATIO = {"motion.slide_roll_ratio", "motion.slip_percent"}
LEAST_ERROR, LEAST_SLOPE = 1e-6, 1e-9  # of f, relative, that may be stated; and by a parameter, over its bounds
MOST = 30  # curves on the way, beside those of the differences
STEPS = 3  # curves of a search, about, beside those of the differences


def fit(scene: Scene, measured: Measured, parameters, *, start=None, executor=None, on_progress=None) -> FitResult:
    """Find the values of ``parameters`` with which the friction of a scene is nearest to a measured curve.

    The fit minimises ``sum ((f - measured)/deviation)²``, with relative deviations if none are given. The method is a
    trust region within the bounds (`scipy.optimize.least_squares`, "trf"). Its derivatives are differences over 4 % of
    the bounds, which stay above the tolerance on f. They are computed anew when the parameters have moved by more than
    4 % of their bounds. The search stops when a step moves the parameters by <= 0.2 % of their bounds, or changes the
    sum by <= 1e-4 of it. `FitResult` says how sure the values are, and `lubfric.explain_fit` says beforehand how long a
    fit will take.

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

    instance("scene", scene, Scene, "a scene to change: what lubfric.load_scene returned, not lubfric.prepare")
    instance("measured", measured, Measured, "lubfric.read_measured(...) or lubfric.Measured(x, coefficient)")
    found = parameters_of(scene, parameters)
    if measured.over == SLIP and (given := RATIO.intersection(found.keys)):
        raise InputError(f"parameters: {', '.join(given)} is measured, not fitted; name another number of the scene")
    if measured.x.size <= len(found.keys):
        raise InputError(f"{measured.x.size} measured points for {len(found.keys)} parameters; give more points")
    begin = _begin(scene, found, {} if start is None else start)
    search = Search(scene, measured, found, checked_executor(executor), on_progress)
    scale = measured.coefficient if measured.deviation is None else measured.deviation
    end = least_squares(
        lambda unit: (search.at(unit).coefficient - measured.coefficient) / scale,
        begin,
        lambda unit: search.slopes(unit) / scale[:, None],
        bounds=(0.0, 1.0),
        xtol=CLOSE,
        ftol=1e-4,
        gtol=1e-12,
        max_nfev=MOST,
    )
    result = _result(search, scale, end)
    result.report.raise_if_failed(result)
    return result


def explain_fit(scene: Scene, measured: Measured, parameters) -> str:
    """What a fit will do and about how long it will take, in words. The map is made, and no point is solved.

    Parameters
    ----------
    scene, measured, parameters : as for `lubfric.fit`

    Returns
    -------
    str : lines of text

    Raises
    ------
    InputError : a parameter is not one
    """
    found = parameters_of(scene, parameters)
    count = f"{len(found.keys)} parameter{'s' if len(found.keys) > 1 else ''}"
    lines = [f"fit of {count} of {scene.name} to {measured.x.size} points of {measured.source}"]
    for key, low, high, logarithmic in zip(found.keys, found.low, found.high, found.logarithmic):
        lines.append(f"  {key}: {low:g} to {high:g}{', sought in its logarithm' if logarithmic else ''}")
    speeds = measured.x.tolist() if measured.over == SPEED else [scene.motion.entrainment_speed] * measured.x.size
    curves = len(found.keys) + STEPS
    seconds = curves * curve_seconds(scene, speeds)
    return "\n".join(
        [*lines, f"  time: about {in_words(seconds)} on one core (an order of magnitude): {curves} curves"]
    )


def _begin(scene: Scene, found: Parameters, start: dict) -> np.ndarray:
    """Where the search begins, as positions between the bounds."""
    for key in start:
        if key not in found.keys:
            raise InputError(f"start holds {key!r}, which is no parameter; allowed: {', '.join(found.keys)}")
    values = found.values(np.full(len(found.keys), 0.5))
    for i, (key, low, high) in enumerate(zip(found.keys, found.low, found.high)):
        section, _, name = key.partition(".")
        own = vars(getattr(scene, section)).get(name)  # a short form has none there
        if key in start:
            values[i] = number(f"start[{key!r}]", start[key], "(of the key)", minimum=low, maximum=high)
        elif isinstance(own, (int, float)) and low < own < high:
            values[i] = own
    return np.clip(found.unit(values), 0.02, 0.98)


@dataclass(frozen=True)
class Curve:
    """The computed curve at a position ``unit`` of the parameters: f (n,), and its points."""

    unit: np.ndarray
    coefficient: np.ndarray
    points: tuple[FrictionResult, ...]


class Search:
    """f of ``scene`` at the points of ``measured``, and its slopes, for any values of ``parameters``. Two curves are
    kept: the last, and that of the last slopes."""

    def __init__(self, scene: Scene, measured: Measured, parameters: Parameters, executor=None, on_progress=None):
        self.scene, self.measured, self.parameters = scene, measured, parameters
        deviation = measured.deviation
        scatter = 0.05 if deviation is None else float(np.median(deviation / np.abs(measured.coefficient)))
        self.tolerance = min(scene.numerics.tolerance, max(0.2 * scatter, 1e-3))  # as tight as the measurement requires
        self._executor, self._on_progress = executor, on_progress
        self._curves = 0
        self._last: Curve | None = None
        self._base: Curve | None = None
        self._slopes = np.empty((0, 0))

    def at(self, unit: np.ndarray) -> Curve:
        """The curve at positions of the parameters between their bounds. Raises `ConvergenceError` when a point
        fails."""
        if self._last is None or not np.array_equal(self._last.unit, unit):
            self._last = self._curve(unit)
        return self._last

    def slopes(self, unit: np.ndarray) -> np.ndarray:
        """df/d(unit), (n, p), by differences at the curve there, or the last ones if these were computed near by."""
        if self._base is None or np.abs(unit - self._base.unit).max() > STEP:
            self._base = self.at(unit)
            self._slopes = self.differences(self._base, STEP)
        return self._slopes

    def differences(self, here: Curve, step: float) -> np.ndarray:
        """df/d(unit), (n, p), at the curve ``here``, by differences of ``step`` that stay within the bounds."""
        columns = []
        for i, key in enumerate(self.parameters.keys):
            moved = here.unit.copy()
            moved[i] += step if moved[i] + step <= 1.0 else -step
            try:
                away = self._curve(moved).coefficient
            except ConvergenceError as error:
                raise ConvergenceError(
                    f"{key} moved by {step:g} of its range: {error}", error.report, error.result
                ) from error
            columns.append((away - here.coefficient) / (moved[i] - here.unit[i]))
        return np.stack(columns, axis=1)

    def _curve(self, unit: np.ndarray) -> Curve:
        scene = self.parameters.into(self.scene, self.parameters.values(np.clip(unit, 0.0, 1.0)))
        prepared = prepare(scene.with_(numerics={"tolerance": self.tolerance}))
        work = partial(_point, prepared, self.measured.over == SPEED)
        self._curves += 1
        found: dict[int, FrictionResult] = {}
        for index, point in spread(self._executor, work, list(enumerate(self.measured.x.tolist()))):
            found[index] = point
            if self._on_progress:
                self._on_progress(self._curves, len(found), self.measured.x.size)
        points = tuple(found[i] for i in range(self.measured.x.size))
        return Curve(unit.copy(), np.array([point.coefficient for point in points]), points)


def _point(prepared: Prepared, speeds: bool, place: tuple[int, float]) -> Iterator[tuple[int, FrictionResult]]:
    """A point of a curve, with its number: ``place`` has that, and a speed [m/s] or a slide-roll ratio."""
    index, x = place
    if speeds:
        yield index, friction(prepared, x).without_fields()
    else:
        moved = prepared.scene.with_(motion={"slide_roll_ratio": x})
        yield index, friction(prepare(moved, like=prepared)).without_fields()


def _numerical_variance(points, tolerance: float, relative: np.ndarray) -> float:
    """Mean square of the numerical error of f, which hides from the data what changes f by less. ``relative``: f over
    the scale of the residuals. Where the error of a point is not known it is the tolerance."""
    stated = np.array([point.uncertainty.numerical for point in points])
    known = np.maximum(np.where(np.isfinite(stated), stated, tolerance), LEAST_ERROR)
    return float(np.mean((known * relative) ** 2))


def _result(search: Search, scale: np.ndarray, end) -> FitResult:
    """The result of a ``search`` whose derivatives were computed where it ended (``end``, of SciPy), or near by."""
    measured, curve = search.measured, search.at(end.x)
    n, p = end.jac.shape
    squares = float(end.fun @ end.fun)
    variance = squares / (n - p) if measured.deviation is None else 1.0
    variance += _numerical_variance(curve.points, search.tolerance, curve.coefficient / scale)
    _, singular, axes = np.linalg.svd(end.jac, full_matrices=False)
    known = np.maximum(singular, max(1e-8 * singular[0], LEAST_SLOPE))  # a direction without effect: a huge variance
    status = CONVERGED if end.status > 0 else ITERATION_LIMIT
    report = Report(
        "fit, trust region",
        status,
        int(end.nfev),
        0.0 if status == CONVERGED else 1.0,
        CLOSE,
        {"sum of squares": squares},
        advice="give start = {...} closer to the answer, narrower bounds, or fewer parameters",
    )
    return FitResult(
        base=search.scene,
        measured=measured,
        parameters=search.parameters,
        unit=np.clip(end.x, 0.0, 1.0),
        unit_covariance=variance * (axes.T / known**2) @ axes,
        predicted=curve.coefficient,
        slopes=end.jac * scale[:, None],
        scale=scale,
        report=report,
        entries=tuple(point.validity for point in curve.points),
        sampling=np.array([point.uncertainty.sampling for point in curve.points]),
    )
