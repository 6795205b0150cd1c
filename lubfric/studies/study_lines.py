"""Studies drawn as lines: f over the speed, or over another key, a line for each combination of what else is varied."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base import figures
from ..quantities import COLUMNS, axis_label, worded_value
from .operating_points import INTERVAL_COLUMNS
from .plan import StudyPlan
from .points import SPEED
from .tables import BAND, LINE_POINTS, label, name_of, plot_points, shown_numbers

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Lines of a plot, at most. A choice, by looking at the figures.
MOST_PLOTTED_LINES = 500

# Lines of a plot that get a label each, at most, where they do not differ in one number. A choice, by looking at the
# figures.
NAMED = 10

# Values of a number that are named with their colour, at most; more are read off a bar. A choice, by looking at the
# figures.
NAMED_SHADES = 6

# Part of the colours that are dark enough to be seen on white [-]: without yellow. A choice, by looking at the figures.
DARK_SHADES = 0.85

# Markers and dashes of the combinations of what else is varied, one pair for each; more have none. A choice, by looking
# at the figures.
STYLES = (("o", "-"), ("s", "--"), ("^", ":"), ("D", "-."), ("v", (0, (5, 1))), ("P", (0, (1, 1))), ("X", (0, (7, 3))))

# Lines whose intervals are drawn as bands, at most. A choice, by looking at the figures: more bands hide each other.
MOST_BANDS = 4

# Distance of lines beside each other over a name, as a part of the distance of names. A choice, by looking at the
# figures.
BESIDE = 0.12

# Why marks are not at their name on the axis x.
SIDE_BY_SIDE_IN_LABEL = " (marks side by side)"

# Values of an axis that are its ticks, at most. A choice, by looking at the figures.
MOST_VALUE_TICKS = 8

# Width of a letter of a tick over the size of its font, and blank between two ticks in letters. Choices, by looking at
# the figures.
TICK_LETTER = 0.62
TICK_BLANK = 1.5


def plot(result: Any, ax: Axes | None = None, **style: Any) -> Axes:
    """Draw f over speed, a line for each curve, on ``ax`` or new axes, which are returned; ``style``: of the lines.
    Many curves are coloured by the first number that is varied, and have markers and dashes by the second. Where speeds
    were chosen, the lines are interpolated."""
    style = figures.line_style(style, ("ax",))
    if result.paired:
        return plot_points(result, "coefficient", ax, **style)
    axes = figures.axes_or_new(ax)
    count = int(np.prod(result.status.shape[:-1], dtype=int))
    drawn = lines_over(axes, result, SPEED, **style)
    has_key = len(axes.get_legend_handles_labels()[1]) > 1
    rows = figures.key_above(axes, 2) if has_key else 0
    some = "" if drawn == count else f": {drawn} of {count} curves"
    axes.set_title(figures.plain_words(result.plan.scene.name) + some, pad=6 + 13 * rows)
    return axes


def lines_over(axes: Axes, result: Any, over: str, *, has_bands: bool = False, **style: Any) -> int:
    """Draw f ``over`` a key of the study, a line for each combination of what else is varied, with labels for a key of
    lines; ``has_bands``: with the intervals of a few lines. Return the number of lines."""
    along = len(result.dims) - 1 if over == SPEED else result.dims.index(result.coords[over][0])
    shape = list(result.status.shape)
    shape[along] = 1
    indices = list(np.ndindex(*shape))
    indices = indices[:: -(-len(indices) // MOST_PLOTTED_LINES)]
    styles = _line_styles(result.plan, indices, along)
    _draw_bar(axes, styles)
    values, x_label = _values_over(result, over)
    is_text = over != SPEED and values.dtype.kind not in "fi"
    bands = has_bands and len(indices) <= MOST_BANDS
    shifts = BESIDE * (np.arange(len(indices)) - 0.5 * (len(indices) - 1)) if len(indices) <= NAMED_SHADES else None
    for number, (index, base_style) in enumerate(zip(indices, styles.lines)):
        place = (*index[:along], slice(None), *index[along + 1 :])
        f = result.columns["coefficient"][place]
        x = np.arange(f.size) + (0.0 if shifts is None else shifts[number]) if is_text else values
        x = np.abs(result.speeds(index[:-1])) if over == SPEED else x
        good = np.flatnonzero(np.isfinite(f) & ((over != SPEED) | (x > 0)))
        good = good[np.argsort(x[good], kind="stable")]
        curve = result.curve(index[:-1]) if over == SPEED and result.chosen else None
        line_style = base_style | ({"ls": ""} if is_text else {}) | style
        if curve is not None:
            fine = np.geomspace(x[good][0], x[good][-1], LINE_POINTS)
            axes.plot(fine, curve.at(fine), **line_style | {"marker": ""})
            line_style |= {"ls": "", "label": None}
        dots: dict[str, Any] = {"marker": "o", "ms": 3} if styles.are_few or curve is None else {}
        axes.plot(x[good], f[good], **dots | line_style)
        if bands:
            low, high = (result.columns[name][place][good] for name in INTERVAL_COLUMNS["coefficient"])
            _draw_intervals(axes, x[good], low, high, base_style["color"], are_apart=is_text)
    _label_intervals(axes, result, bands=bands)
    for handle in styles.handles:
        axes.plot([], [], **handle)
    apart = SIDE_BY_SIDE_IN_LABEL if is_text and shifts is not None and len(indices) > 1 else ""
    axes.set(xlabel=f"{x_label}{apart}", ylabel=figures.FRICTION_LABEL)
    if over == SPEED:
        axes.set_xscale("log")
        figures.plain_ticks(axes.xaxis)
    elif is_text:
        name_places(axes, values.tolist())
    else:
        tick_values(axes, values)
    return len(indices)


@dataclass(frozen=True, kw_only=True)
class LineStyles:
    """How lines are told apart.

    Attributes
    ----------
    lines : the style of each line, with its label where each has one
    handles : styles of lines without points, which the key of lines names in place of each line
    are_few : whether each line has a label
    bar : the key, and its smallest and largest value, that a bar of colours shows; None: there is none
    """

    lines: Sequence[dict[str, Any]]
    handles: Sequence[dict[str, Any]] = ()
    are_few: bool = False
    bar: tuple[str, float, float] | None = None


def _line_styles(plan: StudyPlan, indices: Sequence[tuple[int, ...]], along: int) -> LineStyles:
    """Return how the lines at ``indices`` are told apart, which run along the axis number ``along``: by colours where
    one thing is varied; by colours of one and, if these are few, markers and dashes of the combinations of the
    others."""
    sizes = np.array([max(index[axis] for index in indices) + 1 for axis in range(len(plan.dims))])
    varied = [axis for axis in range(len(plan.dims)) if axis != along and sizes[axis] > 1]
    if not varied:
        return LineStyles(
            lines=[{"color": figures.BLUE, "lw": 1.2, "label": COLUMNS["coefficient"].label}], are_few=True
        )
    colour_axes = [axis for axis in varied if _combinations(sizes, varied, axis) <= len(STYLES)]
    first = colour_axes[0] if colour_axes else varied[0]
    others = [axis for axis in varied if axis != first] if colour_axes else []
    number = _first_number(plan, first)
    most = NAMED_SHADES if number is not None and len(varied) == 1 else NAMED
    few = len(indices) <= most and not others
    places = np.array([index[first] for index in indices])
    handles: list[dict[str, Any]] = []
    bar = None
    if few:
        shades = np.linspace(0.0, 1.0, len(indices))
    elif number is None or np.unique(plan.coords[number][1]).size <= NAMED_SHADES:
        shades = places / (sizes[first] - 1)
        for place, colour in enumerate(line_colours(np.arange(sizes[first]) / (sizes[first] - 1))):
            handles.append({"color": colour, "lw": 2.0, "label": _label_along(plan, {first: place})})
    else:
        values = plan.coords[number][1]
        bar = (number, float(values.min()), float(values.max()))
        shades = (values[places] - bar[1]) / (bar[2] - bar[1])
    lines: list[dict[str, Any]] = [{"color": colour, "lw": 1.0} for colour in line_colours(shades)]
    for index, line in zip(indices, lines):
        if few:
            line["label"] = figures.plain_words(label(plan, _without(index, along), uses_symbols=True))
        if others:
            place = int(np.ravel_multi_index([index[axis] for axis in others], sizes[others]))
            line |= dict(zip(("marker", "ls"), STYLES[place])) | {"ms": 3.5}
    for places_of_others, (marker, dashes) in zip(np.ndindex(*sizes[others]) if others else (), STYLES):
        of_style = {"color": figures.GREY, "lw": 1.0, "ls": dashes, "marker": marker, "ms": 3.5}
        handles.append(of_style | {"label": _label_along(plan, dict(zip(others, places_of_others)))})
    return LineStyles(lines=lines, handles=handles, are_few=few, bar=bar)


def _without(index: tuple[int, ...], along: int) -> tuple[Any, ...]:
    """Return an ``index`` that is no place on the axis number ``along``."""
    return (*index[:along], slice(None), *index[along + 1 :])


def _first_number(plan: StudyPlan, axis: int) -> str | None:
    """Return the first key along an ``axis`` of a plan whose values are different numbers; None where none are."""
    for key, (dim, values) in plan.coords.items():
        if dim == plan.dims[axis] and values.dtype.kind in "fi" and np.ptp(values) > 0:
            return key
    return None


def _combinations(sizes: np.ndarray, varied: Sequence[int], axis: int) -> int:
    """Return the number of combinations of what is varied along all but one ``axis``."""
    return int(np.prod([sizes[other] for other in varied if other != axis], dtype=int))


def _label_along(plan: StudyPlan, places: dict[int, int]) -> str:
    """Return what is varied at the ``places`` along some axes, as text."""
    index: list[Any] = [slice(None)] * len(plan.dims)
    for axis, place in places.items():
        index[axis] = place
    return figures.plain_words(label(plan, tuple(index), uses_symbols=True))


def line_colours(shades: np.ndarray) -> np.ndarray:
    """Return the colours of lines (n, 4) whose ``shades`` are 0 to 1."""
    from matplotlib import colormaps

    return np.asarray(colormaps["viridis"](DARK_SHADES * np.asarray(shades, dtype=float)))


def _draw_bar(axes: Axes, styles: LineStyles) -> None:
    """Draw the bar of colours beside ``axes``, if the lines have one."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import ListedColormap, Normalize

    if styles.bar is None:
        return
    key, *ends = styles.bar
    shown, text = shown_numbers(key, np.array(ends))
    colours = ListedColormap(line_colours(np.linspace(0.0, 1.0, 256)))
    axes.figure.colorbar(ScalarMappable(Normalize(*shown), colours), ax=axes, label=text)


def _values_over(result: Any, over: str) -> tuple[np.ndarray, str]:
    """Return the values along the axis of the key ``over``, numbers in a unit of people, and the label of the axis."""
    if over == SPEED:
        return np.zeros(0), axis_label(SPEED)
    values = result.coords[over][1]
    return (
        shown_numbers(over, values)
        if values.dtype.kind in "fi"
        else (np.array([worded_value(over, value) for value in values.tolist()]), name_of(over))
    )


def _draw_intervals(
    axes: Axes, x: np.ndarray, low: np.ndarray, high: np.ndarray, colour: Any, *, are_apart: bool
) -> None:
    """Draw the intervals of a line as a band, or of points that no line joins as bars."""
    if not np.isfinite(low).any():
        return
    if are_apart or x.size == 1:
        axes.vlines(x, low, high, color=[colour], alpha=0.4, lw=3)
    else:
        axes.fill_between(x, low, high, color=[colour], alpha=0.12, lw=0)
        for end in (low, high):
            axes.plot(x, end, color=colour, alpha=0.5, lw=0.5)


def _label_intervals(axes: Axes, result: Any, *, bands: bool) -> None:
    """Name the bands in the key of lines, if there are some."""
    if bands and np.isfinite(result["interval_low"]).any():
        axes.fill_between([], [], [], color=figures.GREY, alpha=0.3, lw=0, label=BAND)


def name_places(axes: Axes, names: Sequence[Any]) -> None:
    """Write ``names`` at 0, 1, ... of the axis x, upright where they have no room side by side."""
    texts = [figures.plain_words(str(name)) for name in names]
    axes.set_xticks(range(len(texts)), texts, rotation=0 if _fit(axes, np.arange(len(texts)), texts) else 90)
    axes.set_xlim(-0.5, len(texts) - 0.5)


def tick_values(axes: Axes, values: np.ndarray) -> None:
    """Choose the scale of the axis x by the ``values`` on it, and make them its ticks if they have room there."""
    from matplotlib.ticker import NullLocator

    figures.log_if_wide(axes, "x", values)
    distinct = np.unique(values)
    texts = [f"{value:.4g}" for value in distinct]
    along = np.log(distinct) if axes.get_xscale() == "log" else distinct
    if 1 < distinct.size <= MOST_VALUE_TICKS and _fit(axes, along, texts):
        axes.set_xticks(distinct, texts)
        axes.xaxis.set_minor_locator(NullLocator())
    else:
        figures.plain_ticks(axes.xaxis)


def _fit(axes: Axes, along: np.ndarray, texts: Sequence[str]) -> bool:
    """Return whether ``texts`` centred at the places ``along`` an axis do not touch each other."""
    from matplotlib import rcParams
    from matplotlib.font_manager import FontProperties

    figure = axes.get_figure(root=True)
    assert figure is not None
    size = FontProperties(size=rcParams["xtick.labelsize"]).get_size_in_points()
    room = 72 * figure.get_figwidth() * axes.get_position().width / max(float(np.ptp(along)), 1e-300)
    return all(
        room * (after - before) > TICK_LETTER * size * (0.5 * (len(one) + len(other)) + TICK_BLANK)
        for (before, one), (after, other) in _neighbours(along, texts)
    )


def _neighbours(along: np.ndarray, texts: Sequence[str]) -> Iterator[tuple[tuple[float, str], tuple[float, str]]]:
    pairs = [(float(place), text) for place, text in zip(along, texts)]
    yield from zip(pairs, pairs[1:])
