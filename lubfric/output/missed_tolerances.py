"""Which points of a curve or of a study miss a tolerance of their scene, and by how much."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from .._base import FloatArray
from ..models.shared import (
    SAMPLING_ERROR,
    SAMPLING_ERROR_MISSED,
    half_width_of_error,
    is_by_sliding,
    is_near_zero,
    percent_beside,
    sentence,
    standard_error_in_words,
)
from ..scene import Scene


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
    """

    error: str
    tolerance: str
    points: tuple[int, ...]
    worst: int
    value: float
    limit: float

    def in_words(self, total: int, place: Callable[[int], str]) -> str:
        """Return the miss in a sentence; ``total``: number of solved points; ``place``: gives where a row lies, as "at point 3"."""
        value, limit = percent_beside(self.value, self.limit)
        if total == 1:
            return f"The {self.error} is {value}, above {limit} ({self.tolerance})."
        if len(self.points) == 1:
            return f"{sentence(place(self.worst)).removesuffix('.')} the {self.error} is {value}, above {limit} ({self.tolerance})."
        return (
            f"At {len(self.points)} of {total} points the {self.error} is above its tolerance, farthest {place(self.worst)}: {value}, "
            f"above {limit} ({self.tolerance})."
        )


def missed_tolerances(columns: Mapping[str, np.ndarray], scenes: Sequence[Scene]) -> Iterator[MissedTolerance]:
    """Yield the tolerances that points miss, by the ``columns`` of their errors, (n,), and the scene of each point, (n,).

    The sampling error counts at 95 %, as its tolerance then does, which is a standard error. The model-form error counts without
    that by an unknown limiting stress, of any model. Where f is near 0, or that of rolling resistance, no relative error counts.
    """
    unknown = np.full(len(scenes), np.nan)

    def column(name: str) -> FloatArray:
        return np.asarray(columns.get(name, unknown), dtype=float)

    f = column("coefficient")
    slides = is_by_sliding({"coefficient": f, **columns})
    numerics = [scene.numerics for scene in scenes]
    freedom = column("sampling_freedom").tolist()
    at_95 = np.array([half_width_of_error(1.0, number) for number in freedom])
    of_sample = np.array([each.sampling_tolerance for each in numerics])
    of_model = np.square(column("model_error")) - np.square(np.nan_to_num(column("limit_error")))
    errors = {
        "numerical error of f": (column("numerical_error"), np.array([each.tolerance for each in numerics])),
        SAMPLING_ERROR: (at_95 * column("sampling_error"), at_95 * of_sample),
        "model-form error of f": (
            np.sqrt(np.maximum(of_model, 0.0)),
            np.array([each.model_tolerance for each in numerics]),
        ),
    }
    for name, (error, limit) in errors.items():
        factor = SAMPLING_ERROR_MISSED if name == SAMPLING_ERROR else 1.0
        is_relative = np.array([not is_near_zero(*pair) for pair in zip(f.tolist(), error.tolist())], dtype=bool)
        points = np.flatnonzero((error > factor * limit) & is_relative & slides)
        if not points.size:
            continue
        worst = int(points[np.argmax(error[points] / limit[points])])
        keys = {
            "numerical error of f": "numerics.tolerance",
            SAMPLING_ERROR: standard_error_in_words(float(of_sample[worst])),
            "model-form error of f": "numerics.model_tolerance",
        }
        yield MissedTolerance(
            error=name,
            tolerance=keys[name],
            points=tuple(points.tolist()),
            worst=worst,
            value=float(error[worst]),
            limit=float(limit[worst]),
        )
