"""The rough contact under an imposed film, solved in two ways.

`single_loop` is the method of the paper's Appendix 2. `alternating` is the method at the end of its Sec. 2.2.
"""

from .alternating import alternating
from .single_loop import single_loop

__all__ = ["alternating", "single_loop"]
