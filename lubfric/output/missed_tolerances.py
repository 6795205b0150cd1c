"""Which points of a curve or of a study miss a tolerance of their scene, and by how much."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from .._base import FloatArray
from ..estimate import uncertainty_of_row
from ..models.shared import (
    NEAR_ZERO,
    SAMPLING_ERROR,
    Assumption,
    half_width_of_error,
    is_by_sliding,
    is_near_zero,
    percent_beside,
    sentence,
    standard_error_in_words,
)
from ..quantities import counted
from ..scene import Numerics, Scene

# Why an error above its tolerance is no warning.
WHY_A_NOTE = "the error is usual for the model, or the scene names the model"


@dataclass(frozen=True, kw_only=True)
class MissedTolerance:
    """A tolerance that some points of a table miss.

    Attributes
    ----------
    error : what is above it, as text
    tolerance : the key that sets it, as text
    points : numbers of the rows of the table, from 0
    worst : the row that is farthest above
    value, limit : the error there and its limit, relative to f, at 95 %
    assumption : on this error, an `Assumption`
    notes : at how many of the points it is a note, because it is usual for the model or accepted with it
    uncounted : number of rows where the error is above its limit and does not count relative to f, as f is near 0 or
        that of rolling resistance; warnings and notes state it there
    """

    error: str
    tolerance: str
    points: tuple[int, ...]
    worst: int
    value: float
    limit: float
    assumption: str = ""
    notes: int = 0
    uncounted: int = 0

    def in_words(self, total: int, place: Callable[[int], str]) -> str:
        """Return the miss in a sentence; ``total``: number of solved points; ``place``: gives where a row lies, as "at
        point 3"."""
        return f"{self._of_counted(total, place)}{f' {self._of_uncounted()}' if self.uncounted else ''}"

    def _of_counted(self, total: int, place: Callable[[int], str]) -> str:
        value, limit = percent_beside(self.value, self.limit)
        if total == 1:
            return f"The {self.error} is {value}, above {limit} ({self.tolerance})."
        if len(self.points) == 1:
            return (
                f"{sentence(place(self.worst)).removesuffix('.')} the {self.error} is {value}, above {limit} "
                f"({self.tolerance})."
            )
        where = "This" if self.notes == len(self.points) else f"At {self.notes} of these it"
        notes = f" {where} is a note, because {WHY_A_NOTE}." if self.notes else ""
        return (
            f"At {len(self.points)} of {total} points the {self.error} is above its tolerance, farthest "
            f"{place(self.worst)}: {value}, above {limit} ({self.tolerance}).{notes}"
        )

    def _of_uncounted(self) -> str:
        more = counted(self.uncounted, "more points")
        return f"Warnings and notes state it at {more}, where f is below {NEAR_ZERO:g} or that of rolling resistance."


def missed_tolerances(
    columns: Mapping[str, np.ndarray], scenes: Sequence[Scene], usual: FloatArray | float = math.nan
) -> Iterator[MissedTolerance]:
    """Yield the tolerances that points miss, by the ``columns`` of their errors, (n,), and the scene of each point,
    (n,); ``usual``: model-form errors that do not count, (n,), NaN where they do.

    The sampling error counts where the notes of its points state it (`Uncertainty.misses_sampling_tolerance`), at 95 %,
    as its tolerance then does, which is a standard error. The model-form error counts without that by an unknown
    limiting stress, of any model. Where f is near 0, or that of rolling resistance, no other relative error counts.
    """
    f = _column(columns, "coefficient", len(scenes))
    slides = is_by_sliding({"coefficient": f, **columns})
    for checked in _checked_errors(columns, [scene.numerics for scene in scenes]):
        error = checked.error
        counts = checked.counts
        is_above = error > checked.limit
        uncounted = 0
        if counts is None:
            is_relative = np.array([not is_near_zero(*pair) for pair in zip(f.tolist(), error.tolist())], dtype=bool)
            counts = is_above & is_relative & slides
        if checked.assumption == Assumption.MODEL_FORM_ERROR:
            uncounted = int((is_above & ~counts).sum())
            counts = counts & np.isnan(usual)
        points = np.flatnonzero(counts)
        if not points.size:
            continue
        worst = int(points[np.argmax(error[points] / checked.limit[points])])
        yield MissedTolerance(
            error=checked.name,
            tolerance=checked.tolerance_of(worst),
            assumption=checked.assumption,
            points=tuple(points.tolist()),
            worst=worst,
            uncounted=uncounted,
            value=float(error[worst]),
            limit=float(checked.limit[worst]),
        )


@dataclass(frozen=True, kw_only=True)
class _CheckedError:
    """An error of f at some points, relative, at 95 %, and its limit, (n,) each.

    ``tolerance_of`` gives what sets the limit of a row, as text; ``counts``: where the error is above its limit and
    counts; None: where it is so as a relative error of f.
    """

    name: str
    assumption: str
    error: FloatArray
    limit: FloatArray
    tolerance_of: Callable[[int], str]
    counts: np.ndarray | None = None


def _checked_errors(columns: Mapping[str, np.ndarray], numerics: Sequence[Numerics]) -> Iterator[_CheckedError]:
    """Yield the numerical, the sampling and the model-form error of points with these ``numerics``."""
    count = len(numerics)
    yield _CheckedError(
        name="numerical error of f",
        assumption=Assumption.NUMERICAL_ERROR,
        error=_column(columns, "numerical_error", count),
        limit=np.array([each.tolerance for each in numerics]),
        tolerance_of=lambda row: "numerics.tolerance",
    )
    freedom = _column(columns, "sampling_freedom", count).tolist()
    at_95 = np.array([half_width_of_error(1.0, number) for number in freedom])
    of_sample = np.array([each.sampling_tolerance for each in numerics])
    requested = {**columns, "sampling_tolerance": of_sample}
    uncertainties = [uncertainty_of_row(requested, row) for row in range(count)]
    yield _CheckedError(
        name=SAMPLING_ERROR,
        assumption=Assumption.SAMPLING_ERROR,
        error=at_95 * _column(columns, "sampling_error", count),
        limit=at_95 * of_sample,
        tolerance_of=lambda row: standard_error_in_words(float(of_sample[row])).removesuffix(","),
        counts=np.array([each.misses_sampling_tolerance for each in uncertainties], dtype=bool),
    )
    by_limit = np.nan_to_num(_column(columns, "limit_error", count))
    of_model = np.square(_column(columns, "model_error", count)) - np.square(by_limit)
    yield _CheckedError(
        name="model-form error of f",
        assumption=Assumption.MODEL_FORM_ERROR,
        error=np.sqrt(np.maximum(of_model, 0.0)),
        limit=np.array([each.model_tolerance for each in numerics]),
        tolerance_of=lambda row: "numerics.model_tolerance",
    )


def _column(columns: Mapping[str, np.ndarray], name: str, count: int) -> FloatArray:
    """Return a column of ``count`` numbers; NaN where there is none of this ``name``."""
    return np.asarray(columns.get(name, np.full(count, np.nan)), dtype=float)
