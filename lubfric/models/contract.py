"""The contract of a model: all that you need to know to write one.

A `Model` solves the first strips of a sample at one speed. Its `SampleSolution` says how many strips the tolerances
need and whether their cells are too coarse; `lubfric.estimate` solves more until both are enough, corrects it, and builds
the `FrictionResult` from its `ModelAnswer`. What else a model knows of its strips, it may hand to a more expensive one as
`ControlVariate`. `name` and `solve` of a model and the `answer` of its solution are all that has to be written; the
other members say what a model costs, where it applies and whether it is good enough, and have defaults. The three
models of lubfric, and one of 30 lines in tests/test_contracts.py, do no more than this.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from ..errors import Report
from ..film import EHLResult
from ..samples import Sample
from ..scene import Scene
from ..surface import Surface
from .shared import (
    REDUCED_BY_TOLERANCE,
    ControlVariate,
    Decision,
    ExpectedViolations,
    Heat,
    ModelErrorPart,
    Prepared,
    StandardError,
    Violation,
    error_of_parts,
    strips_for_error,
)

# The value of ``numerics.model`` that takes the cheapest model that is good enough.
AUTO = "auto"

# Whether asperities touch under an expected film, in words (`WorkEstimate.asperities`).
ALL_TOUCH = "touching"
FEW_TOUCH = "none or a few summits"
NONE_TOUCHES = "none"


@dataclass(frozen=True, kw_only=True)
class ContactFields:
    """The fields of one solve, all on the same cells (nx, ny), x along the motion; NaN: the solve has none.

    Attributes
    ----------
    solve : which solve they are of, as text
    x, y : cells [m], (nx,) around the line of contact, and (ny,)
    heights : of the roughness of both bodies about their mean [m], out of them
    pressure : of the asperity contacts [Pa]; of film and contact together by the deterministic model
    gap : between the rough surfaces [m]
    deflection : of both bodies by the pressure [m], up to a constant; of a deterministic solve with its dents
    film : thickness of the smooth film [m], constant along y; by the deterministic model that of the rough gap
    shear : shear stress [Pa]; NaN where the solve has none
    half_width : of the Hertz strip of the total load [m]; NaN without one
    pressure_includes_film : whether ``pressure`` is of film and contact together, in their rough gap
    """

    solve: str
    x: np.ndarray
    y: np.ndarray
    heights: np.ndarray
    pressure: np.ndarray
    gap: np.ndarray
    deflection: np.ndarray
    film: np.ndarray
    shear: np.ndarray
    half_width: float = math.nan
    pressure_includes_film: bool = False

    def __post_init__(self) -> None:
        shape = (self.x.size, self.y.size)
        for name in ("heights", "pressure", "gap", "deflection", "film", "shear"):
            if getattr(self, name).shape != shape:
                raise ValueError(f"{name} {getattr(self, name).shape} is not on the cells {shape} of the other fields")

    @property
    def pressure_label(self) -> str:
        """What ``pressure`` is, as text."""
        return "film and contact pressure" if self.pressure_includes_film else "contact pressure"

    @property
    def spacing(self) -> tuple[float, float]:
        """(dx, dy) [m] of the cells; of a single row or column the other length."""
        steps = [float(axis[1] - axis[0]) if axis.size > 1 else math.nan for axis in (self.x, self.y)]
        known = [step for step in steps if math.isfinite(step)] or [math.nan]
        return (steps[0] if math.isfinite(steps[0]) else known[0], steps[1] if math.isfinite(steps[1]) else known[0])


class ModelDetails:
    """What a model keeps of its solve, for those who know it: a frozen dataclass, which a store of results can hold.

    ``kind``: what it is, for those who look for it among the details of a result.
    """

    kind: ClassVar[str] = ""

    @property
    def smooth_film(self) -> EHLResult | None:
        """The film of smooth surfaces, on its own nodes; None: the model solved none."""
        return None


@dataclass(frozen=True, kw_only=True)
class AtInputs:
    """f of a point at other inputs, from where it is solved.

    ``middle``: f at its own inputs, as the others are compared with it; ``coefficient``: f of a scene that differs in
    inputs only, which raises `ConvergenceError`; ``may_run_in_processes``: whether it may be sent to other processes.
    """

    middle: float
    coefficient: Callable[[Scene], float]
    may_run_in_processes: bool = False


@dataclass(frozen=True, kw_only=True)
class ModelAnswer:
    """What a model says of one operating point on its sample: numbers, their errors, warnings, fields.

    Attributes
    ----------
    numbers : quantities of a point by name (`lubfric.quantities`), among them ``coefficient``, ``speed`` and, where f_b
        has a range, ``contact_load``; others that are omitted are NaN
    numerical : relative error of f by solver and grids, an estimate that the interval takes as a bound at 95 %
    sampling_error : relative standard error of f because the sample is finite; an error that is NaN is not known
    model_error : relative error of f by the model itself, at 95 %, towards 0 and away from it; NaN: not known
    by_limit : part of ``model_error``, at 95 %, because the limiting stress of a Newtonian lubricant is not known
    parts_of_model : what the model-form error consists of, each with its cause; (): not known
    accepts_model_error : whether the scene accepts it, because it names this model: then no warning reports it
    narrows_numerical : what narrows ``numerical``, as text
    most_rolling_ratio : the largest that the rolling part of f may be, over its value; it bounds the interval
    not_given : relative changes of f at both ends of the range of an input that the scene does not give, by its key
        (section.key, one of `lubfric.scene.inputs_not_given`); no part of ``model_error``
    errors : relative errors of the numbers, by name: of the sample the standard error, with ``numerical`` or what it is of
        that number; the model-form error is not included
    why_no_error, reasons : why an error is not known: of those not in ``errors`` whose number is neither NaN nor 0, and of
        some by name
    length, effective_contacts, area_needed : of the sample (`lubfric.estimate.Uncertainty`)
    notes : remarks on these errors
    report, decision : of the solve; what was modelled
    violations : limits of the model that are exceeded
    recommendation : what to do where the numerical error exceeds the tolerance
    fields : of the solve; None if there are none
    fine_fields : solves a part of the surface again on cells fine enough to look at; None: ``fields`` are all there is
    details : what the model keeps of its solve, for those who know it
    at_inputs : makes what solves f again at other inputs; None: the model cannot
    change_without_solve : returns the relative change of f at an end of the range of an input, from its name, the number
        of the end (0 or 1) and the scene there, if the solution shows it; None: it has to be solved
    """

    numbers: dict[str, float]
    numerical: float
    sampling_error: StandardError
    model_error: tuple[float, float]
    report: Report
    decision: Decision
    by_limit: float = 0.0
    parts_of_model: tuple[ModelErrorPart, ...] = ()
    accepts_model_error: bool = False
    narrows_numerical: str = REDUCED_BY_TOLERANCE
    most_rolling_ratio: float = 2.0
    not_given: dict[str, tuple[float, float]] = field(default_factory=dict)
    errors: dict[str, float] = field(default_factory=dict)
    why_no_error: str = "not known"
    reasons: dict[str, str] = field(default_factory=dict)
    length: float = math.nan
    effective_contacts: float = math.nan
    area_needed: float = 1.0
    notes: tuple[str, ...] = ()
    violations: tuple[Violation, ...] = ()
    recommendation: str = "a larger numerics.tolerance"
    fields: ContactFields | None = None
    fine_fields: Callable[[], ContactFields] | None = None
    details: ModelDetails | None = None
    at_inputs: Callable[[], AtInputs] | None = None
    change_without_solve: Callable[[str, int, Scene], float | None] = lambda name, number, end: None

    @property
    def error_of_model_alone(self) -> float:
        """Relative error of f by the model at 95 %, the larger of both sides, without what an unknown input adds."""
        alone = [part for part in self.parts_of_model if not part.is_of_input]
        return error_of_parts(alone) if alone else max(self.model_error)


@dataclass(frozen=True, kw_only=True)
class SharedWork:
    """Work that points have in common, and that the first of them does.

    Attributes
    ----------
    what : its name: work of one name is done once
    seconds : processor time [s]
    is_of_surface_alone : whether it serves other speeds, lubricants and tolerances on the same surface as well (as in
        `lubfric.models.shared.memo.Key`); else all points of one scene
    """

    what: str
    seconds: float
    is_of_surface_alone: bool


@dataclass(frozen=True, kw_only=True)
class WorkEstimate:
    """What a model will take at one operating point, from closed forms and to an order of magnitude.

    Attributes
    ----------
    strips : number of strips that the tolerances need; 0: the model is not asked
    seconds : processor time [s] of all of it, beyond that of the cheaper models
    has_answer : whether the model is expected to have an answer of its own (`Model.why_unable`)
    waits_for_next : whether "auto" spends them only where the next model is not solved (`SampleSolution.may_suffice`)
    shared : the parts of these seconds that other points are spared
    fine_fields_seconds : processor time [s] of fields on cells fine enough to look at, if they are requested
    strip_seconds : processor time [s] of one strip, where its roughness moves; 0 where it does not, or has little
        effect
    longest_strip_seconds : the same if that strip has to be solved again on shorter cells
    length : of the strips [m]; NaN: there is one patch
    expected_sampling_error : relative standard error of f after the first strips; NaN: there is one patch
    expected_model_error : relative model-form error of f
    asperities : whether asperities touch: `ALL_TOUCH`, `FEW_TOUCH` or `NONE_TOUCHES`
    """

    strips: int
    seconds: float
    has_answer: bool = True
    waits_for_next: bool = False
    shared: tuple[SharedWork, ...] = ()
    fine_fields_seconds: float = 0.0
    strip_seconds: float = 0.0
    longest_strip_seconds: float = 0.0
    length: float = math.nan
    expected_sampling_error: float = math.nan
    expected_model_error: float = math.nan
    asperities: str = ""


class SampleSolution(ABC):
    """What a model has solved of the first ``count`` strips of a sample. A model whose strips are of its own, as "quick",
    solves them in `completed`.

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
        """Return all that the model says of this point. What `completed` would solve for it is solved here, if it is not yet."""

    def required_strips(self) -> int:
        """Return the number of strips that the tolerances need: `count` if these are enough.

        By default they are those that `ModelAnswer.sampling_error` needs, of the `answer` before `completed`. A model whose
        `answer` takes work or needs `completed`, or that decides by another error, says it here.
        """
        tolerance = self.prepared.scene.numerics.sampling_tolerance
        return strips_for_error(
            self.answer().sampling_error,
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

        `lubfric.estimate.choice` calls it: once there are enough strips, whether of `Model.solve` or adopted from another
        model (`Model.adopt`), and before it asks for the answer, which needs no solve then.
        """
        return self

    def may_suffice(self) -> bool:
        """Return whether it may suffice once it is completed (`why_sufficient`), as far as is known before."""
        return True

    def control(self) -> ControlVariate | None:
        """Return what is known of the strips for a more expensive model; None if nothing is."""
        return None

    def why_sufficient(self) -> str:
        """Return why numerics.model = "auto" needs no more expensive model, as text; "" if it does.

        It is `completed` before where it `may_suffice`. No strip is solved. It may make the `answer`, and a smooth film with it.
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
        """Solve the first ``count`` strips of the line at ``speed`` [m/s], of which a model may solve as many as its own error
        asks for.

        ``sample``: that of ``prepared``, on the cells that are requested, for a model that takes them
        (`takes_cells_of_sample`); ``start``: the solution of fewer of the same strips; ``control``: what a cheaper model knows of them. Raises
        `ConvergenceError`.
        """

    def check(self, scene: Scene, *, has_one_map_for_all_bodies: bool) -> None:
        """Raise `InputError` for a ``scene`` that names this model and has keys it does not take. Nothing is solved.

        ``has_one_map_for_all_bodies``: whether one map was given to `lubfric.prepare` for all bodies.
        """

    def described(self, scene: Scene) -> str:
        """Return what the model is, and how wide its interval, as text for a ``scene`` that names it."""
        return f"{self.name} model (numerics.model)"

    def described_in_auto(self, scene: Scene, where: str, *, is_everywhere: bool) -> str:
        """Return how the model takes part ``where`` numerics.model = "auto" is expected to take it, and what answers at
        other speeds unless it ``is_everywhere``, as text. ``where``: speeds in words."""
        return f"{self.name} model {where}"

    def limit_of_work_in_auto(self) -> str:
        """Return the work of a point above which numerics.model = "auto" leaves it to a cheaper model, as text; "": none."""
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
        """Return the number of strips that this model solves before its error says how many it needs: those on which a line is
        solved first, or one where it solves each strip by itself."""
        return sample.first_strips

    def estimate_work(
        self, scene: Scene, sample: Sample, surface: Surface, speed: float, cheaper: WorkEstimate | None
    ) -> WorkEstimate:
        """Return what a point at ``speed`` [m/s] will take, without a solve.

        ``surface``: the `Sample.stated_map`; ``cheaper``: what the next cheaper model will take; None: there is none. A
        model that says nothing about its work takes the first strips in no time.
        """
        return WorkEstimate(strips=self.strips_to_begin_with(sample), seconds=0.0)

    def why_unable(self, prepared: Prepared, speed: float) -> str:
        """Return why the model has no answer at ``speed`` [m/s], as text; "" if it has one."""
        return ""

    def methods(self, prepared: Prepared, *, has_contact: bool, has_film: bool) -> tuple[str, ...]:
        """Return the names of the methods of this model that have a paper behind them (estimate/papers.toml).

        ``has_contact``, ``has_film``: whether asperities, or a film, carry load. What surface, lubricant and heat rest on is
        added for every model.
        """
        return ()

    def rolling_error(self, lambda_ratio: float) -> float:
        """Return the relative model-form error of the rolling resistance, at 95 %; NaN: not known."""
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
