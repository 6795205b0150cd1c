"""Numbers beside their bounds, as a table."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

CHANCE = 2.0  # standard errors of a proportion or ratio of few trials, granted beyond the bounds
RATIO = (0.85, 1.15)
BIAS = 0.3  # of the sampling tolerance
PIECES = (0.85, 0.99)
WITHIN = 0.95


@dataclass(frozen=True)
class Line:
    """One row of the table and whether it is within its bounds."""

    cells: tuple[str, ...]
    passed: bool


HEAD = ("case", "trials", "coverage", "reported / scatter", "bias", "mean length", "mean time", "told too few", "")


def of_case(result) -> Line:
    """Coverage, reported error over observed scatter, bias against the truth."""
    case, n = result.case, len(result.rows)
    coverage, ratio, bias = float(result.covered.mean()), result.ratio, result.bias
    slack = CHANCE * math.sqrt(0.05 * 0.95 / n)
    scatter = float(result.column("f").std(ddof=1)) / result.truth / math.sqrt(n)
    told = float(result.column("told").mean())
    passed = (
        (case.low - slack <= coverage <= case.high + slack or told > 0.5)
        and RATIO[0] - CHANCE / math.sqrt(2 * n) <= ratio <= RATIO[1] + CHANCE / math.sqrt(2 * n)
        and abs(bias) <= BIAS * case.asked + CHANCE * math.hypot(scatter, result.error)
    )
    cells = (
        f"{case.name}, asked {100 * case.asked:g} %",
        str(n),
        f"{100 * coverage:.1f} %",
        f"{ratio:.2f}",
        f"{100 * bias:+.2f} ± {100 * math.hypot(scatter, result.error):.2f} %",
        f"{1e3 * result.column('length').mean():.3g} mm",
        f"{result.column('seconds').mean():.2g} s",
        f"{100 * told:.0f} %",
        "ok" if passed else "outside",
    )
    return Line(cells, bool(passed))


def of_pieces(rows) -> Line:
    """Coverage of the whole map's friction by the intervals of its pieces."""
    covered = np.array([r["low"] <= r["whole"] <= r["high"] for r in rows])
    n, coverage = len(rows), float(covered.mean())
    slack = CHANCE * math.sqrt(0.05 * 0.95 / n)
    passed = PIECES[0] - slack <= coverage <= PIECES[1] + slack
    length = 1e3 * np.mean([r["length"] for r in rows])
    cells = ("pieces of a map", str(n), f"{100 * coverage:.1f} %", "", "", f"{length:.3g} mm", "", "")
    return Line((*cells, "ok" if passed else "outside"), bool(passed))


def of_quantities(counted) -> Line:
    """Every reported number within its stated error in 95 % of the scenes that state one."""
    worst = min(counted, key=lambda row: row[2])
    scenes = max(row[1] for row in counted)
    passed = all(held >= WITHIN - CHANCE * math.sqrt(0.05 * 0.95 / told) for _, told, held, _ in counted)
    cells = ("other numbers, random scenes", str(scenes), f"{100 * worst[2]:.1f} % ({worst[0]})", "", "", "", "", "")
    return Line((*cells, "ok" if passed else "outside"), passed)


def table(lines) -> str:
    """In Markdown."""
    rows = [HEAD, ("---",) * len(HEAD), *(line.cells for line in lines)]
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)
