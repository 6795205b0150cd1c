"""The effects of the inputs of a study on f, where no lines could tell all its points apart: a panel for each input,
with the mean of f at each of its values and the range of f over all other inputs."""

from __future__ import annotations

from textwrap import fill
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from .. import studies
from .._base import figures
from ..models.shared import percent
from ..quantities import worded_value
from .change_panels import chains_of, draw_chains, handles_of_chains, show_ends
from .picture_options import THINNER, PictureOptions

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Speeds up to which f is drawn over the inputs, in a colour for each speed; of more it is drawn over the speed. A
# choice, by looking at the figures.
FEW_SPEEDS = 4

# Values of an input that have a colour each, at most; else its points are in as many groups of equal size as `GROUPS`.
# Choices, by looking at the figures.
MOST_COLOURS = 5
GROUPS = 3

# Points from which their middle half is drawn. A choice: fewer have no quartiles worth the name.
LEAST_FOR_QUARTILES = 5

# Distance of the marks of two speeds over one value, as a part of the axis. A choice, by looking at the figures.
APART = 0.03

# Speeds of a common axis for curves that chose their own. A choice, by looking at the figures.
COMMON_SPEEDS = 40

# Points of a study up to which panels show those that differ in one input alone. A choice: of more, others say more.
MOST_CHAINED = 12

# Panels, at most: of the inputs with the largest parts of the variance. A choice, by looking at the figures.
MOST_EFFECTS = 8

# Height of a row of panels at the usual width [inch]. Chosen by looking at the figures.
ROW_HEIGHT = 2.6

# Panels side by side, at most, in a picture of the usual width and in a narrow one. Chosen by looking at the figures.
PANELS_IN_A_ROW = 3
NARROW_PANELS_IN_A_ROW = 2

# Width of a panel over its part of the figure. A choice, by looking at the figures.
PANEL_ROOM = 0.75

# Part of the variance below which it is not stated as a number. A choice: smaller ones are rounding.
LEAST_SHARE = 0.01

# Letters in a row of the key below the panels, of the usual width and of a narrow one. Chosen by looking at the
# figures.
KEY_LETTERS = 105
NARROW_KEY_LETTERS = 62

# Sizes of the marks of a point and of a mean [pt]. Choices, by looking at the figures.
POINT_SIZE = 2.2
MEAN_SIZE = 3.5

# Why marks are not at their value on the axis x.
SIDE_BY_SIDE = "at each value the colours are side by side"
MEAN = "mean over all other inputs"
MIDDLE = "middle half of the points"
RANGE_OF_POINTS = "range of the points"


class Group(NamedTuple):
    """Points of a picture that have one colour.

    ``name``: their label, "" for all points of a study; ``rows``: where they are in its columns.
    """

    name: str
    rows: np.ndarray


def draw_effects(result: studies.StudyResult, keys: list[str], options: PictureOptions) -> Figure:
    """Return a figure with a panel for each of the ``keys``, that of the largest part of the variance of ln f first.

    Where the study has at most `FEW_SPEEDS` speeds, or each point its own, f is drawn over the key, in a colour for
    each speed; else over the speed, in a colour for each value of the key, or for the low, middle and high ones.
    """
    shares = studies.main_effects(result)
    are_separated = not studies.why_not_separated(result)
    ordered = [*(key for key in shares if key in keys), *(key for key in keys if key not in shares)]
    columns = _columns(result)
    speeds = np.unique(columns[studies.SPEED])
    over_speed = not result.paired and speeds.size > FEW_SPEEDS
    inputs = [key for key in ordered if key != studies.SPEED or result.paired][:MOST_EFFECTS]
    most = NARROW_PANELS_IN_A_ROW if options.is_narrow else PANELS_IN_A_ROW
    rows = -(-len(inputs) // most)
    across = -(-len(inputs) // rows)
    figure = figures.new_figure(figsize=options.size([ROW_HEIGHT] * rows))
    panels = figure.subplots(rows, across, sharey=True, squeeze=False).ravel()
    letters = figures.SMALL_KEY_SIZE if options.is_narrow else figures.KEY_SIZE
    room = int(
        72.0 * PANEL_ROOM * figure.get_figwidth() / across / (figures.TITLE_LETTER * letters)
    )  # letters above a panel
    of_speeds = [Group(name="", rows=np.arange(columns[studies.SPEED].size))]
    if not result.paired and speeds.size > 1:
        of_speeds = _groups(columns[studies.SPEED])
    chains = chains_of(result) if not (over_speed or shares or result.status.size > MOST_CHAINED) else {}
    ends = []
    for number, (axes, key) in enumerate(zip(panels, inputs)):
        if key in chains:
            ends.append(draw_chains(axes, result, key, chains[key]))
        elif over_speed:
            (shown, label) = _shown(key, columns[key])
            _draw_over_speed(axes, columns, _groups(shown))
            heads = [fill(text, room) for text in (label, _share_in_words(key, shares)) if text]
            axes.get_legend().set_title("\n".join(heads), {"size": letters})
            axes.get_legend().set_alignment("left")
        else:
            has_means = are_separated and not (studies.is_scattered(result, key) and columns[key].dtype.kind in "fi")
            width = THINNER if options.is_narrow else 1.0
            _draw_over_key(axes, columns, key, of_speeds, has_means=has_means, width=width)
            axes.set_title(fill(_share_in_words(key, shares), room), fontsize=letters)
        axes.set_ylabel("" if number % across else figures.FRICTION_LABEL)
    for axes in panels[len(inputs) :]:
        axes.set_visible(False)
    if ends and len(ends) == len(inputs):
        show_ends(panels[0], ends)
    handles = handles_of_chains(result, panels[0]) if ends else []
    _key_below(figure, columns, of_speeds if not over_speed else [], options, handles)
    return figure


def _columns(result: studies.StudyResult) -> dict[str, np.ndarray]:
    """Return the points of a study with a known f, (n,), by the magnitude of their speed; of curves that chose their
    speeds, each at common ones."""
    columns = studies.columns_of_study(result)
    known = np.isfinite(columns["coefficient"])
    shown = {name: values[known] for name, values in columns.items()}
    shown[studies.SPEED] = np.abs(shown[studies.SPEED])
    return _at_common_speeds(result, shown) if result.chosen else shown


def _at_common_speeds(result: studies.StudyResult, shown: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Return the curves of a study at common speeds, those at which most curves are known, as a mean of others would
    jump; the points that are ``shown`` if there are no curves."""
    used = shown[studies.SPEED][shown[studies.SPEED] > 0]
    grid = np.geomspace(used.min(), used.max(), COMMON_SPEEDS)
    curves = {index: result.curve(index) for index in np.ndindex(*result.status.shape[:-1])}
    known = {index: curve for index, curve in curves.items() if curve is not None}
    counts = sum((curve.within(curve.sense * grid).astype(int) for curve in known.values()), np.zeros(grid.size, int))
    common = grid[counts == counts.max()]
    parts: dict[str, list[np.ndarray]] = {}
    for index, curve in known.items():
        speeds = common[curve.within(curve.sense * common)]
        row: dict[str, Any] = {studies.SPEED: speeds, "coefficient": curve.at(speeds)}
        for key, (dim, values) in result.coords.items():
            row[key] = np.repeat(values[index[result.dims.index(dim)]], speeds.size)
        for name, values in row.items():
            parts.setdefault(name, []).append(values)
    return {name: np.concatenate(arrays) for name, arrays in parts.items()} or shown


def _share_in_words(key: str, shares: dict[str, Any]) -> str:
    """Return the part of the variance of ln f that a ``key`` has by itself, as text; "" where that is not known."""
    if key not in shares:
        return ""
    share = shares[key].share
    return (
        f"{percent(share) if share >= LEAST_SHARE else f'below {percent(LEAST_SHARE)}'} of the variance of "
        f"ln\N{NO-BREAK SPACE}f"
    )


def _shown(key: str, values: np.ndarray) -> tuple[np.ndarray, str]:
    """Return the ``values`` of a ``key``, numbers in a unit of people, and what they are called."""
    return studies.shown_numbers(key, values) if values.dtype.kind in "fi" else (values, studies.name_of(key))


def _groups(values: np.ndarray) -> list[Group]:
    """Return the points by their ``values`` of an input: of each value, or the low, the middle and the high ones."""
    is_number = values.dtype.kind in "fi"
    distinct = np.unique(values) if is_number else np.array(list(dict.fromkeys(values.tolist())))
    if distinct.size <= MOST_COLOURS or not is_number:
        names = [f"{value:.4g}" if is_number else figures.plain_words(value) for value in distinct.tolist()]
        return [Group(name=name, rows=np.flatnonzero(values == value)) for name, value in zip(names, distinct)]
    ends = np.quantile(distinct, np.linspace(0.0, 1.0, GROUPS + 1))
    places = np.clip(np.searchsorted(ends, values, side="right") - 1, 0, GROUPS - 1)
    groups = []
    for place in range(GROUPS):
        rows = np.flatnonzero(places == place)
        groups.append(Group(name=f"{values[rows].min():.3g} to {values[rows].max():.3g}", rows=rows))
    return groups


def _colours(count: int) -> list[Any]:
    return [figures.BLUE] if count == 1 else list(studies.line_colours(np.linspace(0.0, 1.0, count)))


def _draw_over_speed(axes: Axes, columns: dict[str, np.ndarray], groups: list[Group]) -> None:
    """Draw the mean and the middle half of f over the speed, in a colour for each of the ``groups``."""
    for group, colour in zip(groups, _colours(len(groups))):
        of_group = group.rows[columns[studies.SPEED][group.rows] > 0]
        (speeds, spread) = _spread(columns[studies.SPEED][of_group], columns["coefficient"][of_group])
        axes.plot(speeds, spread[2], color=colour, lw=1.4, label=group.name)
        axes.fill_between(speeds, spread[1], spread[3], color=[colour], alpha=0.15, lw=0)
    axes.set(xscale="log", xlabel=figures.axis_label(studies.SPEED))
    figures.plain_ticks(axes.xaxis)
    figures.key_above(axes, 3)


def _draw_over_key(
    axes: Axes, columns: dict[str, np.ndarray], key: str, groups: list[Group], *, has_means: bool, width: float
) -> None:
    """Draw f over the values of a ``key``, in a colour for each of the ``groups``, beside each other: its mean, middle
    half and range, or without ``has_means`` its points. ``width``: of the bars over the usual one."""
    values = columns[key]
    is_number = values.dtype.kind in "fi"
    names = [] if is_number else list(dict.fromkeys(values.tolist()))
    (along, label) = _shown(key, values)
    if is_number:
        figures.log_if_wide(axes, "x", along)
    else:
        along = np.array([names.index(value) for value in values.tolist()], dtype=float)
    is_log = axes.get_xscale() == "log"
    scale = np.log(along) if is_log else along
    step = APART * (float(np.ptp(scale)) or 1.0)
    for number, (group, colour) in enumerate(zip(groups, _colours(len(groups)))):
        f = columns["coefficient"][group.rows]
        if not has_means:
            low, high = (columns[name][group.rows] for name in studies.INTERVAL_COLUMNS["coefficient"])
            axes.vlines(along[group.rows], low, high, color=[colour], lw=0.7 * width, alpha=0.25)
            axes.plot(along[group.rows], f, "o", ms=POINT_SIZE, color=colour, alpha=0.8)
            continue
        (places, spread) = _spread(scale[group.rows], f)
        shifted = places + step * (number - 0.5 * (len(groups) - 1))
        x = np.exp(shifted) if is_log else shifted
        axes.vlines(x, spread[0], spread[4], color=[colour], lw=0.8 * width, alpha=0.8)
        axes.vlines(x, spread[1], spread[3], color=[colour], lw=3.5 * width, alpha=0.4)
        axes.plot(x, spread[2], "o", ms=MEAN_SIZE, color=colour, ls="-" if is_number else "", lw=1.0)
    if is_number:
        studies.tick_values(axes, along)
    else:
        studies.name_places(axes, [worded_value(key, name) for name in names])
    axes.set_xlabel(label)


def _spread(x: np.ndarray, f: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the different ``x``, and of f there the smallest value, lower quartile, mean, upper quartile and largest
    value (5, n); quartiles are NaN of fewer points than `LEAST_FOR_QUARTILES`."""
    (distinct, place) = np.unique(x, return_inverse=True)
    numbers = np.full((5, distinct.size), np.nan)
    for column in range(distinct.size):
        here = f[place == column]
        numbers[:, column] = here.min(), np.nan, here.mean(), np.nan, here.max()
        if here.size >= LEAST_FOR_QUARTILES:
            numbers[1::2, column] = np.quantile(here, (0.25, 0.75))
    return distinct, numbers


def _key_below(
    figure: Figure, columns: dict[str, np.ndarray], groups: list[Group], options: PictureOptions, others: list[Any]
) -> None:
    """Write what the colours and marks of the panels mean below them, with ``others`` as further entries."""
    from matplotlib.lines import Line2D

    grey: dict[str, Any] = {"color": figures.GREY}
    handles = list(others)
    named = [group for group in groups if group.name]
    for group, colour in zip(named, _colours(len(named))):
        name = f"{studies.name_of(studies.SPEED)} {group.name} m/s"
        handles.append(Line2D([], [], color=colour, marker="o", ms=3.5, lw=1.0, label=name))
    lines = [line for axes in figure.axes for line in axes.lines]
    if any(line.get_linestyle() == "None" and line.get_markersize() == POINT_SIZE for line in lines):
        handles.append(Line2D([], [], **grey, marker="o", ms=POINT_SIZE, ls="", label="one point"))
        if np.isfinite(columns.get(studies.INTERVAL_COLUMNS["coefficient"][0], np.zeros(0))).any():
            handles.append(Line2D([], [], **grey, lw=0.7, alpha=0.4, label="its 95 % interval"))
    if any(line.get_markersize() == MEAN_SIZE for line in lines):
        handles.append(Line2D([], [], **grey, marker="o", ms=MEAN_SIZE, lw=1.0, label=MEAN))
        handles.append(Line2D([], [], **grey, lw=3.5, alpha=0.4, label=MIDDLE))
        handles.append(Line2D([], [], **grey, lw=0.8, label=RANGE_OF_POINTS))
    if not groups:
        handles.append(Line2D([], [], **grey, lw=1.4, label=MEAN))
        handles.append(Line2D([], [], **grey, lw=5.0, alpha=0.3, label=MIDDLE))
    letters = NARROW_KEY_LETTERS if options.is_narrow else KEY_LETTERS
    longest = max(len(str(handle.get_label())) for handle in handles) + int(figures.KEY_LINE) + 3
    size = figures.SMALL_KEY_SIZE if options.is_narrow else figures.KEY_SIZE
    across = max(1, min(len(handles), letters // longest))
    are_apart = len(named) > 1 and any(line.get_markersize() == MEAN_SIZE for line in lines)
    are_apart |= bool(others) and any(len(axes.lines) > 1 for axes in figure.axes)
    titles = [*filter(None, (median_interval_in_words(columns), SIDE_BY_SIDE if are_apart else ""))]
    legend = figure.legend(
        handles=handles,
        title="\n".join(titles) or None,
        title_fontsize=size,
        loc="outside lower center",
        ncols=across,
        frameon=False,
        fontsize=size,
    )
    figure.set_figheight(figure.get_figheight() + legend.get_window_extent().height / figure.dpi)


def median_interval_in_words(columns: dict[str, np.ndarray]) -> str:
    """Return the median 95 % interval of f of one point, relative, or that none is known; "" where ``columns`` have
    none."""
    low, high = (columns.get(name, np.zeros(0)) for name in studies.INTERVAL_COLUMNS["coefficient"])
    if not np.isfinite(low).any():
        return "the 95 % interval of f is not known at any point" if low.size else ""
    f = columns["coefficient"]
    size = np.where(f == 0, np.nan, np.abs(f))
    down, up = (float(np.nanmedian(np.abs(end - f) / size)) for end in (low, high))
    count = int(np.isfinite(low).sum())
    some = "" if count == low.size else f"; known at {count} of {low.size}"
    return f"95 % interval of a point (median{some}): -{percent(down)}, +{percent(up)}"
