"""The chart of the quick answer: error of f against time on the random contacts of the campaign "calibration".

Five kinds of contact, with the roughness at rest and moving. Errors are |ln(f/f of the reference)|, their median and the
range of the middle half of the contacts. Calibrated load sharing is without the bias of a fit to other lays or loads. The
reference at rest is the deterministic model on the cells of the map, and in rolling the same with tight settings for the
march in time. Times are processor seconds on one strip.
"""

import math
import time
from collections.abc import Iterator

import numpy as np

import lubfric
from lubfric.models.deterministic import solve_strip

from ... import plotting
from ...check import Check, Figure
from ..calibration import fit
from ..calibration.case import drawn as drawn_case
from ..moving_effort.table import differences
from .draw import COLOURS
from .measure import point, quartiles

HEAVY = 7e8  # Pa: peak Hertz pressure from which on a contact is a heavy one
KINDS = ("isotropic", "across", "along", "plateau", "heavy")
MOTIONS = {"rest": "at rest", "rolling": "rolling"}
BY_EQUATION = "Eq. (9), paper"
CALIBRATED = "load sharing, calibrated"
LONG = "deterministic, long cells"
USUAL = "deterministic, usual"
METHODS = (BY_EQUATION, CALIBRATED, LONG, USUAL)
LONGER = {LONG: (4, 4), USUAL: (2, 2)}  # cells at rest over those of the map, along x and y
VARIANTS = {LONG: "longer", USUAL: "economical"}  # of the march in time
SOLVED = {True: 1, False: 5}  # contacts of a kind at rest that are solved for the chart
LEAST = 1e-4  # error that is drawn, at least


def cases(*, quick: bool) -> dict[str, tuple[str, str, bool]]:
    """Return a panel for each kind and motion."""
    return {f"{kind}, {words}": (kind, motion, quick) for motion, words in MOTIONS.items() for kind in KINDS}


def of_kind(row: dict[str, str], kind: str) -> bool:
    """Return whether the case of a ``row`` is of a ``kind``."""
    return float(row["pressure"]) > HEAVY if kind == "heavy" else row["lay"] == kind


def measured(chosen: tuple[str, str, bool]) -> list[dict]:
    """Return the points of one panel."""
    kind, motion, quick = chosen
    solved = fit.cases(motion)
    known = fit.design(solved)
    of = np.array([of_kind(case.row, kind) for case in solved])
    own = [case for case, is_own in zip(solved, of) if is_own]
    bias = known.of_bias[of] @ known.fit(~of).bias
    plain = [abs(math.log(f)) for f in (float(c.row["det_f"]) / c.numbers["ls_f"] for c in own) if f > 0]
    seconds = {name: [case.numbers[name] for case in own] for name in ("seconds_balance", "seconds")}
    panel = f"{kind}, {MOTIONS[motion]}"
    points = [
        _point(panel, BY_EQUATION, plain, seconds["seconds_balance"]),
        _point(panel, CALIBRATED, np.abs(known.errors[of] - bias).tolist(), seconds["seconds"]),
    ]
    deterministic = _at_rest(own[: SOLVED[quick]]) if motion == "rest" else _rolling(own)
    points += [_point(panel, method, errors, times) for method, errors, times in deterministic if errors]
    return points


def _point(panel: str, method: str, errors: list[float], seconds: list[float]) -> dict:
    low, median, high = (float(value) for value in np.quantile(errors, (0.25, 0.5, 0.75)))
    return point(panel, method, "", median, quartiles(seconds), least=low, most=high, cases=len(errors))


def _at_rest(own: list[fit.Solved]) -> Iterator[tuple[str, list[float], list[float]]]:
    for method, factors in LONGER.items():
        errors = []
        times = []
        for case in own:
            drawn = drawn_case("rest", int(case.row["seed"]))
            begun = time.process_time()
            try:
                strip = solve_strip(drawn.scene, drawn.surface, drawn.speed, factors=factors)
            except lubfric.LubfricError:
                continue
            times.append(time.process_time() - begun)
            errors.append(abs(math.log(float(case.row["det_f"]) / strip.result.coefficient)))
        yield method, errors, times


def _rolling(own: list[fit.Solved]) -> Iterator[tuple[str, list[float], list[float]]]:
    rows = {case.row["seed"]: float(case.row["seconds"]) for case in own}
    table = [row for row in differences() if row["seed"] in rows and row["starved"] == "0"]
    usual = {row["seed"]: row["faster"] for row in table if row["variant"] == VARIANTS[USUAL]}
    for method, variant in VARIANTS.items():
        part = [row for row in table if row["variant"] == variant and row["seed"] in usual]
        errors = [abs(math.log1p(row["f"])) for row in part]
        times = [rows[row["seed"]] * usual[row["seed"]] / row["faster"] for row in part]
        yield method, errors, times


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
