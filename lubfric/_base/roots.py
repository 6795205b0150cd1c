"""Roots: a bracketed one of an increasing function, which stops by the value of the function, not by the step; and one
by the secant."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..errors import CONVERGED, ITERATION_LIMIT, Report

# Ratio of a value to the one before [-], below which the secant gives the next step; otherwise the step is doubled. A
# choice: a larger value takes longer secant steps, which may miss the root.
NEARER = 0.3

# First step of the secant, in x, and the same relative to x [-]. A choice: that of ``scipy.optimize.newton``.
SECANT_STEP = 1e-4

# Steps of the secant, at most [-]. A choice: a bound, as that of ``scipy.optimize.newton``.
MOST_SECANT_STEPS = 50


@dataclass(frozen=True, kw_only=True)
class Root:
    """x, f(x), its payload, |f| at every step, and how it ended."""

    x: float
    value: float
    payload: Any
    history: tuple[float, ...]
    status: str


def increasing_root(
    f: Callable[[float, Any], tuple[float, Any]],
    guess: float,
    *,
    step: float,
    bounds: tuple[float, float],
    tolerance: float,
    slope: float | None = None,
    first: tuple[float | None, Any] = (None, None),
    max_evaluations: int = 60,
) -> Root:
    """Return the root of an increasing f, by expansion from ``guess`` and then Chandrupatla's method.

    ``f(x, last)`` returns (value, payload); ``last``: the payload before it. ``first``: value and payload at ``guess``
    inside the bounds, if they are known, which counts as an evaluation; or None and a payload to begin with. Stops when
    |value| <= tolerance. The bracket grows by doubled steps inside ``bounds``, or by the secant if a step came much
    nearer. A function of one sign there ends with "iteration_limit". If ``slope`` is roughly known, the first step is
    Newton's, at most ``step``. Source: T. R. Chandrupatla, Adv. Eng. Softw. 28 (1997) 145-149,
    doi:10.1016/S0965-9978(96)00051-8.

    ``scipy.optimize.elementwise.bracket_root`` and ``find_root``, the same method, know neither the value nor the slope
    at the guess, and bracket before they look at the tolerance: for 18 balances of the scene "paper" they solve film
    and contact 108 times, this one 34 times.
    """
    search = _Search(f, tolerance, max_evaluations, first[1])
    if (value := first[0]) is not None:
        search.keep(guess, value, first[1])
    bracket = _bracket(search, min(max(guess, bounds[0]), bounds[1]), step, bounds, slope)
    if bracket is not None:
        _close_in(search, *bracket)
    return search.root()


class _Search:
    """One search: f, and its values so far."""

    def __init__(self, f: Callable[..., Any], tolerance: float, max_evaluations: int, first: Any):
        self.f = f
        self.tolerance = tolerance
        self.max_evaluations = max_evaluations
        self.last = first
        self.points: list[tuple[float, float]] = []
        self.best: tuple[float, float, Any] = (math.nan, math.inf, None)

    def at(self, x: float) -> tuple[float, float]:
        """Return (x, f(x))."""
        return self.keep(x, *self.f(x, self.last))

    def keep(self, x: float, value: float, payload: Any) -> tuple[float, float]:
        """Return (x, f(x)), found with its payload."""
        self.last = payload
        self.points.append((x, value))
        if len(self.points) == 1 or abs(value) < abs(self.best[1]):
            self.best = (x, value, payload)
        return x, value

    @property
    def done(self) -> bool:
        """Whether the best is good enough, or enough has been tried."""
        return abs(self.best[1]) <= self.tolerance or len(self.points) >= self.max_evaluations

    def root(self) -> Root:
        """Return the result."""
        x, value, payload = self.best
        status = CONVERGED if abs(value) <= self.tolerance else ITERATION_LIMIT
        return Root(x=x, value=value, payload=payload, history=tuple(abs(f) for _, f in self.points), status=status)


def _bracket(
    search: _Search, x: float, step: float, bounds: tuple[float, float], slope: float | None
) -> tuple[tuple[float, float], tuple[float, float]] | None:
    """Return points (upper, lower) of both signs; None if the search ended before they were found."""
    lower = None
    upper = None
    point = search.points[0] if search.points else search.at(x)
    while not search.done:
        if point[1] < 0:
            lower = point
        else:
            upper = point
        if lower is not None and upper is not None:
            return upper, lower
        if slope and slope > 0 and len(search.points) == 1:
            step = min(step, abs(point[1]) / slope)
        edge = bounds[1] if upper is None else bounds[0]
        if x == edge:
            return None
        x = min(x + step, edge) if upper is None else max(x - step, edge)
        last, point = point, search.at(x)
        step = abs(point[1] / (point[1] - last[1])) * step if abs(point[1]) < NEARER * abs(last[1]) else 2 * step
    return None


def _close_in(search: _Search, a: tuple[float, float], b: tuple[float, float]) -> None:
    """Evaluate between ``a`` and ``b``, of different signs, until the search is done, or until the bracket is down to
    rounding and f still jumps in it."""
    # the secant's first
    fraction = min(max(a[1] / (a[1] - b[1]), 0.02), 0.98)
    c = None
    while True:
        x = a[0] + fraction * (b[0] - a[0])
        if x in (a[0], b[0]):
            return
        point = search.at(x)
        if search.done:
            return
        if (point[1] > 0) == (a[1] > 0):
            c, a = a, point
        else:
            c, b, a = b, a, point
        fraction = _next_fraction(a, b, c)


def _next_fraction(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> float:
    """Return the inverse quadratic interpolation where it is safe (Chandrupatla), else bisection; in (0, 1)."""
    xi = (a[0] - b[0]) / (c[0] - b[0])
    phi = (a[1] - b[1]) / (c[1] - b[1])
    if not (phi**2 < xi and (1 - phi) ** 2 < 1 - xi):
        return 0.5
    (xa, fa) = a
    (xb, fb) = b
    (xc, fc) = c
    t = fa / (fb - fa) * fc / (fb - fc) + (xc - xa) / (xb - xa) * fa / (fc - fa) * fb / (fc - fb)
    return min(max(t, 1e-3), 1 - 1e-3)


def secant_root(f: Callable[[float], float], guess: float, *, accuracy: float) -> float:
    """Return the root of a smooth ``f`` near ``guess`` by the secant, until a step is at most ``accuracy``.

    Raises `ConvergenceError`. ``scipy.optimize.newton`` takes the same steps; its import takes 0.1 s, a twentieth of a
    first point of the scene "paper".
    """
    last = guess
    now = guess + math.copysign(SECANT_STEP, guess) * (1.0 + abs(guess))
    value_last = f(last)
    value_now = f(now)
    if abs(value_now) < abs(value_last):
        (last, now) = (now, last)
        (value_last, value_now) = (value_now, value_last)
    for count in range(1, 1 + MOST_SECANT_STEPS):
        if value_now == value_last:
            break
        if abs(value_now) > abs(value_last):
            ratio = value_last / value_now
            following = (last - ratio * now) / (1.0 - ratio)
        else:
            ratio = value_now / value_last
            following = (now - ratio * last) / (1.0 - ratio)
        if abs(following - now) <= accuracy:
            return following
        last = now
        value_last = value_now
        now = following
        value_now = f(now)
    step = abs(now - last)
    Report("secant", ITERATION_LIMIT, iterations=count, residual=step, tolerance=accuracy).raise_if_failed()
    return now
