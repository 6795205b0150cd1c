"""Which model answers at one speed, and why: the cheapest that is good enough."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, replace

from .._base import limited_forecast, limited_work, work_left
from ..errors import ConvergenceError, InputError, TooCostlyError, TooManyCellsError, WorkLimitError
from ..models import AUTO, Model, SampleSolution, models_cheaper_than, models_up_to
from ..models.shared import Assumption, Prepared
from .solve_to_tolerance import solve_to_tolerance

# Counted work [s] that the cheapest model may take under "auto", however small numerics.max_work is: its answer is what
# a point ends with. As much is left to the answer, and to the ends of input ranges, after a more expensive model was
# tried in vain. A choice: a smaller value leaves points without an answer.
LEAST_WORK_OF_CHEAPEST = 10.0

# Severe violations of one model only. Another model continues the patch, so that its f may have a meaning.
OF_ONE_MODEL = {Assumption.CONTACT_ON_PATCH}


@dataclass(frozen=True, kw_only=True)
class Choice:
    """The solution that answers, and how it was chosen.

    Attributes
    ----------
    model, solution : the model that answers, and its solution
    why : the reason for this model, as text; "" where it was requested, or is the most expensive
    compared : the cheapest model on the same strips, and its solution, where that is the control of the answer
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
    answers in its place, and `Choice.why` says so; of a model that is not in `MODELS`, the cheapest counts as cheaper.
    A model that is given as such takes no control. ``for_fields``: on the cells on which a sample shows its fields
    (`Sample.on_field_cells`). Raises `ConvergenceError`, and `InputError` where no model has an answer.
    """
    if isinstance(requested, Model):
        if not requested.why_unable(prepared, speed):
            solution = solve_to_tolerance(prepared, speed, requested, for_fields=for_fields)
            return _completed(Choice(model=requested, solution=solution))
        models = (*models_cheaper_than(requested), requested)
    else:
        models = models_up_to(requested)
    reasons = {model.name: model.why_unable(prepared, speed) for model in models}
    able = _able(speed, models, reasons)
    if requested == AUTO:
        choice = _cheapest(prepared, speed, able, for_fields=for_fields)
        why = reasons[models[-1].name]
        if why and choice.model is able[-1] and not choice.why:
            choice = replace(choice, why=f"not the {models[-1].title}: {why}")
        return _completed(choice)
    return _completed(_most_expensive(prepared, speed, able, models[-1], for_fields=for_fields))


def _able(speed: float, models: Sequence[Model], reasons: Mapping[str, str]) -> list[Model]:
    """Return those of ``models`` that have an answer at ``speed`` [m/s]: none of the ``reasons`` against it, by their
    names. `InputError` where none has."""
    able = [model for model in models if not reasons[model.name]]
    if not able:
        why = "; ".join(f"{name}: {reason}" for name, reason in reasons.items())
        raise InputError(
            f" = {speed:g} m/s has no answer by any model ({why})",
            "speed",
            recommendation="give another speed or another model",
        )
    return able


def work_for_an_answer() -> float:
    """Return the counted work [s] that is left to the answer that a point ends with."""
    return max(work_left(), LEAST_WORK_OF_CHEAPEST)


def _most_expensive(prepared: Prepared, speed: float, models: list[Model], named: Model, *, for_fields: bool) -> Choice:
    """Return the solution of the most expensive of ``models``, from the cheapest on: of the ``named`` model, or of the
    one that answers in its place.

    Where it takes the strips of the cheapest as a control, these are solved before.
    """
    model = models[-1]
    why = ""
    if model is not named:
        why = f"the {model.title} in place of the {named.title}: {named.why_unable(prepared, speed)}"
    if model is models[0] or not model.takes_control(prepared.scene, prepared.sample):
        return Choice(model=model, solution=solve_to_tolerance(prepared, speed, model, for_fields=for_fields), why=why)
    first = solve_to_tolerance(prepared, speed, models[0], for_fields=for_fields)
    return replace(_beside(prepared, speed, model, (models[0], first), for_fields=for_fields), why=why)


def _beside(
    prepared: Prepared, speed: float, model: Model, cheapest: tuple[Model, SampleSolution], *, for_fields: bool
) -> Choice:
    """Return the solution of ``model``, with the strips of the ``cheapest`` model and its solution as a control if it
    takes one (`Model.takes_control`)."""
    control = cheapest[1].control() if model.takes_control(prepared.scene, prepared.sample) else None
    solution = solve_to_tolerance(prepared, speed, model, for_fields=for_fields, control=control)
    return Choice(model=model, solution=solution, compared=None if control is None else cheapest)


def _cheapest(prepared: Prepared, speed: float, models: list[Model], *, for_fields: bool) -> Choice:
    """Return the solution of the cheapest of ``models`` that is good enough; they are sorted, the cheapest first.

    Each model in turn is tried after the solution of the one before. That solution answers, and no further model is
    tried,

    - if it suffices (`SampleSolution.why_sufficient`), once it is completed;
    - if it has a severe violation, so that f means nothing by any model (those `OF_ONE_MODEL` excepted);
    - if the next model declines (`Model.why_declined`), does not converge, needs too many cells, or finds by its first
      steps that it takes more than `Model.most_strip_work_in_auto`.

    A model may adopt what the one before has solved (`Model.adopt`). The strips of the first model are the control of
    those that take one.
    """
    with limited_work(work_for_an_answer()):
        first = solve_to_tolerance(prepared, speed, models[0], for_fields=for_fields)
    choice = Choice(model=models[0], solution=first)
    for model in models[1:]:
        if choice.solution.may_suffice():
            choice = _completed(choice)
        severe = {violation.assumption for violation in choice.solution.violations() if violation.severe}
        why = "" if severe & OF_ONE_MODEL else choice.solution.why_sufficient()
        means_nothing = not why and bool(severe - OF_ONE_MODEL)
        if not why and not means_nothing:
            why = model.why_declined(prepared, speed, choice.solution)
        if why or means_nothing:
            return replace(choice, why=why)
        if (adopted := model.adopt(choice.solution)) is not None:
            choice = Choice(model=model, solution=adopted)
            continue
        try:
            with limited_forecast(model.most_strip_work_in_auto):
                choice = _beside(prepared, speed, model, (models[0], first), for_fields=for_fields)
        except TooCostlyError as error:
            return replace(choice, why=f"not the {model.title}: {error}", gave_up=True)
        except (ConvergenceError, TooManyCellsError) as error:
            return replace(choice, why=f"the {model.title} was not solved ({error})", gave_up=True)
    return choice


def _completed(choice: Choice) -> Choice:
    """Return ``choice`` with its solution completed (`SampleSolution.completed`): all that its answer needs is solved.

    After a more expensive model was tried in vain, that may take what is left of the work, or `LEAST_WORK_OF_CHEAPEST`;
    where it is not enough, the solution stays as it is.
    """
    try:
        with limited_work(work_for_an_answer()) if choice.gave_up else nullcontext():
            return replace(choice, solution=choice.solution.completed())
    except WorkLimitError:
        if choice.gave_up:
            return choice
        raise
