"""The closure of load sharing: how film and contact divide the load, by Eq. (8) of the paper.

The mean gap G of the rough surfaces is the mean film h of the smooth ones. Both follow from s = ln(F_H/F_C): where the
film carries more, it is thinner, and the gap is wider. So the residual of the closure increases with s and has one
root, which `balance` finds. Errors meet the closure through an error of the gap at given load: cells (`CellEffect`),
places (`Scatter`) and solvers state that error, and `log_load_ratio_per_gap` is how the division of the load reacts to
it.

Another closure of gap and film is another body of the first three functions; the others follow from these, and so do
all equations that take them from here, at rest and in time. These are of this closure by themselves: the first guesses
of a root (`balance.predict_log_load_ratio`, powers of the loads, and `balance._root_start`, a film of two Sq); where
the film does not fill the gap in the inlet (`balance._in_contact`), and the film that fills it in `answer.fields_on`;
limits that take film and gap for lengths of one size (`balance._needed_settings`, `BalancedSample.is_too_coarse`); the
estimates of work (`estimated_work.expected_gap`); `error_of_eq8`, which is measured; and the texts that say "Eq. (8)",
which another closure replaces.
"""

import math
from dataclasses import replace

from ...contact import ContactState


def gap_under(mean_film: float) -> float:
    """Return the mean gap [m] that the closure demands under ``mean_film`` [m]: the film fills the gap."""
    return mean_film


def film_under(mean_gap: float) -> float:
    """Return the mean film [m] that the closure demands in ``mean_gap`` [m]: the inverse of `gap_under`."""
    return mean_gap


def gap_per_film(mean_film: float) -> float:
    """Return the change of `gap_under` [m] per relative change of the film: its derivative by ln(``mean_film``)."""
    return mean_film


def relative_gap_per_film(mean_film: float) -> float:
    """Return the relative change of `gap_under` per relative change of the film [-]: its error over that of the
    film."""
    return gap_per_film(mean_film) / gap_under(mean_film)


def volume_residual(contact_state: ContactState) -> float:
    """Return (G - g)/(|G| + g) of ``contact_state``, g the gap that the closure demands: 0 where it holds, increasing
    with s."""
    gap = contact_state.mean_gap
    demanded = gap_under(contact_state.mean_film)
    return (gap - demanded) / (abs(gap) + demanded)


def open_gap(contact_state: ContactState) -> float:
    """Return the gap [m] that the closure leaves open at ``contact_state``: G - g, g the gap that it demands."""
    return contact_state.mean_gap - gap_under(contact_state.mean_film)


def with_gap_of_closure(contact_state: ContactState, mean_film: float) -> ContactState:
    """Return ``contact_state`` with the gap that the closure demands under ``mean_film`` [m]."""
    return replace(contact_state, mean_gap=gap_under(mean_film), mean_film=mean_film)


def log_load_ratio_per_gap(gap_rate: float, demanded_rate: float) -> float:
    """Return ds/dG [1/m], the change of s by a change of the gap at given load, from the rates dG/ds and dg/ds [m], of
    the gap and of the gap that the closure demands.

    The closure remains: dG + dG/ds ds = dg/ds ds.
    """
    return -1.0 / (gap_rate - demanded_rate)


def residual_slope(per_gap: float, mean_film: float) -> float:
    """Return the slope of the residual over s, where it is 0, from ds/dG = ``per_gap`` [1/m]; infinite where that is
    0."""
    return -0.5 / (per_gap * gap_under(mean_film)) if per_gap else math.inf
