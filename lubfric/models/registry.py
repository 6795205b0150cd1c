"""The models that ``numerics.model`` names. A further one is added to `MODELS`, and its name to keys.toml.

Whoever needs the models asks the functions here, so that `MODELS` is the one place that lists them.
"""

from ..errors import InputError
from ..scene import Scene
from .contract import AUTO, Model
from .deterministic import DeterministicModel
from .load_sharing import PaperModel
from .quick import QuickModel

# The cheapest first: "auto" asks them in this order.
MODELS: tuple[Model, ...] = (PaperModel(), QuickModel(), DeterministicModel())


def model_named(name: str) -> Model:
    """Return the model of this ``name``; `InputError` if there is none."""
    for model in MODELS:
        if model.name == name:
            return model
    names = ", ".join(repr(model.name) for model in MODELS)
    raise InputError(f" = {name!r} names no model", "numerics.model", names)


def title_of(name: str) -> str:
    """Return what pictures and texts call the model of this ``name`` (`Model.title`); of a name that `MODELS` does not
    have, the name with "model"."""
    return next((model.title for model in MODELS if model.name == name), f"{name} model")


def title_to_quote(name: str) -> str:
    """Return the title of the model of this ``name`` with what it is, for a publication (`Model.summary`)."""
    summary = next((model.summary for model in MODELS if model.name == name), "")
    return f"{title_of(name)} ({summary})" if summary else title_of(name)


def models_up_to(name: str) -> tuple[Model, ...]:
    """Return the model of this ``name`` and the cheaper ones, the cheapest first; all of them for `AUTO`."""
    if name == AUTO:
        return MODELS
    return MODELS[: MODELS.index(model_named(name)) + 1]


def models_cheaper_than(model: Model) -> tuple[Model, ...]:
    """Return the models that are cheaper than ``model``, the cheapest first: by its name, or, where no model of
    `MODELS` has it, the cheapest alone."""
    names = [each.name for each in MODELS]
    return MODELS[: names.index(model.name)] if model.name in names else MODELS[:1]


def models_that_may_answer(name: str) -> tuple[Model, ...]:
    """Return the models whose answer the value ``name`` of ``numerics.model`` may give, the cheapest first."""
    return MODELS if name == AUTO else (model_named(name),)


def check_by_model(scene: Scene, *, has_one_map_for_all_bodies: bool) -> None:
    """Raise `InputError` for a ``scene`` that the model it names refuses (`Model.check`)."""
    if scene.numerics.model != AUTO:
        model_named(scene.numerics.model).check(scene, has_one_map_for_all_bodies=has_one_map_for_all_bodies)
