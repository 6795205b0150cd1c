"""Friction over speed: `stribeck` and its `StribeckResult`."""

from .result import QUANTITIES, StribeckResult
from .solve import AUTO, stribeck

__all__ = ["AUTO", "QUANTITIES", "StribeckResult", "stribeck"]
