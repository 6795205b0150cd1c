"""``python -m verification charts``: error against time, and cost against size, measured on this machine.

Times are processor seconds, which another job on the machine changes less than it changes the time by the clock.
"""

from __future__ import annotations

import importlib
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from ..check import Item, Table
from ..frame import Command
from ..frame import main as run
from ..studies import Study

CHARTS = {
    "contact": "Dry contact: error against time",
    "film": "Smooth film: error against time",
    "job": "The whole job: error against time per point",
    "growth": "Cost growth",
}
LEVELS = ("full", "quick")


def main(argv: list[str]) -> int:
    """Run the command line."""
    studies = tuple(
        Study(name, "verification.charts:chart", title, LEVELS, {"name": name}) for name, title in CHARTS.items()
    )
    return run(
        Command("charts", __doc__, studies, "out/charts", LEVELS, 1, add_options=_options, prepared=_prepared), argv
    )


def chart(level: str, name: str, redraw: str = "") -> Iterator[Item]:
    """Every method at every setting, measured in turn on this machine, or drawn again from an earlier report."""
    from .data import load, machine, measured_on
    from .draw import growth, work_precision

    if redraw:
        points = load(Path(redraw), name)
    else:
        points = list(importlib.import_module(f"verification.charts.{name}").points(level))
    where = measured_on(Path(redraw), name) if redraw else machine()
    yield from points
    yield Table(f"{name}_machine", "Where and when the points were measured", ("machine",), ((where,),))
    yield growth(points, where) if name == "growth" else work_precision(name, points, where)


def _options(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--redraw", metavar="DIR", default="", help="draw the report in that folder again, measure nothing"
    )


def _prepared(study: Study, options: Namespace) -> Study:
    return replace(study, options=study.options | {"redraw": options.redraw})
