"""Curves and maps other than Stribeck's: traction over the slide-roll ratio, friction over two keys."""

from .traction import TractionResult, traction

__all__ = ["TractionResult", "traction"]
