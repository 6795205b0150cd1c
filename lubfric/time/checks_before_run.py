"""Checks of a run in time before it is solved: those of its model at each moment."""

from ..models.shared import Violation, violations_by_inlet_of_moment, violations_by_motion
from ..scene import Scene, sampled_times
from .registry import run_model_of
from .scene_in_time import fastest_of_run, scene_at

# Part of the largest speed of a run below which a speed is that of a standstill, where no film is entrained: a moment
# of reversal has any slide-roll ratio. A choice, as `SMALLEST_SPEED` of the estimate.
LEAST_ENTRAINING_PART = 1e-3


def expected_violations_of_run(scene: Scene) -> list[tuple[float | None, Violation]]:
    """Return the limits of the model that a run of ``scene`` will exceed, each with its moment [s], by closed forms:
    those of steady motion with the values of each of its `sampled_times`."""
    model = run_model_of(scene).model
    least = LEAST_ENTRAINING_PART * fastest_of_run(scene)
    expected: list[tuple[float | None, Violation]] = []
    for time in sampled_times(scene):
        now = scene_at(scene, time)
        speed = now.motion.entrainment_speed
        of_moment = [violation for _, violation in model.expected_violations(now, [abs(speed)])]
        if abs(speed) > least:
            film = now.line_contact(abs(speed)).expected_film
            known = {violation.assumption for violation in of_moment}
            more = (*violations_by_motion(now, speed, film), *violations_by_inlet_of_moment(now, speed))
            of_moment += [violation for violation in more if violation.assumption not in known]
        expected += [(time, violation) for violation in of_moment]
    return expected
