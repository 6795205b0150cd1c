"""The steady line contact in Moes' similarity variables.

With the units of `lubfric.film.hertz`, x = R U1^(1/4) X, h = R U1^(1/2) H, p = E' U1^(1/4) P:

    d/dX( rho H^3/(6 eta) dP/dX ) = d(rho H)/dX                  Reynolds
    H = H00 + X^2/2 - (4/pi) ∫ (P + Pi)(X') ln|X - X'| dX'       elastic film, Pi imposed
    ∫ P dX = M                                                   load

rho and eta relative to their ambient values, d ln(eta)/dP = L at ambient pressure.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from operator import attrgetter

import numpy as np

from ..oil import density_ratio, log_viscosity_ratio
from .formulas import moes_film
from .grid import LinePressure, line_deflection
from .hertz import LineContact

STARVED = 0.1  # film of a badly starved contact, relative to the square of the inlet length


@dataclass(frozen=True)
class Problem:
    """A line contact in Moes' units, seen along its motion: X points downstream.

    inlet_length: None or metres upstream of the centre; imposed: a pressure that deflects the film in addition to its
    own, and carries none of the load.

    The seat is a cylinder that approximates the gap which an imposed pressure leaves, about seat_at [m], with
    seat_radius R and seat_modulus E' (ratios to the real ones). The film in that gap, and the dry contact of the film's
    own load, are roughly those of this cylinder. It only serves to make grids and starts.
    """

    contact: LineContact
    inlet_length: float | None = None
    imposed: LinePressure | None = None
    seat_at: float = 0.0
    seat_radius: float = 1.0
    seat_modulus: float = 1.0

    # the numbers and units of the contact: M, L [-]; units of x [m], h [m], p [Pa]
    M = property(attrgetter("contact.M"))
    L = property(attrgetter("contact.L"))
    length_unit = property(attrgetter("contact.length_unit"))
    film_unit = property(attrgetter("contact.film_unit"))
    pressure_unit = property(attrgetter("contact.pressure_unit"))

    @property
    def half_width(self) -> float:
        """Hertz half-width in units of x."""
        return math.sqrt(8.0 * self.M / math.pi)

    @property
    def imposed_load(self) -> float:
        """Load of the imposed pressure, in the units of M."""
        return 0.0 if self.imposed is None else self.M * self.imposed.load / self.contact.load_per_width

    @property
    def flat_half_width(self) -> float:
        """Hertz half-width, in units of x, of the film's own load and the imposed load together."""
        return math.sqrt(8.0 * (self.M + self.imposed_load) / math.pi)

    @property
    def seat_centre(self) -> float:
        """Centre of the seat, in units of x."""
        return self.seat_at / self.length_unit

    @property
    def seat_half_width(self) -> float:
        """Half-width, in units of x, of the dry contact of the film's own load in the gap that the imposed pressure
        leaves."""
        return math.sqrt(8.0 * self.M * self.seat_radius / (math.pi * self.seat_modulus))

    def imposed_deflection(self, X: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Deflection by the imposed pressure at ``X`` (n,), and its derivative by X."""
        if self.imposed is None:
            return np.zeros_like(X), np.zeros_like(X)
        return line_deflection(X, self.imposed.x / self.length_unit, self.imposed.pressure / self.pressure_unit)

    def alone(self) -> Problem:
        """The problem of the seat's cylinder, without imposed pressure."""
        radius, e_prime = self.contact.radius * self.seat_radius, self.contact.e_prime * self.seat_modulus
        return Problem(replace(self.contact, radius=radius, e_prime=e_prime), self.inlet_length)

    @property
    def flooded_film(self) -> float:
        """Moes' film of the cylinder of the seat, in the units of the real one."""
        root = math.sqrt(self.seat_radius * self.seat_modulus)
        return moes_film(self.M / root, self.L * self.seat_modulus / math.sqrt(root)) * self.seat_radius / root

    @property
    def film_guess(self) -> float:
        """Moes' film; less if the lubricant begins within the length on which a flooded film builds up."""
        if self.inlet_length is None:
            return self.flooded_film
        return min(self.flooded_film, STARVED * (self.inlet_length / self.length_unit) ** 2)

    def softened(self, share: float) -> Problem:
        """The same contact with ``share`` of the pressure-viscosity coefficient (same units, same M)."""
        if share == 1.0:
            return self
        oil = self.contact.lubricant
        oil = replace(oil, pressure_viscosity_coefficient=share * oil.pressure_viscosity_coefficient)
        return replace(self, contact=replace(self.contact, lubricant=oil))

    def log_viscosity(self, P) -> tuple[np.ndarray, np.ndarray]:
        """ln(eta/eta0) and its derivative with respect to P."""
        value, slope = log_viscosity_ratio(self.contact.lubricant, P * self.pressure_unit)
        return value, slope * self.pressure_unit

    def density(self, P) -> tuple[np.ndarray, np.ndarray]:
        """rho/rho0 and its derivative with respect to P."""
        value, slope = density_ratio(self.contact.lubricant, P * self.pressure_unit)
        return value, slope * self.pressure_unit
