"""Closed forms of the smooth line contact: fitted films and starved inlets.

Film formulas are in Moes' numbers M and L, and films in his unit (`lubfric.film.hertz`), unless said otherwise.
They are fits to isothermal, Newtonian, fully flooded solutions. Sources: H. Moes, Lubrication and Beyond, Univ. Twente
2000, and G. Nijenbanning, C. H. Venner, H. Moes, Wear 176 (1994) 217-229, doi:10.1016/0043-1648(94)90150-3.
"""

import math

from .._base import validate

# Factor of M^(-1/8) L^(3/4) in Grubin's film [-], by quadrature of the Hertz gap (Ertel and Grubin).
ELASTIC_PIEZOVISCOUS = 1.311


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
    """Return the film of a contact over the flooded one where its lubricant begins ``inlet`` upstream of the centre.
    ``length``: l = √(2 R h_flooded), ``half_width``: b of the dry contact. ``1 - (1 + X/c)^-2`` with X = (inlet - b)/s,
    s of `flooded_inlet` and c from 1 (b far below l) to 0.39: within 0.12 of own solutions at b/l = 0.03 to 13."""
    x = max(inlet - half_width, 0.0) / flooded_inlet(length, half_width)
    return 1.0 - (1.0 + x / _narrowness(length, half_width)) ** -2


def starved_inlet(share: float, length: float, half_width: float) -> float:
    """Return where the lubricant begins for a ``share`` of the flooded film, below 1: the inverse of
    `starved_share`."""
    x = _narrowness(length, half_width) * ((1.0 - share) ** -0.5 - 1.0)
    return half_width + x * flooded_inlet(length, half_width)


def flooded_inlet(length: float, half_width: float) -> float:
    """Return how far upstream of the dry contact a flooded film builds up: ``3.52 (R h_flooded)^(2/3) b^(-1/3)`` (L. D.
    Wedeven, D. Evans, A. Cameron, J. Lubr. Technol. 93 (1971) 349-363; the number is cited from memory) where
    the half-width b is far above l = √(2 R h_flooded) (``length``); b + l takes the place of b."""
    return 3.52 * 0.25 ** (1 / 3) * length * (length / (length + half_width)) ** (1 / 3)


def _narrowness(length: float, half_width: float) -> float:
    return 1.0 / (1.0 + 1.54 * half_width / (half_width + length))
