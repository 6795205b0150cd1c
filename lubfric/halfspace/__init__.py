"""Elastic deflection of a half-space under pressure on a uniform grid of cells.

`half_space` builds the operator for any pair of periodic and free axes; `line_coefficients` is the
plane-strain limit; `reciprocity_error` checks any of them.
"""

from .kernels import line_coefficients, love_coefficients, semiperiodic_coefficients
from .operator import HalfSpace, half_space
from .reciprocity import reciprocity_error

__all__ = [
    "HalfSpace",
    "half_space",
    "line_coefficients",
    "love_coefficients",
    "reciprocity_error",
    "semiperiodic_coefficients",
]
