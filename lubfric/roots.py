"""One bracketed root of an increasing function, stopped by its value and not by its step."""

from __future__ import annotations

from dataclasses import dataclass

from .report import CONVERGED, ITERATION_LIMIT


@dataclass(frozen=True)
class Root:
    """x, f(x), the payload that came with it, every |f| on the way, and how it ended."""

    x: float
    value: float
    payload: object
    history: tuple[float, ...]
    status: str


def increasing_root(
    f,
    guess: float,
    *,
    step: float,
    bounds: tuple[float, float],
    tolerance: float,
    slope: float | None = None,
    max_evaluations: int = 60,
) -> Root:
    """Root of an increasing f, by expansion from ``guess`` and then Chandrupatla's method.

    ``f(x)`` returns (value, payload); stops when |value| <= tolerance. The bracket grows by
    doubled steps inside ``bounds``; a function of one sign there ends with "iteration_limit". Where ``slope`` is
    roughly known, the first step is Newton's, at most ``step``.
    Source: T. R. Chandrupatla, Adv. Eng. Softw. 28 (1997) 145-149, doi:10.1016/S0965-9978(96)00051-8.
    """
    history, best = [], None

    def evaluate(x):
        nonlocal best
        value, payload = f(x)
        history.append(abs(value))
        if best is None or abs(value) < abs(best[1]):
            best = (x, value, payload)
        return value

    def done():
        return abs(best[1]) <= tolerance or len(history) >= max_evaluations

    x = min(max(guess, bounds[0]), bounds[1])
    lower = upper = None
    while not done_bracketing(lower, upper):
        value = evaluate(x)
        if done():
            return _root(best, history, tolerance)
        if value < 0:
            lower = (x, value)
        else:
            upper = (x, value)
        if slope and len(history) == 1:
            step = min(step, abs(value) / slope)
        if not done_bracketing(lower, upper):
            edge = bounds[1] if upper is None else bounds[0]
            if x == edge:
                return _root(best, history, tolerance)
            x = min(x + step, edge) if upper is None else max(x - step, edge)
            step *= 2

    a, b = upper, lower
    fraction, c = _secant(a, b), None
    while True:
        x = a[0] + fraction * (b[0] - a[0])
        if x in (a[0], b[0]):  # the bracket is down to rounding, and f still jumps in it
            return _root(best, history, tolerance)
        point = (x, evaluate(x))
        if done():
            return _root(best, history, tolerance)
        if (point[1] > 0) == (a[1] > 0):
            c, a = a, point
        else:
            c, b, a = b, a, point
        fraction = _next_fraction(a, b, c)


def done_bracketing(lower, upper) -> bool:
    """Both signs have been seen."""
    return lower is not None and upper is not None


def _secant(a, b) -> float:
    return min(max(a[1] / (a[1] - b[1]), 0.02), 0.98)


def _next_fraction(a, b, c) -> float:
    """Inverse quadratic interpolation where it is safe (Chandrupatla), else bisection; in (0, 1)."""
    xi = (a[0] - b[0]) / (c[0] - b[0])
    phi = (a[1] - b[1]) / (c[1] - b[1])
    if not (phi**2 < xi and (1 - phi) ** 2 < 1 - xi):
        return 0.5
    t = a[1] / (b[1] - a[1]) * c[1] / (b[1] - c[1]) + (c[0] - a[0]) / (b[0] - a[0]) * a[1] / (c[1] - a[1]) * b[1] / (
        c[1] - b[1]
    )
    return min(max(t, 1e-3), 1 - 1e-3)


def _root(best, history, tolerance) -> Root:
    status = CONVERGED if abs(best[1]) <= tolerance else ITERATION_LIMIT
    return Root(*best, tuple(history), status)
