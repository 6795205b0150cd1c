"""``python -m verification stability``: map where methods fail, and prove that the default ones say so.

The exit code is 1 when a cell of a default method is silently wrong, when one inside the promised range failed, when a
bad input was not refused in words, or when one of many random scenes was answered wrongly.
"""

import importlib
from collections.abc import Iterator
from functools import partial

from ... import frame
from ...check import Check, Item
from ...kept import Run

MAPS = {"film": "Smooth film", "contact": "Dry contact", "sharing": "Load sharing", "whole": "One gap, one pressure"}
PARTS = (
    *((name, "stability:stability_map", title, {"name": name}) for name, title in MAPS.items()),
    ("bad-inputs", "hostile:bad_inputs", "Bad input", {}),
    ("soak", "hostile.soak:soak", "Random scenes", {}),
)
COMMAND = frame.campaign("stability", __doc__, PARTS, ("full", "quick"))


def stability_map(level: str, name: str, run: Run = Run()) -> Iterator[Item]:
    """Every cell of one map, judged without asking the solver; then their counts and their picture."""
    from .draw import draw, table

    cells = _map(name).cells(level == "quick")
    values = []
    for _, row in run.solved({cell.name: cell for cell in cells}, partial(check_cell, name)):
        values.append(Check.from_dict(row))
        yield values[-1]
    yield table(name, values)
    yield draw(name, values)


def check_cell(name: str, cell) -> dict:
    """The check of one cell of the map ``name``, in plain types."""
    from . import cell as cells

    return cells.check_cell(cell, _map(name).solve, _map(name).deviations).as_dict()


def _map(name: str):
    return importlib.import_module(f"verification.campaigns.stability.{name}_map")
