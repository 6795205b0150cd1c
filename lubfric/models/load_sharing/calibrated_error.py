"""The error of rough-film friction, as a campaign of solved cases shows it.

The campaign (``python -m verification calibration``) solves random contacts by load sharing and by the deterministic
model. ln(f deterministic/f) has a mean, the bias b·x, and a standard deviation σ = exp(s·y), both linear in a few
`features` of the solution; C is the covariance of b. The 95 % bounds are bias ± k sqrt(σ² + x·C x), so that they widen
where few cases are like the contact. k is the 95 % quantile of what was seen on kinds of cases (fluids, lays, loads,
slide-roll ratios) that were excluded from the fit, one kind at a time (conformal prediction). calibration.toml has the numbers.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np

from ..._base import packaged
from ...oil import log_viscosity_ratio
from ...scene import Scene, moves
from ..shared import peak_hertz_pressure
from .rough_film import BOUNDARY_FILM

# of features that grow without end where f or the film tends to 0
MOST_PART = 1.5  # parts of f over f
MOST_SENSITIVE = 1.5  # d ln f/d logit of the asperity load
MOST_CONTRAST = 1.5
LEAST_SHARE = 1e-4  # of the load on asperities, and what is left to 1 at most
VISCOUS = (
    8.0  # ln(viscosity at the mean Hertz pressure over that at ambient pressure) from which on more changes nothing
)
MIDDLE_VISCOUS = 4.0  # of the cases
MIDDLE_SLOPE = 0.015  # rms slope along y, of the cases
RIDGES = math.log(5.0)  # ln of length over width of the ridges that the feature "lay" calls 1
WIDEST = 3.0  # factor on the bounds far outside the range of the campaign


@dataclass(frozen=True, kw_only=True)
class ErrorModel:
    """The distribution of ln(f deterministic/f) for a kind of contact: roughness at rest, or moving.

    cases : number of solved cases; bias : coefficient of each feature; covariance : of these coefficients
    spread : coefficient of each feature in ln σ; quantile : k; least_spread : σ that one case in a hundred is below
    range : least and largest pressure [Pa], Moes' film over Sq [-], load [N/m] and slide-roll ratio [-] of the cases
    """

    cases: int
    bias: Mapping[str, float]
    covariance: np.ndarray
    spread: Mapping[str, float]
    quantile: float
    least_spread: float
    range: Mapping[str, tuple[float, float]]

    def bias_at(self, x: Mapping[str, float]) -> float:
        """Return the mean of ln(f deterministic/f) at the features ``x``."""
        return sum(factor * x[name] for name, factor in self.bias.items())

    def half_width(self, x: Mapping[str, float]) -> float:
        """Return the half-width of the 95 % interval of ln f at the features ``x``."""
        spread = math.exp(sum(factor * x[name] for name, factor in self.spread.items()))
        direction = np.array([x[name] for name in self.bias])
        return self.quantile * math.sqrt(spread**2 + float(direction @ self.covariance @ direction))


@cache
def error_models() -> dict[str, ErrorModel]:
    """Return the error models by kind of contact, "rest" or "rolling"."""
    tables = packaged(__package__, "calibration.toml")
    return {kind: ErrorModel(**table | {"covariance": np.array(table["covariance"])}) for kind, table in tables.items()}


def error_model_of(scene: Scene) -> ErrorModel:
    """Return the error model for ``scene``."""
    return error_models()["rolling" if moves(scene) else "rest"]


def least_half_width() -> float:
    """Return a half-width that hardly any contact is below, relative."""
    return min(math.expm1(model.quantile * model.least_spread) for model in error_models().values())


def features(
    scene: Scene, speed: float, sq: float, slopes: tuple[float, float], film: Mapping[str, float]
) -> dict[str, float]:
    """Return what bias and σ may depend on, by name, for the rough ``film`` (the numbers of a `RoughFilm`).

    ``sq`` [m] and rms ``slopes`` along x and y: of the roughness that is not flattened. The friction is f = f_b a + t (1 -
    a) + rolling, with the share a of the load on asperities and the mean stress t of the film over its pressure. The
    features are

    - "one"; "film": t (1 - a)/f; "unthinned": the same for a fluid whose flow no shear thins, else 0
    - "asperity": S = a (1 - a) (f_b - t)/f, by which f changes with the logit of a; and S times
      "thickness", ln of Moes' film over the boundary film; "contact", the share of the load on the flattened roughness; "width",
      ln of the wavelength along y over the Hertz half-width; "length", the same along x; "lay" times ln of Moes'
      film over Sq; "thinness", the square of that; "no thinning", 1 for a fluid as above
    - of σ only: "sensitivity" |S|; "contrast"; "viscous", ln of the viscosity at the mean Hertz pressure;
      "rolling", the part of f; "slope" along y and "wavelength" along x, both as ln.
    """
    line = scene.line_contact(abs(speed))
    bodies = scene.bodies
    f = max(abs(film["coefficient"]), 1e-12)
    friction = bodies.boundary_friction_coefficient * (scene.motion.slide_roll_ratio != 0)
    share = min(max(film["asperity"], LEAST_SHARE), 1 - LEAST_SHARE)
    in_film = max(film["coefficient"] - friction * share - film["rolling"], 1e-6 * f)
    stress = in_film / (1 - share)
    sensitivity = min(max(share * (1 - share) * (friction - stress) / f, -0.5), MOST_SENSITIVE)
    part = min(in_film / f, MOST_PART)
    thins_not = float(scene.lubricant.flow_law is None)
    viscous = float(log_viscosity_ratio(line.lubricant, np.array(bodies.mean_hertz_pressure))[0])
    along, across = (max(slope, 1e-9) for slope in slopes)
    lay = math.log(across / along) / RIDGES
    wavelength, width = (math.log(math.sqrt(2) * sq / slope / bodies.half_width) for slope in (along, across))
    log_moes_ratio = math.log(line.moes_film / sq)
    contrast = abs(friction - f) / f * math.sqrt(share / (1 - share))
    return {
        "one": 1.0,
        "film": part,
        "unthinned": part * thins_not,
        "asperity": sensitivity,
        "asperity thickness": sensitivity * math.log(line.moes_film / BOUNDARY_FILM),
        "asperity contact": sensitivity * film["contact"],
        "asperity width": sensitivity * width,
        "asperity length": sensitivity * wavelength,
        "asperity lay": sensitivity * lay * log_moes_ratio,
        "asperity thinness": sensitivity * log_moes_ratio**2,
        "asperity no thinning": sensitivity * thins_not,
        "sensitivity": min(abs(sensitivity), 1.0),
        "contrast": min(contrast, MOST_CONTRAST),
        "viscous": min(max(viscous, 0.0), VISCOUS) - MIDDLE_VISCOUS,
        "rolling": min(abs(film["rolling"]) / f, MOST_PART),
        "slope": math.log(across / MIDDLE_SLOPE),
        "wavelength": wavelength,
    }


def rms_slopes(heights: np.ndarray, spacing: tuple[float, float]) -> tuple[float, float]:
    """Return the rms slopes along x and y of ``heights`` [m] (nx, ny) on cells of the ``spacing`` [m]."""
    along, across = (float(np.sqrt(np.mean(np.diff(heights, axis=k) ** 2))) / spacing[k] for k in (0, 1))
    return along, across


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


def weight_of(scene: Scene, sq: float, speed: float, least: float) -> float:
    """Return the weight of calibrated friction compared with Eq. (9), which is right where asperities carry the total
    load.

    It is 1 from the ``least`` ratio of Moes' film to Sq of the campaign on, falls linearly in its logarithm, and is 0
    below half of it.
    """
    moes_ratio = scene.line_contact(abs(speed)).moes_film / sq
    return min(max(1.0 + math.log(moes_ratio / least) / math.log(2.0), 0.0), 1.0)


def widening(distances: Iterable[float]) -> float:
    """Return the factor on the bounds at ``distances`` outside the range of the campaign, in ln: 1 + their sum, at most
    `WIDEST`. Nothing was measured there."""
    return min(1.0 + sum(distances), WIDEST)
