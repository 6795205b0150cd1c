"""How a balance reacts to an error of its gap or its film: the division of the load, and all that depends on it."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...contact import ContactState, RoughContact, weighted_mean
from ...film import EHLResult
from ...scene import Scene
from .closure import gap_per_film, gap_under, log_load_ratio_per_gap
from .forces import Forces, forces_of

# Step of ln(F_H/F_C), each way, for the rates of the film. Half and twice as much change f by less than 0.01 %
# (`python -m verification.campaigns.constants`).
LOG_RATIO_STEP = 0.05

# Relative step of the contact load for the slope of its gap. Half and twice as much change f by less than 0.05 %
# (`python -m verification.campaigns.constants`).
LOAD_STEP = 0.05

# Change of ln(F_H/F_C) beyond which nothing is known [-]. A choice, below what overflows.
LARGEST_GROWTH = 50.0


def loads_at(load: float, log_load_ratio: float) -> tuple[float, float]:
    """Return (F_H, F_C) [N] of a total ``load`` [N] at ``log_load_ratio`` = ln(F_H/F_C)."""
    return load / (1 + math.exp(-log_load_ratio)), load / (1 + math.exp(log_load_ratio))


@dataclass(frozen=True, kw_only=True)
class Slopes:
    """Derivatives of a rough contact by its load per width P [N/m], at a given film.

    Attributes
    ----------
    gap : of the mean gap over A [m²/N]
    area : of the contact area fraction of A [m/N]
    contact_length : of the contact area per length [m²/N]
    """

    gap: float
    area: float
    contact_length: float

    def area_factor(self, more: float, width: float, area: float) -> float:
        """Return by which factor a contact area fraction grows under ``more`` load [N] on the ``width`` [m]."""
        return max(1 + self.area * more / (width * area), 0.0) if area else 1.0


@dataclass(frozen=True, kw_only=True)
class Response:
    """Reaction of a balance to an error of its gap. Without a film the load ratio does not change.

    Attributes
    ----------
    slopes : those of its rough contact
    log_load_ratio_per_gap : ds/dG [1/m], the change of s = ln(F_H/F_C) by a change of the gap at given load
    rates : d ln q/ds of the reported quantities q along the balance of load, by name; None: without a film
    load_ratio : F_H/F_C
    """

    slopes: Slopes
    log_load_ratio_per_gap: float = 0.0
    rates: dict[str, float] | None = None
    load_ratio: float = 0.0

    def per_gap(self, name: str) -> float:
        """Return the relative change of quantity ``name`` per change of the gap [1/m], for small changes; 0 without a
        film."""
        return abs(self.rates[name] * self.log_load_ratio_per_gap) if self.rates else 0.0

    def per_film(self, forces: Forces, mean_film: float) -> float:
        """Return the relative change of f per relative change of the film, of mean thickness ``mean_film`` [m], at
        most."""
        return self.per_gap("coefficient") * gap_per_film(mean_film) + forces.film_sensitivity

    def relative(self, name: str, gap_error: float) -> float:
        """Return the relative error [-] of quantity ``name`` for an error of the gap [m]; 0 without a film.

        The load of a light contact depends exponentially on the gap. Where s falls by m, it grows by (1 + F_H/F_C)/(1 +
        exp(-m) F_H/F_C) - 1, which is more than to first order.
        """
        rate = self.per_gap(name)
        if not rate:  # a quantity that does not move is known, however far the gap is off
            return 0.0
        return (
            rate * abs(gap_error) * max(1.0, load_growth(abs(self.log_load_ratio_per_gap * gap_error), self.load_ratio))
        )

    def gap_for(self, name: str, change: float) -> float:
        """Return a gap error [m] that changes quantity ``name`` by no more than ``change``, relative."""
        rate = self.per_gap(name)
        if not rate:
            return math.inf
        first_order = change / rate
        return first_order / max(1.0, load_growth(abs(self.log_load_ratio_per_gap * first_order), self.load_ratio))


@dataclass(frozen=True, kw_only=True)
class MomentResponse:
    """Reaction of f at a moment of a run in time to an error of the gap or of the film.

    Film and contact are assumed to have time to divide the load anew, as in a `Response`; a film that is squeezed
    follows more slowly, and then f changes less. Each part of the friction is in proportion to its load.

    Attributes
    ----------
    contact_load, film_load : F_C and F_H [N]
    boundary, viscous : friction of the contact and of the film [N]
    softness : -dG/d ln F_C of the contact [m]
    film_load_exponent : -d ln h/d ln F_H of the film [-], 1 if it is rigid and some .1 if it is elastic
    mean_film : of the film [m]
    """

    contact_load: float
    film_load: float
    boundary: float
    viscous: float
    softness: float
    film_load_exponent: float
    mean_film: float

    @property
    def force(self) -> float:
        """The friction of both [N]."""
        return self.boundary + self.viscous

    @cached_property
    def per_gap(self) -> float:
        """The relative change of f per change of the gap [1/m]."""
        total = self.contact_load + self.film_load
        contact_share = self.contact_load / total
        film_share = self.film_load / total
        per_log_ratio = abs((self.viscous * contact_share - self.boundary * film_share) / self.force)
        by_film = self.film_load_exponent * gap_per_film(self.mean_film)
        return per_log_ratio / (self.softness * film_share + by_film * contact_share)

    def per_film(self, shear_magnitude: float) -> float:
        """Return the relative change of f by a relative change of the film, at most; ``shear_magnitude``: the sum of
        the absolute parts of the film's shear force [N]. In steady motion it is `Response.per_film`, from films at
        other loads."""
        if self.force == 0:
            return 0.0
        at_given_loads = shear_magnitude / abs(self.force)
        if self.contact_load <= 0:
            return at_given_loads
        return self.per_gap * gap_per_film(self.mean_film) + at_given_loads


def load_growth(moved: float, load_ratio: float) -> float:
    """Return how much more the contact load grows than to first order, when ln(F_H/F_C) falls by ``moved`` >= 0 from
    ln(``load_ratio``), ``load_ratio`` = F_H/F_C. As F_C = F_T/(1 + F_H/F_C), it is less than 1 where the contact
    carries most."""
    moved = min(moved, LARGEST_GROWTH)
    if not moved or not load_ratio:
        return 1.0
    return ((1 + load_ratio) / (1 + math.exp(-moved) * load_ratio) - 1) * (1 + load_ratio) / (moved * load_ratio)


def slopes_of(
    rough_contact: RoughContact,
    contact_state: ContactState,
    *,
    load: float,
    width: float,
    thickness: np.ndarray,
    shape: np.ndarray | None = None,
) -> Slopes:
    """Return the `Slopes` of ``rough_contact``, which is in ``contact_state`` at ``load`` [N] on the ``width`` [m]
    under ``thickness`` and ``shape`` [m] (nx,): secants to a load 5 % larger, or smaller where the contact carries no
    more."""
    step = LOAD_STEP * load * (1 if rough_contact.capacity > (1 + LOAD_STEP) * load else -1)
    more = rough_contact.close(thickness, load + step, contact_state, shape)
    area = more.real_contact_area_fraction - contact_state.real_contact_area_fraction
    return Slopes(
        gap=(more.mean_gap - contact_state.mean_gap) * width / step,
        area=area * width / step,
        contact_length=(contact_length(more) - contact_length(contact_state)) * width / step,
    )


def respond(
    scene: Scene,
    rough_contact: RoughContact,
    contact_state: ContactState,
    *,
    load: float,
    thickness: np.ndarray,
    shape: np.ndarray | None = None,
    film_of: Callable[[float], EHLResult] | None = None,
) -> Response:
    """Return the `Response` of ``rough_contact``, which is in ``contact_state`` at ``load`` [N] under ``thickness`` and
    ``shape`` [m] (nx,).

    ``film_of``: the film that carries a load [N], where one shares the load. Its rates come from films at two other
    divisions of the load; no contact is solved for them. The rate of the gap is dG/ds = dG/dP dP/ds, with dP/ds = -P
    F_H/F_T.
    """
    width = scene.bodies.width
    slopes = slopes_of(rough_contact, contact_state, load=load, width=width, thickness=thickness, shape=shape)
    total = scene.bodies.load
    film_load = total - load
    if film_of is None or film_load <= 0:  # 0 where the film carries less than the rounding error of the load
        return Response(slopes=slopes)
    log_load_ratio = math.log(film_load / load)

    def at(s: float) -> dict[str, float]:
        loads = loads_at(total, s)
        shared = film_of(loads[0])
        factor = slopes.area_factor(loads[1] - load, width, contact_state.real_contact_area_fraction)
        mean_gap = gap_under(weighted_mean(shared.film_at(rough_contact.x), rough_contact.weight))
        return point_numbers(
            forces_of(scene, shared, with_contact_area_scaled(contact_state, factor), loads[1]), shared, loads, mean_gap
        )

    low = at(log_load_ratio - LOG_RATIO_STEP)
    high = at(log_load_ratio + LOG_RATIO_STEP)
    demanded_rate = (high["mean_gap"] - low["mean_gap"]) / (2 * LOG_RATIO_STEP)
    gap_rate = -slopes.gap * load * film_load / (total * width)
    per_gap = log_load_ratio_per_gap(gap_rate, demanded_rate)
    return Response(
        slopes=slopes,
        log_load_ratio_per_gap=per_gap,
        rates={name: _log_rate(low[name], high[name]) for name in low},
        load_ratio=film_load / load,
    )


def point_numbers(
    forces: Forces, film: EHLResult | None, loads: tuple[float, float], mean_gap: float
) -> dict[str, float]:
    """Return the numbers of a point that a balance determines, by name (`lubfric.quantities`). ``forces``: those of the
    ``film`` (None: none), which carries the first of ``loads`` [N], and of the contact, which carries the second."""
    return {
        "coefficient": forces.coefficient,
        "contact_load": loads[1],
        "boundary_film_load": loads[1],
        "film_load": loads[0],
        "shear_force": forces.shear.total,
        "couette_force": forces.shear.couette,
        "rolling_force": forces.shear.rolling,
        "rolling_resistance": forces.shear.resistance,
        "boundary_force": forces.boundary,
        "min_film": math.nan if film is None else film.min_film,
        "central_film": math.nan if film is None else film.central_film,
        "mean_gap": mean_gap,
        "inlet_film_factor": forces.heat.inlet_film_factor,
        "flash_temperature_rise": forces.heat.flash,
        "film_temperature_rise": forces.heat.film_rise,
    }


def with_contact_area_scaled(contact_state: ContactState, factor: float) -> ContactState:
    """Return ``contact_state`` with ``factor`` times its contact area, at every x up to the full width."""
    return replace(
        contact_state,
        contact_fraction=np.minimum(contact_state.contact_fraction * factor, 1.0),
        real_contact_area_fraction=min(contact_state.real_contact_area_fraction * factor, 1.0),
    )


def contact_length(contact_state: ContactState) -> float:
    """Return the contact area per length of the line [m]."""
    return float(contact_state.contact_fraction.sum() * (contact_state.x[1] - contact_state.x[0]))


def _log_rate(low: float, high: float) -> float:
    middle = 0.5 * (low + high)
    return (high - low) / (2 * LOG_RATIO_STEP * middle) if middle else 0.0
