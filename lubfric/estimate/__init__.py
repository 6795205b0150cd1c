"""The answer at one speed: how many strips, on which cells, by which model, and the uncertainty of f.

`sampled` asks a model for more strips and shorter cells until the tolerances are met; `friction` chooses the model;
`answer` builds the one `FrictionResult` from what the model answers; `uncertainty` makes the interval, `ranges` adds the
inputs. Nothing here knows how a model solves: the contract is `lubfric.models.contract`.
"""

from .friction import LEAST_WORK, TIMES_ESTIMATE, friction
from .full_load import full_load_numbers
from .methods import MethodUse, methods_of
from .outlook import Forecast, forecast
from .power import power_of_forces
from .result import FrictionResult, cited, together
from .sampled import sampled
from .uncertainty import Uncertainty, UncertaintyCurve, curve_of
