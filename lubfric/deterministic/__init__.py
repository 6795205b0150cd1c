"""The deterministic model: the film of a rough line contact with one gap and one pressure, solved as a whole.

`lay_out` puts a height map under a cylinder; `solve_point` solves it.
"""

from .domain import lay_out
from .problem import Problem
from .result import DeterministicResult
from .solve import solve_point

__all__ = ["DeterministicResult", "Problem", "lay_out", "solve_point"]
