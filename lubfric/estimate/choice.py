"""Which model answers at one speed, and why: the cheapest that is good enough."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, replace

from .._base import limited_work, work_left
from ..errors import ConvergenceError, WorkLimitError
from ..models import AUTO, Model, SampleSolution, models_up_to
from ..models.shared import Prepared
from .solve_to_tolerance import solve_to_tolerance

# Counted work [s] that the cheapest model may take under "auto", however small numerics.max_work is: its answer is what
# a point ends with. As much is left to the answer, and to the ends of input ranges, after a more expensive model was tried
# in vain.
LEAST_WORK_OF_CHEAPEST = 10.0


@dataclass(frozen=True, kw_only=True)
class Choice:
    """The solution that answers, and how it was chosen.

    Attributes
    ----------
    model, solution : the model that answers, and its solution
    why : the reason for this model, as text; "" where it was requested, or is the most expensive
    compared : the cheapest model on the same strips, and its solution, where it was solved beside the answer
    gave_up : whether a more expensive model was tried in vain, so that the work of the point may be spent
    """

    model: Model
    solution: SampleSolution
    why: str = ""
    compared: tuple[Model, SampleSolution] | None = None
    gave_up: bool = False


def choose(prepared: Prepared, speed: float, requested: str | Model, *, for_fields: bool = False) -> Choice:
    """Solve ``prepared`` at ``speed`` [m/s] by the ``requested`` model, or by the cheapest that is good enough.

    Where the requested model has no answer (`Model.why_unable`), the most expensive of the cheaper ones that has one
    answers in its place, and `Choice.why` says so. ``for_fields``: on the cells on which a sample shows its fields
    (`Sample.for_fields`). Raises `ConvergenceError`.
    """
    if isinstance(requested, Model):
        return Choice(model=requested, solution=solve_to_tolerance(prepared, speed, requested, for_fields=for_fields))
    up_to_requested = models_up_to(requested)
    able = [model for model in up_to_requested if not model.why_unable(prepared, speed)]
    if requested == AUTO:
        return _completed(_cheapest(prepared, speed, able, for_fields=for_fields))
    *cheaper, model = able
    why = ""
    if model is not up_to_requested[-1]:
        why = f"the {model.name} model in place of the {requested} model: {up_to_requested[-1].why_unable(prepared, speed)}"
    if not cheaper or not model.takes_control(prepared.scene, prepared.sample):
        return Choice(model=model, solution=solve_to_tolerance(prepared, speed, model, for_fields=for_fields), why=why)
    compared = (cheaper[0], solve_to_tolerance(prepared, speed, cheaper[0], for_fields=for_fields))
    control = compared[1].control()
    solution = solve_to_tolerance(prepared, speed, model, for_fields=for_fields, control=control)
    return Choice(model=model, solution=solution, why=why, compared=None if control is None else compared)


def work_for_an_answer() -> float:
    """Return the counted work [s] that is left to the answer that a point ends with."""
    return max(work_left(), LEAST_WORK_OF_CHEAPEST)


def _cheapest(prepared: Prepared, speed: float, models: list[Model], *, for_fields: bool) -> Choice:
    """Return the solution of the cheapest of ``models`` that is good enough.

    From the cheapest on, a solution answers if it suffices (`SampleSolution.why_sufficient`), if f means nothing anyway
    (a severe warning), or if the next model declines (`Model.why_declined`) or does not converge. The strips of the first
    are the control of those that take one.
    """
    with limited_work(work_for_an_answer()):
        first = solve_to_tolerance(prepared, speed, models[0], for_fields=for_fields)
    control = first.control()
    choice = Choice(model=models[0], solution=first)
    for model in models[1:]:
        if choice.solution.may_suffice():
            choice = replace(choice, solution=choice.solution.completed())
        solution = choice.solution
        why = solution.why_sufficient()
        if why or any(violation.severe for violation in solution.violations()):
            return Choice(model=choice.model, solution=solution, why=why)
        if why := model.why_declined(prepared, speed, solution):
            return Choice(model=choice.model, solution=solution, why=why)
        if (adopted := model.adopt(solution)) is not None:
            choice = Choice(model=model, solution=adopted)
            continue
        try:
            solution = solve_to_tolerance(prepared, speed, model, for_fields=for_fields, control=control)
        except ConvergenceError as error:
            return replace(choice, why=f"the {model.name} model was not solved ({error})", gave_up=True)
        choice = Choice(model=model, solution=solution, compared=None if control is None else (models[0], first))
    return choice


def _completed(choice: Choice) -> Choice:
    """Return ``choice`` with its solution completed; after a more expensive model was tried in vain, within what is left of
    the work, or within `LEAST_WORK_OF_CHEAPEST`."""
    if not choice.gave_up:
        return replace(choice, solution=choice.solution.completed())
    with suppress(WorkLimitError), limited_work(work_for_an_answer()):
        return replace(choice, solution=choice.solution.completed())
    return choice
