"""Results for eyes: one line, a small table in notebooks, axes to draw on."""

from .shown import Shown

__all__ = ["Shown"]
