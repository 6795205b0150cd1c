"""Draws charts from the points alone."""

import numpy as np
from matplotlib.axes import Axes

from ... import plotting
from ...check import Check, Figure, Table

LEAST = 1e-12  # of the reference: errors below are drawn there
ORDER = ("lubfric", "default", "default, cold", "default, warm")
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#8C564B", "#7F7F7F", "#882255")
OF_FRICTION = ("models", "rolling")  # charts whose error is that of f
EQUAL = 1e-5  # error of the pressure at which methods are compared


def work_precision(name: str, points: list[Check], machine: str) -> Figure:
    """Draw error over time, one panel for each case. A ring marks the default, and bars extend from quartile to
    quartile.

    A solver with an error of 100 % has failed; its points are not drawn.
    """
    points = [p for p in points if p.at.get("apart") or p.measured < 1]
    names = list(dict.fromkeys(p.at["panel"] for p in points))
    columns = min(3, len(names))
    canvas, axes = plotting.panels(len(names), 3, width=3.9 * columns + 0.4, height=3.1)
    colours = palette(points)
    for ax, label in zip(axes, names):
        chosen = [p for p in points if p.at["panel"] == label]
        for method in dict.fromkeys(p.at["method"] for p in chosen):
            curve(ax, [p for p in chosen if p.at["method"] == method], colours[method])
        apart = any(p.at.get("apart") for p in chosen)
        ylabel = "error" if apart else "solver error"
        if name in OF_FRICTION:
            ylabel = "error of f"
        ax.set(xscale="log", yscale="log", xlabel="CPU seconds", ylabel=ylabel)
        ax.set_title(label, fontsize=9)
    handles = [axes[0].plot([], [], "o-", color=c, label=m)[0] for m, c in colours.items()]
    handles.append(axes[0].plot([], [], "o", mfc="none", mec="k", ms=10, ls="", label="default setting")[0])
    canvas.legend(handles=handles, loc="outside lower center", ncols=3 if columns > 1 else 2, frameon=False, fontsize=8)
    canvas.suptitle(machine.replace("; python", "\npython"), fontsize=6.5)
    return plotting.compact(plotting.finish(name, canvas, "Error against time", format="png"))


def palette(points: list[Check]) -> dict[str, str]:
    """Return a colour for each method, our default first."""
    results = dict.fromkeys(p.at["method"] for p in points)
    methods = [m for m in ORDER if m in results] + [m for m in results if m not in ORDER]
    return {m: COLOURS[i % len(COLOURS)] for i, m in enumerate(methods)}


def curve(ax: Axes, points: list[Check], colour: str) -> None:
    """One method, in the order in which its settings were given."""
    errors = [p.measured for p in points]
    times = np.array([p.at["seconds"] for p in points])
    spread = np.abs([times - [p.at["low"] for p in points], [p.at["high"] for p in points] - times])
    ax.errorbar(times, np.maximum(errors, LEAST), xerr=spread, fmt="o-", color=colour, ms=4, lw=1.3, elinewidth=0.8)
    for p, e in zip(points, errors):
        if p.at.get("default"):
            ax.plot(p.at["seconds"], max(e, LEAST), "o", mfc="none", mec="k", ms=10)


def methods_table(points: list[Check]) -> Table:
    """Return contacts solved to a measured error of `EQUAL`: time of every method over that of the library."""
    good = [p for p in points if not p.at.get("apart") and p.measured <= EQUAL]
    names = [name for name in dict.fromkeys(p.at["method"] for p in good) if name != "lubfric"]
    rows = []
    for panel in dict.fromkeys(p.at["panel"] for p in good):
        shortest: dict[str, float] = {}
        for p in (p for p in good if p.at["panel"] == panel):
            shortest[p.at["method"]] = min(p.at["seconds"], shortest.get(p.at["method"], np.inf))
        ours = shortest["lubfric"]
        rows.append(
            [panel, f"{1e3 * ours:.0f} ms", *(f"{shortest[n] / ours:.1f}" if n in shortest else "" for n in names)]
        )
    return Table("contact-methods", f"Time to an error of {EQUAL:g}", ["contact", "lubfric", *names], rows)
