"""Regime numbers and film formulas of the smooth line contact.

``U1 = eta0 u_s/(E' R)`` with u_s = 2 U, ``W = w/(E' R)``; Moes: ``M = W/sqrt(U1)``,
``L = alpha E' U1^(1/4)``, film ``H = (h/R)/sqrt(U1)``. All formulas are fits to isothermal,
Newtonian, fully flooded solutions. Sources: H. Moes, Lubrication and Beyond, Univ. Twente 2000,
and G. Nijenbanning, C. H. Venner, H. Moes, Wear 176 (1994) 217-229, doi:10.1016/0043-1648(94)90150-3;
D. Dowson, G. R. Higginson, Elasto-Hydrodynamic Lubrication, Pergamon 1966;
D. Dowson, S. Toyoda, Proc. 5th Leeds-Lyon Symposium on Tribology (1978) 60-65.
"""

from __future__ import annotations

import math

from .._base import validate


def speed_number(*, radius, e_prime, entrainment_speed, viscosity) -> float:
    """U1 = eta0 2U/(E' R); radius [m], e_prime [Pa], entrainment_speed U [m/s], viscosity [Pa s]."""
    return viscosity * 2 * entrainment_speed / (e_prime * radius)


def moes_numbers(
    *, load_per_width, radius, e_prime, entrainment_speed, viscosity, pressure_viscosity_coefficient
) -> tuple[float, float]:
    """(M, L) from w [N/m], R [m], E' [Pa], U > 0 [m/s], eta0 [Pa s], alpha [1/Pa]."""
    validate.positive("entrainment_speed", entrainment_speed, "m/s")
    u1 = speed_number(radius=radius, e_prime=e_prime, entrainment_speed=entrainment_speed, viscosity=viscosity)
    return load_per_width / (e_prime * (radius * math.sqrt(u1))), pressure_viscosity_coefficient * (e_prime * u1**0.25)


def load_and_speed(m, l, *, radius, e_prime, viscosity, pressure_viscosity_coefficient) -> tuple[float, float]:
    """(load_per_width [N/m], entrainment_speed [m/s]) that have the Moes numbers M > 0, L > 0.

    L = 0 fixes no speed: raises `InputError`.
    """
    validate.positive("m", m, "(-)")
    validate.positive("l", l, "(-)")
    validate.positive("pressure_viscosity_coefficient", pressure_viscosity_coefficient, "1/Pa")
    u1 = (l / (pressure_viscosity_coefficient * e_prime)) ** 4
    return m * math.sqrt(u1) * e_prime * radius, u1 * e_prime * radius / (2 * viscosity)


ELASTIC_PIEZOVISCOUS = 1.311  # of M^(-1/8) L^(3/4), Grubin's film


def moes_film(m, l) -> float:
    """H in Moes units where dp/dx = 0 (the *flow* film), incompressible lubricant; M > 0, L >= 0.

    Joins the four asymptotes H_RI = 3/M, H_EI = 2.621 M^(-1/5), H_RP = 1.287 L^(2/3) and
    H_EP = 1.311 M^(-1/8) L^(3/4); within about 5 % of converged solutions for M 5..100, L 5..10.
    Below L = 1e-6 the viscosity counts as constant.
    """
    validate.positive("m", m, "(-)")
    validate.nonnegative("l", l, "(-)")
    h_ri, h_ei = 3.0 / m, 2.621 * m**-0.2
    s = (7.0 + 8.0 * math.exp(-2.0 * h_ei / h_ri)) / 5.0
    isoviscous = (h_ri ** (7 / 3) + h_ei ** (7 / 3)) ** (3 / 7)
    if l < 1e-6:
        return isoviscous
    piezoviscous = ((1.287 * l ** (2 / 3)) ** -3.5 + (ELASTIC_PIEZOVISCOUS * m**-0.125 * l**0.75) ** -3.5) ** (-2 / 7)
    larger, smaller = max(isoviscous, piezoviscous), min(isoviscous, piezoviscous)
    return larger * (1.0 + (smaller / larger) ** s) ** (1.0 / s)


def moes_flow_film(
    *, load_per_width, radius, e_prime, entrainment_speed, viscosity, pressure_viscosity_coefficient
) -> float:
    """`moes_film` in metres."""
    m, l = moes_numbers(
        load_per_width=load_per_width,
        radius=radius,
        e_prime=e_prime,
        entrainment_speed=entrainment_speed,
        viscosity=viscosity,
        pressure_viscosity_coefficient=pressure_viscosity_coefficient,
    )
    u1 = speed_number(radius=radius, e_prime=e_prime, entrainment_speed=entrainment_speed, viscosity=viscosity)
    return radius * math.sqrt(u1) * moes_film(m, l)


def dowson_higginson_min_film(
    *, load_per_width, radius, e_prime, entrainment_speed, viscosity, pressure_viscosity_coefficient
) -> float:
    """*Minimum* film [m]: h_min/R = 2.65 U^0.70 G^0.54 W^-0.13, U = eta0 U/(E' R), G = alpha E'.

    Fitted in the piezoviscous-elastic regime (about U 1e-13..1e-11, W 1e-5..3e-4, G 2500..7500).
    """
    speed_viscosity = entrainment_speed * viscosity
    exponents = (0.70, 0.54, -0.13)
    return _power_law(2.65, exponents, load_per_width, radius, e_prime, speed_viscosity, pressure_viscosity_coefficient)


def dowson_toyoda_central_film(
    *, load_per_width, radius, e_prime, entrainment_speed, viscosity, pressure_viscosity_coefficient
) -> float:
    """*Central* film [m] of a compressible lubricant: h_c/R = 3.06 U^0.69 G^0.56 W^-0.10, numbers as
    in `dowson_higginson_min_film`. Up to 13 % from converged solutions at M 5..100, L 5..10."""
    speed_viscosity = entrainment_speed * viscosity
    exponents = (0.69, 0.56, -0.10)
    return _power_law(3.06, exponents, load_per_width, radius, e_prime, speed_viscosity, pressure_viscosity_coefficient)


def _power_law(factor, exponents, load_per_width, radius, e_prime, speed_viscosity, alpha) -> float:
    """R factor U^a G^b W^c, ``exponents`` (a, b, c)."""
    u, g, w = speed_viscosity / (e_prime * radius), alpha * e_prime, load_per_width / (e_prime * radius)
    a, b, c = exponents
    return radius * factor * u**a * g**b * w**c
