"""The status of a report: whether all points are solved, and which tolerances they miss."""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..models.shared import (
    ERROR_OF_ORDER_OF_MAGNITUDE,
    NEAR_ZERO,
    Assumption,
    Violation,
    is_near_zero,
    percent,
    sentence,
)
from ..quantities import counted
from ..scene import Numerics, Scene
from ..studies import CurveResult, StudyResult, columns_of_curve, columns_of_study
from ..time import TransientResult, counts_in_average
from ..units import worded
from .missed_tolerances import MissedTolerance, missed_tolerances
from .operating_point import place_on_curve
from .study_points import scene_of_each, violations_of_each

# Assumptions on errors of f, whose violation the status of a run names.
ERRORS_OF_F = (Assumption.NUMERICAL_ERROR, Assumption.MODEL_FORM_ERROR)


def status_kind(*, failed: bool, inexact: int) -> str:
    """Return the kind of a status, a class of the style sheet: whether points ``failed``, and whether (not 0) f is
    ``inexact``: an order of magnitude, or beyond a tolerance."""
    if failed:
        return "failed"
    return "inexact" if inexact else ""


@dataclass(frozen=True, kw_only=True)
class StatusOfPoints:
    """How sure f is at the points of a curve or of a study.

    Attributes
    ----------
    columns : their numbers by name, (n,), those of the error of f among them
    scenes : the scene of each, (n,)
    violations : the assumptions that do not hold at each, (n,)
    """

    columns: Mapping[str, np.ndarray]
    scenes: Sequence[Scene]
    violations: Sequence[tuple[Violation, ...]]

    @property
    def exceeded(self) -> list[MissedTolerance]:
        """The tolerances that points miss, but for the `usual_model_errors`."""
        return [
            replace(each, notes=self._noted_model_errors(each.points))
            if each.assumption == Assumption.MODEL_FORM_ERROR
            else each
            for each in missed_tolerances(self.columns, self.scenes, self.usual_model_errors)
        ]

    @property
    def usual_model_errors(self) -> np.ndarray:
        """The relative model-form errors of f that are above the default target and usual for the quick model, which
        the scene names, (n,); NaN at other points."""
        return np.array([_usual_model_error(*pair) for pair in zip(self.scenes, self.violations)])

    @property
    def omitted_heat(self) -> np.ndarray:
        """The relative reduction of f by the heat of the film, at most, that neither f nor its interval includes, (n,);
        NaN at other points."""
        return np.array([_omitted_heat(each) for each in self.violations])

    def _noted_model_errors(self, points: Iterable[int]) -> int:
        """Return at how many ``points`` the model-form error is a note."""
        return sum(
            any(each.assumption == Assumption.MODEL_FORM_ERROR and each.is_note for each in self.violations[point])
            for point in points
        )

    @property
    def largely_inexact(self) -> int:
        """At how many points the numerical error of f is a warning."""
        return sum(
            any(each.assumption == Assumption.NUMERICAL_ERROR and not each.is_note for each in of_point)
            for of_point in self.violations
        )

    def kind(self, *, failed: bool) -> str:
        """Return the `status_kind`; ``failed``: whether points are not solved."""
        heat = omitted_heat_in_words(self.omitted_heat)
        return status_kind(failed=failed, inexact=self.largely_inexact + len(self.exceeded) + len(heat))

    def in_words(self, plural: str, place: Callable[[int], str]) -> str:
        """Return in sentences that all points are solved, and which tolerances they miss. ``plural``: what they are
        called; ``place``: gives where a row lies, as "at point 3"."""
        total = len(self.scenes)
        head = "The point is solved." if total == 1 else f"All {total} {plural} are solved."
        if self.largely_inexact == 0:
            head = f"Converged: {head[0].lower()}{head[1:]}"
        solved = np.isfinite(self.columns["coefficient"])
        unknown = int(np.isnan(self.columns["interval_low"][solved]).sum())
        orders = orders_of_magnitude(self.columns["numerical_error"].tolist())
        usual = usual_errors_in_words(self.usual_model_errors, self.columns["interval_low"])
        heat = omitted_heat_in_words(self.omitted_heat)
        return " ".join((*orders, head, *shortfalls(self.exceeded, unknown, total, place), *usual, *heat))


def _usual_model_error(scene: Scene, violations: Iterable[Violation]) -> float:
    """Return one of `StatusOfPoints.usual_model_errors`, of a point of ``scene`` with these ``violations``."""
    is_by_default = scene.numerics.model_tolerance == Numerics().model_tolerance
    if scene.numerics.model != "quick" or not is_by_default:
        return np.nan
    of_model = (each for each in violations if each.assumption == Assumption.MODEL_FORM_ERROR)
    # near 0 its unit is that of f, and no relative error counts
    return next((each.effect for each in of_model if each.is_note and each.unit == "%"), np.nan)


def _omitted_heat(violations: Iterable[Violation]) -> float:
    """Return one of `StatusOfPoints.omitted_heat`, of a point with these ``violations``."""
    return next((each.effect for each in violations if each.assumption == Assumption.HEAT_INCLUDED), np.nan)


def omitted_heat_in_words(
    changes: np.ndarray, plural: str = "points", place: Callable[[int], str] = lambda index: f"at point {index + 1}"
) -> list[str]:
    """Return the `StatusOfPoints.omitted_heat` in a sentence; none where all are NaN. ``plural``: what the points are
    called; ``place``: where one lies, as "at point 3"."""
    omitted = changes[np.isfinite(changes)]
    if not omitted.size:
        return []
    where = "" if omitted.size == changes.size else f"at {omitted.size} of {changes.size} {plural} "
    worst = f" ({place(int(np.nanargmax(changes)))})" if omitted.size > 1 else ""
    return [
        sentence(
            f"{where}f and its interval are without the heat of the film, which lowers f by up to "
            f"{percent(float(omitted.max()))}{worst}"
        )
    ]


def usual_errors_in_words(errors: np.ndarray, low_ends: np.ndarray) -> list[str]:
    """Return the `StatusOfPoints.usual_model_errors` in a sentence; none where all are NaN. ``low_ends``: of the
    intervals of f, NaN where they are not known."""
    usual = errors[np.isfinite(errors)]
    if not usual.size:
        return []
    where = "The" if usual.size == errors.size else f"At {usual.size} of {errors.size} points the"
    some = "" if np.isfinite(low_ends[np.isfinite(errors)]).all() else ", where it is known,"
    span = " to ".join(dict.fromkeys(map(percent, (float(usual.min()), float(usual.max())))))
    return [
        f"{where} model-form error of f is {span}, as is usual for the quick model; the interval of f{some} includes it."
    ]


def status_of_curve(scene: Scene, curve: CurveResult) -> StatusOfPoints:
    """Return how sure f is at the points of a ``curve`` of ``scene``."""
    return StatusOfPoints(
        columns=columns_of_curve(curve),
        scenes=[scene] * len(curve.points),
        violations=[() if point is None else point.validity for point in curve.points],
    )


def status_of_study(result: StudyResult) -> StatusOfPoints:
    """Return how sure f is at the points of a study."""
    return StatusOfPoints(
        columns=columns_of_study(result), scenes=scene_of_each(result), violations=violations_of_each(result)
    )


def curve_in_words(scene: Scene, curve: CurveResult) -> str:
    """Return in sentences whether all points of ``curve`` of ``scene`` were solved, and which of its tolerances they
    miss; the first failure with its message."""
    plural = curve.SWEPT[3]
    if not curve.errors:
        return status_of_curve(scene, curve).in_words(plural, lambda index: place_on_curve(curve, index))
    total = len(curve.points)
    solved = total - len(curve.errors)
    first = min(curve.errors)
    return (
        f"Not complete: {solved} of {counted(total, plural)} solved. First failure {place_on_curve(curve, first)}: "
        f"{curve.errors[first]}"
    )


def study_in_words(result: StudyResult) -> str:
    """Return in sentences how many points of a study are solved, and which tolerances they miss, or the most frequent
    failures."""
    if not result.failed:
        return status_of_study(result).in_words("points", lambda row: f"at point {row + 1}")
    failed = Counter(result.failures)
    reasons = "; ".join(f"{count} x {reason.removesuffix('.')}" for reason, count in failed.most_common(3))
    total = counted(result.solved, "points")
    return f"Not complete: {result.solved - result.failed} of {total} solved. Failures: {reasons}."


def orders_of_magnitude(errors: Iterable[float]) -> list[str]:
    """Return at how many solved points, with these relative numerical ``errors`` of f, f is known to an order of
    magnitude only, in a sentence; none where there are none."""
    are_large = [error > ERROR_OF_ORDER_OF_MAGNITUDE for error in errors]
    if not any(are_large):
        return []
    where = "The" if len(are_large) == 1 else f"At {sum(are_large)} of {len(are_large)} points the"
    return [
        f"{where} numerical error of f is above {percent(ERROR_OF_ORDER_OF_MAGNITUDE)}, so f is only an order of "
        "magnitude (see the warnings)."
    ]


def shortfalls(exceeded: Sequence[MissedTolerance], unknown: int, total: int, place: Callable[[int], str]) -> list[str]:
    """Return which tolerances of ``total`` solved points are ``exceeded`` and where (``place`` of a row), and how many
    points have an ``unknown`` interval, in sentences."""
    sentences = [each.in_words(total, place) for each in exceeded]
    if exceeded and not unknown:
        sentences.append(f"The interval of f includes {'this error' if len(exceeded) == 1 else 'these errors'}.")
    if unknown > 0:
        head = f"At {unknown} of {total} points the" if total > 1 else "The"
        sentences.append(f"{head} interval of f is not known.")
    return sentences


def missed_by_run(scene: Scene, result: TransientResult) -> list[str]:
    """Return the errors of f that are above their tolerances at outputs of a run of ``scene``, and the heat that f
    omits, in a sentence each."""
    sentences = []
    named = set()
    for each in result.gathered:
        violation = each.violation
        if violation is None or violation.is_note or violation.assumption not in ERRORS_OF_F:
            continue
        named.add(violation.assumption)
        worst = f"{float(f'{violation.value:.2g}'):g} {violation.unit}"
        sentences.append(
            f"{sentence(each.place).removesuffix('.')} the {violation.what} is above {violation.limit:g} "
            f"{violation.unit}, up to {worst}."
        )
    wide = wide_by_model(scene, result)
    if wide.any() and Assumption.MODEL_FORM_ERROR not in named:
        sentences.append(
            f"At {counted(int(wide.sum()), 'outputs')} the model-form error of f is above "
            f"{100 * scene.numerics.model_tolerance:g} % (numerics.model_tolerance), up to "
            f"{_largest_in_words(result.coefficient[wide], result.uncertainty.model[wide])}."
        )
    heat = np.array([_omitted_heat(each) for each in result.violations])
    return sentences + omitted_heat_in_words(heat, "outputs", lambda index: f"at t = {worded(result.time[index], 's')}")


def _largest_in_words(f: np.ndarray, errors: np.ndarray) -> str:
    """Return the largest of the relative ``errors`` of ``f`` as text, in f itself where it `is_near_zero`."""
    near = np.array([is_near_zero(*pair) for pair in zip(f.tolist(), errors.tolist())])
    words = [percent(float(errors[~near].max()))] if not near.all() else []
    if near.any():
        words.append(f"{float((errors * np.abs(f))[near].max()):.2g} in f itself where f is below {NEAR_ZERO:g}")
    return ", and up to ".join(words)


def wide_by_model(scene: Scene, result: TransientResult) -> np.ndarray:
    """Return the outputs (bools) of a run of ``scene`` whose model-form error of f is above its tolerance."""
    return counts_in_average(result.columns) & (result.uncertainty.model > scene.numerics.model_tolerance)
