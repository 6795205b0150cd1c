"""``lubfric study`` and ``lubfric fit``: carry out a study file, or find numbers of a scene from a measured curve.
Both write to a folder."""

from __future__ import annotations

import json
import math
import shlex
import time
from argparse import Namespace
from collections.abc import Callable
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from .. import studies
from .._base import files, plain, validate
from .._base.progress import progress_to
from ..errors import ITERATION_LIMIT, ConvergenceError, InputError, Report, ValidityError
from ..estimate import FrictionResult
from ..models.shared import Assumption
from ..quantities import KEYS, counted, worded_value
from ..scene import given_tables
from ..units import number_and_unit, numbers_of, with_interval, worded
from .command_line import scene_of
from .commands import (
    CommandStart,
    RunFolder,
    answer,
    check_outputs,
    keeping,
    made,
    map_checksums,
    moment_reports,
    paced,
    references,
    run_folder,
    say,
)
from .fit_picture import drawn_record, plot_fit
from .fit_report import fit_page
from .plot_again import read_measured_of
from .progress import ProgressLine
from .run_files import BIBTEX_FILE, RESOLVED_SCENE, RESOLVED_STUDY
from .study_answer import answer_lines, numbered_point, planned_point_in_words
from .study_pictures import STUDY_PICTURE, plot_study
from .study_report import study_page, times_in_words
from .study_warnings import tolerance_lines, warning_lines
from .time_left import TimeLeft


def run_study(arguments: Namespace) -> None:
    """Plan, solve, write study.csv, study.png, report.html and references.bib (and study.nc, study.parquet), and report
    the smallest and the largest f and power loss, and which points miss a tolerance."""
    workers = validate.integer("--workers", arguments.workers, minimum=1, maximum=studies.MOST_WORKERS)
    if arguments.cluster is not None and workers > 1:
        raise InputError("--cluster and --workers both say who solves; give one of them")
    plan = studies.load_study(arguments.study, arguments.points)
    if arguments.explain:
        answer(plan.explain(arguments.out, workers=workers) + "\n")
        return
    studies.check_tools(netcdf=arguments.netcdf, parquet=arguments.parquet)
    wanted = {"csv": True, "nc": arguments.netcdf, "parquet": arguments.parquet}
    names = [f"study.{kind}" for kind, given in wanted.items() if given]
    others = (STUDY_PICTURE, "report.html", BIBTEX_FILE, RESOLVED_SCENE, RESOLVED_STUDY)
    check_outputs(arguments, arguments.out, [*names, *others])
    (explanation, expected, known) = studies.explained(plan, arguments.out, workers=workers, refuses=True)
    say(explanation)
    given = studies.given_tables_of_study(arguments.study)
    begun = CommandStart.now()
    workers_of = studies.pool(workers) if arguments.cluster is None else studies.cluster(arguments.cluster)
    kept = keeping(lambda: _kept(arguments.out))
    time_left = None if arguments.cluster is not None else TimeLeft(expected, workers)
    with ProgressLine("points", time_left) as shown, kept, workers_of as executor, progress_to(moment_reports()):
        result = studies.study(
            plan,
            executor=executor,
            store=arguments.out,
            on_progress=_progress(plan, shown),
            on_point=_point_reports(plan, begun.moment, time_left),
        )
    writers = {"csv": result.to_csv, "nc": result.to_netcdf, "parquet": result.to_parquet}
    with run_folder(arguments.out, begun) as folder, keeping(lambda: _written(folder)):
        for name in names:
            folder.add(name, made, name, writers[name.partition(".")[2]])
        if np.isfinite(result["coefficient"]).any():
            folder.draw(STUDY_PICTURE, plot_study, result)
        for line in warning_lines(result):
            say(line)
        rows: list[str] = []
        with folder.reporting("the smallest and the largest f were not reported"):
            rows = answer_lines(result)
        folder.add("report.html", study_page, result, folder.contents, rows, known, given)
        if np.isfinite(result["coefficient"]).any():
            folder.add(BIBTEX_FILE, lambda: references(result))
        folder.add(RESOLVED_SCENE, lambda: plan.scene.to_toml(arguments.out).encode())
        folder.add(RESOLVED_STUDY, lambda: plan.to_toml(RESOLVED_SCENE).encode())
        folder.put()
    for row in (*rows, *tolerance_lines(result), *([times_in_words(result, known)] if known else [])):
        say(row)
    if result.failed:
        report = Report(
            "study", ITERATION_LIMIT, iterations=result.solved - result.failed, residual=float("inf"), tolerance=0.0
        )
        message = f"{result.failed} of {counted(result.solved, 'points')} failed; first: {result.failures[0]}"
        raise ConvergenceError(message, report, result)


# Time between two points up to which a process handed them over together [s]. A choice: a smaller value counts a batch
# as points one by one, and the time left jumps.
SECONDS_OF_A_BATCH = 0.2

# Time after which points that come one after the other are counted anew for the time left [s]. A choice: more updates
# the time left later.
LONGEST_BATCH = 5.0

# Points of a study up to which each one gets a line on stderr. A choice: more fills the screen.
MOST_LINES = 200


def _kept(folder: Path) -> str:
    try:
        study = studies.open_study(folder)
    except InputError:
        return ""
    if not study.solved:
        return ""
    kept = f"{counted(study.solved, 'points')} {_verb(study.solved)} kept in {folder}"
    kind = "curves" if study.chosen else "points"
    return f"{kept}, {counted(study.missing, kind)} {_verb(study.missing)} left"


def _written(folder: RunFolder) -> str:
    """Return what is kept where the writing of the files of a study is interrupted, as text."""
    files = [name for name, content in folder.contents.items() if _holds(folder.path / name, content)]
    return (
        f"the solved points are kept in {folder.path}, and of the tables and the report {', '.join(files) or 'no file'} "
        f"{_verb(max(len(files), 1))} written"
    )


def _holds(path: Path, content: bytes) -> bool:
    """Return whether the file ``path`` holds the ``content``."""
    return path.is_file() and path.read_bytes() == content


def _verb(count: int) -> str:
    return "is" if count == 1 else "are"


def _progress(plan: studies.StudyPlan, shown: ProgressLine) -> Callable[[int, int], None]:
    """Return what reports how many points, or curves that choose their speeds, have ended."""
    before = -1

    def on_progress(done: int, total: int) -> None:
        nonlocal before
        if plan.chooses_speeds and shown.time_left is not None and before >= 0:
            for _ in range(done - before):
                shown.time_left.end_next()
        before = done
        shown.update(done, total)

    return on_progress


def _point_reports(plan: studies.StudyPlan, begun: float, time_left: TimeLeft | None = None) -> Callable[..., None]:
    """Return what writes f and the power loss of each point when it is solved, with the time left (without
    ``time_left`` by the points so far): of each one in a study of up to `MOST_LINES` points, else of one a second."""
    due = paced()
    first = -1
    # when the last points came together, as a process hands over several, and how many were done then
    batch = (begun, 0)
    last = begun
    first_with_reason: dict[str, str] = {}

    def on_point(done: int, total: int, index: tuple[int, ...], outcome: Any) -> None:
        nonlocal first, batch, last
        first = done - 1 if first < 0 else first  # what the store held already took no time
        now = time.perf_counter()
        if now - last > SECONDS_OF_A_BATCH or last - batch[0] > LONGEST_BATCH:
            batch = (last, done - 1 - first)
        last = now
        if time_left is not None and not plan.chooses_speeds:
            along = index if plan.paired else index[:-1]
            curve = int(np.ravel_multi_index(along, plan.curve_shape)) if along else 0
            time_left.end((plan.keys[curve], plan.point_speed(index)))
        if total > MOST_LINES and not due(end=done == total):
            return
        head = f"[{done:>{len(str(total))}}/{total}{' curves' if plan.chooses_speeds else ''}]"
        passed = time.perf_counter() - begun
        of_this = f"of the point {outcome.seconds:.2f} s, " if isinstance(outcome, FrictionResult) else ""
        ends = f"wall-clock time {of_this}of the study so far {passed:.0f} s"
        if time_left is not None:
            ends += time_left.in_words() if done < total else ""
        elif 0 < batch[1] and done < total:
            ends += f", about {studies.in_words((batch[0] - begun) * (total - done) / batch[1])} left"
        place = _place(plan, index, outcome)
        text = _in_a_line(outcome)
        if not isinstance(outcome, FrictionResult):
            of_point = place if plan.chooses_speeds else numbered_point(plan, index)
            earlier = first_with_reason.setdefault(text, of_point)
            text = text if of_point == earlier else f"{_how_it_failed(outcome)} for the same reason as {earlier}"
        say(f"{head} {place}: {text} ({ends})")

    return on_point


def _place(plan: studies.StudyPlan, index: tuple[int, ...], outcome: Any) -> str:
    """Return where a point lies, as text; of a curve that chooses its speeds with the speed of the ``outcome``."""
    if not plan.chooses_speeds:
        return planned_point_in_words(plan, index)
    speed = f"speed {worded(outcome.speed, 'm/s')}" if isinstance(outcome, FrictionResult) else ""
    return ", ".join(filter(None, (studies.label(plan, index[:-1]), speed)))


# What a negative f is, on the line of a point.
NEGATIVE = " (negative: the rolling resistance on surface 2 is above the friction of sliding)"


def _how_it_failed(error: Exception) -> str:
    """Return whether the model refused a point, or the solve failed, in a word."""
    return "refused" if isinstance(error, ValidityError) else "failed"


def _in_a_line(outcome: FrictionResult | Exception) -> str:
    """Return f and the power loss of a point with their intervals, or why it failed."""
    if not isinstance(outcome, FrictionResult):
        return f"{_how_it_failed(outcome)}: {outcome}"
    f = with_interval(outcome.coefficient, *outcome.uncertainty.interval)
    negative = NEGATIVE if outcome.coefficient < 0 and outcome.speed >= 0 else ""
    unknown = "" if math.isfinite(outcome.uncertainty.interval[0]) else " (95 % interval not known)"
    power = with_interval(outcome.power_loss, *outcome.power_loss_interval, unit="W")
    heat = next((each for each in outcome.validity if each.assumption == Assumption.HEAT_INCLUDED), None)
    without = f"; without the heat of the film, which lowers f by up to {heat.value_in_words} %" if heat else ""
    return f"f = {f}{negative}{unknown}, P = {power}{without}"


def run_fit(arguments: Namespace) -> None:
    """Say what it will cost, search, and write fitted.toml, fit.png, report.html, references.bib and, last,
    fit.json."""
    for name in ("measured", "coefficient"):
        if getattr(arguments, name) is None:
            raise InputError(f"lubfric fit needs --{name}, the measured curve with the heading of its coefficients")
    if (arguments.speed is None) == (arguments.ratio is None):
        raise InputError("a measured curve is over one quantity; give --speed or --ratio, the heading of its column")
    scene = scene_of(arguments)
    check_outputs(arguments, arguments.out, ("fitted.toml", "fit.png", "report.html", BIBTEX_FILE, "fit.json"))
    scene.to_toml()  # raises InputError now, rather than after the fit
    bounds = _bounds(arguments.parameter)
    begun = CommandStart.now()
    due = paced()
    columns = {"speed": arguments.speed, "slide_roll_ratio": arguments.ratio}
    measured = read_measured_of(arguments, rolling=not arguments.without_rolling, **columns)
    checksums = {str(arguments.measured): files.checksum_of_file(arguments.measured)} | map_checksums(scene)
    given = given_tables(arguments.scene)
    say(studies.explain_fit(scene, measured, bounds, starts=arguments.starts))

    def on_progress(done: int, total: int, left: float, misfit: float, values: dict[str, float]) -> None:
        if due(end=done == 1):
            misfit_in_words = (
                f"{100 * misfit:.2g} % of f" if measured.deviation is None else f"{misfit:.3g} of the stated deviations"
            )
            place = ", ".join(f"{key} = {worded_value(key, value)}" for key, value in values.items())
            to_come = f"about {studies.in_words(left)} left" if done < total else "the last of the expected curves"
            passed = f"{begun.processor_seconds:.0f} s of processor time, {to_come}"
            state = (
                f"fit, curve {done} of about {total}: smallest root mean square residual so far {misfit_in_words}, "
                f"at {place}"
            )
            if math.isnan(misfit):
                state = f"search by the load-sharing model, curve {done} of about {total}: lowest at {place}"
            say(f"{state}; {passed}")

    with keeping(lambda: f"the points solved so far are kept in {arguments.out}"), progress_to(moment_reports()):
        fitted = studies.fit(
            scene, measured, bounds, starts=arguments.starts, store=arguments.out, on_progress=on_progress
        )
    say(fitted.explain())
    with run_folder(arguments.out, begun) as folder:
        folder.add("fitted.toml", lambda: fitted.to_toml().encode())
        folder.draw("fit.png", plot_fit, drawn_record(fitted))
        made_of = {
            "command": _fit_command(arguments),
            "sha256": checksums,
            "curves": fitted.report.evaluations,
            "seconds": begun.seconds,
            "processor_seconds": begun.processor_seconds,
        }
        page = partial(fit_page, given=given, record=made_of)
        folder.add("report.html", page, fitted, folder.contents)
        folder.add(BIBTEX_FILE, references, fitted)
        folder.add("fit.json", lambda: json.dumps(plain(_record(fitted)), indent=1).encode())
        folder.put()


def _fit_command(arguments: Namespace) -> str:
    """Return the command that repeats a fit."""
    options = {
        "surface": arguments.surface,
        "counterface": arguments.counterface,
        "measured": arguments.measured,
        "speed": arguments.speed,
        "ratio": arguments.ratio,
        "coefficient": arguments.coefficient,
        "deviation": arguments.deviation,
        "measured-label": arguments.measured_label,
        "starts": arguments.starts,
    }
    words = [word for name, value in options.items() if value is not None for word in (f"--{name}", str(value))]
    words += ["--without-rolling"] if arguments.without_rolling else []
    words += [word for text in arguments.parameter for word in ("--parameter", text)]
    return shlex.join(("lubfric", "fit", str(arguments.scene), *words))


def _has_unit(word: str) -> bool:
    """Return whether a ``word`` is a number with a unit."""
    parts = number_and_unit(word)
    return parts is not None and parts[1] != ""


def _bounds(texts: list[str]) -> dict[str, tuple[Any, Any]]:
    """Return the bounds by key: numbers, and text of those with a unit, which is stated and not to be questioned."""
    bounds: dict[str, tuple[Any, Any]] = {}
    for text in texts:
        name, _, ends = text.partition("=")
        key = name.strip()
        ways = "write 'section.key=lowest:highest', in SI or with units, once for each key"
        if ends.count(":") != 1 or key in bounds:
            raise InputError(f" {validate.shown(text)}", "--parameter", recommendation=ways)
        words = [word.strip() for word in ends.split(":")]
        if key in KEYS:
            numbers = numbers_of(f"--parameter {key}", words, [KEYS[key].unit] * 2)
            low, high = (word if _has_unit(word) else number for word, number in zip(words, numbers))
            bounds[key] = (low, high)
        else:
            bounds[key] = (words[0], words[1])  # refused with the nearest key
    return bounds


def _record(fitted: studies.FitResult) -> dict[str, Any]:
    of_fit = ("values", "intervals", "covariance", "moved_by_surface", "undetermined", "undetermined_sides")
    names = (*of_fit, "at_bounds", "validity", "describes_data", "other_minima", "starts", "tolerance")
    return {name: getattr(fitted, name) for name in names} | {
        "parameters": list(fitted.parameters),
        **drawn_record(fitted),
        "report": fitted.report.as_dict(),
        "residual_tests": None if fitted.tests is None else asdict(fitted.tests),
    }
