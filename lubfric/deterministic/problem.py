"""What is solved: one rough body at rest under a smooth one that moves, with one gap and one pressure.

On a grid of cells (nx, ny), x along the motion, periodic along y:

    h = h0 + x²/(2R) - z + K p + w        gap; z heights of the rough body, w >= 0 its plastic dent
    div( U rho θ h - rho h³/(12 eta) grad p ) = 0    mass; θ = 1 where fluid fills the gap
    p >= 0, θ <= 1, p (1 - θ) = 0          rupture and refilling that keep the mass (Jakobsson-Floberg-Olsson)
    h = floor                              where the bodies touch; p there is the whole pressure
    p <= P_u, w >= 0, (P_u - p) w = 0      plastic limit, of film and contact alike
    ∫ p dx dy = load

``floor`` (1 nm) is the gap of touching surfaces. Film and contact are not added: there is one pressure.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..contact import HalfSpace
from ..film import LineContact, OfLineContact
from ..oil import Lubricant

FLOOR = 1e-9  # m


@dataclass(frozen=True)
class Problem(OfLineContact):
    """One operating point, plain values in SI units.

    contact: load, bodies, lubricant and the speed U > 0 along +x; sliding Δu >= 0 [m/s], the difference of the surface
    speeds; x [m] (nx,) centres of the cells around the line of contact; heights z [m] (nx, ny), upwards out of the
    resting body; operator: K of that grid, free along x and periodic along y; hardness P_u [Pa] (inf: elastic);
    boundary_friction: f_b [-] of the spots where the bodies touch; floor [m].
    """

    contact: LineContact
    sliding: float
    x: np.ndarray
    heights: np.ndarray
    operator: HalfSpace
    boundary_friction: float
    hardness: float = math.inf
    floor: float = FLOOR

    @property
    def spacing(self) -> tuple[float, float]:
        """(dx, dy) [m]."""
        return self.operator.spacing

    @property
    def speed(self) -> float:
        """U [m/s]."""
        return self.contact.entrainment_speed

    @property
    def lubricant(self) -> Lubricant:
        """The lubricant of the contact."""
        return self.contact.lubricant

    @cached_property
    def rigid_gap(self) -> np.ndarray:
        """x²/(2R) - z [m] (nx, ny)."""
        return (self.x**2 / (2 * self.radius))[:, None] - self.heights

    @cached_property
    def self_deflection(self) -> float:
        """Deflection of a cell by its own pressure [m/Pa]: the diagonal of K."""
        unit = np.zeros(self.heights.shape)
        middle = self.x.size // 2
        unit[middle, 0] = 1.0
        return float(self.operator.apply(unit)[middle, 0])

    @property
    def edge_log(self) -> float:
        """4 w/(pi E') [m]: far upstream the gap is less than the parabola by this times ln|x|."""
        return 4 * self.load / (math.pi * self.e_prime)

    def at_speed(self, speed: float) -> Problem:
        """The same problem on the same grid at another U [m/s], with the same ratio of sliding."""
        faster = replace(self.contact, entrainment_speed=speed)
        return replace(self, contact=faster, sliding=self.sliding * speed / self.speed)

    def with_lubricant(self, lubricant: Lubricant) -> Problem:
        """The same problem with another lubricant."""
        return replace(self, contact=replace(self.contact, lubricant=lubricant))
