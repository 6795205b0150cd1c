"""The models that ``numerics.model`` names. A further one is added to `MODELS`, and its name to scene/keys.toml."""

from .contract import Model
from .deterministic import DeterministicModel
from .load_sharing import LoadSharingModel, PaperModel

# The cheapest first: "auto" asks them in this order.
MODELS: tuple[Model, ...] = (PaperModel(), LoadSharingModel(), DeterministicModel())

# The value of ``numerics.model`` that takes the cheapest model that is good enough.
AUTO = "auto"


def model_named(name: str) -> Model:
    """Return the model of this ``name``."""
    return next(model for model in MODELS if model.name == name)


def models_up_to(name: str) -> tuple[Model, ...]:
    """Return the model of this ``name`` and the cheaper ones, the cheapest first; all of them for `AUTO`."""
    if name == AUTO:
        return MODELS
    names = [model.name for model in MODELS]
    return MODELS[: names.index(name) + 1]
