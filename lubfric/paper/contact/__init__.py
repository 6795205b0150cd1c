"""The contact under an imposed film: `single_loop` (the paper's Appendix 2), `alternating` (end of its Sec. 2.2)."""

from .alternating import alternating
from .single_loop import single_loop

__all__ = ["alternating", "single_loop"]
