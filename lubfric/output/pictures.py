"""Pictures of a run, by its table: a curve, or what changes in time; and the contact of one speed."""

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np

from .._base import figures
from ..studies import friction_over
from ..time import friction_over_time, time_scale

WHOLE = 3.0  # times as long along y as along x: no more is drawn whole
NEAR = 4.0  # half-widths of the Hertz strip around which a contact is drawn
NAMED = re.compile(r"(?:caution|not valid): (.+?) is (?:[-\d]|nan|inf)")  # what an entry in a cell is about


def plot_stribeck(path: Path, columns: dict[str, np.ndarray], title: str, measured=None) -> None:
    """Coefficient, load split and lambda ratio over entrainment speed.

    ``columns``: arrays by name as `lubfric._base.read_table` gives them; speeds that failed are left out.
    ``measured``: a `lubfric.Measured` over speed, drawn beside the curve.
    """
    figure = figures.new_figure(figsize=(7, 8))
    top, middle, bottom = figure.subplots(3, 1, sharex=True, gridspec_kw={"height_ratios": [3, 2, 2]})
    if measured is not None:
        measured.draw(top)
    c = _friction(figure, top, columns, title)
    speed, film = np.abs(c["speed"]), c["central_film"] * 1e9
    top.set(xlabel="")
    figures.load_shares(middle, speed, c["contact_load"] / (c["contact_load"] + c["film_load"]))
    figures.key_above(middle)
    bottom.loglog(speed, film, "o-", color=figures.GREEN, ms=4, label="central film")
    sq = film / c["film_to_roughness_ratio"]
    if np.isfinite(sq).all() and (sq > 0).all():  # not of smooth surfaces
        for times, dashes, name in ((1, "--", f"Sq = {sq[0]:.3g} nm"), (3, ":", "3 Sq: summits hardly touch")):
            bottom.axhline(times * sq[0], color=figures.GREY, lw=0.8, ls=dashes, label=name)
    figures.key_above(bottom)
    bottom.set(ylabel="film thickness (nm)", xlabel=figures.speed_label(c["speed"]))
    for axis in (bottom.xaxis, bottom.yaxis):
        figures.plain_ticks(axis)
    figure.savefig(path, dpi=150)


def plot_traction(path: Path, columns: dict[str, np.ndarray], title: str) -> None:
    """Friction over the slide-roll ratio, and below, where heat was found, temperatures. Arguments as of
    `plot_stribeck`."""
    rises = {"flash_temperature_rise": (figures.RED, "surfaces (flash)")}
    rises["film_temperature_rise"] = figures.GREEN, "film above the surfaces"
    warm = any((columns[name] > 0).any() for name in rises)
    figure = figures.new_figure(figsize=(7, 6.5 if warm else 4.5))
    top, *others = figure.subplots(1 + warm, 1, sharex=True, squeeze=False, height_ratios=[3, 2][: 1 + warm]).flat
    c = _friction(figure, top, columns, f"{title}, U = {np.nanmax(columns['speed']):g} m/s")
    for bottom in others:
        for name, (colour, label) in rises.items():
            bottom.plot(c["ratio"], c[name], "-", color=colour, label=label)
        bottom.set(ylabel="largest temperature rise (K)", xlabel=top.get_xlabel())
        top.set_xlabel("")
        figures.key_above(bottom)
    figure.savefig(path, dpi=150)


def _friction(figure, axes, columns: dict[str, np.ndarray], title: str) -> dict[str, np.ndarray]:
    """f on ``axes``, with rings where an assumption is violated, unless it is at all points, and crosses where f is
    meaningless; the text below says which. Returns the ``columns`` of the points drawn, in order."""
    order = friction_over(axes, columns)
    c = type(columns)((name, column[order]) for name, column in columns.items())
    severe = np.array(["not valid: " in cell for cell in c["validity"]], dtype=bool)
    minor = (c["validity"] != "") & ~severe
    everywhere = minor.all()
    for chosen, marker, color, label in (
        (minor & (not everywhere), "o", figures.GREY, "with cautions"),
        (severe, "x", figures.RED, "no answer (accepted)"),
    ):
        if chosen.any():
            at = np.abs(c["speed"]) if "ratio" not in c else c["ratio"]
            axes.plot(at[chosen], c["coefficient"][chosen], marker, ms=9, mfc="none", mec=color, label=label)
    if names := dict.fromkeys(name for cell in c["validity"] for name in NAMED.findall(cell)):
        head = "cautions, at all points: " if everywhere else "cautions: "
        figure.supxlabel(head + "; ".join(names), fontsize=8, color=figures.GREY, wrap=True)
    figures.key_above(axes)
    figure.suptitle(figures.plain_words(title))
    return c


def plot_contact(path: Path, point, half_width: float) -> None:
    """Pressure, gap and, with one gap, shear of ``point``, a `lubfric.FrictionResult` with fields, from above, around
    the Hertz strip of that ``half_width`` [m], in the part of the line with the highest pressure."""
    from matplotlib.colors import LogNorm

    near = np.abs(point.x) <= NEAR * half_width
    x, y = point.x[near], point.y
    part = _part(x, y, int(point.pressure[near].max(axis=0).argmax()))
    panels = {
        "pressure (GPa)": (point.pressure / 1e9, "magma_r", None),
        "gap (nm), white: none": (point.gap * 1e9, "viridis", LogNorm()),
    }
    if point.deterministic is not None:
        panels["shear stress (MPa)"] = (point.deterministic.result.shear / 1e6, "cividis", None)
    figure = figures.new_figure(figsize=(10, 5.5), layout="compressed")
    for axes, (label, (field, colours, norm)) in zip(figure.subplots(1, len(panels), sharey=True), panels.items()):
        figures.field_image(axes, x, y[part], field[near][:, part], colours, label, norm=norm)
        for edge in (-half_width, half_width):
            axes.axvline(edge * 1e6, color=figures.GREY, lw=0.8, ls="--")
        axes.label_outer()
    some = f"; {1e6 * np.ptp(y[part]):.0f} of {1e6 * y[-1]:.0f} µm of the line" if part != slice(None) else ""
    figure.suptitle(f"U = {point.speed:g} m/s{some}; dashed: Hertz strip", fontsize=10)
    figure.savefig(path, dpi=150)


def _part(x: np.ndarray, y: np.ndarray, row: int) -> slice:
    """The rows of ``y`` to draw: all, or of long strips those around ``row``, twice as long as ``x`` is wide."""
    across = x[-1] - x[0]
    if y[-1] < WHOLE * across:
        return slice(None)
    first = min(max(y[row] - across, 0.0), y[-1] - 2 * across)
    return slice(int(np.searchsorted(y, first)), int(np.searchsorted(y, first + 2 * across)) + 1)


def plot_history(path: Path, columns: dict[str, np.ndarray], title: str) -> None:
    """Speed and load, film, shares of the load, and friction over time, from the columns of history.csv."""
    c = columns
    t = c["time"] * time_scale(c["time"][-1])[0]
    figure = figures.new_figure(figsize=(7.5, 9))
    first, second, third, fourth = figure.subplots(4, 1, sharex=True)
    first.plot(t, c["entrainment_speed"], color="k")
    first.axhline(0.0, color=figures.GREY, lw=0.6)
    first.set_ylabel("entrainment speed U (m/s)")
    figure.suptitle(figures.plain_words(title))
    load = first.twinx()
    load.plot(t, c["load"], color=figures.GREY, lw=1.2, ls="--")
    load.set_ylim(0.0, 1.15 * c["load"].max())
    load.set_ylabel("load $F_T$ (N), dashed", color=figures.GREY)
    for name, label, style in (
        ("central_film", "central film", {"color": figures.GREEN}),
        ("min_film", "minimum film", {"color": figures.GREEN, "lw": 1, "ls": "--"}),
        ("mean_gap", "mean gap over A", {"color": figures.GREY, "lw": 0.9, "ls": ":"}),
    ):
        second.plot(t, c[name] * 1e9, label=label, **style)
    second.set(ylabel="film thickness (nm)", ylim=(0.0, None))
    figures.load_shares(third, t, c["contact_load"] / c["load"])
    for axes in (second, third):
        figures.key_above(axes)
    error = c.get("sampling_error", np.zeros(0))
    if np.any(error > 0):
        low, high = (c["coefficient"] * (1 + sign * 2 * error) for sign in (-1, 1))
        fourth.fill_between(t, low, high, color=figures.BLUE, alpha=0.2, lw=0, label="95 %: finite surface alone")
    friction_over_time(fourth, c)
    fourth.set_xlim(t[0], t[-1])
    figure.savefig(path, dpi=150)


PICTURES: dict[str, Callable] = {"stribeck": plot_stribeck, "traction": plot_traction, "history": plot_history}
