"""Kinematic viscosity over temperature: ASTM D341, and a table."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .._base import validate
from ..errors import InputError

CONSTANT = 0.7  # of D341, mm²/s (older charts: 0.8, which moves 68 / 8.6 mm²/s at 60 °C from 28.49 to 28.58)
CELSIUS = 273.15
RANGE = (200.0, 600.0)  # K in which a temperature is taken for one of an oil


def checked_temperature(temperature: float, name: str = "temperature") -> float:
    """``temperature`` [K], checked to be possible for an oil. The error says so if °C were likely meant."""
    likely = isinstance(temperature, (int, float)) and -60 <= temperature < RANGE[0]
    hint = f"°C were meant? {temperature:g} °C = {temperature + CELSIUS:g} K" if likely else ""
    try:
        return validate.number(name, temperature, "K", minimum=RANGE[0], maximum=RANGE[1])
    except InputError as error:
        error.hint(hint)
        raise


def at_each(function: Callable[[float], float], temperature) -> float | np.ndarray:
    """``function`` of one temperature [K], as a float, or of an array of them, as an array of its shape."""
    if np.ndim(temperature) == 0:
        return function(temperature)
    temperatures = validate.array("temperature", temperature, "K", ndim=np.ndim(temperature))
    return np.array([function(t) for t in temperatures.ravel().tolist()]).reshape(temperatures.shape)


@dataclass(frozen=True)
class Walther:
    """ASTM D341: log10 log10 Z = m - n log10 T, Z = nu + 0.7 + exp(-1.47 - 1.84 nu - 0.51 nu²), nu in mm²/s, T in K.

    ``m``: intercept [-]; ``n``: slope [-], 2.5 to 4.5 for lubricating oils. The constant is 0.7. The exponential
    matters only below 2 mm²/s (6e-4 of nu there). D341 gives the law for 0.21 to 2e7 mm²/s. Between the two
    temperatures of its points it holds to a few percent for oils without wax. Outside them it is an extrapolation.
    ``said``: the keys of [lubricant] that it follows from, with their values.
    """

    m: float
    n: float
    said: tuple[tuple[str, float | str], ...] = ()

    def __call__(self, temperature: float) -> float:
        """nu [m²/s] at ``temperature`` [K]."""
        power = self.m - self.n * math.log10(checked_temperature(temperature))
        return _viscosity(10 ** (10**power)) * 1e-6


def walther(first: tuple[float, float], second: tuple[float, float], **said: float | str) -> Walther:
    """`Walther` through two pairs (temperature [K], nu [m²/s]); nu must fall as the temperature rises. ``said``: the
    keys of [lubricant] that the pairs follow from."""
    (cold, thick), (warm, thin) = sorted((first, second))
    checked_temperature(cold), checked_temperature(warm)
    if not warm > cold:
        raise InputError(f"temperatures = {cold:g} and {warm:g} K; give two that differ")
    for nu in (thick, thin):
        validate.number("kinematic viscosity", nu, "m²/s", minimum=0.21e-6, maximum=2.0)
    if not thin < thick:
        raise InputError(
            f"kinematic viscosity = {thick:g} m²/s at {cold:g} K and {thin:g} m²/s at {warm:g} K; allowed: one that "
            "falls as the temperature rises (swapped?)"
        )
    a, b = (math.log10(math.log10(_raised(nu * 1e6))) for nu in (thick, thin))
    n = (a - b) / math.log10(warm / cold)
    return Walther(a + n * math.log10(cold), n, tuple(said.items()))


def _raised(nu: float) -> float:
    """Z of D341 at nu [mm²/s]."""
    return nu + CONSTANT + math.exp(-1.47 - 1.84 * nu - 0.51 * nu**2)


def _viscosity(raised: float) -> float:
    """nu [mm²/s] of Z: the standard's closed form, then Newton's method on its equation."""
    x = raised - CONSTANT
    nu = x - math.exp(-0.7487 - 3.295 * x + 0.6119 * x**2 - 0.3193 * x**3)
    for _ in range(4 if nu < 5 else 0):
        share = math.exp(-1.47 - 1.84 * nu - 0.51 * nu**2)
        nu -= (nu + CONSTANT + share - raised) / (1 - (1.84 + 1.02 * nu) * share)
    return nu


@dataclass(frozen=True)
class ViscosityTable:
    """Pairs of temperature [K], rising, and kinematic viscosity [m²/s], falling; D341 between neighbours.

    There is no value outside the table.
    """

    temperatures: tuple[float, ...]
    viscosities: tuple[float, ...]

    def __post_init__(self):
        if len(self.temperatures) != len(self.viscosities) or len(self.temperatures) < 2:
            raise InputError(
                f"a viscosity table of {len(self.temperatures)} temperatures and {len(self.viscosities)} viscosities; "
                "allowed: as many of both, at least two"
            )
        if any(b <= a for a, b in zip(self.temperatures, self.temperatures[1:])):
            raise InputError(f"temperatures = {self.temperatures}; allowed: rising, in K")
        for pair in zip(self._points, self._points[1:]):
            walther(*pair)

    @property
    def _points(self) -> list[tuple[float, float]]:
        return list(zip(self.temperatures, self.viscosities))

    def piece(self, temperature: float) -> Walther:
        """The D341 law between the neighbours of ``temperature`` [K]."""
        low, high = self.temperatures[0], self.temperatures[-1]
        validate.number("temperature", temperature, "K (the viscosity table's)", minimum=low, maximum=high)
        i = max(next(i for i, t in enumerate(self.temperatures) if t >= temperature), 1)
        return walther(self._points[i - 1], self._points[i])

    def __call__(self, temperature: float) -> float:
        """nu [m²/s] at ``temperature`` [K]."""
        return self.piece(temperature)(temperature)
