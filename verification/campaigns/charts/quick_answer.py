"""The chart of the quick model: error of f against time on the random contacts of the campaign "calibration".

Five kinds of contact, with the roughness at rest and moving. Errors are |ln| of f over the reference, their median and
the range of the middle half of the contacts. The quick model is without the bias of a fit to other lays or loads. The
deterministic model on long cells is the same without that bias, and on short ones it is the reference before the
correction for its own cells. Times are processor seconds on one strip. All numbers are those of the campaign's tables.
"""

import numpy as np

from ... import plotting
from ...check import Check, Figure
from ...types import PlainRow
from ..calibration import fit
from .draw import COLOURS
from .measure import point, quartiles

HEAVY = 7e8  # Pa: peak Hertz pressure from which on a contact is a heavy one
KINDS = ("isotropic", "across", "along", "plateau", "heavy")
MOTIONS = {"rest": "at rest", "rolling": "rolling"}
BY_EQUATION = 'load sharing ("paper")'
QUICK = "quick model: long cells, calibrated"
LONG = "deterministic, long cells"
SHORT = "deterministic, cells half as long"
METHODS = (BY_EQUATION, QUICK, LONG, SHORT)
LEAST = 1e-4  # error that is drawn, at least


def cases(*, quick: bool) -> dict[str, tuple[str, str]]:
    """Return a panel for each kind and motion."""
    return {f"{kind}, {words}": (kind, motion) for motion, words in MOTIONS.items() for kind in KINDS}


def of_kind(row: dict[str, str], kind: str) -> bool:
    """Return whether the case of a ``row`` is of a ``kind``."""
    return float(row["pressure"]) > HEAVY if kind == "heavy" else row["lay"] == kind


def measured(chosen: tuple[str, str]) -> list[PlainRow]:
    """Return the points of one panel."""
    kind, motion = chosen
    solved = fit.cases(motion)
    known = fit.design(solved)
    is_of_kind = np.array([of_kind(case.row, kind) for case in solved])
    of_kind_alone = [case for case, chosen in zip(solved, is_of_kind) if chosen]
    errors = known.errors[is_of_kind]
    bias = known.of_bias[is_of_kind] @ known.fit(~is_of_kind).bias
    by_equation = np.array([float(case.row["det_f"]) / float(case.row["ls_f"]) for case in of_kind_alone])
    known_logarithm = by_equation > 0
    seconds = {
        BY_EQUATION: [float(case.row["ls_seconds"]) for case in of_kind_alone],
        QUICK: [case.numbers["seconds"] for case in of_kind_alone],
        LONG: [case.numbers["seconds"] for case in of_kind_alone],
        SHORT: [float(case.row["seconds"]) - float(case.row["ls_seconds"]) for case in of_kind_alone],
    }
    sizes = {
        BY_EQUATION: np.abs(np.log(by_equation[known_logarithm])),
        QUICK: np.abs(errors - bias),
        LONG: np.abs(errors),
        SHORT: np.abs([case.left for case in of_kind_alone]),
    }
    panel = f"{kind}, {MOTIONS[motion]}"
    return [_point(panel, method, sizes[method], seconds[method]) for method in METHODS]


def _point(panel: str, method: str, errors: np.ndarray, seconds: list[float]) -> PlainRow:
    low, median, high = (float(value) for value in np.quantile(errors, (0.25, 0.5, 0.75)))
    return point(panel, method, "", median, quartiles(seconds), least=low, most=high, cases=len(errors))


def drawn(name: str, points: list[Check], machine: str) -> Figure:
    """Return the figure: a row for each motion, a column for each kind."""
    canvas, grid = plotting.axes(len(MOTIONS), len(KINDS), 12.5, 5.6, sharex=True, sharey=True)
    colours = dict(zip(METHODS, COLOURS))
    for row, words in zip(grid, MOTIONS.values()):
        for ax, kind in zip(row, KINDS):
            for each in (p for p in points if p.at["panel"] == f"{kind}, {words}"):
                at = each.at
                error = max(each.measured, LEAST)
                spread = [[max(error - at["least"], 0.0)], [max(at["most"] - error, 0.0)]]
                across = [[max(at["seconds"] - at["low"], 0.0)], [max(at["high"] - at["seconds"], 0.0)]]
                ax.errorbar(
                    at["seconds"], error, spread, across, "o", color=colours[at["method"]], ms=5, elinewidth=0.9
                )
            ax.set(xscale="log", yscale="log", title=f"{kind}, {words}")
            ax.title.set_fontsize(9)
    for ax in grid[-1]:
        ax.set_xlabel("CPU seconds per strip")
    for row in grid:
        row[0].set_ylabel("error of f, |ln|")
    handles = [grid[0][0].plot([], [], "o", color=colour, label=method)[0] for method, colour in colours.items()]
    canvas.legend(handles=handles, loc="outside lower center", ncols=len(METHODS), frameon=False, fontsize=8)
    canvas.suptitle(machine.replace("; python", "\npython"), fontsize=6.5)
    return plotting.compact(plotting.finish(name, canvas, "Error of f against time", format="png"))
