"""``lubfric run`` on a steady scene: its Stribeck curve, written to a folder."""

from __future__ import annotations

import json
import math
import re
import threading
import time

import numpy as np

from .._base import make_ready, read_table, validate, whole_file
from ..errors import ConvergenceError, InputError, ValidityError
from ..quantities import in_words
from ..sampling import percent
from ..scene import FASTEST, MOST_SPEEDS, Scene
from ..sharing import Validity, prepare, takes_strips
from ..studies import AUTO, MOST_WORKERS, csv_bytes, fingerprint, pool, processors, read_measured, stribeck
from .console import keeping, say, say_written
from .fields import fields_bytes, vtk_bytes
from .pictures import plot_contact, plot_stribeck
from .record import curve_record
from .report_page import report_page
from .run_folder import RESULT, RunFolder, run_folder

WORTH = 8  # speeds from which a second process gains more than it costs
TABLE, CURVE, CONTACT = "stribeck.csv", "stribeck.png", "contact.png"
CAPTIONS = {CURVE: "Friction, shares of the load and film", CONTACT: "Contact of one speed"}


def run_sweep(scene: Scene, arguments) -> int:
    """Compute a curve, and write stribeck.csv, stribeck.png, fields.npz, contact.png and, last, result.json to the
    folder ``arguments.out``; with ``.report`` and ``.vtk`` also report.html, and contact_0.vtk ... for ParaView.

    ``arguments``: of the command, with ``.speeds``, ``.fields`` and ``.workers`` (None: two if that pays) too. The
    scene is checked and made ready before the folder is touched. The results of an earlier run stay until those of this
    one are there. Every point is on disk when it ends, so an interrupted run continues from there. A failed run writes
    what it has, then raises `ConvergenceError`.
    """
    begun, out, done_so_far = time.perf_counter(), arguments.out, [0]
    speeds, chosen = _asked(scene, arguments.speeds, arguments.fields)
    total = "some" if speeds == AUTO else len(speeds)
    with pool(_workers(scene, speeds, arguments.workers)) as executor:
        say(f"{scene.name}: preparing the height map and the contact")
        prepared = prepare(scene)
        say(prepared.surface.describe())

        def on_point(done, of, speed, outcome):
            done_so_far[0] = done
            _progress(done, of, speed, outcome)

        def kept() -> str:
            points = f"{done_so_far[0]} of {total} points"
            return f"interrupted; {points} are kept in {out}: the same command goes on from there"

        with keeping(kept), run_folder(out, fingerprint(prepared, speeds, chosen)) as folder:
            threading.Thread(target=make_ready, daemon=True).start()  # while the speeds are solved
            options = {"fields": chosen, "store": folder.unfinished, "on_point": on_point, "raise_on_failure": False}
            curve = stribeck(prepared, speeds, None if speeds == AUTO else executor, **options)
            _write(folder, prepared, curve, chosen)
            record = curve_record(prepared, curve, time.perf_counter() - begun)
            if arguments.vtk:
                _write_vtk(folder, prepared, curve)
            if arguments.report:
                made = {name: text for name, text in CAPTIONS.items() if name in folder.written}
                images = {text: (folder.path / name).read_bytes() for name, text in made.items()}
                folder.write("report.html", report_page(prepared, curve, record, images))
            folder.finish(record)
    for text in (*curve.validity, *_doubts(curve)):
        say(text)
    if scene.numerics.accept and any(e.severe for i in range(curve.speed.size) for e in curve.entries(i)):
        say("accepted although outside the range of the model: these coefficients are marked, and are no answers")
    say_written(folder.written, out, begun)
    if curve.errors:
        raise _unsolved(curve)
    return 0


def _workers(scene: Scene, speeds, given: int | None) -> int:
    """Processes that share the ``speeds``: as ``given``, else two if there are as many processors, enough speeds, and
    each is solved on strips. The numbers do not depend on it."""
    if given is not None:
        return validate.integer("--workers", given, minimum=1, maximum=MOST_WORKERS)
    return 2 if speeds != AUTO and len(speeds) >= WORTH and takes_strips(scene) and processors() > 1 else 1


def _write(folder: RunFolder, prepared, curve, chosen) -> None:
    """The table, the fields of the ``chosen`` speeds, and their pictures."""
    folder.clear()
    folder.write(TABLE, csv_bytes(curve))
    if len(curve.errors) < curve.speed.size:
        entries = [curve.entries(i) for i in range(curve.speed.size)]
        folder.draw(CURVE, plot_stribeck, read_table(folder.path / TABLE), prepared.scene.name, entries)
    points = [p for p in curve.points if p is not None and (p.balance is not None or p.deterministic is not None)]
    if points:
        points.sort(key=lambda p: chosen.index(p.speed))
        folder.write("fields.npz", fields_bytes(prepared, points))
        folder.draw(CONTACT, plot_contact, prepared, points[0])


def _write_vtk(folder: RunFolder, prepared, curve) -> None:
    touching = [p for p in curve.points if p is not None and p.shows_contact]
    for i, point in enumerate(touching):
        folder.write(f"contact_{i}.vtk", vtk_bytes(prepared, point))
    if not touching:
        say("no .vtk file: none of the speeds of --fields has a contact with fields")


def plot_again(arguments) -> None:
    """Draw stribeck.png of a folder again, with the measured curve that the ``arguments`` of ``lubfric plot`` name."""
    folder = arguments.folder
    source, record = folder / TABLE, folder / RESULT
    for needed in (source, record):
        if not needed.is_file():
            raise InputError(f"{folder} holds no {needed.name}; give a folder that 'lubfric run' wrote")
    try:
        found = json.loads(record.read_text(encoding="utf-8"))
        name, entries = (
            found["scene"]["name"],
            [[Validity(**e) for e in p.get("validity", ())] for p in found["points"]],
        )
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as problem:
        raise InputError(f"{record} is torn, or no record of a run ({problem})") from None
    measured, columns = None, read_table(source)
    if arguments.measured is not None:
        if arguments.speed is None or arguments.coefficient is None:
            raise InputError("--measured needs --speed and --coefficient, the headings of its columns")
        measured = read_measured(arguments.measured, coefficient=arguments.coefficient, speed=arguments.speed)
    if len(columns["speed"]) != len(entries):
        count = f"{source} has {len(columns['speed'])} speeds and {record} {len(entries)}"
        raise InputError(f"{count}; run 'lubfric run' again")
    with whole_file(folder / CURVE) as part:
        plot_stribeck(part, columns, str(name), entries, measured)


def _doubts(curve) -> list[str]:
    """The errors of f in words: at how many speeds, and in full for the least sure of them; at how many speeds too few
    spots carry the load; and the error of load sharing itself, which the intervals leave out, if it is larger."""
    points, told = [p for p in curve.points if p is not None], []
    noted = [p for p in points if p.uncertainty.notes]
    few = [p.speed for p in points if p.uncertainty.few_spots]
    if noted:
        worst = max(noted, key=lambda p: p.uncertainty.sampling if math.isfinite(p.uncertainty.sampling) else math.inf)
        others = f" (the largest; result.json has {_speeds(len(noted) - 1, 'more ')})" if len(noted) > 1 else ""
        told.append(f"error of f at {worst.speed:.4g} m/s: {'; '.join(worst.uncertainty.notes)}{others}")
        if few and few != [worst.speed]:
            where = ", ".join(f"{u:.4g}" for u in few)
            told.append(f"few spots carry the load at {where} m/s: these intervals are too narrow")
    beyond = [p for p in points if p.uncertainty.model_form > _half_width(p.uncertainty.interval)]
    if beyond:
        worst = max(beyond, key=lambda p: p.uncertainty.model_form)
        told.append(
            "not in the intervals: the error of load sharing itself, up to "
            f"{percent(worst.uncertainty.model_form)} at {worst.speed:.4g} m/s; it is larger than the interval at "
            f"{_speeds(len(beyond))}"
        )
    return told


def _speeds(count: int, word: str = "") -> str:
    return f"{count} {word}{'speeds' if count > 1 else 'speed'}"


def _half_width(interval: tuple[float, float]) -> float:
    """Of an interval, relative to its middle."""
    low, high = interval
    return abs(high - low) / abs(high + low) if high + low else math.nan


def _unsolved(curve) -> ConvergenceError:
    """How many speeds failed and how many were refused, and the first of them."""
    total, failed = curve.speed.size, sum(not isinstance(error, ValidityError) for error in curve.errors.values())
    counts = [f"{failed} of {total} speeds failed"] if failed else []
    if len(curve.errors) > failed:
        counts.append(f"{len(curve.errors) - failed} of {total} speeds refused (--accept keeps them, marked)")
    return ConvergenceError(f"{', '.join(counts)}; first: {curve.errors[min(curve.errors)]}", curve.report)


def _asked(scene: Scene, speeds: str | None, fields: str | None) -> tuple:
    """The speeds [m/s] of a command, or "auto", and those of them whose fields are wanted: these are added where they
    are missing, in order if the others are in order."""
    chosen = parse_speeds("--fields", fields) or [scene.motion.entrainment_speed]
    if speeds == AUTO:
        return AUTO, [abs(u) for u in chosen if u != 0]
    asked = parse_speeds("--speeds", speeds) or list(scene.motion.speeds) or [scene.motion.entrainment_speed]
    own, rising = [], asked == sorted(asked)
    for speed in chosen:
        near = [u for u in asked if math.isclose(u, speed, rel_tol=1e-9)]
        own.append(near[0] if near else speed)
        asked = asked if near else [*asked, speed]
    validate.array("speeds", asked, "m/s", ndim=1)
    return (sorted(asked) if rising else asked), own


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


def _progress(done, total, speed, outcome) -> None:
    head = f"[{done:>{len(str(total))}}/{total}] U = {speed:<9.4g} m/s"
    if isinstance(outcome, Exception):
        verb = "refused" if isinstance(outcome, ValidityError) else "failed"
        say(f"{head}: {verb}: {outcome}")
        return
    loads = ", ".join(
        f"{symbol} = {value}" for symbol, value in in_words(outcome, ("contact_load", "film_load")).items()
    )
    say(f"{head}: {outcome.uncertainty.short(outcome.coefficient):<59} {loads} ({outcome.seconds:.2f} s)")
