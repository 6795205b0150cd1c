"""Calibrated load sharing: the friction of a rough film (`rough_film`), and the error that a campaign of solved cases
leaves of it.

The campaign (``python -m verification calibration``) solves random contacts by this model and by the deterministic
one. ln(f deterministic/f) has a mean, the bias, and a standard deviation σ = exp(Σ c_i x_i) in a few features x_i of
the solution (`features`). The 95 % bounds are bias ± k sqrt(σ² + variance of the bias); k is the 95 % quantile of what
was seen on kinds of cases (fluids, lays, loads, slide-roll ratios) that were excluded from the fit, one kind at a time
(split conformal prediction). calibration.toml has the numbers. Outside the range of the campaign the bounds widen
(`widening`).
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np

from ..._base import packaged
from ...samples import Sample
from ...scene import Scene, moves, moving_bodies
from ..shared import Prepared, error_by_heat, limit_bounds, on_strip
from .balance import Balance, solve_balance
from .rough_film import RoughFilm, RoughMap, rough_film

MOST = 1.5  # of the features "contrast" and "rolling", which grow without end where f tends to 0
ROLLING = 8.0  # of the rolling part of f: what pressure on the flanks of moving roughness may add (docs/uncertainty.md)
SLIGHT = 0.1  # slide-roll ratio below which pressure on the flanks of the roughness counts in f
MOST_SLIGHT = 4.0  # of the feature "slight", ln(SLIGHT/slip), which grows without end where slip tends to 0
FLANKS = 1.5  # lambda ratio from which on that falls, with the square of it


@dataclass(frozen=True, kw_only=True)
class CalibratedFriction:
    """f by calibrated load sharing, and its error.

    coefficient : f, with the bias taken away; film : the rough film behind it
    bounds : 95 % bounds of f by the model, relative, below and above; least_bounds : those that a contact in the range
        of the campaign would have; bias : that was taken away, of ln f
    by_film : relative change of f by half and by twice the boundary film
    by_heat : relative error of f by what heat does to it (`lubfric.models.shared.error_by_heat`)
    by_limit : how much lower and higher f is with the limiting stress of a Newtonian oil at the ends of what oils
        have; zeros where that does not matter
    weight : of this f in the answer; below 1 where the lambda ratio is below that of the campaign (`weight_of`)
    cases : number of solved cases behind the bounds; outside : what is outside of their range, as text
    """

    coefficient: float
    film: RoughFilm
    bounds: tuple[float, float]
    least_bounds: tuple[float, float]
    bias: float
    by_film: tuple[float, float]
    by_heat: float
    by_limit: tuple[float, float]
    weight: float
    cases: int
    outside: tuple[str, ...] = ()

    @property
    def sides(self) -> tuple[float, float]:
        """Model-form error of f at 95 %, relative, below and above: the bounds, the boundary film where the scene does
        not give it, heat, and the limit of the oil."""
        by_film = max(map(abs, self.by_film))
        down, up = (math.hypot(bound, by_film, self.by_heat, limit) for bound, limit in zip(self.bounds, self.by_limit))
        return min(down, 1.0), up

    @property
    def error(self) -> float:
        """The larger side without the limit of the oil: what counts against ``numerics.model_tolerance``."""
        return math.hypot(max(self.bounds), max(map(abs, self.by_film)), self.by_heat)


def calibrated_friction(prepared: Prepared, sample: Sample, speed: float, line: Balance) -> CalibratedFriction:
    """Return f of ``prepared``, whose ``sample`` is resolved, at ``speed`` [m/s], not 0. ``line``: its balance of load
    sharing on all strips; the rough film is that of the first one, and the ratio of their f by Eq. (9) corrects for it.
    Raises `ConvergenceError`."""
    scene = prepared.scene
    start = replace(line, contact=replace(line.contact, fields=None)) if line.response is not None else None
    balance, film = film_on_strip(prepared, sample, scene, speed, start)
    here = balance.forces.coefficient
    there = line.forces.coefficient
    of_line = there / here if here > 0 < there else 1.0
    heat = line.forces.heat.change if line.forces.heat.heated else 0.0
    kind = "rolling" if moves(scene) else "rest"
    fit = calibration()[kind]
    x = features(scene, film)
    bias = fit["bias"]
    f = film.coefficient * of_line * math.exp(bias) * (1 - heat)
    outside = out_of_range(scene, prepared.surface.sq, speed, fit["range"])
    in_range = half_width(x, fit)
    width = in_range * widening(outside.values())
    flanks = _by_flanks(scene, film, prepared.surface.sq, speed)
    bounds = (math.hypot(-math.expm1(-width), flanks), math.hypot(math.expm1(width), flanks))
    return CalibratedFriction(
        coefficient=f,
        film=film,
        bounds=bounds,
        least_bounds=(-math.expm1(-in_range), math.expm1(in_range)),
        bias=bias,
        by_film=(0.0, 0.0) if scene.bodies.boundary_film is not None else _changes(film),
        by_heat=_by_heat(line),
        by_limit=limit_bounds(scene, film.saturated_film, film.coefficient, (film.at_least_limit, film.at_most_limit)),
        weight=weight_of(scene, prepared.surface.sq, speed, fit["range"]["lambda"][0]),
        cases=fit["cases"],
        outside=tuple(outside),
    )


def film_on_strip(
    prepared: Prepared, sample: Sample, scene: Scene, speed: float, start: Balance | None
) -> tuple[Balance, RoughFilm]:
    """Return the balance and the rough film of ``scene``, which may differ from that of ``prepared`` in inputs, on the
    first strip of ``sample`` at ``speed`` [m/s]. Raises `ConvergenceError`."""
    contact = on_strip(prepared, sample, 0)
    if scene.bodies.hardness != prepared.scene.bodies.hardness:
        contact = replace(contact, hardness=scene.bodies.hardness)
    balance = solve_balance(scene, speed, contact, prepared.surface.sq, start)
    return balance, rough_film(scene, speed, contact, balance, rough_maps(prepared, sample, contact.heights, speed))


def rough_maps(prepared: Prepared, sample: Sample, heights: np.ndarray, speed: float) -> list[RoughMap]:
    """Return the map of each rough body on the first strip, whose ``heights`` [m] are those of all, and its speed along
    x at U = ``speed`` [m/s]."""
    bodies = moving_bodies(prepared.scene)
    if len({ratio for _, ratio in bodies}) < 2 or prepared.joint:
        return [RoughMap(heights, speed * bodies[0][1])]
    return [RoughMap(sample.of_body(k).strip(0).heights, speed * ratio) for k, (_, ratio) in enumerate(bodies)]


def features(scene: Scene, film: RoughFilm) -> dict[str, float]:
    """Return what σ depends on, by name: the ``contrast`` between f_b and the friction of the film, which an error of
    the load on the boundary film exchanges; the load ratio of the ``contact``; the part of ``rolling`` in f; and how ``slight`` the sliding is, ln(SLIGHT/slip)."""
    f = abs(film.coefficient)
    friction = scene.bodies.boundary_friction_coefficient * (scene.motion.slide_roll_ratio != 0)
    slip = scene.motion.slide_roll_ratio
    return numbers_of(film.coefficient, film.asperity, friction, film.contact, film.rolling / max(f, 1e-12), slip)


def numbers_of(
    f: float, boundary: float, friction: float, contact: float, rolling: float, slip: float
) -> dict[str, float]:
    """Return the features of a film with the coefficient ``f``, of which a share ``boundary`` of the load rubs with
    ``friction``; ``rolling``: over f; ``slip``: the slide-roll ratio."""
    share = min(max(boundary, 0.0), 1.0)
    exchanged = abs(friction - f) / max(abs(f), 1e-12) * math.sqrt(share / (1 - share)) if share < 1 else 0.0
    return {
        "one": 1.0,
        "contrast": min(exchanged, MOST),
        "contact": contact,
        "rolling": min(abs(rolling), MOST),
        "slight": min(max(math.log(SLIGHT / max(abs(slip), 1e-12)), 0.0), MOST_SLIGHT),
    }


def half_width(x: Mapping[str, float], fit: Mapping[str, Any]) -> float:
    """Return the half-width of the 95 % interval of ln f at the features ``x``, by the ``fit`` of a kind of contact."""
    sigma = math.exp(sum(factor * x[name] for name, factor in fit["spread"].items()))
    return fit["quantile"] * math.hypot(sigma, fit["bias_error"])


def out_of_range(scene: Scene, sq: float, speed: float, known: Mapping[str, Any]) -> dict[str, float]:
    """Return how far ``scene`` is outside the range of the campaign, in ln, by a description as text."""
    line = scene.line_contact(abs(speed))
    ratio = abs(scene.motion.slide_roll_ratio)
    values = {
        "pressure": ("Hertz pressure of {:.3g} Pa", math.pi / 4 * scene.bodies.mean_hertz_pressure),
        "lambda": ("lambda ratio of {:.3g}", line.moes_film / sq),
        "load": ("load of {:.3g} N/m", scene.bodies.load / scene.bodies.width),
        "slip": ("slide-roll ratio of {:.3g}", ratio),
    }
    words = {}
    for name, (text, value) in values.items():
        low, high = known[name]
        if value < low:
            # less sliding than in any case changes the stress by little; the part of rolling is `_by_flanks`
            words[f"{text.format(value)}, below {low:.3g}"] = low - value if name == "slip" else math.log(low / value)
        elif value > high:
            words[f"{text.format(value)}, above {high:.3g}"] = math.log(value / high)
    return words


def weight_of(scene: Scene, sq: float, speed: float, least: float) -> float:
    """Return the weight of calibrated friction compared with Eq. (9), which is right where asperities carry the total
    load.

    It is 1 from the ``least`` lambda ratio of the campaign on, falls linearly in its logarithm, and is 0 below half of
    it.
    """
    ratio = scene.line_contact(abs(speed)).moes_film / sq
    return min(max(1.0 + math.log(ratio / least) / math.log(2.0), 0.0), 1.0)


def widening(distances: Iterable[float]) -> float:
    """Return the factor on the bounds at ``distances`` outside the range of the campaign, in ln: 1 + their sum, at most
    3. Nothing was measured there."""
    return min(1.0 + sum(distances), 3.0)


def _by_heat(line: Balance) -> float:
    """Return the relative error of f by what heat does to it, as the load-sharing balance ``line`` knows it."""
    forces = line.forces
    response = line.response
    by_film = forces.film_sensitivity if response is None else response.per_film(forces, line.contact.mean_film)
    return error_by_heat(forces.heat, 1 - forces.heat.film_factor**by_film)


def _by_flanks(scene: Scene, film: RoughFilm, sq: float, speed: float) -> float:
    """Return the relative error of f by the pressure on the flanks of moving roughness, in rolling with almost no
    sliding; with more of it the campaign has it."""
    known = calibration()["rolling"]["range"]["slip"][0]
    if not moves(scene) or abs(scene.motion.slide_roll_ratio) >= known or film.coefficient == 0:
        return 0.0
    ratio = scene.line_contact(abs(speed)).moes_film / sq
    return ROLLING * min(1.0, (FLANKS / ratio) ** 2) * abs(film.rolling / film.coefficient)


def _changes(film: RoughFilm) -> tuple[float, float]:
    return film.at_half_film / film.coefficient - 1, film.at_twice_film / film.coefficient - 1


def least_half_width() -> float:
    """Return the least half-width that calibrated load sharing can have, relative."""
    fits = calibration().values()
    return min(
        math.expm1(fit["quantile"] * math.exp(fit["spread"]["one"] - abs(fit["spread"]["contact"]))) for fit in fits
    )


@cache
def calibration() -> dict[str, Any]:
    """Return the numbers of calibration.toml, by kind of contact: "rest" or "rolling"."""
    return packaged(__package__, "calibration.toml")
