"""Load sharing, Eq. (8) of the paper: film and contact carry one load.

- The balance: `point` solves film and contact, each at its share of the load; `balance` finds the division at which the
  `closure`, Eq. (8), holds; `balanced_sample` solves it on the first strips of a sample; `cell_effect` corrects it for
  their cells, `scatter` and `undetected` give its sampling error, and `response` shows how strongly all that depends on
  an error of the gap.
- `paper_model`, ``"paper"``: `forces` gives the friction by Eq. (9), `error_of_eq8` its error, `limits` the assumptions
  that a balance violates; `answer` and `errors_of` make the answer.
- `differences_of_strips` hands what is known of the strips to the deterministic model; `estimated_work` estimates the
  cost.
"""

from .balance import Balance, is_separated, solve_balance
from .closure import film_under, gap_per_film, gap_under, volume_residual, with_gap_of_closure
from .error_of_eq8 import (
    OF_SHARE,
    STATIONARY_ROLLING_RATIOS,
    error_of_share,
    largest_film_load_ratio,
    least_error,
    load_sharing_error,
    load_sharing_error_parts,
    rolling_ratios_of,
    starved_error,
)
from .errors_of import moment_model_error, why_moment_unknown
from .estimated_work import expected_gap, expected_model_error, flattening
from .methods import methods_of_load_sharing
from .paper_model import PaperModel, PaperSolution
from .point import Point
from .response import MomentResponse, Response, Slopes, slopes_of
from .scatter import effective_contacts, moment_error
from .undetected import load_of_tail, summit_radius, undetected_load
