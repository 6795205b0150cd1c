"""``python -m verification stability``: maps of the conditions under which methods fail, and a check that the default
methods report it.

The exit code is 1 when a cell of a default method is silently wrong, when a cell inside the stated range failed, when
a bad input was not refused with a message, or when one of many random scenes had a wrong answer.
"""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from functools import partial
from types import ModuleType
from typing import TYPE_CHECKING

from ... import frame
from ...check import Check, Item
from ...kept import Run
from ...types import PlainRow, PlainValue

if TYPE_CHECKING:
    from .cell import Cell

MAPS = {"film": "Smooth film", "contact": "Dry contact", "sharing": "Load sharing", "whole": "Deterministic model"}
PARTS = (
    *((name, "stability:stability_map", title, {"name": name}) for name, title in MAPS.items()),
    ("bad-inputs", "hostile:bad_inputs", "Bad input", {}),
    ("soak", "hostile.soak:soak", "Random scenes", {}),
)
COMMAND = frame.campaign("stability", __doc__, PARTS, ("full", "quick"))


def stability_map(level: str, name: str, run: Run = Run()) -> Iterator[Item]:
    """Check every cell of one map independently of the solver; then count and draw them."""
    from .draw import draw, table

    cells = _map(name).cells(quick=level == "quick")
    values = []
    for _, row in run.solved({cell.name: cell for cell in cells}, partial(check_cell, name)):
        values.append(Check.from_dict(row))
        yield values[-1]
    yield table(name, values)
    yield draw(name, values)


def check_cell(name: str, cell: Cell[PlainValue]) -> PlainRow:
    """Return the check of one cell of the map ``name``, in plain types."""
    from . import cell as cells

    return cells.check_cell(cell, _map(name).solve, _map(name).deviations).as_dict()


def _map(name: str) -> ModuleType:
    return importlib.import_module(f"verification.campaigns.stability.{name}_map")
