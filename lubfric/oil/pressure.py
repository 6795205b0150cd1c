"""Pressure-viscosity coefficient: estimates from the viscosity, each with the range in which measured oils lie.

An estimate cannot distinguish oils of the same viscosity, so it comes with a range: measured coefficients over the
estimate, widened to round numbers. The measured oils are 13 mineral oils at 30, 60 and 100 °C (Stachowiak and
Batchelor, Engineering Tribology, Table 2.3; `tests/oil` has them), glycols and esters of the same table, and
polyalphaolefins.

The coefficient is the slope d ln(eta)/dp at ambient pressure. Published fits often give a mean slope up to some 0.2
GPa, which is lower.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .._base import packaged, validate
from ..errors import InputError

BASES = packaged(__package__, "oils.toml")["bases"]
# Measured coefficients over the estimate of So and Klaus [-], of the 13 oils named above.
SO_KLAUS_RANGE = (0.70, 1.15)
# Relative error of a measured coefficient [-], as twin-disc fits state it (Arana et al. 2019).
MEASURED_ERROR = 0.04
# Distance [K] beyond the measured temperatures up to which their line is continued.
CONTINUED_TEMPERATURES = 25.0


@dataclass(frozen=True)
class MeasuredCoefficients:
    """Measured pressure-viscosity coefficients of one oil.

    Attributes
    ----------
    temperatures : rising [K]
    coefficients : alpha at each [1/Pa]
    source : as text
    """

    temperatures: tuple[float, ...]
    coefficients: tuple[float, ...]
    source: str

    def at(self, temperature: float) -> Estimate:
        """Return alpha at ``temperature`` [K], with 4 % each way.

        Between two temperatures ln alpha is linear, and 25 K beyond the first and the last. Raises `InputError` farther
        off.
        """
        low = self.temperatures[0]
        high = self.temperatures[-1]
        if not low - CONTINUED_TEMPERATURES <= temperature <= high + CONTINUED_TEMPERATURES:
            raise InputError(
                f": the coefficient of this oil was measured from {low:g} to {high:g} K, and {temperature:g} K is more "
                f"than {CONTINUED_TEMPERATURES:g} K outside",
                "pressure_viscosity_coefficient",
                recommendation="give pressure_viscosity_coefficient [1/Pa] at that temperature",
            )
        right = min(max(int(np.searchsorted(self.temperatures, temperature)), 1), len(self.temperatures) - 1)
        cold, warm = self.temperatures[right - 1 : right + 1]
        first, second = np.log(self.coefficients[right - 1 : right + 1])
        value = math.exp(first + (second - first) * (temperature - cold) / (warm - cold))
        return Estimate(
            value=value,
            low=(1 - MEASURED_ERROR) * value,
            high=(1 + MEASURED_ERROR) * value,
            source=self.source,
            method="measured",
        )


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """A pressure-viscosity coefficient [1/Pa]: value, the bounds [1/Pa] within which measured oils lie, its source as
    text, and the name of the method, "gold", "so-klaus" or "measured" ("": given, not estimated)."""

    value: float
    low: float
    high: float
    source: str
    method: str = ""

    @property
    def text(self) -> str:
        """Return the coefficient as text, in 1/GPa."""
        value, low, high = (1e9 * each for each in (self.value, self.low, self.high))
        oils = "this oil" if self.method == "measured" else "measured oils"
        return f"{value:.3g} /GPa by {self.source}, {oils} {low:.3g} to {high:.3g}"


def gold(nu: float, base: str) -> Estimate:
    """Return alpha by ``s nu^t``, with s and t of the ``base`` oil: "mineral", "pao", "ester" or "polyglycol". nu
    [m²/s]: at the temperature in question and ambient pressure.

    Source: P. W. Gold, A. Schmidt, H. Dicke, J. Loos, C. Assmann, J. Synthetic Lubrication 18 (2001) 51-79,
    doi:10.1002/jsl.3000180105. A second source, a public program for gears (GEARpie), has the same digits, but those of
    s and t exchanged, and PAO and ester the other way round. Measured mineral oils have up to 1.63 times as much, an
    aromatic ester 1.9, a polypropylene glycol 1.7 times. The range stated is 0.85 to 1.65 times (ester 2.1, polyglycol
    1.75).
    """
    nu = validate.positive("nu", nu, "m²/s", maximum=1.0)
    base = validate.choice("base", base, BASES)
    s, t = BASES[base]["gold"]
    value = s * (nu * 1e6) ** t * 1e-9
    low, high = BASES[base]["measured"]
    return Estimate(value=value, low=low * value, high=high * value, source="Gold et al. (2001)", method="gold")


def so_klaus(nu: float, slope: float, density: float) -> Estimate:
    """Return alpha by So and Klaus's regression for mineral oils: nu [m²/s] and density [kg/m³] at the temperature in
    question, ``slope`` n of ASTM D341 (`Walther`).

    With l = log10(nu in mm²/s), alpha in 10 /GPa is
    ``1.216 + 4.143 l^3.0627 + 2.848e-4 n^5.1903 l^1.5976 - 3.999 l^3.0975 rho^0.1162``, rho in g/cm³ (B. Y. C. So, E.
    E. Klaus, ASLE Trans. 23 (1980) 409-421, doi:10.1080/05698198008982986). For nu above 1 mm²/s. Measured mineral oils
    have 0.71 to 1.1 times as much; stated: 0.70 to 1.15 times.
    """
    nu = validate.number("nu", nu, "m²/s (for So and Klaus)", above=1e-6, maximum=1.0)
    slope = validate.number("slope", slope, "(-)", minimum=1.0, maximum=6.0)
    rho = validate.number("density", density, "kg/m³", minimum=500, maximum=2000) / 1000
    l = math.log10(nu * 1e6)
    fitted = 1.216 + 4.143 * l**3.0627 + 2.848e-4 * slope**5.1903 * l**1.5976 - 3.999 * l**3.0975 * rho**0.1162
    value = fitted * 1e-8
    return Estimate(
        value=value,
        low=SO_KLAUS_RANGE[0] * value,
        high=SO_KLAUS_RANGE[1] * value,
        source="So and Klaus (1980)",
        method="so-klaus",
    )
