"""Friction over the speed, drawn with its parts and intervals."""

from __future__ import annotations

import numpy as np

from .._base import BLUE, FRICTION, axes_or_new, friction_lines, plain_ticks, speed_label


def interval_band(ax, over: np.ndarray, columns) -> None:
    """The intervals of f as a band ``over`` speeds or ratios, if ``columns`` have them."""
    if np.isfinite(columns.get("interval_low", np.array([np.nan]))).any():
        band = {"color": BLUE, "alpha": 0.2, "lw": 0, "label": "95 %: solvers, grids, finite surface"}
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
