"""Line kernel: deflection of a half-space in plane strain by uniform cells of pressure."""

from __future__ import annotations

import numpy as np


def line_coefficients(count: int, spacing: float, e_prime: float, reference_length: float) -> np.ndarray:
    """Deflection [m/Pa] at ``count`` cell centres, 0, 1, ... cells away from a cell under 1 Pa.

    ``-(4/(pi E')) ∫ ln(|x - x'|/reference_length) dx'`` over the cell, exact; spacing [m], e_prime
    [Pa]. The half-space is unbounded, so u is known up to a constant: here u of a line load is zero
    at the distance ``reference_length`` [m]. Source: paper, Eq. (6).
    """
    edge = np.arange(count) + 0.5
    antiderivative = edge * (np.log(edge * (spacing / reference_length)) - 1)
    cells = np.diff(antiderivative, prepend=-antiderivative[0])
    return -4 / (np.pi * e_prime) * spacing * cells
