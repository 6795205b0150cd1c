"""Friction over the speed, drawn with its parts and intervals; numbers of a study over two of its keys."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .._base import (
    BLUE,
    FRICTION,
    RED,
    axes_or_new,
    friction_lines,
    log_if_wide,
    new_figure,
    plain_ticks,
    speed_label,
)
from ..errors import InputError
from ..quantities import axis_label


def interval_band(ax, over: np.ndarray, columns) -> None:
    """The intervals of f as a band ``over`` speeds or ratios, if ``columns`` have them."""
    if np.isfinite(columns.get("interval_low", np.array([np.nan]))).any():
        band = {"color": BLUE, "alpha": 0.2, "lw": 0, "label": "95 %: solvers, grids, surface, model"}
        ax.fill_between(over, columns["interval_low"], columns["interval_high"], **band)


def friction_over_speed(axes, columns: dict[str, np.ndarray], between=None, **style) -> np.ndarray:
    """Friction over the magnitude of the speed with its parts and the band of its intervals, by the ``columns`` of a
    `lubfric.StribeckResult`. ``between``: (speeds, f, its two parts) on a smooth curve through the points. Returns the
    indices of the points drawn, in order: those that failed, and rest, are left out."""
    good = np.isfinite(columns["coefficient"]) & (columns["speed"] != 0)
    order = np.flatnonzero(good)[np.argsort(np.abs(columns["speed"][good]))]
    c = type(columns)((name, column[order]) for name, column in columns.items())
    speed, load = np.abs(c["speed"]), c["contact_load"] + c["film_load"]
    interval_band(axes, speed, c)
    if between is None:
        parts = c["coefficient"], c["boundary_force"] / load, c["shear_force"] / load
        friction_lines(axes, speed, parts, **{"marker": "o", "ms": 4} | style)
    else:
        friction_lines(axes, between[0], between[1:], **style)
        axes.plot(speed, c["coefficient"], "o", ms=4, color=style.get("color", BLUE))
    axes.set(xscale="log", xlabel=speed_label(c["speed"]), ylabel=FRICTION)
    plain_ticks(axes.xaxis)
    axes.set_ylim(bottom=min(0.0, 1.1 * float(c["coefficient"].min(initial=0.0))))
    return order


def curve_axes(curve, ax=None, **style):
    """Friction over speed of a `lubfric.StribeckResult`, with its parts and the band of its intervals; interpolated if
    it chose its speeds."""
    axes = axes_or_new(ax)
    names = "speed", "coefficient", "contact_load", "film_load", "boundary_force", "shear_force"
    columns = {name: getattr(curve, name) for name in names}
    columns |= dict(zip(("interval_low", "interval_high"), curve.uncertainty.interval.T))
    between = None
    if "interpolation" in curve.report.residuals:
        known = np.abs(curve.speed[np.isfinite(curve.coefficient) & (curve.speed != 0)])
        fine = np.geomspace(known.min(), known.max(), 400)
        between = fine, curve.at(fine), *curve.parts_at(fine)
    friction_over_speed(axes, columns, between, **style)
    axes.legend(frameon=False)
    return axes


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
    ax.set(xlabel=axis_label(across), ylabel=axis_label(up), title=title)
    log_if_wide(ax, "x", x)
    log_if_wide(ax, "y", y)
    figure.colorbar(shown, label="friction coefficient (-)" if quantity == "coefficient" else quantity)
    figure.savefig(path, dpi=150)


def _numbers(key: str, values: np.ndarray) -> np.ndarray:
    """The values [SI] of a key along one axis of a map."""
    if values.dtype.kind != "f" or np.unique(values).size < max(2, values.size):
        raise InputError(f"{key} = {', '.join(map(str, values))}; an axis of a map takes two or more different numbers")
    return values
