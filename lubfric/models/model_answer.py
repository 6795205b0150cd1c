"""What a model says of one operating point: its `ModelAnswer`, with the `ContactFields` of one solve.

`lubfric.estimate` builds the `FrictionResult` from it. A model fills what it knows: the defaults say that it knows no
more.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from ..errors import Report
from ..film import EHLResult
from ..scene import Scene
from .shared import REDUCED_BY_TOLERANCE, Decision, ModelErrorPart, StandardError, Violation, error_of_parts


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
    shear : isothermal shear stress [Pa], where f includes the heat within the contact; NaN where the solve has none
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
class AnswerErrors:
    """The relative errors of f by their source, and those of the other numbers of a point.

    Attributes
    ----------
    numerical : of f by solver and grids, an estimate that the interval takes as a bound at 95 %
    sampling_error : standard error of f because the sample is finite; an error that is NaN is not known
    model_error : of f by the model itself, at 95 %, towards 0 and away from it; NaN: not known
    by_limit : part of ``model_error``, at 95 %, because the limiting stress of a Newtonian lubricant is not known
    parts_of_model : what the model-form error consists of, each with its cause; (): not known
    of_numbers : of the numbers, by name: the standard error of the sample together with the numerical error, which is
        that of the number where it is known, else ``numerical``; without the model-form error, but for that of the
        division of the load by Eq. (8)
    why_not_known, reasons : why an error is not known: of those not in ``of_numbers`` whose number is neither NaN nor
        0, and of some by name
    notes : remarks on these errors
    largest_film_load_ratio : largest part of the load that the film may carry beside asperities, 1: any part
    area_needed : area that the sampling error needs, over that of the sample (`lubfric.estimate.Uncertainty`)
    """

    numerical: float
    sampling_error: StandardError
    model_error: tuple[float, float]
    by_limit: float = 0.0
    parts_of_model: tuple[ModelErrorPart, ...] = ()
    of_numbers: dict[str, float] = field(default_factory=dict)
    why_not_known: str = "not known"
    reasons: dict[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    largest_film_load_ratio: float = 1.0
    area_needed: float = 1.0

    @property
    def of_model_alone(self) -> float:
        """Relative error of f by the model at 95 %, the larger of both sides, without what an unknown input adds."""
        alone = [part for part in self.parts_of_model if not part.is_of_input]
        return error_of_parts(alone) if alone else max(self.model_error)


@dataclass(frozen=True, kw_only=True)
class ModelAnswer:
    """What a model says of one operating point on its sample: numbers, their errors, warnings, fields.

    Attributes
    ----------
    numbers : quantities of a point by name (`lubfric.quantities`), among them ``coefficient``, ``speed`` and, where f_b
        has a range, ``contact_load``; others that are omitted are NaN
    errors : of f and of the other numbers
    accepts_model_error : whether the scene accepts it, because it names this model: then no warning reports it
    narrows_numerical : what narrows ``numerical`` where it is within the tolerance, as text
    narrows_sampling : what narrows the sampling error, as text; "": as of the sample
    rolling_ratios : the smallest and the largest that the rolling part of f may be, over its value; they bound the
        interval. Below 0: the part may have the other sign
    not_given : relative changes of f at both ends of the range of an input that the scene does not give, by its key
        (section.key, one of `lubfric.scene.inputs_not_given`); no part of the model-form error
    length, effective_contacts : of the sample (`lubfric.estimate.Uncertainty`)
    report, decision : of the solve; what was modelled
    violations : limits of the model that are exceeded
    recommendation : what reduces the numerical error where it exceeds the tolerance
    fields : of the solve; None if there are none
    fine_fields : solves a part of the surface again on cells fine enough to look at; None: ``fields`` are all there is
    details : what the model keeps of its solve, for those who know it
    at_inputs : makes what solves f again at other inputs; None: the model cannot
    change_without_solve : returns the relative change of f at an end of the range of an input, from its name, the
        number of the end (0 or 1) and the scene there, if the solution shows it; None: it has to be solved
    """

    numbers: dict[str, float]
    errors: AnswerErrors
    report: Report
    decision: Decision
    accepts_model_error: bool = False
    narrows_numerical: str = REDUCED_BY_TOLERANCE
    narrows_sampling: str = ""
    rolling_ratios: tuple[float, float] = (0.0, 2.0)
    not_given: dict[str, tuple[float, float]] = field(default_factory=dict)
    length: float = math.nan
    effective_contacts: float = math.nan
    violations: tuple[Violation, ...] = ()
    recommendation: str = "set a smaller numerics.tolerance"
    fields: ContactFields | None = None
    fine_fields: Callable[[], ContactFields] | None = None
    details: ModelDetails | None = None
    at_inputs: Callable[[], AtInputs] | None = None
    change_without_solve: Callable[[str, int, Scene], float | None] = lambda name, number, end: None
