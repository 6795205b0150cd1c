"""Pictures: what they share, and results drawn on given axes or on new ones of pyplot."""

from __future__ import annotations

import io

import numpy as np

from ..quantities import axis_label

BLUE, RED, GREEN, GREY = "#1f5a94", "#b3392f", "#2f7d4f", "#6b6b6b"
FRICTION = axis_label("coefficient")


def new_figure(*args, **kwargs):
    """A figure without a window."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(*args, layout="constrained", **kwargs)
    FigureCanvasAgg(figure)
    return figure


def make_ready() -> None:
    """Import matplotlib and load its fonts, which takes half a second, while something else is computed."""
    figure = new_figure(figsize=(1, 1))
    figure.subplots()
    figure.savefig(io.BytesIO())


def axes_or_new(ax):
    """``ax``, or the axes of a new figure."""
    if ax is not None:
        return ax
    from matplotlib import pyplot

    return pyplot.subplots(figsize=(7, 4.5), layout="constrained")[1]


def interval_band(ax, over: np.ndarray, columns) -> None:
    """The intervals of f as a band ``over`` speeds or ratios, if ``columns`` have them."""
    if np.isfinite(columns.get("interval_low", np.array([np.nan]))).any():
        band = {"color": BLUE, "alpha": 0.2, "lw": 0, "label": "95 %: solvers, grids, finite surface"}
        ax.fill_between(over, columns["interval_low"], columns["interval_high"], **band)


def friction_lines(axes, x, parts, **style) -> None:
    """f, and its parts from the contact spots and from the film, over ``x``. ``parts``: three arrays; ``style``: of the
    first."""
    f, contact, film = parts
    axes.plot(x, f, **{"color": BLUE, "label": "friction coefficient"} | style)
    for part, color, label in ((contact, RED, "from the contact spots"), (film, GREEN, "from the film")):
        axes.plot(x, part, color=color, lw=1, ls=(0, (4, 4)), label=label)  # f shows through where a part is all of it


def load_shares(axes, x, share) -> None:
    """Share of the load on the contact, and the rest on the film, over ``x``."""
    axes.fill_between(x, 0, share, color=RED, alpha=0.5, lw=0, label="contact $F_C$")
    axes.fill_between(x, share, 1, color=BLUE, alpha=0.3, lw=0, label="film $F_H$")
    axes.set(ylim=(0, 1), ylabel="share of the load (-)")


def plain_ticks(axis) -> None:
    """Numbers such as 0.2 and 0.5 on a logarithmic ``axis`` (``ax.xaxis``) of less than two decades, where matplotlib
    would write every tick as a product, so that they overlap. Ticks that were set by hand stay."""
    from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter

    low, high = sorted(axis.get_view_interval())
    if axis.get_scale() == "log" and 0 < low and high < 100 * low and isinstance(axis.get_major_locator(), LogLocator):
        axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high > 5 * low else (1, 1.5, 2, 3, 4, 5, 7)))
        axis.set_major_formatter(FormatStrFormatter("%g"))
        axis.set_minor_formatter(NullFormatter())


def speed_label(speed: np.ndarray) -> str:
    """The label of a logarithmic axis of entrainment ``speed`` [m/s], which shows its magnitude."""
    if not (speed < 0).any():
        return axis_label("speed")
    return f"entrainment speed |U| (m/s), {'both directions' if (speed > 0).any() else 'backwards'}"


def field_image(axes, x, y, values, colours: str, label: str, **options):
    """``values`` (nx, ny) over cells at ``x`` and ``y`` [m], from above, with a bar of colours; returns the image."""
    half_x, half_y = (0.5 * (a[1] - a[0] if a.size > 1 else 1e-6) for a in (x, y))
    extent = [1e6 * end for end in (x[0] - half_x, x[-1] + half_x, y[0] - half_y, y[-1] + half_y)]
    image = axes.imshow(values.T, origin="lower", aspect="auto", cmap=colours, extent=extent, **options)
    axes.figure.colorbar(image, ax=axes, label=label)
    axes.set(xlabel="x (µm), along the motion", ylabel="y (µm), along the line")
    return image


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


def pressure_axes(point, ax=None):
    """Pressure of the contact of a `lubfric.FrictionResult` with fields, over x and y."""
    axes = axes_or_new(ax)
    field_image(axes, point.x, point.y, point.pressure / 1e9, "magma_r", "contact pressure (GPa)", vmin=0)
    axes.set_title(f"U = {point.speed:g} m/s, $F_C$ = {point.contact_load:.4g} N, $F_H$ = {point.film_load:.4g} N")
    return axes


def surface_axes(surface, ax=None):
    """Heights of a `lubfric.Surface`, over x and y."""
    axes = axes_or_new(ax)
    x, y = (np.arange(count) * step for count, step in zip(surface.shape, surface.spacing))
    field_image(axes, x, y, (surface.heights - np.nanmean(surface.heights)) * 1e9, "cividis", "height (nm)")
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
    axes.set(xlabel=f"time ({unit})", ylabel=FRICTION)
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
    axes.set(xlabel=axis_label("speed"), ylabel=FRICTION)
    axes.legend(frameon=False)
    return axes
