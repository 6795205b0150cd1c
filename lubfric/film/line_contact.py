"""The smooth line contact as one value: load, bodies, speed and lubricant, and the numbers that follow directly from
them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

from .._base import validate
from ..errors import InputError
from ..oil import Lubricant
from . import formulas, hertz, rigid_cylinder


@dataclass(frozen=True)
class LineContact:
    """A cylinder of radius R on a plane, pressed and lubricated; checked when made.

    load_per_width : w > 0 [N/m]
    radius : reduced radius R > 0 [m], 1/R = 1/R1 + 1/R2
    e_prime : reduced modulus E' > 0 [Pa], 2/E' = sum (1 - nu²)/E
    entrainment_speed : U = (u1 + u2)/2 [m/s], not 0; a negative one mirrors the film
    lubricant : `lubfric.Lubricant`

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

    def __post_init__(self):
        speed = validate.number("entrainment_speed", self.entrainment_speed, "m/s")
        if speed == 0.0:
            raise InputError("entrainment_speed = 0 m/s carries no steady film; give another speed")
        if not isinstance(self.lubricant, Lubricant):
            raise InputError(f"lubricant = {self.lubricant!r} is not a Lubricant; allowed: lubfric.Lubricant")
        object.__setattr__(self, "entrainment_speed", speed)
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
        return float(hertz.line_half_width(self.load_per_width, self.radius, self.e_prime))

    @cached_property
    def peak_pressure(self) -> float:
        """Hertz pressure 2 w/(pi b) [Pa] at the centre of the dry contact."""
        return float(hertz.line_peak_pressure(self.load_per_width, self.radius, self.e_prime))

    @cached_property
    def moes_film(self) -> float:
        """Moes' film h [m] where dp/dx = 0, a regression within some 5 to 10 % (`lubfric.film.formulas.moes_film`)."""
        return self.film_unit * formulas.moes_film(self.M, self.L)

    @cached_property
    def rigid_film(self) -> float:
        """Smallest film [m] of rigid bodies and constant viscosity, 4.895 eta0 |U| R/w."""
        return rigid_cylinder.isoviscous_min_film(
            load_per_width=self.load_per_width,
            radius=self.radius,
            entrainment_speed=abs(self.entrainment_speed),
            viscosity=self.lubricant.viscosity,
        )


class OfLineContact:
    """Base of what is solved or found for a ``contact``, a `LineContact`: its numbers, by the names of a film."""

    contact: LineContact

    @property
    def load(self) -> float:
        """w [N/m]: what the film carries."""
        return self.contact.load_per_width

    @property
    def radius(self) -> float:
        """R [m]."""
        return self.contact.radius

    @property
    def e_prime(self) -> float:
        """E' [Pa]."""
        return self.contact.e_prime

    @property
    def entrainment_speed(self) -> float:
        """U [m/s]."""
        return self.contact.entrainment_speed
