"""The answer at one speed: by which model, on how many strips and which cells, and the uncertainty of f.

The way of a point, in the order of the modules:

1. `friction` checks the call, limits the work and hands the point on.
2. `choice` finds the model that answers, and why: it asks the models of `lubfric.models.MODELS`, the cheapest first.
3. `solve_to_tolerance` asks one model for more strips and shorter cells until the tolerances are met.
4. `build_result` builds the one `FrictionResult` (`result`) from what the model answers (`ModelAnswer`):
   `uncertainty_of_f` makes the interval, to which `ranges` adds what the ranges of the inputs change, `power`,
   `full_load` and `methods` give power, lambda ratio and papers.

`work_of_point` estimates beforehand what a point will take. Nothing here knows how a model solves: the contract is
`lubfric.models.contract`, and a test holds that no module imports a model at run time.
"""

from .build_result import beside_larger_part
from .expected_of_sample import expected_of_sample
from .friction import friction, most_work_of_estimate
from .full_load import full_load_numbers
from .inputs_to_quote import (
    dry_contact_to_quote,
    grid_to_quote,
    inputs_to_quote,
    lubricated_contact_to_quote,
    roughness_to_quote,
    span_to_quote,
    varied_to_quote,
)
from .length_ranges import QuickFriction, scenes_at_ends
from .methods import MethodUse, methods_of
from .power import power_of_forces
from .ranges import with_input_ranges
from .result import FrictionResult, cite_together, cited, shared_inputs
from .solve_to_tolerance import solve_to_tolerance
from .uncertainty import (
    PARTS,
    UNCERTAINTY_COLUMNS,
    Uncertainty,
    UncertaintyCurve,
    curve_of,
    interval,
    row_of_uncertainty,
    uncertainty_of_row,
)
from .uncertainty_of_f import CUT_AT_LIMIT, CUT_AT_ZERO, NAME_OF_INTERVAL, uncertainty_of
from .work_of_point import (
    NOT_MEASURED,
    PointWorkEstimate,
    WorkOfPoints,
    estimated_work_of_point,
    expected_violations,
    seconds_of_points,
)
