"""Draws charts from the points alone."""

from __future__ import annotations

import numpy as np

from .. import plotting
from ..check import Check, Figure
from .growth import exponent

LEAST = 1e-12  # of the reference: errors below are drawn there
NOTICED = 2e5  # bytes: less is lost in what the process already had
ORDER = ("lubfric", "default", "default (load-controlled)", "default, cold", "default, warm")


def work_precision(name: str, points: list[Check], machine: str) -> Figure:
    """Error against time, a panel each. The default is ringed, and bars reach from quartile to quartile.

    Where a solver is off by its whole answer it has failed: such points are left out.
    """
    points = [p for p in points if p.at.get("apart") or p.measured < 1]
    panels = list(dict.fromkeys(p.word("panel") for p in points))
    columns = min(3, len(panels))
    rows = -(-len(panels) // columns)
    canvas, axes = plotting.axes(rows, columns, width=3.9 * columns + 0.4, height=3.1 * rows + 0.9, squeeze=False)
    colours = palette(points)
    for ax in axes.ravel()[len(panels) :]:
        ax.set_axis_off()
    for ax, label in zip(axes.ravel(), panels):
        chosen = [p for p in points if p.word("panel") == label]
        for method in dict.fromkeys(p.word("method") for p in chosen):
            curve(ax, [p for p in chosen if p.word("method") == method], colours[method])
        apart = any(p.at.get("apart") for p in chosen)
        ax.set(
            xscale="log",
            yscale="log",
            xlabel="CPU seconds",
            title=label,
            ylabel="discretisation error" if apart else "solver error",
        )
        readable(ax)
        ax.title.set_fontsize(9)
    handles = [axes[0, 0].plot([], [], "o-", color=c, label=m)[0] for m, c in colours.items()]
    handles.append(axes[0, 0].plot([], [], "o", mfc="none", mec="k", ms=10, ls="", label="default setting")[0])
    canvas.legend(handles=handles, loc="outside lower center", ncols=3 if columns > 1 else 2, frameon=False, fontsize=8)
    canvas.suptitle(machine.replace("; python", "\npython"), fontsize=6.5)
    return plotting.compact(plotting.finish(name, canvas, "Error against time", format="png"))


def readable(ax) -> None:
    """Label the time axis at 1, 2 and 5 where it shows less than two powers of ten, in at least two places."""
    from matplotlib.ticker import FixedLocator, FuncFormatter

    low, high = ax.get_xlim()
    if high < 30 * low:
        ticks: list[float] = []
        while len(ticks) < 2:
            low, high = low / 1.3, high * 1.3
            ticks = [m * 10.0**k for k in range(-9, 6) for m in (1, 2, 5) if low <= m * 10.0**k <= high]
        ax.set_xlim(low, high)
        ax.xaxis.set_major_locator(FixedLocator(ticks))
        ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.xaxis.set_minor_formatter("")


def palette(points: list[Check]) -> dict[str, str]:
    """A colour for each method, our default first."""
    methods = sorted(
        dict.fromkeys(p.word("method") for p in points),
        key=lambda m: (m not in ORDER, ORDER.index(m) if m in ORDER else 0),
    )
    colours = [
        "#0072B2",
        "#D55E00",
        "#009E73",
        "#CC79A7",
        "#E69F00",
        "#56B4E9",
        "#000000",
        "#8C564B",
        "#7F7F7F",
        "#882255",
    ]
    return {m: colours[i % len(colours)] for i, m in enumerate(methods)}


def curve(ax, points: list[Check], colour: str) -> None:
    """One method, in the order in which its settings were given."""
    errors = [p.measured for p in points]
    times = np.array([p.duration for p in points])
    spread = np.abs([times - [p.number("low") for p in points], [p.number("high") for p in points] - times])
    ax.errorbar(times, np.maximum(errors, LEAST), xerr=spread, fmt="o-", color=colour, ms=4, lw=1.3, elinewidth=0.8)
    for p, e in zip(points, errors):
        if p.at.get("default"):
            ax.plot(p.duration, max(e, LEAST), "o", mfc="none", mec="k", ms=10)


def growth(points: list[Check], machine: str) -> Figure:
    """Time and peak memory over size, with the exponents of the larger half."""
    panels = list(dict.fromkeys(p.word("panel") for p in points))
    canvas, axes = plotting.axes(2, len(panels), width=3.3 * len(panels), height=6, squeeze=False)
    for column, label in enumerate(panels):
        chosen = [p for p in points if p.word("panel") == label]
        sizes = [p.number("size") for p in chosen]
        unit = "points" if "sweep" in label else "cells" if label == "contact" else "nodes"
        axes[0, column].loglog(sizes, [p.duration for p in chosen], "o-")
        axes[0, column].set(
            title=f"{label}\ntime ~ N^{exponent(chosen, 'seconds'):.2f}", ylabel="CPU seconds", xlabel=unit
        )
        if label == "contact":
            axes[0, column].set_title(
                f"contact: time ~ N^{exponent(chosen, 'seconds'):.2f}\nconvolutions ~ N^{exponent(chosen, 'work'):.2f}"
            )
        seen = [p for p in chosen if p.number("memory") > NOTICED]
        axes[1, column].loglog(
            [p.number("size") for p in seen], [p.number("memory") / 1e6 for p in seen], "o-", color="#D55E00"
        )
        axes[1, column].set(title=f"memory ~ N^{exponent(seen, 'memory'):.2f}", ylabel="peak memory, MB", xlabel=unit)
        axes[1, column].set_xlim(axes[0, column].get_xlim())
        axes[1, column].xaxis.set_minor_formatter("")
    canvas.suptitle(machine.replace("; python", "\npython"), fontsize=6.5)
    return plotting.compact(plotting.finish("growth", canvas, "Time and peak memory against size", format="png"))
