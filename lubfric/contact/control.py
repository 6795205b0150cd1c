"""Contact with a prescribed mean gap."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from .._base import increasing_root
from ..errors import CONVERGED
from .nested import approach_controlled, load_controlled
from .residual import volume

FLATTENED = 10.0  # times E' height/spacing: 1.1 would do for a periodic ripple
LOOSEST = 1e-2  # tolerance of a solve whose mean gap is far off
CERTAIN = 20.0  # a surplus so many times its uncertainty away from zero has a certain sign


def gap_controlled(problem, mean_gap: float, start=None):
    """Contact whose mean gap is ``mean_gap`` [m].

    In an elastic periodic contact the mean deflection is zero. So the approach is known, and one solve is enough.
    Otherwise, or if that solve fails, the load is searched.
    """
    guess = pressure_guess(problem)
    if problem.roughness > 0:  # the smaller the gap, the more exactly its zeros have to be met
        problem = replace(
            problem, tolerance=max(problem.tolerance * min(1.0, 0.3 * mean_gap / problem.roughness), 1e-13)
        )
    if problem.operator.boundary == ("periodic", "periodic") and math.isinf(problem.hardness):
        approach = float(problem.gap0.mean()) - mean_gap
        found = approach_controlled(problem, approach, guess, start)
        if found.status == CONVERGED:
            return found
        note = f"at the known approach: {found.status} after {found.iterations} iterations; load searched instead"
        rest = by_load(problem, mean_gap, guess, found.pressure if found.pressure.any() else start)
        return replace(rest, notes=(note,), convolutions=rest.convolutions + found.convolutions)
    return by_load(problem, mean_gap, guess, start)


def pressure_guess(problem) -> float:
    """A first pressure [Pa]: E' times rms height over the longer side. It flattens a wave of that length and height."""
    longest = max(n * d for n, d in zip(problem.operator.shape, problem.operator.spacing))
    return min(problem.operator.e_prime * problem.roughness / longest, 0.5 * problem.hardness)


def flattening_pressure(problem) -> float:
    """A pressure [Pa] that no roughness exceeds: it flattens the whole height as if it were the shortest ripple that
    the grid resolves."""
    height = float(np.ptp(problem.gap0))
    return FLATTENED * problem.operator.e_prime * height / min(problem.operator.spacing)


def by_load(problem, mean_gap: float, guess: float, start=None):
    """Find the load with that mean gap, by one bracketed root in the logarithm of the pressure.

    The mean gap falls with the load, so there is one root. Each solve starts from the last, and is only as exact as the
    sign of the remaining gap requires.
    """
    finest = 0.2 * problem.tolerance
    pressure, spent, iterations = start, 0.0, 0

    def surplus(log_pressure, _):
        nonlocal pressure, spent, iterations
        tolerance = max(finest, LOOSEST)
        while True:
            found = load_controlled(replace(problem, tolerance=tolerance), math.exp(log_pressure), pressure)
            pressure = found.pressure
            spent, iterations = spent + found.convolutions, iterations + found.iterations
            open_gap, scale = volume(found.state.gap), found.state.scale
            smaller = min(mean_gap, scale)
            value, doubt = (mean_gap - open_gap) / smaller, CERTAIN * tolerance * scale / smaller
            if tolerance == finest or abs(value) > doubt:
                return value, found
            tolerance = max(finest, tolerance * min(0.1, abs(value) / doubt))

    if start is not None and start.any():
        guess = float(start.mean())
    upper = math.log(min(problem.hardness, flattening_pressure(problem)))
    root = increasing_root(
        surplus, math.log(guess), step=0.7, bounds=(-300.0, upper), tolerance=0.5 * problem.tolerance
    )
    found = root.payload
    return replace(
        found,
        iterations=iterations,
        convolutions=spent,
        history=tuple(root.history),
        status=root.status if found.status == CONVERGED else found.status,
        solver="bracketed load, preconditioned conjugate gradient",
    )
