"""The speeds that a Stribeck curve chooses, so that few points determine it everywhere."""

import math
from bisect import bisect_left, insort
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from .._base import validate
from ..errors import InputError
from ..estimate import FrictionResult
from ..models.shared import Prepared
from ..scene import FASTEST as LARGEST_SPEED
from ..scene import Scene
from ..units import without_unit
from .curve import points_of_interpolation
from .interpolate import FEWEST_SPEEDS, Interpolant, through

AUTO_SPEEDS = "auto"

# Relative distance of two speeds, or slide-roll ratios, that are one point: f cannot tell them apart, and a curve
# through both would have any slope. A choice, between rounding and steps that a user wants.
ALIKE = 1e-6

# Most speeds that a curve chooses. A choice: a bound of the work.
MOST_CHOSEN_SPEEDS = 25

# Moes' film of the whole load over Sq at the slow end of a curve: boundary lubrication. A choice: a smaller value costs
# speeds that show f_b alone.
BOUNDARY_FILM_RATIO = 0.02

# Moes' film of the whole load over Sq at the fast end of a curve: full-film lubrication. A choice, twice that of
# lift-off.
FULL_FILM_RATIO = 10.0

# Moes' film of the whole load over Sq where the asperity load ratio is about 0.9, 0.5 and 0. A choice: others begin the
# search elsewhere.
MIXED_FILM_RATIOS = (0.5, 1.5, 4.5)

# Moes' film of the whole load over Sq at the speeds that a curve chooses, about, for estimates of time: 16 random
# curves of `python -m verification.campaigns.estimates` have 11 to 15 points, 197 in all, two fifths of them above 1.5.
EXPECTED_FILM_RATIOS = (0.07, 0.2, 0.5, 0.85, 1.15, 1.5, 2.1, 2.7, 4.5, 5.2)

# Speeds that a curve chooses, about: these and both ends. A choice: it moves estimates alone.
EXPECTED_SPEEDS = 12

# Speeds to begin with. It follows from both ends and `MIXED_FILM_RATIOS`: a choice.
FIRST_SPEEDS = 5

# Speeds [m/s] between which the ends of a curve are searched. A choice: no contact moves slower or faster.
SLOWEST_SEARCHED = 1e-9
FASTEST_SEARCHED = 1e3

# Ratio of the slowest film without contact to lift-off up to which lift-off is known. A choice: a smaller value takes a
# further point.
LIFT_OFF_KNOWN_ABOVE = 1.2

# Speed over lift-off at which a film without contact is solved. A choice: nearer it may meet contact.
SPEED_ABOVE_LIFT_OFF = 1.1

# Ratio of the fastest contact to lift-off from which the end of the contact is known. A choice: a larger value takes a
# further point.
CONTACT_END_KNOWN_FROM = 0.75

# Speed over lift-off at which a contact is solved. A choice: nearer it may meet no contact.
SPEED_BELOW_LIFT_OFF = 0.86

# Ratio of neighbouring speeds without contact from which one between them is solved. A choice: f of a film is smooth
# over the speed.
MOST_SPEED_RATIO = 12.0

# Speeds within a tenth of a requested one from which no more are solved there. A choice: a third does not move a place
# that scatters.
ENOUGH_SPEEDS = 2

# Part of the tolerance that the estimated error may reach where fewer speeds than `MANY_SPEEDS` are solved: an estimate
# from few points is uncertain by a factor of about two. A choice: that factor.
ESTIMATE_SHARE = 0.5
MANY_SPEEDS = 11

# Least ratio of neighbouring speeds: closer ones differ by the tolerance of f rather than by the speed. A choice: a
# smaller value takes points that tell nothing new.
LEAST_SPEED_RATIO = 1.015

# Speeds at which the error between the points is estimated. A choice: finer than any two speeds of a curve.
SPEEDS_OF_ERROR = 400


def requested_speeds(scene: Scene, speeds: Any) -> tuple[float, ...]:
    """Return the requested speeds [m/s], one or many, each once; those of the scene for None, and none for "auto"."""
    if isinstance(speeds, str):
        if speeds == AUTO_SPEEDS:
            return ()
        meaning = f"speeds in m/s, or {AUTO_SPEEDS!r}, where each curve chooses its own"
        speeds = without_unit(f"speeds ({meaning})", speeds, "m/s")
    if speeds is None:
        speeds = scene.motion.speeds or (scene.motion.entrainment_speed,)
    return each_once(validate.numbers("speeds", speeds, "m/s", LARGEST_SPEED).tolist())


def each_once(values: Iterable[float]) -> tuple[float, ...]:
    """Return ``values`` in their order without those that repeat another to within `ALIKE`."""
    kept: list[float] = []
    ordered: list[float] = []
    for value in values:
        place = bisect_left(ordered, value)
        near = ordered[max(place - 1, 0) : place + 1]
        if not any(abs(value - other) <= ALIKE * max(abs(value), abs(other)) for other in near):
            insort(ordered, value)
            kept.append(value)
    return tuple(kept)


def alike(value: float, values: Iterable[float]) -> float:
    """Return the one of ``values`` that ``value`` repeats to within `ALIKE`, or ``value`` itself."""
    return next((other for other in values if abs(value - other) <= ALIKE * max(abs(value), abs(other))), value)


def chosen(prepared: Prepared, ahead: Sequence[float], solve: Callable[..., Any]) -> Iterator[tuple[float, Any]]:
    """Yield (speed [m/s], outcome) of a curve that begins with the speeds ``ahead``, and then chooses one after the
    other. ``solve(speed)`` gives an outcome."""
    outcomes: dict[float, Any] = {}
    while ahead and len(outcomes) < MOST_CHOSEN_SPEEDS:
        for speed in ahead:
            outcomes[speed] = solve(speed)
            yield speed, outcomes[speed]
        good = [outcome for outcome in outcomes.values() if isinstance(outcome, FrictionResult)]
        failed = [speed for speed, outcome in outcomes.items() if not isinstance(outcome, FrictionResult)]
        wanted = None
        if len(good) >= FEWEST_SPEEDS:
            wanted = next_speed(through(points_of_interpolation(good)), tolerance_between(prepared), failed)
        ahead = [] if wanted is None else [wanted]


def tolerance_between(prepared: Prepared) -> float:
    """Return the tolerance on f between the points of a curve: that on f itself. On strips of a rough surface,
    neighbouring points may be solved on different numbers of them; there it is the root sum of squares of the tolerance
    on f and the sampling tolerance."""
    return prepared.sample.tolerance_between(prepared.scene.numerics)


def next_speed(curve: Interpolant, tolerance: float, tried: Iterable[float] = ()) -> float | None:
    """Return the speed [m/s] to solve next, or None if the curve is known.

    ``tried``: speeds that failed and are left alone.

    First the knee at lift-off is enclosed: a film just thicker than the highest asperities shows where contact begins,
    and the contact just before shows how it ends. No two films are left far apart. Then comes the speed at which the
    estimated error is largest, until that is below ``tolerance`` everywhere; with few speeds, below half of it.
    """
    samples = curve.samples
    knee = curve.lift_off
    speeds = samples.speed
    taken = np.append(speeds, np.array([*tried], dtype=float))
    wanting = []
    films = speeds[samples.contacts :]
    if knee is not None:
        fastest = speeds[samples.contacts - 1]
        slowest = films[0]
        wanting += [SPEED_ABOVE_LIFT_OFF * knee] if slowest > LIFT_OFF_KNOWN_ABOVE * knee else []
        wanting += [SPEED_BELOW_LIFT_OFF * knee] if fastest < CONTACT_END_KNOWN_FROM * knee else []
    # gaps that are too wide to judge
    wanting += [float(np.sqrt(a * b)) for a, b in zip(films, films[1:]) if b > MOST_SPEED_RATIO * a]
    for wanted in wanting:
        about = np.count_nonzero(np.abs(np.log(taken / wanted)) < 0.1)
        if about < ENOUGH_SPEEDS and _free(np.array([wanted]), taken)[0]:
            return wanted
    grid, error = _errors_between(curve, taken)
    if error.max() <= (tolerance if speeds.size >= MANY_SPEEDS else ESTIMATE_SHARE * tolerance):
        return None
    return float(grid[error.argmax()])


def between(curve: Interpolant) -> float:
    """Return the largest relative error of f that a curve is estimated to have between its points."""
    return float(errors_of_gaps(curve).max())


def errors_of_gaps(curve: Interpolant) -> np.ndarray:
    """Return the largest relative error of f that a curve is estimated to have between each two neighbouring speeds,
    (n - 1,)."""
    speeds = curve.samples.speed
    grid, error = _errors_between(curve, speeds)
    largest = np.zeros(speeds.size - 1)
    np.maximum.at(largest, np.searchsorted(speeds, grid) - 1, error)
    return largest


def _errors_between(curve: Interpolant, taken: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return speeds [m/s] between the ends of a curve and the estimated relative error of f at each, which is 0 near
    the speeds that are ``taken``."""
    speeds = curve.samples.speed
    grid = np.geomspace(speeds[0], speeds[-1], SPEEDS_OF_ERROR)[1:-1]
    return grid, np.where(_free(grid, taken), curve.error(grid), 0.0)


def _free(at: np.ndarray, speeds: np.ndarray) -> np.ndarray:
    """Return the speeds of ``at`` that are not too close to a solved one."""
    return np.abs(np.log(at[:, None] / speeds[None, :])).min(axis=1) > np.log(LEAST_SPEED_RATIO)


def first_speeds(scene: Scene, sq: float) -> tuple[float, ...]:
    """Return the first speeds [m/s], fastest first, at least 5: both ends of `span`, and where Moes' film under the
    total load is 0.5, 1.5 and 4.5 times Sq, because there rough line contacts pass from boundary lubrication to
    full film."""
    return _speeds_at(scene, sq, MIXED_FILM_RATIOS, FIRST_SPEEDS)


def expected_speeds(scene: Scene, sq: float) -> tuple[float, ...]:
    """Return the speeds [m/s] that a curve is expected to choose, fastest first, for estimates of time: both ends of
    `span`, and where Moes' film under the total load is `EXPECTED_FILM_RATIOS` times Sq."""
    return _speeds_at(scene, sq, EXPECTED_FILM_RATIOS, EXPECTED_SPEEDS)


def _speeds_at(scene: Scene, sq: float, ratios: Sequence[float], count: int) -> tuple[float, ...]:
    """Return at least ``count`` speeds [m/s], fastest first: both ends of `span`, those of the film ``ratios`` between
    them, and means of neighbours."""
    low, high = span(scene, sq)
    speeds = [low, high]
    if sq > 0:
        least = film_ratio(scene, sq, low) / 0.9
        most = film_ratio(scene, sq, high) / 1.1
        speeds += [_speed_of(scene, sq, ratio, low, high) for ratio in ratios if least < ratio < most]
    while len(speeds) < count:
        speeds.sort()
        _, widest = max((math.log(b / a), i) for i, (a, b) in enumerate(zip(speeds, speeds[1:])))
        speeds.append(math.sqrt(speeds[widest] * speeds[widest + 1]))
    return tuple(sorted(speeds, reverse=True))


def span(scene: Scene, sq: float) -> tuple[float, float]:
    """Return the (lowest, highest) entrainment speed [m/s] of a curve: those of ``motion.speeds``. Without these, the
    speeds at which Moes' film of the total load is 0.02 and 10 times Sq.

    Raises `InputError` for negative speeds, and for a smooth surface without speeds, which has no such range.
    """
    if any(u < 0 for u in scene.motion.speeds):
        ways = "give motion.speed_range, or speeds in m/s"
        raise InputError(
            " = 'auto' chooses speeds above 0, and motion.speeds are below 0", "speeds", recommendation=ways
        )
    speeds = sorted({u for u in scene.motion.speeds if u != 0})
    if len(speeds) > 1:
        return speeds[0], speeds[-1]
    if sq <= 0:
        raise InputError("speeds = 'auto' of a smooth surface (Sq = 0 m) needs a range; give motion.speed_range in m/s")
    if (
        film_ratio(scene, sq, SLOWEST_SEARCHED) > BOUNDARY_FILM_RATIO
        or film_ratio(scene, sq, FASTEST_SEARCHED) < FULL_FILM_RATIO
    ):
        message = " = 'auto' finds no range from boundary lubrication to a full film"
        raise InputError(message, "speeds", recommendation="give motion.speed_range")
    return _speed_of(scene, sq, BOUNDARY_FILM_RATIO, SLOWEST_SEARCHED, FASTEST_SEARCHED), _speed_of(
        scene, sq, FULL_FILM_RATIO, SLOWEST_SEARCHED, FASTEST_SEARCHED
    )


def film_ratio(scene: Scene, sq: float, speed: float) -> float:
    """Return Moes' film of the total load over Sq."""
    return scene.line_contact(speed).moes_film / sq


def _speed_of(scene: Scene, sq: float, ratio: float, low: float, high: float) -> float:
    """Return the speed [m/s] between ``low`` and ``high`` at which `film_ratio` is ``ratio``."""
    from scipy.optimize import brentq

    def excess(log_speed: float) -> float:
        return math.log(film_ratio(scene, sq, math.exp(log_speed)) / ratio)

    return math.exp(brentq(excess, math.log(low), math.log(high), xtol=1e-6))
