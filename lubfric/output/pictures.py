"""Pictures of a run: the curve, the contact of one speed (Akchurin et al. 2015, Figs. 8-10), and what changes in
time."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from .._base import (
    BLUE,
    FRICTION,
    GREEN,
    GREY,
    RED,
    field_image,
    friction_lines,
    load_shares,
    log_if_wide,
    new_figure,
    plain_ticks,
    plain_words,
    speed_label,
)
from ..studies import friction_over_speed, interval_band
from ..time import friction_over_time, time_scale

WHOLE = 3.0  # times as long along y as along x: no more is drawn whole
FRAMES = 150  # of an animation at most, spread over the run
NEAR = 4.0  # half-widths of the Hertz strip around which a gap is drawn


def plot_stribeck(
    path: Path, columns: dict[str, np.ndarray], title: str, entries: Sequence[Sequence[Any]], measured=None
) -> None:
    """Coefficient, load split and lambda ratio over entrainment speed.

    ``columns``: arrays by name as `lubfric._base.read_table` gives them; speeds that failed are left out. ``entries``:
    for each row, the assumptions that are violated (`lubfric.Validity`). ``measured``: a `lubfric.Measured` over speed,
    drawn beside the curve.
    """
    figure = new_figure(figsize=(7, 8))
    top, middle, bottom = figure.subplots(3, 1, sharex=True, gridspec_kw={"height_ratios": [3, 2, 2]})
    order = friction_over_speed(top, columns)
    c = type(columns)((name, column[order]) for name, column in columns.items())
    speed, ratio = np.abs(c["speed"]), c["film_to_roughness_ratio"]
    if measured is not None:
        error = None if measured.deviation is None else 1.96 * measured.deviation
        points = {"fmt": "D", "ms": 4, "color": "k", "mfc": "none", "lw": 1, "label": plain_words(measured.source)}
        top.errorbar(np.abs(measured.x), measured.coefficient, error, **points)
        top.set_ylim(bottom=min(top.get_ylim()[0], 1.1 * measured.coefficient.min()))
    _mark(figure, top, speed, c["coefficient"], [entries[i] for i in order])
    top.set(title=title, xlabel="")
    top.legend(framealpha=0.8, edgecolor="none")  # where it hides a line, the line shows through
    load_shares(middle, speed, c["contact_load"] / (c["contact_load"] + c["film_load"]))
    middle.legend(frameon=False, loc="center right")
    bottom.loglog(speed, ratio, "o-", color=GREY, ms=4)
    bottom.axhline(3, color=GREY, lw=0.7, ls=":")
    below = ratio.max() < 4  # the line is near the upper end of the axis
    place = {"xytext": (2, -2 if below else 2), "textcoords": "offset points", "va": "top" if below else "bottom"}
    bottom.annotate("λ = 3", (speed[0], 3), color=GREY, **place)
    bottom.set(ylabel="λ = central film / Sq (-)", xlabel=speed_label(c["speed"]))
    for axis in (bottom.xaxis, bottom.yaxis):
        plain_ticks(axis)
    figure.savefig(path, dpi=150)


def plot_traction(
    path: Path, columns: dict[str, np.ndarray], title: str, entries: Sequence[Sequence[Any]], measured=None
) -> None:
    """Friction over the slide-roll ratio, and temperatures below. Arguments as of `plot_stribeck`."""
    good = np.flatnonzero(np.isfinite(columns["coefficient"]))
    order = good[np.argsort(columns["ratio"][good])]
    c = type(columns)((name, column[order]) for name, column in columns.items())
    ratio, load = c["ratio"], c["contact_load"] + c["film_load"]
    figure = new_figure(figsize=(7, 6.5))
    top, bottom = figure.subplots(2, 1, sharex=True, gridspec_kw={"height_ratios": [3, 2]})
    interval_band(top, ratio, c)
    friction_lines(
        top, ratio, (c["coefficient"], c["boundary_force"] / load, c["shear_force"] / load), marker="o", ms=4
    )
    _mark(figure, top, ratio, c["coefficient"], [entries[i] for i in order])
    top.set(title=title, ylabel=FRICTION)
    top.legend(framealpha=0.8, edgecolor="none")
    bottom.plot(ratio, c["flash_temperature_rise"], "-", color=RED, label="surfaces (flash)")
    bottom.plot(ratio, c["film_temperature_rise"], "-", color=GREEN, label="film above the surfaces")
    bottom.set(xlabel="slide-roll ratio (-)", ylabel="largest temperature rise (K)")
    bottom.legend(frameon=False)
    log_if_wide(bottom, "x", ratio)
    plain_ticks(bottom.xaxis)
    figure.savefig(path, dpi=150)


def _mark(figure, axes, speed, coefficient, entries: list[Sequence[Any]]) -> None:
    """Ring the points at which an assumption is violated, and cross out those at which f is meaningless. The text below
    says which."""
    severe = np.array([any(entry.severe for entry in violated) for violated in entries], dtype=bool)
    minor = np.array([len(violated) > 0 for violated in entries], dtype=bool) & ~severe
    for chosen, marker, color, label in (
        (minor, "o", GREY, "with cautions"),
        (severe, "x", RED, "no answer (accepted)"),
    ):
        if chosen.any():
            axes.plot(speed[chosen], coefficient[chosen], marker, ms=9, mfc="none", mec=color, label=label)
    if names := dict.fromkeys(entry.what for violated in entries for entry in violated):
        figure.supxlabel("cautions: " + "; ".join(names), fontsize=8, color=GREY, wrap=True)


def plot_contact(path: Path, prepared, point) -> None:
    """The contact of ``point``, a `lubfric.FrictionResult` with fields, on the cells of ``prepared``, as PNG."""
    if point.deterministic is not None:
        figure = _one_gap(point.deterministic.result, prepared.scene.bodies.half_width)
    else:
        figure = _two_pressures(prepared, point)
    figure.savefig(path, dpi=150)


def _one_gap(result, half_width: float):
    """Pressure, gap and shear around the Hertz strip, from above."""
    from matplotlib.colors import LogNorm

    near = np.abs(result.x) <= NEAR * half_width
    y = np.arange(result.pressure.shape[1]) * result.spacing[1]
    figure = new_figure(figsize=(13, 4.2))
    for axes, (label, field, colours, norm) in zip(
        figure.subplots(1, 3, sharey=True),
        (
            ("pressure (GPa)", result.pressure / 1e9, "magma_r", None),
            ("gap (nm)", result.gap * 1e9, "viridis", LogNorm()),
            ("shear (MPa)", result.shear / 1e6, "cividis", None),
        ),
    ):
        field_image(axes, result.x[near], y, field[near], colours, label, norm=norm)
        _hertz_strip(axes, half_width)
    return figure


def _two_pressures(prepared, point):
    """Map of the contact pressure; beside it film, separation and surface on a section through the highest pressure.

    The section shows what the paper's Fig. 10 shows: the smooth film h, the separation h_s = h - epsilon, and the rough
    surface, deformed (z - u) and undeformed (z). epsilon and u are known up to one constant. It is chosen so that u has
    zero mean over the section.
    """
    heights = prepared.surface.heights if point.heights is None else point.heights
    heights, x = heights - heights.mean(), point.balance.contact.x
    contact, film = point.balance.contact.fields, point.balance.film
    row = heights.shape[1] // 2 if contact is None else int(contact.pressure.max(axis=0).argmax())
    in_section = film is not None and heights.shape[0] == x.size
    panels = [contact is not None or not in_section, in_section]
    figure = new_figure(figsize=(5.5 * sum(panels), 4.5))
    axes = list(figure.subplots(1, sum(panels), squeeze=False).flat)
    loads = f"U = {point.speed:g} m/s, $F_C$ = {point.contact_load:.4g} N, $F_H$ = {point.film_load:.4g} N"
    if contact is not None:
        _pressure_map(axes[0], prepared, point, row)
    elif panels[0]:
        said = {"ha": "center", "va": "center", "transform": axes[0].transAxes}
        axes[0].text(0.5, 0.5, "no dry contact field\n(separated, or read from a contact curve)", **said)
        axes[0].set_axis_off()
    axes[0].set_title(loads if panels[0] else f"{loads}: no contact")
    if in_section:
        _section(axes[-1], x * 1e6, heights[:, row], film.film_at(x), contact, row)
        place = "" if contact is None else f"section at y = {point.y[row] * 1e6:.1f} µm"
        axes[-1].set_title(place if panels[0] else f"{loads}: no contact\n{place}")
    return figure


def _pressure_map(axes, prepared, point, row: int) -> None:
    """The pressure, with the section. Of long strips, only the part around the section, about twice as long as wide."""
    pressure, x, y = point.pressure, point.x, point.y
    across, along, at = x[-1] - x[0], y[-1], y[row]
    field_image(axes, x, y, pressure / 1e9, "magma_r", "contact pressure (GPa)", vmin=0)
    _hertz_strip(axes, prepared.scene.bodies.half_width)
    axes.axhline(at * 1e6, color=GREEN, lw=0.8, ls=":")
    axes.set_ylabel("y (µm); dotted: section")
    if along >= WHOLE * across:
        first = min(max(at - across, 0.0), along - 2 * across)
        axes.set_ylim(first * 1e6, (first + 2 * across) * 1e6)
        axes.set_ylabel(f"y (µm) on strips of {1e3 * point.uncertainty.length:.3g} mm; dotted: section")


def _hertz_strip(axes, half_width: float) -> None:
    for edge in (-half_width, half_width):
        axes.axvline(edge * 1e6, color=GREY, lw=0.8, ls="--")
    axes.set_xlabel("x (µm), direction of motion; dashed: Hertz strip")


def _section(axes, micro, surface, smooth, contact, row: int) -> None:
    axes.plot(micro, smooth * 1e9, color=BLUE, label="film thickness h")
    axes.plot(micro, surface * 1e9, color=GREY, lw=0.8, ls="--", label="surface z, undeformed")
    if contact is not None:
        deflection = contact.displacement[:, row]
        deformed = surface - deflection + deflection.mean()
        axes.plot(micro, deformed * 1e9, color=GREY, lw=1, label="surface, deformed")
        pressed_under = contact.gap[:, row] + deformed
        axes.plot(micro, pressed_under * 1e9, color=RED, label="separation $h_s$ = h − ε")
    axes.set(xlabel="x (µm)", ylabel="height (nm)")
    axes.legend(frameon=False, fontsize=8)


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
