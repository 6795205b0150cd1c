"""Load sharing, Eq. (8) of the paper: film and contact carry one load.

`point` solves film and contact, each at its share of the load; `balance` finds the division at which they agree;
`forces` gives the friction; `response` shows how strongly all that depends on an error of the gap; `limits` are the
assumptions of the model that a balance violates.
"""

from .balance import Balance, solve_balance
from .balanced_sample import BalancedSample
from .calibrated import CalibratedFriction, calibrated_friction
from .control_variate import control_for
from .decision import decided
from .error_model import ErrorModel, error_models, features, least_half_width, rms_slopes, widening
from .errors_of import moment_model_error
from .forces import Forces, forces
from .limits import limits_exceeded
from .load_sharing_model import LoadSharingModel, LoadSharingSolution
from .model_error import least_error, load_sharing_error, starved_error
from .paper_model import PaperModel, PaperSolution
from .point import Point
from .response import Response, Slopes, loads_at, quantities, touched_length, with_contact_area_scaled
from .rough_film import RoughFilm, RoughMap, flattened, rough_film
from .scatter import Scatter, effective_spots, moment_error
from .undetected import summit_radius, undetected_load
