"""Coverage and width of the calibrated bounds on kinds of cases that the fit excluded, one kind at a time."""

from collections.abc import Iterator

import numpy as np

from ... import plotting
from ...check import AT_LEAST, REPORTED, Check, Figure, Item, Table
from ...kept import Run
from .fit import Solved, cases, design, held_out, quantile_of

LEAST = 0.92  # share of cases within the bounds, of all kinds together


def coverage(level: str, motion: str, run: Run = Run()) -> Iterator[Item]:
    """Compare bounds of ln(f deterministic/f), fitted without a kind of case, with the errors of that kind."""
    solved = cases(motion)
    known = design(solved)
    parts = held_out(solved, known)
    quantile = quantile_of(parts)
    inside = np.concatenate([np.abs(part.standard) <= quantile for part in parts])
    widths = np.concatenate([np.sinh(quantile * part.sigma) for part in parts])
    name = f"{len(solved)} cases, {motion}"
    yield Check(f"{name}: within the bounds", float(inside.mean()), LEAST, 0.0, "excluded kinds", AT_LEAST)
    yield Check(f"{name}: median half-width", float(np.median(widths)), 0.15, 0.0, "the target", REPORTED)
    fit = known.fit()
    errors = known.errors - known.of_bias @ fit.bias
    plain = np.array([np.log(float(case.row["det_f"]) / case.numbers["ls_f"]) for case in solved])
    yield Check(f"{name}: rms error of ln f", float(np.sqrt(np.mean(errors**2))), 0.0, 0.0, "deterministic", REPORTED)
    yield Check(f"{name}: the same by Eq. (9)", float(np.sqrt(np.mean(plain**2))), 0.0, 0.0, "deterministic", REPORTED)
    rows = [
        (
            part.kind,
            str(part.sigma.size),
            f"{np.mean(np.abs(part.standard) <= quantile):.2f}",
            f"{100 * np.median(np.sinh(quantile * part.sigma)):.0f} %",
        )
        for part in parts
    ]
    columns = ("excluded kind", "cases", "within the bounds", "half-width, median")
    yield Table(f"calibration-{motion}", f"Calibrated load sharing, {motion}: kinds excluded in turn", columns, rows)
    yield drawn(motion, solved, plain, errors)


def drawn(motion: str, solved: list[Solved], plain: np.ndarray, errors: np.ndarray) -> Figure:
    """Return the errors of both kinds of load sharing over the lambda ratio."""
    canvas, grid = plotting.axes(1, 2, 8.5, 3.6, sharey=True)
    ratios = [float(case.row["ratio"]) for case in solved]
    for ax, values, title in zip(grid, (plain, errors), ("load sharing, Eq. (9)", "calibrated load sharing")):
        ax.plot(ratios, values, "o", ms=3, alpha=0.6)
        ax.axhline(0.0, color="0.5", lw=0.8)
        ax.set(xscale="log", xlabel="lambda ratio", title=title, ylim=(-1.5, 1.5))
    grid[0].set_ylabel("ln(f deterministic/f)")
    return plotting.finish(f"calibration-{motion}", canvas, f"Error of f on random contacts, {motion}")
