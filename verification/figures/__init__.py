"""``python -m verification figures``: Figs. 2 to 10 of the paper, each as data, picture and a verdict.

The paper is A. Akchurin, R. Bosman, P. M. Lugt, M. van Drogen, Tribol. Lett. 59:19 (2015),
doi:10.1007/s11249-015-0536-z. A figure is a function ``name(quick)`` that returns a `PaperFigure`. Its verdict is
written from the numbers of the run. ``--quick`` takes smaller grids and fewer cases, to see that all works. (fig4 draws
Figs. 3 and 4.)
"""

from __future__ import annotations

import importlib
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator
from pathlib import Path

from ..check import Figure, Item, Table
from ..frame import Command
from ..frame import main as run
from ..report import Report
from ..studies import Study
from .page import markdown, write_document

FIGURES = {
    "fig2": "verification.figures.surfaces:generated_surfaces",
    "fig4": "verification.figures.spheres:sphere_array",
    "fig5": "verification.figures.deviation:friction_curves",
    "fig6": "verification.figures.deviation:deviation_map",
    "fig8": "verification.figures.cylinder:stribeck_curves",
    "fig9": "verification.figures.cylinder:pressure_map",
    "fig10": "verification.figures.cylinder:sections",
    "film": "verification.figures.options:film_deflection",
}
LEVELS = ("full", "quick")


def main(argv: list[str] | None = None) -> int:
    """The command."""
    studies = tuple(Study(name, "verification.figures:figure", name, LEVELS, {"name": name}) for name in FIGURES)
    command = Command("figures", __doc__, studies, "out/figures", LEVELS, 0, _options, finished=_document)
    return run(command, [] if argv is None else argv)


def figure(level: str, name: str) -> Iterator[Item]:
    """One figure of the paper: its checks, its data, its picture."""
    module, _, function = FIGURES[name].partition(":")
    made = getattr(importlib.import_module(module), function)(level == "quick")
    yield from made.checks
    for stem, (headings, rows) in made.tables.items():
        yield Table(stem, made.title, headings, tuple(rows))
    yield Figure(made.name, markdown(made), made.picture, "png")


def _options(parser: ArgumentParser) -> None:
    words = "also write figures.md and images/ there (the project keeps them under docs)"
    parser.add_argument("--docs", type=Path, metavar="DIR", help=words)


def _document(report: Report, options: Namespace) -> str:
    if not options.docs:
        return ""
    made = [f for outcome in report.outcomes for f in outcome.figures]
    write_document(options.docs, {f.name: f.caption for f in made}, {f.name: f.data for f in made})
    return f"written: {options.docs / 'figures.md'}"
