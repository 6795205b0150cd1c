"""What is said of special films: the gap of touching cells, and films at their limiting stress."""

import math
from collections.abc import Iterable, Mapping

import numpy as np

from ..models.deterministic import FLOOR
from ..quantities import counted
from ..units import plain_number

# What a smallest film of `FLOOR` is.
GAP_OF_TOUCHING = "the gap that the deterministic model assumes where asperities touch, not a computed film"
# Smallest film [m], a mean over strips, below which some of them have that gap. A choice: those of gears with one to
# four strips were 1.01 to 3.4 nm.
NEAR_FLOOR = 5.0 * FLOOR
# Relative rounding error of that gap as a mean over strips. A choice: any number between rounding and a nanometre does.
FLOOR_ROUNDING = 1e-6
# What the films and gaps of a table of details are, and which of them the lambda ratio has.
FILMS_AND_GAPS = (
    "The film thickness of the lambda ratio is the full-load film. The separations are gaps of the rough surfaces, mean "
    "over the Hertz strip and, central, at x = 0: where asperities touch, summits hold them open, so they are larger "
    "than the film. By the load-sharing model the central separation is the smooth film under the film load F_H."
)
# Loads that say what carries F_T.
LOADS = ("contact_load", "film_load", "boundary_film_load", "saturated_film_load")
# Part of the load on films at their limiting stress from which it is stated. A convention.
LEAST_AT_LIMIT = 0.01


def is_gap_of_touching(film: float) -> bool:
    """Return whether a smallest ``film`` [m] is the gap that the deterministic model gives to touching cells."""
    return math.isclose(film, FLOOR, rel_tol=FLOOR_ROUNDING)


def note_on_touching(films: Iterable[float]) -> str:
    """Return what a smallest film of 1 nm is, in a sentence, and what a larger one below `NEAR_FLOOR`; "" where none of
    the smallest ``films`` [m] is one."""
    near = [film for film in films if is_gap_of_touching(film) or FLOOR < film < NEAR_FLOOR]
    if not near:
        return ""
    of_means = f"; one below {1e9 * NEAR_FLOOR:.0f} nm is a mean over strips or times, some of which have this gap"
    return f"A smallest film of 1 nm is {GAP_OF_TOUCHING}{'' if all(map(is_gap_of_touching, near)) else of_means}."


def films_at_limit(loads: Mapping[str, np.ndarray]) -> str:
    """Return in a sentence how much of the load films at their limiting stress carry that are no part of the asperity
    load, by the ``loads`` (`LOADS`) [N] of some points; "" where that is less than `LEAST_AT_LIMIT` everywhere or not
    known."""
    (contact, film, boundary, saturated) = (loads[name] for name in LOADS)
    shares = (saturated - np.maximum(contact - boundary, 0.0)) / (contact + film)
    shares = shares[shares > LEAST_AT_LIMIT]
    if not shares.size:
        return ""
    ends = " to ".join(dict.fromkeys(plain_number(100 * float(end), digits=2) for end in (shares.min(), shares.max())))
    where = f" at {shares.size} of {counted(contact.size, 'points')}" if contact.size > 1 else ""
    return (
        f"Films sheared at their limiting stress carry {ends} % of the load{where}; the asperity load ratio does not "
        "include this load."
    )
