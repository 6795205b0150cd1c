"""Traction curves and maps of friction over two keys, drawn."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .._base import GREEN, GREY, RED, friction_lines, interval_band, new_figure, plain_ticks
from ..errors import InputError
from ..quantities import axis_label


def plot_traction(path: Path, columns: dict[str, np.ndarray], title: str, load: float) -> None:
    """Draw friction over the slide-roll ratio with its parts, and temperatures below. ``columns``: those of a
    `TractionResult`, and ``ratio``."""
    order = np.argsort(columns["ratio"])
    c = {name: column[order] for name, column in columns.items() if name != "validity"}
    figure = new_figure(figsize=(7, 6.5))
    top, bottom = figure.subplots(2, 1, sharex=True, gridspec_kw={"height_ratios": [3, 2]})
    interval_band(top, c["ratio"], c)
    parts = c["coefficient"], c["boundary_force"] / load, c["shear_force"] / load
    friction_lines(top, c["ratio"], parts, marker="o", ms=4)
    told = columns.get("validity")
    if told is not None and any(told):
        held = np.array([not text for text in told])[order]
        top.plot(c["ratio"][~held], c["coefficient"][~held], "o", ms=9, mfc="none", mec=GREY, label="with cautions")
    top.set_ylabel("friction coefficient (-)")
    top.set_title(title)
    top.legend(framealpha=0.8, edgecolor="none")  # where it hides a line, the line shows through
    bottom.plot(c["ratio"], c["flash_temperature_rise"], "-", color=RED, label="surfaces (flash)")
    bottom.plot(c["ratio"], c["film_temperature_rise"], "-", color=GREEN, label="film above the surfaces")
    bottom.set_ylabel("largest temperature rise (K)")
    bottom.set_xlabel("slide-roll ratio (-)")
    bottom.legend(frameon=False)
    if np.all(c["ratio"] > 0) and c["ratio"][-1] > 20 * c["ratio"][0]:
        bottom.set_xscale("log")
        plain_ticks(bottom.xaxis)
    figure.savefig(path, dpi=150)


def plot_map(path: Path, study, across: str, up: str, title: str = "", quantity: str = "coefficient") -> None:
    """Draw ``quantity`` of a `StudyResult` as contours over two of its keys, for example ``"speed"`` and
    ``"motion.slide_roll_ratio"``.

    Points that have no number are marked. Raises `InputError` unless the two keys are its only dimensions, and numbers
    of which there are two at least.
    """
    coords = study.coords
    for key in (across, up):
        if key not in coords:
            raise InputError(f"{key!r} is not varied in this study; allowed: {', '.join(coords)}")
    dims = [coords[up][0], coords[across][0]]
    longer = [d for d, n in zip(study.dims, study.status.shape) if n > 1 and d not in dims]
    if longer or dims[0] == dims[1]:
        raise InputError(f"a map needs two dimensions, this study varies {', '.join(study.dims)} as well")
    axes = [study.dims.index(d) for d in dims]
    values = np.moveaxis(study[quantity], axes, (0, 1)).reshape(*(study.status.shape[a] for a in axes))
    x, y = (_numbers(key, coords[key][1]) for key in (across, up))
    values, x, y = values[np.argsort(y)][:, np.argsort(x)], np.sort(x), np.sort(y)
    known = np.ma.masked_invalid(values)
    figure = new_figure(figsize=(7, 5))
    ax = figure.subplots()
    shown = ax.contourf(x, y, known, levels=16, cmap="viridis")
    ax.contour(x, y, known, levels=16, colors="w", linewidths=0.4)
    rows, places = np.nonzero(~np.isfinite(values))
    if rows.size:
        ax.plot(x[places], y[rows], "x", color=RED, label="no answer")
        ax.legend(frameon=False)
    for key, values_of, scale, label in (
        (across, x, ax.set_xscale, ax.set_xlabel),
        (up, y, ax.set_yscale, ax.set_ylabel),
    ):
        label(axis_label(key))
        if np.all(values_of > 0) and values_of.max() > 20 * values_of.min():
            scale("log")
    figure.colorbar(shown, label="friction coefficient (-)" if quantity == "coefficient" else quantity)
    ax.set_title(title)
    figure.savefig(path, dpi=150)


def _numbers(key: str, values: np.ndarray) -> np.ndarray:
    """The values [SI] of a key along one axis of a map."""
    if values.dtype.kind != "f" or np.unique(values).size < max(2, values.size):
        raise InputError(f"{key} = {', '.join(map(str, values))}; an axis of a map takes two or more different numbers")
    return values
