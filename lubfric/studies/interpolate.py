"""Friction between the solved speeds: the contact's share of the load and the film's traction coefficient are
interpolated, in coordinates in which each is smooth.

With s = F_C/F_T, f = (b/s) s + t (1 - s): b = f_b F_C/F_T is the part of f from the asperity contacts, and
t = F_sh/F_H the traction coefficient of the film. In contact t is interpolated over ln U, above lift-off t/sqrt(U) over
1/sqrt(U). Two known trends of the share are removed: in boundary lubrication the ratio
(1 - s)/s of film to asperity load grows about in proportion to the speed, and at lift-off U_0 the share ends like that
of one Hertz asperity, as (1 - U/U_0)^(3/2). The remainder, ln((1 - s)/s) - ln(U/U_0) + 3/2 ln(1 - U/U_0), is
interpolated over U^0.6, which grows about as the film does, with the slopes that are known at the points. All
interpolations are cubics; those of t and b are monotone wherever their points are, so that f has a bump or a minimum
between two points only where b falls and the film's part rises. Both parts go through all points, also those where they
carry hardly any load. Other cubics, and where the points are far apart a monotone cubic and a line through f itself,
are compared with them to estimate the error.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np

from .._base import FloatArray
from ..errors import InputError
from ..models.shared import LARGE_NUMERICAL_ERROR
from ..quantities import counted

# Fewest solved speeds of a curve. A choice: two show no bend.
FEWEST_SPEEDS = 3

# Power of the speed over which the asperity load ratio is interpolated: about that of the film. A choice: by Moes that
# has .6 to 1.
LOAD_RATIO_POWER = 0.6

# Power of the remaining speed with which a contact ends: that of a Hertz asperity. It follows from load ~
# approach^(3/2) (Hertz 1882).
HERTZ = 1.5

# Other powers, whose effect is part of the estimated error. A choice on both sides of it.
OTHER_POWERS = (1.0, 2.0)

# Power of the speed of a film, where one speed alone is known. A choice, as in `LOAD_RATIO_POWER`.
FILM_POWER = 0.8

# An estimate of lift-off below NEAR_CONTACT times a speed with contact is taken to be BEYOND times that speed. A
# choice: lift-off is above that speed.
NEAR_CONTACT = 1.003
BEYOND = 1.03

# Error of an extrapolated lift-off, as a part of the logarithm of the ratio over which it is extrapolated. A choice: a
# smaller value narrows an error that is not measured.
EXTRAPOLATED_ERROR = 0.05

# `EXTRAPOLATED_ERROR` of a lift-off in the middle of the solved speeds around it, where the film is not extrapolated. A
# choice: at 1 the contact would end at a solved speed, and the interpolation overshoots between the others.
MIDDLE_ERROR = 0.5

# Ratio of the two solved speeds around lift-off up to which its place between them is stated: an extrapolation over a
# longer way rests on the power law of the film alone. A convention.
WIDEST_BRACKET = 2.0

# Ratios of neighbouring speeds: up to NEAR_SPEEDS a monotone cubic through f itself is not compared, from FAR_SPEEDS
# on wholly. These, and the factors below, are chosen so that on subsets of 3 to 14 of 31 or 37 speeds of eleven curves
# of the models "paper" and "quick" the error, with that of the points, holds at 97 % of the speeds left out.
NEAR_SPEEDS = 1.6
FAR_SPEEDS = 4.0

# These ratios for straight lines between the points. A choice: from half a decade on.
STRAIGHT_FROM = 3.3
STRAIGHT_WHOLLY = 7.4

# Speeds among which the least f of a curve is searched. A choice: it costs no solve.
MINIMUM_GRID = 1000

# Error between the points, over that at a point which the curve through the others has: of near speeds, and of far
# ones. A choice: the omission of a point doubles the distance.
BETWEEN_NEAR_POINTS = 0.6
BETWEEN_FAR_POINTS = 1.0

# Error between the points, over the difference of both kinds of cubics. A choice: both are monotone, and so more alike
# than one of them is to f.
BETWEEN_CUBICS = 2.0

# Largest slope of a cubic at a point, over that of the flatter secant beside it. A choice: up to 3 it is monotone
# between the points (Fritsch and Carlson, SIAM J. Numer. Anal. 17 (1980) 238-246), and less overshoots less what lies
# there.
STEEPEST_SLOPE = 2.0

# Relative distance of the largest lift-off that is tried from the slowest speed without contact. A choice, above
# rounding.
BELOW_SEPARATED = 1e-12

# Film load ratio below which the traction coefficient of the film is not used. A choice: below it the relative error of
# that is large.
LITTLE = 0.02

# Asperity load ratio below which chance rules: how a contact ends is not read off such a point. A choice: a smaller
# value follows chance, a larger one leaves fewer points.
LEAST_LOAD_RATIO = 2e-3

# Smallest divisor of an error relative to f. A choice, near the smallest number.
LEAST_POSITIVE = 1e-300

# Part of f that parts may leave by rounding [-]. A choice, between rounding and what a picture shows.
LEFT_BY_ROUNDING = 1e-9

# Film load ratio below which the film counts as carrying nothing. A choice: any number between rounding and a share
# does.
NO_FILM_LOAD = 1e-9


@dataclass(frozen=True, kw_only=True)
class Samples:
    """The solved points of a curve: arrays (n,) by ascending entrainment speed [m/s].

    share: of the load on the contact; boundary, film: parts of f; thickness: central film, and clearance: its distance
    from the summits if nothing touches, both in units of Sq; steepness: d ln((1 - share)/share)/d ln U (NaN if not
    known); numerical: relative numerical error of f (0 where it
    is not known).
    """

    speed: np.ndarray
    share: np.ndarray
    boundary: np.ndarray
    film: np.ndarray
    thickness: np.ndarray
    clearance: np.ndarray
    steepness: np.ndarray
    numerical: np.ndarray

    @property
    def contacts(self) -> int:
        """Number of speeds with contact, which are the slowest ones."""
        return int(np.count_nonzero(self.share > 0))

    def without(self, index: int) -> Samples:
        """Return all samples but one."""
        return Samples(**{part.name: np.delete(getattr(self, part.name), index) for part in fields(self)})


@dataclass(frozen=True, kw_only=True)
class Minimum:
    """The least f between the solved speeds of a curve.

    Attributes
    ----------
    speed : entrainment speed [m/s] at which the interpolated f is least
    coefficient : f there [-]
    interval : (lowest, highest) that the least f may be [-] by the interpolation, without the errors of the points; of
        a `StribeckResult`: 95 % interval, with these errors
    speeds : (lowest, highest) speed [m/s] at which f may be least, by the interpolation and the numerical errors of the
        points
    interpolated_speeds : the same by the interpolation alone
    is_inside : whether ``speeds`` reach neither the slowest nor the fastest solved speed
    is_bracketed : whether it is inside, and ``speeds`` differ by at most a factor of 2
    """

    speed: float
    coefficient: float
    interval: tuple[float, float]
    speeds: tuple[float, float]
    interpolated_speeds: tuple[float, float]
    is_inside: bool
    is_bracketed: bool


@dataclass(frozen=True)
class Interpolant:
    """f between the speeds of ``samples``. ``lift_off`` [m/s]: where the contact ends (None: not in the range); its
    share falls there as the power ``end`` of 1 - U/lift_off (None: as `HERTZ`, and only at the next solved speed if no
    extrapolation of the film shows lift-off). ``sense``: the sign of the speeds that were solved."""

    samples: Samples
    lift_off: float | None
    end: float | None = None
    sense: float = 1.0

    @property
    def range(self) -> tuple[float, float]:
        """(lowest, highest) speed [m/s] in the direction of the curve."""
        low, high = sorted((self.sense * self.samples.speed[0], self.sense * self.samples.speed[-1]))
        return low, high

    def within(self, speeds: np.ndarray) -> np.ndarray:
        """Return which ``speeds`` [m/s] lie in the range."""
        low, high = self.samples.speed[[0, -1]]
        return (self.sense * speeds >= low * (1 - 1e-9)) & (self.sense * speeds <= high * (1 + 1e-9))

    @property
    def bracket(self) -> tuple[float, float]:
        """(fastest speed [m/s] with contact, slowest without), without their sign; NaN without a lift-off."""
        s = self.samples
        if self.lift_off is None:
            return np.nan, np.nan
        return float(s.speed[s.contacts - 1]), float(s.speed[s.contacts])

    @property
    def numerical_at_lift_off(self) -> float:
        """The largest relative numerical error of f at the solved speeds around lift-off; 0 without a lift-off."""
        k = self.samples.contacts
        around = self.samples.numerical[k - 1 : k + 1]
        return 0.0 if self.lift_off is None else float(np.max(around))

    @property
    def is_lift_off_supported(self) -> bool:
        """Whether the solved speeds around lift-off are near enough, and f there known well enough, to state its place
        between them."""
        low, high = self.bracket
        return high <= WIDEST_BRACKET * low and not self.numerical_at_lift_off > LARGE_NUMERICAL_ERROR

    @property
    def _is_lift_off_extrapolated(self) -> bool:
        """Whether the place of lift-off is an extrapolation of the film; else it is the middle of the solved speeds
        around it, because the clearance of the film is not known."""
        s = self.samples
        return bool(np.isfinite(s.clearance[s.contacts]))

    @property
    def _end_of_contact(self) -> float | None:
        """The speed [m/s] at which the contact ends in the interpolation: lift-off, or where that is only known to lie
        between two solved speeds the faster one, where both parts of f pass without a knee; None without a lift-off."""
        if self.lift_off is None or self.end is not None or self._is_lift_off_extrapolated:
            return self.lift_off
        return self.bracket[1]

    @property
    def lifted(self) -> float:
        """Lift-off [m/s] in the direction of the curve; NaN without one, and where the points do not support its
        place."""
        return self.sense * self.lift_off if self.lift_off is not None and self.is_lift_off_supported else np.nan

    @property
    def lift_off_range(self) -> tuple[float, float]:
        """(lowest, highest) speed [m/s] that lift-off may have, by the points alone, without the sign: where they do
        not support its place, or it is not extrapolated, the solved speeds around it. NaN without a lift-off."""
        if self.is_lift_off_supported and self._is_lift_off_extrapolated:
            return self._extrapolated_range
        return self.bracket

    @property
    def _extrapolated_range(self) -> tuple[float, float]:
        """(lowest, highest) speed [m/s] of lift-off by the extrapolation of the film; NaN without one."""
        s = self.samples
        knee = knee_of(self.samples)
        if knee is None:
            return np.nan, np.nan
        # a share of the way to the slowest film without contact
        away = (s.speed[s.contacts] / knee) ** EXTRAPOLATED_ERROR
        least = min(NEAR_CONTACT * s.speed[s.contacts - 1], knee)  # not where contact is known
        return float(max(knee / away, least)), float(knee * away)

    def at(self, speed: FloatArray, *, smooth: bool = True) -> np.ndarray:
        """Return f at speeds [m/s] within the range. ``smooth=False``: by the other cubics."""
        speed = np.asarray(speed, dtype=float)
        return self.boundary(speed, smooth=smooth) + self.film(speed, smooth=smooth)

    def error(self, speed: FloatArray) -> np.ndarray:
        """Return the estimated relative error at speeds [m/s]. It is the largest of these: twice the difference between
        the two kinds of cubics; the effect of the uncertain place of the knee, and of the power with which the contact
        ends there; a multiple of the error at the neighbouring points when the curve goes through the other points
        only; and, where the neighbouring points are far apart, the differences from a monotone cubic and from the line
        through f itself."""
        speed = np.asarray(speed, dtype=float)
        value = self.at(speed)
        right = np.clip(np.searchsorted(self.samples.speed, speed), 1, self.samples.speed.size - 1)
        low, high, log_speed = (np.log(u) for u in (self.samples.speed[right - 1], self.samples.speed[right], speed))
        far = _ramp(high - low, NEAR_SPEEDS, FAR_SPEEDS)
        monotone, line = self._through_f(log_speed)
        straight = _ramp(high - low, STRAIGHT_FROM, STRAIGHT_WHOLLY)
        spread = np.maximum(far * _distance(monotone, value), straight * _distance(line, value))
        spread = np.maximum(spread, BETWEEN_CUBICS * _distance(self.at(speed, smooth=False), value))
        for other in self._other_ends:
            spread = np.maximum(spread, _distance(other.at(speed), value))
        change_without = self._changes_without_points
        place = np.clip((log_speed - low) / (high - low), 0.0, 1.0)
        between = 2.0 * np.sqrt(place * (1.0 - place))  # an error that is none at the points
        factor = BETWEEN_NEAR_POINTS + far * (BETWEEN_FAR_POINTS - BETWEEN_NEAR_POINTS)
        beside = factor * between * np.maximum(change_without[right - 1], change_without[right])
        is_known = np.isfinite(value)
        size = np.where(is_known, np.maximum(np.abs(value), LEAST_POSITIVE), 1.0)
        return np.where(is_known, np.maximum(spread / size, beside), np.inf)

    def minimum(self) -> Minimum:
        """Return where f is least between the points, and how well that is known by their interpolation."""
        solved = self.samples.speed
        speed = np.union1d(np.geomspace(solved[0], solved[-1], MINIMUM_GRID), solved)
        speed = np.clip(speed, solved[0], solved[-1])
        f = self.at(speed)
        error = self.error(speed)
        half = np.abs(f) * error
        half_of_points = np.abs(f) * np.hypot(error, np.interp(np.log(speed), np.log(solved), self.samples.numerical))
        least = int(np.nanargmin(f))
        (first, last) = _places_of_least(f, half_of_points)
        is_inside = bool(first > 0 and last < speed.size - 1)
        return Minimum(
            speed=self.sense * float(speed[least]),
            coefficient=float(f[least]),
            interval=(float(np.nanmin(f - half)), float(np.nanmin(f + half))),
            speeds=self._ends_of(speed, (first, last)),
            interpolated_speeds=self._ends_of(speed, _places_of_least(f, half)),
            is_inside=is_inside,
            is_bracketed=bool(is_inside and speed[last] <= WIDEST_BRACKET * speed[first]),
        )

    def _ends_of(self, speed: FloatArray, places: tuple[int, int]) -> tuple[float, float]:
        """Return (lowest, highest) of ``speed`` [m/s] at two ``places``, in the direction of the curve."""
        (low, high) = sorted(self.sense * float(speed[place]) for place in places)
        return low, high

    @cached_property
    def _other_ends(self) -> list[Interpolant]:
        """The curves with lift-off at the ends of its range, and with other powers with which the contact ends
        there."""
        if self.lift_off is None:
            return []
        s = self.samples
        (low, high) = self.bracket
        far = float(_ramp(np.log(high / low), WIDEST_BRACKET, FAR_SPEEDS))
        part = far + (1.0 - far) * (EXTRAPOLATED_ERROR if self._is_lift_off_extrapolated else MIDDLE_ERROR)
        least = min(NEAR_CONTACT * low, self.lift_off)
        most = high * (1.0 - BELOW_SEPARATED)
        extrapolated = (self.lift_off * (end / self.lift_off) ** part for end in (low, high))
        places = {*self._extrapolated_range, *(min(max(place, least), most) for place in extrapolated)}
        within = [place for place in places if s.speed[s.contacts - 1] < place != self.lift_off]
        others = [replace(self, lift_off=place, end=HERTZ) for place in within]
        return others + [replace(self, end=power) for power in OTHER_POWERS]

    @cached_property
    def _changes_without_points(self) -> np.ndarray:
        """The relative change of f at each point, (n,), where the curve goes through the others only; 0 at the ends."""
        s = self.samples
        changes = np.zeros(s.speed.size)
        for i in range(1, s.speed.size - 1):
            left = s.without(i)
            has_knee = self.lift_off is not None and 0 < left.contacts < left.speed.size
            knee = self.lift_off if has_knee and self.is_lift_off_supported else knee_of(left)
            value_without = Interpolant(left, knee).at(s.speed[i : i + 1])[0]
            at_point = s.boundary[i] + s.film[i]
            changes[i] = _distance(value_without, at_point) / max(abs(at_point), LEAST_POSITIVE)
        return changes

    def _through_f(self, log_speed: np.ndarray) -> tuple[FloatArray, FloatArray]:
        """Return f at ln U by two curves through f itself: a monotone cubic of ln f (of f where one is not
        positive), and lines of f."""
        x = np.log(self.samples.speed)
        f = self.samples.boundary + self.samples.film
        if np.all(f > 0.0):
            monotone = np.exp(_cubic(x, np.log(f), log_speed, smooth=False))
        else:
            monotone = _cubic(x, f, log_speed, smooth=False)
        return monotone, np.interp(log_speed, x, f)

    def boundary(self, speed: np.ndarray, *, smooth: bool = True) -> np.ndarray:
        """Return the part of f from the asperity contacts."""
        return self._through_points(self._by_load_ratio, self.samples.boundary, speed, smooth=smooth)

    def film(self, speed: np.ndarray, *, smooth: bool = True) -> np.ndarray:
        """Return the part of f from the film."""
        return self._through_points(self._by_traction, self.samples.film, speed, smooth=smooth)

    def _through_points(
        self, part: Callable[..., np.ndarray], solved: np.ndarray, speed: np.ndarray, *, smooth: bool
    ) -> np.ndarray:
        """Return a ``part`` of f at ``speed``, through what is ``solved`` of it.

        A point at which a part carries hardly any load is not used for its interpolation (`LITTLE`,
        `LEAST_LOAD_RATIO`). A monotone cubic over ln U joins what the interpolation leaves at the points.
        """
        s = self.samples
        value = part(speed, smooth=smooth)
        left = solved - part(s.speed, smooth=smooth)
        is_seen = np.isfinite(left) & (np.abs(left) > LEFT_BY_ROUNDING * np.abs(s.boundary + s.film))
        if not is_seen.any():
            return value
        inside = np.clip(speed, s.speed[0], s.speed[-1])
        return value + _cubic(np.log(s.speed), np.where(is_seen, left, 0.0), np.log(inside), smooth=False)

    def _by_load_ratio(self, speed: np.ndarray, *, smooth: bool) -> np.ndarray:
        """Return the part of f from the asperity contacts by the interpolated asperity load ratio."""
        s = self.samples
        k = self.samples.contacts
        if k == 0:
            return np.zeros(speed.shape)
        of_share = _cubic(np.log(s.speed[:k]), s.boundary[:k] / s.share[:k], np.log(speed), smooth=False)
        return of_share * self.share(speed, smooth=smooth)

    def _by_traction(self, speed: np.ndarray, *, smooth: bool) -> np.ndarray:
        """Return the part of f from the film by its interpolated traction coefficient."""
        with np.errstate(invalid="ignore"):  # an overflow where the film carries nothing: not known
            return self.traction(speed, smooth=smooth) * (1.0 - self.share(speed, smooth=smooth))

    def share(self, speed: np.ndarray, *, smooth: bool = True) -> np.ndarray:
        """Return the asperity load ratio F_C/F_T."""
        s = self.samples
        known = np.flatnonzero((s.share > min(LEAST_LOAD_RATIO, 0.5 * s.share.max())) & (s.share < 1 - NO_FILM_LOAD))
        if known.size == 0:
            return np.full(speed.shape, float(s.contacts > 0))
        log_load_ratio = np.log(1 / s.share[known] - 1)
        load_ratio = np.zeros(speed.shape)
        end = self._end_of_contact
        if end is None:
            return _share_of(_cubic(np.log(s.speed[known]), log_load_ratio, np.log(speed), smooth=smooth))
        power = HERTZ if self.end is None else self.end
        below = speed < end
        y = s.speed[known] / end
        there = speed[below] / end
        rate = (s.steepness[known] - 1 - power * y / (1 - y)) / (LOAD_RATIO_POWER * y**LOAD_RATIO_POWER)
        left = _steered(
            y**LOAD_RATIO_POWER,
            log_load_ratio - np.log(y) + power * np.log1p(-y),
            rate,
            there**LOAD_RATIO_POWER,
            smooth=smooth,
        )
        load_ratio[below] = _share_of(left, there / (1 - there) ** power)
        return load_ratio

    def traction(self, speed: np.ndarray, *, smooth: bool = True) -> np.ndarray:
        """Return the traction coefficient of the film."""
        s = self.samples
        k = self.samples.contacts
        knee = self._end_of_contact
        known = np.flatnonzero(1 - s.share >= LITTLE)
        known = known if known.size else np.array([s.speed.size - 1])
        y = s.speed[known]
        t = s.film[known] / np.maximum(1 - s.share[known], NO_FILM_LOAD)
        touching = known < k
        known_speed = np.maximum(speed, y[0])
        if k == 0:
            return _film_alone(y, t, known_speed, smooth=smooth)
        if knee is None or np.count_nonzero(~touching) < 2:
            return _cubic(np.log(y), t, np.log(known_speed), smooth=smooth)
        alone = _film_alone(y[~touching], t[~touching], np.append(known_speed, knee), smooth=smooth)
        place = np.log(np.append(y[touching], knee))
        slow = _cubic(place, np.append(t[touching], alone[-1]), np.log(known_speed), smooth=smooth)
        return np.where(known_speed < knee, slow, alone[:-1])


def through(numbers: dict[str, np.ndarray]) -> Interpolant:
    """Return the curve through points with these ``numbers`` and the column of their numerical error, as
    `lubfric.quantities` names them. Raises `InputError` for speeds of both directions and for fewer than three
    different ones."""
    speed = numbers["speed"]
    if (speed > 0).any() and (speed < 0).any():
        raise InputError("speeds run both ways; a curve between them has those of one direction: solve two curves")
    good = np.flatnonzero(np.isfinite(numbers["coefficient"]) & (speed != 0))
    good = good[np.argsort(np.abs(speed[good]))]
    if good.size < FEWEST_SPEEDS or np.unique(speed[good]).size < good.size:
        raise InputError(
            f"{counted(good.size, 'speeds')} {'is' if good.size == 1 else 'are'} solved; a curve between them needs "
            f"{FEWEST_SPEEDS} different ones"
        )
    solved = {name: values[good] for name, values in numbers.items()}
    total = solved["contact_load"] + solved["film_load"]
    boundary = solved["boundary_force"] / total
    samples = Samples(
        speed=np.abs(solved["speed"]),
        share=solved["contact_load"] / total,
        boundary=boundary,
        film=solved["coefficient"] - boundary,
        thickness=solved["film_to_roughness_ratio"],
        clearance=solved["clearance"],
        steepness=solved["steepness"],
        numerical=np.nan_to_num(solved["numerical_error"]),
    )
    return Interpolant(samples, knee_of(samples), sense=float(np.sign(solved["speed"][0])))


def knee_of(samples: Samples) -> float | None:
    """Lift-off [m/s]: the speed at which the film is as thick as the summits are high. The film is a power of the speed
    through the slowest two points without contact. The height of the summits is the film less the clearance at the
    slower of these."""
    k = samples.contacts
    if k in (0, samples.speed.size):
        return None
    low = samples.speed[k - 1]
    high = samples.speed[k]
    film = samples.thickness[k : k + 2]
    clear = samples.clearance[k]
    power = FILM_POWER
    if film.size == 2:
        power = np.log(film[1] / film[0]) / np.log(samples.speed[k + 1] / high)
    if clear < film[0] and power > 0:
        lift_off = high * (1 - clear / film[0]) ** (1 / power)
    else:
        lift_off = float(np.sqrt(low * high))
    if lift_off < NEAR_CONTACT * low:
        lift_off = min(BEYOND * low, float(np.sqrt(low * high)))
    return float(min(lift_off, high))


def _places_of_least(f: FloatArray, half: FloatArray) -> tuple[int, int]:
    """Return the (first, last) of the places between which ``f`` may be least, if it is known to ± ``half``."""
    candidates = np.flatnonzero(~(f - half > np.nanmin(f + half)))
    return max(int(candidates[0]) - 1, 0), min(int(candidates[-1]) + 1, f.size - 1)


def _share_of(log_load_ratio: FloatArray, trend: FloatArray | float = 1.0) -> FloatArray:
    """Return the asperity load ratio s of ln((1 - s)/s) - ln ``trend``; 0 where that overflows."""
    with np.errstate(over="ignore"):
        return 1 / (1 + np.exp(log_load_ratio) * trend)


def _distance(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return the distance of two interpolations of f; infinite where one of them overflows."""
    with np.errstate(invalid="ignore"):
        distance = np.abs(np.asarray(first) - second)
    return np.where(np.isnan(distance), np.inf, distance)


def _ramp(log_ratio: FloatArray, near: float, far: float) -> FloatArray:
    """Return 0 where the ratio of two speeds is at most ``near``, 1 where it is at least ``far``, and a line in its
    logarithm between."""
    return np.clip((log_ratio - np.log(near)) / np.log(far / near), 0.0, 1.0)


def _film_alone(speed: FloatArray, traction: FloatArray, at: FloatArray, *, smooth: bool) -> FloatArray:
    """Return the interpolation where nothing touches, by cubics of t/sqrt(U) over 1/sqrt(U): a sqrt(U) + b + c/sqrt(U)
    + .... The friction of a Newtonian film between rigid bodies is proportional to sqrt(U), and that of a film at its
    limiting stress is constant."""
    root = np.sqrt(speed)
    return np.sqrt(at) * _cubic(-1 / root, traction / root, -1 / np.sqrt(at), smooth=smooth)


def _steered(x: FloatArray, values: FloatArray, slopes: FloatArray, at: FloatArray, *, smooth: bool) -> FloatArray:
    """Return the mean of the spline through the points and of cubics with the ``slopes`` known there; beyond the points
    a straight line. ``smooth=False``: these cubics alone."""
    from scipy.interpolate import CubicHermiteSpline, CubicSpline

    if x.size < 2 or not np.isfinite(slopes).any():
        return _cubic(x, values, at, smooth=smooth)
    spline = CubicSpline(x, values)
    spline_slopes = spline(x, 1)
    weight = 0.5 if smooth else 1.0
    cubics = CubicHermiteSpline(
        x, values, np.where(np.isfinite(slopes), weight * slopes + (1 - weight) * spline_slopes, spline_slopes)
    )
    inside = np.clip(at, x[0], x[-1])
    return cubics(inside) + cubics(inside, 1) * (at - inside)


def _cubic(x: FloatArray, values: FloatArray, at: FloatArray, *, smooth: bool) -> FloatArray:
    """Return a cubic between the points ``x``, monotone wherever they are; beyond them a straight line. Its slopes are
    those of the spline through the points, limited by `_monotone`; ``smooth=False``: those of Fritsch and Butland (SIAM
    J. Sci. Stat. Comput. 5 (1984) 300-304), and beyond the points the last secant."""
    from scipy.interpolate import CubicHermiteSpline, CubicSpline, PchipInterpolator

    if x.size == 1:
        return np.full(np.shape(at), values[0])
    inside = np.clip(at, x[0], x[-1])
    if not smooth:
        ends = (values[1] - values[0]) / (x[1] - x[0]), (values[-1] - values[-2]) / (x[-1] - x[-2])
        return PchipInterpolator(x, values)(inside) + np.where(at < x[0], *ends) * (at - inside)
    cubics = CubicHermiteSpline(x, values, _monotone(x, values, CubicSpline(x, values)(x, 1)))
    return cubics(inside) + cubics(inside, 1) * (at - inside)


def _monotone(x: FloatArray, values: FloatArray, slopes: FloatArray) -> FloatArray:
    """Return ``slopes`` limited so that a cubic with them has no extremum between two points: none at an extremum of
    the points, else in the sense of the secants beside it, and at most `STEEPEST_SLOPE` times the flatter of these."""
    secants = np.diff(values) / np.diff(x)
    before = np.append(secants[0], secants)
    after = np.append(secants, secants[-1])
    sense = np.where(before * after > 0.0, np.sign(before), 0.0)
    most = STEEPEST_SLOPE * np.minimum(np.abs(before), np.abs(after))
    return sense * np.clip(sense * slopes, 0.0, most)
