"""``python -m verification figures``: Figs. 2 to 10 of the paper, each as data, picture and a verdict.

The paper is A. Akchurin, R. Bosman, P. M. Lugt, M. van Drogen, Tribol. Lett. 59:19 (2015),
doi:10.1007/s11249-015-0536-z. A figure is a function ``name(quick, run)`` that returns a `PaperFigure`. Its verdict is
written from the numbers of the run. ``--quick`` takes smaller grids and fewer cases, to see that all works. (fig4 draws
Figs. 3 and 4.)
"""

import importlib
from argparse import Namespace
from collections.abc import Iterator
from dataclasses import replace

from .. import frame
from ..check import Item, Table
from ..kept import Run
from ..report import Report

FIGURES = {
    "fig2": "surfaces:generated_surfaces",
    "fig4": "spheres:sphere_array",
    "fig5": "deviation:friction_curves",
    "fig6": "deviation:deviation_map",
    "fig8": "cylinder:stribeck_curves",
    "fig9": "cylinder:pressure_map",
    "fig10": "cylinder:sections",
}


def main(argv: list[str]) -> int:
    """The command."""
    parts = [(name, "figures:figure", name, {"name": name}) for name in FIGURES]
    command = frame.campaign("figures", __doc__, parts, ("full", "quick"))
    return frame.main(replace(command, finished=_document), argv)


def figure(level: str, name: str, run: Run = Run()) -> Iterator[Item]:
    """One figure of the paper: its checks, its data, its picture."""
    from . import page

    module, _, function = FIGURES[name].partition(":")
    made = getattr(importlib.import_module(f"verification.figures.{module}"), function)(level == "quick", run)
    yield from made.checks
    for stem, (headings, rows) in made.tables.items():
        yield Table(stem, made.title, headings, rows)
    yield page.picture(made)


def _document(report: Report, options: Namespace) -> str:
    from . import page

    if not options.docs:
        return ""
    page.write(options.docs, [f for outcome in report.outcomes for f in outcome.figures])
    return f"written: {options.docs / 'paper.md'}"
