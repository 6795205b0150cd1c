"""Pictures of a run: the curve, the surface, and what changes in time."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Sequence
from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base import FloatArray, figures
from ..errors import InputError
from ..samples import is_extended, is_measured
from ..studies import OF_TOLERANCES, OVER_X, friction_over_speed, gaps_of, interval_band, mark_models
from ..time import (
    add_angle_axis,
    band_label,
    friction_over_time,
    in_motion,
    sense_of_friction_over_time,
    time_scale,
)
from ..units import converted, printed, unit_for, worded
from .contact_pictures import PANEL_GAP, are_stacked, drawn_part, part_in_words, size_of_maps
from .picture_options import PANELS, X_LABELS, PictureOptions
from .point_picture import draw_point

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from ..models.shared import Prepared
    from ..time import TransientResult


# What the text below the curve lists.
NOT_FULFILLED = "Assumptions of the model that the marked points do not fulfil (see the warnings)"

# This line for a single point, which needs no mark.
NOT_FULFILLED_HERE = "Assumptions of the model that this point does not fulfil (see the warnings)"

# Choices, by looking at the figures.
FRAMES = 150  # of an animation at most, spread over the run
PANEL_HEIGHTS = {"friction": 3.0, "load": 1.5, "film": 2.0, "temperature": 1.5}  # inch, at the usual width
LEAST_OF_PANEL = 0.5  # of the height of a panel, without its labels and the key above it
HISTORY_HEIGHTS = (1.7, 1.8, 1.5, 1.8)  # inch, at the usual width: speeds, films, load ratios, f
LAST_HEIGHT = 1.4  # inch, at the usual width: of friction force and power loss
LONE = 2.0  # factor between a lone speed and the ends of its axis
BEARING_WIDTH = 4.0  # inch: of a bearing curve
BESIDE_HEIGHTS = (2.6, 4.5)  # inch: of a map and a bearing curve beside each other
SURFACE_PAD = 0.05  # inch around a map and its bearing curve
LENGTH_ROUNDING = 1e-9  # of the length of a map
LEAST_ROWS = 32  # along y, of a map of which a part along x is drawn: fewer show too little of it
QUANTILES = 401  # of the heights, of a bearing curve
LETTERS_OF_INCH = 13.0  # of the text below a curve, in an inch of its width


@figures.styled
def plot_stribeck(
    path: Path,
    columns: dict[str, np.ndarray],
    title: str,
    violations: Sequence[Sequence[Any]],
    measured: Any = None,
    options: PictureOptions = PictureOptions(),
    operating_point: float = np.nan,
) -> None:
    """Draw f, the load ratios and the film over the entrainment speed.

    ``columns``: arrays by name as `lubfric._base.read_table` gives them; speeds that failed are omitted.
    ``violations``: for each row, the assumptions that are violated (`lubfric.Violation`). ``measured``: a
    `lubfric.Measured`, drawn with the curve. ``operating_point``: the solved speed [m/s] that is the scene's own; NaN
    marks none.
    """
    panels = [name for name in PANELS["stribeck"] if name in options.panels]
    good = np.isfinite(columns["coefficient"]) & (columns["speed"] != 0)
    order = np.flatnonzero(good)[np.argsort(np.abs(columns["speed"][good]))]
    c = type(columns)((name, column[order]) for name, column in columns.items())
    speed = c.get(OVER_X, np.abs(c["speed"]))
    if _is_point(order, measured, options):
        place = f"U = {worded(float(c['speed'][0]), 'm/s')}"
        _save_point(path, c, panels, f"{title}\n{place}", [violations[i] for i in order], options)
        return
    figure, axes = _panels(panels, options)
    shown = [*axes.values()]
    if "friction" in axes:
        top = axes["friction"]
        friction_over_speed(
            top, columns, has_parts=options.has_parts, as_bars=options.has_bars, without=options.without
        )
        _draw_measured(top, measured)
        if figures.OPERATING_POINT_MARK not in options.without:
            _mark_operating_point(top, c["speed"], speed, c["coefficient"], operating_point)
        _mark(figure, top, speed, c["coefficient"], [violations[i] for i in order], options)
        top.set(xlabel="")
    figures.head(figure, title if options.has_title else "")
    if "load" in axes:
        figures.load_shares(axes["load"], speed, c["contact_load"] / (c["contact_load"] + c["film_load"]))
        figures.key_above(axes["load"])
    if "film" in axes:
        _films(axes["film"], speed, c)
    last = shown[-1]
    last.set(xscale="log", xlabel=X_LABELS[options.x] or figures.speed_label(c["speed"]))
    if speed.size == 1:  # a narrow bar in the middle, beside what was measured
        last.set_xlim(speed[0] / LONE, speed[0] * LONE)
    options.scale(last, friction=axes.get("friction"), f=c["coefficient"])
    for each in shown:
        figures.plain_ticks(each.xaxis)
    options.thin(figure)
    _save_panels(path, figure, panels, options)


def _is_point(order: np.ndarray, measured: Any, options: PictureOptions) -> bool:
    """Return whether one point is drawn, in the places ``order`` of a table, with nothing else over an axis of speeds
    or ratios and no scale of an axis chosen."""
    return order.size == 1 and measured is None and options.x_scale is None and options.y_scale is None


def _save_point(
    path: Path,
    columns: dict[str, np.ndarray],
    panels: list[str],
    title: str,
    violations: list[Sequence[Any]],
    options: PictureOptions,
) -> None:
    """Save the picture of the one point in ``columns``, with its ``violations`` below it."""
    figure = draw_point(columns, panels, options)
    figures.head(figure, title if options.has_title else "")
    _list_assumptions(figure, _shown_violations(violations, options))
    options.thin(figure)
    figures.fit_labels(figure)
    figure.savefig(path)


def _draw_measured(axes: Axes, measured: Any, *, is_signed: bool = False) -> None:
    """Draw a `lubfric.Measured` among the lines of a curve; None draws nothing. ``is_signed``: the axis has slide-roll
    ratios of both signs, not magnitudes."""
    if measured is None:
        return
    measured.draw(axes, is_signed=is_signed)
    axes.set_ylim(bottom=min(axes.get_ylim()[0], 1.1 * measured.coefficient.min()))


def _mark_operating_point(
    axes: Axes, solved: np.ndarray, x: np.ndarray, coefficient: np.ndarray, operating_point: float
) -> None:
    """Mark f at the ``operating_point``, one of the ``solved`` speeds or ratios, at its ``x`` of the axis; NaN marks
    none."""
    own = solved == operating_point
    if own.any():
        axes.plot(x[own], coefficient[own], "*", color="k", ms=9, label=figures.OPERATING_POINT_MARK)


def _films(axes: Axes, speed: np.ndarray, c: dict[str, np.ndarray]) -> None:
    """Draw the full-load film thickness and the central separation over ``speed``, or a slide-roll ratio, and the
    roughness to compare."""
    separation = c["central_film"]
    film = c.get("full_load_film", np.full(speed.shape, np.nan))
    unit = unit_for(separation.tolist(), "m")
    scale = 1.0 / converted(1.0, unit, "m")
    if np.isfinite(film).any():
        axes.plot(speed, film * scale, "o-", color=figures.GREEN, ms=4, label="full-load film thickness")
    axes.plot(speed, separation * scale, "s--", color=figures.BLUE, ms=3, lw=1, label="central separation")
    sq = separation / c["film_to_roughness_ratio"]
    if np.isfinite(sq).all() and (sq > 0).all():  # not of smooth surfaces
        for times, dashes, name in (
            (1, "--", f"$Λ$ = 1 (Sq of solved surface {worded(float(sq[0]), 'm')})"),
            (3, ":", "$Λ$ = 3"),
        ):
            axes.axhline(times * sq[0] * scale, color=figures.GREY, lw=0.8, ls=dashes, label=name)
    figures.key_above(axes, 2)
    axes.set(yscale="log", ylabel=f"film thickness ({printed(unit)})")
    figures.plain_ticks(axes.yaxis)


@figures.styled
def plot_traction(
    path: Path,
    columns: dict[str, np.ndarray],
    title: str,
    violations: Sequence[Sequence[Any]],
    measured: Any = None,
    options: PictureOptions = PictureOptions(),
    operating_point: float = np.nan,
) -> None:
    """Draw f, the load ratios and the film over the slide-roll ratio, and below, where they were computed,
    temperatures. Arguments as of `plot_stribeck`."""
    good = np.flatnonzero(np.isfinite(columns["coefficient"]))
    order = good[np.argsort(columns["ratio"][good])]
    c = type(columns)((name, column[order]) for name, column in columns.items())
    ratio = c["ratio"]
    warm = bool((c["flash_temperature_rise"] > 0).any() or (c["film_temperature_rise"] > 0).any())
    panels = [name for name in PANELS["traction"] if name in options.panels and (warm or name != "temperature")]
    if not panels:
        raise InputError(
            "--panels temperature: the curve has no temperatures, which its runs have not computed; omit it"
        )
    if _is_point(order, measured, options):
        place = f"slide-roll ratio {ratio[0]:.4g}"
        _save_point(path, c, panels, f"{title}\n{place}", [violations[i] for i in order], options)
        return
    figure, axes = _panels(panels, options)
    if "friction" in axes:
        top = axes["friction"]
        traction_over_ratio(top, c, options)
        _draw_measured(top, measured, is_signed=bool((ratio < 0).any()))
        if figures.OPERATING_POINT_MARK not in options.without:
            _mark_operating_point(top, ratio, ratio, c["coefficient"], operating_point)
        _mark(figure, top, ratio, c["coefficient"], [violations[i] for i in order], options)
    figures.head(figure, title if options.has_title else "")
    if "load" in axes:
        figures.load_shares(axes["load"], ratio, c["contact_load"] / (c["contact_load"] + c["film_load"]))
        figures.key_above(axes["load"])
    if "film" in axes:
        _films(axes["film"], ratio, c)
    if "temperature" in axes:
        _temperatures(axes["temperature"], ratio, c)
    last = axes[panels[-1]]
    last.set_xlabel("slide-roll ratio (-)")
    figures.log_if_wide(last, "x", ratio)
    options.scale(last, friction=axes.get("friction"), f=c["coefficient"])
    figures.plain_ticks(last.xaxis)
    options.thin(figure)
    _save_panels(path, figure, panels, options)


def _save_panels(path: Path, figure: Figure, panels: list[str], options: PictureOptions) -> None:
    """Save a ``figure`` of ``panels``, higher where the key above them and the text below them would leave one of them
    less than `LEAST_OF_PANEL`."""
    (_, lowest) = options.size([min(PANEL_HEIGHTS[name] for name in panels)])
    figures.lay_out(figure)
    figures.heighten(figure, LEAST_OF_PANEL * lowest)
    figures.fit_labels(figure)
    figure.savefig(path)


def _panels(panels: list[str], options: PictureOptions) -> tuple[Figure, dict[str, Axes]]:
    """Return a figure with these ``panels`` one above the other, and their axes by name."""
    heights = [PANEL_HEIGHTS[name] for name in panels]
    figure = figures.new_figure(figsize=options.size(heights))
    shown = figure.subplots(len(panels), 1, sharex=True, squeeze=False, height_ratios=heights)[:, 0]
    return figure, dict(zip(panels, shown))


def traction_over_ratio(
    axes: Axes,
    columns: dict[str, np.ndarray],
    options: PictureOptions,
    *,
    label: str = figures.FRICTION_COEFFICIENT,
    color: str = figures.BLUE,
    others: int = 0,
    models: Collection[str] = (),
) -> None:
    """Draw f, its interval and its parts over the slide-roll ratio, from the ``columns`` of a traction curve by
    ascending ratio; f as ``label`` in the ``color``, which the interval has too. ``others``: as of
    `lubfric.studies.interval_band`; ``models``: as of `lubfric.studies.mark_models`."""
    c = columns
    gaps = _draw_gaps(axes, c, color)
    numbers = {name: column for name, column in c.items() if np.asarray(column).dtype.kind in "fiu"}
    broken = {name: np.insert(column.astype(float), gaps, np.nan) for name, column in numbers.items()}
    shown_as: dict[str, Any] = {"has_parts": options.has_parts, "as_bars": options.has_bars}
    interval_band(axes, broken["ratio"], broken, color=color, others=others, **shown_as)
    load = c["contact_load"] + c["film_load"]
    shown = (c["coefficient"], c["boundary_force"] / load, c["shear_force"] / load)
    parts = [np.insert(part, gaps, np.nan) for part in shown]
    style: dict[str, Any] = {"label": label, "color": color, "marker": "o", "ms": 4}
    figures.friction_lines(axes, broken["ratio"], parts, without=options.without, **style)
    mark_models(axes, c["ratio"], c, color, models)
    axes.set_ylabel(figures.FRICTION_LABEL)


def _temperatures(axes: Axes, ratio: np.ndarray, c: dict[str, np.ndarray]) -> None:
    """Draw the largest temperature rises of surfaces and film over the slide-roll ``ratio``."""
    line = "-" if ratio.size > 1 else "o"
    axes.plot(ratio, c["flash_temperature_rise"], line, color=figures.RED, label="surfaces (flash temperature)")
    axes.plot(ratio, c["film_temperature_rise"], line, color=figures.GREEN, label="film, above the surfaces")
    axes.set(ylabel="largest temperature rise (K)")
    figures.key_above(axes)


def _draw_gaps(axes: Axes, columns: dict[str, np.ndarray], color: str) -> list[int]:
    """Dot the line of f, of the ``color``, where its points do not show it between them, and bar the intervals of
    points that no line joins. ``columns``: of a traction curve, by ascending ratio. Returns the places before which
    lines and bands end."""
    ratio = columns["ratio"]
    f = columns["coefficient"]
    unknown = np.full(ratio.shape, np.nan)
    low, high = (columns.get(f"interval_{end}", unknown) for end in ("low", "high"))
    ends = []
    slips = np.abs(ratio)
    label: str | None = figures.NOT_BETWEEN
    for gap in gaps_of(ratio, f, 0.5 * (high - low)):
        place = int(np.argmin(np.abs(slips - gap.low)))
        other = int(np.argmin(np.abs(slips - gap.high)))
        pair = sorted((place, other))
        axes.plot(ratio[pair], f[pair], ":", color=color, lw=1.0, label=label)
        ends.append(pair[1])
        label = None
    pieces = np.split(np.arange(ratio.size), sorted(ends))
    lone = [int(piece[0]) for piece in pieces if piece.size == 1 and ratio.size > 1]
    axes.vlines(ratio[lone], low[lone], high[lone], color=color, alpha=0.4, lw=3)
    return sorted(ends)


def _mark(
    figure: Figure,
    axes: Axes,
    speed: FloatArray,
    coefficient: FloatArray,
    violations: list[Sequence[Any]],
    options: PictureOptions,
) -> None:
    """Ring the points with a warning, and cross out those at which f is meaningless. The text below says which
    assumptions are violated there. Then the key of all lines."""
    ring_points(axes, speed, coefficient, violations, options)
    _list_assumptions(figure, _shown_violations(violations, options))
    figures.key_above(axes)


def ring_points(
    axes: Axes,
    x: FloatArray,
    coefficient: FloatArray,
    violations: list[Sequence[Any]],
    options: PictureOptions,
) -> None:
    """Ring the points at ``x`` with a warning among their ``violations``, and cross out those at which f is
    meaningless."""
    violations = _shown_violations(violations, options)
    severe = np.array([any(violation.severe for violation in violated) for violated in violations], dtype=bool)
    minor = np.array([len(violated) > 0 for violated in violations], dtype=bool) & ~severe
    for chosen, marker, color, label in (
        (minor, "o", figures.GREY, "with warnings"),
        (severe, "x", figures.RED, "outside the model (accepted)"),
    ):
        if chosen.any():
            axes.plot(x[chosen], coefficient[chosen], marker, ms=9, mfc="none", mec=color, label=label)


def _shown_violations(violations: list[Sequence[Any]], options: PictureOptions) -> list[Sequence[Any]]:
    """Return those of the ``violations`` of each point that a picture shows: no notes, and warnings unless omitted."""
    return [
        [violation for violation in violated if violation.severe or (options.has_warnings and not violation.is_note)]
        for violated in violations
    ]


def _list_assumptions(figure: Figure, violations: list[Sequence[Any]]) -> None:
    """List below ``figure`` which assumptions are violated, and at how many points; errors of f are none."""
    counts = Counter(
        name
        for violated in violations
        for name in {each.assumption or each.what for each in violated if each.assumption not in OF_TOLERANCES}
    )
    if not counts:
        return
    named = (
        what.rstrip(",") + ("" if n == len(violations) else f" ({n} of {len(violations)} points)")
        for what, n in counts.items()
    )
    head = NOT_FULFILLED if len(violations) > 1 else NOT_FULFILLED_HERE
    text = fill(f"{head}: {'; '.join(named)}", int(LETTERS_OF_INCH * figure.get_figwidth()))
    figure.supxlabel(text, fontsize="small", color=figures.GREY)


def _drawn_along_motion(counts: tuple[int, int], spacing: tuple[float, float]) -> int:
    """Return how many of ``counts`` points along x are drawn of a map [m]: all, or of one that is too long along x to be
    drawn to scale, and has `LEAST_ROWS`, as many as can."""
    if counts[1] < LEAST_ROWS:
        return counts[0]
    longest = figures.SLENDER_MAP * counts[1] * spacing[1] / spacing[0]
    return min(counts[0], int(longest * (1 - LENGTH_ROUNDING)))


@figures.styled
def plot_surface(path: Path, prepared: Prepared) -> None:
    """Draw the map that the scene of ``prepared`` has, to scale: of generated strips the first, as two of them beside
    each other have a seam, of a measured map that is continued by its mirror image the measured part, and of a long
    line the beginning; and the bearing (Abbott-Firestone) curve of the whole of it."""
    sample = prepared.sample
    surface = sample.whole_map
    (before, *others) = sample.maps_before_extension
    is_mirrored = is_extended(prepared.scene) and before.shape != surface.shape
    if is_mirrored and not others:
        surface = before
    is_one_of_strips = sample.first_strips > 1 and not is_measured(prepared.scene)
    drawn = sample.strip(0) if is_one_of_strips else surface
    whole = f"the first of {sample.first_strips} strips" if is_one_of_strips else "the map"
    if is_mirrored:
        whole = "both maps with their mirror images" if others else "the measured part; its mirror image continues it"
    x, y = (np.arange(count) * step for count, step in zip(drawn.shape, drawn.spacing))
    whole_x = x
    part = drawn_part(x, y, 0)
    x = x[: _drawn_along_motion((x.size, y[part].size), drawn.spacing)]
    higher = np.linspace(0.0, 1.0, QUANTILES)
    (width, height) = size_of_maps(x, y[part], 1)
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    engine = ConstrainedLayoutEngine(w_pad=PANEL_GAP)
    if are_stacked(x, y[part]):
        figure = figures.new_figure(figsize=(width, height + BEARING_WIDTH), layout=engine)
        above, bearing = figure.subplots(2, 1, height_ratios=(height, BEARING_WIDTH))
    else:
        figure = figures.new_figure(
            figsize=(width + BEARING_WIDTH, float(np.clip(height, *BESIDE_HEIGHTS))), layout=engine
        )
        above, bearing = figure.subplots(1, 2, width_ratios=(width, BEARING_WIDTH))
    drawn.cropped((x.size, y[part].size), (0, 0)).plot(above)
    above.set_xlabel("x (µm), along the motion")
    texts = [part_in_words(whole_x, slice(x.size), f"{whole} along x")] if x.size < whole_x.size else []
    texts += [part_in_words(y, part, whole)]
    shown = "".join(texts).removeprefix("; ") or (whole if is_one_of_strips or is_mirrored else "")
    above.set_title("\n".join(filter(None, (above.get_title(), shown))), fontsize=10)
    heights = 1e9 * (np.quantile(surface.measured, 1 - higher) - surface.measured.mean())
    bearing.plot(100 * higher, heights, color=figures.BLUE)
    bearing.set(xlim=(0, 100), xlabel="bearing area (%)", ylabel="height (nm)")
    bearing_of = "all strips" if is_one_of_strips else "complete map"
    if is_mirrored and not others:
        bearing_of = "measured part"
    bearing.set_title(
        f"{bearing_of}:\nSq = {1e9 * surface.sq:.4g} nm, Ssk = {surface.ssk:.3g}",
        fontsize=10,
    )
    figure.savefig(
        path, bbox_inches="tight", pad_inches=SURFACE_PAD
    )  # a map to scale may be lower than its part of the figure


# Ratio of the thickest to the thinnest film of a run in time above which their axis is logarithmic, and the film [m]
# below which none is drawn there, less than a molecule. Choices, by looking at the figures.
WIDE_SPAN_OF_FILMS = 30.0
THINNEST_DRAWN = 1e-10


@figures.styled
def plot_history(
    path: Path, columns: dict[str, np.ndarray], title: str, options: PictureOptions = PictureOptions()
) -> None:
    """Draw speeds and load, film, load ratios, f, friction force and, where it is known, the power loss over time, from
    the columns of history.csv."""
    c = columns
    t = c["time"] * time_scale(c["time"][-1])[0]
    further = [_force_over_time] if "friction_force" in c else []
    if "power_loss" in c and np.any(c["power_loss"] > 0):
        further.append(_power_over_time)
    heights = [*HISTORY_HEIGHTS, *([LAST_HEIGHT] * len(further))]
    figure = figures.new_figure(figsize=options.size(heights))
    first, second, third, fourth, *others = figure.subplots(len(heights), 1, sharex=True)
    first.plot(t, c["entrainment_speed"], color="k", label="entrainment speed $U$")
    first.plot(t, c["sliding_speed"], color=figures.BLUE, ls=":", label="sliding speed $u_2 - u_1$")
    first.axhline(0.0, color=figures.GREY, lw=0.6)
    first.set_ylabel("speed (m/s)")
    figures.head(figure, title if options.has_title else "")
    load = first.twinx()
    load.grid(visible=False)
    load.spines["right"].set_visible(True)
    load.plot(t, c["load"], color=figures.GREY, lw=1.2, ls="--")
    load.set_ylim(0.0, 1.15 * c["load"].max())
    load.set_ylabel("load $F_T$ (N), dashed", color=figures.GREY)
    _films_over_time(second, t, c)
    figures.load_shares(third, t, c["contact_load"] / c["load"])
    for axes in (first, second, third):
        figures.key_above(axes)
    low, high = (c.get(f"interval_{end}", np.zeros(0)) for end in ("low", "high"))
    if np.isfinite(low).any():
        fourth.fill_between(t, low, high, color=figures.BLUE, alpha=0.2, lw=0, label=band_label(c))
    friction_over_time(fourth, c)
    time_label = fourth.get_xlabel()
    for axes, draw in zip(others, further):
        draw(axes, t, c)
    for axes in (fourth, *others):
        axes.set_xlabel("")
    (fourth, *others)[-1].set_xlabel(time_label)
    fourth.set_xlim(t[0], t[-1])
    add_angle_axis((fourth, *others)[-1], c)
    options.scale(fourth, friction=fourth, f=c["coefficient"])
    options.thin(figure)
    figures.fit_labels(figure)
    figure.savefig(path)


def _films_over_time(axes: Axes, t: np.ndarray, c: dict[str, np.ndarray]) -> None:
    """Draw the films over the times ``t`` of an axis, on a logarithmic one where they span more than
    `WIDE_SPAN_OF_FILMS`. Of these the solved films count, because the full-load film falls to 0 at a reversal."""
    unit = unit_for(c["central_film"].tolist(), "m")
    scale = 1.0 / converted(1.0, unit, "m")
    lines: tuple[tuple[str, str, dict[str, Any]], ...] = (
        ("full_load_film", "full-load film in steady motion", {"color": figures.BLUE, "lw": 1}),
        ("central_film", "central separation", {"color": figures.GREEN, "lw": 3.2, "alpha": 0.45}),
        ("min_film", "smallest film", {"color": "k", "lw": 1, "ls": "--"}),
        ("mean_gap", "mean separation over the Hertz strip", {"color": figures.RED, "lw": 1.2, "ls": ":"}),
    )
    for name, label, style in lines:
        if name in c:
            axes.plot(t, c[name] * scale, label=label, **style)
    films = np.concatenate([c[name] for name, *_ in lines[1:] if name in c])
    films = films[films > THINNEST_DRAWN]
    axes.set(ylabel=f"film thickness ({printed(unit)})", ylim=(0.0, None))
    if films.size and films.max() > WIDE_SPAN_OF_FILMS * films.min():
        axes.set(yscale="log", ylim=(0.8 * films.min() * scale, None))
        figures.plain_ticks(axes.yaxis)


def _force_over_time(axes: Axes, t: np.ndarray, c: dict[str, np.ndarray]) -> None:
    """Draw the friction force on surface 2 over the times ``t`` of an axis, with the band of its intervals;
    none at rest, where it may have any value up to that of the first slip."""
    moving = in_motion(c)
    unit = unit_for(c["friction_force"][moving].tolist(), "N")
    if np.isfinite(c.get("interval_low", np.zeros(0))).any():
        ends = (c[f"interval_{end}"] * c["load"] * sense_of_friction_over_time(c) for end in ("low", "high"))
        (first, second) = (converted(end, "N", unit) for end in ends)
        axes.fill_between(t, first, second, color=figures.BLUE, alpha=0.2, lw=0, label=band_label(c))
    force = np.where(moving, converted(c["friction_force"], "N", unit), np.nan)
    axes.plot(t, force, color=figures.BLUE, lw=1.2, label="friction force on surface 2, positive along −x")
    axes.axhline(0.0, color=figures.GREY, lw=0.6)
    axes.set(ylabel=f"force ({printed(unit)})")
    figures.key_above(axes)


def _power_over_time(axes: Axes, t: np.ndarray, c: dict[str, np.ndarray]) -> None:
    """Draw the power loss over the times ``t`` of an axis, with the band of its intervals."""
    low, high = (c.get(f"power_loss_{end}", np.full(t.shape, np.nan)) for end in ("low", "high"))
    unit = unit_for(c["power_loss"].tolist(), "W")
    if np.isfinite(low).any():
        (below, above) = (converted(end, "W", unit) for end in (low, high))
        axes.fill_between(t, below, above, color=figures.RED, alpha=0.2, lw=0, label=band_label(c))
    axes.plot(t, converted(c["power_loss"], "W", unit), color=figures.RED, lw=1.2, label="power loss")
    axes.set(ylabel=f"power loss $P$ ({printed(unit)})", ylim=(0.0, None))
    figures.key_above(axes)


@figures.styled
def animate(path: Path, result: TransientResult, half_width: float) -> None:
    """Write a GIF of pressure and film along the contact over time."""
    count = result.time.size
    x = result.x
    h = result.film_thickness
    radius = (x[0] ** 2 - x[1] ** 2) / (2.0 * (h[0, 0] - h[0, 1]))  # of the undeformed gap, far out
    reach = 3.0 * max(half_width, float(np.sqrt(h.min(axis=1).max() * 2.0 * radius)))
    seen = np.abs(x) <= reach
    micro = x[seen] * 1e6
    pressures, pressure_unit = figures.in_unit_for(result.pressure[:, seen], "Pa")
    highest = 1.5 * max(float(np.nanmax(result.central_film)), 2.0 * float(np.median(h[:, seen].min(axis=1))))
    film_unit = unit_for([highest], "m")
    films = converted(h[:, seen], "m", film_unit)
    figure = figures.new_figure(figsize=(7, 4.5))
    top = figure.subplots()
    bottom = top.twinx()
    bottom.grid(visible=False)
    bottom.spines["right"].set_visible(True)
    (pressure,) = top.plot([], [], color=figures.RED)
    (film,) = bottom.plot([], [], color=figures.BLUE)
    top.set(xlim=(micro[0], micro[-1]), ylim=(0.0, 1.1 * pressures.max() or 1.0), xlabel="x (µm), along the motion")
    top.set_ylabel(f"film pressure ({pressure_unit})", color=figures.RED)
    bottom.set_ylim(0.0, converted(highest, "m", film_unit))
    bottom.set_ylabel(f"film thickness ({printed(film_unit)})", color=figures.BLUE)
    scale, unit = time_scale(result.time[-1])
    moving = in_motion(result.columns)

    def draw(i: int) -> tuple[Any, Any]:
        pressure.set_data(micro, pressures[i])
        film.set_data(micro, films[i])
        friction = f"f = {result.coefficient[i]:z.4f}" if moving[i] else "at rest: no f"
        moment = f"t = {result.time[i] * scale:.4g} {unit},  U = {result.entrainment_speed[i]:.3g} m/s,  {friction}"
        top.set_title(moment, fontsize=10)
        return pressure, film

    draw(0)
    figure.canvas.draw()
    figure.set_layout_engine("none")  # laid out once: the frames must not jump, and are drawn faster
    frames = np.unique(np.linspace(0, count - 1, min(FRAMES, count)).round().astype(int)).tolist()
    figures.animated(path, figure, draw, frames, 15, 80)
