"""How the strips of a line of Eq. (8) differ from the complete line, to first order: the control of the second level.

At the film and the approach that all strips share, every place has its influence on the mean gap and on f
(`lubfric.models.load_sharing.scatter`). The mean over a strip shows by how much f would differ if the line were like
that strip. Over the line these differences are zero in the mean. So they are known without another solve, and taking
them from strips of the deterministic model leaves less scatter and the same mean (a control variate: J. M. Hammersley
and D. C. Handscomb, Monte Carlo Methods, Methuen 1964, Sec. 5.5).
"""

import math

import numpy as np

from ...quantities import names_with
from ..shared import FREEDOM_NOT_COUNTED, ControlVariate, StandardError, contact_on_strip, with_forces_of_film
from .balanced_sample import BalancedSample
from .response import point_numbers
from .scatter import friction_influence, gap_influence, hertz_mean_gap, line_load


def control_for(balanced: BalancedSample) -> ControlVariate | None:
    """Return the control of another model on the strips of the scene; None where ``balanced`` is on other cells, on a
    single patch, or does not know its own scatter."""
    prepared = balanced.prepared
    sample = prepared.sample
    has_others = balanced.sample.cells == sample.cells and sample.represents_more
    if not has_others or not math.isfinite(balanced.sampling_error.value):
        return None
    return control_variate_of(balanced)


def control_variate_of(balanced: BalancedSample) -> ControlVariate:
    """Return the differences of the strips of ``balanced`` from their line. Where nothing touches, strips do not
    differ."""
    prepared = balanced.prepared
    raw_balance = balanced.raw_balance
    response = balanced.response
    rough_contact = balanced.on_cells
    assert rough_contact is not None  # as there are strips
    rows = contact_on_strip(prepared, prepared.sample, 0).heights.shape[1]
    # a measured line may have some more rows than its strips
    starts = np.arange(balanced.count) * rough_contact.heights.shape[1] // balanced.count

    def of_strips(places: np.ndarray) -> np.ndarray:
        return np.array([places[start : start + rows] for start in starts]) - places.mean()

    places = of_strips(raw_balance.forces.coefficient * friction_influence(prepared.scene, rough_contact, raw_balance))
    numbers = {"coefficient": places.mean(axis=1)}
    if response is None or response.rates is None:
        error = StandardError(balanced.sampling_error.value, FREEDOM_NOT_COUNTED)
        return ControlVariate(by_place=places, numbers=numbers, sampling_error=error)
    gap = hertz_mean_gap(rough_contact, raw_balance.contact_state)
    load = line_load(rough_contact, raw_balance.contact_state)
    influence = gap_influence(gap, load, response.slopes.gap)
    moved = response.log_load_ratio_per_gap * of_strips(influence).mean(axis=1)  # of ln(F_H/F_C)
    values = point_numbers(
        raw_balance.forces,
        raw_balance.film,
        (raw_balance.film_load, raw_balance.contact_load),
        raw_balance.contact_state.mean_gap,
    )
    # beside f all that change with the division of the load, and the mean gap, which is that of rough surfaces by both
    # models; the other numbers of films are those of a smooth one here
    numbers |= {name: values[name] * response.rates[name] * moved for name in names_with("is_controlled")}
    numbers = with_forces_of_film(numbers, prepared.scene.bodies.load)
    error = StandardError(balanced.sampling_error.value, balanced.friction_scatter.freedom)
    return ControlVariate(by_place=places, numbers=numbers, sampling_error=error)
