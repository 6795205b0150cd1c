"""The steady line contact in Moes' similarity variables.

With the units of `lubfric.film.line_contact`, x = R U1^(1/4) X, h = R U1^(1/2) H, p = E' U1^(1/4) P:

    d/dX( rho H^3/(6 eta) dP/dX ) = d(rho H)/dX                  Reynolds
    H = H00 + X^2/2 - (4/pi) ∫ (P + Pi)(X') ln|X - X'| dX'       elastic film, Pi imposed
    ∫ P dX = M                                                   load

rho and eta relative to their ambient values, d ln(eta)/dP = L at ambient pressure.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..oil import density_ratio, log_viscosity_ratio
from .deflection import LinePressure, line_deflection
from .formulas import moes_film
from .line_contact import LineContact

STARVED = 0.1  # film of a badly starved contact, relative to the square of the inlet length


@dataclass(frozen=True)
class Seat:
    """A cylinder that approximates the gap which an imposed pressure leaves: ``radius`` R and ``modulus`` E' (ratios to
    the real ones) about ``centre`` [m].

    The film in that gap, and the dry contact of the film's own load, are roughly those of this cylinder. It only serves
    to make grids and starts.
    """

    centre: float = 0.0
    radius: float = 1.0
    modulus: float = 1.0


@dataclass(frozen=True)
class Problem:
    """A line contact in Moes' units, seen along its motion: X points downstream.

    inlet_length: None or metres upstream of the centre; imposed: a pressure that deflects the film in addition to its
    own, and carries none of the load; seat: the cylinder that approximates the gap then, for grids and starts.
    """

    contact: LineContact
    inlet_length: float | None = None
    imposed: LinePressure | None = None
    seat: Seat = Seat()

    @property
    def M(self) -> float:
        """Moes' load number."""
        return self.contact.M

    @property
    def L(self) -> float:
        """Moes' material number (0 for the constant-viscosity law)."""
        return self.contact.L

    @property
    def length_unit(self) -> float:
        """Unit of x [m]."""
        return self.contact.length_unit

    @property
    def film_unit(self) -> float:
        """Unit of h [m]."""
        return self.contact.film_unit

    @property
    def pressure_unit(self) -> float:
        """Unit of p [Pa]."""
        return self.contact.pressure_unit

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
        return self.seat.centre / self.length_unit

    @property
    def seat_half_width(self) -> float:
        """Half-width, in units of x, of the dry contact of the film's own load in the gap that the imposed pressure
        leaves."""
        return math.sqrt(8.0 * self.M * self.seat.radius / (math.pi * self.seat.modulus))

    def imposed_deflection(self, X: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Deflection by the imposed pressure at ``X`` (n,), and its derivative by X."""
        if self.imposed is None:
            return np.zeros_like(X), np.zeros_like(X)
        return line_deflection(X, self.imposed.x / self.length_unit, self.imposed.pressure / self.pressure_unit)

    def alone(self) -> Problem:
        """The problem of the seat's cylinder, without imposed pressure."""
        whole, seat = self.contact, self.seat
        cylinder = replace(whole, radius=whole.radius * seat.radius, e_prime=whole.e_prime * seat.modulus)
        return replace(self, contact=cylinder, imposed=None, seat=Seat())

    @property
    def flooded_film(self) -> float:
        """Moes' film of the cylinder of the seat, in the units of the real one."""
        seat = self.seat
        root = math.sqrt(seat.radius * seat.modulus)
        return moes_film(self.M / root, self.L * seat.modulus / math.sqrt(root)) * seat.radius / root

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
