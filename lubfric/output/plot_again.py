"""``lubfric plot`` of one folder: the picture of a run again, from its table."""

from __future__ import annotations

import re
from argparse import Namespace
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from .. import studies
from .._base import FolderLock, OwnFiles, figures, read_table, validate
from ..errors import InputError
from ..quantities import counted
from ..units import number_and_unit, number_of
from .commands import (
    UNFINISHED,
    check_outputs,
    made,
    read_record,
    say,
)
from .contact_pictures import plot_contact
from .curve_picture import (
    among_requested,
    draw_curve,
    operating_point_of_record,
    over_x,
    points_of_record,
    record_of_point,
    table_of,
    title_of_curve,
)
from .fields import read_contact
from .fit_picture import FIT, plot_fit, read_fit
from .operating_point import operating_point_of
from .picture_options import CONTACT_PANELS, LINES, PANELS, SPEED_AXIS, WITHOUT_ADDED, X_LABELS, PictureOptions
from .pictures import plot_history
from .run_files import PICTURE_FORMATS, RESOLVED_STUDY, SO_FAR
from .study_pictures import plot_study, solved_so_far

AXIS_SCALES = ("linear", "log")  # of an axis

INTERVAL_FORMS = ("band", "bars")  # of the intervals of a curve in its picture

LEFT_OUT = ("warnings", "parts", "title", WITHOUT_ADDED, *LINES)  # of a picture, where a user does not want them

# Narrowest and widest picture [m]. A choice: it can be read and drawn.
NARROWEST = 0.05
WIDEST_PICTURE = 0.6

# Points of a picture per inch, at least and at most. A choice: the same.
LEAST_DPI = 50
MOST_DPI = 1200

# Options of a measured curve, of its columns and of its label.
OF_MEASURED = ("measured", "speed", "ratio", "coefficient", "deviation", "measured_label")

# By the table of a curve, of what a measured curve is over: the option that names its column, the keyword of
# `lubfric.read_measured`, and its name.
MEASURED_OVER = {"stribeck": ("speed", "speed", "speed"), "traction": ("ratio", "slide_roll_ratio", "slide-roll ratio")}

TABLES = {"history": "a run in time", "traction": "a traction curve", "stribeck": "a Stribeck curve"}


def plot_again(arguments: Namespace) -> None:
    """Draw the picture of a run again from its table, as a PNG, or as a PDF or SVG for a paper; of a curve with the
    measured one that the ``arguments`` of ``lubfric plot`` name. With ``--contact`` draw the contact at one speed
    again, from fields.npz."""
    if arguments.contact is not None:
        _plot_contact_again(arguments)
        return
    folder = arguments.folder
    name = next((name for name in TABLES if (folder / f"{name}.csv").is_file()), None)
    _check_measured(arguments)
    if name is None and (folder / FIT).is_file():
        _plot_fit_again(arguments)
        return
    if name is None and ((folder / RESOLVED_STUDY).is_file() or studies.has_study(folder)):
        _plot_study_again(arguments)
        return
    if not folder.is_dir():
        raise InputError(f"there is no folder {validate.shown(str(folder))}; give one that 'lubfric run' wrote")
    if name is None and (folder / UNFINISHED).is_dir():
        _plot_unfinished_again(arguments)
        return
    if name is None:
        raise InputError(
            f"{folder} has no stribeck.csv; give a folder that 'lubfric run', 'lubfric study' or 'lubfric fit' wrote"
        )
    if name == "history":
        _refuse(arguments, OF_MEASURED, f"is for the picture of a curve, and {folder} has {TABLES[name]}; omit it")
    measured = None if name == "history" else measured_of(arguments, name)
    options = picture_options(arguments, name)
    columns = read_table(folder / f"{name}.csv")
    record = read_record(folder)
    title = record["scene"]["name"]
    if name == "history":
        again: Callable[..., Any] = partial(
            plot_history, columns=columns, title=figures.plain_words(title), options=options
        )
    else:
        points = points_of_record(folder / f"{name}.csv", columns, record)
        columns, points = among_requested(columns, points, record, _left_out(arguments))
        columns = over_x(columns, record, options.x)
        again = partial(
            draw_curve,
            columns=columns,
            title=title_of_curve(title, points),
            points=points,
            measured=measured,
            options=options,
            operating_point=operating_point_of_record(record),
        )
    write_picture(arguments, name, again)


def _plot_unfinished_again(arguments: Namespace) -> None:
    """Draw the solved points of the curve of an interrupted run, in a folder of its own, as the run may go on, with a
    line on stderr that says how much of the curve is drawn."""
    folder = arguments.folder
    states = sorted((folder / UNFINISHED).iterdir(), key=lambda path: path.stat().st_mtime, reverse=True)
    unfinished = next(filter(None, map(studies.unfinished_curve, states)), None)
    if unfinished is None:
        raise InputError(
            f"{folder} has an interrupted run without a solved point of a curve",
            recommendation="the command of the run continues it",
        )
    curve = unfinished.curve
    kind = table_of(curve)
    measured = measured_of(arguments, kind)
    options = picture_options(arguments, kind)
    points = [record_of_point(curve, i) for i in range(len(curve.points))]
    failed = f", {len(curve.errors)} failed" if curve.errors else ""
    say(f"the run is not finished: {unfinished.in_words}{failed}; the picture has these")
    (name, *models) = title_of_curve(unfinished.scene.name, points).splitlines()
    again = partial(
        draw_curve,
        columns=read_table(folder / f"{kind}.csv", studies.csv_bytes(curve)),
        title="\n".join([f"{name}, not finished: {unfinished.in_words}", *models]),
        points=points,
        measured=measured,
        options=options,
        operating_point=operating_point_of(unfinished.scene, curve.SWEPT[0]),
    )
    write_picture(Namespace(**(vars(arguments) | {"folder": folder / SO_FAR})), kind, again)


def measured_of(arguments: Namespace, name: str) -> studies.Measured | None:
    """Return the measured curve that the ``arguments`` of a command name, for the picture of the table ``name``; None
    where they name none. A line on stderr says which columns it is."""
    _check_measured(arguments)
    if arguments.measured is None:
        return None
    (option, keyword, axis) = MEASURED_OVER[name]
    for other, *_ in MEASURED_OVER.values():
        if other != option and getattr(arguments, other) is not None:
            recommendation = f"give --{option}, the heading of the column of {axis}s"
            raise InputError(f"--{other} is not for {TABLES[name]}", recommendation=recommendation)
    heading = getattr(arguments, option)
    if heading is None or arguments.coefficient is None:
        raise InputError(f"--measured needs --{option} and --coefficient, the headings of its columns")
    measured = read_measured_of(arguments, **{keyword: heading})
    columns = f"the {axis} is its column {heading!r}, f its column {arguments.coefficient!r}"
    if measured.deviation is not None:
        columns += f", the standard deviation {deviation_in_words(arguments.deviation)}"
    say(f"measured: {counted(measured.x.size, 'points')} of {measured.source}; {columns}")
    return measured


def read_measured_of(arguments: Namespace, **options: Any) -> studies.Measured:
    """Return the measured curve that the ``arguments`` of a command name, with its standard deviations and its label.
    ``options``: the heading of what it is over, and others of `lubfric.read_measured`. --deviation is a heading, or a
    number for all points, in percent relative to f."""
    given = arguments.deviation
    number = None if given is None else number_and_unit(given)
    deviation: str | float | None = given
    is_relative = number is not None and number[1] == "%"
    if is_relative:
        deviation = None
    elif number is not None:
        deviation = number_of("--deviation", given, "-")
    measured = studies.read_measured(
        arguments.measured,
        coefficient=arguments.coefficient,
        deviation=deviation,
        legend=arguments.measured_label,
        **options,
    )
    if not is_relative:
        return measured
    part = validate.number("--deviation", number_of("--deviation", given, "-"), "-", above=0.0)
    return replace(measured, deviation=part * measured.coefficient)


def deviation_in_words(given: str) -> str:
    """Return what --deviation is, as text."""
    number = number_and_unit(given)
    if number is None:
        return f"its column {given!r}"
    return f"{given} of each f" if number[1] == "%" else f"{given} of each point"


def _check_measured(arguments: Namespace) -> None:
    """Refuse ``arguments`` that name a column of a measured curve and no such curve."""
    given = next((name for name in OF_MEASURED if getattr(arguments, name) is not None), "measured")
    if arguments.measured is None and given != "measured":
        solved = f", or --{given}s for what is solved" if f"{given}s" in arguments else ""
        what = "labels the measured curve" if given == "measured_label" else "names a column of the measured curve"
        raise InputError(f"--{given.replace('_', '-')} {what}; give --measured as well{solved}")


def _refuse(arguments: Namespace, names: Sequence[str], why: str) -> None:
    """Refuse the first of the options of these ``names`` that the ``arguments`` give; ``why``: what the message says of
    it."""
    given = next((name for name in names if getattr(arguments, name) is not None), None)
    if given is not None:
        raise InputError(f"--{given.replace('_', '-')} {why}")


def _plot_study_again(arguments: Namespace) -> None:
    """Draw the picture of a study again; of one that is not finished, in a folder of its own, as the study may be
    running, with a line on stderr that says how much of it is drawn."""
    of_runs = (*OF_MEASURED, "panels", "x", "x_scale", "y_scale", "interval")
    _refuse(arguments, of_runs, f"is for the picture of a run, and {arguments.folder} has a study; omit it")
    options = picture_options(arguments, "study")
    result = studies.open_study(arguments.folder)
    folder = arguments.folder
    if result.missing:
        known = int(np.isfinite(result["coefficient"]).sum())
        if not known:
            recommendation = "the command of the study continues it"
            raise InputError(f"{folder} has a study without a solved point so far", recommendation=recommendation)
        failed = f", {result.failed} failed" if result.failed else ""
        say(f"the study is not finished: {solved_so_far(result)}{failed}; the picture has these")
        folder = folder / SO_FAR
    again = partial(plot_study, result=result, options=options)
    write_picture(Namespace(**(vars(arguments) | {"folder": folder})), "study", again)


def _plot_fit_again(arguments: Namespace) -> None:
    """Draw the picture of a fit again."""
    of_runs = (*OF_MEASURED, "panels", "x", "without", "interval")
    _refuse(arguments, of_runs, f"is for the picture of a run, and {arguments.folder} has a fit; omit it")
    options = picture_options(arguments, "fit")
    write_picture(arguments, "fit", partial(plot_fit, record=read_fit(arguments.folder / FIT), options=options))


def _plot_contact_again(arguments: Namespace) -> None:
    """Draw the picture of the contact at the speed ``arguments.contact`` again."""
    of_curves = (*OF_MEASURED, "x", "x_scale", "y_scale", "interval")
    _refuse(arguments, of_curves, "is for the picture of a curve, and --contact draws the contact; omit one of them")
    contact = read_contact(arguments.folder / "fields.npz", number_of("--contact", arguments.contact, "m/s"))
    fields = contact.fields
    if arguments.panels is not None and (fields is None or not fields.pressure_includes_film):
        raise InputError("--panels with --contact is for a contact by the deterministic model; omit it")
    panels = [] if arguments.panels is None else arguments.panels.split(",")
    left_out = [] if arguments.without is None else [arguments.without]
    if left_out:
        validate.choice("--without", left_out[0].strip(), ("title",))
    options = PictureOptions(
        panels=tuple(validate.choice("--panels", word.strip(), CONTACT_PANELS) for word in panels) or CONTACT_PANELS,
        width=_width(arguments),
        dpi=_dpi(arguments),
        has_title=not left_out,
    )
    if options.is_narrow and fields is not None:
        heat = "; the shear stress is isothermal, f includes heat" if "shear" in options.panels else ""
        say(f"for the caption, as a narrow picture has no room for it: {fields.solve}{heat}")
    write_picture(arguments, f"contact_at_{contact.speed:.4g}", partial(plot_contact, contact=contact, options=options))


def write_picture(arguments: Namespace, name: str, draw: Callable[..., Any]) -> None:
    """Put what ``draw(path)`` draws into the folder of ``lubfric plot``, as ``name``, or as the ``arguments`` name it,
    in the format that they say."""
    folder = arguments.folder
    if arguments.name is not None:
        name = arguments.name
        if Path(name).name != name or name.startswith("."):
            recommendation = "give a name without a folder; the picture is written to the folder of the run"
            raise InputError(f" = {name!r} is not the name of a file", "--name", recommendation=recommendation)
    file = f"{name}.{validate.choice('--format', arguments.format, PICTURE_FORMATS)}"
    check_outputs(arguments, folder, [file])
    content = made(file, draw)
    with FolderLock(folder):
        OwnFiles(folder).replace({file: content})
    say(f"wrote {file} to {folder}")


def _width(arguments: Namespace) -> float | None:
    """Return the width of the picture [m] that the ``arguments`` ask for."""
    if arguments.width is None:
        return None
    number = number_of("--width", arguments.width, "m")
    if NARROWEST <= number / 1e3 <= WIDEST_PICTURE and re.search(r"[a-z]", arguments.width) is None:
        message = f" = {number:g} m is out of range"
        ways = f"did you mean '{number:g} mm'?"
        raise InputError(message, "--width", f"{NARROWEST:g} to {WIDEST_PICTURE:g} m", ways)
    return validate.number("--width", number, "m", minimum=NARROWEST, maximum=WIDEST_PICTURE)


def _dpi(arguments: Namespace) -> float | None:
    """Return the points of a picture per inch that the ``arguments`` ask for."""
    if arguments.dpi is None:
        return None
    if arguments.format != "png":
        raise InputError(f"--dpi is for a PNG, and --format is {arguments.format}, which has no points; omit it")
    return float(validate.integer("--dpi", arguments.dpi, minimum=LEAST_DPI, maximum=MOST_DPI))


def _left_out(arguments: Namespace) -> list[str]:
    """Return what --without names, of `LEFT_OUT`."""
    words = [] if arguments.without is None else arguments.without.split(",")
    return [validate.choice("--without", word.strip().replace("-", " "), LEFT_OUT) for word in words]


def picture_options(arguments: Namespace, name: str) -> PictureOptions:
    """Return the options of the picture of the table ``name`` by the ``arguments`` of ``lubfric plot``."""
    panels = PANELS["traction"]
    if arguments.panels is not None:
        if name not in PANELS:
            raise InputError(f"--panels chooses parts of the picture of a curve, and this is {TABLES[name]}; omit it")
        panels = tuple(validate.choice("--panels", word.strip(), PANELS[name]) for word in arguments.panels.split(","))
    scales = {option: getattr(arguments, option) for option in ("x_scale", "y_scale")}
    for option, scale in scales.items():
        if scale is not None:
            validate.choice(f"--{option.replace('_', '-')}", scale, AXIS_SCALES)
    over = SPEED_AXIS if arguments.x is None else validate.choice("--x", arguments.x, X_LABELS)
    if over != SPEED_AXIS and (name != "stribeck" or arguments.measured is not None):
        raise InputError("--x is for the picture of a Stribeck curve without a measured one; omit it")
    form = INTERVAL_FORMS[0]
    if arguments.interval is not None:
        if name == "history":
            raise InputError(f"--interval is for a curve, and this is {TABLES[name]}; omit it")
        form = validate.choice("--interval", arguments.interval, INTERVAL_FORMS)
    left_out = _left_out(arguments)
    lines = tuple(line for line in LINES if line in left_out)
    if lines and name not in PANELS:
        raise InputError(f"--without {lines[0]!r} is for a curve, and this is {TABLES.get(name, f'a {name}')}; omit it")
    return PictureOptions(
        panels=panels,
        x=over,
        width=_width(arguments),
        dpi=_dpi(arguments),
        **scales,
        has_warnings="warnings" not in left_out,
        has_parts="parts" not in left_out,
        has_title="title" not in left_out,
        has_bars=form == "bars",
        without=lines,
    )
