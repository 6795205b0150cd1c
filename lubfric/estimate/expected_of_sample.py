"""What the finite surface is expected to do to the interval of f, before anything is solved."""

import math
from collections.abc import Iterator, Sequence

from ..models import ALL_TOUCH, NONE_TOUCHES
from ..models.shared import (
    FREEDOM_NOT_COUNTED,
    SAMPLING_ERROR,
    Assumption,
    ExpectedViolations,
    Violation,
    area_needed,
    expected_without_interval,
    half_width_of_error,
    why_map_too_small,
)
from ..samples import Sample, way_to_longer_line
from ..scene import Scene
from .work_of_point import PointWorkEstimate

# Expected sampling error over its target from which on it is stated before the solve [-]. A choice: the closed form is
# known to about a factor of three (0.75 to 3.1 times that of five solved contacts), so that a smaller one may be within
# the target.
LIKELY_ABOVE = 3.0


def expected_of_sample(scene: Scene, sample: Sample, points: Sequence[PointWorkEstimate]) -> ExpectedViolations:
    """Return the limits that ``sample`` is expected to exceed at the ``points``, with their speeds: it is too short for
    an interval of f, or all of it leaves a sampling error above its target."""
    touching = [point for point in points if point.speed != 0 and point.asperities != NONE_TOUCHES]
    expected: list[tuple[float | None, Violation]] = []
    for point in touching:
        short = tuple(expected_without_interval(scene, sample, includes_motion=point.model.includes_motion))
        expected += [(point.speed, violation) for violation in short]
        if not short and point.asperities == ALL_TOUCH:
            expected += [(point.speed, violation) for violation in _violations_by_error(scene, sample, point)]
    return tuple(expected)


def _violations_by_error(scene: Scene, sample: Sample, point: PointWorkEstimate) -> Iterator[Violation]:
    """Yield the violation by the sampling error that is expected at ``point`` if all strips of ``sample`` are
    solved."""
    target = scene.numerics.sampling_tolerance
    error = point.error * math.sqrt(min(sample.first_strips / sample.available_strips, 1.0))
    if not error > LIKELY_ABOVE * target:
        return
    too_small = why_map_too_small(target, area_needed(error, target, has_ended=True))
    stated, limit = (100 * half_width_of_error(each, FREEDOM_NOT_COUNTED) for each in (error, target))
    yield Violation(
        assumption=Assumption.LARGE_ENOUGH_MAP,
        what=f"expected {SAMPLING_ERROR}",
        value=stated,
        limit=limit,
        unit="%",
        consequence=f"{too_small}, estimated with closed forms (error within a factor of 3); the interval of f includes the error",
        recommendation=f"give {way_to_longer_line(scene, sample.whole_map)}, or use f with its interval",
        effect=0.01 * stated,
    )
