"""The lubricated line contact as one value, and the frictionless elastic contact of smooth cylinders
(Hertz 1882).

Everywhere ``2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2`` and ``1/R = 1/R1 + 1/R2``. Valid while the contact is small
compared with R, so that each body is a half-space, and stresses are elastic. Source: K. L. Johnson, Contact Mechanics,
1985, Sec. 4.2, doi:10.1017/CBO9781139171731.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from operator import attrgetter

import numpy as np
from numpy.typing import ArrayLike

from .._base import FloatArray, validate
from ..errors import InputError
from ..oil import Lubricant
from . import formulas

# Smallest film of a rigid cylinder over eta0 |U| R/w [-], isoviscous, Swift-Stieber rupture (exact): it follows from
# Reynolds' equation for the parabola for the cylinder.
RIGID_FILM_FACTOR = 4.894968493913369


def composite_modulus(young_1: float, poisson_1: float, young_2: float, poisson_2: float) -> float:
    """Return E' [Pa] of two bodies with Young's moduli [Pa] and Poisson ratios [-]: ``2/E' = (1 - nu1^2)/E1 + (1 -
    nu2^2)/E2``.

    Raises `InputError` unless E > 0 and -1 <= nu <= 0.5. A rigid body has ``young = math.inf``.
    """
    compliance = 0.0
    for i, (e, nu) in enumerate(((young_1, poisson_1), (young_2, poisson_2)), start=1):
        nu = validate.number(f"poisson_{i}", nu, "(-)", minimum=-1.0, maximum=0.5)
        if e != np.inf:
            compliance += (1 - nu**2) / validate.positive(f"young_{i}", e, "Pa")
    return 2 / validate.positive("compliance of the two bodies (1 - nu^2)/E", compliance, "1/Pa")


def line_half_width(load_per_width: float, radius: float, e_prime: float) -> float:
    """Return b [m] = sqrt(8 w R / (pi E')); w [N/m], R [m], E' [Pa]."""
    return np.sqrt(8 * load_per_width * radius / (np.pi * e_prime))


def line_peak_pressure(load_per_width: float, radius: float, e_prime: float) -> float:
    """Return p_h [Pa] = 2 w / (pi b)."""
    return 2 * load_per_width / (np.pi * line_half_width(load_per_width, radius, e_prime))


def line_pressure(x: ArrayLike, load_per_width: float, radius: float, e_prime: float) -> float | FloatArray:
    """Return p(x) [Pa] = p_h sqrt(1 - x^2/b^2) inside, 0 outside; x [m] from the centre line."""
    ratio = np.asarray(x) / line_half_width(load_per_width, radius, e_prime)
    return line_peak_pressure(load_per_width, radius, e_prime) * np.sqrt(np.maximum(1 - ratio**2, 0))


def line_gap(x: ArrayLike, load_per_width: float, radius: float, e_prime: float) -> float | FloatArray:
    """Return the gap [m] of the loaded contact, 0 inside; with X = |x|/b >= 1, ``g = b^2/(2R) [X sqrt(X^2-1) - ln(X +
    sqrt(X^2-1))]``."""
    b = line_half_width(load_per_width, radius, e_prime)
    big = np.maximum(np.abs(np.asarray(x)) / b, 1.0)
    return b**2 / (2 * radius) * (big * np.sqrt(big**2 - 1) - np.arccosh(big))


@dataclass(frozen=True, kw_only=True)
class LineContact:
    """A cylinder of radius R on a plane, pressed and lubricated; checked when made.

    load_per_width : w > 0 [N/m]
    radius : reduced radius R > 0 [m], 1/R = 1/R1 + 1/R2
    e_prime : reduced modulus E' > 0 [Pa], 2/E' = sum (1 - nu²)/E
    entrainment_speed : U = (u1 + u2)/2 [m/s], not 0; a negative one mirrors the film
    lubricant : `lubfric.Lubricant`
    sliding : u2 - u1 [m/s], with which shear thins the flow of the film (`lubfric.film.thinning`); None: Newtonian flow

    Moes' units of length, film and pressure are x = R U1^(1/4) X, h = R U1^(1/2) H, p = E' U1^(1/4) P with
    U1 = 2 eta0 |U|/(E' R) (H. Moes, Wear 159 (1992) 57-66).
    ``dataclasses.replace`` makes the contact of another load, speed, modulus or lubricant.

    Raises `InputError` for a value out of range.
    """

    load_per_width: float
    radius: float
    e_prime: float
    entrainment_speed: float
    lubricant: Lubricant
    sliding: float | None = None

    def __post_init__(self) -> None:
        speed = validate.number("entrainment_speed", self.entrainment_speed, "m/s")
        if speed == 0.0:
            raise InputError("entrainment_speed = 0 m/s carries no steady film; give another speed")
        validate.instance("lubricant", self.lubricant, Lubricant, "a lubfric.Lubricant")
        object.__setattr__(self, "entrainment_speed", speed)
        if self.sliding is not None:
            object.__setattr__(self, "sliding", validate.number("sliding", self.sliding, "m/s"))
        for name, unit in (("load_per_width", "N/m"), ("radius", "m"), ("e_prime", "Pa")):
            object.__setattr__(self, name, validate.positive(name, getattr(self, name), unit))

    @cached_property
    def speed_number(self) -> float:
        """U1 = 2 eta0 |U|/(E' R) [-]."""
        return self.lubricant.viscosity * 2 * abs(self.entrainment_speed) / (self.e_prime * self.radius)

    @cached_property
    def length_unit(self) -> float:
        """Moes' unit of x [m]."""
        return self.radius * self.speed_number**0.25

    @cached_property
    def film_unit(self) -> float:
        """Moes' unit of h [m]."""
        return self.radius * math.sqrt(self.speed_number)

    @cached_property
    def pressure_unit(self) -> float:
        """Moes' unit of p [Pa]."""
        return self.e_prime * self.speed_number**0.25

    @cached_property
    def M(self) -> float:
        """Moes' load number w/(E' R sqrt(U1)) [-]."""
        return self.load_per_width / (self.e_prime * self.film_unit)

    @cached_property
    def L(self) -> float:
        """Moes' material number alpha E' U1^(1/4) [-]; 0 for the constant-viscosity law."""
        if self.lubricant.viscosity_law == "constant":
            return 0.0
        return self.lubricant.pressure_viscosity_coefficient * self.pressure_unit

    @cached_property
    def half_width(self) -> float:
        """Hertz half-width b [m] of the dry contact."""
        return float(line_half_width(self.load_per_width, self.radius, self.e_prime))

    @cached_property
    def moes_film(self) -> float:
        """Moes' film h [m] where dp/dx = 0, a regression within some 5 to 10 % (`lubfric.film.formulas.moes_film`)."""
        return self.film_unit * formulas.moes_film(self.M, self.L)

    @cached_property
    def expected_film(self) -> float:
        """Return `moes_film` [m], as much thinner as shear and a starved inlet make it with closed forms; a rough
        guess. Shear thins it where the law of the flow is a power law at large rates
        (`ShearLaw.power_law_exponent`)."""
        return self.expected_film_with(1.0)

    def expected_film_with(self, inlet_factor: float) -> float:
        """Return `expected_film` [m] where the heat of the inlet multiplies what flows in by ``inlet_factor`` [-]. A
        given film that arrives (``inlet_film``) limits it, however warm the inlet is."""
        film = self.moes_film
        oil = self.lubricant
        law = oil.flow_law
        exponent = law.power_law_exponent if law is not None and law.thins else None
        if law is not None and exponent is not None and self.sliding is not None:
            number = oil.viscosity * abs(self.entrainment_speed) / (film * law.critical(0.0)[0])
            film *= formulas.thinned_share(number, exponent, self.sliding / self.entrainment_speed)
        if oil.inlet_length is not None:
            film *= formulas.starved_share(oil.inlet_length, math.sqrt(2 * self.radius * film), self.half_width)
        film *= inlet_factor
        return film if oil.inlet_film is None else min(film, oil.inlet_film)

    @property
    def starved_film(self) -> float:
        """Return `moes_film` [m], as much thinner as a starved inlet makes it with a closed form
        (`lubfric.film.formulas.starved_share`)."""
        film = self.moes_film
        inlet = self.lubricant.inlet_length
        if inlet is None:
            return film
        return film * formulas.starved_share(inlet, math.sqrt(2 * self.radius * film), self.half_width)

    @cached_property
    def rigid_film(self) -> float:
        """Smallest film [m] of rigid bodies and constant viscosity, 4.895 eta0 |U| R/w (H. M. Martin, Engineering 102
        (1916) 119; rupture where p = dp/dx = 0)."""
        return (
            RIGID_FILM_FACTOR
            * self.lubricant.viscosity
            * abs(self.entrainment_speed)
            * self.radius
            / self.load_per_width
        )


class HasLineContact:
    """Base of what is solved or found for a ``line``, a `LineContact`: its numbers, by the names of a film."""

    line: LineContact

    load = property(attrgetter("line.load_per_width"), doc="w [N/m]: what the film carries.")
    radius = property(attrgetter("line.radius"), doc="R [m].")
    e_prime = property(attrgetter("line.e_prime"), doc="E' [Pa].")
    entrainment_speed = property(attrgetter("line.entrainment_speed"), doc="U [m/s].")
