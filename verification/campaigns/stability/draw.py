"""Draws and counts the maps."""

from collections import Counter

import numpy as np
from matplotlib.axes import Axes

from ... import plotting
from ...check import Check, Figure, Table
from .cell import FAILED, RIGHT, VERDICTS, WRONG
from .cell import verdict as verdict_of
from .contact_map import SURFACES

COLOURS = {RIGHT: "#009E73", FAILED: "#E69F00", WRONG: "#D50000"}
MARKS = {RIGHT: "s", FAILED: "X", WRONG: "D"}
AXES = {  # of a map: labels of x and y, and those of both that are linear
    "film: load and material": ("load number M", "material number L", "y"),
    "film: speed and load": ("entrainment speed, m/s", "load, N/m", ""),
    "film: tolerance": ("case", "requested tolerance", "x"),
    "film: poor start": ("start from case", "case", "xy"),
    "film: starved inlet": ("load number M", "oil ahead, inlet lengths", ""),
    "contact: load and surface": ("mean pressure / flattening pressure", "surface", "y"),
    "contact: hardness": ("hardness / E'", "mean pressure / hardness", ""),
    "contact: size and aspect ratio": ("cell length / width", "grid", "y"),
    "contact: mean gap": ("mean gap / gap at first touch", "surface", "y"),
    "contact: roughness height": ("rms height, m", "mean pressure, Pa", ""),
    "contact: tilt and offset": ("tilt, rms heights", "offset, m", "xy"),
    "contact: precision, tolerance, start": ("tolerance", "input", "y"),
    "sharing: flat": ("lambda ratio, film/Sq (-)", "Sq, m", ""),
    "sharing: paper": ("lambda ratio, film/Sq (-)", "Sq, m", ""),
    "sharing: speed, either sign": ("entrainment speed, m/s", "scene", "y"),
    "sharing: share of the contact": ("asperity load ratio, $F_C/F_T$ (-)", "", "y"),
}
WHOLE = ("load, N/m", "entrainment speed, m/s", "")
COUNTED = ("case", "start from case", "grid", "")  # labels of axes that number things
# labels of axes that name things, in the order of their numbers
NAMED = {
    "surface": SURFACES,
    "scene": ("flat", "paper"),
    "input": ("double precision", "single precision", "absurd start", "even start"),
}


def counts(cells: list[Check]) -> dict[tuple[str, str, bool], Counter[str]]:
    """Return verdicts by (map, method, default)."""
    results: dict[tuple[str, str, bool], Counter[str]] = {}
    for cell in cells:
        key = (cell.at["map"], cell.at["method"], bool(cell.at["default"]))
        results.setdefault(key, Counter())[verdict_of(cell)] += 1
    return results


def table(kind: str, cells: list[Check]) -> Table:
    """Return verdicts of the methods that users get unasked: of every map in which not all is right, and of all
    together."""
    rows = [
        (name, sum(result.values()), *(result[v] for v in VERDICTS))
        for (name, _, default), result in counts(cells).items()
        if default and result[RIGHT] < sum(result.values())
    ]
    chosen = [verdict_of(c) for c in cells if c.at["default"]]
    maps = len({c.at["map"] for c in cells})
    rows.append((f"all {maps} maps", len(chosen), *(chosen.count(v) for v in VERDICTS)))
    inside = sum(verdict_of(c) == FAILED and bool(c.at["inside"]) for c in cells if c.at["default"])
    caption = f"Cells by verdict. Reported failures inside the range promised: {inside}"
    return Table(f"stability-{kind}", caption, ("map (default methods)", "cells", *VERDICTS), rows)


def draw(kind: str, cells: list[Check]) -> Figure:
    """Return one panel for each map and method. Cells that share a place show the worst verdict."""
    panels = list(dict.fromkeys((c.at["map"], c.at["method"]) for c in cells))
    canvas, axes = plotting.panels(len(panels), 3, width=11, height=2.9)
    for ax, place in zip(axes, panels):
        panel(ax, [c for c in cells if (c.at["map"], c.at["method"]) == place])
    handles = [axes[0].plot([], [], MARKS[v], color=COLOURS[v], label=v)[0] for v in VERDICTS]
    canvas.legend(handles=handles, loc="outside lower center", ncols=3, frameon=False)
    return plotting.compact(plotting.finish(kind, canvas, f"Stability of the {kind} solvers", format="png"))


def panel(ax: Axes, cells: list[Check]) -> None:
    """All cells of one map and method."""
    from matplotlib.ticker import MaxNLocator

    name = cells[0].at["map"]
    method = cells[0].at["method"]
    *labels, linear = AXES.get(name, WHOLE)
    count = Counter(verdict_of(c) for c in cells)
    for order, verdict in enumerate(VERDICTS):
        places = np.array([(c.at["x"], c.at["y"]) for c in cells if verdict_of(c) == verdict]).reshape(-1, 2)
        ax.plot(*places.T, MARKS[verdict], color=COLOURS[verdict], markersize=4, zorder=1 + order)
    for axis, label in zip("xy", labels):
        if axis not in linear:
            scale = "log" if min(c.at[axis] for c in cells) > 0 else "symlog"
            ax.set(**{f"{axis}scale": scale})
        ax.set(**{f"{axis}label": label})
        drawn_axis = ax.xaxis if axis == "x" else ax.yaxis
        if label in COUNTED:
            drawn_axis.set_major_locator(MaxNLocator(integer=True, min_n_ticks=1))
        if label in NAMED:
            drawn_axis.set_ticks(range(len(NAMED[label])), NAMED[label], fontsize=7)
        if not label:
            drawn_axis.set_ticks([])
    if name.startswith("sharing: speed"):
        ax.set_xscale("symlog", linthresh=1e-10)
        ax.set_xticks([-1, -1e-4, -1e-8, 1e-8, 1e-4, 1])
    ax.set_title(f"{name}\n{method}: {count[RIGHT]} right, {count[FAILED]} failed, {count[WRONG]} wrong", fontsize=9)
