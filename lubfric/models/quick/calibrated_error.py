"""The error of f on long cells, as a campaign of solved cases shows it.

The campaign (``python -m verification calibration``) solves random contacts by the deterministic model on long cells
and on short ones. ln of the ratio of the sliding parts of f has a mean, the bias b·x, and a standard deviation σ =
exp(s·y), both linear in a few `features` of the solution; C is the covariance of b. The 95 % bounds are bias ± k
sqrt(σ² + x·C x), so that they widen where few cases are like the contact. k is the 95 % quantile of what was seen on
kinds of cases (fluids, lays, loads, slide-roll ratios) that were excluded from the fit, one kind at a time (conformal
prediction). calibration.toml has the numbers.
"""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np

from ..._base import packaged
from ...scene import Scene, has_moving_roughness
from ...units import worded
from ..shared import Assumption, Violation, peak_hertz_pressure

OUTSIDE = (
    "the quick model is not calibrated for such contacts, so its model-form error is increased, at most three times"
)

# This consequence where numerics.model = 'auto' chose the quick model.
OUTSIDE_OF_CHOSEN = (
    "the cases on which the quick model is calibrated end there; its model-form error, which the interval of f "
    "contains, is increased for this, at most three times"
)

# The name of this model (`lubfric.models.quick.QuickModel.name`).
QUICK = "quick"

# What to do outside the calibration, and above its lambda ratios, where heat is often beyond what the deterministic
# model was checked for.
BY_DETERMINISTIC = "use numerics.model = 'deterministic', which needs no calibration"
WIDENED = "use f with its model-form error, which includes this increase"

# Distance in ln, below which the bounds widen by so little that nothing is reported: a hundredth of their width. A
# choice: a smaller value reports more.
NEGLIGIBLE_DISTANCE = 0.01

# Factor on the bounds far outside the range of the campaign. A choice: nothing was measured there.
MOST_WIDENING = 3.0

# How far [-], in ln, an oil with a shear law that no solved case has is taken to be outside: the bounds are twice as
# wide. Not measured.
DISTANCE_OF_OTHER_OIL = 1.0

OTHER_LAWS = "number of shear laws of the oil that no solved case has"


@dataclass(frozen=True, kw_only=True)
class ErrorModel:
    """The distribution of ln of the sliding part of f over that on long cells, for roughness at rest, or moving.

    Attributes
    ----------
    cases : number of solved cases
    bias : coefficient of each feature in the bias
    covariance : of these coefficients
    spread : coefficient of each feature in ln σ
    quantile : k
    usual_error : half-width of the bounds of f, relative, that nine cases in ten do not exceed
    rolling : 95 % quantile of the error of the part of f by the gradient of the pressure, over the square root of that
        part times the sum of both parts
    range : least and largest pressure [Pa], Moes' film over Sq [-], load [N/m] and slide-roll ratio [-] of the cases
    """

    cases: int
    bias: Mapping[str, float]
    covariance: np.ndarray
    spread: Mapping[str, float]
    quantile: float
    usual_error: float
    rolling: float
    range: Mapping[str, tuple[float, float]]

    def bias_at(self, x: Mapping[str, float]) -> float:
        """Return the bias at the features ``x``."""
        return sum(factor * x[name] for name, factor in self.bias.items())

    def log_half_width(self, x: Mapping[str, float]) -> float:
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
    return error_models()["rolling" if has_moving_roughness(scene) else "rest"]


@dataclass(frozen=True, kw_only=True)
class Outside:
    """A number of a contact that is outside of the range of the campaign.

    what, value, limit, unit : as of `lubfric.models.shared.Violation`; distance : in ln, from the range; is_thicker :
        whether it is the film over Sq, and above the range
    """

    what: str
    value: float
    limit: float
    unit: str
    distance: float
    is_thicker: bool = False

    @property
    def limit_in_words(self) -> str:
        """The end of the range that is passed, with its unit."""
        return worded(self.limit, self.unit) if self.unit else f"{self.limit:.3g}"

    def violation_in(self, scene: Scene) -> Violation:
        """Return what a result of ``scene``, and `lubfric info` before it, says of it: a note where the scene does not
        name the quick model, because the user has not chosen it then."""
        is_named = scene.numerics.model == QUICK
        factor = 1e-9 if self.unit == "Pa" else 1.0
        recommendation = WIDENED if self.is_thicker else BY_DETERMINISTIC
        return Violation(
            assumption=Assumption.CALIBRATED,
            what=self.what,
            value=factor * self.value,
            limit=factor * self.limit,
            unit="GPa" if self.unit == "Pa" else self.unit,
            consequence=OUTSIDE if is_named else OUTSIDE_OF_CHOSEN,
            recommendation=recommendation if is_named else "",
            is_note=not is_named,
        )


def out_of_range(
    scene: Scene, sq: float | None, speed: float, known: Mapping[str, tuple[float, float]]
) -> tuple[Outside, ...]:
    """Return what of ``scene`` at ``speed`` [m/s] is outside the range of the campaign; ``sq`` [m]: of its roughness
    (None: not known yet)."""
    values = {
        "pressure": ("Hertz pressure", peak_hertz_pressure(scene), "Pa"),
        "load": ("load per width", scene.bodies.load / scene.bodies.width, "N/m"),
        "slip": ("slide-roll ratio", abs(scene.motion.slide_roll_ratio), ""),
    }
    if sq and speed:
        values["moes_ratio"] = (
            "lambda ratio of a flooded, isothermal, Newtonian film",
            scene.line_contact(abs(speed)).moes_film / sq,
            "",
        )
    outside = []
    for name, (what, value, unit) in values.items():
        low, high = known[name]
        limit = low if value < low else high
        if low <= value <= high:
            continue
        # less sliding than in any case changes the stress by little; the part of rolling is counted apart
        is_slow = name == "slip" and value < low
        distance = low - value if is_slow else abs(math.log(value / limit))
        outside.append(
            Outside(
                what=what,
                value=value,
                limit=limit,
                unit=unit,
                distance=distance,
                is_thicker=name == "moes_ratio" and value > high,
            )
        )
    others = sum(not law.is_calibrated for law in scene.lubricant.shear_laws)
    if others:
        outside.append(
            Outside(what=OTHER_LAWS, value=others, limit=0.0, unit="", distance=others * DISTANCE_OF_OTHER_OIL)
        )
    return tuple(outside)


def reported(outside: Iterable[Outside]) -> Iterator[Outside]:
    """Yield what is so far outside of the range of the campaign that a warning reports it."""
    return (part for part in outside if part.distance > NEGLIGIBLE_DISTANCE)


def widening(distances: Iterable[float]) -> float:
    """Return the factor on the bounds at ``distances`` outside the range of the campaign, in ln: 1 + their sum, at most
    `MOST_WIDENING`. Nothing was measured there."""
    return min(1.0 + sum(distances), MOST_WIDENING)
