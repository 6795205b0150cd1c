"""study.png: what a study found."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import studies
from .._base import figures
from ..quantities import COLUMNS, counted
from .change_panels import hides_differences
from .effect_pictures import FEW_SPEEDS, draw_effects, median_interval_in_words
from .picture_options import PictureOptions

if TYPE_CHECKING:
    from matplotlib.axes import Axes

STUDY_PICTURE = "study.png"

# Heights of the pictures at the usual width [inch]: of curves, and of both panels of operating points.
# Chosen by looking at the figures.
STUDY_HEIGHT = 4.2
PAIRED_HEIGHTS = (3.0, 3.0)

# Height of the axes of a picture, at least [inch]. Chosen by looking at the figures.
LEAST_PANEL = 1.3

# Points up to which they are numbered where more inputs than `MOST_PANELS` are varied. A choice, by looking at the
# figures.
MANY_POINTS = 40

# Lines of what two or more things vary, and lines coloured by one thing, that a picture tells apart, at most. Choices,
# by looking at the figures.
MOST_STYLED_LINES = 16
MOST_SHADED_LINES = 40

# Operating points without a position from which on f is drawn over what is varied: their numbers say nothing. A choice:
# fewer are looked up in the table.
MANY_NUMBERED = 20

# Inputs of few points up to which each has a panel; with more the points are numbered. A choice, by looking at the
# figures.
MOST_PANELS = 8


@figures.styled
def plot_study(path: Path, result: studies.StudyResult, options: PictureOptions = PictureOptions()) -> None:
    """Draw what a study found: operating points with their power loss; else f over the speed, or over a key that is
    varied, a line for each combination of the others; where no lines tell these apart, the effect of each input on
    f."""
    title = _title(result) if options.has_title else ""
    if result.missing:
        title = "\n".join(filter(None, (title, f"not finished: {solved_so_far(result)}")))
    combinations = int(np.prod(result.status.shape[:-1], dtype=int))
    if result.paired and not _is_sample(result) and combinations > studies.MOST_OF_POINTS:
        part = f"the first {studies.MOST_OF_POINTS} of {combinations} combinations; study.csv has all"
        title = "\n".join(filter(None, (title, part)))
    over = _key_of_axis(result)
    varied = [key for key, (_, values) in result.coords.items() if np.unique(values.astype(str)).size > 1]
    if result.paired and not _is_sample(result):
        figure = figures.new_figure(figsize=options.size(PAIRED_HEIGHTS))
        upper, lower = figure.subplots(2, 1, sharex=True)
        studies.plot_points(result, "coefficient", upper).set_xlabel("")
        studies.plot_points(result, "power_loss", lower)
        figure.align_ylabels()
    elif over not in ("", studies.SPEED) and _is_of_one_input(result, varied) and hides_differences(result, over):
        figure = draw_effects(result, varied, options)
    elif over:
        figure = figures.new_figure(figsize=options.size([STUDY_HEIGHT]))
        axes = figure.subplots()
        has_bands = studies.lines_over(axes, result, over, has_bands=True) <= studies.MOST_BANDS
        _begin_at_zero(axes, result, has_intervals=has_bands)
        if not has_bands and (interval := median_interval_in_words(result.columns)):
            axes.plot([], [], " ", label=interval)
        figures.key_above(axes, 2)
    elif varied and (len(varied) <= MOST_PANELS or result.status.size > MANY_POINTS):
        figure = draw_effects(result, varied, options)
    else:
        figure = figures.new_figure(figsize=options.size([STUDY_HEIGHT]))
        axes = figure.subplots()
        _draw_points(axes, np.arange(1, result.status.size + 1), result)
        axes.set_xlabel("no. of the point, as in report.html: its row of study.csv")
        figures.key_above(axes)
    figures.head(figure, title)
    options.thin(figure)
    if not figures.fit_labels(figure):
        figures.lay_out(figure)
    figures.heighten(figure, LEAST_PANEL)
    figure.savefig(path)


def _is_of_one_input(result: studies.StudyResult, varied: list[str]) -> bool:
    """Return whether a study of few points varies one key alone."""
    return len(varied) == 1 and result.status.size <= MANY_POINTS


def _title(result: studies.StudyResult) -> str:
    """Return the name of the scene of a study, with its model unless the study varies this."""
    name = figures.plain_words(result.plan.scene.name)
    varies_model = any(key in ("numerics", "numerics.model") for key in result.coords)
    return name if varies_model else f"{name} (model: {result.plan.scene.numerics.model})"


def solved_so_far(result: studies.StudyResult) -> str:
    """Return how much of an unfinished study is solved, as text."""
    solved = result.solved - result.failed
    if result.chosen:
        curves = int(np.prod(result.status.shape[:-1], dtype=int))
        return f"{counted(solved, 'points')} are solved, and {curves - result.missing} of {curves} curves complete"
    return f"{solved} of {result.status.size} points are solved"


def _key_of_axis(result: studies.StudyResult) -> str:
    """Return the key along the axis of a picture of lines: the speed, or of what is varied in all combinations the
    number with the most values, else the text with the most; "" where no lines tell apart what is varied."""
    if result.paired:
        return ""
    lengths = dict(zip(result.dims, result.status.shape))
    longer = {key: values for key, (dim, values) in result.coords.items() if lengths[dim] > 1}
    if result.chosen or studies.SPEED in longer:
        others = {key: values for key, values in longer.items() if key != studies.SPEED}
        is_sparse = not result.chosen and len(result.plan.speeds) <= FEW_SPEEDS
        axes_of_lines = {result.coords[key][0] for key in others}
        return (
            studies.SPEED if _are_lines_distinct(result, others) and not (is_sparse and len(axes_of_lines) > 2) else ""
        )
    dims = [result.coords[key][0] for key in longer]
    if not longer or len(set(dims)) < len(dims):
        return ""
    over = max(longer, key=lambda key: (_is_number(longer[key]), key in COLUMNS, longer[key].size))
    others = {key: values for key, values in longer.items() if key != over}
    return over if _are_lines_distinct(result, others) else ""


def _are_lines_distinct(result: studies.StudyResult, others: dict[str, np.ndarray]) -> bool:
    """Return whether lines, one for each combination of the values of ``others`` by their keys, can be told apart."""
    sizes = {result.coords[key][0]: values.size for key, values in others.items()}
    count = int(np.prod(list(sizes.values()), dtype=int))
    if len(sizes) > 1:
        styles = int(np.prod(sorted(sizes.values())[:-1], dtype=int))
        return styles <= len(studies.STYLES) and count <= MOST_STYLED_LINES
    if len(others) > 1:
        return count <= studies.NAMED_SHADES
    return count <= (MOST_SHADED_LINES if all(map(_is_number, others.values())) else studies.NAMED)


def _is_number(values: np.ndarray) -> bool:
    """Return whether ``values`` are numbers, each of them once."""
    return values.dtype.kind in "fi" and np.unique(values).size == values.size


def _is_sample(result: studies.StudyResult) -> bool:
    """Return whether a study of operating points is over no position, angle or time, and has so many of them that their
    number says nothing."""
    is_ordered = any(name in result.coords for name in studies.ORDERED_BY)
    return not is_ordered and result.status.shape[-1] > MANY_NUMBERED


def _draw_points(axes: Axes, over: np.ndarray, result: studies.StudyResult) -> None:
    """Draw f of a study with its 95 % intervals, each as wide as it is, ``over`` (n,)."""
    f = result["coefficient"].ravel()
    low, high = (result[f"interval_{end}"].ravel() for end in ("low", "high"))
    known = np.isfinite(low) & np.isfinite(high)
    if known.any():
        bars: dict[str, Any] = {"color": figures.BLUE, "alpha": 0.4, "lw": 4, "label": "95 % interval"}
        axes.vlines(over[known], low[known], high[known], **bars)
    axes.plot(over, f, "o", ms=5, color=figures.BLUE, label="friction coefficient")
    axes.set_ylabel(figures.FRICTION_LABEL)
    _begin_at_zero(axes, result, has_intervals=True)


def _begin_at_zero(axes: Axes, result: studies.StudyResult, *, has_intervals: bool) -> None:
    """Let the axis of f begin at 0, or below its negative values, and end above the largest f, or end of an interval
    where the picture ``has_intervals``."""
    names = ("coefficient", *(studies.INTERVAL_COLUMNS["coefficient"] if has_intervals else ()))
    numbers = [result[name].ravel() for name in names]
    finite = np.concatenate([values[np.isfinite(values)] for values in numbers])
    if finite.size:
        axes.set_ylim(min(0.0, 1.05 * finite.min()), 1.05 * max(finite.max(), 0.0) or None)
