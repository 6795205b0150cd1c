"""The differential-deflection method: film and pressure coupled through second differences of the film.

`mesh` (uniform, with its convolutions), `equations`, `newton`, `result`; `solve`: the steady film;
`transient`: in time.
"""

from .solve import solve_differential_deflection
from .transient import solve_differential_transient

__all__ = ["solve_differential_deflection", "solve_differential_transient"]
