"""The load that several lines carry when they are joined to one, from the balance of each."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

CLOSED = 1e-12  # of the whole load


@dataclass(frozen=True)
class Joined:
    """Contact load [N] of joined lines, and what is left open of it [N]."""

    load: float
    open: float = 0.0


def joined(lengths, loads, total: float, film_exponent: float) -> Joined:
    """Lines of ``lengths`` [m] that are each in balance carry ``loads`` [N] of the whole width; as one, they share a
    film.

    Where a line is lightly loaded by its own balance, its film carries more and is thinner than the common one. So
    under the common film of F_H it carries less than its load P_i, and a heavily loaded line more. If that load is
    exponential in the gap, it is P_i (F_H/F_Hi)^n with n = ``film_exponent`` (`Response`), and the common load P is
    the root of P = mean_i P_i ((F_T - P)/(F_T - P_i))^n. If it is linear in the gap, P is the mean of P_i. Summits that
    are pressed in one by one are between the two: the middle is taken, and half the distance is left open. Under a
    film that does not thin with its load (n <= 0) the mean is taken.
    """
    from scipy.optimize import brentq

    part, loads = np.asarray(lengths) / np.sum(lengths), np.asarray(loads)
    mean, films = float(part @ loads), np.maximum(total - loads, CLOSED * total)
    if film_exponent <= 0 or np.ptp(loads) <= CLOSED * total:
        return Joined(mean)

    def surplus(load: float) -> float:
        return float(part @ (loads * ((total - load) / films) ** film_exponent)) - load

    exponential = brentq(surplus, float(loads.min()), float(loads.max()), xtol=CLOSED * total)
    return Joined((mean + exponential) / 2, abs(exponential - mean) / 2)
