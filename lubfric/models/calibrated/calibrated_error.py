"""The error of f on long cells, as a campaign of solved cases shows it.

The campaign (``python -m verification calibration``) solves random contacts by the deterministic model on long cells and
on short ones. ln of the ratio of the sliding parts of f has a mean, the bias b·x, and a standard deviation σ = exp(s·y),
both linear in a few `features` of the solution; C is the covariance of b. The 95 % bounds are bias ± k sqrt(σ² + x·C x),
so that they widen where few cases are like the contact. k is the 95 % quantile of what was seen on kinds of cases (fluids,
lays, loads, slide-roll ratios) that were excluded from the fit, one kind at a time (conformal prediction). calibration.toml
has the numbers.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np

from ..._base import packaged
from ...scene import Scene, moves
from ..shared import peak_hertz_pressure

# Factor on the bounds far outside the range of the campaign.
WIDEST = 3.0


@dataclass(frozen=True, kw_only=True)
class ErrorModel:
    """The distribution of ln of the sliding part of f over that on long cells, for a kind of contact: roughness at rest,
    or moving.

    cases : number of solved cases; bias : coefficient of each feature; covariance : of these coefficients
    spread : coefficient of each feature in ln σ; quantile : k
    rolling : 95 % quantile of the error of the part of f by the gradient of the pressure, over the square root of that part
        times the sum of both parts
    range : least and largest pressure [Pa], Moes' film over Sq [-], load [N/m] and slide-roll ratio [-] of the cases
    """

    cases: int
    bias: Mapping[str, float]
    covariance: np.ndarray
    spread: Mapping[str, float]
    quantile: float
    rolling: float
    range: Mapping[str, tuple[float, float]]

    def bias_at(self, x: Mapping[str, float]) -> float:
        """Return the bias at the features ``x``."""
        return sum(factor * x[name] for name, factor in self.bias.items())

    def half_width(self, x: Mapping[str, float]) -> float:
        """Return the half-width of the 95 % interval of ln f at the features ``x``."""
        spread = math.exp(sum(factor * x[name] for name, factor in self.spread.items()))
        direction = np.array([x[name] for name in self.bias])
        return self.quantile * math.sqrt(spread**2 + float(direction @ self.covariance @ direction))

    def rolling_error(self, rolling: float, sliding: float) -> float:
        """Return the error of the ``rolling`` part of f at 95 %, by its size and that of the ``sliding`` part."""
        return self.rolling * math.sqrt(abs(rolling) * (abs(rolling) + abs(sliding)))


@cache
def error_models() -> dict[str, ErrorModel]:
    """Return the error models by kind of contact, "rest" or "rolling"."""
    tables = packaged(__package__, "calibration.toml")
    return {kind: ErrorModel(**table | {"covariance": np.array(table["covariance"])}) for kind, table in tables.items()}


def error_model_of(scene: Scene) -> ErrorModel:
    """Return the error model for ``scene``."""
    return error_models()["rolling" if moves(scene) else "rest"]


def out_of_range(scene: Scene, sq: float, speed: float, known: Mapping[str, tuple[float, float]]) -> dict[str, float]:
    """Return how far ``scene`` is outside the range of the campaign, in ln, by a description as text."""
    line = scene.line_contact(abs(speed))
    ratio = abs(scene.motion.slide_roll_ratio)
    moes_ratio = line.moes_film / sq
    values = {
        "pressure": ("Hertz pressure of {:.3g} Pa", peak_hertz_pressure(scene)),
        "lambda": ("Moes' film over Sq of {:.3g}", moes_ratio),
        "load": ("load of {:.3g} N/m", scene.bodies.load / scene.bodies.width),
        "slip": ("slide-roll ratio of {:.3g}", ratio),
    }
    words = {}
    for name, (text, value) in values.items():
        low, high = known[name]
        if value < low:
            # less sliding than in any case changes the stress by little; the part of rolling is counted apart
            words[f"{text.format(value)}, below {low:.3g}"] = low - value if name == "slip" else math.log(low / value)
        elif value > high:
            words[f"{text.format(value)}, above {high:.3g}"] = math.log(value / high)
    return words


def widening(distances: Iterable[float]) -> float:
    """Return the factor on the bounds at ``distances`` outside the range of the campaign, in ln: 1 + their sum, at most
    `WIDEST`. Nothing was measured there."""
    return min(1.0 + sum(distances), WIDEST)
