"""Figures of a run: the Stribeck curve, and the contact of one speed (paper, Figs. 8-10)."""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

WHOLE = 3.0  # times as long along y as along x: no more is drawn whole
BLUE, RED, GREEN, GREY = "#1f5a94", "#b3392f", "#2f7d4f", "#6b6b6b"


def new_figure(*args, **kwargs):
    """A figure without a window."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(*args, layout="constrained", **kwargs)
    FigureCanvasAgg(figure)
    return figure


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
        axes.plot(
            x, part, color=color, lw=1, ls=(0, (4, 4)), label=label
        )  # f shows through where one part is all of it


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
        return "entrainment speed U (m/s)"
    return f"entrainment speed |U| (m/s), {'both directions' if (speed > 0).any() else 'backwards'}"


def make_ready() -> None:
    """Import matplotlib and load its fonts, which takes half a second, while something else is computed."""
    figure = new_figure(figsize=(1, 1))
    figure.subplots()
    figure.savefig(io.BytesIO())


def plot_stribeck(
    path: Path, columns: dict[str, np.ndarray], title: str, entries: Sequence[Sequence[Any]], measured=None
) -> None:
    """Coefficient, load split and lambda ratio over entrainment speed.

    ``columns``: arrays by name as in `lubfric._base.read_table`; speeds that failed are left out. ``entries``: for each
    row, the assumptions that are violated (`lubfric.Validity`). ``measured``: a `lubfric.Measured` over
    speed, drawn beside the curve.
    """
    good = np.isfinite(columns["coefficient"]) & (columns["speed"] != 0)
    order = np.flatnonzero(good)[np.argsort(np.abs(columns["speed"][good]))]
    c = type(columns)((k, v[order]) for k, v in columns.items())
    speed, total = np.abs(c["speed"]), c["contact_load"] + c["film_load"]
    figure = new_figure(figsize=(7, 8))
    top, middle, bottom = figure.subplots(3, 1, sharex=True, gridspec_kw={"height_ratios": [3, 2, 2]})
    interval_band(top, speed, c)
    parts = c["coefficient"], c["boundary_force"] / total, c["shear_force"] / total
    friction_lines(top, speed, parts, marker="o", ms=4)
    top.set_xscale("log")
    if measured is not None:
        error = None if measured.deviation is None else 1.96 * measured.deviation
        top.errorbar(np.abs(measured.x), measured.coefficient, error, fmt="D", ms=4, color="k", mfc="none", lw=1)
        top.plot([], [], "D", ms=4, color="k", mfc="none", label=measured.source)
    _mark(figure, top, speed, c["coefficient"], [entries[i] for i in order])
    top.set_ylabel("friction coefficient (-)")
    lowest = c["coefficient"].min() if measured is None else min(c["coefficient"].min(), measured.coefficient.min())
    top.set_ylim(bottom=min(0, 1.1 * lowest))
    top.set_title(title)
    top.legend(framealpha=0.8, edgecolor="none")  # where it hides a line, the line shows through
    load_shares(middle, speed, c["contact_load"] / total)
    middle.legend(frameon=False, loc="center right")
    bottom.loglog(speed, c["film_to_roughness_ratio"], "o-", color=GREY, ms=4)
    bottom.axhline(3, color=GREY, lw=0.7, ls=":")
    below = c["film_to_roughness_ratio"].max() < 4  # the line is near the upper end of the axis
    place = {"xytext": (2, -2 if below else 2), "textcoords": "offset points", "va": "top" if below else "bottom"}
    bottom.annotate("λ = 3", (speed[0], 3), color=GREY, **place)
    bottom.set_ylabel("λ = central film / Sq (-)")
    bottom.set_xlabel(speed_label(c["speed"]))
    for axis in (bottom.xaxis, bottom.yaxis):
        plain_ticks(axis)
    figure.savefig(path, dpi=150)


def _mark(figure, axes, speed, coefficient, entries: list[Sequence[Any]]) -> None:
    """Ring the points at which an assumption is violated, and cross out those at which f is meaningless. The text below
    says which."""
    if not any(entries):
        return
    severe = np.array([any(entry.severe for entry in told) for told in entries])
    minor = np.array([bool(told) for told in entries]) & ~severe
    for chosen, marker, color, label in (
        (minor, "o", GREY, "with cautions"),
        (severe, "x", RED, "no answer (accepted)"),
    ):
        if chosen.any():
            axes.plot(speed[chosen], coefficient[chosen], marker, ms=9, mfc="none", mec=color, label=label)
    names = dict.fromkeys(entry.what for told in entries for entry in told)
    figure.supxlabel("cautions: " + "; ".join(names), fontsize=8, color=GREY, wrap=True)


def plot_contact(path: Path, prepared, point) -> None:
    """Contact pressure map; beside it film, separation and surface on a section through the highest pressure.

    ``point``: a `FrictionResult` with fields, on the cells of ``prepared``. The section shows what the paper's Fig. 10
    shows: the smooth film h, the separation h_s = h - epsilon, and the rough surface, deformed (z - u) and undeformed
    (z). epsilon and u are known up to one constant. It is chosen so that u has zero mean over the section.
    """
    x = prepared.contact.x
    heights = prepared.surface.heights - prepared.surface.heights.mean()
    contact = point.balance.contact.fields
    row = heights.shape[1] // 2 if contact is None else int(contact.pressure.max(axis=0).argmax())
    section = point.balance.film is not None and heights.shape[0] == x.size
    shown = [contact is not None or not section, section]
    figure = new_figure(figsize=(5.5 * sum(shown), 4.5))
    panels = iter(figure.subplots(1, sum(shown), squeeze=False).flat)
    loads = f"U = {point.speed:g} m/s, $F_C$ = {point.contact_load:.4g} N, $F_H$ = {point.film_load:.4g} N"
    if shown[0]:
        left = next(panels)
        _pressure_map(figure, left, prepared, contact, row)
        left.set_title(loads)
    if section:
        right, place = next(panels), f"section at y = {row * prepared.surface.spacing[1] * 1e6:.1f} µm"
        _section(right, x, heights[:, row], point.balance, row)
        right.set_title(place if shown[0] else f"{loads}: no contact\n{place}")
        if shown[0]:
            _place_on_the_line(left, prepared, point, row)
    figure.savefig(path, dpi=150)


def _place_on_the_line(axes, prepared, point, row) -> None:
    """Of a long line, draw only the part around the section, about twice as long as wide, and say where it lies."""
    step, (across, along) = prepared.surface.spacing[1], prepared.surface.size
    if prepared.lines is None or along < WHOLE * across:
        return
    first = min(max(row * step - across, 0.0), along - 2 * across)
    axes.set_ylim(first * 1e6, (first + 2 * across) * 1e6)
    axes.set_ylabel(f"y (µm) on a line of {1e3 * point.uncertainty.length:.3g} mm; dotted: section")


def _pressure_map(figure, axes, prepared, contact, row) -> None:
    if contact is None:
        axes.text(
            0.5,
            0.5,
            "no dry contact field\n(separated, or read from a contact curve)",
            ha="center",
            va="center",
            transform=axes.transAxes,
        )
        axes.set_axis_off()
        return
    x, (_, dy), half_width = prepared.contact.x, prepared.surface.spacing, prepared.scene.bodies.half_width
    image = axes.imshow(
        contact.pressure.T / 1e9,
        origin="lower",
        aspect="auto",
        cmap="magma_r",
        vmin=0,
        extent=(x[0] * 1e6, x[-1] * 1e6, 0, contact.pressure.shape[1] * dy * 1e6),
    )
    figure.colorbar(image, ax=axes, label="contact pressure (GPa)")
    for edge in (-half_width, half_width):
        axes.axvline(edge * 1e6, color=GREY, lw=0.8, ls="--")
    axes.axhline(row * dy * 1e6, color=GREEN, lw=0.8, ls=":")
    axes.set(xlabel="x (µm), direction of motion; dashed: Hertz strip", ylabel="y (µm); dotted: section")


def _section(axes, x, surface, balance, row) -> None:
    smooth, contact = balance.film.film_at(x), balance.contact.fields
    micro = x * 1e6
    axes.plot(micro, smooth * 1e9, color=BLUE, label="film thickness h")
    axes.plot(micro, surface * 1e9, color=GREY, lw=0.8, ls="--", label="surface z, undeformed")
    if contact is not None:
        deflection = contact.displacement[:, row]
        gauge = deflection.mean()
        axes.plot(micro, (surface - deflection + gauge) * 1e9, color=GREY, lw=1, label="surface, deformed")
        # gap + deformed surface is what the surface is pressed under
        axes.plot(
            micro,
            (contact.gap[:, row] + surface - deflection + gauge) * 1e9,
            color=RED,
            label="separation $h_s$ = h − ε",
        )
    axes.set(xlabel="x (µm)", ylabel="height (nm)")
    axes.legend(frameon=False, fontsize=8)
