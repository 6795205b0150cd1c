"""The contract of a model in time: what the march and a run need of it, and nothing else."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ..models.shared import Prepared, Violation
from ..scene import Scene
from .march import Progress, Solver, Step


@dataclass(frozen=True, kw_only=True)
class Output:
    """What a model records at an output time.

    Attributes
    ----------
    numbers : the numbers of the moment by name (`lubfric.quantities.OF_MOMENT`); one that is missing was not computed
    violations : the assumptions that do not hold then
    pressure, film_thickness : of the film over x [Pa], [m], (nx,); means over y where it is solved on rough surfaces
    """

    numbers: dict[str, float]
    violations: tuple[Violation, ...]
    pressure: np.ndarray
    film_thickness: np.ndarray


class TimeModel(Solver, Protocol):
    """A model of a run in time: a `Solver` of its steps that also records them. It is a protocol and no base class,
    because what is a field of one model is a property of another.

    ``prepared`` has the strip of rough surface of the run, ``scene`` what changes in time, ``x`` the nodes of the film
    [m], ``cells`` its grid as text. ``tolerance`` is the largest residual of a solved step, ``time_error`` the largest
    local error of a step unless the scene states one, ``first_step`` [s] the step after a start or a jump, and
    ``stops`` [s] the times at which a step has to end. ``notes`` say what a reader of the result should know, and
    ``model_form_unknown`` why the model-form error of f is not known ("" where it is).
    """

    @property
    def tolerance(self) -> float: ...

    @property
    def prepared(self) -> Prepared: ...

    @property
    def scene(self) -> Scene: ...

    @property
    def x(self) -> np.ndarray: ...

    @property
    def cells(self) -> str: ...

    @property
    def time_error(self) -> float: ...

    @property
    def first_step(self) -> float: ...

    @property
    def stops(self) -> Sequence[float]: ...

    @property
    def notes(self) -> tuple[str, ...]: ...

    @property
    def model_form_unknown(self) -> str: ...

    def record(self, progress: Progress) -> Output:
        """Return the numbers and fields after the last step of ``progress``."""
        ...

    def resumable(self, progress: Progress) -> Progress:
        """Return what a later process needs to continue from ``progress`` to the same bits."""
        ...


@dataclass(frozen=True, kw_only=True)
class Start:
    """A model that is ready to run.

    Attributes
    ----------
    model : the model on its grid
    state : the state at t = 0
    grid_error : relative error of a steady start by the grid; NaN of another start, or where it is not known
    """

    model: TimeModel
    state: Step
    grid_error: float
