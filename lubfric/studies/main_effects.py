"""Shares of the variance of ln f that the inputs of a study have, each by itself."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np
from scipy.stats import rankdata

from ..models.shared import is_by_sliding
from .operating_points import INTERVAL_COLUMNS
from .points import SPEED
from .tables import columns_of_study, name_of

# Points with f from which shares are stated. A convention.
LEAST_POINTS = 6

# Points with f for each number that seldom repeats, from which shares are stated. A convention.
POINTS_FOR_EACH = 6

# Rank correlation of two inputs from which their shares are not told apart. A convention.
MOST_CORRELATED = 0.3

# Standard deviations by which the points at one pair of values of two inputs may exceed those of independent inputs. A
# convention: a few of 10,000 pairs do by chance.
MOST_ALIKE = 4.0

# Points of an axis at each value of an input, on average, from which these are groups where other inputs change along
# that axis; else a parabola is laid through all points. A choice: one each has no scatter in a group.
POINTS_IN_GROUP = 2

# Ratio of the largest to the smallest value from which a number counts by its logarithm. A choice: it changes the
# parabola, which is an estimate.
WIDE = 3.0


# Sets of errors of f that are drawn for the interval of a share, and the seed of these draws. A choice: fewer scatter
# by more than a digit shown.
ERROR_DRAWS = 400
ERROR_SEED = 0

# Ends of the interval of a share, in percent of the draws. A convention: 95 %.
ENDS_OF_INTERVAL = (2.5, 97.5)

# Half width of an interval at 95 % over the standard deviation of a normal error: it follows from the normal
# distribution.
HALF_WIDTH_OF_NORMAL = 1.96


class MainEffect(NamedTuple):
    """Effect of one input of a study.

    ``share``: of the variance of ln |f|, or of ln P, over the points, by this input alone; ``slope``: sign of the
    change of |f| with it, 0 for words; ``interval``: (lowest, highest) share within the numerical, sampling and model-form errors of f at
    95 %, NaN where one of them is not known.
    """

    share: float
    slope: int
    interval: tuple[float, float]


def main_effects(result: Any, quantity: str = "coefficient") -> dict[str, MainEffect]:
    """Return the `MainEffect` on ``quantity`` ("coefficient", "power_loss") of every input that a `StudyResult` varies,
    by its key, the largest first.

    The share is the variance of the mean of ln |f| at each value of the input over that of ln |f| (the first-order
    index of Sobol); of a number that seldom repeats, that of a parabola in the number, or in its logarithm where it
    varies by more than a factor of 3. Empty where f is known at too few points, does not vary, or `why_not_separated`.
    What only says where an operating point lies is no input.
    """
    columns = columns_of_study(result)
    known = _known(columns, quantity)
    keys = _inputs(result, columns, known)
    if result.chosen or len(keys) < 2 or known.sum() < LEAST_POINTS or why_not_separated(result, quantity):
        return {}
    y = np.log(np.abs(columns[quantity][known]))
    if not y.std() > 0:
        return {}
    x = {key: _coordinate(columns[key][known]) for key in keys}
    draws = np.random.default_rng(ERROR_SEED).standard_normal((ERROR_DRAWS, y.size))
    errors = _independent_errors(columns, known) if quantity == "coefficient" else _errors_by_interval(columns, known)
    noise = draws * errors
    effects = {}
    for key in keys:
        is_number = columns[key].dtype.kind == "f"
        explained = partial(_explained, x[key], is_fitted=is_number and is_scattered(result, key))
        share = explained(y) / float(y.var())
        low, high = np.percentile(_drawn_shares(explained, y, noise), ENDS_OF_INTERVAL)
        slope = int(np.sign(np.corrcoef(x[key], y)[0, 1])) if is_number else 0
        effects[key] = MainEffect(share=share, slope=slope, interval=(min(float(low), share), max(float(high), share)))
    return dict(sorted(effects.items(), key=lambda pair: -pair[1].share))


def why_not_separated(result: Any, quantity: str = "coefficient") -> str:
    """Return why the effects of the inputs of a `StudyResult` cannot be told apart, as text; "" where they can: its
    points are too few, or two inputs change together over them, or share a pair of values more often than points do
    that are drawn independently."""
    columns = columns_of_study(result)
    known = _known(columns, quantity)
    keys = _inputs(result, columns, known)
    count = int(known.sum())
    if result.chosen or len(keys) < 2 or count < 2:
        return ""
    scattered = [key for key in keys if is_scattered(result, key)]
    if count < POINTS_FOR_EACH * len(scattered):
        return f"{count} points are too few for {len(keys)} inputs"
    x = {key: _coordinate(columns[key][known]) for key in keys}
    together = np.abs(np.corrcoef([rankdata(values) for values in x.values()])) - np.eye(len(keys))
    (one, other) = (keys[place] for place in np.unravel_index(int(together.argmax()), together.shape))
    if together.max() > MOST_CORRELATED:
        return f"{name_of(one)} and {name_of(other)} change together (rank correlation {together.max():.2f})"
    for one, other in combinations(keys, 2):
        alike = _alike_pairs(x[one], x[other])
        if alike:
            return f"{alike} points share one value of {name_of(one)} and one of {name_of(other)}"
    return ""


def _alike_pairs(one: np.ndarray, other: np.ndarray) -> int:
    """Return how many points share the pair of values, of ``one`` and ``other`` input (n,), that occurs most above what
    independent inputs have; 0 where none is above `MOST_ALIKE` standard deviations."""
    (_, place, count) = np.unique(one, return_inverse=True, return_counts=True)
    (_, place_of_other, count_of_other) = np.unique(other, return_inverse=True, return_counts=True)
    (pairs, frequency) = np.unique(place * count_of_other.size + place_of_other, return_counts=True)
    expected = count[pairs // count_of_other.size] * count_of_other[pairs % count_of_other.size] / one.size
    excess = (frequency - expected) / np.sqrt(np.maximum(expected, 1.0))
    return int(frequency[excess.argmax()]) if excess.max() > MOST_ALIKE else 0


def _known(columns: dict[str, np.ndarray], quantity: str) -> np.ndarray:
    """Return at which points a ``quantity`` counts, (n,)."""
    size = np.abs(columns[quantity])
    counted = is_by_sliding(columns) if quantity == "coefficient" else np.ones(size.size, dtype=bool)
    return np.isfinite(size) & (size > 0) & counted


def _inputs(result: Any, columns: dict[str, np.ndarray], known: np.ndarray) -> list[str]:
    """Return the keys of the inputs that a `StudyResult` varies over its ``known`` points."""
    inputs = {SPEED, *(key for axis in result.plan.axes for key in axis.keys)}
    return [key for key in result.coords if key in inputs and np.unique(columns[key][known]).size > 1]


def _coordinate(values: np.ndarray) -> np.ndarray:
    """Return the ``values`` of an input as numbers: of words their place in the alphabet, of a wide range
    logarithms."""
    if values.dtype.kind != "f":
        return np.unique(values.astype(str), return_inverse=True)[1].astype(float)
    return np.log(values) if values.min() > 0 and values.max() > WIDE * values.min() else values


def is_scattered(result: Any, key: str) -> bool:
    """Return whether a ``key`` that a `StudyResult` varies seldom repeats its values along an axis that other inputs
    share, as in a sample: what these do is then in the mean of f at each value."""
    (dim, values) = result.coords[key]
    inputs = {SPEED, *(name for axis in result.plan.axes for name in axis.keys)}
    others = [
        name
        for name, (of_other, column) in result.coords.items()
        if name != key and name in inputs and of_other == dim and np.unique(column).size > 1
    ]
    return bool(others) and bool(np.unique(values).size * POINTS_IN_GROUP > values.size)


def _independent_errors(columns: dict[str, np.ndarray], known: np.ndarray) -> np.ndarray:
    """Return the standard deviation of ln |f| at the ``known`` points by the errors that differ from point to point;
    NaN where one of these is not known."""
    unknown = np.full(known.shape, np.nan)
    numerical, model, sampling = (
        columns.get(f"{name}_error", unknown)[known] for name in ("numerical", "model", "sampling")
    )
    return np.hypot(np.hypot(numerical, model) / HALF_WIDTH_OF_NORMAL, sampling)


def _errors_by_interval(columns: dict[str, np.ndarray], known: np.ndarray) -> np.ndarray:
    """Return the standard deviation of ln P at the ``known`` points by the intervals of the power loss."""
    low, high = (columns[name][known] for name in INTERVAL_COLUMNS["power_loss"])
    return 0.5 * (high - low) / np.abs(columns["power_loss"][known]) / HALF_WIDTH_OF_NORMAL


def _drawn_shares(explained: Callable[[np.ndarray], float], y: np.ndarray, noise: np.ndarray) -> np.ndarray:
    """Return the shares, (n,), of the variance of ``y`` with each of the n rows of ``noise`` that an input ``explained``.

    Noise adds a variance of its own, of which the input explains a part by chance: without its mean over the rows all
    shares would be too small.
    """
    parts = np.array([explained(y + each) for each in noise]) - np.mean([explained(each) for each in noise])
    variances = (y + noise).var(axis=1) - np.mean(noise.var(axis=1))
    if np.isnan(noise).any():
        return np.full(variances.shape, np.nan)
    # as much noise as there is variance leaves any share
    ratios = np.divide(parts, variances, out=np.where(parts > 0.0, 1.0, 0.0), where=variances > 0.0)
    return np.clip(ratios, 0.0, 1.0)


def _explained(x: np.ndarray, y: np.ndarray, *, is_fitted: bool) -> float:
    """Return the variance of ``y`` that ``x`` explains; ``is_fitted``: by a parabola, else by the means at each value."""
    if not is_fitted:
        (_, place, count) = np.unique(x, return_inverse=True, return_counts=True)
        means = (np.bincount(place, y) / count)[place]
    else:
        middle = (x - x.mean()) / x.std()
        means = np.polyval(np.polyfit(middle, y, 2), middle)
    return float(means.var())
