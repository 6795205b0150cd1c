"""How long a line has to be."""

from __future__ import annotations

import math

PILOT = 180.0  # correlation lengths along y of the first line
LONGEST = 1900.0  # of one line
PAIR = 42.0  # of a piece on the scene's own cells
GROWTH = 4.0  # times the length so far: a standard error from few blocks is no guide further
SAFETY = 1.15
MOST = 256 * PILOT  # of all lines together
MOST_CELLS = 1_500_000  # of one line: memory


def next_length(so_far: float, reached: float, asked: float, longest: float) -> float:
    """The length that is still missing for the standard error ``asked``.

    The total needed is (reached/asked)² x 1.15 of the present length. The new part is at least a quarter of the present
    length, and at most three times that or ``longest``.
    """
    wanted = so_far * (SAFETY * (reached / asked) ** 2 - 1.0) if math.isfinite(reached) else GROWTH * so_far
    return min(max(wanted, 0.25 * so_far), (GROWTH - 1.0) * so_far, longest)
