"""Calibrated load sharing: the friction of a rough film (`rough_film`), without its bias, and with the error that a
campaign of solved cases leaves (`calibrated_error`)."""

import math
from dataclasses import asdict, dataclass, replace

import numpy as np

from ...samples import Sample
from ...scene import Scene, moves, moving_bodies
from ..shared import Prepared, StandardError, error_by_heat, limit_bounds, on_strip
from .balance import Balance, solve_balance
from .calibrated_error import error_model_of, error_models, features, out_of_range, rms_slopes, weight_of, widening
from .rough_film import RoughFilm, RoughMap, rough_film

# Share of the rolling part in |f| [-] between which the calibration passes over from f to its sliding part: where
# rolling is most of f, f may be a small difference, whose relative error means nothing. Not measured: the campaign has few
# such cases.
OF_SLIDING = (0.25, 0.5)
# Friction coefficient [-] below which a relative error means nothing.
LEAST_FRICTION = 1e-9
STRIPS = 4  # of the rough film: f of one scatters by some 7 % about their mean (scene "paper", .03 m/s)
ROLLING = 8.0  # of the rolling part of f: what pressure on the flanks of moving roughness may add (docs/uncertainty.md)
FLANKS = 1.5  # Moes' film over Sq from which on that falls, with the square of it


@dataclass(frozen=True, kw_only=True)
class CalibratedFriction:
    """f by calibrated load sharing, and its error.

    coefficient : f, with the bias taken away; film : the rough film behind it
    bounds : 95 % bounds of f by the model, relative, below and above; least_bounds : those that a contact in the range
        of the campaign would have; bias : that was taken away, of ln f
    of_strips : relative standard error of f by the scatter of the strips, beside that of Eq. (9) on the line
    by_film : relative change of f by half and by twice the boundary film
    by_heat : relative error of f by what heat does to it (`lubfric.models.shared.error_by_heat`)
    by_limit : how much lower and higher f is with the limiting stress of a Newtonian oil at the ends of what oils
        have; zeros where that does not matter
    weight : of this f in the answer; below 1 where Moes' film over Sq is below that of the campaign (`weight_of`)
    cases : number of solved cases behind the bounds; outside : what is outside of their range, as text
    """

    coefficient: float
    film: RoughFilm
    bounds: tuple[float, float]
    least_bounds: tuple[float, float]
    bias: float
    of_strips: StandardError
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
    """Return f of ``prepared``, whose ``sample`` is resolved, at ``speed`` [m/s], not 0.

    ``line``: its balance of load sharing on all strips. The rough film is the mean over `STRIPS` strips. The ratio of f by
    Eq. (9) on the line and on a strip corrects f of the strip; what is left of the scatter is a sampling error.
    Raises `ConvergenceError`."""
    scene = prepared.scene
    start = replace(line, contact=replace(line.contact, fields=None)) if line.response is not None else None
    count = min(STRIPS, sample.available)
    strips = [film_on_strip(prepared, sample, scene, speed, start, k) for k in range(count)]
    film = _mean_film([strip.film for strip in strips])
    heat = 1 - (line.forces.heat.change if line.forces.heat.heated else 0.0)
    model = error_model_of(scene)
    sq = prepared.surface.sq
    outside = out_of_range(scene, sq, speed, model.range)
    x = _mean_features([strip.features for strip in strips])
    bias = model.bias_at(x)
    in_range = model.half_width(x)
    width = in_range * widening(outside.values())
    values = np.array([strip.film.coefficient * _of_line(strip.balance, line) for strip in strips])
    values *= math.exp(bias) * heat
    downwards = -math.expm1(-width)
    upwards = math.expm1(width)
    relative = 1.0
    if (part := _part_of_sliding(film)) > 0:
        x = _mean_features([strip.sliding_features for strip in strips])
        factor = math.exp(model.bias_at(x)) * heat
        sliding = np.array([strip.film.coefficient - strip.film.rolling for strip in strips]) * factor
        values = (1 - part) * values + part * (film.rolling + sliding)
        size = max(abs(float(values.mean())), LEAST_FRICTION)
        share = abs(float(sliding.mean())) / size
        width = model.half_width(x) * widening(outside.values())
        downwards = (1 - part) * downwards + part * share * -math.expm1(-width)
        upwards = (1 - part) * upwards + part * share * math.expm1(width)
        relative = (1 - part) + part * abs(film.coefficient) / size
    flanks = _by_flanks(scene, film, sq, speed) * relative
    half, twice = (0.0, 0.0) if scene.bodies.boundary_film is not None else _changes(film)
    limits = (film.at_least_limit, film.at_most_limit)
    lower, higher = limit_bounds(scene, film.saturated_film_share, film.coefficient, limits)
    return CalibratedFriction(
        coefficient=float(values.mean()),
        film=film,
        of_strips=_scatter(values),
        bounds=(math.hypot(downwards, flanks), math.hypot(upwards, flanks)),
        least_bounds=(-math.expm1(-in_range), math.expm1(in_range)),
        bias=bias,
        by_film=(half * relative, twice * relative),
        by_heat=_by_heat(line),
        by_limit=(lower * relative, higher * relative),
        weight=weight_of(scene, sq, speed, model.range["lambda"][0]),
        cases=model.cases,
        outside=tuple(outside),
    )


def _part_of_sliding(film: RoughFilm) -> float:
    """Return the part of the answer, 0 to 1, that takes bias and bounds of the sliding part of f (`OF_SLIDING`)."""
    low, high = OF_SLIDING
    share = abs(film.rolling) / max(abs(film.coefficient), LEAST_FRICTION)
    return min(max((share - low) / (high - low), 0.0), 1.0)


def _mean_features(rows: list[dict[str, float]]) -> dict[str, float]:
    """Return the mean of every feature of the strips."""
    return {name: float(np.mean([row[name] for row in rows])) for name in rows[0]}


@dataclass(frozen=True, kw_only=True)
class StripFilm:
    """The balance of load sharing on one strip, its rough film, and the `features` of both; ``sliding_features``: those
    of the film without the rolling part of its friction."""

    balance: Balance
    film: RoughFilm
    features: dict[str, float]
    sliding_features: dict[str, float]


def film_on_strip(
    prepared: Prepared, sample: Sample, scene: Scene, speed: float, start: Balance | None, index: int = 0
) -> StripFilm:
    """Return the rough film of ``scene``, which may differ from that of ``prepared`` in inputs, on strip ``index`` of
    ``sample`` at ``speed`` [m/s]. Raises `ConvergenceError`."""
    contact = on_strip(prepared, sample, index)
    if scene.bodies.hardness != prepared.scene.bodies.hardness:
        contact = replace(contact, hardness=scene.bodies.hardness)
    sq = prepared.surface.sq
    balance = solve_balance(scene, speed, contact, sq, start)
    film = rough_film(scene, speed, contact, balance, rough_maps(prepared, sample, contact.heights, speed, index))
    slopes = rms_slopes(contact.heights, contact.spacing)
    sliding = asdict(film) | {"coefficient": film.coefficient - film.rolling, "rolling": 0.0}
    return StripFilm(
        balance=balance,
        film=film,
        features=features(scene, speed, sq, slopes, asdict(film)),
        sliding_features=features(scene, speed, sq, slopes, sliding),
    )


def _of_line(strip: Balance, line: Balance) -> float:
    """Return f of the ``line`` over f of the ``strip``, both by Eq. (9); 1 where one is not positive."""
    here = strip.forces.coefficient
    there = line.forces.coefficient
    return there / here if here > 0 < there else 1.0


def _mean_film(films: list[RoughFilm]) -> RoughFilm:
    """Return the mean of every number of ``films``."""
    rows = [asdict(film) for film in films]
    return RoughFilm(**{name: float(np.mean([row[name] for row in rows])) for name in rows[0]})


def _scatter(values: np.ndarray) -> StandardError:
    """Return the relative standard error of the mean of ``values`` of independent strips; of one it is not known here."""
    if values.size < 2 or values.mean() == 0:
        return StandardError(0.0, 0)
    return StandardError(float(values.std(ddof=1) / math.sqrt(values.size) / abs(values.mean())), values.size - 1)


def rough_maps(prepared: Prepared, sample: Sample, heights: np.ndarray, speed: float, index: int = 0) -> list[RoughMap]:
    """Return the map of each rough body on strip ``index``, whose ``heights`` [m] are those of all, and its speed along
    x at U = ``speed`` [m/s]."""
    bodies = moving_bodies(prepared.scene)
    if len({ratio for _, ratio in bodies}) < 2 or prepared.joint:
        return [RoughMap(heights, speed * bodies[0][1])]
    return [RoughMap(sample.of_body(k).strip(index).heights, speed * ratio) for k, (_, ratio) in enumerate(bodies)]


def _by_heat(line: Balance) -> float:
    """Return the relative error of f by what heat does to it, as the load-sharing balance ``line`` knows it."""
    forces = line.forces
    response = line.response
    by_film = forces.film_sensitivity if response is None else response.per_film(forces, line.contact.mean_film)
    return error_by_heat(forces.heat, 1 - forces.heat.film_factor**by_film)


def _by_flanks(scene: Scene, film: RoughFilm, sq: float, speed: float) -> float:
    """Return the relative error of f by the pressure on the flanks of moving roughness, in rolling with almost no
    sliding; with more of it the campaign has it."""
    known = error_models()["rolling"].range["slip"][0]
    if not moves(scene) or abs(scene.motion.slide_roll_ratio) >= known or film.coefficient == 0:
        return 0.0
    moes_ratio = scene.line_contact(abs(speed)).moes_film / sq
    return ROLLING * min(1.0, (FLANKS / moes_ratio) ** 2) * abs(film.rolling / film.coefficient)


def _changes(film: RoughFilm) -> tuple[float, float]:
    return film.at_half_film / film.coefficient - 1, film.at_twice_film / film.coefficient - 1
