"""Friction between the solved speeds. Each of the two parts of f is interpolated in coordinates in which it is smooth,
with a knee at lift-off.

The boundary part b = f_b F_C/F_T falls to zero at lift-off as a power of the remaining speed, about 3/2 as for one
Hertz asperity. So b^(2/3) is interpolated over U^0.6, which grows about as the film does. The film part g = F_sh/F_T is
close to a power of the speed on either side of the knee. So ln g is interpolated over ln U. Both use cubic splines.
Shape-preserving cubics beside them tell how sure the result is.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

EXPONENT, POWER = 0.6, 2.0 / 3.0
NEAR, BEYOND = 1.003, 1.03  # an estimate of lift-off below NEAR times a speed with contact is put BEYOND it
CLOSER = 1.0 / 5.0  # error between points over that with every other one left out, of a cubic or better


@dataclass(frozen=True)
class Samples:
    """What is known of a curve: arrays (n,) by ascending entrainment speed [m/s].

    boundary, film: parts of f; touching: whether the contact carries load; clearance: film above the summits in units
    of Sq where it does not (NaN where not known).
    """

    speed: np.ndarray
    boundary: np.ndarray
    film: np.ndarray
    touching: np.ndarray
    clearance: np.ndarray

    @property
    def contacts(self) -> int:
        """Number of speeds with contact, the slowest ones."""
        return int(np.count_nonzero(self.touching))


@dataclass(frozen=True)
class Interpolant:
    """f between the speeds of ``samples``; ``lift_off`` [m/s]: where the contact ends (None: not in the range)."""

    samples: Samples
    lift_off: float | None

    def at(self, speed, smooth: bool = True) -> np.ndarray:
        """f at speeds [m/s] within the range. ``smooth=False``: by the shape-preserving cubics."""
        speed = np.asarray(speed, dtype=float)
        return self.boundary(speed, smooth) + self.film(speed, smooth)

    def error(self, speed) -> np.ndarray:
        """Estimated relative error at speeds [m/s]. It is the largest of three numbers: how much the two kinds of
        cubics differ; how much f depends on where the knee may be; and a share of how much the curve misses a
        neighbouring point that is left out."""
        value = self.at(speed)
        spread = np.abs(self.at(speed, smooth=False) - value)
        for other in self._other_knees:
            spread = np.maximum(spread, np.abs(other.at(speed) - value))
        return np.maximum(spread / np.maximum(np.abs(value), 1e-300), self._missed_beside(speed))

    def _missed_beside(self, speed) -> np.ndarray:
        """Leave each point out in turn, and see how much the curve misses it by, relative. Each speed gets `CLOSER`
        times the larger miss of the two points around it."""
        s = self.samples
        missed = np.zeros(s.speed.size)
        for i in range(1, s.speed.size - 1):
            others = Samples(*(np.delete(part, i) for part in (s.speed, s.boundary, s.film, s.touching, s.clearance)))
            knee = self.lift_off if 0 < others.contacts < others.speed.size else None
            found = Interpolant(others, knee).at(s.speed[i : i + 1])[0]
            missed[i] = abs(found / (s.boundary[i] + s.film[i]) - 1.0)
        right = np.clip(np.searchsorted(s.speed, speed), 1, s.speed.size - 1)
        return CLOSER * np.maximum(missed[right - 1], missed[right])

    @cached_property
    def _other_knees(self) -> tuple[Interpolant, ...]:
        """The same curve with the knee at either end of the range in which it may be."""
        if self.lift_off is None:
            return ()
        low, high = knee_range(self.samples)
        return tuple(Interpolant(self.samples, knee) for knee in (low, high) if abs(knee / self.lift_off - 1) > 1e-12)

    def boundary(self, speed: np.ndarray, smooth: bool = True) -> np.ndarray:
        """The part of f from the contact spots."""
        k, s = self.samples.contacts, self.samples
        if k == 0:
            return np.zeros(speed.shape)
        x, w = s.speed[:k] ** EXPONENT, s.boundary[:k] ** POWER
        if self.lift_off is not None:
            x, w = np.append(x, self.lift_off**EXPONENT), np.append(w, 0.0)
        found = np.maximum(_cubic(x, w, speed**EXPONENT, smooth), 0.0) ** (1.0 / POWER)
        return found if self.lift_off is None else np.where(speed < self.lift_off, found, 0.0)

    def film(self, speed: np.ndarray, smooth: bool = True) -> np.ndarray:
        """The part of f from the film."""
        s, k = self.samples, self.samples.contacts
        powers = bool(np.all(s.film > 0.0))
        y, g, at = np.log(s.speed), np.log(s.film) if powers else s.film, np.log(speed)
        if self.lift_off is None or y.size - k < 2:
            found = _cubic(y, g, at, smooth)
        else:
            knee = np.log(self.lift_off)
            there = _cubic(y[k:], g[k:], np.array([knee]), smooth)
            slow = _cubic(np.append(y[:k], knee), np.append(g[:k], there), at, smooth)
            found = np.where(at < knee, slow, _cubic(y[k:], g[k:], at, smooth))
        return np.exp(found) if powers else found


def knee_of(samples: Samples) -> float | None:
    """Lift-off [m/s]. It is where the clearance of the slowest films without contact, as a straight line over U^0.6,
    reaches zero."""
    k = samples.contacts
    if k in (0, samples.speed.size):
        return None
    low, high = samples.speed[k - 1], samples.speed[k]
    clear = samples.clearance[k : k + 2]
    if clear.size == 2 and np.all(np.isfinite(clear)) and clear[1] > clear[0]:
        x = samples.speed[k : k + 2] ** EXPONENT
        found = max(x[0] - clear[0] * (x[1] - x[0]) / (clear[1] - clear[0]), 0.0) ** (1 / EXPONENT)
    else:
        found = float(np.sqrt(low * high))
    if found < NEAR * low:
        found = min(BEYOND * low, float(np.sqrt(low * high)))
    return float(min(found, high))


def knee_range(samples: Samples) -> tuple[float, float]:
    """The lowest and highest lift-off [m/s] that are likely: a quarter of the way from the estimate to the speeds
    that enclose it."""
    k, knee = samples.contacts, knee_of(samples)
    low, high = samples.speed[k - 1], samples.speed[k]
    return float(knee * (low / knee) ** 0.25), float(knee * (high / knee) ** 0.25)


def _cubic(x, values, at, smooth):
    from scipy.interpolate import CubicSpline, PchipInterpolator

    if x.size == 1:
        return np.full(np.shape(at), values[0])
    return (CubicSpline if smooth else PchipInterpolator)(x, values, extrapolate=True)(at)
