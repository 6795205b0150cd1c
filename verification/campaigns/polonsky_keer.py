"""Contact by the plain method of Polonsky and Keer: the yardstick of the field, and a second opinion.

I. A. Polonsky, L. M. Keer, Wear 231 (1999) 206-219, doi:10.1016/S0043-1648(99)00113-1. It is a conjugate gradient on
the cells in contact, restarted whenever a cell enters. Overlapping cells are corrected in a step of their own, and the
pressure is rescaled to the load. The contact is elastic and its load is given. All is in double precision, with no
preconditioner and no nested grids.
"""

import numpy as np

from lubfric.contact import HalfSpace


def polonsky_keer(
    gap0: np.ndarray,
    operator: HalfSpace,
    mean_pressure: float,
    tolerance: float = 1e-6,
    max_iterations: int = 5000,
) -> tuple[np.ndarray, bool]:
    """Return (pressure [Pa], converged) for any ``operator`` with ``apply``.

    It has converged when sum(p |g|)/sum(p) and the deepest overlap are <= tolerance times the load-weighted deflection
    sum(p u)/sum(p), or times the rms of gap0 if that is larger. The overlap is looked at as well, because a single
    touching cell has p g = 0.
    """
    p = np.full(gap0.shape, float(mean_pressure))
    direction = np.zeros_like(p)
    power = 1.0
    keep = 0.0
    for _ in range(max_iterations):
        u = operator.apply(p)
        inside = p > 0
        gap = gap0 + u
        gap -= gap[inside].mean()
        total = p.sum()
        scale = tolerance * max(np.vdot(p, u) / total, gap0.std())
        if np.vdot(p, np.abs(gap)) / total <= scale and -gap.min() <= scale:
            return p, True
        now = np.vdot(gap[inside], gap[inside])
        direction = np.where(inside, gap + keep * (now / power) * direction, 0.0)
        answer = operator.apply(direction)
        answer -= answer[inside].mean()
        curvature = np.vdot(answer[inside], direction[inside])
        if not curvature > 0:
            return p, False
        step = np.vdot(gap[inside], direction[inside]) / curvature
        p = np.where(inside, np.maximum(p - step * direction, 0.0), 0.0)
        overlapping = (p == 0) & (gap < 0)
        p[overlapping] -= step * gap[overlapping]
        power = now
        keep = 0.0 if overlapping.any() else 1.0
        p *= mean_pressure / p.mean()
    return p, False
