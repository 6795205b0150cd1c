"""``lubfric plot``: the picture of a run again, or the Stribeck curves of several runs in one picture."""

from __future__ import annotations

from argparse import Namespace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .. import studies
from .._base import figures, read_table, validate
from ..errors import InputError
from .commands import read_record
from .picture_options import PictureOptions
from .plot_again import measured_of, picture_options, plot_again, write_picture

if TYPE_CHECKING:
    from .._base.tables import Columns

# Height of the picture [inch], at the usual width. A choice, by looking at the figures.
HEIGHT_OF_CURVES = 4.0

# Lines that are drawn of a curve alone: with those of several, none of them can be read.
OF_ONE_CURVE = (figures.ASPERITY_FRICTION, figures.FLUID_FRICTION)

# Of the picture of several curves, without its ending.
TOGETHER = "stribeck_together"

# Options of ``lubfric plot`` that are for the picture of one run.
OF_ONE_RUN = ("contact", "panels")


def plot(arguments: Namespace) -> None:
    """Draw the picture of a run again, or of the curves in several folders of the ``arguments``, into the first one."""
    (first, *others) = arguments.folder
    of_first = Namespace(**(vars(arguments) | {"folder": first}))
    labels = [] if arguments.labels is None else [label.strip() for label in arguments.labels.split(",")]
    if not others:
        if labels:
            raise InputError("--labels names the curves of several folders, and there is one; omit it")
        plot_again(of_first)
        return
    for option in OF_ONE_RUN:
        if getattr(arguments, option) is not None:
            raise InputError(f"--{option} is for the picture of one run; omit it, or give one folder")
    if labels and len(labels) != len(arguments.folder):
        message = f"--labels has {len(labels)} names for {len(arguments.folder)} folders"
        raise InputError(message, recommendation="separate one for each folder by commas")
    curves = [_curve(folder) for folder in arguments.folder]
    names = [name for name, _ in curves]
    if len(set(names)) < len(names):
        names = [folder.resolve().name for folder in arguments.folder]
    draw = partial(
        plot_curves,
        curves=dict(zip(labels or names, (columns for _, columns in curves))),
        options=picture_options(of_first, "stribeck"),
        measured=measured_of(of_first, "stribeck"),
    )
    write_picture(of_first, TOGETHER, draw)


def _curve(folder: Path) -> tuple[str, Columns]:
    """Return the name of the scene and the table of the Stribeck curve in a ``folder``."""
    table = folder / "stribeck.csv"
    if not table.is_file():
        what = "has no Stribeck curve" if folder.is_dir() else "does not exist"
        message = f"folder {validate.shown(str(folder))} {what}"
        raise InputError(message, recommendation="give folders in which 'lubfric run' has written stribeck.csv")
    columns = read_table(table)
    if not (np.isfinite(columns["coefficient"]) & (columns["speed"] != 0)).any():
        raise InputError(f"nothing to draw: no point in {table} moves and has an answer")
    return read_record(folder)["scene"]["name"], columns


@figures.styled
def plot_curves(
    path: Path,
    curves: dict[str, Columns],
    measured: studies.Measured | None = None,
    options: PictureOptions = PictureOptions(),
) -> None:
    """Draw friction over the speed of several ``curves``, by their names, with what was ``measured``, without its
    parts."""
    figure = figures.new_figure(figsize=options.size([HEIGHT_OF_CURVES]))
    axes = figure.subplots()
    for name, columns in curves.items():
        studies.draw_curve(
            axes,
            columns,
            name,
            name,
            interval="bars" if options.has_bars else "band",
            without=(*OF_ONE_CURVE, *options.without),
        )
    if measured is not None:
        measured.draw(axes)
        figures.key_above(axes)
    options.scale(axes, friction=axes)
    figures.plain_ticks(axes.xaxis)
    options.thin(figure)
    figures.fit_labels(figure)
    figure.savefig(path)
