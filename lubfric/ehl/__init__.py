"""Smooth elastohydrodynamic line contact."""

from .result import EHLResult
from .solve import solve_ehl

__all__ = ["EHLResult", "solve_ehl"]
