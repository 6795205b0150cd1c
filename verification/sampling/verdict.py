"""Numbers of the study beside their bounds."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ..check import ABSOLUTE, AT_LEAST, Check
from .measure import Result

CHANCE = 2.0  # standard errors of a proportion or ratio of few trials, granted beyond the bounds
RATIO = 0.15  # of the reported error over the scatter from 1
BIAS = 0.3  # of the sampling tolerance
PIECES = (0.85, 0.99)
WITHIN = 0.95
ENDLESS = "plain balances of long patches"
COLUMNS = ("case", "trials", "coverage", "reported / scatter", "bias", "mean length", "mean time", "says few spots")


def checks(result: Result) -> Iterator[Check]:
    """Coverage, reported error over observed scatter, and bias against the truth.

    The coverage decides nothing in a case of which most trials say that the map is too small.
    """
    case, n = result.case, len(result.rows)
    decides = float(result.column("told").mean()) <= 0.5
    coverage = float(result.covered.mean())
    yield _share(f"{case.name}: coverage", coverage, n, (case.low, case.high), ENDLESS, decides)
    slack = RATIO + CHANCE / math.sqrt(2 * n)
    yield Check(f"{case.name}: reported over scatter", result.ratio, 1.0, slack, "scatter of the trials", ABSOLUTE)
    slack = BIAS * case.asked + CHANCE * _error_of_mean(result)
    yield Check(f"{case.name}: bias of f", result.bias, 0.0, slack, ENDLESS, ABSOLUTE)


def row(result: Result) -> tuple[str, ...]:
    """The same numbers as cells of a table (`COLUMNS`)."""
    return (
        f"{result.case.name}, asked {100 * result.case.asked:g} %",
        str(len(result.rows)),
        f"{100 * result.covered.mean():.1f} %",
        f"{result.ratio:.2f}",
        f"{100 * result.bias:+.2f} ± {100 * _error_of_mean(result):.2f} %",
        f"{1e3 * result.column('length').mean():.3g} mm",
        f"{result.column('seconds').mean():.2g} s",
        f"{100 * result.column('told').mean():.0f} %",
    )


def of_pieces(rows: list[dict]) -> Check:
    """Coverage of the whole map's friction by the intervals of its pieces."""
    covered = float(np.mean([r["low"] <= r["whole"] <= r["high"] for r in rows]))
    return _share("pieces of a map: coverage", covered, len(rows), PIECES, "the whole map")


def of_quantities(counted: list[tuple[str, int, float, float]]) -> Iterator[Check]:
    """Every reported number within its stated error in 95 % of the scenes that state one."""
    for name, told, held, _ in counted:
        words = f"{name}: within its stated error in {told} scenes"
        yield Check(words, held, WITHIN, _chance(told), "everything modelled, at 0.01 %", AT_LEAST)


def _share(
    name: str, found: float, trials: int, bounds: tuple[float, float], source: str, decides: bool = True
) -> Check:
    """A check of a share of trials between two bounds, with what chance does to it."""
    low, high = bounds
    tolerance = (high - low) / 2 + _chance(trials)
    return Check(name, found, (high + low) / 2, tolerance, source, ABSOLUTE, decisive=decides)


def _chance(trials: int) -> float:
    """How much less than 95 % is granted to a share of few trials."""
    return CHANCE * math.sqrt(0.05 * 0.95 / trials)


def _error_of_mean(result: Result) -> float:
    """Relative standard error of the mean f of the trials beside the truth."""
    scatter = float(result.column("f").std(ddof=1)) / result.truth / math.sqrt(len(result.rows))
    return math.hypot(scatter, result.error)
