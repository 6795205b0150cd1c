"""The unknown of the balance, ln(F_H/F_C), and its prediction at another speed."""

from __future__ import annotations

import math
from dataclasses import replace

from ..film import LineContact, moes_film
from .operating_point import OperatingPoint

BOUNDS = (-40.0, 30.0)  # film shares down to 4e-18, contact shares to 1e-13
NUDGE = 1e-3  # of the film's load, for the exponent of Moes' film
LARGEST_GROWTH = 50.0  # of ln(F_H/F_C): beyond it nothing is known
STEPS, FARTHEST, NEAR = 30, 1.0, 1e-3  # of Newton's method, its longest one, and how far it goes in ln(F_H/F_C)


def divided(load: float, split: float) -> tuple[float, float]:
    """(F_H, F_C) of ``load`` at split = ln(F_H/F_C)."""
    return load / (1 + math.exp(-split)), load / (1 + math.exp(split))


def foretold_split(
    point: OperatingPoint, speed: float, split: float, slope: float | None
) -> tuple[float, float | None]:
    """Predict the balance of ``point`` from that at another ``speed`` [m/s], with its ``split`` and the slope of its
    volume residual. Returns the split, and the slope there.

    The film follows Moes' formula, ``h ~ F_H^-m`` locally, and the mean gap a power of the contact's load,
    ``g ~ F_C^-b``. The slope of (g - h)/(g + h) at a balance is (b F_H + m F_C)/(2 F_T), which gives b. Without a
    slope, the film's load at the same gap is taken as proportional to the speed. The prediction is only a start:
    results depend on it within the tolerance of the root.
    """
    step = math.log(abs(point.speed / speed))
    if not slope or not step:
        return split + step, slope
    load = point.scene.bodies.load
    film_load, contact_load = divided(load, split)
    line = point.line(film_load)
    before = _moes(replace(line, entrainment_speed=speed), 1.0)
    stiffness = max(2 * slope * load - before[1] * contact_load, 0.0) / film_load
    found = split + step
    for _ in range(STEPS):
        now = divided(load, found)
        film, exponent = _moes(line, now[0] / film_load)
        steepness = (stiffness * now[0] + exponent * now[1]) / load
        excess = -stiffness * math.log(now[1] / contact_load) - math.log(film / before[0])
        move = min(max(-excess / steepness, -FARTHEST), FARTHEST)
        found = min(max(found + move, BOUNDS[0]), BOUNDS[1])
        if abs(excess) <= NEAR * steepness:
            return found, 0.5 * steepness
    return split + step, slope


def steepness(point: OperatingPoint, split: float, slope: float) -> float:
    """d ln(F_H/F_C)/d ln U at a balance, from the ``slope`` of its volume residual and Moes' formula at F_H.

    At a given division of the load the film grows as U^e, and the residual (gap - film)/(gap + film) falls by half of
    that. Along the curves of 48 random scenes it was 1 % off in the median, and at most 18 %.
    """
    line = point.line(divided(point.scene.bodies.load, split)[0])
    faster = replace(line, entrainment_speed=(1 + NUDGE) * line.entrainment_speed)
    exponent = math.log(_moes(faster, 1.0)[0] / _moes(line, 1.0)[0]) / math.log1p(NUDGE)
    return 0.5 * exponent / slope


def _moes(line: LineContact, share: float) -> tuple[float, float]:
    """Moes' film [m] of ``share`` of the load of ``line``, and m."""
    film = moes_film(share * line.M, line.L)
    heavier = moes_film((1 + NUDGE) * share * line.M, line.L)
    return line.film_unit * film, -math.log(heavier / film) / math.log1p(NUDGE)


def growth(moved: float, odds: float = math.inf) -> float:
    """How much more the contact load grows than to first order, when ln(F_H/F_C) falls by ``moved`` >= 0 from
    ln(``odds``), ``odds`` = F_H/F_C. As F_C = F_T/(1 + F_H/F_C), it is less than 1 where the contact carries most."""
    moved = min(moved, LARGEST_GROWTH)
    if not moved or not odds:
        return 1.0
    if odds == math.inf:
        return math.expm1(moved) / moved
    return ((1 + odds) / (1 + math.exp(-moved) * odds) - 1) * (1 + odds) / (moved * odds)
