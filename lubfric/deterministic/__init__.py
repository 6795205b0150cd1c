"""One gap and one pressure: the film between rough surfaces in its own gap (docs/deterministic.md)."""

from .domain import lay_out, reach
from .faces import couette_flow
from .inlet import Inlet, inlet
from .linear import gmres
from .point import LEAST, deterministic_point, grids, layer
from .problem import Problem
from .refine import Refined, estimate, solve_refined
from .result import DeterministicResult
from .reynolds import first_film
from .solve import Start, solve_point
from .start import RUPTURE, dry_contact
from .transfer import state_on
