"""Kinematic viscosity: over temperature (ASTM D341, and a table), and the viscosity index (ASTM D2270, ISO 2909)."""

import math
from dataclasses import dataclass
from importlib import resources

import numpy as np

from .._base import validate
from ..errors import InputError

# Constant of ASTM D341 [mm²/s]. Older charts have 0.8, which moves 68 / 8.6 mm²/s at 60 °C from 28.49 to 28.58.
CONSTANT = 0.7
# 0 °C in K. By definition (SI).
CELSIUS = 273.15
# Temperatures [K] that are taken for those of an oil. A choice: a number below is one in °C.
RANGE = (200.0, 600.0)
# Viscosity at 100 °C [m²/s] below which the index is not defined (ASTM D2270).
LEAST_VISCOSITY_AT_100 = 2e-6
# Constant of procedure B of ASTM D2270 [-].
ASTM_D2270_B = 0.00715
# Largest index [-] that `viscosity_at_100` takes; oils on the market end below 250. A choice: a smaller value refuses
# oils that may be.
MOST_INDEX = 400.0
with (resources.files(__package__) / "d2270.txt").open() as _file:
    AT_100, LOW, HIGH = np.loadtxt(_file, unpack=True)  # mm²/s: at 100 °C; L and H of the standard


def checked_temperature(temperature: float, name: str = "temperature") -> float:
    """Return ``temperature`` [K], checked to be possible for an oil. The error says so if °C were likely meant."""
    try:
        return validate.number(name, temperature, "K", minimum=RANGE[0], maximum=RANGE[1])
    except InputError as error:
        if isinstance(temperature, (int, float)) and -60 <= temperature < RANGE[0]:
            error.hint(
                f"{name} = {temperature:g} is read as {temperature:g} K; did you mean {temperature:g} °C "
                f"({temperature + CELSIUS:g} K)?",
                asks=True,
            )
        raise


@dataclass(frozen=True)
class Walther:
    """ASTM D341: log10 log10 Z = m - n log10 T, Z = nu + 0.7 + exp(-1.47 - 1.84 nu - 0.51 nu²), nu in mm²/s, T in K.

    ``m``: intercept [-]; ``n``: slope [-], 2.5 to 4.5 for lubricating oils. The constant is 0.7. The exponential
    matters only below 2 mm²/s (6e-4 of nu there). D341 gives the law for 0.21 to 2e7 mm²/s. Between the two
    temperatures of its points it holds to a few percent for oils without wax. Outside them it is an extrapolation.
    ``given_keys``: the keys of [lubricant] that it follows from, with their values.
    """

    m: float
    n: float
    given_keys: tuple[tuple[str, float | str], ...] = ()

    def __call__(self, temperature: float) -> float:
        """Return nu [m²/s] at ``temperature`` [K]."""
        power = self.m - self.n * math.log10(checked_temperature(temperature))
        return _viscosity(10 ** (10**power)) * 1e-6


def walther(first: tuple[float, float], second: tuple[float, float], **given_keys: float | str) -> Walther:
    """Return `Walther` through two pairs (temperature [K], nu [m²/s]); nu must fall as the temperature rises.
    ``given_keys``: the keys of [lubricant] that the pairs follow from."""
    (cold, thick), (warm, thin) = sorted((first, second))
    checked_temperature(cold), checked_temperature(warm)
    if not warm > cold:
        raise InputError(f"temperatures = {cold:g} and {warm:g} K; give two that differ")
    for nu in (thick, thin):
        validate.number("kinematic viscosity", nu, "m²/s", minimum=0.21e-6, maximum=2.0)
    if not thin < thick:
        fault = f" = {thick:g} m²/s at {cold:g} K and {thin:g} m²/s at {warm:g} K"
        raise InputError(fault, "kinematic viscosity", "one that falls as the temperature rises (swapped?)")
    raised = [nu + CONSTANT + math.exp(-1.47 - 1.84 * nu - 0.51 * nu**2) for nu in (thick * 1e6, thin * 1e6)]  # Z
    a, b = (math.log10(math.log10(z)) for z in raised)
    n = (a - b) / math.log10(warm / cold)
    return Walther(a + n * math.log10(cold), n, tuple(given_keys.items()))


def _viscosity(raised: float) -> float:
    """Return nu [mm²/s] of Z: the standard's closed form, then Newton's method on its equation."""
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

    def __post_init__(self) -> None:
        if len(self.temperatures) != len(self.viscosities) or len(self.temperatures) < 2:
            message = (
                f"a viscosity table of {len(self.temperatures)} temperatures and {len(self.viscosities)} viscosities"
            )
            raise InputError(message, allowed="as many of both, at least two")
        if any(b <= a for a, b in zip(self.temperatures, self.temperatures[1:])):
            raise InputError(f"temperatures = {self.temperatures}; allowed: rising, in K")
        for i in range(1, len(self.temperatures)):
            self._law_up_to(i)

    def _law_up_to(self, i: int) -> Walther:
        """Return the law between the entries i - 1 and i."""
        return walther(*zip(self.temperatures[i - 1 : i + 1], self.viscosities[i - 1 : i + 1]))

    def piece(self, temperature: float) -> Walther:
        """Return the D341 law between the neighbours of ``temperature`` [K]."""
        low = self.temperatures[0]
        high = self.temperatures[-1]
        unit = "K (the viscosity table's)"
        temperature = validate.number("temperature", temperature, unit, minimum=low, maximum=high)
        return self._law_up_to(max(next(i for i, t in enumerate(self.temperatures) if t >= temperature), 1))

    def __call__(self, temperature: float) -> float:
        """Return nu [m²/s] at ``temperature`` [K]."""
        return self.piece(temperature)(temperature)


def viscosity_index(nu40: float, nu100: float) -> float:
    """Return viscosity index [-], not rounded, from the kinematic viscosities [m²/s] at 40 °C and at 100 °C.

    ASTM D2270: with L and H of the standard's table (above 70 mm²/s at 100 °C of its formulas), procedure A, ``100 (L
    - nu40)/(L - H)``, where nu40 >= H; procedure B, ``100 + (10^N - 1)/0.00715`` with ``N = log(H/nu40)/log(nu100)``
    in mm²/s, below (index 100 and more). The standard rounds to integers.

    Raises `InputError` for viscosities that are not positive, a nu100 below 2 mm²/s (not defined there) or not below
    nu40.
    """
    nu40 = validate.positive("nu40", nu40, "m²/s")
    nu100 = validate.positive("nu100", nu100, "m²/s")
    if nu100 < LEAST_VISCOSITY_AT_100 * (1 - 1e-12):
        least = f"from 2e-6 m²/s (2 mm²/s), the viscosity index is not defined below{_millimetres(nu40, nu100)}"
        raise InputError(f" = {nu100:g} m²/s is out of range", "nu100", least)
    if nu40 <= nu100:
        message = f" = {nu40:g} m²/s is not above nu100 = {nu100:g} m²/s"
        raise InputError(message, "nu40", "nu40 > nu100 (swapped?)", also=("nu100",))
    if nu100 > 1e-2:
        error = InputError(f" = {nu100:g} m²/s is out of range", "nu100", "up to 0.01 m²/s")
        error.hint(_millimetres(nu40, nu100), asks=True)
        raise error
    return _index(nu40 * 1e6, nu100 * 1e6)


def _millimetres(nu40: float, nu100: float) -> str:
    """Return the question whether mm²/s were meant; "" where that is not likely."""
    if min(nu40, nu100) <= 1e-2:
        return ""
    return f"nu40 = {nu40:g} and nu100 = {nu100:g} are read in m²/s; did you mean mm²/s (1 mm²/s = 1e-6 m²/s)?"


def _index(at_40: float, at_100: float) -> float:
    """Return the viscosity index, from viscosities in mm²/s."""
    if at_100 > AT_100[-1]:  # L and H [mm²/s]: by the standard's formulas, or its table
        low = (0.8353 * at_100 + 14.67) * at_100 - 216
        high = (0.1684 * at_100 + 11.85) * at_100 - 97
    else:
        low = float(np.interp(at_100, AT_100, LOW))
        high = float(np.interp(at_100, AT_100, HIGH))
    if at_40 >= high:
        return 100 * (low - at_40) / (low - high)
    return 100 + (10 ** (math.log(high / at_40) / math.log(at_100)) - 1) / ASTM_D2270_B


def viscosity_at_100(nu40: float, index: float) -> float:
    """Return the kinematic viscosity at 100 °C [m²/s] of an oil of ``nu40`` [m²/s] at 40 °C and viscosity index
    ``index``: D2270 inverted, by one bracketed root; `viscosity_index` of the result is ``index`` to 1e-9.

    Raises `InputError` where no viscosity from 2 mm²/s at 100 °C up has that index.
    """
    from scipy.optimize import brentq

    nu40 = validate.positive("nu40", nu40, "m²/s", maximum=1.0)
    index = validate.number("viscosity_index", index, "(-)", minimum=-200, maximum=MOST_INDEX)
    at_40 = nu40 * 1e6
    least = LEAST_VISCOSITY_AT_100 * 1e6
    if at_40 <= least or _index(at_40, least) > index:
        message = (
            f" = {index:g} (-) with nu40 = {nu40:g} m²/s is less than 2e-6 m²/s at 100 °C, where it is not defined"
        )
        instead = "give the kinematic viscosities at 40 and 100 °C instead"
        raise InputError(message, "viscosity_index", recommendation=instead, also=("nu40",))
    if _index(at_40, 0.999 * at_40) < index:
        message = f" = {index:g} (-) has no oil of nu40 = {nu40:g} m²/s"
        raise InputError(message, "viscosity_index", "a lower index", also=("nu40",))
    root = brentq(lambda at_100: _index(at_40, at_100) - index, least, 0.999 * at_40, xtol=1e-13, rtol=1e-14)
    return root * 1e-6
