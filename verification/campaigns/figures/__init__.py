"""``python -m verification figures``: Figs. 2 to 10 of the paper, each as data, picture and assessment.

The paper is A. Akchurin, R. Bosman, P. M. Lugt, M. van Drogen, Tribol. Lett. 59:19 (2015),
doi:10.1007/s11249-015-0536-z. Each figure yields its checks, its data and its picture, with a verdict that is written
from the numbers of the run. ``--quick`` takes smaller grids and fewer cases, to see that all works. (fig4 draws Figs. 3
and 4.)
"""

from argparse import Namespace
from dataclasses import replace

from ... import frame
from ...report import Report
from ...types import Keywords

FIGURES = {
    "fig2": "surfaces:generated_surfaces",
    "fig4": "spheres:sphere_array",
    "fig5": "deviation:friction_curves",
    "fig6": "deviation:deviation_map",
    "fig8": "cylinder:stribeck_curves",
    "fig9": "cylinder:pressure_map",
    "fig10": "cylinder:sections",
}


def _document(report: Report, options: Namespace) -> str:
    from . import page

    if not options.docs:
        return ""
    page.write(options.docs, [f for outcome in report.outcomes for f in outcome.figures])
    return f"written: {options.docs / 'paper.md'}"


PARTS: list[tuple[str, str, str, Keywords]] = [(name, f"figures.{at}", name, {}) for name, at in FIGURES.items()]
COMMAND = replace(frame.campaign("figures", __doc__, PARTS, ("full", "quick")), finished=_document)
