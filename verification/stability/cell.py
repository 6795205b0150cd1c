"""One condition, one method, one verdict, decided by a check that does not ask the solver."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass

import lubfric

from ..check import AT_MOST, Check

RIGHT, FAILED, WRONG = "right", "reported failure", "silently wrong"
VERDICTS = (RIGHT, FAILED, WRONG)
SOURCE = "the judge beside this map"


@dataclass(frozen=True)
class Condition:
    """Where a cell lies: the map and panel that it is drawn on, and x and y on their axes.

    ``inside`` says that it lies within the range in which the method that users get unasked promises to answer.
    """

    map: str
    panel: str
    x: float
    y: float
    inside: bool = True


def verdict(cell: Check) -> str:
    """One of `VERDICTS`."""
    return RIGHT if cell.passed else FAILED if cell.refused else WRONG


def judged(condition: Condition, method: str, solve: Callable, check: Callable, default: bool = True) -> Check:
    """Run ``solve()`` and hand a result to ``check``, which returns {name: deviation/allowed}. The worst one is
    measured.

    `lubfric.ConvergenceError` and `lubfric.InputError` are reported failures, and so is the analogue of another package
    (an exception whose class is named like it). Any other exception is a defect and ends the map. A ratio that is above
    1, or not a number, makes the cell silently wrong. What decides are the cells of the ``default`` method, which users
    get unasked: none may be silently wrong, and none inside its promise may fail.
    """
    begun = time.perf_counter()
    try:
        result = solve()
    except Exception as failure:
        if not (isinstance(failure, lubfric.LubfricError) or type(failure).__name__ in ("SolveError", "InputError")):
            raise
        refused = f"{type(failure).__name__}: {failure}"[:300]
        return _cell(condition, method, math.nan, refused, refused, time.perf_counter() - begun, default)
    seconds = time.perf_counter() - begun
    ratios = check(result)
    worst = max(ratios, key=lambda name: ratios[name] if math.isfinite(ratios[name]) else math.inf)
    return _cell(condition, method, ratios[worst], worst, "", seconds, default)


def _cell(c: Condition, method, ratio, note, refused, seconds, default) -> Check:
    inside = bool(c.inside)
    return Check(
        f"{c.map}; {c.panel}; x = {c.x:g}, y = {c.y:g}; {method}",
        ratio,
        1.0,
        0.0,
        SOURCE,
        AT_MOST,
        unit="of what is allowed",
        note=note,
        seconds=seconds,
        decisive=default and (inside or not refused),
        refused=refused,
        at={
            "map": c.map,
            "panel": c.panel,
            "method": method,
            "x": float(c.x),
            "y": float(c.y),
            "default": default,
            "inside": inside,
        },
    )
