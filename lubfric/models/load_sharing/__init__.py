"""Load sharing, Eq. (8) of the paper: film and contact carry one load.

`point` solves film and contact, each at its share of the load; `balance` finds the division at which they agree;
`forces` gives the friction; `response` tells how strongly all that depends on an error of the gap; `limits` are the
assumptions of the model that a balance violates.
"""

from .balance import Balance, solve_balance
from .forces import Forces, forces
from .limits import limits_exceeded
from .point import Point, exponents
from .response import Response, Slopes, loads_at, quantities, touched_length, with_contact_area_scaled
from .rough_film import LIMIT_RANGE, RoughFilm, RoughMap, rough_film
