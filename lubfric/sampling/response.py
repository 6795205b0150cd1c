"""How a balance reacts to an error of its gap: the division of the load, and everything that depends on it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..contact import ContactState
from ..sharing import Balance, growth

STEP = 0.05  # of s = ln(F_H/F_C), each way, for rates of the film
LOAD_STEP = 0.05  # relative, of the contact load, for the slope of its gap


@dataclass(frozen=True)
class Slopes:
    """Derivatives of a rough contact by its load per width P [N/m], at a given film.

    ``gap`` [m²/N]: the mean gap over A; ``area`` [m/N]: the contact area fraction of A; ``touched`` [m²/N]: the contact
    area per length.
    """

    gap: float
    area: float
    touched: float

    def area_factor(self, more: float, width: float, area: float) -> float:
        """By which factor a contact area fraction grows under ``more`` load [N] on the ``width`` [m]."""
        return max(1 + self.area * more / (width * area), 0.0) if area else 1.0


@dataclass(frozen=True)
class Response:
    """Reaction of a balance to an error of its gap.

    ``slopes``: those of its contact; ``split``: ds/dG [1/m], the change of s = ln(F_H/F_C) by a change of the gap at
    given load; ``rates``: d ln q/ds of the reported quantities q along the balance of load, by name; ``odds``: F_H/F_C;
    ``film_exponent``: n of F_C ~ F_H^n, for a contact at the gap that the film of F_H leaves. Without a film the split
    does not change.
    """

    slopes: Slopes
    split: float = 0.0
    rates: dict[str, float] | None = None
    odds: float = 0.0
    film_exponent: float = 0.0

    def per_gap(self, name: str) -> float:
        """Relative change of quantity ``name`` per change of the gap [1/m], for small changes; 0 without a film."""
        return abs(self.rates[name] * self.split) if self.rates else 0.0

    def relative(self, name: str, gap_error: float) -> float:
        """Relative error [-] of quantity ``name`` for an error of the gap [m]; 0 without a film.

        The load of a light contact depends exponentially on the gap. Where s falls by m, it grows by (1 + F_H/F_C)/(1 +
        exp(-m) F_H/F_C) - 1, which is more than to first order.
        """
        rate = self.per_gap(name)
        if not rate:  # a quantity that does not move is known, however far the gap is off
            return 0.0
        return rate * abs(gap_error) * max(1.0, growth(abs(self.split * gap_error), self.odds))

    def gap_of_load(self, change: float) -> float:
        """The change of the gap [m] that changes the contact load by ``change`` of it, to first order."""
        return abs(change * (1 + self.odds) / (self.odds * self.split)) if self.split and self.odds else 0.0


def slopes_of(state: ContactState, load: float, width: float, close: Callable[[float], ContactState]) -> Slopes:
    """The `Slopes` as secants, from ``load`` [N], at which the contact is ``state``, to 1.05 times it, which ``close``
    solves for."""
    more, step = close(load * (1 + LOAD_STEP)), LOAD_STEP * load / width
    return Slopes(
        (more.mean_gap - state.mean_gap) / step,
        (more.real_contact_area_fraction - state.real_contact_area_fraction) / step,
        (touched_length(more) - touched_length(state)) / step,
    )


def respond(width: float, balance: Balance, slopes: Slopes, at_split: Callable[[float], dict[str, float]]) -> Response:
    """The `Response` of a balance in contact with a film.

    ``at_split(s)`` gives the quantities by name at another division of the load, among them "mean_gap", which is there
    the mean film. No contact is solved for it. The gap obeys G(P(s)) = h(s), so ds/dG = -1/(dG/dP dP/ds - dh/ds), with
    dP/ds = -P F_H/F_T. At the gap h, d ln P/dG = 1/(P dG/dP), and d ln F_H/ds = F_C/F_T.
    """
    low, high = at_split(balance.split - STEP), at_split(balance.split + STEP)
    film_rate = (high["mean_gap"] - low["mean_gap"]) / (2 * STEP)
    total = balance.contact_load + balance.film_load
    load_rate = -balance.contact_load * balance.film_load / (total * width)
    rates = {name: _log_rate(low[name], high[name]) for name in low}
    split = -1.0 / (slopes.gap * load_rate - film_rate)
    exponent = film_rate * width * total / (slopes.gap * balance.contact_load**2)
    return Response(slopes, split, rates, balance.film_load / balance.contact_load, exponent)


def touched_length(state: ContactState) -> float:
    """Contact area per length of the line [m]."""
    return float(state.contact_fraction.sum() * (state.x[1] - state.x[0]))


def _log_rate(low: float, high: float) -> float:
    middle = 0.5 * (low + high)
    return (high - low) / (2 * STEP * middle) if middle else 0.0
