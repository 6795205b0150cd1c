"""``lubfric plot``: the picture of a run again, or the Stribeck or traction curves of several runs in one picture."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import studies
from .._base import figures, read_table, validate
from ..errors import InputError
from .commands import read_record
from .curve_picture import drawable, over_x, points_of_record, violations_of_record
from .picture_options import SPEED_AXIS, X_LABELS, PictureOptions
from .pictures import ring_points, traction_over_ratio
from .plot_again import TABLES, measured_of, picture_options, plot_again, write_picture

if TYPE_CHECKING:
    from .._base.tables import Columns

# Height of the picture [inch], at the usual width. A choice, by looking at the figures.
HEIGHT_OF_CURVES = 4.0

# Lines that are drawn of a curve alone: with those of several, none of them can be read.
OF_ONE_CURVE = (figures.ASPERITY_FRICTION, figures.FLUID_FRICTION)

# Of the picture of several curves, without its ending; {}: that of their table.
TOGETHER = "{}_together"

# Tables of curves that are drawn in one picture, without their endings, and what they are over.
OVER_OF_CURVE = {"stribeck": "speed", "traction": "ratio"}

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
        if arguments.parts_of is not None:
            raise InputError("--parts-of is for the picture of several curves, and there is one; omit it")
        plot_again(of_first)
        return
    for option in OF_ONE_RUN:
        if getattr(arguments, option) is not None:
            raise InputError(f"--{option} is for the picture of one run; omit it, or give one folder")
    if labels and len(labels) != len(arguments.folder):
        message = f"--labels has {len(labels)} names for {len(arguments.folder)} folders"
        raise InputError(message, recommendation="separate one for each folder by commas")
    kind = _kind(arguments.folder)
    curves = [_curve(folder, kind) for folder in arguments.folder]
    names = [name for name, _ in curves]
    if len(set(names)) < len(names):
        names = [folder.resolve().name for folder in arguments.folder]
    options = picture_options(of_first, kind)
    names = labels or names
    records = map(read_record, arguments.folder)
    columns = [over_x(columns, record, options.x) for (_, columns), record in zip(curves, records)]
    draw = partial(
        plot_curves,
        curves=dict(zip(names, columns)),
        violations=[_violations(folder, kind) for folder in arguments.folder],
        options=replace(options, parts_of=_parts_of(arguments.parts_of, names)),
        measured=measured_of(of_first, kind),
    )
    write_picture(of_first, TOGETHER.format(kind), draw)


def _parts_of(given: str | None, names: Sequence[str]) -> tuple[str, ...]:
    """Return the curves, of these ``names``, whose parts of f are drawn, as --parts-of names them."""
    words = [] if given is None else given.split(",")
    return tuple(validate.choice("--parts-of", word.strip(), names) for word in words)


def _kind(folders: Sequence[Path]) -> str:
    """Return of which of `OVER_OF_CURVE` each of the ``folders`` has a table. Raises `InputError` where there is none."""
    for folder in folders:
        if not folder.is_dir():
            raise InputError(f"folder {validate.shown(str(folder))} does not exist")
    for kind in OVER_OF_CURVE:
        if all((folder / f"{kind}.csv").is_file() for folder in folders):
            return kind
    tables = (
        f"{folder}: {next((TABLES[kind] for kind in OVER_OF_CURVE if (folder / f'{kind}.csv').is_file()), 'no curve')}"
        for folder in folders
    )
    raise InputError(
        f"the folders have no curves of one kind ({'; '.join(tables)})",
        recommendation="give folders in which 'lubfric run' has written stribeck.csv, or traction.csv, in all of them",
    )


def _curve(folder: Path, kind: str) -> tuple[str, Columns]:
    """Return the name of the scene, and those rows of the table ``kind`` of a ``folder`` that can be drawn, in the
    order of what they are over."""
    table = folder / f"{kind}.csv"
    columns = read_table(table)
    rows = np.flatnonzero(drawable(columns))
    if not rows.size:
        raise InputError(f"nothing to draw: no point in {table} moves and has an answer")
    order = rows[np.argsort(columns[OVER_OF_CURVE[kind]][rows])]
    chosen = type(columns)((name, column[order]) for name, column in columns.items())
    return read_record(folder)["scene"]["name"], chosen


def _violations(folder: Path, kind: str) -> list[Sequence[Any]]:
    """Return the assumptions that are violated at each of the points that `_curve` returns of a ``folder``."""
    table = folder / f"{kind}.csv"
    columns = read_table(table)
    violated = violations_of_record(points_of_record(table, columns, read_record(folder)))
    rows = np.flatnonzero(drawable(columns))
    return [violated[row] for row in rows[np.argsort(columns[OVER_OF_CURVE[kind]][rows])]]


@figures.styled
def plot_curves(
    path: Path,
    curves: dict[str, Columns],
    violations: list[list[Sequence[Any]]],
    measured: studies.Measured | None = None,
    options: PictureOptions = PictureOptions(),
) -> None:
    """Draw friction over the speed, or the slide-roll ratio, of several ``curves``, by their names, with what was
    ``measured``, without its parts. ``violations``: of each curve, the assumptions that are violated at each point."""
    figure = figures.new_figure(figsize=options.size([HEIGHT_OF_CURVES]))
    axes = figure.subplots()
    models = {model for columns in curves.values() for model in columns.get("model", np.zeros(0, str)).tolist()}
    for place, (name, columns) in enumerate(curves.items()):
        left_out = () if name in options.parts_of else OF_ONE_CURVE
        shown = replace(options, without=(*left_out, *options.without), has_parts=False)
        if "ratio" in columns:
            color = figures.CURVE_COLOURS[place % len(figures.CURVE_COLOURS)]
            label = figures.plain_words(name)
            traction_over_ratio(axes, columns, shown, label=label, color=color, others=place, models=models)
        else:
            interval = "bars" if options.has_bars else "band"
            studies.draw_curve(axes, columns, name, name, interval=interval, without=shown.without, models=models)
    for columns, violated in zip(curves.values(), violations):
        x = columns["ratio"] if "ratio" in columns else columns.get(studies.OVER_X, np.abs(columns["speed"]))
        ring_points(axes, x, columns["coefficient"], violated, options)
    figures.key_above(axes)
    ratios = np.concatenate([columns.get("ratio", []) for columns in curves.values()])
    if ratios.size:
        axes.set_xlabel("slide-roll ratio (-)")
        figures.log_if_wide(axes, "x", ratios)
        figures.key_above(axes)
    if options.x != SPEED_AXIS:
        axes.set_xlabel(X_LABELS[options.x])
    if measured is not None:
        measured.draw(axes, is_signed=bool((ratios < 0).any()))
        figures.key_above(axes)
    f = np.concatenate([columns["coefficient"] for columns in curves.values()])
    options.scale(axes, friction=axes, f=f)
    figures.plain_ticks(axes.xaxis)
    options.thin(figure)
    figures.fit_labels(figure)
    figure.savefig(path)
