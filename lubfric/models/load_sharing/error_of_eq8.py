"""The error of f by the load-sharing model itself (docs/uncertainty.md)."""

import math
from dataclasses import dataclass

from ..shared import Sides

# Error of the load on asperities over sqrt(s (1 - s)) of the total load, s = F_C/F_T. The constants of this module
# cover 95 % and more of the differences from deterministic answers: `python -m verification model --only answers`,
# docs/measurements.md.
OF_SHARE = 0.7

# Error of f in contact over sqrt(1 - s), from some s = 0.1 on. Measured by that command.
IN_CONTACT = 0.25

# Error of the shear force of the film times the square of the film-to-roughness ratio (central film over Sq), over that
# force. Measured by that command.
OF_FILM = 3.2

# Error of the shear force of the film over that force, at most. Measured by that command.
MOST_OF_FILM = 0.3

# Factor on the rolling force: what pressure on the flanks of moving roughness may add; up to 7 were seen (`python -m
# verification model --only rolling`).
OF_ROLLING = 8.0

# Smallest and largest rolling part of f over its value where no roughness moves: they bound intervals. A choice: none
# was seen above 1.
STATIONARY_ROLLING_RATIOS = (0.0, 2.0)

# Error of f towards 0 and away from it, over the filled part of the gap, where a given film arrives (`starved_error`).
# Measured by that command.
STARVED_ERROR = Sides(0.5, 0.1)

# Least error of f over the film-to-roughness ratio, up to 1, where there is a film between rough surfaces. Measured by
# that command.
LEAST_WITH_FILM = 0.1

# Part of the asperity load, over the film-to-roughness ratio, that film at the limiting stress of an oil may carry [-];
# all of it at most. At .3 and .6 the asperity load ratio of the load-sharing model is .57 to .62 and .41 to .44, that of
# the deterministic one .10 to .63 and .01 to .35 (`python -m verification model --only rolling`).
AS_FILM = 5.0

# Film-to-roughness ratio from which the flanks add less, with the square of it: 2.4 times the rolling force were seen
# at 2. A choice below it.
FLANKS = 1.5


def load_sharing_error(
    film_to_roughness_ratio: float, *, share: float, boundary: float, shear: float, rolling: float = 0.0
) -> Sides:
    """Return the relative error of f by Eq. (8), at 95 % (docs/uncertainty.md), towards 0 and away from it.

    ``film_to_roughness_ratio``: r, the central film over Sq; ``share``: s = F_C/F_T; ``boundary``, ``shear``: the two
    parts of f, of asperities and film; ``rolling``: the part of rolling in the latter, if roughness moves. Four things
    may be off: the load that asperities carry, by up to 0.7 sqrt(s (1 - s)) of the whole, but never below 0 or above
    the whole, which exchanges the friction of one part for that of the other; the shear of the film, which is that of
    smooth surfaces, by 3.2/r² of it, at most 30 %; in contact all of f by 0.25 sqrt(1 - s), but by no more than what
    0.7 sqrt(s (1 - s)) of the load rubs on asperities or film, whichever is more, so that it begins with the contact:
    towards 0, of what the others leave; and the pressure on the flanks of moving roughness, which is omitted, by up to
    8 times the rolling force, and 18/r² times for thick films. 0 without roughness.
    """
    f = abs(boundary + shear)
    if film_to_roughness_ratio == math.inf or f == 0:
        return Sides(0.0, 0.0)
    parts = load_sharing_error_parts(
        film_to_roughness_ratio, share=share, boundary=boundary, shear=shear, rolling=rolling
    )
    of_film = (parts.of_film + parts.of_flanks) / f
    towards, away = (of_film + each / f for each in parts.of_share)
    of_all = parts.in_contact / f
    return Sides(towards + max(1 - towards, 0.0) * of_all, away + of_all)


@dataclass(frozen=True, kw_only=True)
class LoadSharingErrorParts:
    """The parts of `load_sharing_error`, in f itself.

    Attributes
    ----------
    of_share : by how film and asperities divide the load, towards 0 and away from it
    of_film : by the shear of the film, as that of smooth surfaces
    of_flanks : by the pressure on the flanks of moving roughness
    in_contact : of all friction in contact
    """

    of_share: Sides
    of_film: float
    of_flanks: float
    in_contact: float


def rolling_ratios_of(*, omits_flanks: bool) -> tuple[float, float]:
    """Return the smallest and the largest that the rolling part of f may be, over its value. ``omits_flanks``: whether
    the pressure on the flanks of moving roughness is omitted, which may have the other sign."""
    return (-OF_ROLLING, OF_ROLLING) if omits_flanks else STATIONARY_ROLLING_RATIOS


def load_sharing_error_parts(
    film_to_roughness_ratio: float, *, share: float, boundary: float, shear: float, rolling: float = 0.0
) -> LoadSharingErrorParts:
    """Return the parts of `load_sharing_error`, whose arguments these are; the ratio is finite."""
    of_flanks = OF_ROLLING * min(1.0, (FLANKS / film_to_roughness_ratio) ** 2) * abs(rolling)
    of_film = min(MOST_OF_FILM, OF_FILM / film_to_roughness_ratio**2) * abs(shear)
    if not 0 < share < 1:
        return LoadSharingErrorParts(of_share=Sides(0.0, 0.0), of_film=of_film, of_flanks=of_flanks, in_contact=0.0)
    f = boundary + shear
    on_asperities = boundary / share
    on_film = shear / (1 - share)
    exchanged = on_asperities - on_film
    # asperities that rub more than the film, in the sense of f: less load on them leads towards 0
    rooms = (share, 1 - share) if exchanged * f > 0 else (1 - share, share)
    of_share = OF_SHARE * math.sqrt(share * (1 - share))
    towards, away = (min(of_share, room) * abs(exchanged) for room in rooms)
    return LoadSharingErrorParts(
        of_share=Sides(towards, away),
        of_film=of_film,
        of_flanks=of_flanks,
        in_contact=min(IN_CONTACT * math.sqrt(1 - share) * abs(f), of_share * max(abs(on_asperities), abs(on_film))),
    )


def starved_error(inlet_film: float, gap: float) -> Sides:
    """Return the relative error of f by Eq. (8), at 95 %, towards 0 and away from it, where a given film arrives.

    Eq. (8) takes a film that does not fill the gap for none, and f = f_b. The deterministic model finds lubricant
    between the asperities that lowers f, the more of the gap it fills: by 7 % at half and by 33 % at all of it (scene
    `paper` with 80 and 160 nm). ``inlet_film`` [m]: that arrives; ``gap`` [m]: mean gap of the rough surfaces.
    """
    filled = min(inlet_film / gap, 1.0) if gap > 0 else 1.0
    return Sides(STARVED_ERROR.towards * filled, STARVED_ERROR.away * filled)


def least_error(film_to_roughness_ratio: float, share: float) -> float:
    """Return the least relative error of f by Eq. (8) where a film is present, however much of the load the asperities
    carry: it does not vanish with the load of the film. Where the ``share`` of the asperities vanishes, it does so with
    the error of that share."""
    return min(LEAST_WITH_FILM * min(film_to_roughness_ratio, 1.0), OF_SHARE * math.sqrt(share))


def error_of_share(film_to_roughness_ratio: float, share: float, *, may_be_film: bool = False) -> float:
    """Return the error of the ``share`` of the asperities in the load [-], at 95 %; ``may_be_film``: whether films at a
    limiting stress may carry it (`AS_FILM`)."""
    of_share = OF_SHARE * math.sqrt(max(share * (1.0 - share), 0.0))
    as_film = share * min(AS_FILM * film_to_roughness_ratio, 1.0) if may_be_film else 0.0
    return max(of_share, as_film)


def largest_film_load_ratio(film_to_roughness_ratio: float, share: float) -> float:
    """Return the largest part of the load [-] that the film carries, by the model-form error of the ``share`` of the
    asperities; ``film_to_roughness_ratio``: not finite where there is no film."""
    of_share = error_of_share(film_to_roughness_ratio, share)
    least = least_error(film_to_roughness_ratio, share) if math.isfinite(film_to_roughness_ratio) else 0.0
    return min(1.0 - min(share, 1.0) + max(of_share, least), 1.0)
