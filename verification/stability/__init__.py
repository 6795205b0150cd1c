"""``python -m verification stability``: map where methods fail, and prove that the default ones say so.

The exit code is 1 when a cell of a default method is silently wrong, when one inside the promised range failed, when a
bad input was not refused in words, or when one of many random scenes was answered wrongly.
"""

from __future__ import annotations

import argparse
import importlib
from collections.abc import Iterator
from dataclasses import replace

from ..check import Item
from ..frame import Command
from ..frame import main as run
from ..studies import Study

MAPS = {
    "film": "Smooth film",
    "contact": "Dry contact",
    "sharing": "Load sharing",
    "whole": "One gap, one pressure",
}
LEVELS = ("full", "quick")


def main(argv: list[str]) -> int:
    """The command."""
    studies = tuple(
        Study(name, "verification.stability:stability_map", title, LEVELS, {"name": name})
        for name, title in MAPS.items()
    )
    studies += (
        Study("bad-inputs", "verification.hostile.study:bad_inputs", "Bad input", LEVELS),
        Study("soak", "verification.hostile.study:soak", "Random scenes in one process", LEVELS),
    )
    return run(Command("stability", __doc__, studies, "out/stability", LEVELS, workers=1, prepared=_kept), argv)


def _kept(study: Study, options: argparse.Namespace) -> Study:
    """The soak and the map of the whole keep what is done in the folder of the report; the soak, alone, has all the
    processes."""
    folder = {"folder": options.out / f"{study.name}-{options.level}"}
    if study.name == "whole":
        return replace(study, options=study.options | folder)
    if study.name != "soak":
        return study
    workers = options.workers if options.only == ["soak"] else 1
    return replace(study, options=folder | {"workers": workers})


def stability_map(level: str, name: str, **kept) -> Iterator[Item]:
    """Every cell of one map, judged without asking the solver; then their counts and their picture."""
    from .draw import draw, table

    cells = []
    for found in importlib.import_module(f"verification.stability.{name}_map").cells(level, **kept):
        cells.append(found)
        yield found
    yield table(name, cells)
    yield draw(name, cells)
