"""The next speed to solve, so that few points determine a Stribeck curve everywhere."""

from __future__ import annotations

import numpy as np

from .interpolate import Interpolant, Samples, knee_of

CLOSE, ABOVE = 1.2, 1.1  # ratio of the slowest film without contact to lift-off that pins it down; where to look
TOUCHING, BELOW = 0.75, 0.86  # the same of the fastest contact
WIDE = 12.0  # ratio of neighbouring speeds without contact from which one between them is solved
ENOUGH = 2  # speeds within a tenth of one that is wanted: more would not tell the knee better
SHARE, MANY = 0.5, 11  # of the tolerance that the estimate may reach, with fewer speeds than these
APART = 1.015  # least ratio of neighbouring speeds
GRID = 400


def next_speed(samples: Samples, tolerance: float, tried=()) -> tuple[float | None, float]:
    """The speed [m/s] to solve next, or None if the curve is known; and the largest estimated relative error of f now.

    ``tried``: speeds that failed and are left alone.

    First the knee at lift-off is enclosed: a film that just clears the summits tells where they touch, and the contact
    just before tells how it ends. No two films are left far apart. Then comes the speed at which the estimated error is
    largest, until that is below ``tolerance`` everywhere; with few speeds, below half of it.
    """
    speeds, knee = samples.speed, knee_of(samples)
    curve = Interpolant(samples, knee)
    at = np.geomspace(speeds[0], speeds[-1], GRID)[1:-1]
    taken = np.append(speeds, np.asarray(tried, dtype=float))
    error = np.where(_free(at, taken), curve.error(at), 0.0)
    largest = float(error.max())
    for wanted in (*_about_the_knee(samples, knee), *_between_films(samples)):
        if _about(wanted, taken) < ENOUGH and _free(np.array([wanted]), taken)[0]:
            return wanted, largest
    if largest <= (tolerance if speeds.size >= MANY else SHARE * tolerance):
        return None, largest
    return float(at[error.argmax()]), largest


def _about_the_knee(samples: Samples, knee: float | None) -> list[float]:
    """Speeds [m/s] that are needed to enclose the knee."""
    if knee is None:
        return []
    fastest, slowest = samples.speed[samples.contacts - 1], samples.speed[samples.contacts]
    above = [ABOVE * knee] if slowest > CLOSE * knee else []
    return [*above, BELOW * knee] if fastest < TOUCHING * knee else above


def _between_films(samples: Samples) -> list[float]:
    """Speeds [m/s] in the middle of intervals that are too wide to be judged from their ends."""
    films = samples.speed[samples.contacts :]
    return [float(np.sqrt(a * b)) for a, b in zip(films, films[1:]) if b > WIDE * a]


def _about(speed: float, taken: np.ndarray) -> int:
    """Number of speeds within a tenth of one."""
    return int(np.count_nonzero(np.abs(np.log(taken / speed)) < 0.1))


def _free(at: np.ndarray, speeds: np.ndarray) -> np.ndarray:
    """The speeds of ``at`` that are not too close to a solved one."""
    ratio = np.abs(np.log(at[:, None] / speeds[None, :])).min(axis=1)
    return ratio > np.log(APART)
