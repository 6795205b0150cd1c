"""The models that have a run in time, by their names in ``numerics.model``. A further one is added to `RUNS`."""

from collections.abc import Callable
from dataclasses import dataclass

from ..errors import InputError
from ..models import AUTO, Model, model_named, models_that_may_answer
from ..models.deterministic import State
from ..models.load_sharing import why_moment_unknown
from ..models.shared import Prepared
from ..samples import Sample
from ..scene import Scene
from ..surface import Surface
from .estimated import RunEstimate, estimated_deterministic, estimated_load_sharing
from .load_sharing_solver import ContactStep
from .model import Start
from .start import check_load_sharing, start_load_sharing
from .transient_deterministic import check_deterministic, start_deterministic


@dataclass(frozen=True, kw_only=True)
class RunModel:
    """How a model runs in time.

    Attributes
    ----------
    model : the model that is solved
    start : makes a scene ready, and returns the `TimeModel` with its state at t = 0
    check : raises `InputError` for a scene that the run does not take, and solves nothing
    estimate_work : steps and processor time of a run, with its sample and the `Sample.stated_map`
    described : what computes the run of a scene, and which model-form error its interval has, as text
    model_in_words : the name of the model, as text
    solves_rough_film : whether its film is that between rough surfaces, whose smallest may be a gap that is assumed
    continues_patch : whether a patch that is shorter than the contact is continued by its mirror image
    state_class : the class of what a step hands to the next beside its unknowns, which is saved after every step
    """

    model: Model
    start: Callable[[Scene | Prepared], Start]
    check: Callable[[Scene], None]
    estimate_work: Callable[[Scene, Sample, Surface], RunEstimate]
    described: Callable[[Scene], str]
    model_in_words: str
    solves_rough_film: bool
    continues_patch: bool
    state_class: type


def _load_sharing_in_words(scene: Scene) -> str:
    which = "load-sharing model at all times"
    if scene.numerics.model == "quick":
        which += " (numerics.model = 'quick' is for steady points and has no run in time)"
    if why := why_moment_unknown(scene):
        return f"{which}; its model-form error is not known and not in the interval: {why}"
    return f"{which}; the interval has the model-form error of steady motion"


LOAD_SHARING = RunModel(
    model=model_named("paper"),
    start=start_load_sharing,
    check=check_load_sharing,
    estimate_work=estimated_load_sharing,
    described=_load_sharing_in_words,
    model_in_words="load-sharing model",
    solves_rough_film=False,
    continues_patch=False,
    state_class=ContactStep,
)
DETERMINISTIC_RUN = RunModel(
    model=model_named("deterministic"),
    start=start_deterministic,
    check=check_deterministic,
    estimate_work=estimated_deterministic,
    described=lambda _: "deterministic model at all times (numerics.model); the interval has no model-form error",
    model_in_words="deterministic model",
    solves_rough_film=True,
    continues_patch=True,
    state_class=State,
)
RUNS = {"paper": LOAD_SHARING, "quick": LOAD_SHARING, "deterministic": DETERMINISTIC_RUN}


def run_model_of(scene: Scene) -> RunModel:
    """Return how the model of ``scene`` runs in time; for "auto" the cheapest that does. `InputError` if it has no
    run."""
    name = scene.numerics.model
    for model in models_that_may_answer(name):
        if model.name in RUNS:
            return RUNS[model.name]
    raise InputError(
        f" = {name!r}: this model has no run in time", "numerics.model", ", ".join(map(repr, [AUTO, *RUNS]))
    )


def models_that_may_be_solved(scene: Scene) -> tuple[Model, ...]:
    """Return the models of which one answers for ``scene``, the cheapest first: at one point those that its
    ``numerics.model`` allows, in a run in time the one that is solved."""
    if scene.transient is not None:
        return (run_model_of(scene).model,)
    return models_that_may_answer(scene.numerics.model)


def may_move_roughness(scene: Scene) -> bool:
    """Return whether a model that may answer for ``scene`` includes that its roughness moves
    (`Model.includes_motion`)."""
    return any(model.includes_motion for model in models_that_may_be_solved(scene))


def check_run(scene: Scene) -> None:
    """Raise `InputError` for a ``scene`` with a ``transient`` that its model refuses. Nothing is solved."""
    run_model_of(scene).check(scene)


def estimated_run(scene: Scene, sample: Sample, surface: Surface) -> RunEstimate:
    """Return the estimate of the run of ``scene``; ``sample`` and ``surface`` as `lubfric.prepare` makes them."""
    return run_model_of(scene).estimate_work(scene, sample, surface)
