"""Friction over speed: `stribeck` and its `StribeckResult`."""

from .points import QUANTITIES
from .result import StribeckResult
from .solve import AUTO, stribeck

__all__ = ["AUTO", "QUANTITIES", "StribeckResult", "stribeck"]
