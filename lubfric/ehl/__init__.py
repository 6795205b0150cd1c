"""Elastohydrodynamic line contact: the film carries the load.

The steady film, `solve_ehl`: `problem` (its units), `grid` and `kernel`, `reynolds` (the equations), `newton`,
`start`, `imposed` (another pressure on the same line), `assemble` and `result`; `solve` puts them together.
`transient`: the film in time, on a fixed grid.
"""

from .result import EHLResult
from .solve import solve_ehl

__all__ = ["EHLResult", "solve_ehl"]
