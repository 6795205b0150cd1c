"""Figures of a run in time: its course, and film and pressure as an animation."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .._base import BLUE, GREEN, GREY, RED, friction_over_time, load_shares, new_figure, time_scale

FRAMES = 150  # at most, spread over the run


def plot_history(path: Path, columns: dict[str, np.ndarray], title: str) -> None:
    """Speed and load, film, shares of the load, and friction over time, from the columns of history.csv."""
    c = columns
    t = c["time"] * time_scale(c["time"][-1])[0]
    figure = new_figure(figsize=(7.5, 9))
    first, second, third, fourth = figure.subplots(4, 1, sharex=True)
    first.plot(t, c["entrainment_speed"], color=BLUE)
    first.axhline(0.0, color=GREY, lw=0.6)
    first.set_ylabel("entrainment speed U (m/s)", color=BLUE)
    load = first.twinx()
    load.plot(t, c["load"], color=RED, lw=1)
    load.set_ylim(0.0, 1.15 * c["load"].max())
    load.set_ylabel("load $F_T$ (N)", color=RED)
    first.set_title(title)
    second.plot(t, c["central_film"] * 1e9, color=BLUE, label="central film")
    second.plot(t, c["min_film"] * 1e9, color=GREEN, label="minimum film")
    second.plot(t, c["mean_gap"] * 1e9, color=GREY, lw=0.9, ls="--", label="mean gap over A")
    second.set_ylabel("film thickness (nm)")
    second.set_ylim(bottom=0.0)
    second.legend(frameon=False, ncols=3, fontsize=8)
    load_shares(third, t, c["contact_load"] / c["load"])
    third.legend(frameon=False, ncols=2, fontsize=8)
    _error_band(fourth, t, c)
    friction_over_time(fourth, c)
    fourth.set_xlim(t[0], t[-1])
    figure.savefig(path, dpi=150)


def _error_band(axes, t: np.ndarray, c: dict[str, np.ndarray]) -> None:
    """Two standard errors of f to either side over the drawn times ``t``, if the table has the standard error."""
    error = c.get("sampling_error", np.zeros(0))
    if np.any(error > 0):
        low, high = (c["coefficient"] * (1 + sign * 2 * error) for sign in (-1, 1))
        axes.fill_between(t, low, high, color=BLUE, alpha=0.2, lw=0, label="2 standard errors: finite surface")


def animate(path: Path, result, half_width: float) -> None:
    """GIF of pressure and film along the contact over time (Pillow writer)."""
    from matplotlib.animation import FuncAnimation, PillowWriter

    chosen = np.unique(np.linspace(0, result.time.size - 1, min(FRAMES, result.time.size)).round().astype(int))
    reach = 3.0 * max(half_width, float(np.sqrt(result.film_thickness.min(axis=1).max() * 2.0 * _radius(result))))
    seen = np.abs(result.x) <= reach
    x = result.x[seen] * 1e6
    figure = new_figure(figsize=(7, 4.5))
    top = figure.subplots()
    bottom = top.twinx()
    (pressure,) = top.plot([], [], color=RED)
    (film,) = bottom.plot([], [], color=BLUE)
    top.set(xlim=(x[0], x[-1]), ylim=(0.0, 1.1 * result.pressure.max() / 1e6), xlabel="x (µm)")
    top.set_ylabel("film pressure (MPa)", color=RED)
    thick = result.film_thickness[:, seen] * 1e9
    bottom.set_ylim(0.0, 1.5 * max(result.central_film.max() * 1e9, np.median(thick.min(axis=1)) * 2.0))
    bottom.set_ylabel("film thickness (nm)", color=BLUE)
    scale, unit = time_scale(result.time[-1])

    def draw(i):
        pressure.set_data(x, result.pressure[i, seen] / 1e6)
        film.set_data(x, thick[i])
        top.set_title(
            f"t = {result.time[i] * scale:.4g} {unit},  U = {result.entrainment_speed[i]:.3g} m/s,  "
            f"f = {result.coefficient[i]:.4f}",
            fontsize=10,
        )
        return pressure, film

    draw(0)
    figure.canvas.draw()
    figure.set_layout_engine("none")  # laid out once: the frames must not jump, and are drawn faster
    FuncAnimation(figure, draw, frames=[int(i) for i in chosen], blit=False).save(
        path, writer=PillowWriter(fps=15), dpi=80
    )


def _radius(result) -> float:
    """Radius of the undeformed gap, from the two nodes farthest out."""
    x, h = result.x, result.film_thickness[0]
    return float((x[0] ** 2 - x[1] ** 2) / (2.0 * (h[0] - h[1])))
