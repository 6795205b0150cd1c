"""Coverage and width of the calibrated bounds on kinds of cases that were left out of the fit, each in turn."""

from collections.abc import Iterator

import numpy as np

from ... import plotting
from ...check import AT_LEAST, REPORTED, Check, Figure, Item, Table
from ...kept import Run
from .fit import MOTIONS, Design, HeldOut, Solved, cases, design, held_out, quantile_of

LEAST = 0.92  # share of cases within the bounds, of all kinds together
TARGETS = {"rest": 0.15, "rolling": 0.18}  # median half-widths, the target
WORDS = {"rest": "at rest", "rolling": "rolling"}


def coverage(level: str, motion: str, run: Run = Run()) -> Iterator[Item]:
    """Yield bounds of ln f, without its rolling part, fitted without a kind of case, beside the errors of that kind."""
    solved = cases(motion)
    known = design(solved)
    parts = held_out(solved, known)
    quantile = quantile_of(parts)
    inside = np.concatenate(_inside(parts, quantile))
    name = f"{len(solved)} cases, {motion}"
    yield Check(
        f"{name}: within the bounds",
        float(inside.mean()),
        expected=LEAST,
        tolerance=0.0,
        source="kinds left out",
        kind=AT_LEAST,
    )
    width = _width(parts, quantile)
    yield Check(
        f"{name}: median half-width", width, expected=TARGETS[motion], tolerance=0.0, source="the target", kind=REPORTED
    )
    errors = _without_bias(known)
    plain = _by_equation(solved)
    yield Check(
        f"{name}: rms error of ln f", _rms(errors), expected=0.0, tolerance=0.0, source="deterministic", kind=REPORTED
    )
    yield Check(
        f"{name}: the same by Eq. (9)", _rms(plain), expected=0.0, tolerance=0.0, source="deterministic", kind=REPORTED
    )
    rows = [
        (
            part.kind,
            str(part.sigma.size),
            f"{np.mean(np.abs(part.standard) <= quantile):.2f}",
            f"{100 * _width([part], quantile):.0f} %",
        )
        for part in parts
    ]
    columns = ("kind left out", "cases", "within the bounds", "half-width, median")
    yield Table(f"calibration-{motion}", f"The quick model, {motion}: kinds left out in turn", columns, rows)
    yield drawn(motion, solved, plain, errors)


def summary(level: str, run: Run = Run()) -> Iterator[Item]:
    """Yield one row for each motion: errors, bounds and coverage of kinds that were left out."""
    rows = []
    for motion in MOTIONS:
        solved = cases(motion)
        known = design(solved)
        parts = held_out(solved, known)
        quantile = quantile_of(parts)
        inside = [float(part.mean()) for part in _inside(parts, quantile)]
        share = float(np.concatenate(_inside(parts, quantile)).mean())
        yield Check(
            f"{motion}: within the bounds", share, expected=LEAST, tolerance=0.0, source="kinds left out", kind=AT_LEAST
        )
        rows.append(
            (
                WORDS[motion],
                str(len(solved)),
                f"{_rms(_by_equation(solved)):.2g}",
                f"{_rms(known.errors):.2f}",
                f"{np.median(np.abs(known.errors)):.2f}",
                f"{100 * _width(parts, quantile):.0f} %",
                f"{100 * share:.0f} % ({100 * min(inside):.0f} to {100 * max(inside):.0f} %)",
                _seconds(solved),
            )
        )
    columns = (
        *("roughness", "cases", "rms error, Eq. (9)", "rms error", "median error"),
        *("median half-width", "inside (by kind)", "CPU s, median (9 of 10)"),
    )
    yield Table("calibration", "The quick model: its error of ln f, and kinds left out", columns, rows)


def _seconds(solved: list[Solved]) -> str:
    """Return the processor time [s] of a strip on long cells, as text: the median, and that of nine strips in ten."""
    seconds = [case.numbers["seconds"] for case in solved]
    return f"{np.median(seconds):.1f} ({np.quantile(seconds, 0.9):.1f})"


def _inside(parts: list[HeldOut], quantile: float) -> list[np.ndarray]:
    return [np.abs(part.standard) <= quantile for part in parts]


def _width(parts: list[HeldOut], quantile: float) -> float:
    return float(np.median(np.concatenate([part.half_widths(quantile) for part in parts])))


def _without_bias(known: Design) -> np.ndarray:
    return known.errors - known.of_bias @ known.fit().bias


def _by_equation(solved: list[Solved]) -> np.ndarray:
    """Return ln(f deterministic/f by Eq. (9)), of cases in which that f is positive."""
    ratios = np.array([float(case.row["det_f"]) / float(case.row["ls_f"]) for case in solved])
    return np.log(np.where(ratios > 0, ratios, np.nan))


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.nanmean(values**2)))


def drawn(motion: str, solved: list[Solved], plain: np.ndarray, errors: np.ndarray) -> Figure:
    """Return the errors of load sharing and of the quick model over the lambda ratio."""
    canvas, grid = plotting.axes(1, 2, 8.5, 3.6, sharey=True)
    ratios = [float(case.row["ratio"]) for case in solved]
    for ax, values, title in zip(grid, (plain, errors), ("load sharing, Eq. (9)", "long cells, calibrated")):
        ax.plot(ratios, values, "o", ms=3, alpha=0.6)
        ax.axhline(0.0, color="0.5", lw=0.8)
        ax.set(xscale="log", xlabel="lambda ratio", title=title, ylim=(-1.5, 1.5))
    grid[0].set_ylabel("ln(f deterministic/f)")
    return plotting.finish(f"calibration-{motion}", canvas, f"Error of f on random contacts, {motion}")
