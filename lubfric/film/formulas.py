"""Closed forms of the smooth line contact: fitted films and starved inlets.

Film formulas are in Moes' numbers M and L, and films in his unit (`lubfric.film.hertz`), unless said otherwise.
They are fits to isothermal, Newtonian, fully flooded solutions. Sources: H. Moes, Lubrication and Beyond, Univ. Twente
2000, and G. Nijenbanning, C. H. Venner, H. Moes, Wear 176 (1994) 217-229, doi:10.1016/0043-1648(94)90150-3.
"""

import math

from .._base import validate

# Factor of M^(-1/8) L^(3/4) in Grubin's film [-], by quadrature of the Hertz gap (Ertel and Grubin). The power law is
# that of Moes (2000).
ELASTIC_PIEZOVISCOUS = 1.311

# Part by which the least film of a rigid contact is thinner than that which flows: 1 - 1/1.226, Reynolds' condition. It
# follows from Reynolds' equation with a constant viscosity.
REYNOLDS_THINNING = 0.184

# Half-width of the dry contact over l at which it is half narrow [-] (`starved_share`, where the fit is described).
# Measured on 185 solutions.
NARROW = 0.085

# Exponent n of the starved film in a wide contact [-], and what a narrow one adds. Measured on the solutions of
# `starved_share`.
WIDE_EXPONENT = 2.0
MORE_EXPONENT = 6.0

# Scale c of the starved film in a wide contact [-], and what a narrow one adds. Measured on the solutions of
# `starved_share`.
WIDE_SCALE = 0.333
MORE_SCALE = 6.0


def moes_film(m: float, l: float) -> float:
    """Return H in Moes units where dp/dx = 0 (the *flow* film), incompressible lubricant; M > 0, L >= 0.

    Joins the four asymptotes H_RI = 3/M, H_EI = 2.621 M^(-1/5), H_RP = 1.287 L^(2/3) and
    H_EP = 1.311 M^(-1/8) L^(3/4); within about 5 % of converged solutions for M 5..100, L 5..10.
    Below L = 1e-6 the viscosity counts as constant.
    """
    validate.positive("m", m, "(-)")
    validate.nonnegative("l", l, "(-)")
    h_ri = 3.0 / m
    h_ei = 2.621 * m**-0.2
    s = (7.0 + 8.0 * math.exp(-2.0 * h_ei / h_ri)) / 5.0
    isoviscous = (h_ri ** (7 / 3) + h_ei ** (7 / 3)) ** (3 / 7)
    if l < 1e-6:
        return isoviscous
    piezoviscous = ((1.287 * l ** (2 / 3)) ** -3.5 + (ELASTIC_PIEZOVISCOUS * m**-0.125 * l**0.75) ** -3.5) ** (-2 / 7)
    larger = max(isoviscous, piezoviscous)
    smaller = min(isoviscous, piezoviscous)
    return larger * (1.0 + (smaller / larger) ** s) ** (1.0 / s)


def smallest_film(film: float, length: float, half_width: float) -> float:
    """Return the smallest film about a contact whose ``film`` is known where dp/dx = 0. ``length``: l = √(2 R h),
    ``half_width``: b of the dry contact. ``h (1 - 0.184 l/(l + b))``: that of a rigid cylinder for a narrow contact,
    and h for a wide one."""
    return film * (1.0 - REYNOLDS_THINNING * length / (length + half_width))


def thinned_share(number: float, exponent: float, slide_roll_ratio: float) -> float:
    """Return the film of a Carreau fluid over the Newtonian one h: ``(1 + 0.79 ((1 + S) N)^(1/(1 + 0.2 S)))^(-3.6 (1 -
    n)^1.7)`` with ``number`` N = eta0 U/(h G), ``exponent`` n and the slide-roll ratio S.

    S. Bair, Proc. Inst. Mech. Eng. J 219 (2005) 69-74, cited from memory, as no second place with its numbers was
    found. 40 own films (M, L from 20, 10 up; N from 0.05 to 3, S from 0 to 2, n from 0.5 to 0.8) are up to 13 % off.
    """
    sliding = abs(slide_roll_ratio)
    thinning = 0.79 * ((1.0 + sliding) * number) ** (1.0 / (1.0 + 0.2 * sliding))
    return (1.0 + thinning) ** (-3.6 * (1.0 - exponent) ** 1.7)


def starved_share(inlet: float, length: float, half_width: float) -> float:
    """Return the film (where dp/dx = 0) of a contact over the flooded one where its lubricant begins ``inlet`` upstream
    of the centre. ``length``: l = √(2 R h_flooded), ``half_width``: b of the dry contact.

    ``1 - (1 + x/c)^-n`` with x = (inlet - (1 - t) b)/s, s of `flooded_inlet`, t = 1/(1 + (b/(0.085 l))²), n = 2 + 6 t
    and c = 0.333 + 6 t: t is 1 for a narrow contact, whose film begins to carry at its centre, and 0 for a wide one. A
    fit to 185 own solutions at b/l = 0.004 to 24, L = 0.8 to 23 and (inlet - b)/s = 0.1 to 2: within 0.06 where b <
    0.15 l, and within 0.1 elsewhere, but up to 0.18 below where L < 1.
    """
    narrow = _narrowness(length, half_width)
    x = max(inlet - (1.0 - narrow) * half_width, 0.0) / flooded_inlet(length, half_width)
    return 1.0 - (1.0 + x / _scale(narrow)) ** -_exponent(narrow)


def starved_inlet(share: float, length: float, half_width: float) -> float:
    """Return where the lubricant begins for a ``share`` of the flooded film, below 1: the inverse of
    `starved_share`, but not inside the dry contact."""
    narrow = _narrowness(length, half_width)
    x = _scale(narrow) * ((1.0 - share) ** (-1.0 / _exponent(narrow)) - 1.0)
    return max((1.0 - narrow) * half_width + x * flooded_inlet(length, half_width), half_width)


def flooded_inlet(length: float, half_width: float) -> float:
    """Return how far upstream of the dry contact a flooded film builds up: ``3.52 (R h_flooded)^(2/3) b^(-1/3)`` (L. D.
    Wedeven, D. Evans, A. Cameron, J. Lubr. Technol. 93 (1971) 349-363; the number is cited from memory) where
    the half-width b is far above l = √(2 R h_flooded) (``length``); b + l takes the place of b."""
    return 3.52 * 0.25 ** (1 / 3) * length * (length / (length + half_width)) ** (1 / 3)


def _narrowness(length: float, half_width: float) -> float:
    """Return t of `starved_share`: 1 for a contact far narrower than its inlet, 0 for one far wider."""
    return 1.0 / (1.0 + (half_width / (NARROW * length)) ** 2)


def _exponent(narrow: float) -> float:
    return WIDE_EXPONENT + MORE_EXPONENT * narrow


def _scale(narrow: float) -> float:
    return WIDE_SCALE + MORE_SCALE * narrow
