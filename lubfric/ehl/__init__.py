"""Elastohydrodynamic line contact: the film carries the load.

`solve` has the steady film, `solve_ehl`. It is made of `problem` (the equations in Moes' units), `grid` and `kernel`,
`reynolds` (the discrete equations), `newton`, `start`, `imposed` (a further pressure that deflects the film),
`assemble` and `result`. `transient` is the film in time, on a fixed grid.
"""

from .result import EHLResult
from .solve import solve_ehl

__all__ = ["EHLResult", "solve_ehl"]
