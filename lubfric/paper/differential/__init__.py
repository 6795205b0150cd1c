"""The differential-deflection method: film and pressure are coupled through second differences of the film.

The modules are `mesh` (a uniform grid with its convolutions), `equations` (the method and its sources), `newton`,
`result`, `solve` (the steady film) and `transient` (the film in time).

All residuals of the report are relative, and must be <= tolerance. The last four are <= 1e-3 of it where Newton's
method converged. ``evaluations`` counts banded solves, each with one convolution.

- discretisation: the largest change of min_film, central_film and flow_film against the grid of half the cells, or a
  quarter of the change before that
- domain: the estimated effect of the finite inlet on flow_film (0 with inlet_length)
- mass: the largest |flux through a face before rupture/q - 1|
- load: |∫ p dx/load - 1|
- film: the largest |h - full integral|/h
- complementarity: the largest of -p/p_max, and of 1 - flux/q behind rupture
"""

from .solve import solve_differential_deflection
from .transient import solve_differential_transient

__all__ = ["solve_differential_deflection", "solve_differential_transient"]
