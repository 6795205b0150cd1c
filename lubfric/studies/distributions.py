"""Distributions of which a study draws its values, beside ranges (`lubfric.studies.vary.Between`)."""

import math
from dataclasses import dataclass, field

import numpy as np

from .._base import FloatArray, validate
from ..errors import InputError
from ..units import in_si, number_and_unit

DISTRIBUTION_SCALES = ("linear", "log")

# Part of a distribution that its limits have to contain. A choice: less is another distribution than the one stated.
LEAST_WITHIN = 0.01

# Share of a sample at which its first and last value are drawn, at least from both ends. It follows from the 30 bits of
# a Sobol sequence, whose first share may be 0.
FIRST_SHARE = 2.0**-31

# Numbers of a `Normal` that are values of the key, and that is a difference of them.
VALUES_OF_NORMAL = ("mean", "low", "high")
DEVIATION = "standard_deviation"


@dataclass(frozen=True, kw_only=True)
class Normal:
    """A normal distribution of a key with this ``mean`` and ``standard_deviation``, in the unit of the key, or all with
    a unit: "5 N". ``low``, ``high``: limits, between which alone is drawn (None: without); they change both moments.
    scale "log": the logarithm is normal, and mean and standard deviation are those of the value. ``unit``: in SI."""

    mean: float
    standard_deviation: float
    low: float | None = None
    high: float | None = None
    scale: str = "linear"
    unit: str = field(default="", init=False)

    def __post_init__(self) -> None:
        self._convert()
        validate.choice("scale", self.scale, DISTRIBUTION_SCALES)
        above = 0.0 if self.scale == "log" else -math.inf
        for name in VALUES_OF_NORMAL:
            if getattr(self, name) is not None:
                validate.number(name, getattr(self, name), "(of the key)", above=above)
        validate.number(DEVIATION, self.standard_deviation, "(of the key)", above=0.0)
        (low, high) = self._limits()
        if not high - low > LEAST_WITHIN:
            shown = f"{self.low} to {self.high}"
            message = f"low to high = {shown} contain {100 * max(high - low, 0.0):.2g} % of the normal distribution"
            raise InputError(message, recommendation="give a low below the mean, and a high above it")

    def _convert(self) -> None:
        """Convert numbers that are text with a unit to SI. Raises `InputError` where only some are, or to another
        unit."""
        given = [name for name in (*VALUES_OF_NORMAL, DEVIATION) if getattr(self, name) is not None]
        if not any(isinstance(getattr(self, name), str) for name in given):
            return
        converted = {name: in_si(name, getattr(self, name)) for name in given}
        units = {unit for _, unit in converted.values()}
        if len(units) > 1:
            raise InputError(f"{', '.join(given)} of a distribution convert to {' and '.join(sorted(units))}")
        for name, (number, unit) in converted.items():
            value = (
                number - in_si(name, f"0 {unit_in(str(self.standard_deviation))}")[0] if name == DEVIATION else number
            )
            object.__setattr__(self, name, value)
            object.__setattr__(self, "unit", unit)

    def _location(self) -> tuple[float, float]:
        """Return the mean and the standard deviation of what is normal: of the value, or of its logarithm."""
        if self.scale == "linear":
            return self.mean, self.standard_deviation
        variance = math.log1p((self.standard_deviation / self.mean) ** 2)
        return math.log(self.mean) - 0.5 * variance, math.sqrt(variance)

    def _limits(self) -> tuple[float, float]:
        """Return which parts of the distribution without limits are below ``low`` and below ``high``."""
        from scipy.special import ndtr

        (mean, deviation) = self._location()
        ends = [end if end is None or self.scale == "linear" else math.log(end) for end in (self.low, self.high)]
        low, high = (free if end is None else float(ndtr((end - mean) / deviation)) for end, free in zip(ends, (0, 1)))
        return low, high

    def at(self, share: float) -> float | FloatArray:
        """Return values below which a ``share`` in [0, 1] of the distribution is, a number or an array."""
        from scipy.special import ndtri

        (mean, deviation) = self._location()
        (low, high) = self._limits()
        inner = np.clip(share, FIRST_SHARE, 1 - FIRST_SHARE)
        drawn = mean + deviation * ndtri(low + inner * (high - low))
        return np.exp(drawn) if self.scale == "log" else drawn


def unit_in(text: str) -> str:
    """Return the unit of a number that is given as ``text``, to convert 0 of it: "5 °C" is a difference of 5 K."""
    return (number_and_unit(text) or ("", ""))[1]
