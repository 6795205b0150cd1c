"""``python -m verification figures``: Figs. 2 to 10 of the paper, each as data, picture and a verdict.

Paper: A. Akchurin, R. Bosman, P. M. Lugt, M. van Drogen, Tribol. Lett. 59:19 (2015),
doi:10.1007/s11249-015-0536-z. A figure is a function ``name(quick)`` that returns a `PaperFigure`; its
verdict is written from the numbers of the run. ``--quick`` takes smaller grids and fewer cases, to see that
all works.
"""

from __future__ import annotations

import argparse
import importlib
import sys
import time
from pathlib import Path

from .page import write_document, write_figure, write_index

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


def main(argv: list[str] | None = None) -> int:
    """Exit code 0: all chosen figures written; 2: the command makes no sense."""
    options = _parser().parse_args(argv)
    options.out.mkdir(parents=True, exist_ok=True)
    done, begun = [], time.perf_counter()
    for name in options.only or FIGURES:
        start = time.perf_counter()
        module, _, function = FIGURES[name].partition(":")
        figure = getattr(importlib.import_module(module), function)(options.quick)
        seconds = time.perf_counter() - start
        write_figure(options.out, figure)
        done.append((figure, seconds))
        write_index(options.out, done, options.quick)
        if options.docs:
            write_document(options.docs, done)
        print(f"{name}: {seconds:.1f} s  {figure.agrees}", file=sys.stderr, flush=True)
    print(f"{len(done)} figures in {time.perf_counter() - begun:.0f} s: {options.out / 'index.html'}")
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("python -m verification figures", description=__doc__)
    parser.add_argument(
        "--only",
        nargs="+",
        choices=list(FIGURES),
        metavar="NAME",
        help=f"some of: {', '.join(FIGURES)} (fig4 draws Figs. 3 and 4)",
    )
    parser.add_argument(
        "--out",
        type=Path,
        default=Path("out/figures"),
        metavar="DIR",
        help="where the files go (default: %(default)s)",
    )
    parser.add_argument("--quick", action="store_true", help="small grids, few cases")
    parser.add_argument(
        "--docs",
        type=Path,
        metavar="DIR",
        help="also write figures.md and images/ there (the project keeps them under docs)",
    )
    return parser
