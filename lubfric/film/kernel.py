"""Elastic deflection of a half-space under a piecewise linear line pressure."""

from __future__ import annotations

import math

import numpy as np


def hat_kernel(points: np.ndarray, nodes: np.ndarray) -> np.ndarray:
    """Matrix K (points, nodes) of -(4/pi) ∫ phi_j(x') ln|x_i - x'| dx', exact.

    phi_j are the hat functions on increasing ``nodes`` (half hats at both ends). With
    G(s) = s²/2 ln|s| - 3/4 s², G'' = ln|s|, each integral is the second divided difference of
    G(x_i - x_j) over the nodes of the hat, plus a G' term at the two ends.
    """
    s = points[:, None] - nodes[None, :]
    log = np.log(np.where(s == 0.0, 1.0, np.abs(s)))
    slope = np.diff(s * s * (0.5 * log - 0.75), axis=1)
    slope /= np.diff(nodes)
    K = np.empty_like(s)
    np.subtract(slope[:, 1:], slope[:, :-1], out=K[:, 1:-1])
    K[:, 0] = slope[:, 0] + s[:, 0] * (log[:, 0] - 1.0)
    K[:, -1] = -slope[:, -1] - s[:, -1] * (log[:, -1] - 1.0)
    K *= -4.0 / math.pi
    return K
