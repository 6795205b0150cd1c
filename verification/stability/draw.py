"""Draws and counts the maps."""

from __future__ import annotations

from collections import Counter

import numpy as np

from .. import plotting
from ..check import Check, Figure, Table
from .cell import FAILED, RIGHT, VERDICTS, WRONG
from .cell import verdict as verdict_of

COLOURS = {RIGHT: "#009E73", FAILED: "#E69F00", WRONG: "#D50000"}
MARKS = {RIGHT: "s", FAILED: "X", WRONG: "D"}
AXES = {
    "film: load and material": ("load number M", "material number L"),
    "film: speed and load": ("entrainment speed, m/s", "load, N/m"),
    "film: tolerance": ("case", "tolerance asked for"),
    "film: poor start": ("start from case", "case"),
    "film: starved inlet": ("load number M", "oil ahead, inlet lengths"),
    "contact: load and surface": ("mean pressure / flattening pressure", "surface"),
    "contact: hardness": ("hardness / E'", "mean pressure / hardness"),
    "contact: size and aspect ratio": ("cell length / width", "grid"),
    "contact: mean gap": ("mean gap / gap at first touch", "surface"),
    "contact: roughness height": ("rms height, m", "mean pressure, Pa"),
    "contact: tilt and offset": ("tilt, rms heights", "offset, m"),
    "contact: precision, tolerance, start": ("tolerance", "input"),
    "sharing: flat": ("film / roughness", "rms height, m"),
    "sharing: paper": ("film / roughness", "rms height, m"),
    "sharing: speed, either sign": ("entrainment speed, m/s", "scene"),
    "sharing: share of the contact": ("$F_C/F_T$", ""),
}
COUNTED = ("case", "start from case", "surface", "grid", "input", "scene", "")  # labels of axes that number things
LINEAR = {
    "film: load and material": "y",
    "film: tolerance": "x",
    "film: poor start": "xy",
    "contact: load and surface": "y",
    "contact: size and aspect ratio": "y",
    "contact: mean gap": "y",
    "contact: tilt and offset": "xy",
    "contact: precision, tolerance, start": "y",
    "sharing: speed, either sign": "xy",
    "sharing: share of the contact": "y",
}


def counts(cells: list[Check]) -> dict[tuple[str, str, bool], Counter]:
    """Verdicts by (map, method, default)."""
    table: dict[tuple[str, str, bool], Counter] = {}
    for cell in cells:
        table.setdefault((cell.word("map"), cell.word("method"), bool(cell.at["default"])), Counter())[
            verdict_of(cell)
        ] += 1
    return table


def table(kind: str, cells: list[Check]) -> Table:
    """Verdicts by map and method. A star marks the methods that users get unasked."""
    rows = [
        (name, method + (" *" if default else ""), *(found[v] for v in VERDICTS))
        for (name, method, default), found in counts(cells).items()
    ]
    promised = sum(verdict_of(c) == FAILED and bool(c.at["inside"]) for c in cells if c.at["default"])
    caption = (
        f"Cells of the {kind} maps by verdict. Reported failures of default methods (*) inside the range promised: "
    )
    return Table(kind, f"{caption}{promised}", ("map", "method", *VERDICTS), tuple(rows))


def draw(kind: str, cells: list[Check]) -> Figure:
    """One panel for each map and method. Cells that share a place show the worst verdict."""
    panels = list(dict.fromkeys((c.word("map"), c.word("method")) for c in cells))
    columns = min(3, len(panels))
    rows = -(-len(panels) // columns)
    canvas, axes = plotting.axes(rows, columns, width=11, height=2.9 * rows + 0.4, squeeze=False)
    for ax in axes.ravel()[len(panels) :]:
        ax.set_axis_off()
    for ax, (name, method) in zip(axes.ravel(), panels):
        panel(ax, [c for c in cells if (c.word("map"), c.word("method")) == (name, method)])
    handles = [axes[0, 0].plot([], [], MARKS[v], color=COLOURS[v], label=v)[0] for v in VERDICTS]
    canvas.legend(handles=handles, loc="outside lower center", ncols=3, frameon=False)
    return plotting.compact(plotting.finish(kind, canvas, f"Stability of the {kind} solvers", format="png"))


def panel(ax, cells: list[Check]) -> None:
    """All cells of one map and method."""
    from matplotlib.ticker import MaxNLocator

    name, method = cells[0].word("map"), cells[0].word("method")
    linear = LINEAR.get(name, "")
    found = Counter(verdict_of(c) for c in cells)
    for verdict in VERDICTS:
        places = np.array([(c.number("x"), c.number("y")) for c in cells if verdict_of(c) == verdict]).reshape(-1, 2)
        ax.plot(
            places[:, 0],
            places[:, 1],
            MARKS[verdict],
            color=COLOURS[verdict],
            markersize=4,
            zorder=1 + VERDICTS.index(verdict),
        )
    for axis, values in (("x", [c.number("x") for c in cells]), ("y", [c.number("y") for c in cells])):
        if axis not in linear and min(values) > 0:
            getattr(ax, f"set_{axis}scale")("log")
        elif axis not in linear or name.startswith("sharing: speed") and axis == "x":
            getattr(ax, f"set_{axis}scale")("symlog", linthresh=1e-10 if name.startswith("sharing") else 1e-12)
    if name.startswith("sharing: speed"):
        ax.set_xticks([-1, -1e-4, -1e-8, 1e-8, 1e-4, 1])
    labels = ("load, N/m", "entrainment speed, m/s") if name.startswith("whole") else AXES.get(name, ("", ""))
    ax.set(xlabel=labels[0], ylabel=labels[1])
    for axis, label in ((ax.xaxis, labels[0]), (ax.yaxis, labels[1])):
        if label in COUNTED:
            axis.set_major_locator(MaxNLocator(integer=True, min_n_ticks=1))
        if not label:
            axis.set_ticks([])
    ax.set_title(f"{name}\n{method}: {found[RIGHT]} right, {found[FAILED]} failed, {found[WRONG]} wrong", fontsize=9)
