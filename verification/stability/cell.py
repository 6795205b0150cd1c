"""One condition, one method, one verdict, decided by a check that does not ask the solver."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass

import lubfric

RIGHT, FAILED, WRONG = "right", "reported failure", "silently wrong"
VERDICTS = (RIGHT, FAILED, WRONG)


@dataclass(frozen=True)
class Cell:
    """What one method did under one condition.

    Attributes
    ----------
    map, panel, method : where it is drawn; ``default``: the method that users get unasked
    x, y : its condition, on the axes of the map
    verdict : one of `VERDICTS`
    error : worst ratio of a measured deviation to what is allowed for it (NaN for a reported failure)
    note : which deviation was the worst, or the failure as the method told it
    inside : it lies within the range in which the default promises to answer
    """

    map: str
    panel: str
    method: str
    x: float
    y: float
    verdict: str
    error: float
    note: str
    seconds: float
    default: bool
    inside: bool

    def as_dict(self) -> dict:
        """Plain types, ready for JSON."""
        return asdict(self)


@dataclass(frozen=True)
class Condition:
    """Where a cell lies; see `Cell`."""

    map: str
    panel: str
    x: float
    y: float
    inside: bool = True


def judged(condition: Condition, method: str, solve: Callable, check: Callable, default: bool = True) -> Cell:
    """Run ``solve()``; a result is handed to ``check``, which returns {name: deviation/allowed}.

    `lubfric.ConvergenceError` and `lubfric.InputError` are reported failures, and so is the analogue of another
    package (an exception whose class is named like it). Any other exception is a defect and ends the map.
    A ratio above 1 or not a number makes the cell silently wrong.
    """
    begun = time.perf_counter()
    try:
        result = solve()
    except Exception as failure:
        if not (isinstance(failure, lubfric.LubfricError) or type(failure).__name__ in ("SolveError", "InputError")):
            raise
        return _cell(
            condition,
            method,
            FAILED,
            math.nan,
            f"{type(failure).__name__}: {failure}"[:300],
            time.perf_counter() - begun,
            default,
        )
    seconds = time.perf_counter() - begun
    ratios = check(result)
    worst = max(ratios, key=lambda name: ratios[name] if math.isfinite(ratios[name]) else math.inf)
    right = math.isfinite(ratios[worst]) and ratios[worst] <= 1
    return _cell(condition, method, RIGHT if right else WRONG, float(ratios[worst]), worst, seconds, default)


def _cell(condition, method, verdict, error, note, seconds, default) -> Cell:
    return Cell(
        condition.map,
        condition.panel,
        method,
        float(condition.x),
        float(condition.y),
        verdict,
        error,
        note,
        seconds,
        default,
        bool(condition.inside),
    )
