"""The models of a mixed-lubricated contact, under one contract.

`contract` says what a model is: it solves strips of a sample at one speed. `registry` names the models there are:
``"paper"``, film and contact that share one load, with the friction of Eq. (9) (`load_sharing.paper_model`);
``"quick"``, the quick model: strips on long cells with a calibrated error (`quick.quick_model`); and
``"deterministic"``, the film between the rough surfaces in its own gap (`deterministic.deterministic_model`). `shared`
is what they have in common: the scene made ready, heat, limits of validity, statistics. `prepare` makes a scene ready.
"""

from .contract import AUTO, Model, SampleSolution
from .deterministic import DeterministicModel, DeterministicResult
from .load_sharing import Balance, PaperModel
from .model_answer import AnswerErrors, ContactFields, ModelAnswer, ModelDetails
from .prepare import prepare, prepare_on_maps, prepare_on_sample, prepared_with, with_boundary_friction_at
from .quick import QuickModel
from .registry import (
    MODELS,
    model_named,
    models_cheaper_than,
    models_that_may_answer,
    models_up_to,
    title_of,
    title_to_quote,
)
from .work_estimate import ALL_TOUCH, FEW_TOUCH, NONE_TOUCHES, MeasuredTime, SharedWork, WorkEstimate, time_at
