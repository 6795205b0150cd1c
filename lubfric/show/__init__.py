"""How results are shown: one line, a small table in notebooks, and drawings on axes."""

from .shown import Shown

__all__ = ["Shown"]
