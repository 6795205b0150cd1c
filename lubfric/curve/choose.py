"""Which speed to solve next, so that a Stribeck curve is known everywhere from few points."""

from __future__ import annotations

import numpy as np

from .interpolate import Interpolant, Samples, knee_of

CLOSE = 1.06  # ratio of the slowest film without contact to lift-off that pins the knee down
ENOUGH = 4  # speeds within a tenth of the knee: more would not tell it better
APART = 1.015  # least ratio of neighbouring speeds
SHARE = 0.8  # of the tolerance that the estimate of the error may reach
GRID = 400


def next_speed(samples: Samples, tolerance: float, tried=()) -> tuple[float | None, float]:
    """The speed [m/s] to solve next, or None where the curve is known; and the largest estimated relative error of f
    now.

    First the knee is enclosed: a film that only just clears the summits tells where they touch. After that, the speed
    with the largest estimated error is next, until the error is below 0.8 ``tolerance`` everywhere. ``tried``: speeds
    that failed, which are left alone.
    """
    speeds, knee = samples.speed, knee_of(samples)
    curve = Interpolant(samples, knee)
    at = np.geomspace(speeds[0], speeds[-1], GRID)[1:-1]
    taken = np.append(speeds, np.asarray(tried, dtype=float))
    error = np.where(_free(at, taken), curve.error(at), 0.0)
    largest = float(error.max())
    if knee is not None and speeds[samples.contacts] > CLOSE * knee and _about(knee, taken) < ENOUGH:
        above = 0.5 * (1 + CLOSE) * knee
        if _free(np.array([above]), taken)[0]:
            return float(above), largest
    if largest <= SHARE * tolerance:
        return None, largest
    return float(at[error.argmax()]), largest


def _about(knee: float, taken: np.ndarray) -> int:
    """Number of speeds within a tenth of the knee."""
    return int(np.count_nonzero(np.abs(np.log(taken / knee)) < 0.1))


def _free(at: np.ndarray, speeds: np.ndarray) -> np.ndarray:
    """Where ``at`` is not too close to a speed that is solved."""
    ratio = np.abs(np.log(at[:, None] / speeds[None, :])).min(axis=1)
    return ratio > np.log(APART)
