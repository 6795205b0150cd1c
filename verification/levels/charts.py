"""Charts of the study: error against saving, one dot a scene; f through the switches."""

from __future__ import annotations

from pathlib import Path

from .measure import TOLERANCES

COLOURS = ("#1f5a94", "#2f7d4f", "#b3392f", "#8a5a9e", "#c98a1b", "#6b6b6b", "#3a9ea5", "#a0522d")
LEAST = 1e-8  # errors below it are drawn there


def _axes(rows: int, columns: int, size):
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=size, layout="constrained")
    FigureCanvasAgg(figure)
    return figure, figure.subplots(rows, columns, squeeze=False)


def error_against_saving(rows: list[dict], path: Path) -> None:
    """One panel a tolerance: |f - f_full|/f_full over the time of the full solve in that of the scene."""
    figure, axes = _axes(1, len(TOLERANCES), (12, 4.8))
    for axis, tolerance in zip(axes[0], TOLERANCES):
        good = [r for r in rows if "f" in r[f"{tolerance:g}"] and "f" in r["reference"]]
        kinds = sorted({(r[f"{tolerance:g}"]["film"], r[f"{tolerance:g}"]["contact"]) for r in good})
        for kind, colour in zip(kinds, COLOURS):
            mine = [
                (
                    r["reference"]["seconds"] / r[f"{tolerance:g}"]["seconds"],
                    max(abs(r[f"{tolerance:g}"]["f"] / r["reference"]["f"] - 1), LEAST),
                )
                for r in good
                if (r[f"{tolerance:g}"]["film"], r[f"{tolerance:g}"]["contact"]) == kind
            ]
            axis.loglog(
                *zip(*mine), "o", ms=4, alpha=0.7, color=colour, mew=0, label=f"film {kind[0]}, contact {kind[1]}"
            )
        axis.axhline(tolerance, color="black", lw=1)
        axis.axvline(1, color="black", lw=0.5, ls=":")
        axis.set(
            title=f"tolerance {100 * tolerance:g} %", xlabel="time of the reference / time (-)", ylim=(0.5 * LEAST, 0.2)
        )
    axes[0, 0].set_ylabel("|f − f_full| / f_full (-)")
    handles = {label: dot for axis in axes[0] for dot, label in zip(*axis.get_legend_handles_labels())}
    figure.legend(handles.values(), handles, frameon=False, fontsize=8, loc="outside lower center", ncols=3)
    figure.savefig(path, dpi=130)


def continuity(rows: list[dict], path: Path) -> None:
    """f over speed with each level in its colour, and below the deviation from the full model, the tolerance in grey."""
    scenes = list(dict.fromkeys(r["scene"] for r in rows))
    levels = sorted({r["level"] for r in rows})
    figure, axes = _axes(2, len(scenes), (13, 6))
    for column, name in enumerate(scenes):
        for level, colour in zip(levels, COLOURS + ("#000000", "#d4779b", "#7fa650", "#4d4dff")):
            mine = [r for r in rows if r["scene"] == name and r["level"] == level]
            if mine:
                speed = [r["speed"] for r in mine]
                axes[0, column].semilogx(speed, [r["f"] for r in mine], ".", color=colour, label=level)
                axes[1, column].semilogx(speed, [100 * (r["f"] / r["full"] - 1) for r in mine], ".", color=colour)
        line = [r for r in rows if r["scene"] == name]
        axes[0, column].semilogx([r["speed"] for r in line], [r["full"] for r in line], "-", color="black", lw=0.6)
        axes[1, column].set(xlabel="entrainment speed U (m/s)", ylim=(-1.3, 1.3))
        axes[1, column].axhline(0, color="black", lw=0.6)
        axes[1, column].axhspan(-1, 1, color="#dddddd", lw=0, zorder=0)
        axes[0, column].set_title(name)
        axes[0, column].legend(frameon=False, fontsize=6)
    axes[0, 0].set_ylabel("f (-); line: full model")
    axes[1, 0].set_ylabel("deviation from full model (%)")
    figure.savefig(path, dpi=130)
