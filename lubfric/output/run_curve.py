"""``lubfric run`` on a steady scene: its Stribeck curve, or (``--ratios``) its traction curve, written to a folder."""

from __future__ import annotations

import math
import re
from argparse import Namespace
from collections import Counter
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import studies
from .._base import FolderLock, OwnFiles, figures, read_table, validate
from .._base.jobs import parts_on
from .._base.progress import progress_to
from ..errors import ConvergenceError, InputError, ValidityError
from ..estimate import FrictionResult
from ..models import models_up_to
from ..models.shared import Prepared, Violation, at_value, at_values, effect_in_words
from ..quantities import COLUMNS, NUMBERS, counted, in_words
from ..samples import takes_strips
from ..scene import (
    FASTEST,
    LARGEST_RATIO,
    MOST_RATIO,
    MOST_SPEEDS,
    Scene,
    check_ratios,
    given_tables,
    has_moving_roughness,
)
from ..units import number_and_unit, number_of, numbers_of, with_interval
from .commands import (
    UNFINISHED,
    RepeatedRun,
    RunFolder,
    check_outputs,
    made,
    moment_reports,
    read_record,
    run_begun,
    say,
)
from .contact_pictures import compared_contact, drawn_contact, plot_contact
from .curve_answer import gap_notes, model_in_words
from .describe import SceneEstimate, is_among, rolling_in_words, speeds_of_curve
from .fields import fields_bytes, read_contact, vtk_bytes
from .fit_picture import FIT, plot_fit, read_fit
from .operating_point import operating_point_not_solved, operating_point_of
from .picture_options import LINES, PANELS, PictureOptions
from .pictures import plot_history, plot_stribeck, plot_traction
from .progress import ProgressLine
from .run_files import PICTURE_FORMATS, RESOLVED_STUDY, SO_FAR, names_of_run
from .study_pictures import plot_study, solved_so_far

if TYPE_CHECKING:
    from .._base.tables import Columns


AXIS_SCALES = ("linear", "log")  # of an axis
INTERVAL_FORMS = ("band", "bars")  # of the intervals of a curve in its picture
LEFT_OUT = ("warnings", "parts", "title", *LINES)  # of a picture, where a user does not want them

# Limits by choice, for a picture that can be read and drawn.
NARROWEST = 0.05  # m: width of a picture
LEAST_DPI = 50  # points of a picture per inch
MOST_DPI = 1200  # points of a picture per inch
WIDEST_PICTURE = 0.6  # m: width of a picture
# Options of a measured curve, of its columns and of its label.
OF_MEASURED = ("measured", "speed", "ratio", "coefficient", "deviation", "measured_label")
# By the table of a curve, of what a measured curve is over: the option that names its column, the keyword of
# `lubfric.read_measured`, and its name.
MEASURED_OVER = {"stribeck": ("speed", "speed", "speed"), "traction": ("ratio", "slide_roll_ratio", "slide-roll ratio")}
TABLES = {"history": "a run in time", "traction": "a traction curve", "stribeck": "a Stribeck curve"}
WORTH = 8  # speeds from which a second process gains more than it costs; a choice: a process takes a second to start
MOST_GAPS = 3  # gaps of a traction curve that are named; a choice


def run_sweep(scene: Scene, arguments: Namespace) -> None:
    """Compute a curve, and write stribeck.csv, stribeck.png, fields.npz, contact.png, surface.png, report.html,
    resolved.toml and, last, result.json to the folder ``arguments.out``; where the deterministic model corrected it,
    sharing.png, the same contact without them; where the curve has a formula, law.json and law.c; with ``.vtk`` also
    contact_0.vtk ... for ParaView.

    ``arguments``: of the command, with ``.speeds``, ``.fields`` and ``.workers`` (None: all processors but one where
    that pays) too. The scene is checked and made ready before the folder is touched. The results of an earlier run stay
    until those of this one are there. Every point is on disk when it ends, so an interrupted run continues from there.
    A failed run writes what it has, then raises `ConvergenceError`.
    """
    ended: list[tuple[Any, ...]] = []
    speeds, chosen = _requested(scene, arguments.speeds, arguments.fields)
    measured = measured_of(arguments, "stribeck")
    total = "some" if speeds == studies.AUTO_SPEEDS else len(speeds)
    progress = _progress("U = {:.4g} m/s", scene, is_total_known=speeds != studies.AUTO_SPEEDS)
    names = names_of_run("stribeck")
    names += [f"contact_{i}.vtk" for i in range(len(chosen) if arguments.vtk else 0)]

    def kept() -> str:
        return _kept_in_words(len(ended), total, arguments.out)

    workers = _workers(arguments, scene, speeds)
    speeds_apart = _are_apart(speeds, workers)
    with (
        ProgressLine("speeds") as shown,
        studies.pool(workers) as executor,
        parts_on(None if speeds_apart else executor),
    ):
        begun = run_begun(scene, arguments, names, kept, speeds, chosen, kept_by="stribeck", speeds=speeds)
        with begun as (folder, prepared, estimate), progress_to(moment_reports()):
            requested = () if speeds == studies.AUTO_SPEEDS else speeds
            known = studies.count_of_kept(folder.unfinished, prepared, requested)
            _say_known(known, len(requested), arguments.out)

            def on_point(*point: Any) -> None:
                if not ended:
                    studies.keep_request(folder.unfinished, prepared, requested)
                ended.append(point)
                shown.update(point[0], point[1])
                progress(*point)

            curve = studies.stribeck(
                prepared,
                speeds,
                executor if speeds_apart else None,
                fields=chosen,
                fine_fields=True,
                store=folder.unfinished,
                on_point=on_point,
                raise_on_failure=False,
            )
            folder.is_needed = not studies.is_all_solved(folder.unfinished)
            _write(folder, prepared, curve, arguments, estimate, chosen, measured)
    _raise_if_failed(curve)


def _kept_in_words(count: int, total: int | str, out: Path) -> str:
    """Return how many of ``total`` points an interrupted run keeps in the folder ``out``, as text; "" for none."""
    verb = "is" if count == 1 else "are"
    return f"{count} of {total} points {verb} kept in {out}" if count else ""


def _say_known(known: int, total: int, out: Path) -> None:
    """Say how many of ``total`` points an interrupted run has solved in the folder ``out``; nothing for none."""
    if known:
        verb = "is" if known == 1 else "are"
        say(f"{known} of {counted(total, 'points')} {verb} solved already, by an interrupted run in {out}")


def _workers(arguments: Namespace, scene: Scene, points: str | list[float]) -> int:
    """Return the number of processes of a curve over ``points``, speeds or slide-roll ratios: that of the
    ``arguments``, else `_default_workers`. Where the points have a process each, a line on stderr says so."""
    if arguments.workers is not None:
        workers = validate.integer("--workers", arguments.workers, minimum=1, maximum=studies.MOST_WORKERS)
    else:
        workers = _default_workers(scene, points)
    if _are_apart(points, workers) and workers > 1:
        plural = "speeds" if arguments.ratios is None else "slide-roll ratios"
        say(f"{workers} processes solve the {plural} in parallel: points end in any order, and their times overlap")
    return workers


def _are_apart(points: str | list[float], workers: int) -> bool:
    """Return whether the ``points`` of a curve are shared by so many ``workers``; else the parts of each point are."""
    return points != studies.AUTO_SPEEDS and len(points) >= max(2, workers)


def _default_workers(scene: Scene, speeds: str | list[float]) -> int:
    """Return the number of processes of a curve: all processors but one, and two at least, where that pays. The numbers
    do not depend on it."""
    several_speeds = speeds != studies.AUTO_SPEEDS and len(speeds) >= WORTH and takes_strips(scene)
    slow_strips = has_moving_roughness(scene) and any(
        model.has_slow_strips for model in models_up_to(scene.numerics.model)
    )
    if not (several_speeds or slow_strips) or studies.processors() == 1:
        return 1
    return max(2, studies.processors() - 1)


def run_traction(scene: Scene, arguments: Namespace) -> None:
    """Compute a traction curve, and write traction.csv, traction.png, surface.png, report.html, resolved.toml
    and, last, result.json to ``arguments.out``. Points are kept, and shared by processes, as by `run_sweep`."""
    ratios = parse_ratios(arguments.ratios)
    measured = measured_of(arguments, "traction")
    ended: list[tuple[Any, ...]] = []
    progress = _progress("slide-roll ratio {:.4g}", scene, has_ratios=True)
    workers = _workers(arguments, scene, ratios)

    def kept() -> str:
        return _kept_in_words(len(ended), len(ratios), arguments.out)

    names = names_of_run("traction")
    begun = run_begun(scene, arguments, names, kept, ratios, "traction", kept_by="traction", ratios=ratios)
    with ProgressLine("ratios") as shown, begun as (folder, prepared, estimate), progress_to(moment_reports()):
        keys = studies.keys_of_ratios(prepared, ratios)
        _say_known(
            studies.count_of_kept_ratios(folder.unfinished, prepared.scene.motion.entrainment_speed, keys),
            len(ratios),
            arguments.out,
        )

        def on_point(*point: Any) -> None:
            if not ended:
                studies.keep_ratios(folder.unfinished, prepared.scene, keys)
            ended.append(point)
            shown.update(point[0], point[1])
            progress(*point)

        curve = studies.traction(
            prepared,
            in_percent(ratios),
            store=folder.unfinished,
            on_point=on_point,
            raise_on_failure=False,
            workers=workers,
        )
        folder.is_needed = not studies.is_all_solved(folder.unfinished)
        _write(folder, prepared, curve, arguments, estimate, [], measured)
        notes = gap_notes(curve)
        for note in notes[:MOST_GAPS]:
            say(f"note: {note}")
        if len(notes) > MOST_GAPS:
            say(f"note: report.html names {counted(len(notes) - MOST_GAPS, 'more ranges')} in which f is not known")
    _raise_if_failed(curve)


def _write(
    folder: RunFolder,
    prepared: Prepared,
    curve: studies.CurveResult,
    arguments: Namespace,
    estimate: SceneEstimate,
    chosen: list[float],
    measured: studies.Measured | None,
) -> None:
    """Write the table, the law, the fields of the ``chosen`` speeds, the pictures, the record; and what else was
    requested. ``estimate``: before it was solved; ``measured``: drawn with the curve."""
    name = _table_of(curve)
    contents = folder.contents
    table = f"{name}.csv"
    folder.add(table, studies.csv_bytes, curve)
    units = {number: COLUMNS[number] for number in (*NUMBERS, curve.SWEPT[0])}
    numbers = [_point(curve, i) for i in range(len(curve.points))]
    if table in contents:
        with folder.reporting(f"{name}.png was not drawn"):
            columns = read_table(folder.path / table, contents[table])
            if _drawable(columns).any():
                title = _title(prepared.scene.name, numbers)
                own = operating_point_of(prepared.scene, curve.SWEPT[0])
                folder.draw(f"{name}.png", _plot, columns, title, numbers, measured, PictureOptions(), own)
    with folder.reporting("the fields were not written"):
        _write_fields(folder, prepared, curve, chosen, vtk=arguments.vtk)
    law: studies.Law | str = ""
    unusual_values: list[str] = []
    with folder.reporting("law.json was not written"):
        law = _law(curve)
        if isinstance(law, studies.Law):
            contents |= {"law.json": law.json.encode(), "law.c": law.c.encode()}
    with folder.reporting("the uncertainty of f was not reported"):
        unusual_values = [*_largest_parts(curve), *_doubts(prepared.scene, curve)]
    if isinstance(law, studies.Law):
        unusual_values.append(f"formula of the curve (law.json, law.c): {law.warning or law.error_in_words}")
    given: dict[str, Any] = {}
    with folder.reporting("report.html does not show how the inputs were given"):
        given = given_tables(arguments.scene)
    again = _repeated(prepared.scene, curve, arguments)
    own = operating_point_of(prepared.scene, curve.SWEPT[0])
    folder.complete(
        prepared, estimate, given, curve, units, law, unusual_values, again, points=numbers, operating_point=own
    )


def _table_of(curve: studies.CurveResult) -> str:
    """Return the name of the table and the picture of a ``curve``."""
    return "traction" if curve.SWEPT[0] == "ratio" else "stribeck"


def _repeated(scene: Scene, curve: studies.CurveResult, arguments: Namespace) -> RepeatedRun:
    """Return how a run is repeated: the speeds of the command are in the scene, and what no key holds is an option."""
    if not isinstance(curve, studies.StribeckResult):
        return RepeatedRun(scene=scene, options=(f"--ratios={arguments.ratios}",))
    options = () if arguments.fields is None else (f"--fields={arguments.fields}",)
    if arguments.speeds is None:
        return RepeatedRun(scene=scene, options=options)
    if arguments.speeds != studies.AUTO_SPEEDS and is_among(scene.motion.entrainment_speed, curve.speed.tolist()):
        with suppress(InputError):  # speeds that a scene does not take
            return RepeatedRun(scene=scene.with_(motion={"speeds": tuple(curve.speed.tolist())}), options=options)
    return RepeatedRun(scene=scene, options=(f"--speeds={arguments.speeds}", *options))


def _write_fields(
    folder: RunFolder, prepared: Prepared, curve: studies.CurveResult, chosen: list[float], *, vtk: bool
) -> None:
    """Write the fields of the ``chosen`` speeds [m/s], and their pictures."""
    points = [p for p in curve.points if p is not None and (p.fields is not None or p.balance is not None)]
    points.sort(key=lambda p: chosen.index(p.speed))
    if points:
        folder.add("fields.npz", fields_bytes, points, prepared.scene.bodies.half_width)
        folder.draw("contact.png", plot_contact, drawn_contact(prepared, points[0]))
        if points[0].compared_fields is not None:
            folder.draw("sharing.png", plot_contact, compared_contact(prepared, points[0]))
    if vtk:
        touching = [p for p in points if p.shows_contact]
        for i, point in enumerate(touching):
            folder.add(f"contact_{i}.vtk", vtk_bytes, point)
        if not touching:
            say("no .vtk file: none of the speeds of --fields has a contact with fields")


def _title(name: str, points: list[dict[str, Any]]) -> str:
    """Return the title of the picture of a curve: the ``name`` of the scene, and by which models its ``points`` (of its
    record) are, the most frequent first. The band of the picture shows how large their errors are."""
    solved = [point for point in points if "error" not in point]
    stated = Counter(filter(None, map(_model_of_record, solved)))
    lines = [
        basis if count == len(solved) else f"{basis} ({count} of {counted(len(solved), 'points')})"
        for basis, count in stated.most_common()
    ]
    return "\n".join([name, *lines])


def _model_of_record(point: dict[str, Any]) -> str:
    """Return by which model a ``point`` of a record is, as `model_in_words`; "" in a record that does not have it."""
    model = point.get("model")
    return model_in_words(point.get("basis") or "", model or "") if model or point.get("basis") else ""


def _law(curve: studies.CurveResult) -> studies.Law | str:
    """Return the curve over the speed as a formula, or why there is none."""
    if not isinstance(curve, studies.StribeckResult):
        return ""
    if any(violation.severe for i in range(len(curve.points)) for violation in curve.violations(i)):
        return "some of its points are outside the range of the model"
    try:
        return curve.law()
    except InputError as why:
        return str(why)


def _operating_point_of_record(record: dict[str, Any]) -> float:
    """Return the scene's own speed [m/s] or slide-roll ratio that a ``record`` has; NaN where it has none."""
    value = record.get("operating_point")
    return float(value) if isinstance(value, (int, float)) else math.nan


def _drawable(columns: Columns) -> np.ndarray:
    """Return which rows of the table of a curve its picture can show: f is known, and over speeds something moves."""
    drawable: np.ndarray = np.isfinite(columns["coefficient"]) & ("ratio" in columns or columns["speed"] != 0)
    return drawable


def _point(curve: studies.CurveResult, index: int) -> dict[str, Any]:
    """Return the record of a point: its numbers, the error of f as text too, and the errors of the other numbers; or
    why there are none."""
    name = curve.SWEPT[0]
    point = curve.points[index]
    swept = {
        name: getattr(curve, name)[index],
        "validity": [asdict(violation) for violation in curve.violations(index)],
    }
    if point is None:
        return swept | {"error": str(curve.errors[index])}
    more = {
        "uncertainty": asdict(point.uncertainty) | {"text": point.uncertainty.text},
        "errors": asdict(point.errors),
        "report": point.report.as_dict(),
        "unmodelled_effects": [effect_in_words(effect) for effect in point.unmodelled_effects],
        "basis": point.decision.basis,
        "model": point.decision.model,
    }
    return {number: getattr(point, number) for number in NUMBERS} | swept | more


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
    options = _picture_options(arguments, name)
    columns = read_table(folder / f"{name}.csv")
    record = read_record(folder)
    title = record["scene"]["name"]
    if name == "history":
        again: Callable[..., Any] = partial(
            plot_history, columns=columns, title=figures.plain_words(title), options=options
        )
    else:
        points = _points_of(folder / f"{name}.csv", columns, record)
        again = partial(
            _plot,
            columns=columns,
            title=_title(title, points),
            points=points,
            measured=measured,
            options=options,
            operating_point=_operating_point_of_record(record),
        )
    _write_picture(arguments, name, again)


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
    kind = _table_of(curve)
    measured = measured_of(arguments, kind)
    options = _picture_options(arguments, kind)
    points = [_point(curve, i) for i in range(len(curve.points))]
    failed = f", {len(curve.errors)} failed" if curve.errors else ""
    say(f"the run is not finished: {unfinished.in_words}{failed}; the picture has these")
    (name, *models) = _title(unfinished.scene.name, points).splitlines()
    again = partial(
        _plot,
        columns=read_table(folder / f"{kind}.csv", studies.csv_bytes(curve)),
        title="\n".join([f"{name}, not finished: {unfinished.in_words}", *models]),
        points=points,
        measured=measured,
        options=options,
        operating_point=operating_point_of(unfinished.scene, curve.SWEPT[0]),
    )
    _write_picture(Namespace(**(vars(arguments) | {"folder": folder / SO_FAR})), kind, again)


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
    of_runs = (*OF_MEASURED, "panels", "x_scale", "y_scale", "interval")
    _refuse(arguments, of_runs, f"is for the picture of a run, and {arguments.folder} has a study; omit it")
    options = _picture_options(arguments, "study")
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
    _write_picture(Namespace(**(vars(arguments) | {"folder": folder})), "study", again)


def _plot_fit_again(arguments: Namespace) -> None:
    """Draw the picture of a fit again."""
    of_runs = (*OF_MEASURED, "panels", "without", "interval")
    _refuse(arguments, of_runs, f"is for the picture of a run, and {arguments.folder} has a fit; omit it")
    options = _picture_options(arguments, "fit")
    _write_picture(arguments, "fit", partial(plot_fit, record=read_fit(arguments.folder / FIT), options=options))


def _plot_contact_again(arguments: Namespace) -> None:
    """Draw the picture of the contact at the speed ``arguments.contact`` again."""
    of_curves = (*OF_MEASURED, "panels", "x_scale", "y_scale", "without", "interval")
    _refuse(arguments, of_curves, "is for the picture of a curve, and --contact draws the contact; omit one of them")
    contact = read_contact(arguments.folder / "fields.npz", number_of("--contact", arguments.contact, "m/s"))
    options = PictureOptions(width=_width(arguments), dpi=_dpi(arguments))
    _write_picture(
        arguments, f"contact_at_{contact.speed:.4g}", partial(plot_contact, contact=contact, options=options)
    )


def _write_picture(arguments: Namespace, name: str, draw: Callable[..., Any]) -> None:
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


def _picture_options(arguments: Namespace, name: str) -> PictureOptions:
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
    form = INTERVAL_FORMS[0]
    if arguments.interval is not None:
        if name == "history":
            raise InputError(f"--interval is for a curve, and this is {TABLES[name]}; omit it")
        form = validate.choice("--interval", arguments.interval, INTERVAL_FORMS)
    words = [] if arguments.without is None else arguments.without.split(",")
    left_out = [validate.choice("--without", word.strip().replace("-", " "), LEFT_OUT) for word in words]
    lines = tuple(line for line in LINES if line in left_out)
    if lines and name not in PANELS:
        raise InputError(f"--without {lines[0]!r} is for a curve, and this is {TABLES.get(name, f'a {name}')}; omit it")
    return PictureOptions(
        panels=panels,
        width=_width(arguments),
        dpi=_dpi(arguments),
        **scales,
        has_warnings="warnings" not in left_out,
        has_parts="parts" not in left_out,
        has_title="title" not in left_out,
        has_bars=form == "bars",
        without=lines,
    )


def _points_of(source: Path, columns: Columns, record: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the points of a ``record`` that belong to the table ``source``, of which something can be drawn."""
    points: list[dict[str, Any]] = record.get("points", [])
    count = columns["coefficient"].size
    if len(points) != count:
        raise InputError(f"{source} has {count} rows and result.json {len(points)} points; run 'lubfric run' again")
    if not _drawable(columns).any():
        first = next((f"; first: {point['error']}" for point in points if "error" in point), "")
        raise InputError(f"nothing to draw: none of the {count} points in {source} moves and has an answer{first}")
    return points


def _plot(
    path: Path,
    columns: Columns,
    title: str,
    points: list[dict[str, Any]],
    measured: Any = None,
    options: PictureOptions = PictureOptions(),
    operating_point: float = math.nan,
) -> None:
    """Draw the picture of the table of a curve; ``points``: those of its record; ``operating_point``: the scene's own
    speed [m/s] or slide-roll ratio."""
    unknown = {"value": math.nan, "limit": math.nan}  # numbers that are not finite are null in a record
    known = [
        [{k: v for k, v in violation.items() if v is not None} for violation in point["validity"]] for point in points
    ]
    violations = [[Violation(**unknown | violation) for violation in each] for each in known]
    title = figures.plain_words(title)
    if "ratio" in columns:
        (first, *others) = title.splitlines()
        speed = columns["speed"][np.isfinite(columns["coefficient"])][0]
        title = "\n".join([f"{first}, U = {speed:.4g} m/s", *others])
    if options.is_narrow:  # what the answers rest on is for the caption
        title = title.splitlines()[0]
    swept = columns["ratio" if "ratio" in columns else "speed"]
    own = [value for value in swept[_drawable(columns)].tolist() if is_among(value, [operating_point])]
    plot = plot_traction if "ratio" in columns else plot_stribeck
    marked = own[0] if own and swept.size > 1 else math.nan
    plot(path, columns, title, violations, measured, options, operating_point=marked)


# How a note begins that says why an error is not known.
UNKNOWN = "sampling not known: "


def _largest_parts(curve: studies.CurveResult) -> list[str]:
    """Return what the largest part of the interval of f is and what reduces it, in a line for all points that have the
    same; none for points where no input or tolerance reduces it."""
    name, _, unit, plural = curve.SWEPT
    places: dict[str, list[float]] = {}
    for value, point in zip(getattr(curve, name).tolist(), curve.points):
        part, advice = ("", "") if point is None else point.uncertainty.largest_part_and_advice
        if advice:
            places.setdefault(f"{part}{advice}", []).append(value)
    return [
        f"largest part of the interval of f {at_values(values, unit, plural)}: {words}"
        for words, values in places.items()
    ]


def _doubts(scene: Scene, curve: studies.CurveResult) -> list[str]:
    """Return the errors of f as text: why points have no interval, in a line for all of the same reason; at how many
    others there are notes, and those of the least sure; at how many points too few asperity contacts carry the load;
    and that results were accepted."""
    name, _, unit, plural = curve.SWEPT
    points = [(value, p.uncertainty) for value, p in zip(getattr(curve, name), curve.points) if p is not None]
    noted = [point for point in points if point[1].notes and math.isfinite(point[1].sampling)]
    unknown: dict[str, list[tuple[float, tuple[str, ...]]]] = {}
    for value, known in points:
        if known.notes and not math.isfinite(known.sampling):
            unknown.setdefault(known.notes[0], []).append((value, known.notes))
    lines = [
        f"no 95 % interval of f {at_values([value for value, _ in same], unit, plural)}: "
        f"{_common_notes(same).removeprefix(UNKNOWN)}"
        for same in unknown.values()
    ]
    few = [value for value, known in points if known.has_few_contacts]
    if noted:
        place, worst = max(noted, key=lambda p: -1.0 if p[1].is_near_zero else p[1].sampling)
        others = counted(len(noted) - 1, f"more {plural}")
        more = f", where its sampling error is largest (result.json has {others})" if len(noted) > 1 else ""
        lines.append(f"uncertainty of f {at_value(place, unit, plural)}{more}: {'; '.join(worst.notes)}")
        if few and few != [place]:
            where = ", ".join(at_value(value, unit, plural) for value in few)
            lines.append(f"few asperity contacts carry the load {where}, so these intervals may be too narrow")
    if scene.numerics.accept and any(e.severe for i in range(len(curve.points)) for e in curve.violations(i)):
        lines.append("accepted outside the range of the model (--accept): the marked coefficients have no meaning")
    return lines


def _common_notes(points: list[tuple[float, tuple[str, ...]]]) -> str:
    """Return the notes that all ``points``, pairs of a value and its notes, have; those of one point alone are in
    result.json."""
    (_, first), *others = points
    return "; ".join(note for note in first if all(note in notes for _, notes in others))


def _raise_if_failed(curve: studies.CurveResult) -> None:
    """Say how many points failed and how many were refused, and the first of them."""
    if not curve.errors:
        return
    total = len(curve.points)
    plural = curve.SWEPT[3]
    failed = sum(not isinstance(error, ValidityError) for error in curve.errors.values())
    counts = [f"{failed} of {counted(total, plural)} failed"] if failed else []
    if len(curve.errors) > failed:
        counts.append(f"{len(curve.errors) - failed} of {counted(total, plural)} refused (--accept keeps them, marked)")
    raise ConvergenceError(f"{', '.join(counts)}; first: {curve.errors[min(curve.errors)]}", curve.report)


def _requested(scene: Scene, speeds: str | None, fields: str | None) -> tuple[Any, ...]:
    """Return the speeds [m/s] to solve, or "auto", and those of them whose fields are drawn and written: of ``fields``,
    which are added where they are missing, in order if the others are in order, as a line on stderr says; else the one
    nearest to the scene's own."""
    own = scene.motion.entrainment_speed
    chosen = parse_speeds("--fields", fields)
    if speeds == studies.AUTO_SPEEDS:
        return studies.AUTO_SPEEDS, [abs(u) for u in chosen or [own] if u != 0]
    requested = parse_speeds("--speeds", speeds) or speeds_of_curve(scene)
    _say_operating_point(scene, requested, are_of_command=speeds is not None)
    validate.array("speeds", requested, "m/s", ndim=1)
    if not chosen:
        return requested, [min(requested, key=lambda speed: abs(speed - own))]
    solved = list(requested)
    with_fields = []
    for speed in chosen:
        near = [u for u in solved if math.isclose(u, speed, rel_tol=1e-9)]
        with_fields.append(near[0] if near else speed)
        solved += [] if near else [speed]
    added = [f"{speed:.4g}" for speed in solved[len(requested) :]]
    if added:
        say(
            f"{counted(len(requested), 'speeds')} requested; added: {', '.join(added)} m/s, whose fields are drawn "
            "(--fields)"
        )
    return (sorted(solved) if requested == sorted(requested) else solved), with_fields


def _say_operating_point(scene: Scene, requested: list[float], *, are_of_command: bool) -> None:
    """Say whether the scene's own speed is solved beside the ``requested`` speeds [m/s], or why it is not; nothing
    where it is one of them. ``are_of_command``: the speeds are those of --speeds."""
    own = scene.motion.entrainment_speed
    in_scene = scene.motion.speeds
    if is_among(own, requested):
        if not are_of_command and in_scene and not is_among(own, in_scene):
            say(
                f"{counted(len(in_scene), 'speeds')} in the scene; added: {own:.4g} m/s, its own speed "
                "(motion.entrainment_speed), the operating point"
            )
        return
    say(f"{operating_point_not_solved(scene, requested)} The operating point of the report is the speed nearest to it.")


def parse_speeds(option: str, text: str | None, unit: str = "m/s", most: float = FASTEST) -> list[float]:
    """Return the values of a command's ``option``: 'a,b,c' or the geometric 'low:high:count', in ``unit`` or each with
    its own; none above ``most``."""
    if text is None:
        return []
    if ":" in text:
        return _range(option, text.split(":"), unit, most, linear=False)
    words = text.split(",")
    decimal = re.fullmatch(r"\s*([+-]?\d+),(\d+)(\s*[^\s\d.,:][^,]*)?", text)  # '0,2 m/s'
    if decimal is not None or any(re.match(r"[+-]?0\d", word.strip()) for word in words):
        likely = "write a point in decimals, 0.01"
        if decimal is not None:
            (first, second, suffix) = ((part or "").rstrip() for part in decimal.groups())
            likely = f"write a point in decimals, '{first}.{second}{suffix}', or for two values '{first}{suffix}, {second}{suffix}'"
        raise InputError(f"{option} {validate.shown(text)}: a comma separates values; {likely}")
    apart = text.split()
    if len(words) == 1 and len(apart) > 1 and all(_is_number(word) for word in apart):
        raise InputError(
            f" {validate.shown(text)}", option, recommendation=f"separate values by commas, {','.join(apart)}"
        )
    ends = re.fullmatch(r"\s*(\S+)\s+to\s+(\S+)\s*", text)
    if ends is not None:
        example = f"{ends[1]}:{ends[2]}:11"
        raise InputError(f" {validate.shown(text)}", option, recommendation=f"write low:high:count, such as {example}")
    numbers = numbers_of(option, words, [unit] * len(words))
    for number in numbers:
        validate.number(option, number, unit, minimum=-most, maximum=most)
    once = list(studies.each_once(numbers))
    if len(once) < len(numbers):
        say(f"{option}: {counted(len(numbers) - len(once), 'values')} given twice, solved once")
    return once


def _is_number(word: str) -> bool:
    """Return whether a ``word`` is a number without a unit."""
    parts = number_and_unit(word)
    return parts is not None and parts[1] == ""


def in_percent(ratios: list[float]) -> list[float] | list[str]:
    """Return ``ratios`` that were checked as text in percent, where some are such as `lubfric.traction` questions."""
    return [f"{100 * ratio!r} %" for ratio in ratios] if max(map(abs, ratios)) > MOST_RATIO else ratios


def parse_ratios(text: str | None) -> list[float]:
    """Return the slide-roll ratios of --ratios: 'a,b,c', or 'low:high:count', geometric, or in equal steps where low is
    0 or negative or ':linear' follows."""
    parts = [] if text is None else text.split(":")
    spacing = parts.pop().strip().lower() if len(parts) == 4 else ""
    if spacing not in ("", "linear", "log"):
        raise InputError(f" {validate.shown(text)} ends with {validate.shown(spacing)}", "--ratios", "linear or log")
    if len(parts) != 3:
        ratios = parse_speeds("--ratios", ":".join(parts) if parts else text, "-", LARGEST_RATIO)
    else:
        at_zero = number_of("--ratios", parts[0], "-") <= 0
        linear = spacing == "linear" or (at_zero and spacing == "")
        ratios = _range("--ratios", parts, "-", LARGEST_RATIO, linear=linear)
    if "%" not in (text or ""):
        check_ratios("--ratios", ratios)
    return ratios


def _range(option: str, words: list[str], unit: str, most: float, *, linear: bool) -> list[float]:
    """Return the values of a range of ``words`` low, high and count, in equal steps or geometric. Raise `InputError`
    that says what is wrong with it, and what to write."""
    text = validate.shown(":".join(words))
    example = "0:0.5:11" if linear else "0.001:1:13"
    if len(words) != 3:
        parts = counted(len(words), "parts")
        raise InputError(f" {text} has {parts}", option, recommendation=f"write low:high:count, such as {example}")
    low, high, count = numbers_of(option, words, [unit, unit, "-"])
    for end in (low, high):
        validate.number(option, end, unit, minimum=-most, maximum=most)
    shown = "" if unit == "-" else f" {unit}"
    if low == high:
        recommendation = f"write {low:g} for this value alone"
        raise InputError(f" {text} begins and ends at {low:g}{shown}", option, recommendation=recommendation)
    if low > high:
        recommendation = f"write the smaller one first, {words[1].strip()}:{words[0].strip()}:{words[2].strip()}"
        raise InputError(
            f" {text} begins at {low:g}{shown}, above its end {high:g}{shown}", option, recommendation=recommendation
        )
    if not linear and low <= 0:
        recommendation = "begin above 0, or list the values, separated by commas"
        recommendation += ", or end it with :linear" if option == "--ratios" else ""
        raise InputError(
            f" {text} begins at {low:g}{shown}: a geometric range has no value at or below 0",
            option,
            recommendation=recommendation,
        )
    if count not in range(2, MOST_SPEEDS + 1):
        recommendation = f"write a whole number from 2 to {MOST_SPEEDS}" + (
            f", or {low:g} for one value" if count == 1 else ""
        )
        raise InputError(f" {text} has {count:g} values", option, recommendation=recommendation)
    if linear:
        return [
            float(f"{value:.12g}") for value in np.linspace(low, high, int(count))
        ]  # 0.05, not 0.049999999999999996
    values: list[float] = np.geomspace(low, high, int(count)).tolist()
    return values


def _progress(place: str, scene: Scene, *, is_total_known: bool = True, has_ratios: bool = False) -> Callable[..., Any]:
    """Return what says how a point of ``scene`` ended; ``place``: the template of its place on the curve.
    ``is_total_known``: whether the number of points is; ``has_ratios``: the points differ in their slide-roll ratio."""

    def on_point(done: int, total: int, value: float, outcome: FrictionResult | ValidityError) -> None:
        number = f"{done:>{len(str(total))}}/{total}" if is_total_known else str(done)
        head = f"[{number}] {place.format(value)}"
        if isinstance(outcome, Exception):
            say(f"{head}: {'refused' if isinstance(outcome, ValidityError) else 'failed'}: {outcome}")
            return
        loads = in_words(outcome, ("contact_load", "film_load"))
        words = ", ".join(f"{symbol} = {load}" for symbol, load in loads.items())
        known = outcome.uncertainty
        omitted = f"; {outcome.not_in_interval}" if outcome.not_in_interval else ""
        time_ = f"(wall-clock time of the point {outcome.seconds:.2f} s)"
        ratio = value if has_ratios else scene.motion.slide_roll_ratio
        rolling = rolling_in_words(outcome, ratio * outcome.speed).replace(", of", " of", 1)
        loss = f"P = {with_interval(outcome.power_loss, *outcome.power_loss_interval, unit='W')}{rolling}"
        say(f"{head}: {known.short(outcome.coefficient)}{omitted}; {loss}; {words} {time_}")

    return on_point
