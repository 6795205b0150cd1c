"""The standard error of f at one moment of a transient, because its line is finite."""

from __future__ import annotations

import math

from .scatter import block_error, gap_influence, line_load, strip_gap


def moment_error(
    contact, state, loads, softness: float, width: float, correlation_length: float, parts, thinning: float
) -> float:
    """Relative standard error of f at one moment, from a `ContactState` with fields on ``contact``: 0 without contact,
    NaN if the line is too short.

    ``loads``: (F_C, F_H) [N]; ``softness``: -dG/d ln F_C [m] of the contact; ``parts``: boundary and viscous friction
    [N]; ``thinning``: -d ln h/d ln F_H of the film, 1 if it is rigid and some .1 if it is elastic. Film and contact are
    assumed to have time to divide the load anew (`lubfric.sampling.response.respond`). A film that is squeezed follows
    more slowly, and the error is smaller then.
    """
    contact_load, film_load = loads
    boundary, viscous = parts
    total, friction = contact_load + film_load, boundary + viscous
    if contact_load <= 0 or friction == 0:
        return 0.0
    if state.fields is None or not math.isfinite(correlation_length):
        return math.nan
    slope = -softness / (contact_load / width)
    values = gap_influence(strip_gap(contact, state), line_load(contact, state), slope)
    found = block_error(values, contact.spacing[1], correlation_length)
    shares = contact_load / total, film_load / total
    split = found.error / (softness * shares[1] + thinning * state.mean_film * shares[0])
    return abs((viscous * shares[0] - boundary * shares[1]) / friction) * split if found.freedom else math.nan
