"""A run in time, drawn: friction over time and over the speed, all of it over time, the film as an animation."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .._base import BLUE, FRICTION, GREEN, GREY, RED, axes_or_new, friction_lines, load_shares, new_figure
from ..quantities import axis_label

FRAMES = 150  # of an animation at most, spread over the run


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


def plot_history(path: Path, columns: dict[str, np.ndarray], title: str) -> None:
    """Speed and load, film, shares of the load, and friction over time, from the columns of history.csv."""
    c = columns
    t = c["time"] * time_scale(c["time"][-1])[0]
    figure = new_figure(figsize=(7.5, 9))
    first, second, third, fourth = figure.subplots(4, 1, sharex=True)
    first.plot(t, c["entrainment_speed"], color=BLUE)
    first.axhline(0.0, color=GREY, lw=0.6)
    first.set_ylabel("entrainment speed U (m/s)", color=BLUE)
    first.set_title(title)
    load = first.twinx()
    load.plot(t, c["load"], color=RED, lw=1)
    load.set_ylim(0.0, 1.15 * c["load"].max())
    load.set_ylabel("load $F_T$ (N)", color=RED)
    second.plot(t, c["central_film"] * 1e9, color=BLUE, label="central film")
    second.plot(t, c["min_film"] * 1e9, color=GREEN, label="minimum film")
    second.plot(t, c["mean_gap"] * 1e9, color=GREY, lw=0.9, ls="--", label="mean gap over A")
    second.set_ylabel("film thickness (nm)")
    second.set_ylim(bottom=0.0)
    second.legend(frameon=False, ncols=3, fontsize=8)
    load_shares(third, t, c["contact_load"] / c["load"])
    third.legend(frameon=False, ncols=2, fontsize=8)
    error = c.get("sampling_error", np.zeros(0))
    if np.any(error > 0):
        low, high = (c["coefficient"] * (1 + sign * 2 * error) for sign in (-1, 1))
        fourth.fill_between(t, low, high, color=BLUE, alpha=0.2, lw=0, label="2 standard errors: finite surface")
    friction_over_time(fourth, c)
    fourth.set_xlim(t[0], t[-1])
    figure.savefig(path, dpi=150)


def animate(path: Path, result, half_width: float) -> None:
    """GIF of pressure and film along the contact over time (Pillow writer)."""
    from matplotlib.animation import FuncAnimation, PillowWriter

    count, x, h = result.time.size, result.x, result.film_thickness
    radius = (x[0] ** 2 - x[1] ** 2) / (2.0 * (h[0, 0] - h[0, 1]))  # of the undeformed gap, far out
    reach = 3.0 * max(half_width, float(np.sqrt(h.min(axis=1).max() * 2.0 * radius)))
    seen = np.abs(x) <= reach
    x, thick = x[seen] * 1e6, h[:, seen] * 1e9
    figure = new_figure(figsize=(7, 4.5))
    top = figure.subplots()
    bottom = top.twinx()
    (pressure,) = top.plot([], [], color=RED)
    (film,) = bottom.plot([], [], color=BLUE)
    top.set(xlim=(x[0], x[-1]), ylim=(0.0, 1.1 * result.pressure.max() / 1e6), xlabel="x (µm)")
    top.set_ylabel("film pressure (MPa)", color=RED)
    bottom.set_ylim(0.0, 1.5 * max(result.central_film.max() * 1e9, np.median(thick.min(axis=1)) * 2.0))
    bottom.set_ylabel("film thickness (nm)", color=BLUE)
    scale, unit = time_scale(result.time[-1])

    def draw(i):
        pressure.set_data(x, result.pressure[i, seen] / 1e6)
        film.set_data(x, thick[i])
        speed, friction = result.entrainment_speed[i], result.coefficient[i]
        moment = f"t = {result.time[i] * scale:.4g} {unit},  U = {speed:.3g} m/s,  f = {friction:.4f}"
        top.set_title(moment, fontsize=10)
        return pressure, film

    draw(0)
    figure.canvas.draw()
    figure.set_layout_engine("none")  # laid out once: the frames must not jump, and are drawn faster
    frames = np.unique(np.linspace(0, count - 1, min(FRAMES, count)).round().astype(int)).tolist()
    FuncAnimation(figure, draw, frames=frames, blit=False).save(path, writer=PillowWriter(fps=15), dpi=80)
