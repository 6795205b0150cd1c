"""The answer at one speed: the sample of the surface, the models, the interval of f.

`sample` solves strips of the surface until the standard error is within what is asked; `cells` corrects for their
coarse cells; `scatter` reads the standard error off one solved contact; `errors_of` and `uncertainty` make the
interval. `friction` is the entry; `answer` and `answer_deterministic` are the two models.
"""

from .friction import friction
from .full_load import full_load_numbers
from .heated import strip_heat
from .moving import MOST_WORK, maps_of
from .outlook import forecast
from .pair import numbers_of, strip_of
from .power import power_of_forces
from .result import FrictionResult, together
from .sample import sampled
from .scatter import block_error, moment_error
from .uncertainty import Uncertainty, UncertaintyCurve, curve_of, load_sharing_error, percent, student
