"""study.png: what a study found."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .. import studies
from .._base import figures
from ..quantities import COLUMNS
from .picture_options import PictureOptions

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

STUDY_PICTURE = "study.png"

# Heights of the pictures at the usual width [inch]: of curves, of a row of panels, and of both panels of operating points.
# Chosen by looking at the figures.
STUDY_HEIGHT = 4.2
ROW_HEIGHT = 2.6
PAIRED_HEIGHTS = (3.0, 3.0)

# Height of the axes of a picture, at least [inch]. Chosen by looking at the figures.
LEAST_PANEL = 1.3

# Panels side by side, at most, in a picture of the usual width and in a narrow one. Chosen by looking at the figures.
PANELS_IN_A_ROW = 3
NARROW_PANELS_IN_A_ROW = 2

# Points from which on those of a picture are small, and their intervals thin. A choice, by looking at the figures.
MANY_POINTS = 40
MANY_OVER_ONE = 3  # points over each value, on average, from which on they are small, too

# Panels of the picture of a study, at most: one for each thing that is varied. A choice, by looking at the figures.
MOST_PANELS = 8


@figures.styled
def plot_study(path: Path, result: studies.StudyResult, options: PictureOptions = PictureOptions()) -> None:
    """Draw what a study found: operating points with their power loss; else f over the speed, or over a key that is varied, a
    line for each combination of the others; where more is varied, or several keys together, f over each of them."""
    title = figures.plain_words(result.plan.scene.name) if options.has_title else ""
    over = _key_of_axis(result)
    varied = [key for key, values in _along(result).items() if np.unique(values.astype(str)).size > 1]
    if result.paired:
        figure = figures.new_figure(figsize=options.size(PAIRED_HEIGHTS))
        upper, lower = figure.subplots(2, 1, sharex=True)
        studies.plot_points(result, "coefficient", upper).set_xlabel("")
        studies.plot_points(result, "power_loss", lower)
        figure.align_ylabels()
    elif over:
        figure = figures.new_figure(figsize=options.size([STUDY_HEIGHT]))
        axes = figure.subplots()
        studies.lines_over(axes, result, over, has_bands=True)
        _begin_at_zero(axes, result)
        figures.key_above(axes, 2)
    elif varied and len(varied) <= MOST_PANELS:
        figure = _panels(result, varied, options)
    else:
        figure = figures.new_figure(figsize=options.size([STUDY_HEIGHT]))
        axes = figure.subplots()
        _draw_points(axes, np.arange(1, result.status.size + 1), result)
        axes.set_xlabel("no. of the point, as in report.html: its row of study.csv")
        figures.key_above(axes)
    figures.head(figure, title)
    options.thin(figure)
    figures.fit_labels(figure)
    figures.heighten(figure, LEAST_PANEL)
    figure.savefig(path)


def _key_of_axis(result: studies.StudyResult) -> str:
    """Return the key along the axis of a picture of lines: the speed, or of what is varied in all combinations the number with
    the most values, else the text with the most; "" where no lines tell apart what is varied."""
    if result.paired:
        return ""
    lengths = dict(zip(result.dims, result.status.shape))
    longer = {key: values for key, (dim, values) in result.coords.items() if lengths[dim] > 1}
    if result.chosen or "speed" in longer:
        return "speed"
    dims = [result.coords[key][0] for key in longer]
    if not longer or len(set(dims)) < len(dims):
        return ""
    over = max(longer, key=lambda key: (_is_number(longer[key]), key in COLUMNS, longer[key].size))
    sizes = sorted(values.size for key, values in longer.items() if key != over)
    return over if int(np.prod(sizes[:-1], dtype=int)) <= len(studies.STYLES) else ""


def _is_number(values: np.ndarray) -> bool:
    """Return whether ``values`` are numbers, each of them once."""
    return values.dtype.kind in "fi" and np.unique(values).size == values.size


def _along(result: studies.StudyResult) -> dict[str, np.ndarray]:
    """Return what is varied by its key, one value for each point, in the shape of the study."""
    shape = result.status.shape
    arrays = {}
    for key, (dim, values) in result.coords.items():
        sides = [1] * len(shape)
        sides[result.dims.index(dim)] = values.size
        arrays[key] = np.broadcast_to(values.reshape(sides), shape)
    return arrays


def _panels(result: studies.StudyResult, varied: list[str], options: PictureOptions) -> Figure:
    """Draw f of all points over each of the keys that are ``varied``, in rows."""
    most = NARROW_PANELS_IN_A_ROW if options.is_narrow else PANELS_IN_A_ROW
    rows = -(-len(varied) // most)
    columns = -(-len(varied) // rows)
    figure = figures.new_figure(figsize=options.size([ROW_HEIGHT] * rows))
    panels = figure.subplots(rows, columns, sharey=True, squeeze=False).ravel()
    values = _along(result)
    for number, (axes, key) in enumerate(zip(panels, varied)):
        of_points = values[key].ravel()
        if of_points.dtype.kind in "fi":
            shown, label = studies.shown_numbers(key, of_points)
            _draw_points(axes, shown, result)
            studies.tick_values(axes, shown)
        else:
            names, places = np.unique(of_points.astype(str), return_inverse=True)
            label = studies.name_of(key)
            _draw_points(axes, places, result)
            studies.name_places(axes, names.tolist())
        axes.set_xlabel(label)
        axes.set_ylabel("" if number % columns else figures.FRICTION_LABEL)
    for axes in panels[len(varied) :]:
        axes.set_visible(False)
    handles, labels = panels[0].get_legend_handles_labels()
    size = figures.SMALL_KEY_SIZE if options.is_narrow else figures.KEY_SIZE
    figure.legend(handles, labels, loc="outside lower center", ncols=2, frameon=False, fontsize=size)
    return figure


def _draw_points(axes: Axes, over: np.ndarray, result: studies.StudyResult) -> None:
    """Draw f of a study with its 95 % intervals, each as wide as it is, ``over`` (n,)."""
    f = result["coefficient"].ravel()
    low, high = (result[f"uncertainty_{end}"].ravel() for end in ("low", "high"))
    known = np.isfinite(low) & np.isfinite(high)
    many = f.size > MANY_POINTS or f.size > MANY_OVER_ONE * np.unique(over).size
    width = 0.7 if many else 4
    if known.any():
        axes.vlines(
            over[known],
            low[known],
            high[known],
            color=figures.BLUE,
            alpha=0.25 if many else 0.4,
            lw=width,
            label="95 % interval",
        )
    axes.plot(over, f, "o", ms=2.5 if many else 5, color=figures.BLUE, label="friction coefficient")
    axes.set_ylabel(figures.FRICTION_LABEL)
    _begin_at_zero(axes, result)


def _begin_at_zero(axes: Axes, result: studies.StudyResult) -> None:
    """Let the axis of f begin at 0, or below its negative values, and end above the largest end of an interval."""
    numbers = [result[name].ravel() for name in ("coefficient", "uncertainty_low", "uncertainty_high")]
    finite = np.concatenate([values[np.isfinite(values)] for values in numbers])
    if finite.size:
        axes.set_ylim(min(0.0, 1.05 * finite.min()), 1.05 * max(finite.max(), 0.0) or None)
