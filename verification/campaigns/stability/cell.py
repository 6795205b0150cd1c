"""One condition, one method, one verdict, decided by a check that does not ask the solver."""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

from lubfric import LubfricError

from ...check import AT_MOST, Check

RIGHT = "right"
FAILED = "reported failure"
WRONG = "silently wrong"
VERDICTS = (RIGHT, FAILED, WRONG)
# What a cell has solved, and what comes of it.
Problem = TypeVar("Problem")
Solution = TypeVar("Solution")


@dataclass(frozen=True, kw_only=True)
class Cell(Generic[Problem]):
    """The ``problem`` of a map, and where it is drawn: the map and panel, and x and y on their axes.

    Users get the ``default`` method unasked. ``inside``: the range in which it promises to answer.
    """

    map: str
    panel: str
    x: float
    y: float
    problem: Problem
    method: str = "default"
    default: bool = True
    inside: bool = True

    @property
    def name(self) -> str:
        """Return the complete name."""
        return f"{self.map}; {self.panel}; x = {self.x:g}, y = {self.y:g}; {self.method}"


def verdict(check: Check) -> str:
    """Return one of `VERDICTS`."""
    if check.passed:
        return RIGHT
    return FAILED if check.refused else WRONG


def check_cell(
    cell: Cell[Problem],
    solve: Callable[[Cell[Problem]], Solution],
    deviations: Callable[[Cell[Problem], Solution], dict[str, float]],
) -> Check:
    """Solve the cell, and set the worst of the ``deviations`` of its result against 1: each is over what is allowed.

    A `lubfric.LubfricError` is a reported failure, and so is the analogue of the finite elements (an exception of that
    name). Any other exception is a defect and ends the map. A deviation above 1, or that is no number, makes the cell
    silently wrong. The cells of default methods decide: none may be silently wrong, and none inside its promise fail.
    """
    begun = time.perf_counter()
    ratio = math.nan
    refused = ""
    try:
        result = solve(cell)
    except Exception as failure:
        if not (isinstance(failure, LubfricError) or type(failure).__name__ in ("SolveError", "InputError")):
            raise
        note = f"{type(failure).__name__}: {failure}"[:300]
        refused = note
        seconds = time.perf_counter() - begun
    else:
        seconds = time.perf_counter() - begun
        ratios = deviations(cell, result)
        note = max(ratios, key=lambda name: ratios[name] if math.isfinite(ratios[name]) else math.inf)
        ratio = ratios[note]
    at: dict[str, str | float] = {"map": cell.map, "panel": cell.panel, "method": cell.method}
    at |= {"x": float(cell.x), "y": float(cell.y), "default": cell.default, "inside": cell.inside}
    return Check(
        cell.name,
        ratio,
        expected=1.0,
        tolerance=0.0,
        source="the independent check of this map",
        kind=AT_MOST,
        unit="of what is allowed",
        note=note,
        seconds=seconds,
        decisive=cell.default and (cell.inside or not refused),
        refused=refused,
        at=at,
    )
