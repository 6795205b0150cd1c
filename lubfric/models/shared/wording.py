"""Errors, and numbers beside their limits, as text: with as many digits as a reader needs."""

import math
from collections.abc import Callable

from .sides import Sides

# Digits of a number compared with another, at most. A convention.
MOST_DIGITS = 6

# Relative error that nobody can see. A convention.
INVISIBLE = 1e-5

# Part of f, of a film or of a load below which it is stated as less than that [-]. A choice: errors of f are larger.
LEAST_STATED_PART = 1e-4

# Temperature rise below which it is stated as less than that [K]. A choice: in 0.1 K the viscosity changes by less than
# 1 %.
LEAST_STATED_RISE = 0.1

# Error of f over f above which it is stated in f itself [-], where f is near 0: there a ratio to it says nothing. A
# convention.
MOST_RELATIVE = 1.0

# f below which it is near 0 [-]: as large is the rolling resistance of a film, beside which sliding friction is small.
# A convention.
NEAR_ZERO = 5e-3


def percent(value: float, digits: int = 2) -> str:
    """Return a ratio as text with so many ``digits`` (all of 100 and more) and a percent sign; "< 0.001 %" for what
    nobody can see, "not known" for NaN."""
    if math.isnan(value):
        return "not known"
    if value >= 0.995:
        return f"{100 * value:.{digits - 2}f} %"
    return "< 0.001 %" if 0 < value < INVISIBLE else f"{100 * value:.{digits}g} %"


def percent_or_less(part: float, digits: int = 2, *, before: str = "") -> str:
    """Return a ``part`` in percent with so many ``digits``, and ``before`` it such words as "at most "; "less than 0.01
    %" below `LEAST_STATED_PART`."""
    if 0 < part < LEAST_STATED_PART:
        return f"less than {100 * LEAST_STATED_PART:g} %"
    return f"{before}{float(f'{100 * part:.{digits}g}'):g} %"  # 100 %, not 1e+02 %


def rise_in_words(rise: float) -> str:
    """Return the largest temperature ``rise`` [K] to two digits; "less than 0.1 K" below `LEAST_STATED_RISE`."""
    if rise < LEAST_STATED_RISE:
        return f"less than {LEAST_STATED_RISE:g} K"
    return f"up to {float(f'{rise:.2g}'):g} K"  # 120 K, not 1.2e+02 K


def standard_error_in_words(tolerance: float) -> str:
    """Return what numerics.sampling_tolerance is, where errors beside it are stated at 95 %."""
    return f"the standard error numerics.sampling_tolerance = {tolerance:g}, at 95 %,"


def percent_beside(value: float, target: float) -> tuple[str, str]:
    """Return a ``value`` and its ``target`` as by `percent`, with as many digits as they need to differ as texts."""
    return distinct_texts(value, target, percent)


def distinct_texts(value: float, other: float, text_of: Callable[[float, int], str], least: int = 2) -> tuple[str, str]:
    """Return both numbers as ``text_of`` a number and of a number of digits writes them, with as few digits, from
    ``least`` to `MOST_DIGITS`, as they need to differ as texts. Equal ones have the ``least``."""
    for digits in range(least, MOST_DIGITS + 1):
        texts = text_of(value, digits), text_of(other, digits)
        if texts[0] != texts[1]:
            return texts
    return text_of(value, least), text_of(other, least)


def percent_of_sides(sides: tuple[float, float], largest: float) -> str:
    """Return a relative error with different ``sides`` as "-29 to +42 %", with equal ones as "42 %"; ``largest``: of
    both sides, which is alone known where these are NaN."""
    towards, away = sides
    if not (math.isfinite(towards) and math.isfinite(away)) or percent(towards) == percent(away):
        return percent(largest)
    low, high = (
        f"{sign}{percent(side)}" if side >= INVISIBLE else "0 %" for sign, side in (("-", towards), ("+", away))
    )
    return f"{low.removesuffix(' %')} to {high}"


def is_near_zero(f: float, error: float) -> bool:
    """Return whether ``f`` is so near 0 that its relative ``error`` says nothing."""
    return abs(f) < NEAR_ZERO and error > MOST_RELATIVE


def sides_in_f(sides: tuple[float, float], largest: float, f: float) -> str:
    """Return the same as `percent_of_sides` in f itself, as "-0.0004 to +0.0025", or "0.0004" where both sides are
    equal."""
    if not math.isfinite(largest):
        return "not known"
    size = abs(f)
    towards, away = sides
    if not (math.isfinite(towards) and math.isfinite(away)) or f"{towards:.2g}" == f"{away:.2g}":
        return f"{largest * size:.2g}"
    below, above = Sides(towards, away).below_and_above(f)
    low, high = (f"{sign}{side * size:.2g}" if side > 0 else "0" for sign, side in (("-", below), ("+", above)))
    return f"{low} to {high}"
