"""`fit`: bounded least squares of a scene to a measured curve, and how well the data determine its parameters."""

import time
from functools import partial
from itertools import product
from typing import Any

import numpy as np

from .._base import validate, with_default_errors
from ..errors import CONVERGED, ITERATION_LIMIT, InputError, LubfricError, Report, returned
from ..estimate import FrictionResult
from ..models.shared import (
    Prepared,
    prepare,
)
from ..quantities import counted, worded_value
from ..scene import Scene
from .curve import without_rolling
from .executor import checked_executor, spread
from .explain import curve_seconds, in_words
from .fit_input import SLIP, SPEED, Measured, parameters_of, values_at
from .fit_result import FitResult
from .points import at_ratios, key_of, solved
from .store import opened
from .vary import Between, unit_of

STEP = 0.04  # of the bounds, of the differences, which are believed as far away: above the scatter of the solves
CLOSE = 2e-3  # of the bounds: a last move of the parameters that ends the search
RATIO = {"motion.slide_roll_ratio", "motion.slip_percent"}
# of f, relative, that may be stated; and by a parameter, over its bounds
LEAST_ERROR = 1e-6
LEAST_SLOPE = 1e-9
MOST = 30  # curves on the way, beside those of the differences
STEPS = 5  # curves of a search, about, beside two for each parameter
CORNERS = 16  # of the ranges, at which the work of a curve is counted


@with_default_errors
def fit(
    scene: Scene, measured: Measured, parameters, *, start=None, executor=None, store=None, on_progress=None
) -> FitResult:
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
    store : folder that receives every point at once; the same fit goes on from there
    on_progress : called as on_progress(done, total, left, misfit, values) after each curve: ``done`` of about ``total``
        curves, about ``left`` seconds to go on one core at the rate so far, and the least root mean square misfit so
        far (relative, or in deviations if these are given) with the ``values`` {"section.key": value} that have it

    Returns a `FitResult`.

    Raises
    ------
    InputError : before any work
    ConvergenceError : the search does not end, or a curve fails; carries the result
    """
    from scipy.optimize import least_squares

    found = _checked(scene, measured, parameters)
    begin = _begin(scene, found, {} if start is None else start)
    ends: dict[str, Any] = {"bounds": (0.0, 1.0), "xtol": CLOSE, "ftol": 1e-4, "gtol": 1e-12, "max_nfev": MOST}
    with opened(store) as kept:
        search = Search(scene, measured, found, checked_executor(executor), kept.root, on_progress)
        end = least_squares(search.residuals, begin, lambda unit: search.slopes(unit) / measured.scale[:, None], **ends)
        return returned(_result(search, end))


@with_default_errors
def explain_fit(scene: Scene, measured: Measured, parameters) -> str:
    """What a fit will do and about how long it will take, in words: by the work counted where it may begin and at the
    corners of the ranges. Maps are made, and no point is solved.

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
    found = _checked(scene, measured, parameters)
    count = counted(len(found), "parameters")
    lines = [f"fit of {count} of {scene.name} to {counted(measured.x.size, 'points')} of {measured.source}"]
    for key, bounds in found.items():
        logarithmic = ", sought in its logarithm" if bounds.scale == "log" else ""
        lines.append(f"  {key}: {worded_value(key, bounds.low)} to {worded_value(key, bounds.high)}{logarithmic}")
    if measured.over == SLIP:
        held = "they hold" if measured.rolling else "they do not hold"
        lines.append(f"  {held} the rolling part of the friction, which averaging over both signs of slip takes out")
    search = Search(scene, measured, found)
    corners = list(product((0.0, 1.0), repeat=len(found)))
    places = [_begin(scene, found, {}), *map(np.array, corners[:: -(-len(corners) // CORNERS)])]
    curves = 2 * len(found) + STEPS
    work = [search.seconds(unit) for unit in places]
    seconds = in_words(curves * 0.5 * (float(np.mean(work)) + max(work)))
    return "\n".join([*lines, f"  time: about {seconds} on one core (within a factor of about 4): {curves} curves"])


def _checked(scene: Scene, measured: Measured, parameters) -> dict[str, Between]:
    """What is sought, if data and scene can tell it."""
    validate.instance("scene", scene, Scene, "a scene to change: what lubfric.load_scene returned, not lubfric.prepare")
    validate.instance("measured", measured, Measured, "lubfric.read_measured(...) or lubfric.Measured(x, coefficient)")
    found = parameters_of(scene, parameters)
    if measured.over == SLIP and (given := RATIO.intersection(found)):
        raise InputError(f"parameters: {', '.join(given)} is measured, not fitted; name another number of the scene")
    if measured.x.size <= len(found):
        points = counted(measured.x.size, "measured points")
        sought = counted(len(found), "parameters")
        raise InputError(f"{points} for {sought}; give more points")
    return found


def _begin(scene: Scene, found: dict[str, Between], start: dict) -> np.ndarray:
    """Where the search begins, as positions between the bounds."""
    for key in start:
        if key not in found:
            raise InputError(f"start holds {key!r}, which is no parameter; allowed: {', '.join(found)}")
    unit = np.full(len(found), 0.5)
    for i, (key, bounds) in enumerate(found.items()):
        section, _, name = key.partition(".")
        own = vars(getattr(scene, section)).get(name)  # a short form has none there
        if key in start:
            own = validate.number(f"start[{key!r}]", start[key], unit_of(key), minimum=bounds.low, maximum=bounds.high)
        if isinstance(own, (int, float)) and bounds.low <= own <= bounds.high:
            unit[i] = bounds.share(own)
    return np.clip(unit, 0.02, 0.98)


class Search:
    """f of ``scene`` at the points of ``measured``, and its slopes, for any positions of ``parameters`` between their
    bounds, each computed once."""

    def __init__(self, scene: Scene, measured: Measured, parameters, executor=None, folder=None, on_progress=None):
        self.scene = scene
        self.measured = measured
        self.parameters = parameters
        told = measured.deviation is not None
        scatter = float(np.median(measured.scale / np.abs(measured.coefficient))) if told else 0.05
        self.tolerance = min(scene.numerics.tolerance, max(0.2 * scatter, 1e-3))  # as tight as the measurement requires
        self._executor = executor
        self._folder = folder
        self._on_progress = on_progress
        self._curves: dict[bytes, tuple[FrictionResult, ...]] = {}
        self._nearest = np.inf, np.empty(0)  # the least misfit, and where
        self._base = np.full(len(parameters), np.inf)
        self._slopes = np.empty((0, 0))
        self._ready: Prepared | None = None

    def at(self, unit: np.ndarray) -> tuple[FrictionResult, ...]:
        """The points there. Raises `ConvergenceError` when one of them fails."""
        if unit.tobytes() not in self._curves:
            prepared = self.ready(unit)
            x = self.measured.x.tolist()
            if self.measured.over == SPEED:
                key = key_of(prepared)
                places = [(prepared, key, speed) for speed in x]
            else:
                speed = prepared.scene.motion.entrainment_speed
                places = [(model, key_of(model), speed) for model in at_ratios(prepared, x)]
            jobs = [partial(solved, model, key, (u,), folder=self._folder) for model, key, u in places]
            outcomes = {(key, u): outcome for key, u, outcome in spread(self._executor, jobs)}
            points = tuple(outcomes[key, u] for _, key, u in places)
            for failed in (outcome for outcome in points if isinstance(outcome, LubfricError)):
                raise failed
            self._curves[unit.tobytes()] = points
            if self._on_progress:
                self._tell(unit)
        return self._curves[unit.tobytes()]

    def coefficient(self, unit: np.ndarray) -> np.ndarray:
        """f (n,), with the rolling part of the film's force or without it, as was measured."""
        points = self.at(unit)
        return np.array([p.coefficient if self.measured.rolling else without_rolling(p) for p in points])

    def residuals(self, unit: np.ndarray) -> np.ndarray:
        """The misfits of the points over their scale, (n,)."""
        return (self.coefficient(unit) - self.measured.coefficient) / self.measured.scale

    def slopes(self, unit: np.ndarray) -> np.ndarray:
        """df/d(unit), (n, p), by differences at the curve there, or the last ones if these were computed near by."""
        if np.abs(unit - self._base).max() <= STEP:
            return self._slopes
        columns = []
        for i in range(unit.size):
            moved = unit.copy()
            moved[i] += STEP if moved[i] + STEP <= 1.0 else -STEP  # within the bounds
            columns.append((self.coefficient(moved) - self.coefficient(unit)) / (moved[i] - unit[i]))
        self._base = unit.copy()
        self._slopes = np.stack(columns, axis=1)
        return self._slopes

    def ready(self, unit: np.ndarray) -> Prepared:
        """The scene made ready there, with the map of the last one where that is the same."""
        scene = self.scene.with_keys(values_at(self.parameters, np.clip(unit, 0.0, 1.0)))
        scene, last = scene.with_(numerics={"tolerance": self.tolerance}), self._ready
        maps = [(s.surface, s.counterface, s.contact, s.bodies.e_prime) for s in (scene, last.scene if last else scene)]
        self._ready = prepare(scene, like=last if maps[0] == maps[1] else None)
        return self._ready

    def seconds(self, unit: np.ndarray) -> float:
        """The processor seconds of a curve there, by its counted work, with those of the map."""
        begun = time.process_time()
        x = self.measured.x.tolist()
        speeds = x if self.measured.over == SPEED else [self.scene.motion.entrainment_speed] * len(x)
        return curve_seconds(self.ready(unit), speeds) + time.process_time() - begun

    def _tell(self, unit: np.ndarray) -> None:
        """Tell ``on_progress`` of the curve that was solved last."""
        misfit = float(np.sqrt(np.mean(self.residuals(unit) ** 2)))
        self._nearest = min(self._nearest, (misfit, unit.copy()), key=lambda one: one[0])
        done = len(self._curves)
        (least, nearest) = self._nearest
        total = max(2 * len(self.parameters) + STEPS, done + 1)
        spent = sum(point.seconds for curve in self._curves.values() for point in curve)
        self._on_progress(done, total, (total - done) * spent / done, least, values_at(self.parameters, nearest))


def _result(search: Search, end) -> FitResult:
    """The result of a ``search`` whose derivatives were computed where it ended (``end``, of SciPy), or near by."""
    measured = search.measured
    points = search.at(end.x)
    predicted = search.coefficient(end.x)
    n, p = end.jac.shape
    squares = float(end.fun @ end.fun)
    variance = squares / (n - p) if measured.deviation is None else 1.0
    f, stated = np.array([(point.coefficient, point.uncertainty.numerical) for point in points]).T
    known = np.maximum(np.where(np.isfinite(stated), stated, search.tolerance), LEAST_ERROR)
    variance += float(np.mean((known * f / measured.scale) ** 2))  # what changes f by less is hidden from the data
    _, singular, axes = np.linalg.svd(end.jac, full_matrices=False)
    known = np.maximum(singular, max(1e-8 * singular[0], LEAST_SLOPE))  # a direction without effect: a huge variance
    status = CONVERGED if end.status > 0 else ITERATION_LIMIT
    coarse = "give start = {...} closer to the answer, narrower bounds, or fewer parameters"
    left, advice = (0.0, "") if status == CONVERGED else (1.0, coarse)
    found = {"sum of squares": squares}
    report = Report("fit, trust region", status, int(end.nfev), left, CLOSE, found, advice=advice)
    return FitResult(
        base=search.scene,
        measured=measured,
        parameters=search.parameters,
        unit=np.clip(end.x, 0.0, 1.0),
        unit_covariance=variance * (axes.T / known**2) @ axes,
        predicted=predicted,
        slopes=end.jac * measured.scale[:, None],
        report=report,
        entries=tuple(point.validity for point in points),
        sampling=np.array([point.uncertainty.sampling for point in points]),
    )
