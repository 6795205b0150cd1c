"""A property of every deflection operator, reciprocity, as a function that anyone can call."""

from __future__ import annotations

import numpy as np

from .._base import validate


def reciprocity_error(operator, seed: int = 0) -> float:
    """Relative difference of q·Kp and p·Kq for random p, q (Maxwell-Betti): 0 up to rounding.

    ``|q·Kp - p·Kq| / (|q| |Kp| + |p| |Kq|)`` for any object with ``shape`` and ``apply``. About 1e-16
    in double and 1e-8 in single precision.
    """
    random = np.random.default_rng(validate.integer("seed", seed, minimum=0))
    p, q = random.standard_normal((2, *operator.shape))
    kp, kq = (np.asarray(operator.apply(f), dtype=float) for f in (p, q))
    scale = np.linalg.norm(q) * np.linalg.norm(kp) + np.linalg.norm(p) * np.linalg.norm(kq)
    return float(abs(np.vdot(q, kp) - np.vdot(p, kq)) / scale) if scale > 0 else 0.0
