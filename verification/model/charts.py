"""Charts of the model's error: over the film ratio, against time, and both models' fields side by side."""

from __future__ import annotations

import numpy as np
from matplotlib.colors import LogNorm

from .. import plotting
from ..check import Figure
from .measure import METHODS, REFERENCE
from .summary import Deviation


def over_speed(name: str, found: list[Deviation], caption: str) -> Figure:
    """Mean and rms of the error of f over speed, a line for each method."""
    canvas, (left, right) = plotting.axes(1, 2, width=9.2, height=3.6)
    for method in METHODS:
        mine = sorted((d for d in found if d.method == method), key=lambda d: d.speed)
        if method == REFERENCE or not mine:
            continue
        speed = [d.speed for d in mine]
        left.semilogx(speed, [100 * d.mean for d in mine], "o-", label=method)
        right.loglog(speed, [100 * max(d.rms, 1e-4) for d in mine], "o-")
    left.axhline(0, color="0.4", lw=0.8)
    left.set(xlabel="entrainment speed (m/s)", ylabel="mean error of f (%)")
    right.set(xlabel="entrainment speed (m/s)", ylabel="rms over surfaces (%)")
    left.legend(fontsize=8)
    return plotting.finish(name, canvas, caption)


def against_time(found: list[Deviation]) -> Figure:
    """The error of the model against the processor time of a point."""
    canvas, axes = plotting.axes(width=6.4, height=4.0)
    for method in METHODS:
        mine = [d for d in found if d.method == method]
        if not mine:
            continue
        rms = [100 * max(d.rms, 1e-3) for d in mine]
        if method == REFERENCE:
            seconds = np.median([d.seconds for d in mine])
            axes.axvline(seconds, color="0.5", ls=":", label=f"{method}, {seconds:.2g} s")
        else:
            axes.loglog([d.seconds for d in mine], rms, "o", label=method)
    axes.set(xlabel="processor time of a point (s)", ylabel="rms error of f over surfaces (%)")
    axes.legend(fontsize=8, ncols=3, loc="lower center", bbox_to_anchor=(0.5, 1.0))  # above: nothing crosses it
    return plotting.finish("error-against-time", canvas, "Error of the model in f against time; a point a speed")


def fields(whole, shared, model, half_width: float) -> Figure:
    """Gap and pressure of one gap with one pressure above; gap and contact pressure of load sharing below."""
    canvas, axes = plotting.axes(2, 2, width=9.2, height=6.4)
    contact = shared.balance.contact.fields
    near = 3 * half_width
    gap = LogNorm(1.0, 1000.0)
    top = max(float(whole.pressure.max()), float(contact.pressure.max())) / 1e9
    rows = (
        ("one gap, one pressure", whole.x, whole.spacing[1], whole.gap, whole.pressure),
        ("load sharing", model.contact.x, model.surface.spacing[1], np.maximum(contact.gap, 1e-9), contact.pressure),
    )
    for (title, x, dy, h, p), line in zip(rows, axes, strict=True):
        part = np.flatnonzero(np.abs(x) <= near)
        extent = (x[part[0]] * 1e6, x[part[-1]] * 1e6, 0, p.shape[1] * dy * 1e6)
        shown = ((h * 1e9, "viridis", gap, None, "gap (nm)"), (p / 1e9, "magma_r", None, top, "pressure (GPa)"))
        for ax, (field, colours, norm, largest, label) in zip(line, shown, strict=True):
            limits = {} if norm else {"vmin": 0, "vmax": largest}
            image = ax.imshow(
                field[part].T, origin="lower", aspect="auto", extent=extent, cmap=colours, norm=norm, **limits
            )
            canvas.colorbar(image, ax=ax, label=label)
            ax.set(title=title, xlabel="x (µm)", ylabel="y (µm)")
            ax.grid(False)
    caption = f"Gap and pressure at {shared.speed:g} m/s; the pressure of load sharing is that of the contact alone"
    return plotting.finish("fields", canvas, caption, "png")
