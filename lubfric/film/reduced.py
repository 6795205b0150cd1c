"""The pressure of an oil from its reduced pressure ``q = ∫ dp eta0/eta(p)``, with which Reynolds' equation of any oil
is that of a constant viscosity."""

import math
from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np

from .._base import FloatArray
from ..oil import Lubricant, log_viscosity_ratio

# Points of the table of q(p). A choice, made once for an oil.
TABLE = 4000
# alpha p [-] of its last point. A choice, far above any pressure of a contact: only guesses reach it.
LAST_ALPHA_P = 1e4


@lru_cache(maxsize=16)
def true_pressure(lubricant: Lubricant) -> Callable[..., Any]:
    """Return p(q) [Pa] by the lubricant's law: the inverse of q = ∫ dp eta0/eta(p), infinite above the largest possible
    q."""
    if lubricant.viscosity_law == "constant":
        return np.positive
    alpha = lubricant.pressure_viscosity_coefficient
    if lubricant.viscosity_law == "barus":

        def barus(q: FloatArray) -> FloatArray:
            with np.errstate(divide="ignore"):
                return -np.log1p(-np.minimum(alpha * q, 1.0)) / alpha

        return barus
    p = np.expm1(np.linspace(0.0, math.log1p(LAST_ALPHA_P), TABLE)) / alpha
    fluidity = np.exp(-np.minimum(log_viscosity_ratio(lubricant, p)[0], 700.0))
    q = np.append(0.0, np.cumsum(0.5 * (fluidity[1:] + fluidity[:-1]) * np.diff(p)))
    ratio = np.append(1.0, p[1:] / q[1:])  # smooth where q is small
    return lambda reduced: reduced * np.interp(reduced, q, ratio, right=math.inf)
