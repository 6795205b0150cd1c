"""Pictures: what they share, and results drawn on given axes or on new ones of pyplot."""

from __future__ import annotations

import io
from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from copy import copy
from functools import wraps
from importlib.resources import as_file, files
from pathlib import Path
from textwrap import fill, wrap
from typing import TYPE_CHECKING, Any, Literal, TypeVar

import numpy as np

from ..errors import InputError
from ..quantities import axis_label
from ..units import converted, printed, unit_for
from .arrays import FloatArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axes._base import _AxesBase
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure
    from matplotlib.image import AxesImage
    from matplotlib.lines import Line2D
    from matplotlib.text import Text
    from matplotlib.transforms import Bbox


Plot = TypeVar("Plot", bound=Callable[..., Any])

BLUE = "#1f5a94"
RED = "#b3392f"
GREEN = "#2f7d4f"
GREY = "#6b6b6b"
# Colours of curves on the same axes, in turn: neither that of asperity nor that of fluid friction. A choice.
CURVE_COLOURS = (BLUE, "#d07a1f", "#7a4a9c", "#14898c", "#8a8a1c", "#c2418f")
FRICTION_LABEL = axis_label("coefficient")

# What of a line a user may choose, by the words of matplotlib.
LINE_STYLE = ("color", "ls", "lw", "marker", "ms", "alpha", "zorder")

# Other words of matplotlib for the same, by definition there.
WORDS_OF_STYLE = {"c": "color", "linestyle": "ls", "linewidth": "lw", "markersize": "ms"}

# Names of the lines of a curve in its key.
FRICTION_COEFFICIENT = "friction coefficient"
ASPERITY_FRICTION = "asperity friction"
FLUID_FRICTION = "fluid friction"
OPERATING_POINT_MARK = "operating point"
POINTS_IN_INCH = 72.0  # pt, by definition
RIM_WIDTH = 2.0  # pt: of the bright rim of a dark line on a map; a choice, by looking at pictures of 85 mm
DECADES_OF_NARROW_BAR = 3  # of ticks at most; a choice: "0.001" and "0.01" stay apart
TICKS_OF_NARROW_BAR = 2  # intervals of such a bar in a narrow picture; a choice: numbers of three digits stay apart
TICKS_OF_BAR = 4  # of a short bar of colours, about; a choice, by looking at pictures of 85 mm
NOT_BETWEEN = "not known in between"  # of a dotted line between points; a longer name takes a column from narrow keys
INTERPOLATED_BETWEEN = "interpolated"  # of a dashed line between points

# Choices, by looking at the figures.
KEY_SIZE = 8.0  # pt: of the letters of a key, at most
TICK_ROUNDING = 1e-9  # of a tick, relative
KEY_ROOM = 0.98  # of the width of axes before the layout, which leaves less to them: of the key above them
NARROW_KEY = {"handlelength": 2.0, "handletextpad": 0.5, "columnspacing": 1.0}  # letters: lengths in a narrow figure
KEY_LINE = 3.0  # letters: length of the lines in a key, such that dashes and dots differ
FIT_ROUNDS = 2  # times that labels are broken: breaking one changes the room of others
TITLE_LETTER = 0.56  # width of a letter of a title over the size of its font, about
GEOMETRIC = 3.0  # ratio of the largest to the smallest of numbers that may be spaced by factors
CORRELATION_ROUNDING = 1e-9  # of a correlation coefficient
EQUAL_STEPS = 0.05  # range of steps that are equal, over their mean
PART_WIDTH = 2.0  # pt: of the dashed line of a part of f, wider than that of f, which it may cover
NARROW_PART_WIDTH = 1.2  # pt: the same in a narrow figure
ASPERITY_DASHES = (0, (2.5, 2))  # of the part of f from the asperities, in widths of the line; f shows through
FLUID_DASHES = (0, (4, 1.5, 1, 1.5))  # of that from the film, which differs without colours
NARROW_FIGURE = 4.5  # inch: a figure up to this width has small letters in its keys
SMALL_KEY_SIZE = 6.0  # pt: of these letters
WIDE_MAP = 0.6  # height over width of a map below which the label of its short side has one word
ROOM_BESIDE_MAP = 1.7  # inch: of its labels and its bar of colours
ROOM_ABOVE_MAP = 0.8  # inch: of its title and the labels below it
NARROWEST_MAP = 3.5  # inch: a figure with a map; a choice: its title keeps its line
SLENDER_MAP = 4.0  # ratio of the sides beyond which a map is not drawn to scale


def styled(plot: Plot) -> Plot:
    """Return ``plot`` with what it draws in the style of pictures.mplstyle."""

    @wraps(plot)
    def drawn(*args: Any, **options: Any) -> Any:
        from matplotlib import rc_context, rc_params_from_file

        # a file for the time being, if the package is in an archive
        with as_file(files(__package__) / "pictures.mplstyle") as path:
            style = rc_params_from_file(str(path), use_default_template=False)
        chosen = next(
            (value for value in (*args, *options.values()) if hasattr(value, "style") and callable(value.style)), None
        )
        with rc_context({**style, **(chosen.style() if chosen is not None else {})}):
            return plot(*args, **options)

    return drawn  # type: ignore[return-value]


def in_unit_for(values: np.ndarray, unit: str) -> tuple[np.ndarray, str]:
    """Return ``values`` in the SI ``unit`` in the unit of people in which the largest is 1 or more, and its name."""
    finite = np.abs(values[np.isfinite(values)])
    name = unit_for([float(finite.max(initial=0.0))], unit)
    return converted(values, unit, name), printed(name)


def new_figure(*args: Any, layout: Any = "constrained", **kwargs: Any) -> Figure:
    """Return a figure without a window, of the resolution in which it is saved: letters are of other widths in another
    one."""
    from matplotlib import rcParams
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    resolution = rcParams["savefig.dpi"]
    figure = Figure(*args, layout=layout, **kwargs)
    if resolution != "figure":
        figure.set_dpi(resolution)
    FigureCanvasAgg(figure)
    return figure


def make_ready() -> None:
    """Import matplotlib and load its fonts, which takes half a second, while something else is computed."""
    figure = new_figure(figsize=(1, 1))
    figure.subplots()
    figure.savefig(io.BytesIO())


def animated(
    path: str | Path, figure: Figure, draw: Callable[[int], Any], frames: int | Iterable[int], per_second: int, dpi: int
) -> None:
    """Save what ``draw(frame)`` makes of ``figure`` as a GIF."""
    from matplotlib.animation import FuncAnimation, PillowWriter

    FuncAnimation(figure, draw, frames=frames, blit=False).save(path, writer=PillowWriter(fps=per_second), dpi=dpi)


def plain_words(text: str) -> str:
    """Return ``text`` of a user, such as the name of a scene, for a picture, in which a $ would begin a formula."""
    return text.replace("$", r"\$")


def head(figure: Figure, title: str) -> None:
    """Write ``title`` above ``figure``, in lines that are no wider than it."""
    from matplotlib import rcParams
    from matplotlib.font_manager import FontProperties

    size = FontProperties(size=rcParams["figure.titlesize"]).get_size_in_points()
    letters = int(POINTS_IN_INCH * figure.get_figwidth() / (TITLE_LETTER * size))
    figure.suptitle("\n".join(fill(line, letters) for line in title.splitlines()))


def axes_or_new(ax: Axes | None, layout: str = "constrained") -> Axes:
    """Return ``ax``, or the axes of a new figure."""
    if ax is not None:
        return ax
    from matplotlib import pyplot

    return pyplot.subplots(figsize=(7, 4.5), layout=layout)[1]


def line_style(style: Mapping[str, Any], own: Sequence[str]) -> dict[str, Any]:
    """Return the ``style`` of a line with one word for each property, those of `LINE_STYLE`. Raises `InputError` for a
    keyword that no line has; ``own``: the other keywords of the caller."""
    unknown = [name for name in style if name not in (*LINE_STYLE, *WORDS_OF_STYLE, *own)]
    if unknown:
        allowed = f"{', '.join(own)}; of the line: {', '.join((*LINE_STYLE, *WORDS_OF_STYLE))}"
        raise InputError(f"plot has no keyword {unknown[0]!r}", allowed=allowed)
    return {WORDS_OF_STYLE.get(name, name): value for name, value in style.items()}


def friction_lines(
    axes: Axes, x: FloatArray, parts: Sequence[FloatArray], *, without: Container[str] = (), **style: Any
) -> list[Line2D]:
    """Draw f, and its parts from the asperities and from the film, over ``x``, and return the lines. ``parts``: three
    arrays; ``without``: the names of those that are omitted; ``style``: of the first."""
    f, contact, film = parts
    lines = axes.plot(x, f, **{"color": BLUE, "label": FRICTION_COEFFICIENT} | style)
    for part, color, dashes, label in (
        (contact, RED, ASPERITY_DASHES, ASPERITY_FRICTION),
        (film, GREEN, FLUID_DASHES, FLUID_FRICTION),
    ):
        if label in without:
            continue
        lone: dict[str, Any] = {"marker": "_", "ms": 20} if np.size(x) == 1 else {}
        lines += axes.plot(x, part, color=color, lw=PART_WIDTH, ls=dashes, label=label, **lone)
    return lines


def widened(x: FloatArray, *values: FloatArray) -> tuple[FloatArray, ...]:
    """Return ``x`` and ``values`` over it; a lone point as a short piece of x, as an area over a point shows
    nothing."""
    return (x, *values) if np.size(x) != 1 else (np.multiply(x, (0.97, 1.03)), *(np.repeat(v, 2) for v in values))


def load_shares(axes: Axes, x: FloatArray, share: FloatArray) -> None:
    """Draw the asperity load ratio, and above it the film load ratio, over ``x``."""
    x, share = widened(x, share)
    axes.fill_between(x, 0, share, color=RED, alpha=0.5, lw=0, label="asperity load $F_C/F_T$")
    axes.fill_between(x, share, 1, color=GREEN, alpha=0.3, lw=0, label="film load $F_H/F_T$")
    axes.set(ylim=(0, 1), ylabel="load ratio (-)")


def plain_ticks(axis: Axis) -> None:
    """Write numbers such as 0.2 and 0.5 on a logarithmic ``axis`` (``ax.xaxis``) of less than two decades, where
    matplotlib would write every tick as a product, so that they overlap, or none around a lone point. Ticks set by hand
    stay."""
    from matplotlib.ticker import FormatStrFormatter, LogLocator, MaxNLocator, NullFormatter, NullLocator

    low, high = sorted(axis.get_view_interval())
    if axis.get_scale() == "log" and 0 < low and high < 100 * low and isinstance(axis.get_major_locator(), LogLocator):
        fine = LogLocator(subs=(1, 2, 5) if high > 5 * low else (1, 1.5, 2, 3, 4, 5, 7))
        axis.set_major_locator(fine if high > 2 * low else MaxNLocator(5))
        axis.set_minor_locator(axis.get_minor_locator() if high > 2 * low else NullLocator())
        axis.set_major_formatter(FormatStrFormatter("%g"))
        axis.set_minor_formatter(NullFormatter())


def log_if_wide(axes: Axes, name: str, values: np.ndarray) -> None:
    """Make an axis "x" or "y" logarithmic where the positive ``values`` on it spread over more than a factor of 20, or
    are spaced geometrically, and not in equal steps."""
    if values.min() > 0 and (values.max() > 20 * values.min() or is_geometric(values)) and not has_equal_steps(values):
        axes.set(**{f"{name}scale": "log"})


def has_equal_steps(values: np.ndarray) -> bool:
    """Return whether three ``values`` or more are apart by equal steps, within `EQUAL_STEPS`."""
    steps = np.diff(np.unique(values))
    return bool(steps.size > 1 and np.ptp(steps) <= EQUAL_STEPS * steps.mean())


def is_geometric(values: np.ndarray) -> bool:
    """Return whether positive ``values`` are spaced, or scattered, more evenly by their logarithms than by themselves,
    over a factor of `GEOMETRIC` at least."""
    different = np.unique(values)
    if different.size < 3 or not different[-1] >= GEOMETRIC * different[0] > 0:
        return False
    place = np.arange(different.size)
    (even, by_factors) = (np.corrcoef(place, x)[0, 1] for x in (different, np.log(different)))
    return bool(by_factors > even + CORRELATION_ROUNDING)


def speed_label(speed: np.ndarray) -> str:
    """Return the label of a logarithmic axis of entrainment ``speed`` [m/s], which shows its magnitude."""
    if not (speed < 0).any():
        return axis_label("speed")
    return f"entrainment speed $|U|$ (m/s), {'both directions' if (speed > 0).any() else 'backwards'}"


def key_above(axes: Axes, columns: int = 3) -> int:
    """Put the key of the lines above the axes, where it hides none, in so many ``columns`` at most as the figure has
    room for, with each label once; returns the number of its lines of text."""
    from matplotlib import rcParams

    handles, labels = _key_entries(axes)
    size = min(rcParams["legend.fontsize"], KEY_SIZE) if not isinstance(rcParams["legend.fontsize"], str) else KEY_SIZE
    figure = axes.get_figure(root=True)
    assert figure is not None
    place: dict[str, Any] = {"loc": "lower left", "bbox_to_anchor": (0.0, 1.0), "borderaxespad": 0.2}
    place |= {"frameon": False, "fontsize": size, "handlelength": KEY_LINE}
    if figure.get_figwidth() <= NARROW_FIGURE:
        place |= {"fontsize": min(size, SMALL_KEY_SIZE), **NARROW_KEY}
    count = min(columns, len(labels)) or 1
    while _excess(axes.legend(handles, labels, ncols=count, **place), axes) > 1 and count > 1:
        count -= 1
    excess = _excess(axes.get_legend(), axes)
    if excess > 1 and labels:
        letters = max(map(len, labels)) + KEY_LINE
        labels = [fill(label, max(int(letters / excess - KEY_LINE), 1)) for label in labels]
        axes.legend(handles, labels, ncols=count, **place)
    per_column = -(-len(labels) // count)
    return per_column + max((label.count("\n") for label in labels), default=0)


def _key_entries(axes: Axes) -> tuple[list[Any], list[str]]:
    """Return the samples and the labels of the key of ``axes``: each label once, with a grey sample and behind the
    others where several lines have it."""
    by_label: dict[str, list[Any]] = {}
    for handle, label in zip(*axes.get_legend_handles_labels()):
        by_label.setdefault(label, []).append(handle)
    labels = sorted(by_label, key=lambda label: len(by_label[label]) > 1)
    return [
        by_label[label][0] if len(by_label[label]) == 1 else _in_grey(by_label[label][0]) for label in labels
    ], labels


def _in_grey(handle: Any) -> Any:
    """Return a copy of a ``handle`` of a key in grey, of a band as opaque as it is; one of several parts unchanged."""
    from matplotlib.collections import Collection
    from matplotlib.colors import to_rgb

    if not hasattr(handle, "set_color"):
        return handle
    sample = copy(handle)
    opacity = float(np.asarray(handle.get_facecolor())[0, -1]) if isinstance(handle, Collection) else 1.0
    sample.set_color((*to_rgb(GREY), opacity))
    return sample


def _excess(legend: Any, axes: Axes) -> float:
    """Return the width of a ``legend`` over the room above its ``axes``, before the figure is laid out."""
    figure = axes.get_figure(root=True)
    assert figure is not None
    return float(legend.get_window_extent().width / (KEY_ROOM * axes.get_position().width * figure.bbox.width))


def lay_out(figure: Figure) -> None:
    """Put the axes of ``figure`` where they are when it is drawn, in two thirds of the time that
    ``Figure.draw_without_rendering`` takes."""
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)
    for axes in figure.axes:
        locator = axes.get_axes_locator()
        axes.apply_aspect(None if locator is None else locator(axes, None))  # type: ignore[arg-type]  # as colour bars do


def fit_labels(figure: Figure, of: Sequence[Axes] | None = None) -> bool:
    """Break the labels of the axes of ``figure``, or ``of`` some of them, into lines that are no longer than the axes
    that they belong to, or than there is room about these where nothing else is beside them. Return whether the figure
    is laid out with them."""
    for _ in range(FIT_ROUNDS):
        lay_out(figure)
        whole = figure.bbox
        is_changed = False
        for axes in figure.axes if of is None else of:
            box = axes.get_window_extent()
            is_lone = not any(_are_side_by_side(axes, other) for other in figure.axes if other is not axes)
            middle = 0.5 * (box.x0 + box.x1)
            room = 2 * min(middle - whole.x0, whole.x1 - middle) if is_lone else box.width
            is_changed |= _break(axes.xaxis.label, axes.xaxis.label.get_window_extent().width / room)
            is_changed |= _break(axes.yaxis.label, axes.yaxis.label.get_window_extent().height / box.height)
        if not is_changed:
            return True
    return False


def heighten(figure: Figure, least: float) -> None:
    """Make a ``figure`` that is laid out so high that none of its axes is lower than ``least`` [inch] where long labels
    take its height."""
    shown = [axes for axes in figure.axes if axes.get_visible() and axes.get_subplotspec() is not None]
    lowest = min(axes.get_window_extent().height for axes in shown) / figure.dpi
    rows = max(axes.get_subplotspec().get_gridspec().nrows for axes in shown)  # type: ignore[union-attr]
    if lowest < least:
        figure.set_figheight(figure.get_figheight() + rows * (least - lowest))


# Empty band at the edge of a figure that stays, and the least that is cut off [inch]. Choices, by looking at the
# figures.
EDGE = 0.04
LEAST_CUT = 0.05
CUT_ROUNDS = 2  # times that a height is cut: the layout follows each cut


def cut_height(figure: Figure) -> None:
    """Make ``figure`` as high as what it shows, as maps that are to scale leave a band below them empty."""
    for _ in range(CUT_ROUNDS):
        lay_out(figure)
        spare = figure.get_figheight() - figure.get_tightbbox().height - 2 * EDGE
        if spare < LEAST_CUT:
            return
        figure.set_figheight(figure.get_figheight() - spare)


def _are_side_by_side(axes: Axes, other: Axes) -> bool:
    """Return whether two axes have labels below them at the same height."""
    one, two = (each.get_subplotspec() for each in (axes, other))
    return one is not None and two is not None and one.rowspan == two.rowspan and one.colspan != two.colspan


def _break(label: Text, excess: float) -> bool:
    """Break a ``label`` that is longer than its room, by the factor ``excess``, into lines, and return whether that
    changes it."""
    before = label.get_text()
    if excess > 1:
        text = before.replace("\n", " ")
        longest = max(map(len, before.splitlines()))
        width = max(int(longest / excess), 1)
        count = len(_lines(text, width))
        while width > 1 and len(_lines(text, width - 1)) == count:  # lines of about equal lengths
            width -= 1
        label.set_text("\n".join(_lines(text, width)))
    return label.get_text() != before


def _lines(text: str, width: int) -> list[str]:
    return wrap(text, width, break_long_words=False, break_on_hyphens=False)


def hertz_strip(axes: Axes, half_width: float) -> None:
    """Draw the edges of a Hertz strip of this ``half_width`` [m] on axes in µm, dark with a bright rim, which is seen on
    all colours; none where it is not known."""
    from matplotlib.patheffects import withStroke

    if np.isfinite(half_width):
        for edge in (-half_width, half_width):
            rim = [withStroke(linewidth=RIM_WIDTH, foreground="w")]
            axes.axvline(edge * 1e6, color="k", lw=0.8, ls="--", path_effects=rim)


# Distance of a bar of colours from the map below it [inch], at most. A choice, by looking at the figures.
ABOVE_MAP = 0.08


class _AlongMap:
    """Where a bar of colours is drawn: beside its map and as high, or above it and as wide. A map that is to scale is
    smaller than its place in the figure."""

    def __init__(self, axes: Axes, bar: Axes, *, is_above: bool):
        self.axes = axes
        self.inner = bar.get_axes_locator()
        self.is_above = is_above

    def __call__(self, bar: _AxesBase, renderer: Any) -> Bbox:
        from matplotlib.transforms import Bbox

        place = bar.get_position(original=True)  # of the layout, as long as the place of the map
        box = (
            place if self.inner is None else self.inner(bar, renderer)
        )  # without the ends that point at clipped values
        drawn = self.axes.get_position()
        whole = self.axes.get_position(original=True)
        if self.is_above:
            times = drawn.width / place.width
            left = drawn.x0 + times * (box.x0 - place.x0)
            figure = bar.get_figure(root=True)
            assert figure is not None  # it is drawn
            above = drawn.y1 + ABOVE_MAP / figure.get_figheight()
            bottom = min(box.y0 + drawn.y1 - whole.y1, above)  # the layout leaves room for a key of the next panel
            return Bbox.from_bounds(left, bottom, times * box.width, box.height)
        times = drawn.height / place.height
        bottom = drawn.y0 + times * (box.y0 - place.y0)
        return Bbox.from_bounds(box.x0 + drawn.x1 - whole.x1, bottom, box.width, times * box.height)


def _ticks_to_the_end(image: AxesImage, bar: Any) -> None:
    """Give a short ``bar`` of colours three to five ticks: of numbers from the first to the last of them, of powers of
    ten all in its range."""
    from matplotlib.colors import LogNorm
    from matplotlib.ticker import LogLocator, MaxNLocator

    (low, high) = image.get_clim()
    is_narrow = bar.ax.get_figure(root=True).get_figwidth() <= NARROW_FIGURE
    if not isinstance(image.norm, LogNorm):
        count = TICKS_OF_NARROW_BAR if is_narrow else TICKS_OF_BAR
        ticks = MaxNLocator(count, steps=[1, 2, 2.5, 5, 10], min_n_ticks=min(3, count)).tick_values(low, high)
        image.set_clim(min(low, ticks[0]) if low < 0 else low, ticks[-1])
        bar.set_ticks([tick for tick in ticks if tick >= low])
    elif high > 100.0 * low:
        decades = LogLocator(numticks=2 * TICKS_OF_BAR).tick_values(low, high)
        inside = [decade for decade in decades if low * (1 - TICK_ROUNDING) <= decade <= high]
        bar.set_ticks(inside[:: 2 if is_narrow and len(inside) > DECADES_OF_NARROW_BAR else 1])


def narrow_to_map(axes: Axes) -> None:
    """Make the figure of these ``axes`` as wide as their map with its labels needs, if it is to scale."""
    figure = axes.get_figure(root=True)
    if figure is None or axes.get_aspect() == "auto":
        return
    (left, right) = axes.get_xlim()
    (low, high) = axes.get_ylim()
    (widest, height) = figure.get_size_inches()
    width = ROOM_BESIDE_MAP + (height - ROOM_ABOVE_MAP) * (right - left) / (high - low)
    figure.set_size_inches(min(max(width, NARROWEST_MAP), widest), height)


def field_image(
    axes: Axes,
    x: FloatArray,
    y: FloatArray,
    values: FloatArray,
    colours: str,
    label: str,
    extend: str = "neither",
    place: Literal["right", "top"] = "right",
    **options: Any,
) -> AxesImage:
    """Draw ``values`` (nx, ny) over cells at ``x`` and ``y`` [m], from above, with a bar of colours at ``place``;
    returns the image. To scale, unless it would be too slender; then the axis says so."""
    from matplotlib.colors import LogNorm

    half_x, half_y = (0.5 * (a[1] - a[0] if a.size > 1 else 1e-6) for a in (x, y))
    extent = (1e6 * (x[0] - half_x), 1e6 * (x[-1] + half_x), 1e6 * (y[0] - half_y), 1e6 * (y[-1] + half_y))
    ratio = (extent[3] - extent[2]) / (extent[1] - extent[0])
    slender = not 1 / SLENDER_MAP <= ratio <= SLENDER_MAP
    aspect: Literal["auto", "equal"] = "auto" if slender else "equal"
    image = axes.imshow(values.T, origin="lower", aspect=aspect, cmap=colours, extent=extent, **options)
    axes.grid(visible=False)
    bar = axes.figure.colorbar(image, ax=axes, label=label, extend=extend, location=place)
    bar.ax.set_axes_locator(_AlongMap(axes, bar.ax, is_above=place == "top"))
    if isinstance(image.norm, LogNorm):
        bar.long_axis.set_major_formatter("{x:g}")
        plain_ticks(bar.long_axis)
    if place == "top":
        _ticks_to_the_end(image, bar)
    axes.set(xlabel="x (µm), along the motion")
    along = "" if WIDE_MAP > ratio and not slender else ", along the line"
    axes.set(ylabel=f"y (µm){along}{' (not to scale)' if slender else ''}")
    return image
