"""Closed forms of dry smooth contact, written from the literature and without `lubfric`.

E* = E'/2 with 2/E' = sum (1 - nu^2)/E. Hertz (1882) line and point contact: K. L. Johnson, Contact Mechanics,
1985, ch. 4, doi:10.1017/CBO9781139171731; wavy line contact: H. M. Westergaard, J. Appl. Mech. 6
(1939) A49-A53, doi:10.1115/1.4008919.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.integrate import quad

from ..types import FloatArray


@dataclass(frozen=True)
class Line:
    """A cylinder on a plane: e_prime [Pa], radius [m] and the half-width b of the contact [m]."""

    e_prime: float
    radius: float
    half_width: float

    @property
    def load(self) -> float:
        """``pi E* b^2/(4 R)``, N/m."""
        return math.pi * self.e_prime / 2 * self.half_width**2 / (4 * self.radius)

    @property
    def peak(self) -> float:
        """``E* b/(2 R)``, Pa."""
        return self.e_prime / 2 * self.half_width / (2 * self.radius)

    def gap(self, x: FloatArray | float) -> FloatArray:
        """Return gap in m at x: twice the integral of the slope ``sqrt(x^2 - b^2)/(2R)`` beyond the edge."""
        t = np.maximum(np.abs(x) / self.half_width, 1.0)
        return self.half_width**2 / (2 * self.radius) * (t * np.sqrt(t**2 - 1) - np.log(t + np.sqrt(t**2 - 1)))

    def mean_gap(self, half: float) -> float:
        """Return mean of the gap [m] over |x| < half."""
        return float(quad(self.gap, self.half_width, half)[0] / half)


@dataclass(frozen=True)
class Sphere:
    """A sphere on a plane: e_prime [Pa], radius [m] and the contact radius a [m]."""

    e_prime: float
    radius: float
    contact_radius: float

    @property
    def load(self) -> float:
        """``4 E* a^3/(3 R)``, N."""
        return 4 * self.e_prime / 2 * self.contact_radius**3 / (3 * self.radius)

    @property
    def peak(self) -> float:
        """``2 E* a/(pi R)``, Pa."""
        return 2 * self.e_prime / 2 * self.contact_radius / (math.pi * self.radius)

    @property
    def approach(self) -> float:
        """``a^2/R``, m."""
        return self.contact_radius**2 / self.radius

    def gap(self, r: FloatArray | float) -> FloatArray:
        """Return gap in m at a distance r from the axis."""
        a = self.contact_radius
        r = np.maximum(r, self.contact_radius)
        inside = (2 * a**2 - r**2) * np.arcsin(a / r) + a * np.sqrt(r**2 - a**2)
        return r**2 / (2 * self.radius) - self.approach + inside / (math.pi * self.radius)


@dataclass(frozen=True)
class Wave:
    """The surface ``amplitude cos(2 pi x/length)`` on a plane. The share s is p/p*, p* closing the gap."""

    e_prime: float
    amplitude: float
    length: float
    share: float

    @property
    def mean_pressure(self) -> float:
        """``s pi E* amplitude/length``, Pa."""
        return self.share * math.pi * self.e_prime / 2 * self.amplitude / self.length

    @property
    def contact(self) -> float:
        """Share of the length in contact, ``(2/pi) asin sqrt s``."""
        return 2 / math.pi * math.asin(math.sqrt(self.share))

    @property
    def mean_gap(self) -> float:
        """``amplitude (1 - s + s ln s)`` [m]: the pressure is minus the derivative of the energy by it."""
        return self.amplitude * (1 - self.share + self.share * math.log(self.share))

    def pressure(self, x: FloatArray | float) -> FloatArray:
        """Return pressure [Pa] at x, with the crest at 0."""
        phase = math.pi * np.asarray(x) / self.length
        inside = np.sqrt(np.maximum(self.share - np.sin(phase) ** 2, 0))
        return 2 * self.mean_pressure / self.share * np.abs(np.cos(phase)) * inside
