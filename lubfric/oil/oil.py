"""An oil: viscosity, density and pressure-viscosity coefficient as functions of temperature."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .._base import Shown, validate
from ..errors import InputError
from .pressure import BASES, Estimate, MeasuredCoefficients, gold, so_klaus
from .viscosity import CELSIUS, ViscosityTable, Walther, checked_temperature, viscosity_index

# Temperature of a stated density [K]. The reference of ISO 5024, as in data sheets.
AT_15 = 15 + CELSIUS
# Estimates of the pressure-viscosity coefficient.
ESTIMATES = ("so-klaus", "gold")
# Step of a central difference [K]. A choice: its error is of second order, and far above rounding.
TEMPERATURE_STEP = 0.05


@dataclass(frozen=True, kw_only=True, repr=False)
class Oil(Shown):
    """An oil at ambient pressure; temperatures in K, kinematic viscosity in m²/s, density in kg/m³.

    viscosity_law : kinematic viscosity over temperature, `Walther` (ASTM D341, constant 0.7) or `ViscosityTable`
    base : "mineral", "pao", "ester" or "polyglycol", for what is not given below
    density : at 15 °C [kg/m³], and density_slope : by which it falls [kg/(m³ K)] (None: typical of the base)
    alpha : pressure-viscosity coefficient [1/Pa] where it is known (None: estimated)
    estimate : "so-klaus" (mineral oils) or "gold" (None: So and Klaus for mineral oils, Gold for the others)
    conductivity : thermal, of the film [W/(m K)] (None: typical of the base)
    name : as text, and note : what else is known of it
    measured : pressure-viscosity coefficients over the temperature (None: estimated); ``alpha`` comes first

    Raises `InputError` for a value out of range, and for So and Klaus's regression with a base that is not mineral.
    """

    viscosity_law: Walther | ViscosityTable
    base: str = "mineral"
    density: float | None = None
    density_slope: float | None = None
    alpha: float | None = None
    estimate: str | None = None
    conductivity: float | None = None
    name: str = "oil"
    note: str = ""
    measured: MeasuredCoefficients | None = None

    def __post_init__(self) -> None:
        validate.choice("base", self.base, BASES)
        for name, value, unit, least, most in (
            ("density", self.density, "kg/m³ (at 15 °C)", 600, 2000),
            ("density_slope", self.density_slope, "kg/(m³ K)", 0, 3),
            ("conductivity", self.conductivity, "W/(m K)", 0.02, 2),
        ):
            if value is not None:
                object.__setattr__(self, name, validate.number(name, value, unit, minimum=least, maximum=most))
        if self.alpha is not None:
            alpha = validate.positive("pressure_viscosity_coefficient", self.alpha, "1/Pa", maximum=1e-6)
            object.__setattr__(self, "alpha", alpha)
        if self.estimate is not None:
            validate.choice("estimate", self.estimate, ESTIMATES)
        if self.estimate == "so-klaus" and self.base != "mineral":
            raise InputError(f"estimate = 'so-klaus' is for mineral oils, base = {self.base!r}; allowed: 'gold'")

    def kinematic_viscosity(self, temperature: ArrayLike) -> float:
        """Return nu [m²/s] at ``temperature`` [K], one or an array of them."""
        return at_each(self.viscosity_law, temperature)

    def density_at(self, temperature: ArrayLike) -> float:
        """Return density rho [kg/m³] at ``temperature`` [K], one or an array of them.

        It is the density at 15 °C, less ``density_slope`` times the distance from 15 °C. This straight line is good to
        some 0.5 % between 0 and 100 °C.
        """
        return at_each(lambda t: self.density_15 - self.density_fall * (checked_temperature(t) - AT_15), temperature)

    @property
    def density_15(self) -> float:
        """Return density at 15 °C [kg/m³]: given, or typical of the base oil (within 5 %)."""
        return BASES[self.base]["density"] if self.density is None else self.density

    @property
    def density_fall(self) -> float:
        """Return the decrease of the density with the temperature [kg/(m³ K)]: given, or typical of the base oil."""
        return BASES[self.base]["density_slope"] if self.density_slope is None else self.density_slope

    @property
    def thermal_conductivity(self) -> float:
        """k [W/(m K)]: given, or typical of the base oil at ambient pressure (within 25 %; about twice as much at 1
        GPa)."""
        return BASES[self.base]["conductivity"] if self.conductivity is None else self.conductivity

    def viscosity(self, temperature: ArrayLike) -> float:
        """Return the dynamic viscosity eta = nu rho [Pa s] at ``temperature`` [K], one or an array of them."""
        return self.kinematic_viscosity(temperature) * self.density_at(temperature)

    def temperature_coefficient(self, temperature: float) -> float:
        """Return -d ln(eta)/dT [1/K] at ``temperature`` [K], from its law by a central difference."""
        temperature = checked_temperature(temperature)
        low = temperature - TEMPERATURE_STEP
        high = temperature + TEMPERATURE_STEP
        if isinstance(self.viscosity_law, ViscosityTable):
            low = max(low, self.viscosity_law.temperatures[0])
            high = min(high, self.viscosity_law.temperatures[-1])
        return math.log(self.viscosity(low) / self.viscosity(high)) / (high - low)

    def pressure_viscosity_coefficient(self, temperature: float) -> Estimate:
        """Return alpha at ``temperature`` [K], with the range in which measured oils lie. Where alpha is known it is
        returned as given."""
        if self.alpha is not None:
            return Estimate(value=self.alpha, low=self.alpha, high=self.alpha, source="the scene")
        if self.measured is not None and self.is_coefficient_measured:
            return self.measured.at(checked_temperature(temperature))
        return self._estimated(self.estimate or ("so-klaus" if self.base == "mineral" else "gold"), temperature)

    @property
    def is_coefficient_measured(self) -> bool:
        """Whether the pressure-viscosity coefficient is that of measurements of this oil."""
        return self.alpha is None and self.measured is not None and self.estimate is None

    def other_estimate(self, temperature: float) -> Estimate | None:
        """Return alpha by the estimate that was not chosen, or None where there is no other. How far the two differ is
        a warning."""
        known = self.alpha is not None or (self.measured is not None and self.estimate is None)
        if known or self.base != "mineral":
            return None
        return self._estimated("gold" if self.estimate in (None, "so-klaus") else "so-klaus", temperature)

    def _estimated(self, method: str, temperature: float) -> Estimate:
        nu = self.kinematic_viscosity(temperature)
        if method == "gold":
            return gold(nu, self.base)
        return so_klaus(nu, self.slope(temperature), self.density_at(temperature))

    def slope(self, temperature: float) -> float:
        """Return n of ASTM D341 [-] at ``temperature`` [K]."""
        law = self.viscosity_law
        return law.n if isinstance(law, Walther) else law.piece(temperature).n

    @property
    def given_keys(self) -> dict[str, Any]:
        """Return the keys of [lubricant], with their values, that give this oil again."""
        law = self.viscosity_law
        if isinstance(law, ViscosityTable):
            viscosity: dict[str, Any] = {"viscosity_table": tuple(zip(law.temperatures, law.viscosities))}
        else:
            viscosity = dict(law.given_keys) or {"nu40": law(40 + CELSIUS), "nu100": law(100 + CELSIUS)}
        given = {key: getattr(self, key) for key in ("base", "density", "density_slope", "conductivity")}
        given |= {"pressure_viscosity_coefficient": self.alpha, "alpha_estimate": self.estimate}
        return viscosity | {key: value for key, value in given.items() if value is not None}

    @property
    def index(self) -> float:
        """Return viscosity index [-] (ASTM D2270), from the law at 40 and 100 °C."""
        return viscosity_index(self.kinematic_viscosity(40 + CELSIUS), self.kinematic_viscosity(100 + CELSIUS))

    @property
    def name_and_note(self) -> str:
        """The name, and the note behind it where there is one, as text."""
        return "; ".join(filter(None, (self.name, self.note)))

    def with_(self, **changed: Any) -> Oil:
        """Return a copy with fields replaced."""
        return replace(self, **changed)


def at_each(function: Callable[[float], float], temperature: Any) -> Any:
    """Return ``function`` of one temperature [K], as a float, or of an array of them, as an array of its shape."""
    if np.ndim(temperature) == 0:
        return function(temperature)
    temperatures = validate.array("temperature", temperature, "K", ndim=np.ndim(temperature))
    return np.array([function(t) for t in temperatures.ravel().tolist()]).reshape(temperatures.shape)
