"""Two conditions in two unknowns, solved together by Broyden's method from a roughly known tangent.

The unknowns are the film's share of the load and the film on the spots. The conditions are the balance of the load and
that of the reduced pressures. Every step costs one dry contact and one film. To nest one condition in the other costs
some five times as much, and is done if this method does not converge.

Source: C. G. Broyden, Math. Comp. 19 (1965) 577-593, doi:10.1090/S0025-5718-1965-0198670-6.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

TANGENT = np.array([[0.9, 1.0], [0.0, 1.5]])  # of rough contacts, in logarithms; the second is that of `lift.SLOPE`
LEAST = (0.2, 0.4)  # of its diagonal, below which it tells nothing
LONGEST = np.array([1.5, 0.7])  # steps
MOST = 14  # evaluations


@dataclass(frozen=True)
class Together:
    """The end of the search: unknowns and values of the conditions (2,), their payload, the tangent (2, 2), and the
    largest value over its tolerance at every step, and whether it fell to 1."""

    unknowns: np.ndarray
    values: np.ndarray
    payload: Any
    tangent: np.ndarray
    history: tuple[float, ...]

    @property
    def converged(self) -> bool:
        """Whether both conditions hold."""
        return self.history[-1] <= 1


def together(
    f: Callable[[np.ndarray, Any], tuple[np.ndarray, Any]],
    start: np.ndarray,
    tangent: np.ndarray | None,
    *,
    lowest: float,
    tolerances: np.ndarray,
    first: Any = None,
) -> Together:
    """Unknowns at which both values of ``f(unknowns, last)`` -> (values, payload) are within ``tolerances``.

    ``last``: the payload before, ``first`` to begin with. The second unknown is at least ``lowest``; at that bound its
    condition may be positive. Ends after `MOST` evaluations.
    """
    J = TANGENT if tangent is None else tangent
    x = np.array([start[0], max(start[1], lowest)])
    values, payload = f(x, first)
    history = [_missed(x, values, lowest, tolerances)]
    while history[-1] > 1 and len(history) < MOST and np.all(np.isfinite(values)):
        new = x + _step(J, x, values, lowest)
        after, payload = f(new, payload)
        moved = new - x
        J = J + np.outer(after - values - J @ moved, moved) / (moved @ moved)
        x, values = new, after
        history.append(_missed(x, values, lowest, tolerances))
    return Together(x, values, payload, J, tuple(history))


def _missed(x, values, lowest: float, tolerances) -> float:
    held = np.array([values[0], min(values[1], 0.0) if x[1] <= lowest else values[1]])
    return float(np.abs(held / tolerances).max())


def _step(J, x, values, lowest: float) -> np.ndarray:
    if J[0, 0] < LEAST[0] or J[1, 1] < LEAST[1] or np.linalg.det(J) < LEAST[0] * LEAST[1]:
        J = TANGENT
    step = -np.linalg.solve(J, values)
    if x[1] + step[1] < lowest:
        step = np.array([-(values[0] + J[0, 1] * (lowest - x[1])) / J[0, 0], lowest - x[1]])
    return step * min(1.0, float((LONGEST / np.maximum(np.abs(step), 1e-300)).min()))
