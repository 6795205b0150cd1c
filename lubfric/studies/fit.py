"""`fit`: bounded least squares of a scene to a measured curve, and how well the data determine its parameters."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from .._base import validate, with_default_errors
from .._base.processes import checked_executor
from .._base.processor_time import processor_time
from ..errors import CONVERGED, ITERATION_LIMIT, InputError, Report, returned
from ..quantities import counted, worded_value
from ..scene import Scene
from .explain import WITHIN_WORDS, in_words
from .fit_checks import residual_tests, root_mean_square
from .fit_curves import FitCurves, coarse_measured, coarse_scene, fit_tolerance, linear_place
from .fit_input import SLIDE_ROLL_RATIO_COLUMN, Measured, parameters_of, values_at
from .fit_profile import LEAST_DECREASE, Profile, confirmed_ends, flat_parameters, follow, loose_parameters
from .fit_result import AT_BOUND, FitResult
from .fit_search import INSIDE, Candidate, estimated_curves, search_minima, sobol_count, with_minimum
from .store import opened
from .vary import Between, unit_of

# Last move of the parameters, as a share of the bounds, that ends the search. A choice, far below what scatter moves.
LAST_MOVE = 2e-3

# Relative change of the sum of squares that ends the search. A choice, far below what scatter changes.
LAST_CHANGE_OF_SUM = 1e-4

# Most curves of the search, beside those of the differences. A choice: a bound of the work.
MOST_CURVES = 30

# Curves of the fit by the scene's own model, about, beside two for each parameter: at the start and at the fitted
# values. 3 to 5 were solved for one parameter, 4 to 14 for f_b and another one, 2 or 3 for f_b alone.
USUAL_CURVES = 2

# Beginnings of the trust region, at most: at a start, and again at fitted values that were not solved yet, or at a
# lower curve of the differences. A choice: a bound of the work.
MOST_BEGINNINGS = 6

# Curves of a parameter that f does not change with at the fit, about: at both bounds, and to the end of its interval. A
# choice between two, where f changes nowhere, and those of an interval with one end (`MOST_FOLLOWED`).
USUAL_FOLLOWED = 5

# Curves towards both ends of a wide interval, about. A choice between two, where the slopes predict both ends, and
# those of an Eyring stress without an upper end (7).
USUAL_CONFIRMED = 4

# Minima of the coarse search from which the scene's own model is fitted, where the first does not describe the data.
MOST_FITTED_MINIMA = 3

# Corners of the bounds at which the work of a curve is counted. A choice: those of four parameters.
CORNERS = 16

# Smallest relative error of f that may be stated. A choice, near rounding.
LEAST_ERROR = 1e-6

# Smallest change of the residuals over the bounds of a parameter that determines it. A choice, near rounding.
LEAST_SLOPE = 1e-9

# Keys that a traction curve is measured over.
OF_SLIP = {"motion.slide_roll_ratio", "motion.slip_percent"}


@with_default_errors
def fit(
    scene: Scene,
    measured: Measured,
    parameters: Mapping[str, Any],
    *,
    start: dict[str, float] | None = None,
    starts: int | None = None,
    executor: Any = None,
    store: str | Path | None = None,
    on_progress: Callable[..., Any] | None = None,
) -> FitResult:
    """Find the values of ``parameters`` with which the friction of a scene is nearest to a measured curve.

    The fit minimises ``sum ((f - measured)/deviation)²``, with relative deviations if none are given. It first searches
    the complete bounds with the load-sharing model, loose tolerances and at most 8 of the points
    (`lubfric.studies.fit_search`): from the start and from the points of a Sobol sequence. From the lowest minimum, a
    trust region within the bounds (`scipy.optimize.least_squares`, "trf") continues with all points and the scene's own
    model; while the fit does not describe the data, it also continues from the next minima, if larger residuals
    separate them from the lowest. Derivatives are differences over 4 % of the bounds, which stay above the tolerance on
    f. A parameter that f does not change with at the fit is followed to its bounds, and curves towards the ends of a
    wide interval show where these are (`lubfric.studies.fit_profile`); the fit continues from smaller residuals on the
    way. The search stops when a step moves the parameters by <= 0.2 % of their bounds, or changes the sum by <= 1e-4 of
    it.

    `FitResult` has the uncertainty of the values, and says whether the fit describes the data at all.
    `lubfric.explain_fit` says beforehand how long a fit will take.

    Parameters
    ----------
    scene : what is known, with the numerics to be used
    measured : from `lubfric.read_measured`, or `lubfric.Measured(speeds, coefficients)`
    parameters : {"section.key": (lowest, highest)}, numbers of the scene to be found between bounds, in SI units
    start : {"section.key": value} to begin with; default: the scene's own if they lie within the bounds, else the
        middle
    starts : number of further starts, spread over the bounds: 0, or a power of two; None: 8 for one parameter, 16 for
        two, 32 for three to five, not counting f_b, in which f is linear
    executor : any `concurrent.futures.Executor`, for the points of a curve; the same bits on each
    store : folder that receives every point at once; the same fit continues from there
    on_progress : called as on_progress(done, total, left, misfit, values) after each curve: ``done`` of about
        ``total`` curves, about ``left`` seconds of processor time left, the least root mean square misfit so far of the
        scene's own model (relative, or in deviations if these are given; NaN during the search, whose model and points
        are others), and the best ``values`` {"section.key": value} so far

    Returns a `FitResult`.

    Raises
    ------
    InputError : before any work
    ConvergenceError : the search does not end, or a curve fails; carries the result
    """
    validate.called_back("on_progress", on_progress, "done, total, left, misfit, values")
    bounds = _checked(scene, measured, parameters)
    begin = _start(scene, bounds, {} if start is None else start)
    starts = _checked_starts(scene, starts, bounds)
    with opened(store) as kept:
        coarse, fine = _curves(scene, measured, bounds, checked_executor(executor), kept.root)
        if on_progress:
            progress = _Progress(coarse, fine, begin, starts, on_progress)
            coarse.on_curve = partial(progress.report, coarse)
            fine.on_curve = partial(progress.report, fine)
        minima = search_minima(coarse, begin, starts, linear_place=coarse.linear_place)
        results: list[FitResult] = []
        for minimum in (minima[0], *(each for each in minima[1:] if each.is_separate))[:MOST_FITTED_MINIMA]:
            fine.expected = fine.count + _usual_curves(fine)
            results.append(_fitted(fine, minimum.unit, starts=starts, minima=minima))
            if results[-1].describes_data and results[-1].report.converged:
                break
        lowest = min(results, key=_sum_of_squares)
        return returned(replace(_followed(coarse, fine, lowest), base=scene))


@with_default_errors
def explain_fit(scene: Scene, measured: Measured, parameters: Mapping[str, Any], *, starts: int | None = None) -> str:
    """Return what a fit will do and about how long it will take, as text.

    The time is that of the work counted where the fit may begin and at the corners of the bounds. Maps are made, and no
    point is solved.

    Parameters
    ----------
    scene, measured, parameters, starts : as for `lubfric.fit`

    Returns
    -------
    str : lines of text

    Raises
    ------
    InputError : a parameter is not one
    """
    bounds = _checked(scene, measured, parameters)
    starts = _checked_starts(scene, starts, bounds)
    count = counted(len(bounds), "parameters")
    lines = [f"fit of {count} of {scene.name} to {counted(measured.x.size, 'points')} of {measured.source}"]
    if len(measured.branches) > 1:
        apart = f"their coefficients are {100 * measured.hysteresis:.2g} % apart (rms)"
        lines.append(f"  {counted(len(measured.branches), 'ramps')} of rising and falling {measured.over}: {apart}")
    for key, ends in bounds.items():
        logarithmic = ", searched on a logarithmic scale" if ends.scale == "log" else ""
        lines.append(f"  {key}: {worded_value(key, ends.low)} to {worded_value(key, ends.high)}{logarithmic}")
    if measured.over == SLIDE_ROLL_RATIO_COLUMN:
        held = "contain" if measured.rolling else "do not contain"
        lines.append(f"  the measured coefficients {held} rolling friction (a mean over both signs of slip has none)")
    coarse, fine = _curves(scene, measured, bounds)
    searched, fitted, seconds = _estimated(coarse, fine, _start(scene, bounds, {}), starts)
    if starts:
        size = counted(coarse.measured.x.size, "points")
        lines.append(
            f"  search: {starts_in_words(starts)}; about {searched} curves of {size} by the load-sharing model"
        )
    both = f"; {searched + fitted} with those of the search" if starts else ""
    lines.append(f"  fit: about {counted(fitted, 'curves')} of {counted(measured.x.size, 'points')}{both}")
    return "\n".join([*lines, f"  time: about {in_words(seconds)} of processor time ({WITHIN_WORDS})"])


def estimated_fit(
    scene: Scene, measured: Measured, parameters: Mapping[str, Any], *, starts: int | None = None
) -> float:
    """Return the estimated processor seconds of a fit; arguments as for `lubfric.fit`."""
    bounds = _checked(scene, measured, parameters)
    coarse, fine = _curves(scene, measured, bounds)
    return _estimated(coarse, fine, _start(scene, bounds, {}), _checked_starts(scene, starts, bounds))[2]


def starts_in_words(starts: int) -> str:
    """Return from where the search of a fit with so many further ``starts`` begins, as text."""
    return f"from the start and {counted(starts, 'further starts')} over the complete bounds"


def _estimated(coarse: FitCurves, fine: FitCurves, begin: np.ndarray, starts: int) -> tuple[int, int, float]:
    """Return about how many curves the search and the fit compute, and their processor seconds."""
    searched = estimated_curves(coarse.changed, starts)
    fitted = _usual_curves(fine)
    return searched, fitted, searched * _usual_seconds(coarse, begin) + fitted * _usual_seconds(fine, begin)


def _usual_curves(fine: FitCurves) -> int:
    """Return about how many curves a trust region solves, none for its steps where f_b alone changes; and those towards
    the ends of the intervals, of which half are wide."""
    if not fine.changed:
        return USUAL_CURVES
    return USUAL_CURVES + 2 * len(fine.parameters) + USUAL_CONFIRMED * len(fine.parameters) // 2


def _curves(
    scene: Scene, measured: Measured, bounds: dict[str, Between], executor: Any = None, folder: str | Path | None = None
) -> tuple[FitCurves, FitCurves]:
    """Return the curves of the search by the coarse model, and those of the fit by the scene's own."""
    fine = scene.with_(numerics={"tolerance": fit_tolerance(scene, measured)})
    return (
        FitCurves(coarse_scene(fine), coarse_measured(measured), bounds, executor, folder),
        FitCurves(fine, measured, bounds, executor, folder),
    )


def _checked(scene: Scene, measured: Measured, parameters: Mapping[str, Any]) -> dict[str, Between]:
    """Return the bounds of ``parameters`` if scene and data can determine them; raises `InputError`."""
    validate.instance("scene", scene, Scene, "a scene to change: what lubfric.load_scene returned, not lubfric.prepare")
    validate.instance("measured", measured, Measured, "lubfric.read_measured(...) or lubfric.Measured(x, coefficient)")
    bounds = parameters_of(scene, parameters)
    if measured.over == SLIDE_ROLL_RATIO_COLUMN and (given := OF_SLIP.intersection(bounds)):
        raise InputError(f"parameters: {', '.join(given)} is measured, not fitted; name another number of the scene")
    if measured.x.size <= len(bounds):
        points = counted(measured.x.size, "measured points")
        raise InputError(f"{points} for {counted(len(bounds), 'parameters')}; give more points")
    return bounds


def _checked_starts(scene: Scene, starts: int | None, bounds: dict[str, Between]) -> int:
    """Return the number of starts of the search; raises `InputError`. A fit of f_b alone has one minimum and needs
    none."""
    changed = len(bounds) - (linear_place(scene, bounds) is not None)
    if starts is None:
        starts = sobol_count(changed) if changed else 0
    starts = validate.integer("starts", starts, minimum=0, maximum=2**12)
    if starts & (starts - 1):
        raise InputError(f" = {starts} of a Sobol sequence", "starts", "0, or a power of two")
    return starts if changed else 0


def _start(scene: Scene, bounds: dict[str, Between], start: dict[str, float]) -> np.ndarray:
    """Return where the search begins, as positions between the bounds."""
    for key in start:
        if key not in bounds:
            raise InputError(f"start contains {key!r}, which is not a parameter; allowed: {', '.join(bounds)}")
    unit = np.full(len(bounds), 0.5)
    for i, (key, ends) in enumerate(bounds.items()):
        section, _, name = key.partition(".")
        value = vars(getattr(scene, section)).get(name)  # a short form has none there
        if key in start:
            value = validate.number(f"start[{key!r}]", start[key], unit_of(key), minimum=ends.low, maximum=ends.high)
        if isinstance(value, (int, float)) and ends.low <= value <= ends.high:
            unit[i] = ends.share(value)
    return np.clip(unit, INSIDE, 1.0 - INSIDE)


def _usual_seconds(curves: FitCurves, begin: np.ndarray) -> float:
    """Return the estimated processor seconds of one of the ``curves``: the mean of those at ``begin`` and at corners of
    the bounds. What curves share is done by one of many, and does not count."""
    corners = list(product((0.0, 1.0), repeat=begin.size))
    places = [begin, *map(np.array, corners[:: -(-len(corners) // CORNERS)])]
    curves.prepared(begin)
    return float(np.mean([curves.estimated_seconds(unit) for unit in places]))


class _Progress:
    """Reports of the curves of a fit, with the least misfit and the time left."""

    def __init__(
        self, coarse: FitCurves, fine: FitCurves, begin: np.ndarray, starts: int, on_progress: Callable[..., Any]
    ):
        coarse.expected = estimated_curves(coarse.changed, starts)
        fine.expected = _usual_curves(fine)
        self.curves = {id(kind): (kind, _usual_seconds(kind, begin)) for kind in (coarse, fine)}
        self.fine = fine
        self.on_progress = on_progress
        self.least: dict[int, tuple[float, np.ndarray]] = {}
        self.elapsed = dict.fromkeys(self.curves, 0.0)
        self.reported = processor_time()

    def report(self, curves: FitCurves) -> None:
        """Report the last of ``curves``.

        A curve takes what those of its kind took with their maps; of a kind that has none yet what was estimated, times
        the ratio of what the others took to their estimates.
        """
        now = processor_time()
        self.elapsed[id(curves)] += now - self.reported
        self.reported = now
        if curves.count > curves.expected:  # the steps go on: one more, with its differences
            curves.expected = curves.count + max(curves.changed, 1)
        unit = curves.solved[-1]
        if curves is not self.fine:
            unit = curves.lowest_over_boundary_friction(unit)
        misfit = curves.misfit(unit)
        smaller = 1.0 - LEAST_DECREASE if curves.solves_differences else 1.0  # the fit ignores less, too
        if misfit**2 < smaller * self.least.get(id(curves), (np.inf, unit))[0] ** 2:
            self.least[id(curves)] = (misfit, unit)
        done = sum(kind.count for kind, _ in self.curves.values())
        total = done
        left = 0.0
        taken = dict(self.elapsed)
        for key, (kind, _) in self.curves.items():
            if kind.has_executor:  # other processes may report no processor time
                taken[key] = max(kind.spent, taken[key])
        expected_so_far = sum(kind.count * estimated for kind, estimated in self.curves.values())
        slower = sum(taken.values()) / expected_so_far if expected_so_far > 0 else 1.0
        for kind, estimated in self.curves.values():
            is_ended = kind is not self.fine and self.fine.count > 0
            remaining = 0 if is_ended else max(kind.expected - kind.count, 0)
            each = taken[id(kind)] / kind.count if kind.count else slower * estimated
            total += remaining
            left += remaining * each
        least, position = self.least[id(self.fine if self.fine.count else curves)]
        misfit = least if self.fine.count else np.nan
        self.on_progress(done, total, left, misfit, values_at(curves.parameters, position))


def _sum_of_squares(result: FitResult) -> float:
    """Return the sum of squares of the residuals of a fit."""
    return result.report.residuals["sum of squares"]


def _followed(coarse: FitCurves, fine: FitCurves, result: FitResult) -> FitResult:
    """Return ``result`` with the profiles of the parameters that f does not change with there, and of those with wide
    intervals; where one of them leads to a smaller sum of squares, the result of a trust region that begins there."""
    followed: set[int] = set()  # beside an edge of f the differences say no more than on the flat
    tries = result.unit.size
    while True:
        jacobian = result.slopes / result.measured.scale[:, None]
        profiles: dict[str, Profile] = {}
        followed.update(flat_parameters(jacobian, result.variance, result.student))
        loose: set[int] = set()
        if result.describes_data:  # without it no interval is valid
            loose.update(loose_parameters(result.unit_covariance, result.student))
        loose -= followed if fine.changed else {*followed, fine.linear_place}  # f is linear in f_b alone
        fine.expected = fine.count + USUAL_FOLLOWED * len(followed - {fine.linear_place}) + USUAL_CONFIRMED * len(loose)
        ends = partial(confirmed_ends, covariance=result.unit_covariance)
        for place in (*sorted(followed), *sorted(loose)):
            search = follow if place in followed else ends
            profile = search(fine, result.unit, jacobian, place=place, variance=result.variance, student=result.student)
            profiles[list(result.parameters)[place]] = profile
            if profile.better is not None and tries:
                break
        better = [profile.better for profile in profiles.values() if profile.better is not None]
        if not better or not tries:
            return replace(result, profiles=profiles)
        fine.forget_slopes()
        other = _fitted(fine, better[0], starts=result.starts, minima=[])
        minima = with_minimum(coarse, result.minima, other.unit) if result.starts else list(result.minima)
        tries -= 1
        if _sum_of_squares(other) >= _sum_of_squares(result):
            tries = 0  # the profiles of the other parameters are still to be followed
        else:
            result = replace(other, minima=tuple(minima))


def _least(curves: FitCurves, begin: np.ndarray) -> tuple[np.ndarray, str, int]:
    """Return the position (p,) of the solved curve at which a trust region from ``begin`` (p,) ends, its status, and
    the number of its steps.

    It begins again where f_b alone has moved, so that the curve is not solved yet, until it moves by no more than
    `LAST_MOVE`; and where a curve of the differences has a smaller sum of squares.
    """
    from scipy.optimize import least_squares

    measured = curves.measured
    limits: dict[str, Any] = {"xtol": LAST_MOVE, "ftol": LAST_CHANGE_OF_SUM, "gtol": 1e-12, "max_nfev": MOST_CURVES}
    known_before = curves.count
    steps = 0
    for _ in range(MOST_BEGINNINGS):
        curves.points(begin)
        end = least_squares(
            curves.residuals,
            begin,
            lambda unit: curves.slopes(unit) / measured.scale[:, None],
            bounds=(0.0, 1.0),
            **limits,
        )
        steps += int(end.nfev)
        if end.status <= 0:
            return end.x, ITERATION_LIMIT, steps
        unit = end.x if curves.is_solved(end.x) else begin
        if np.abs(end.x - unit).max() <= LAST_MOVE:
            lowest = min([unit, *curves.solved[known_before:]], key=curves.misfit)
            if curves.misfit(lowest) ** 2 >= (1.0 - LEAST_DECREASE) * curves.misfit(unit) ** 2:
                return unit, CONVERGED, steps
            curves.forget_slopes()
            begin = lowest
        else:
            begin = end.x
    return unit, ITERATION_LIMIT, steps


def _fitted(curves: FitCurves, begin: np.ndarray, *, starts: int, minima: list[Candidate]) -> FitResult:
    """Return the result of a trust region that begins at ``begin`` (p,), at a solved curve."""
    measured = curves.measured
    (unit, status, iterations) = _least(curves, begin)
    residuals = curves.residuals(unit)
    jacobian = curves.slopes(unit) / measured.scale[:, None]
    points = curves.points(unit)
    predicted = curves.coefficient(unit)
    n, p = jacobian.shape
    squares = float(residuals @ residuals)
    stated = measured.deviation is not None
    model_error = np.array([point.uncertainty.model for point in points])
    coefficient = np.array([point.coefficient for point in points])
    errors = np.array([point.uncertainty.numerical for point in points])
    relative = np.maximum(np.where(np.isfinite(errors), errors, curves.tolerance), LEAST_ERROR)
    numerical = np.abs(relative * coefficient / measured.scale)
    variance = 1.0 if stated else squares / (n - p)
    variance += float(np.mean(numerical**2))  # the data do not see a change of f below its numerical error
    _, singular, axes = np.linalg.svd(jacobian, full_matrices=False)
    effect = np.maximum(singular, max(1e-8 * singular[0], LEAST_SLOPE))  # a direction without effect: a huge variance
    is_free = np.minimum(unit, 1.0 - unit) >= AT_BOUND
    scale = measured.scale if stated else predicted  # without the noise of the measured f
    advice = "give start = {...} closer to the answer, narrower bounds, or fewer parameters"
    report = Report(
        "fit, trust region",
        status,
        iterations=iterations,
        residual=0.0 if status == CONVERGED else 1.0,
        tolerance=LAST_MOVE,
        residuals={"sum of squares": squares},
        evaluations=curves.count,
        advice="" if status == CONVERGED else advice,
    )
    return FitResult(
        base=curves.scene,
        measured=measured,
        parameters=curves.parameters,
        unit=np.clip(unit, 0.0, 1.0),
        unit_covariance=variance * (axes.T / effect**2) @ axes,
        predicted=predicted,
        slopes=jacobian * measured.scale[:, None],
        report=report,
        violations=tuple(point.validity for point in points),
        sampling=np.array([point.uncertainty.sampling for point in points]),
        tests=residual_tests(
            measured.x,
            residuals * measured.scale / scale,
            (jacobian * (measured.scale / scale)[:, None])[:, is_free],
            numerical,
            stated=stated,
            fitted=predicted,
            scale=scale,
            relative=root_mean_square(predicted / measured.coefficient - 1.0),
            expected=root_mean_square(np.nan_to_num(model_error)),
        ),
        model_error=model_error,
        starts=starts,
        minima=tuple(minima),
        variance=variance,
        points=points,
        tolerance=curves.tolerance,
    )
