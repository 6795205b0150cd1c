"""The line contact: two bodies, pressed together."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .._base import Brief, validate
from ..errors import InputError
from ..film import hertz


@dataclass(frozen=True, repr=False)
class Bodies(Brief):
    """The line contact: a cylinder on a plane, or the nominally flat strip under it.

    Attributes
    ----------
    radius : reduced radius R [m]
    width : length of the line B [m]
    load : total load F_T [N]
    e_prime : E' [Pa], 2/E' = (1-nu1²)/E1 + (1-nu2²)/E2
    hardness : plastic limit P_u of the contact pressure [Pa]; None: elastic
    boundary_friction_coefficient : f_b of the contact spots [-]
    conductivity : of both bodies [W/(m K)]; they carry the heat of the film away (default: steel)
    volumetric_heat : rho c of both bodies [J/(m³ K)]
    """

    radius: float
    width: float
    load: float
    e_prime: float
    boundary_friction_coefficient: float
    hardness: float | None = None
    conductivity: tuple[float, float] = (46.0, 46.0)
    volumetric_heat: tuple[float, float] = (3.6e6, 3.6e6)

    def __post_init__(self):
        validate.python_fields(self)
        validate.positive("bodies.radius", self.radius, "m", minimum=1e-9, maximum=1e3)
        validate.positive("bodies.width", self.width, "m", minimum=1e-9, maximum=1e3)
        validate.positive("bodies.load", self.load, "N", minimum=1e-12, maximum=1e12)
        validate.number("bodies.e_prime", self.e_prime, "Pa", minimum=1e3, maximum=1e13)
        validate.nonnegative(
            "bodies.boundary_friction_coefficient", self.boundary_friction_coefficient, "(-)", maximum=10.0
        )
        if self.hardness is not None:
            validate.positive("bodies.hardness", self.hardness, "Pa", minimum=1.0, maximum=1e14)
            if self.mean_hertz_pressure >= self.hardness:
                raise InputError(
                    f" = {self.load:g} N is above hardness x Hertz area",
                    "bodies.load",
                    f"below {self.hardness * 2 * self.half_width * self.width:g} N",
                    also=("bodies.hardness",),
                )

        for name, unit in (("conductivity", "W/(m K)"), ("volumetric_heat", "J/(m^3 K)")):
            both = getattr(self, name)
            if not isinstance(both, (tuple, list)) or len(both) != 2:
                raise InputError(f"bodies.{name} = {both!r} must be a pair, one value a body [{unit}]")
            object.__setattr__(self, name, tuple(validate.positive(f"bodies.{name}", v, unit) for v in both))

    @property
    def effusivity(self) -> tuple[float, float]:
        """sqrt(k rho c) of both bodies [J/(m^2 K s^0.5)]."""
        first, second = (math.sqrt(k * c) for k, c in zip(self.conductivity, self.volumetric_heat))
        return first, second

    @property
    def half_width(self) -> float:
        """Hertz half-width b [m] of the total load, b = sqrt(8 w R/(pi E'))."""
        return hertz.line_half_width(self.load / self.width, self.radius, self.e_prime)

    @property
    def strip_rise(self) -> float:
        """b²/(6 R) [m]: the mean rise of the undeformed cylinder over the Hertz strip."""
        return self.half_width**2 / (6 * self.radius)

    @property
    def mean_hertz_pressure(self) -> float:
        """F_T / (2 b B) [Pa]."""
        return hertz.line_mean_pressure(self.load / self.width, self.radius, self.e_prime)
