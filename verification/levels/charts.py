"""Charts of the study: error against saving, one dot a scene; f through the switches."""

from __future__ import annotations

from .. import plotting
from ..check import Check, Figure
from .measure import TOLERANCES

COLOURS = ("#1f5a94", "#2f7d4f", "#b3392f", "#8a5a9e", "#c98a1b", "#6b6b6b", "#3a9ea5", "#a0522d")
LEAST = 1e-8  # errors below it are drawn there


def error_against_saving(found: list[Check]) -> Figure:
    """One panel for each tolerance: |f - f_full|/f_full over what was saved, the time of the full solve in that of the
    scene."""
    figure, axes = plotting.axes(1, len(TOLERANCES), 12, 4.8, squeeze=False)
    for axis, tolerance in zip(axes[0], TOLERANCES):
        good = [c for c in found if c.number("asked") == tolerance and not c.refused]
        kinds = sorted({(c.word("film"), c.word("contact")) for c in good})
        for kind, colour in zip(kinds, COLOURS):
            mine = [c for c in good if (c.word("film"), c.word("contact")) == kind]
            dots = [(c.number("seconds_reference") / c.duration, max(c.deviation, LEAST)) for c in mine]
            label = f"film {kind[0]}, contact {kind[1]}"
            axis.loglog(*zip(*dots), "o", ms=4, alpha=0.7, color=colour, mew=0, label=label)
        axis.axhline(tolerance, color="black", lw=1)
        axis.axvline(1, color="black", lw=0.5, ls=":")
        axis.set(
            title=f"tolerance {100 * tolerance:g} %", xlabel="time of the reference / time (-)", ylim=(0.5 * LEAST, 0.2)
        )
    axes[0, 0].set_ylabel("|f − f_full| / f_full (-)")
    handles = {label: dot for axis in axes[0] for dot, label in zip(*axis.get_legend_handles_labels())}
    figure.legend(handles.values(), handles, frameon=False, fontsize=8, loc="outside lower center", ncols=3)
    return plotting.finish("saving", figure, "Error of f against the time saved, one dot a scene", format="png")


def continuity(found: list[Check]) -> Figure:
    """f over speed with each level in its colour. Below is the deviation from the full model, with the tolerance in
    grey."""
    scenes = list(dict.fromkeys(c.word("scene") for c in found))
    levels = sorted({c.word("level") for c in found})
    figure, axes = plotting.axes(2, len(scenes), 13, 6, squeeze=False)
    for column, name in enumerate(scenes):
        line = [c for c in found if c.word("scene") == name]
        for level, colour in zip(levels, COLOURS + ("#000000", "#d4779b", "#7fa650", "#4d4dff")):
            mine = [c for c in line if c.word("level") == level]
            if mine:
                speed = [c.number("speed") for c in mine]
                off = [100 * (c.measured / c.expected - 1) for c in mine]
                axes[0, column].semilogx(speed, [c.measured for c in mine], ".", color=colour, label=level)
                axes[1, column].semilogx(speed, off, ".", color=colour)
        speeds, full = [c.number("speed") for c in line], [c.expected for c in line]
        axes[0, column].semilogx(speeds, full, "-", color="black", lw=0.6)
        axes[1, column].set(xlabel="entrainment speed U (m/s)", ylim=(-1.3, 1.3))
        axes[1, column].axhline(0, color="black", lw=0.6)
        axes[1, column].axhspan(-1, 1, color="#dddddd", lw=0, zorder=0)
        axes[0, column].set_title(name)
        axes[0, column].legend(frameon=False, fontsize=6)
    axes[0, 0].set_ylabel("f (-); line: full model")
    axes[1, 0].set_ylabel("deviation from full model (%)")
    return plotting.finish("switches", figure, "f through the switches between levels and grids", format="png")
