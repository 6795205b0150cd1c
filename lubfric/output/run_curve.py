"""``lubfric run`` on a steady scene: its Stribeck curve, or (``--ratios``) its traction curve, written to a folder."""

from __future__ import annotations

import math
import time
from argparse import Namespace
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

from .. import studies
from .._base import read_table, validate
from .._base.jobs import parts_on
from .._base.progress import progress_to
from ..errors import ConvergenceError, InputError, ValidityError
from ..estimate import FrictionResult
from ..models import models_up_to
from ..models.shared import Prepared, at_value, at_values
from ..quantities import COLUMNS, NUMBERS, counted, in_words
from ..samples import takes_strips
from ..scene import (
    Scene,
    given_tables,
    has_moving_roughness,
)
from ..units import plain_number, with_interval
from .commands import (
    RepeatedRun,
    RunFolder,
    moment_reports,
    run_begun,
    say,
)
from .contact_pictures import compared_contact, drawn_contact, plot_contact
from .curve_answer import gap_notes
from .curve_picture import ADDED_SPEEDS, draw_curve, drawable, record_of_point, table_of, title_of_curve
from .describe import SceneEstimate, index_of_nearest, is_among, rolling_in_words, speeds_of_curve
from .fields import fields_bytes, vtk_bytes
from .operating_point import operating_point_not_solved, operating_point_of
from .picture_options import PictureOptions
from .plot_again import measured_of
from .progress import ProgressLine
from .regime import regime_of
from .run_files import names_of_run
from .swept_values import in_percent, parse_ratios, parse_speeds
from .time_left import TimeLeft

WORTH = 8  # speeds from which a second process gains more than it costs; a choice: a process takes a second to start

MOST_GAPS = 3  # gaps of a traction curve that are named; a choice

# What the lines of a point begin with, but for the first.
INDENT = "    "

# How a note begins that says why an error is not known.
UNKNOWN = "sampling not known: "

# Which runs still need the points that are kept, as text.
RUN_WITH_MORE_POINTS = (
    "the points of an interrupted run of this scene with more points; the command of that run continues it"
)


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
    progress = _progress("U = {:.4g} m/s", is_total_known=speeds != studies.AUTO_SPEEDS)
    names = names_of_run("stribeck")
    names += [f"contact_{i}.vtk" for i in range(len(chosen) if arguments.vtk else 0)]

    def kept() -> str:
        return _kept_in_words(len(ended), total, arguments.out)

    workers = _workers(arguments, scene, speeds)
    speeds_apart = _are_apart(speeds, workers)
    with studies.pool(workers) as executor, parts_on(None if speeds_apart else executor):
        begun = run_begun(scene, arguments, names, kept, speeds, chosen, kept_by="stribeck", speeds=speeds)
        with (
            begun as (folder, prepared, estimate),
            ProgressLine("speeds", _time_left(estimate, workers, are_apart=speeds_apart)) as shown,
            progress_to(moment_reports()),
        ):
            requested = () if speeds == studies.AUTO_SPEEDS else speeds
            known = studies.count_of_kept(folder.unfinished, prepared, requested, chosen)
            folder.continues = known > 0
            _say_known(known, len(requested), arguments.out)
            shown.update(0, len(requested))

            def on_point(*point: Any) -> None:
                if not ended:
                    studies.keep_request(folder.unfinished, prepared, requested)
                ended.append(point)
                _end_of_point(shown, point[2], is_known=len(ended) <= known)
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
            folder.needed_by = "" if studies.is_all_solved(folder.unfinished) else RUN_WITH_MORE_POINTS
            _write(folder, prepared, curve, arguments, estimate, chosen, measured, known)
    _raise_if_failed(curve)


def _time_left(estimate: SceneEstimate, workers: int, *, are_apart: bool) -> TimeLeft:
    """Return the time left of a curve by its ``estimate``, whose points are solved by so many ``workers``;
    ``are_apart``: each point by one of them, else all of them share one point, and report their processor time late."""
    if workers > 1 and not are_apart:
        return TimeLeft(estimate.point_seconds, spent=time.monotonic)
    return TimeLeft(estimate.point_seconds, workers)


def _end_of_point(shown: ProgressLine, value: float, *, is_known: bool) -> None:
    """Report to the time left on the line ``shown`` that the point at this ``value``, a speed or a ratio, ended; the
    next one where the curve chose the value. ``is_known``: it was solved before."""
    left = shown.time_left
    if left is None or not left.expected:
        return
    point = value if value in left.expected else next(iter(left.expected))
    (left.omit if is_known else left.end)(point)


def _kept_in_words(count: int, total: int | str, out: Path) -> str:
    """Return how many of ``total`` points an interrupted run keeps in the folder ``out``, as text; "" for none."""
    verb = "is" if count == 1 else "are"
    return f"{count} of {total} points {verb} kept in {out}" if count else ""


def _say_known(known: int, total: int, out: Path) -> None:
    """Say how many of ``total`` points (0: the curve chooses them) an interrupted run has solved in the folder ``out``;
    nothing for none."""
    if known:
        verb = "is" if known == 1 else "are"
        points = f"{known} of {counted(total, 'points')}" if total else counted(known, "points")
        say(f"{points} {verb} solved already, by an interrupted run in {out}")


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
    progress = _progress("slide-roll ratio {:.4g}")
    workers = _workers(arguments, scene, ratios)

    def kept() -> str:
        return _kept_in_words(len(ended), len(ratios), arguments.out)

    names = names_of_run("traction")
    begun = run_begun(scene, arguments, names, kept, ratios, "traction", kept_by="traction", ratios=ratios)
    with (
        begun as (folder, prepared, estimate),
        ProgressLine("ratios", _time_left(estimate, workers, are_apart=_are_apart(ratios, workers))) as shown,
        progress_to(moment_reports()),
    ):
        keys = studies.keys_of_ratios(prepared, ratios)
        known = studies.count_of_kept_ratios(folder.unfinished, prepared.scene.motion.entrainment_speed, keys)
        folder.continues = known > 0
        _say_known(known, len(ratios), arguments.out)
        shown.update(0, len(ratios))

        def on_point(*point: Any) -> None:
            if not ended:
                studies.keep_ratios(folder.unfinished, prepared.scene, keys)
            ended.append(point)
            _end_of_point(shown, point[2], is_known=len(ended) <= known)
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
        folder.needed_by = "" if studies.is_all_solved(folder.unfinished) else RUN_WITH_MORE_POINTS
        _write(folder, prepared, curve, arguments, estimate, [], measured, known)
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
    points_read: int,
) -> None:
    """Write the table, the law, the fields of the ``chosen`` speeds, the pictures, the record; and what else was
    requested. ``estimate``: before it was solved; ``measured``: drawn with the curve; ``points_read``: number of the
    points that an interrupted run had solved."""
    name = table_of(curve)
    contents = folder.contents
    table = f"{name}.csv"
    folder.add(table, studies.csv_bytes, curve)
    units = {number: COLUMNS[number] for number in (*NUMBERS, curve.SWEPT[0])}
    numbers = [record_of_point(curve, i) for i in range(len(curve.points))]
    if table in contents:
        with folder.reporting(f"{name}.png was not drawn"):
            columns = read_table(folder.path / table, contents[table])
            if drawable(columns).any():
                title = title_of_curve(prepared.scene.name, numbers)
                own = operating_point_of(prepared.scene, curve.SWEPT[0])
                folder.draw(f"{name}.png", draw_curve, columns, title, numbers, measured, PictureOptions(), own)
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
    of_record = {
        "points": numbers,
        "operating_point": operating_point_of(prepared.scene, curve.SWEPT[0]),
        ADDED_SPEEDS: _added_speeds(prepared.scene, curve, arguments.speeds),
        "points_seconds": curve.total_seconds,
        "points_read": points_read,
    }
    if points_read:
        unusual_values.append(
            f"wall-clock time of all points together, each as it was solved: {plain_number(curve.total_seconds, 's')}; "
            f"points that the interrupted run had solved: {points_read} of {len(curve.points)}"
        )
    folder.complete(prepared, estimate, given, curve, units, law, unusual_values, again, **of_record)


def _added_speeds(scene: Scene, curve: studies.CurveResult, speeds: str | None) -> list[float]:
    """Return the solved speeds [m/s] that neither --speeds nor the list of ``scene`` has: its own, and those whose
    fields are drawn; none where no list was given."""
    if not isinstance(curve, studies.StribeckResult) or speeds == studies.AUTO_SPEEDS:
        return []
    given = parse_speeds("--speeds", speeds) or list(scene.motion.speeds)
    return [speed for speed in curve.speed.tolist() if given and not is_among(speed, given)]


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
    """Write the fields of the ``chosen`` speeds [m/s], and the pictures of the one nearest to the scene's own."""
    points = [p for p in curve.points if p is not None and (p.fields is not None or p.balance is not None)]
    points.sort(key=lambda p: chosen.index(p.speed))
    if points:
        folder.add("fields.npz", fields_bytes, points, prepared.scene.bodies.half_width)
        own = operating_point_of(prepared.scene, curve.SWEPT[0])
        drawn = points[index_of_nearest([point.speed for point in points], own, are_speeds=True)]
        folder.draw("contact.png", plot_contact, drawn_contact(prepared, drawn))
        if drawn.compared_fields is not None:
            folder.draw("sharing.png", plot_contact, compared_contact(prepared, drawn))
    if vtk:
        touching = [p for p in points if p.shows_contact]
        for i, point in enumerate(touching):
            folder.add(f"contact_{i}.vtk", vtk_bytes, point)
        if not touching:
            say("no .vtk file: none of the speeds of --fields has a contact with fields")


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


def _largest_parts(curve: studies.CurveResult) -> list[str]:
    """Return what the largest part of the interval of f is and what reduces it, in a line for all points that have the
    same; none for points where no input or tolerance reduces it."""
    swept, _, unit, plural = curve.SWEPT
    places: dict[str, list[float]] = {}
    for value, point in zip(getattr(curve, swept).tolist(), curve.points):
        name, advice = ("", "") if point is None else point.uncertainty.largest_part_and_advice
        if point is not None and advice:
            places.setdefault(f"{point.uncertainty.part_in_words(name)}{advice}", []).append(value)
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
        others = counted(len(noted) - 1, f"other {plural}")
        more = f", where its sampling error is largest (for {others} see result.json)" if len(noted) > 1 else ""
        head = f"uncertainty of f {at_value(place, unit, plural)}{more}:"
        lines.append(f"\n{INDENT}".join((head, *worst.notes)) if len(worst.notes) > 1 else f"{head} {worst.notes[0]}")
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
        return requested, [requested[index_of_nearest(requested, own, are_speeds=True)]]
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


def lines_of_point(point: FrictionResult) -> list[str]:
    """Return what is said of a solved ``point``, a line each: f, the parts of its interval, what the interval does not
    contain, power loss, lubrication regime, film, loads and time."""
    loads = in_words(point, ("contact_load", "film_load"))
    words = ", ".join(f"{symbol} = {load}" for symbol, load in loads.items())
    regime = regime_of(point.contact_load / (point.contact_load + point.film_load))
    film = f"full-load film {plain_number(point.full_load_film, 'm')}, lambda ratio {point.lambda_ratio:.3g}"
    loss = with_interval(point.power_loss, *point.power_loss_interval, unit="W")
    return [
        *point.uncertainty.short_lines(point.coefficient),
        *([point.not_in_interval] if point.not_in_interval else []),
        f"power loss: P = {loss}{rolling_in_words(point)}",
        "; ".join(filter(None, (regime or "", film if math.isfinite(point.lambda_ratio) else ""))),
        f"loads: {words} (wall-clock time of the point {point.seconds:.2f} s)",
    ]


def _progress(place: str, *, is_total_known: bool = True) -> Callable[..., Any]:
    """Return what says how a point ended; ``place``: the template of its place on the curve; ``is_total_known``:
    whether the number of points is."""

    def on_point(done: int, total: int, value: float, outcome: FrictionResult | ValidityError) -> None:
        number = f"{done:>{len(str(total))}}/{total}" if is_total_known else str(done)
        head = f"[{number}] {place.format(value)}"
        if isinstance(outcome, Exception):
            say(f"{head}: {'refused' if isinstance(outcome, ValidityError) else 'failed'}: {outcome}")
            return
        first, *others = lines_of_point(outcome)
        say(f"\n{INDENT}".join((f"{head}: {first}", *others)))

    return on_point
