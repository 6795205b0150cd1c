"""The contract of a model: all that you need to know to write one.

A `Model` solves the first strips of a sample at one speed. Its `SampleSolution` says how many strips the tolerances
need and whether their cells are too coarse; `lubfric.estimate` solves more until both are enough, corrects it, and
builds the `FrictionResult` from its `ModelAnswer`. What else a model knows of its strips, it may hand to a more
expensive one as `ControlVariate`. `name` and `solve` of a model and the `answer` of its solution are all that has to be
written; the other members say what a model costs, where it applies and whether it is good enough, and have defaults.
The three models of lubfric, and one of 30 lines in tests/test_contracts.py, do no more than this.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod

from ..samples import Sample
from ..scene import Scene
from ..surface import Surface
from .model_answer import ModelAnswer
from .shared import ControlVariate, ExpectedViolations, Heat, Prepared, Violation, strips_for_error
from .work_estimate import MeasuredTime, WorkEstimate

# The value of ``numerics.model`` that takes the cheapest model that is good enough.
AUTO = "auto"


class SampleSolution(ABC):
    """What a model has solved of the first ``count`` strips of a sample. A model whose strips are of its own, as
    "quick", solves them in `completed`.

    `lubfric.estimate` requests more strips or shorter cells until there are enough, then `corrected` and `completed`,
    and at last the `answer`.

    Attributes
    ----------
    prepared, sample, count, speed : what `Model.solve` was called with, at an entrainment speed [m/s]
    """

    prepared: Prepared
    sample: Sample
    count: int
    speed: float

    @abstractmethod
    def answer(self) -> ModelAnswer:
        """Return all that the model says of this point. What `completed` would solve for it is solved here, if it is
        not yet."""

    def required_strips(self) -> int:
        """Return the number of strips that the tolerances need: `count` if these are enough.

        By default they are those that `AnswerErrors.sampling_error` needs, of the `answer` before `completed`. A model
        whose `answer` takes work or needs `completed`, or that decides by another error, says it here.
        """
        tolerance = self.prepared.scene.numerics.sampling_tolerance
        return strips_for_error(
            self.answer().errors.sampling_error,
            tolerance,
            count=self.count,
            first=self.sample.first_strips,
            available=self.sample.available_strips,
        )

    def is_too_coarse(self) -> bool:
        """Return whether the cells of the sample have to be shorter; never called on native ones."""
        return False

    def takes_more_strips_first(self) -> bool:
        """Return whether more strips on these cells are cheaper than shorter cells."""
        return False

    def corrected(self) -> SampleSolution:
        """Return this solution as native cells would change it, if the model knows. It may take further solves."""
        return self

    def completed(self) -> SampleSolution:
        """Solve what the answer needs and `Model.solve` left out; itself where that is nothing, as of its own result.

        `lubfric.estimate.choice` calls it: once there are enough strips, whether of `Model.solve` or adopted from
        another model (`Model.adopt`), and before it asks for the answer, which needs no solve then.
        """
        return self

    def may_suffice(self) -> bool:
        """Return whether it may suffice once it is completed (`why_sufficient`), as far as is known before."""
        return True

    def control(self) -> ControlVariate | None:
        """Return what is known of the strips for a more expensive model; None if nothing is."""
        return None

    def why_sufficient(self) -> str:
        """Return as text why numerics.model = "auto" needs no more expensive model; "" where it needs one.

        The solution is `completed` first where it `may_suffice`. No strip is solved, but the `answer`, with its smooth
        film, may be made.
        """
        return ""

    def heat(self) -> Heat | None:
        """Return the heat of inlet, film and surfaces; None if the model knows none."""
        return None

    def violations(self) -> tuple[Violation, ...]:
        """Return the limits of the model that are exceeded, without the rest of the answer."""
        return ()


class Model(ABC):
    """A way to compute the friction of strips of a rough surface at one speed."""

    @property
    @abstractmethod
    def name(self) -> str:
        """The name in ``numerics.model``."""

    @property
    def title(self) -> str:
        """What pictures and texts call the model."""
        return f"{self.name} model"

    @property
    def summary(self) -> str:
        """What the model is, as text for a publication; "": the sources that it cites say it."""
        return ""

    @abstractmethod
    def solve(
        self,
        prepared: Prepared,
        sample: Sample,
        count: int,
        speed: float,
        *,
        start: SampleSolution | None = None,
        control: ControlVariate | None = None,
    ) -> SampleSolution:
        """Solve the first ``count`` strips of the line at ``speed`` [m/s]. A model may solve as few of them as its own
        error needs.

        ``sample``: that of ``prepared``, on the cells that are requested, for a model that takes them
        (`takes_cells_of_sample`); ``start``: the solution of fewer of the same strips; ``control``: what a cheaper
        model knows of them. Raises `ConvergenceError`.
        """

    def check(self, scene: Scene, *, has_one_map_for_all_bodies: bool) -> None:
        """Raise `InputError` for a ``scene`` that names this model and has keys it does not take. Nothing is solved.

        ``has_one_map_for_all_bodies``: whether one map was given to `lubfric.prepare` for all bodies.
        """

    def described(self, scene: Scene) -> str:
        """Return what the model is, and how wide its interval, as text for a ``scene`` that names it."""
        return f"{self.title} (numerics.model)"

    def described_in_auto(self, scene: Scene, where: str, *, is_everywhere: bool) -> str:
        """Return how the model takes part ``where`` numerics.model = "auto" is expected to take it, and what answers at
        other speeds unless it ``is_everywhere``, as text. ``where``: speeds in words."""
        return f"{self.title} {where}"

    @property
    def most_strip_work_in_auto(self) -> float:
        """Counted work [s] of the first strip above which numerics.model = "auto" leaves a point to a cheaper model,
        once the first steps of the solve forecast it; infinite: none."""
        return math.inf

    def limit_of_work_in_auto(self) -> str:
        """Return the work of a point above which numerics.model = "auto" leaves it to a cheaper model, as text; "":
        none."""
        return ""

    def expected_violations(self, scene: Scene, speeds: list[float]) -> ExpectedViolations:
        """Return the limits of the model that will be exceeded at ``speeds`` [m/s], by closed forms before the solve,
        each with its speed (None: at all speeds)."""
        return ()

    @property
    def includes_motion(self) -> bool:
        """Whether f includes, by itself or by a calibration, that roughness moves through the contact."""
        return False

    @property
    def takes_boundary_film(self) -> bool:
        """Whether f depends on ``bodies.boundary_film``, by itself or by a calibration; else its interval alone does."""
        return False

    @property
    def has_slow_strips(self) -> bool:
        """Whether one strip of moving roughness takes so much time that this is estimated, and shown, by itself."""
        return False

    @property
    def takes_wear(self) -> bool:
        """Whether a scene that names it may wear: the asperity pressure of wear is that of the load-sharing model."""
        return False

    @property
    def takes_cells_of_sample(self) -> bool:
        """Whether `solve` takes the cells of its ``sample``, which are halved while they are too long
        (`SampleSolution.is_too_coarse`); False: it lays out the strips of ``prepared.sample`` on cells of its own."""
        return True

    def strips_to_begin_with(self, sample: Sample) -> int:
        """Return the number of strips that this model solves before its error says how many it needs: those on which a
        line is solved first, or one where it solves each strip by itself."""
        return sample.first_strips

    def estimate_work(
        self, scene: Scene, sample: Sample, surface: Surface, speed: float, cheaper: WorkEstimate | None
    ) -> WorkEstimate:
        """Return what a point at ``speed`` [m/s] will take, without a solve.

        ``surface``: the `Sample.stated_map`; ``cheaper``: what the next cheaper model will take; None: there is none. A
        model that says nothing about its work takes the first strips in no time.
        """
        return WorkEstimate(strips=self.strips_to_begin_with(sample), seconds=0.0)

    def measure_time(self, prepared: Prepared, speed: float) -> MeasuredTime | None:
        """Solve the first steps of a strip of moving roughness at ``speed`` [m/s], and return what they say of
        `estimate_work`; None where nothing is measured."""
        return None

    def why_unable(self, prepared: Prepared, speed: float) -> str:
        """Return why the model has no answer at ``speed`` [m/s], as text; "" if it has one."""
        return ""

    def methods(self, prepared: Prepared, *, has_contact: bool, has_film: bool) -> tuple[str, ...]:
        """Return the names of the methods of this model that have a paper behind them (estimate/papers.toml).

        ``has_contact``, ``has_film``: whether asperities, or a film, carry load. What surface, lubricant and heat rest
        on is added for every model.
        """
        return ()

    def rolling_error(self, lambda_ratio: float, film_growth: float) -> float:
        """Return the relative model-form error of the rolling resistance, at 95 %; NaN: not known. ``film_growth``: the
        largest load that the film may carry by the error of that of the asperities, over the load that it carries."""
        return math.nan

    def takes_control(self, scene: Scene, sample: Sample) -> bool:
        """Return whether a `ControlVariate` of a cheaper model spares strips of the ``sample`` of ``scene``."""
        return False

    def adopt(self, cheaper: SampleSolution) -> SampleSolution | None:
        """Return the solution of this model on what ``cheaper`` has solved; None if it needs a solve of its own."""
        return None

    def why_declined(self, prepared: Prepared, speed: float, cheaper: SampleSolution) -> str:
        """Return why numerics.model = "auto" keeps the ``cheaper`` solution, as text; "" if it takes this model."""
        return ""
