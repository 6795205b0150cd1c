"""Contact with a prescribed mean gap."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ..roots import increasing_root
from .nested import load_controlled
from .residual import length_scale


def gap_controlled(problem, mean_gap: float, start=None):
    """The load whose contact has ``mean_gap`` [m]: one bracketed root in the logarithm of the pressure.

    The mean gap falls with the load, so the root is the only one. Each solve starts from the last.
    """
    inner = replace(problem, tolerance=0.3 * problem.tolerance)
    pressure, spent, iterations = start, 0, 0

    def surplus(log_pressure):
        nonlocal pressure, spent, iterations
        found = load_controlled(inner, math.exp(log_pressure), pressure)
        pressure = found.pressure
        spent, iterations = spent + found.convolutions + 1, iterations + found.iterations
        u = problem.operator.apply(pressure)
        volume = np.maximum(problem.gap0 + u - found.approach, 0.0).mean()
        return (mean_gap - volume) / length_scale(pressure, u, problem.operator), found

    sigma, length = problem.gap0.std(), max(n * d for n, d in zip(problem.operator.shape, problem.operator.spacing))
    guess = problem.operator.e_prime * sigma / length if start is None or not start.any() else start.mean()
    upper = math.log(problem.hardness) if math.isfinite(problem.hardness) else 700.0
    root = increasing_root(surplus, math.log(guess), step=0.7, bounds=(-300.0, upper), tolerance=0.5 * problem.tolerance)
    found = root.payload
    return replace(found, iterations=iterations, convolutions=spent, history=list(root.history),
                   status=root.status if found.status == "converged" else found.status,
                   solver="bracketed load, preconditioned conjugate gradient")
