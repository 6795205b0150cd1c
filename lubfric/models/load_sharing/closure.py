"""The closure of load sharing: how film and contact divide the load, by Eq. (8) of the paper.

The mean gap G of the rough surfaces is the mean film h of the smooth ones. Both follow from s = ln(F_H/F_C): where the film
carries more, it is thinner, and the gap is wider. So the residual of the closure increases with s and has one root, which
`balance` finds. Errors meet the closure through an error of the gap at given load: cells (`CellEffect`), places
(`Scatter`) and solvers state that error, and `log_load_ratio_per_gap` is how the division of the load reacts to it.

Another closure of gap and film is another body of these six functions, and another first guess
(`balance.predict_log_load_ratio` has the slope of this residual from powers of the loads). That the gap is the film is also
taken for granted in `Response.per_film`, `errors_of`, `scatter`, the film that is filled in `answer` and `lubfric.time.moment`, and
`error_of_eq8` is the error of this closure alone. Runs in time take the residual
from here, and step along s by their own rule, with this closure in their `Spring` (`lubfric.time.load_sharing_solver`).
"""

import math
from dataclasses import replace

from ...contact import ContactState


def volume_residual(contact_state: ContactState) -> float:
    """Return (G - h)/(|G| + h) of ``contact_state``: 0 where the closure holds, increasing with s."""
    gap = contact_state.mean_gap
    film = contact_state.mean_film
    return (gap - film) / (abs(gap) + film)


def gap_under(mean_film: float) -> float:
    """Return the mean gap [m] that the closure demands under ``mean_film`` [m]: the film fills the gap."""
    return mean_film


def open_gap(contact_state: ContactState) -> float:
    """Return the gap [m] that the closure leaves open at ``contact_state``: G - h."""
    return contact_state.mean_gap - gap_under(contact_state.mean_film)


def closed(contact_state: ContactState, mean_film: float) -> ContactState:
    """Return ``contact_state`` with the gap that the closure demands under ``mean_film`` [m]."""
    return replace(contact_state, mean_gap=gap_under(mean_film), mean_film=mean_film)


def log_load_ratio_per_gap(gap_rate: float, film_rate: float) -> float:
    """Return ds/dG [1/m], the change of s by a change of the gap at given load, from the rates dG/ds and dh/ds [m], of the gap and of
    the gap that the closure demands.

    The closure remains: dG + dG/ds ds = dh/ds ds.
    """
    return -1.0 / (gap_rate - film_rate)


def residual_slope(per_gap: float, mean_film: float) -> float:
    """Return the slope of the residual over s, where it is 0, from ds/dG = ``per_gap`` [1/m]; infinite where that is 0."""
    return -0.5 / (per_gap * mean_film) if per_gap else math.inf
