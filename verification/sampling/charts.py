"""Charts of the study."""

from __future__ import annotations

import numpy as np

from ..check import Figure
from ..plotting import axes, finish
from .lengths import Found
from .measure import Result


def coverage(results: list[Result]) -> Figure:
    """Every interval of every case over the truth. Those that miss it are orange."""
    canvas, grid = axes(-(-len(results) // 2), 2, 11, 2.6 * -(-len(results) // 2), squeeze=False)
    for axis, result in zip(grid.flat, results):
        order = np.argsort(result.column("f"))
        f, low, high = (result.column(name)[order] / result.truth - 1 for name in ("f", "low", "high"))
        for hit, colour in ((True, "#0072B2"), (False, "#D55E00")):
            k = np.flatnonzero(result.covered[order] == hit)
            axis.vlines(k, 100 * low[k], 100 * high[k], color=colour, lw=0.9)
        axis.plot(np.arange(f.size), 100 * f, ".", color="black", ms=2)
        axis.axhline(0, color="black", lw=0.8)
        axis.set_title(f"{result.case.name}: {100 * result.covered.mean():.1f} % of {f.size} cover")
        axis.set_ylabel("f/f∞ − 1 (%)")
        axis.set_xticks([])
    for axis in grid[-1]:
        axis.set_xlabel("trials, by f")
    for axis in grid.flat[len(results) :]:
        axis.set_axis_off()
    return finish("coverage", canvas, "Every interval over the truth; those that miss it are orange", "png")


def bias(found: Found) -> Figure:
    """Mean and scatter of f of one patch over its length."""
    canvas, axis = axes(1, 1, 6.4, 4)
    for speed, (rows, truth) in found.items():
        length, mean, scatter, count = rows.T
        shown = axis.errorbar(
            1e3 * length,
            100 * (mean / truth - 1),
            100 * scatter / truth / np.sqrt(count),
            marker="o",
            capsize=3,
            label=f"bias, {speed:g} m/s",
        )
        axis.plot(
            1e3 * length, 100 * scatter / truth, "--", color=shown[0].get_color(), label=f"scatter, {speed:g} m/s"
        )
    axis.axhline(0, color="black", lw=0.8)
    axis.set(xscale="log", xlabel="length of the patch along y (mm)", ylabel="bias and scatter of f (% of f∞)")
    axis.legend(frameon=False)
    return finish("bias", canvas, "Bias and scatter of f of one patch against its length", "png")


def cost(found: dict[str, np.ndarray]) -> Figure:
    """Time against the error of f that was made by having a finite surface."""
    canvas, axis = axes(1, 1, 6.4, 4)
    for name, rows in found.items():
        asked, seconds, error = rows.T
        axis.loglog(100 * error, seconds, "o-", label=name)
        for e in np.unique(error):  # where the first line does for several of what was asked, one label for all
            words = " and ".join(f"{100 * a:g} %" for a in asked[error == e])
            at = 100 * e, seconds[error == e].max()
            axis.annotate(words, at, xytext=(4, 4), textcoords="offset points", fontsize=8)
    axis.set(xlabel="root mean square error of f, surface included (%); labels: asked", ylabel="processor time (s)")
    axis.legend(frameon=False)
    return finish("cost", canvas, "Processor time against the error of f", "png")
