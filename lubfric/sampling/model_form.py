"""The error of load sharing itself, as far as a study has shown it (docs/model-error.md).

``python -m verification model`` solves the same rough line contact by load sharing and by the deterministic model
(`lubfric.deterministic`): the cylinder of the paper, Sq 100 nm, 5.5 to 110 N, 0.001 to 0.3 m/s, patches of 90 µm. The
rms over surfaces of f/f_deterministic - 1 lies below these bounds.

The bounds hold for a patch. Much of that error differs from patch to patch, so a long line has less. They do not
include what both models leave out: heat, unsteady roughness, boundary films.
"""

from __future__ import annotations

import math

MOST = 0.3  # about lift-off, where the share of the asperities is told worst
LEAST = 0.02
STEEPNESS = 0.56  # of the error over the share of the film, from boundary lubrication on
FULL_FILM = 3.2  # error times (film/Sq)²: a film between rough surfaces is not that between smooth ones
ONE_WAY, ONE_WAY_FULL_FILM = 0.11, 0.05
ONE_WAY_BOUNDARY, MOSTLY = 0.03, 0.85  # where the contact carries that share or more
PER_LEFT_OUT = 7.0  # of the deflection that the closure leaves out, over the mean gap
NO_FILM = 0.005  # beside the film's share of the load: where no film carries, two solvers differ by that at most


def load_sharing_error(film_to_roughness_ratio: float, contact_share: float) -> float:
    """Relative error of f by Eq. (8).

    In contact ``min(0.3, 0.02 + 0.56 (1 - s))`` with s = F_C/F_T. For a full film ``min(0.3, 3.2/λ²)`` with λ = central
    film/Sq. 0 if the contact carries the whole load.
    """
    if contact_share >= 1:
        return 0.0
    if contact_share > 0:
        return min(MOST, LEAST + STEEPNESS * (1 - contact_share))
    if film_to_roughness_ratio == math.inf:
        return 0.0
    return min(MOST, FULL_FILM / film_to_roughness_ratio**2)


def one_way_error(contact_share: float, left_out: float) -> float:
    """Relative error of f by ``numerics.closure = "one-way"``: 11 % in contact, 5 % for a full film. If the contact
    carries the share s >= 0.85 of the load, ``min(0.11, 0.03 + 7 u/h, 0.005 + 1 - s)``. Here u is the deflection of
    the bodies by the film, which the closure leaves out (its rms over the Hertz strip), and h is the mean gap. 0 if the
    contact carries the whole load.

    At 5.5 N with isotropic roughness u/h is 0.002 there, and the rms error is below 1.1 %. A ground map across its lay
    has 0.007 and an error of 8 %: its grooves hold the fluid, which presses the bodies apart between the ridges. Errors
    of 11 % occurred about lift-off (one surface of twenty), on that map, and at 110 N with a shear-limited oil, where
    the closure counts as contact what the film carries.

    A film that carries the share 1 - s can hardly change f by more than that, because contacts and films at their limit
    rub alike. The largest error met was 0.8 (1 - s), on the ground map.
    """
    if contact_share >= 1:
        return 0.0
    if contact_share <= 0:
        return ONE_WAY_FULL_FILM
    if contact_share < MOSTLY:
        return ONE_WAY
    return min(ONE_WAY, ONE_WAY_BOUNDARY + PER_LEFT_OUT * left_out, NO_FILM + 1 - contact_share)
