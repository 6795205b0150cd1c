"""An estimate of what a point will take: the estimates of all models that would be solved (`Model.estimate_work`).
Nothing is solved."""

import math
from collections.abc import Collection, Container, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from ..models import (
    AUTO,
    MeasuredTime,
    Model,
    SharedWork,
    WorkEstimate,
    models_that_may_answer,
    models_up_to,
    time_at,
)
from ..models.shared import (
    ExpectedViolations,
    Violation,
    expected_typical_heat,
    violations_by_inlet_of_moment,
    violations_by_typical_heat,
)
from ..samples import Sample
from ..scene import Scene
from ..surface import Surface
from .length_ranges import MODEL_OF_ENDS, solves_of_lengths

# What is known where no time of strips is measured. By definition.
NOT_MEASURED: Mapping[str, Sequence[MeasuredTime]] = MappingProxyType({})


@dataclass(frozen=True, kw_only=True)
class PointWorkEstimate:
    """What a point will take, to an order of magnitude.

    Attributes
    ----------
    speed : of entrainment [m/s]
    model : that is expected to answer
    asperities : whether asperities touch under the expected film of the total load (`WorkEstimate.asperities`)
    error : relative standard error of f after the first strips of the cheapest model
    strips : number of strips that ``numerics.sampling_tolerance`` needs, by the last model that has a line of its own
    length : of these strips [m]
    slow_strips : number of strips by the model of slow strips (`lubfric.models.Model.has_slow_strips`); 0: it is
        not asked
    seconds : processor time [s]
    shared : the parts of it that other points are spared
    fine_fields_seconds : processor time [s] of fields on fine cells, if they are requested
    slow_strip_seconds : processor time [s] of one strip by that model if its roughness moves; 0 where it does not, or
        has little effect
    longest_strip_seconds : the same if that strip has to be solved again on shorter cells
    """

    speed: float
    model: Model
    asperities: str
    error: float
    strips: int
    length: float
    slow_strips: int
    seconds: float
    shared: tuple[SharedWork, ...] = ()
    fine_fields_seconds: float = 0.0
    slow_strip_seconds: float = 0.0
    longest_strip_seconds: float = 0.0


class WorkOfPoints:
    """Estimates of the points of ``scene`` on ``sample``, each made once; ``surface``: its `Sample.stated_map`."""

    def __init__(self, scene: Scene, sample: Sample, surface: Surface):
        self.scene = scene
        self.sample = sample
        self.surface = surface
        self._of_models: dict[float, list[WorkEstimate]] = {}

    def at(self, speed: float, measured: Mapping[str, Sequence[MeasuredTime]] = NOT_MEASURED) -> PointWorkEstimate:
        """Return what a point at ``speed`` [m/s] will take; ``measured``: by the name of a model what its first steps,
        at some speeds, say of the time of its strips."""
        if speed not in self._of_models:
            expected: list[WorkEstimate] = []
            for model in models_up_to(AUTO):
                before = expected[-1] if expected else None
                expected.append(model.estimate_work(self.scene, self.sample, self.surface, speed, before))
            self._of_models[speed] = expected
        estimates = [
            expected.as_measured(time_at(measured[model.name], speed)) if model.name in measured else expected
            for model, expected in zip(models_up_to(AUTO), self._of_models[speed])
        ]
        return _estimate_of_point(self.scene, self.sample, speed, estimates)


def estimated_work_of_point(
    scene: Scene,
    sample: Sample,
    surface: Surface,
    speed: float,
    measured: Mapping[str, Sequence[MeasuredTime]] = NOT_MEASURED,
) -> PointWorkEstimate:
    """Return what a point of ``scene`` at ``speed`` [m/s] will take on ``sample``; other arguments as of
    `WorkOfPoints`."""
    return WorkOfPoints(scene, sample, surface).at(speed, measured)


def _estimate_of_point(scene: Scene, sample: Sample, speed: float, estimates: list[WorkEstimate]) -> PointWorkEstimate:
    """Return what a point at ``speed`` [m/s] will take, by the ``estimates`` of all models, the cheapest first."""
    models = models_up_to(AUTO)
    cheapest = estimates[0]
    last = len(models_up_to(scene.numerics.model)) - 1
    # AUTO tries one after the other until one is good enough
    enough = [k for k in range(last) if estimates[k].expected_model_error <= scene.numerics.model_tolerance]
    # a model that has no answer leaves its place to the most expensive of the cheaper ones that has one (`choose`)
    answering = max((k for k in range(last + 1) if estimates[k].has_answer), default=0)
    solved: Collection[int] = {0, answering} if models[answering].takes_control(scene, sample) else {answering}
    if scene.numerics.model == AUTO:
        last = min(enough, default=last)
        solved = [k for k in range(last + 1) if k == last or not _is_left_unsolved(estimates, k)]
    with_line = [k for k in solved if estimates[k].strips and math.isfinite(estimates[k].length)]
    line = estimates[max(with_line, default=0)]
    answering = max((k for k in solved if estimates[k].has_answer), default=0)
    with_slow_strips = [k for k, model in enumerate(models) if model.has_slow_strips]
    of_lengths = _seconds_of_lengths(scene, estimates, answering)
    return PointWorkEstimate(
        speed=speed,
        model=models[answering],
        asperities=cheapest.asperities,
        error=cheapest.expected_sampling_error,
        strips=line.strips,
        length=line.length,
        slow_strips=max((estimates[k].strips for k in with_slow_strips if k in solved), default=0),
        seconds=sum(estimates[k].seconds for k in solved) + estimates[answering].ends_seconds + of_lengths,
        fine_fields_seconds=estimates[answering].fine_fields_seconds,
        shared=tuple(part for k in solved for part in estimates[k].shared),
        slow_strip_seconds=max((estimates[k].strip_seconds for k in with_slow_strips), default=0.0),
        longest_strip_seconds=max((estimates[k].longest_strip_seconds for k in with_slow_strips), default=0.0),
    )


def expected_violations(
    scene: Scene, sample: Sample, surface: Surface, speeds: list[float], work: WorkOfPoints | None = None
) -> ExpectedViolations:
    """Return the limits that will be exceeded at ``speeds`` [m/s] (`Model.expected_violations`).

    They are those of the cheapest model that may answer, with whose solution "auto" begins, and at each speed those
    that the model that is expected to answer has in addition, a starved inlet, and the heat
    of the film that a scene omits. ``sample`` and ``surface``: as of
    `estimated_work_of_point`; ``work``: the estimates that are known.
    """
    first = models_that_may_answer(scene.numerics.model)[0]
    expected = first.expected_violations(scene, speeds)
    points = work or WorkOfPoints(scene, sample, surface)
    speeds_of: dict[str, tuple[Model, list[float]]] = {}
    for speed in speeds:
        model = points.at(speed).model
        speeds_of.setdefault(model.name, (model, []))[1].append(speed)
    known = {violation.assumption for _, violation in expected}
    more: list[tuple[float | None, Violation]] = []
    for name, (model, its_speeds) in speeds_of.items():
        if name != first.name:
            more += [pair for pair in model.expected_violations(scene, its_speeds) if pair[1].assumption not in known]
    starved = ((speed, each) for speed in speeds for each in violations_by_inlet_of_moment(scene, speed))
    heated = (
        (speed, each)
        for speed in speeds
        for each in violations_by_typical_heat(
            scene, expected_typical_heat(scene, surface.sq, speed), "it is estimated with closed forms"
        )
    )
    return (*expected, *more, *starved, *heated)


def _seconds_of_lengths(scene: Scene, estimates: Sequence[WorkEstimate], answering: int) -> float:
    """Return the processor time [s] of the ranges of correlation lengths, which the quick model solves, or load sharing
    in its place; ``answering``: the number of the model that answers, which has solved the value itself if it is the
    quick one."""
    ends = solves_of_lengths(scene)
    if not ends:
        return 0.0
    (quick,) = (k for k, model in enumerate(models_up_to(AUTO)) if model.name == MODEL_OF_ENDS)
    one = estimates[quick].seconds or estimates[0].seconds
    return one * (ends + (answering != quick))


def _is_left_unsolved(estimates: Sequence[WorkEstimate], k: int) -> bool:
    """Return whether "auto" leaves model number ``k`` unsolved, because the next one is solved in its place."""
    return estimates[k].waits_for_next and estimates[k + 1].has_answer


def seconds_of_points(
    points: Sequence[PointWorkEstimate], count: float | None = None, done: Container[str] = ()
) -> float:
    """Return the processor time [s] of ``points`` of one scene, or of so many (``count``) like them, where the shared
    work named in ``done`` was done before."""
    if not points:
        return 0.0
    shared: dict[str, float] = {}
    for point in points:
        for part in point.shared:
            if part.what not in done:
                shared[part.what] = max(part.seconds, shared.get(part.what, 0.0))
    each = sum(point.seconds - sum(part.seconds for part in point.shared) for point in points)
    return sum(shared.values()) + each * (1.0 if count is None else count / len(points))
