"""Results drawn on given axes, or on new ones of pyplot."""

from __future__ import annotations

import numpy as np

from .plot import BLUE, GREY, friction_lines, interval_band, plain_ticks, speed_label


def axes_or_new(ax):
    """``ax``, or the axes of a new figure."""
    if ax is not None:
        return ax
    from matplotlib import pyplot

    return pyplot.subplots(figsize=(7, 4.5), layout="constrained")[1]


def curve_axes(curve, ax=None, **style):
    """Friction over speed of a `lubfric.StribeckResult`, with its parts and the band of its intervals; interpolated if
    it chose its speeds."""
    axes = axes_or_new(ax)
    good = np.isfinite(curve.coefficient) & (curve.speed != 0)
    order = np.flatnonzero(good)[np.argsort(np.abs(curve.speed[good]))]
    speed, total = np.abs(curve.speed[order]), (curve.contact_load + curve.film_load)[order]
    f, contact, film = (a[order] for a in (curve.coefficient, curve.boundary_force, curve.shear_force))
    low, high = curve.uncertainty.interval[order].T
    interval_band(axes, speed, {"interval_low": low, "interval_high": high})
    if "interpolation" in curve.report.residuals:
        fine = np.geomspace(speed[0], speed[-1], 400)
        friction_lines(axes, fine, (curve.at(fine), *curve.parts_at(fine)), **style)
        axes.plot(speed, f, "o", ms=4, color=style.get("color", BLUE))
    else:
        friction_lines(axes, speed, (f, contact / total, film / total), **{"marker": "o", "ms": 4} | style)
    axes.set(xscale="log", xlabel=speed_label(curve.speed[order]), ylabel="friction coefficient (-)")
    plain_ticks(axes.xaxis)
    axes.set_ylim(bottom=min(0.0, 1.1 * float(f.min(initial=0.0))))
    axes.legend(frameon=False)
    return axes


def pressure_axes(point, ax=None):
    """Pressure of the contact of a `lubfric.FrictionResult` with fields, over x and y."""
    axes = axes_or_new(ax)
    x, y = point.x * 1e6, point.y * 1e6
    _image(axes, x, y, point.pressure / 1e9, "magma_r", "contact pressure (GPa)", vmin=0)
    axes.set_title(f"U = {point.speed:g} m/s, $F_C$ = {point.contact_load:.4g} N, $F_H$ = {point.film_load:.4g} N")
    return axes


def surface_axes(surface, ax=None):
    """Heights of a `lubfric.Surface`, over x and y."""
    axes = axes_or_new(ax)
    (nx, ny), (dx, dy) = surface.shape, surface.spacing
    heights = (surface.heights - np.nanmean(surface.heights)) * 1e9
    _image(axes, np.arange(nx) * dx * 1e6, np.arange(ny) * dy * 1e6, heights, "cividis", "height (nm)")
    axes.set_title(f"Sq = {surface.sq * 1e9:.4g} nm")
    return axes


def history_axes(history, ax=None):
    """Friction over time of a `lubfric.TransientResult`, with its parts."""
    axes = axes_or_new(ax)
    low, high = history.uncertainty.interval.T
    if (high > low).any():
        time = history.time * time_scale(history.time[-1])[0]
        axes.fill_between(time, low, high, color=BLUE, alpha=0.2, lw=0, label="95 %: finite surface")
    friction_over_time(axes, history.columns)
    return axes


def friction_over_time(axes, c: dict[str, np.ndarray]) -> None:
    """Friction over time with its parts, by the ``c`` of a `lubfric.TransientResult`."""
    sense = np.where(c["sliding_speed"] != 0, c["sliding_speed"], c["entrainment_speed"])
    sense = np.where(sense < 0, -1.0, 1.0)  # of the coefficient
    scale, unit = time_scale(c["time"][-1])
    film = (c["couette_force"] + c["rolling_force"]) * sense / c["load"]
    parts = c["coefficient"], c["boundary_force"] * sense / c["load"], film
    friction_lines(axes, c["time"] * scale, parts)
    axes.set(xlabel=f"time ({unit})", ylabel="friction coefficient (-)")
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.15 * (high - low))
    axes.legend(frameon=False, ncols=3, fontsize=8, loc="upper center")


def time_scale(longest: float) -> tuple[float, str]:
    """(factor, unit) that shows times up to ``longest`` [s] as numbers above one."""
    for scale, unit in ((1.0, "s"), (1e3, "ms")):
        if longest * scale >= 1.0:
            return scale, unit
    return 1e6, "µs"


def loop_axes(history, ax=None):
    """Friction over entrainment speed of a `lubfric.TransientResult`: its hysteresis loop, the start marked.

    At a standstill no friction coefficient is defined, and none is drawn.
    """
    axes = axes_or_new(ax)
    moving = (history.entrainment_speed != 0) | (history.sliding_speed != 0)
    speed, friction = history.entrainment_speed, np.where(moving, history.coefficient, np.nan)
    axes.plot(speed, friction, color=BLUE)
    begin = np.flatnonzero(moving)[:1]
    axes.plot(speed[begin], friction[begin], "o", color=GREY, label="start")
    middle = history.time.size // 2
    if history.time.size > 2 and moving[middle] and moving[middle + 1]:
        ends = [(speed[i], friction[i]) for i in (middle, middle + 1)]
        axes.annotate("", ends[1], ends[0], arrowprops={"arrowstyle": "->", "color": BLUE, "mutation_scale": 18})
    axes.set(xlabel="entrainment speed U (m/s)", ylabel="friction coefficient (-)")
    axes.legend(frameon=False)
    return axes


def _image(axes, x, y, values, colours, label, **limits) -> None:
    half_x, half_y = 0.5 * (x[1] - x[0] if x.size > 1 else 1.0), 0.5 * (y[1] - y[0] if y.size > 1 else 1.0)
    extent = (x[0] - half_x, x[-1] + half_x, y[0] - half_y, y[-1] + half_y)
    image = axes.imshow(values.T, origin="lower", aspect="auto", cmap=colours, extent=extent, **limits)
    axes.figure.colorbar(image, ax=axes, label=label)
    axes.set(xlabel="x (µm), along the motion", ylabel="y (µm), along the line")
