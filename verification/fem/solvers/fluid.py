"""Viscosity and density laws for the finite-element side, written for real and complex pressures.

They take complex pressures because the tangent of a weak form is found by a complex step: ``Im f(p + i e)/e`` is the
derivative to rounding (Squire & Trapp 1998, doi:10.1137/S003614459631241X). So no law needs a second one for its
derivative.
"""

import math
from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass

import numpy as np

from ...types import Keywords, Numbers
from .report import require

ROELANDS_PRESSURE = 1.96e8  # Pa; Roelands 1966
VISCOSITY_LAWS = ("constant", "barus", "roelands")
DENSITY_LAWS = ("constant", "linear", "dowson-higginson")
STEP = 1e-40  # of a complex step: its square is lost beside 1


@dataclass(frozen=True)
class Fluid:
    """A lubricant; pressures are gauge pressures in Pa.

    viscosity : at p = 0, Pa s
    viscosity_law : "constant"; "barus" ``exp(alpha p)``; "roelands" ``exp((alpha p0/z)((1 + p/p0)^z - 1))``
        with p0 = 1.96e8 Pa (Roelands 1966)
    pressure_viscosity_coefficient : alpha, 1/Pa
    roelands_index : z, 1; None takes ``alpha p0/(ln viscosity + 9.67)``
    density_law : relative density "constant" 1; "linear" ``1 + p/bulk_modulus`` (an isothermal ideal gas has
        its ambient pressure for bulk modulus); "dowson-higginson"
        ``(5.9e8 + 1.34 p)/(5.9e8 + p)`` (Dowson & Higginson 1966, p in Pa)
    bulk_modulus : Pa, for "linear"
    eyring_stress : Pa; the shear stress is its asinh of the Newtonian one in its units (infinite: Newtonian)
    limiting_stress : (tau_0 in Pa, Lambda): no stress above tau_0 + Lambda p; None: no limit
    """

    viscosity: float
    _: KW_ONLY
    viscosity_law: str = "constant"
    pressure_viscosity_coefficient: float = 0.0
    roelands_index: float | None = None
    density_law: str = "constant"
    bulk_modulus: float = math.inf
    eyring_stress: float = math.inf
    limiting_stress: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        laws = f"viscosity_law = {self.viscosity_law!r}, density_law = {self.density_law!r}"
        known = self.viscosity_law in VISCOSITY_LAWS and self.density_law in DENSITY_LAWS
        require(known, laws, f"{VISCOSITY_LAWS} and {DENSITY_LAWS}")
        require(0 < self.viscosity < math.inf, f"viscosity = {self.viscosity} Pa s", "> 0")
        alpha = self.pressure_viscosity_coefficient
        require(0 <= alpha < math.inf, f"pressure_viscosity_coefficient = {alpha} 1/Pa", ">= 0")
        if self.viscosity_law == "roelands":
            require(self.index > 0, f"roelands_index = {self.index}", "> 0")
        require(self.bulk_modulus > 0, f"bulk_modulus = {self.bulk_modulus} Pa", "> 0")

    @classmethod
    def of(cls, oil: Keywords) -> "Fluid":
        """Return the fluid of an oil given by the keys of a scene, or by the arguments of ``lubfric.solve_ehl``."""
        alpha = oil.get("pressure_viscosity_coefficient", 0.0)
        limit = oil.get("limiting_stress_coefficient")
        return cls(
            oil["viscosity"],
            viscosity_law=oil.get("viscosity_law", "roelands") if alpha else "constant",
            pressure_viscosity_coefficient=alpha,
            density_law=oil.get("density_law", "constant"),
            eyring_stress=oil.get("eyring_stress") or math.inf,
            limiting_stress=None if limit is None else (oil.get("limiting_stress_offset", 0.0), limit),
        )

    @property
    def index(self) -> float:
        """Roelands' z."""
        if self.roelands_index is not None:
            return self.roelands_index
        return self.pressure_viscosity_coefficient * ROELANDS_PRESSURE / (math.log(self.viscosity) + 9.67)

    def log_viscosity(self, p: Numbers) -> np.ndarray:
        """Return ``ln(eta/eta0)`` at pressure p."""
        p = np.asarray(p)
        if self.viscosity_law == "constant":
            return 0 * p
        if self.viscosity_law == "barus":
            return self.pressure_viscosity_coefficient * p
        z = self.index
        return self.pressure_viscosity_coefficient * ROELANDS_PRESSURE / z * ((1 + p / ROELANDS_PRESSURE) ** z - 1)

    def eta(self, p: Numbers) -> np.ndarray:
        """Return viscosity in Pa s."""
        return self.viscosity * np.exp(self.log_viscosity(p))

    def stress(self, p: Numbers, rate: Numbers) -> np.ndarray:
        """Return shear stress in Pa at the shear rate, 1/s, of either sign."""
        size: np.ndarray = self.eta(p) * np.abs(rate)
        if math.isfinite(self.eyring_stress):
            ratio = size / self.eyring_stress
            size = self.eyring_stress * np.log(ratio + np.sqrt(1 + ratio**2))
        if self.limiting_stress is not None:
            size = np.minimum(size, self.limiting_stress[0] + self.limiting_stress[1] * np.asarray(p))
        return np.sign(rate) * size

    def rho(self, p: Numbers) -> np.ndarray:
        """Return density relative to that at p = 0."""
        p = np.asarray(p)
        if self.density_law == "constant":
            return 1 + 0 * p
        if self.density_law == "linear":
            return 1 + p / self.bulk_modulus
        return (5.9e8 + 1.34 * p) / (5.9e8 + p)


def slope(law: Callable[[Numbers], np.ndarray], p: Numbers) -> np.ndarray:
    """Return the derivative of one of the laws by a complex step. It can itself be differentiated only on the real
    axis."""
    slopes: np.ndarray = np.imag(law(np.asarray(p).real + 1j * STEP)) / STEP
    return slopes
