"""study.png: what a study found."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .. import studies
from .._base import figures
from ..quantities import KEYS, axis_label
from ..units import ZERO_CELSIUS, converted, unit_for
from .picture_options import PictureOptions

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

STUDY_PICTURE = "study.png"

# Heights of the pictures at the usual width [inch]: of curves, of a map, and of both panels of operating points. Chosen
# by looking at the figures.
STUDY_HEIGHT = 4.5
STUDY_MAP_HEIGHT = 5.0
PAIRED_HEIGHTS = (3.25, 3.25)

# Width of a panel, and of what is beside all of them [inch]. Chosen by looking at the figures.
PANEL_WIDTH = 2.9
PANEL_MARGIN = 1.0

# Points from which on those of a picture are small, and their intervals thin. A choice, by looking at the figures.
MANY_POINTS = 40

# Panels of the picture of a study, at most: one for each number that is varied. A choice, by looking at the figures.
MOST_PANELS = 4


@figures.styled
def plot_study(path: Path, result: studies.StudyResult, options: PictureOptions = PictureOptions()) -> None:
    """Draw what a study found: curves over the speed; operating points with their power loss; of one speed, f over what
    is varied: one number, two as a map, else all points by their number."""
    longer = [(key, values) for key, (_, values) in result.coords.items() if values.size > 1]
    numbers = all(values.dtype.kind == "f" and np.unique(values).size == values.size for _, values in longer)
    keys = [key for key, _ in longer]
    title = figures.plain_words(result.plan.scene.name) if options.has_title else ""
    if result.paired:
        figure = figures.new_figure(figsize=options.size(PAIRED_HEIGHTS))
        upper, lower = figure.subplots(2, 1, sharex=True)
        studies.plot_points(result, "coefficient", upper).set_xlabel("")
        studies.plot_points(result, "power_loss", lower)
        _save(path, figure, title, options)
        return
    if numbers and len(keys) == 2 and "speed" not in keys and len(result.dims) == 3:
        studies.plot_map(path, result, keys[0], keys[1], title, size=options.size([STUDY_MAP_HEIGHT]))
        return
    over = {key: values for key, values in _along(result).items() if key in keys and values.dtype.kind == "f"}
    if 1 < len(over) <= MOST_PANELS and "speed" not in keys and not result.chosen:
        _draw_panels(path, result, over, title, options)
        return
    figure = figures.new_figure(figsize=options.size([STUDY_HEIGHT]))
    axes = figure.subplots()
    if "speed" in keys or result.chosen:
        result.plot(axes)
        if not options.has_title:
            axes.set_title("")
        title = ""  # the axes have it
    elif numbers and len(keys) == 1:
        _draw_intervals(axes, longer[0][1], result)
        axes.set_xlabel(axis_label(keys[0]))
        figures.log_if_wide(axes, "x", longer[0][1])
        figures.plain_ticks(axes.xaxis)
    else:
        _draw_intervals(axes, np.arange(1, result.status.size + 1), result)
        axes.set_xlabel("no. of the point, as in report.html: its row of study.csv")
    _save(path, figure, title, options)


def _save(path: Path, figure: Figure, title: str, options: PictureOptions) -> None:
    """Write a ``figure`` with its ``title``."""
    if title:
        figure.suptitle(title)
    options.thin(figure)
    figure.savefig(path)


def _along(result: studies.StudyResult) -> dict[str, np.ndarray]:
    """Return what is varied by its key, one value for each point, in the shape of the study."""
    shape = result.status.shape
    arrays = {}
    for key, (dim, values) in result.coords.items():
        sides = [1] * len(shape)
        sides[result.dims.index(dim)] = values.size
        arrays[key] = np.broadcast_to(values.reshape(sides), shape)
    return arrays


def _draw_panels(
    path: Path, result: studies.StudyResult, over: dict[str, np.ndarray], title: str, options: PictureOptions
) -> None:
    """Draw f of all points over each of the numbers that are varied, side by side."""
    (width, height) = options.size([STUDY_HEIGHT])
    if options.width is None:
        width = PANEL_MARGIN + PANEL_WIDTH * len(over)
    figure = figures.new_figure(figsize=(width, height))
    panels = figure.subplots(1, len(over), sharey=True, squeeze=False)[0]
    for axes, (key, values) in zip(panels, over.items()):
        shown = values.ravel()
        label = axis_label(key)
        if key == "lubricant.temperature":
            shown = shown - float(ZERO_CELSIUS)
            label = axis_label("lubricant.temperature_celsius")
        elif key in KEYS:
            unit = unit_for(shown.tolist(), KEYS[key].unit)
            shown = converted(shown, KEYS[key].unit, unit)
            label = axis_label(key, unit)
        _draw_intervals(axes, shown, result)
        axes.set_xlabel(label)
        figures.log_if_wide(axes, "x", shown)
        figures.plain_ticks(axes.xaxis)
        axes.label_outer()
        if axes is not panels[0]:
            axes.get_legend().remove()
    _save(path, figure, title, options)


def _draw_intervals(axes: Axes, over: np.ndarray, result: studies.StudyResult) -> None:
    """Draw f of a study with its 95 % intervals, each as wide as it is, ``over`` (n,)."""
    f = result["coefficient"].ravel()
    low, high = (result[f"uncertainty_{end}"].ravel() for end in ("low", "high"))
    known = np.isfinite(low) & np.isfinite(high)
    many = f.size > MANY_POINTS
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
    finite = np.concatenate([f[np.isfinite(f)], low[known], high[known]])
    if finite.size:
        axes.set_ylim(min(0.0, 1.05 * finite.min()), 1.05 * max(finite.max(), 0.0) or None)
    figures.key_above(axes)
