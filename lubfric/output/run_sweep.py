"""``lubfric run`` on a steady scene: its Stribeck curve, written to a folder."""

from __future__ import annotations

import math
import re
import time
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .._base import make_ready, plot_contact, plot_stribeck, read_table, validate
from ..errors import ConvergenceError, InputError, ValidityError
from ..one_way import one_way_arrays, plot_one_way
from ..sampling import FrictionResult, Uncertainty, percent
from ..scene import FASTEST, MOST_SPEEDS, Scene
from ..sharing import on_cells_of, prepare, takes_line
from ..studies import AUTO, MOST_WORKERS, csv_bytes, fingerprint, pool, processors, stribeck
from .console import keeping, say, say_written
from .deterministic import deterministic_bytes, plot_deterministic
from .record import curve_record, fields_bytes, npz_bytes
from .report_page import report_page
from .run_folder import RunFolder, drawn, run_folder
from .vtk import vtk_bytes

WORTH = 8  # speeds from which a second process gains more than it costs


@dataclass(frozen=True)
class Extras:
    """Further outputs: report.html, and contact_0.vtk ... for ParaView. ``workers``: processes that share the speeds
    (None: two if that pays)."""

    report: bool = False
    vtk: bool = False
    workers: int | None = None


def run_sweep(scene: Scene, out: Path, speeds: str | None, fields: str | None, more: Extras = Extras()) -> int:
    """Compute a curve, and write stribeck.csv, stribeck.png, fields.npz, contact.png and, last, result.json to ``out``.

    The scene is checked and made ready before ``out`` is touched. The results of an earlier run stay until those of
    this one are there. Every point is on disk when it ends, so an interrupted run continues from there. A failed run
    writes what it has, then raises `ConvergenceError`.
    """
    asked, chosen = _asked(scene, speeds, fields)
    with pool(_workers(scene, asked, more.workers)) as executor:
        return _run(scene, out, (asked, chosen), more, executor)


def _workers(scene: Scene, asked, given: int | None) -> int:
    """Processes that share the speeds ``asked``: as ``given``, else two if there are as many processors, enough speeds,
    and each is solved on a long line. The numbers do not depend on it."""
    if given is not None:
        return validate.integer("--workers", given, minimum=1, maximum=MOST_WORKERS)
    return 2 if asked != AUTO and len(asked) >= WORTH and takes_line(scene) and processors() > 1 else 1


def _run(scene: Scene, out: Path, speeds: tuple, more: Extras, executor) -> int:
    """See `run_sweep`. ``speeds``: asked for, and those whose fields are kept; ``executor``: solves them (or None)."""
    asked, chosen = speeds
    begun, counted, total = time.perf_counter(), [0], "some" if asked == AUTO else len(asked)
    say(f"{scene.name}: preparing the height map and the contact")
    prepared = prepare(scene)
    say(prepared.surface.describe())

    def on_point(done, total, speed, outcome):
        counted[0] = done
        _progress(done, total, speed, outcome)
        if speed == chosen[0] and isinstance(outcome, FrictionResult) and outcome.balance is not None:
            pictures[speed] = artist.submit(_contact, prepared, outcome)

    def kept() -> str:
        return f"interrupted; {counted[0]} of {total} points are kept in {out}: the same command goes on from there"

    pictures: dict[float, Future[bytes]] = {}
    with (
        keeping(kept),
        ThreadPoolExecutor(1) as artist,
        run_folder(out, fingerprint(prepared, asked, chosen)) as folder,
    ):
        artist.submit(make_ready)  # while the speeds are solved
        curve = stribeck(
            prepared,
            asked,
            None if asked == AUTO else executor,
            fields=chosen,
            store=folder.unfinished,
            on_point=on_point,
            raise_on_failure=False,
        )
        _write(folder, prepared, curve, chosen, pictures)
        record = curve_record(prepared, curve, time.perf_counter() - begun)
        _write_more(folder, prepared, curve, record, more)
        folder.finish(record)
    for text in (*curve.validity, *_doubts(curve), *_beside(curve)):
        say(text)
    if scene.numerics.accept and any(e.severe for i in range(curve.speed.size) for e in curve.entries(i)):
        say("accepted although outside the range of the model: these coefficients are marked, and are no answers")
    say_written(folder.written, out, begun)
    if curve.errors:
        raise _unsolved(curve)
    return 0


def _doubts(curve) -> tuple[str, ...]:
    """The errors of f in words: at how many speeds, and in full for the least sure of them; and at how many speeds too
    few spots carry the load."""
    told = [p for p in curve.points if p is not None and p.uncertainty.notes]
    if not told:
        return ()
    worst = max(told, key=lambda p: p.uncertainty.sampling if math.isfinite(p.uncertainty.sampling) else math.inf)
    first = f"error of f at {worst.speed:.4g} m/s: {'; '.join(worst.uncertainty.notes)}"
    if others := len(told) - 1:
        first += f" (the largest; result.json has {others} more {'speeds' if others > 1 else 'speed'})"
    few = [p.speed for p in told if p.uncertainty.few_spots]
    if not few or few == [worst.speed]:
        return (first,)
    return (
        first,
        f"few spots carry the load at {', '.join(f'{u:.4g}' for u in few)} m/s: these intervals are too narrow",
    )


def _beside(curve) -> tuple[str, ...]:
    """What the intervals leave out: the estimated error of load sharing itself, if it is larger than they are."""
    told = [p for p in curve.points if p is not None and p.uncertainty.model_form > _stated(p.uncertainty)]
    if not told:
        return ()
    worst = max(told, key=lambda p: p.uncertainty.model_form)
    count = f"{len(told)} {'speeds' if len(told) > 1 else 'speed'}"
    most = f"up to {percent(worst.uncertainty.model_form)} at {worst.speed:.4g} m/s"
    return (
        f"not in the intervals: the error of load sharing itself, {most}; it is larger than the interval at {count}",
    )


def _stated(found: Uncertainty) -> float:
    """Relative half-width of an interval."""
    low, high = found.interval
    return abs(high - low) / abs(high + low) if high + low else math.nan


def _unsolved(curve) -> ConvergenceError:
    """How many speeds failed and how many were refused, and the first of them."""
    total, failed = curve.speed.size, sum(not isinstance(error, ValidityError) for error in curve.errors.values())
    counts = [f"{failed} of {total} speeds failed"] if failed else []
    if len(curve.errors) > failed:
        counts.append(f"{len(curve.errors) - failed} of {total} speeds refused (--accept keeps them, marked)")
    return ConvergenceError(f"{', '.join(counts)}; first: {curve.errors[min(curve.errors)]}", curve.report)


def _asked(scene: Scene, speeds: str | None, fields: str | None) -> tuple:
    """The speeds [m/s] of a command, or "auto", and those of them whose fields are wanted."""
    chosen = parse_speeds("--fields", fields) or [scene.motion.entrainment_speed]
    if speeds == AUTO:
        return AUTO, [abs(u) for u in chosen if u != 0]
    asked = parse_speeds("--speeds", speeds) or list(scene.motion.speeds) or [scene.motion.entrainment_speed]
    asked, chosen = _with_chosen(asked, chosen)
    validate.array("speeds", asked, "m/s", ndim=1)
    return asked, chosen


def _write(folder: RunFolder, prepared, curve, chosen, pictures: dict[float, Future[bytes]]) -> None:
    """Write everything but result.json. ``pictures``: of contacts, by speed; they may still be in the making."""
    folder.clear()
    folder.write("stribeck.csv", csv_bytes(curve))
    if len(curve.errors) < curve.speed.size:
        columns, told = read_table(folder.path / "stribeck.csv"), [curve.entries(i) for i in range(curve.speed.size)]
        folder.draw("stribeck.png", plot_stribeck, columns, prepared.scene.name, told)
    points = [p for p in curve.points if p is not None and p.balance is not None]
    if points:
        points.sort(key=lambda p: chosen.index(p.speed))
        folder.write("fields.npz", fields_bytes(prepared, points))
        ready = pictures.get(points[0].speed)
        folder.write("contact.png", ready.result() if ready else _contact(prepared, points[0]))
    whole = [p for p in curve.points if p is not None and p.deterministic is not None]
    if whole:
        whole.sort(key=lambda p: chosen.index(p.speed))
        folder.write("fields.npz", deterministic_bytes([p.deterministic.result for p in whole]))
        folder.draw("contact.png", plot_deterministic, whole[0].deterministic.result, prepared.scene.bodies.half_width)
    if one_way := sorted((p for p in curve.points if p and p.one_way), key=lambda p: chosen.index(p.speed)):
        folder.write("fields.npz", npz_bytes(one_way_arrays(one_way)))
        folder.draw("contact.png", plot_one_way, one_way[0])


def _contact(prepared, point) -> bytes:
    """The picture of the contact of ``point``, on the cells on which it was solved."""
    return drawn(plot_contact, on_cells_of(prepared, point.line), point)


def _write_more(folder: RunFolder, prepared, curve, record: dict, more: Extras) -> None:
    """Write the page and the files for ParaView, if they are asked for."""
    if more.vtk:
        touching = [p for p in curve.points if p is not None and p.shows_contact]
        for i, point in enumerate(touching):
            folder.write(f"contact_{i}.vtk", vtk_bytes(prepared, point))
        if not touching:
            say("no .vtk file: none of the speeds of --fields has a contact with fields")
    if more.report:
        captions = {"stribeck.png": "Friction, shares of the load and film", "contact.png": "Contact of one speed"}
        images = {text: (folder.path / name).read_bytes() for name, text in captions.items() if name in folder.written}
        folder.write("report.html", report_page(prepared, curve, record, images))


def parse_speeds(option: str, text: str | None, unit: str = "m/s", most: float = FASTEST) -> list[float]:
    """'a,b,c' or 'low:high:count' (geometric), in ``unit``, of a command's ``option``; none above ``most``."""
    if text is None:
        return []
    refusal = InputError(
        f"{option} {validate.shown(text)}; allowed: '0.001,0.01' or 'low:high:count' with 0 < low < high, "
        f"1 <= count <= {MOST_SPEEDS}, in {unit}"
    )
    ranged = ":" in text
    words = text.split(":" if ranged else ",")
    if not ranged and any(re.match(r"[+-]?0\d", word.strip()) for word in words):
        raise InputError(f"{option} {validate.shown(text)}: a comma separates values; write a point in decimals, 0.01")
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        raise refusal from None
    for speed in numbers[:2] if ranged else numbers:
        validate.number(option, speed, unit, minimum=-most, maximum=most)
    if not ranged:
        return numbers
    if len(numbers) != 3 or not (
        0 < numbers[0] < numbers[1] and 1 <= numbers[2] <= MOST_SPEEDS and numbers[2] % 1 == 0
    ):
        raise refusal
    return [float(u) for u in np.geomspace(numbers[0], numbers[1], int(numbers[2]))]


def _with_chosen(speeds, chosen):
    """``speeds`` together with the chosen ones, in order if they are in order, and the positions of the chosen ones
    among them."""
    own, rising = [], list(speeds) == sorted(speeds)
    for speed in chosen:
        near = [u for u in speeds if math.isclose(u, speed, rel_tol=1e-9)]
        own.append(near[0] if near else speed)
        speeds = speeds if near else [*speeds, speed]
    return (sorted(speeds) if rising else speeds), own


def _progress(done, total, speed, outcome) -> None:
    head = f"[{done:>{len(str(total))}}/{total}] U = {speed:<9.4g} m/s"
    if isinstance(outcome, Exception):
        verb = "refused" if isinstance(outcome, ValidityError) else "failed"
        say(f"{head}: {verb}: {outcome}")
    else:
        say(
            f"{head}: {outcome.uncertainty.short(outcome.coefficient):<59} F_C = {outcome.contact_load:<9.4g} N, "
            f"F_H = {outcome.film_load:<9.4g} N ({outcome.seconds:.2f} s)"
        )
