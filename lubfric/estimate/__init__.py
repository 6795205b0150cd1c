"""The answer at one speed: the sample of the surface, the models, the interval of f.

`sample` solves strips of the surface until the standard error is within what is asked; `cells` corrects for their
coarse cells; `scatter` reads the standard error off one solved contact; `errors_of` and `uncertainty` make the
interval. `friction` is the entry; `answer` and `answer_deterministic` are the two models.
"""

from .friction import friction
from .full_load import full_load_numbers
from .outlook import forecast
from .power import power_of_forces
from .result import FrictionResult, together
from .uncertainty import (
    Uncertainty,
    UncertaintyCurve,
    curve_of,
)
