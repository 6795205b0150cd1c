"""Intervals of parameters in which f is not linear, by the profile of the sum of squares.

The slopes at the fit predict the ends of an interval. Curves there, with the other parameters fitted again to first
order, show whether the sum of squares exceeds its limit at these ends, farther out, or nowhere within the bounds.

A parameter that f does not change with at the fit is followed to its bounds, as differences there say nothing of it.

A limiting stress that is nowhere reached is one: f is constant over a part of its bounds, and falls below it. Curves
between the fit and the bounds say where the residuals exceed those of the fit by what the interval allows, and whether
they are smaller somewhere. The other parameters move along, to first order (a profile of the sum of squares: D. M.
Bates and D. G. Watts, Nonlinear Regression Analysis and Its Applications, Wiley 1988, section 6.1).
"""

import math
from dataclasses import dataclass

import numpy as np

from .._base import FloatArray
from ..errors import LubfricError
from .fit_curves import PARAMETER_STEP, FitCurves

# Curves of one parameter beside those at its bounds, at most: the end of an interval takes five. A choice above it.
MOST_FOLLOWED = 12

# Decrease of the sum of squares, as a share of it, from which a fit continues elsewhere. A convention.
LEAST_DECREASE = 0.01

# Distance of two curves, as a share of the bounds, up to which residuals between them are interpolated to look for
# smaller ones. A convention.
INTERPOLATED = 0.25

# Positions between two curves at which interpolated residuals are compared, as a share of their distance. A choice: it
# costs no curve.
BETWEEN_CURVES = np.linspace(0.0, 1.0, 201)

# Range of positions of a curve between two others, as a share of their distance: a curve nearer to one of them narrows
# the distance too little. A choice: a bisection has (.5, .5).
WITHIN_CURVES = (0.3, 0.7)


# Curves towards one end of an interval, at most. A choice: an end that the slopes predict takes one, and one that they
# miss by a factor of 2 takes three.
MOST_TOWARDS_END = 6

# Distance of the first curve from the fit over that of the predicted end: a curve shows an end by its being outside. A
# choice below the next one.
BEYOND_END = 1.05

# Root of the increase of the sum of squares over its limit, up to which an end is interpolated between the fit or a
# curve within the interval, and a curve outside. A choice: smaller takes more curves.
CONFIRMED_ROOT = 1.15

# Move of a parameter, as a share of its bounds, that is always allowed: a range of no width has no least sum. A choice:
# any number above rounding does.
SMALLEST_STEP = 1e-9


@dataclass(frozen=True, kw_only=True)
class Profile:
    """What curves at other values of one parameter show.

    Attributes
    ----------
    low, high : ends of the 95 % interval, as positions between the bounds; 0 and 1 where the data set no limit
    is_flat : whether f does not change with the parameter at the fit
    change : largest relative change of f at the measured points between the fit and the bounds within the interval;
        0 where it holds no bound, NaN where a curve at one could not be solved
    better : a position between the bounds, (p,), with a smaller sum of squares than the fit; None: there is none
    """

    low: float
    high: float
    change: float
    better: FloatArray | None = None
    is_flat: bool = True


def flat_parameters(jacobian: FloatArray, variance: float, student: float) -> list[int]:
    """Return the places of the parameters that change the residuals by less, over the complete bounds and to first
    order, than their intervals allow. ``jacobian`` (n, p): of the residuals; ``variance`` of these."""
    lengths = np.sqrt(np.sum(jacobian**2, axis=0))
    return [int(place) for place in np.flatnonzero(lengths <= 2.0 * student * np.sqrt(variance))]


def follow(
    curves: FitCurves, unit: FloatArray, jacobian: FloatArray, *, place: int, variance: float, student: float
) -> Profile:
    """Follow the parameter at ``place`` from ``unit`` (p,) to its bounds.

    ``jacobian`` (n, p): of the residuals at ``unit``; ``variance`` of these; ``student``: t of the intervals. A curve
    that cannot be solved ends the way: the data then set no limit on that side, and ``change`` is NaN.
    """
    others = _Others(np.delete(jacobian, place, axis=1), np.delete(unit, place), student * math.sqrt(variance))
    start = float(unit[place])
    known: dict[float, FloatArray] = {}

    def at(share: float) -> FloatArray:
        """Return ``unit`` with the parameter at ``share``."""
        moved = unit.copy()
        moved[place] = share
        return moved

    def projected(share: float) -> FloatArray:
        """Return the residuals at ``share``, with the other parameters moved to the least sum, to first order."""
        if share not in known:
            known[share] = others.fitted(curves.residuals(at(share)))
        return known[share]

    most = _sum(projected(start)) + student**2 * variance
    least = _sum(known[start]) * (1.0 - LEAST_DECREASE)
    failed = False
    for end in (0.0, 1.0):
        try:
            projected(end)
        except LubfricError:
            failed = True
    for _ in range(MOST_FOLLOWED):
        share = _promising(known, least)
        if share is None:
            share = _between(_crossing(known, start, most, 0.0)) or _between(_crossing(known, start, most, 1.0))
        if share is None:
            break
        try:
            trial = projected(share)
        except LubfricError:
            failed = True
            break
        if _sum(trial) < least:
            break
    lowest = min(known, key=lambda share: _sum(known[share]))
    better = None
    if _sum(known[lowest]) < least:
        moved = at(lowest)
        better = np.clip(moved + np.insert(others.step(curves.residuals(moved)), place, 0.0), 0.0, 1.0)
    f = curves.coefficient(unit)
    changes = []
    for end in (0.0, 1.0):
        if end in known and _sum(known[end]) <= most:
            changes.append(float(np.max(np.abs(curves.coefficient(at(end)) / f - 1.0))))
    return Profile(
        low=_limit(known, start, most, 0.0),
        high=_limit(known, start, most, 1.0),
        change=np.nan if failed else max(changes, default=0.0),
        better=better,
    )


def loose_parameters(covariance: FloatArray, student: float) -> list[int]:
    """Return the places of the parameters whose intervals, by the ``covariance`` (p, p) of their positions, reach
    beyond the steps of the differences, so that f may bend within them."""
    return [int(place) for place in np.flatnonzero(student * np.sqrt(np.diag(covariance)) > PARAMETER_STEP)]


def confirmed_ends(
    curves: FitCurves,
    unit: FloatArray,
    jacobian: FloatArray,
    covariance: FloatArray,
    *,
    place: int,
    variance: float,
    student: float,
) -> Profile:
    """Return the interval of the parameter at ``place`` by curves towards the ends that ``covariance`` (p, p) predicts.

    Arguments as for `follow`. A curve has the other parameters of the curves beside it, refitted there, and is
    refitted to first order itself. An end that no curve within the bounds shows is the bound: so is one beyond a curve
    that cannot be solved.
    """
    slopes = np.delete(jacobian, place, axis=1)
    flat = [other - (other > place) for other in flat_parameters(jacobian, variance, student) if other != place]
    slopes[:, flat] = 0.0  # these do not move: to first order they would move anywhere
    together = np.delete(covariance[:, place], place) / covariance[place, place]
    together[flat] = 0.0
    start = float(unit[place])
    refitted: dict[float, FloatArray] = {}
    sums: dict[float, float] = {}

    def solve(share: float, others: FloatArray) -> None:
        """Solve the curve at ``share`` with ``others`` (p - 1,), and refit these."""
        residuals = curves.residuals(np.insert(others, place, share))
        moving = _Others(slopes, others, math.inf)
        refitted[share] = np.clip(others + moving.step(residuals), 0.0, 1.0)
        sums[share] = _sum(moving.fitted(residuals))

    def root(share: float) -> float:
        """Return the root of the increase of the sum of squares at a solved ``share`` over its limit."""
        return math.sqrt(max(sums[share] - sums[start], 0.0) / variance) / student

    def end_towards(bound: float) -> float:
        """Return the end of the interval on the side of ``bound``."""
        side = math.copysign(1.0, bound - start)
        reach = student * math.sqrt(covariance[place, place])
        trial = float(np.clip(start + side * BEYOND_END * reach, 0.0, 1.0))
        others = np.clip(np.delete(unit, place) + together * (trial - start), 0.0, 1.0)
        inner = start
        outer: float | None = None
        for _ in range(MOST_TOWARDS_END):
            try:
                solve(trial, others)
            except LubfricError:
                return bound
            step = (trial - inner) / max(root(trial) - root(inner), SMALLEST_STEP)
            if root(trial) > 1.0:
                outer = trial
            elif trial == bound or sums[trial] < least:
                return bound
            else:
                inner = trial
            if outer is None:  # twice as far as the slope between the curves says: f may saturate
                trial = float(np.clip(inner + 2.0 * (1.0 - root(inner)) * step, 0.0, 1.0))
                others = refitted[inner]
                continue
            end = inner + (outer - inner) * (1.0 - root(inner)) / (root(outer) - root(inner))
            if root(outer) <= CONFIRMED_ROOT or abs(outer - inner) <= PARAMETER_STEP:
                return end
            trial = min(end + side * (BEYOND_END - 1.0) * abs(end - start), outer, key=lambda x: abs(x - start))
            shares = sorted(refitted)
            others = np.array([np.interp(trial, shares, row) for row in np.transpose([refitted[s] for s in shares])])
        return bound if outer is None else outer

    solve(start, np.delete(unit, place))
    least = sums[start] * (1.0 - LEAST_DECREASE)
    low = end_towards(0.0)
    high = end_towards(1.0)
    lowest = min(sums, key=lambda share: sums[share])
    better = np.insert(refitted[lowest], place, lowest) if sums[lowest] < least else None
    return Profile(low=low, high=high, change=math.nan, better=better, is_flat=False)


class _Others:
    """The other parameters of a fit, which move along to first order: within their own intervals, as the profile of the
    sum of squares does until it exceeds what the interval allows, and within their bounds."""

    def __init__(self, jacobian: FloatArray, unit: FloatArray, allowed: float):
        self.jacobian = jacobian
        inverse = np.linalg.pinv(jacobian, rcond=1e-8)
        reach = allowed * np.sqrt(np.sum(inverse**2, axis=1))
        self.low = np.maximum(-reach, -unit) - SMALLEST_STEP
        self.high = np.minimum(reach, 1.0 - unit) + SMALLEST_STEP

    def step(self, residuals: FloatArray) -> FloatArray:
        """Return the move of the parameters, (p - 1,), that makes the sum of the squared ``residuals`` (n,) least."""
        from scipy.optimize import lsq_linear

        if not self.low.size:
            return np.zeros(0)
        return np.asarray(lsq_linear(self.jacobian, -residuals, bounds=(self.low, self.high)).x)

    def fitted(self, residuals: FloatArray) -> FloatArray:
        """Return the ``residuals`` (n,) after that move."""
        return residuals + self.jacobian @ self.step(residuals)


def _promising(known: dict[float, FloatArray], least: float) -> float | None:
    """Return where between two near curves the interpolated sum of squares is below ``least``; None: nowhere."""
    shares = sorted(known)
    candidates = []
    for low, high in zip(shares, shares[1:]):
        if PARAMETER_STEP / 4 < high - low <= INTERPOLATED:
            sums = _sums(known[low], known[high])
            best = float(np.clip(BETWEEN_CURVES[int(np.argmin(sums))], *WITHIN_CURVES))
            candidates.append((float(sums.min()), low + best * (high - low)))
    return min(candidates)[1] if candidates and min(candidates)[0] < least else None


def _crossing(known: dict[float, FloatArray], start: float, most: float, end: float) -> tuple[float, float] | None:
    """Return the nearest two curves from ``start`` towards ``end`` between which the sum of squares exceeds ``most``;
    None: it does not."""
    shares = sorted((share for share in known if (share - start) * (end - start) >= 0.0), key=lambda s: abs(s - start))
    for inner, outer in zip(shares, shares[1:]):
        if _sum(known[outer]) > most:
            return inner, outer
    return None


def _between(pair: tuple[float, float] | None) -> float | None:
    """Return the middle of two positions, if they are farther apart than the steps of the differences."""
    return None if pair is None or abs(pair[1] - pair[0]) <= PARAMETER_STEP else 0.5 * (pair[0] + pair[1])


def _limit(known: dict[float, FloatArray], start: float, most: float, end: float) -> float:
    """Return where the sum of squares exceeds ``most`` on the way to ``end``; ``end`` where it does not."""
    pair = _crossing(known, start, most, end)
    if pair is None:
        return end
    within = np.flatnonzero(_sums(known[pair[0]], known[pair[1]]) <= most)
    return pair[0] + float(BETWEEN_CURVES[within.max(initial=0)]) * (pair[1] - pair[0])


def _sum(residuals: FloatArray) -> float:
    """Return the sum of the squared ``residuals``."""
    return float(np.sum(residuals**2))


def _sums(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return the sums of squares of the residuals interpolated between two curves, at `BETWEEN_CURVES`."""
    return np.sum((first + BETWEEN_CURVES[:, None] * (second - first)) ** 2, axis=1)
