"""Will the contact reach the ends of its patch? Foretold from closed forms and a row of springs: nothing is solved.

The surface is pressed under Hertz's gap of the whole load as if every cell were a spring of its own. How stiff springs
should stand for a half-space is not known, so three are tried, of a sinusoid as short as ten cells, a third and three
times that: only where all of them put twice the allowed load on the edge columns is the patch refused. Of 195 random
patches that hold their contact none was, of 25 that do not 16 were; the others are found by the solve.
"""

from __future__ import annotations

import numpy as np

from ..analytic import hertz

ALLOWED = 0.01  # of the load on the two edge columns
SURE = 2.0  # times that, by every spring
FILM = 1.2  # film over Sq up to which the surfaces are taken to touch as if dry
REACH = 2.5  # half-widths on either side within which roughness cannot be told from reach
TAIL = 0.5  # Sq: over which a rough contact's pressure falls to 1/e with the gap
CELLS = 10.0  # in the wave of the middle spring
SPRINGS = (1 / 3, 1.0, 3.0)
STEPS = 60  # halvings


def edge_share(heights, spacing, x, line_load: float, radius: float, e_prime: float) -> float:
    """Least share of ``line_load`` w [N/m] on the edge columns by any of the springs; 0 where the patch is long enough
    by its gap alone. heights [m] (nx, ny), x [m] (nx,)."""
    half_width = hertz.line_half_width(line_load, radius, e_prime)
    if heights.shape[0] < 3 or abs(x[0]) > REACH * half_width:
        return 0.0
    gap = hertz.line_gap(x, line_load, radius, e_prime)
    falls = np.exp(-gap / max(TAIL * float(heights.std()), 1e-300))
    if falls[0] + falls[-1] <= ALLOWED * falls.sum():
        return 0.0
    under, mean = gap[:, None] - heights, line_load / (x.size * spacing[0])
    stiffness = e_prime * np.pi / (2 * CELLS * min(spacing))
    return min(_on_springs(under, mean / (factor * stiffness)) for factor in SPRINGS)


def _on_springs(under, mean: float) -> float:
    """Share on the edge columns of springs under a gap [m] pressed in by ``mean`` [m] on average."""
    low, high = float(under.min()), float(under.max()) + mean
    for _ in range(STEPS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if np.maximum(middle - under, 0.0).mean() < mean else (low, middle)
    pressed = np.maximum(high - under, 0.0).sum(axis=1)
    return float((pressed[0] + pressed[-1]) / pressed.sum())
