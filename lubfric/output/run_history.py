"""``lubfric run`` on a scene whose motion, load or lubricant changes in time."""

from __future__ import annotations

import time
from argparse import Namespace
from collections.abc import Callable
from dataclasses import asdict
from typing import Any

import numpy as np

from .._base import figures, table_bytes
from .._base.processor_time import processor_time
from ..errors import STOPPED, WORK_LIMIT, ConvergenceError, LubfricError, ValidityError
from ..models.shared import in_a_cell, sentence
from ..quantities import OF_MOMENT, heading
from ..scene import Scene, given_tables
from ..studies import in_words
from ..time import RunEstimate, TransientResult, fastest_of_run, in_motion, raise_if_failed, run_in_time
from . import commands
from .budget_bars import budget_of_mean_in_words
from .describe import FILES_SECONDS
from .fields import npz_bytes
from .history_answer import history_answer, history_notes
from .pictures import animate, plot_history
from .progress import ProgressLine
from .run_files import names_of_run
from .slow_run import SlowRun
from .time_left import TimeLeft

# Part of the expected steps of a run between two lines of its progress. A choice: some 25 lines.
PART_OF_LINE = 0.04

# Parts of the expected steps, whose pace is measured. A choice: fewer show a time left that stays and jumps.
PARTS_OF_COURSE = 50

# Part of the estimated time for which a run is taken to have the pace of its estimate, until twice as much has passed.
# A choice: with less the time left jumps while the first steps are taken, which are short.
USUAL_PART = 0.25

# What `TimeLeft` calls the work before the first step of a run.
BEFORE_STEPS = "before the first step"

# What is kept of a run that ended early, by its status, as text.
CONTINUED_BY = {
    WORK_LIMIT: "the state that was reached; the same command with a larger numerics.max_work continues from there",
    STOPPED: "the state that was reached",
}


class HistoryProgress:
    """What is printed about a run in time while it is solved: use as ``with progress: ...``.

    ``reached``: the moment [s] that the run has reached.
    """

    def __init__(self, scene: Scene, run: RunEstimate, folder: commands.RunFolder):
        assert scene.transient is not None
        self.scene = scene
        self.run = run
        self.folder = folder
        self.duration = scene.transient.duration
        self.reached = 0.0
        self._fastest = fastest_of_run(scene)
        self._left = time_left_of_run(run)
        self._slow = SlowRun(run.seconds, self.duration, self._speed_at)
        self._line = ProgressLine("% of the duration", self._left, lambda: self._slow.text)
        self._due = commands.paced()
        self._reported = 0.0  # part of the expected steps at the last line

    def __enter__(self) -> HistoryProgress:
        self._line.__enter__()
        if not self.folder.continues:
            self._line.update(0.0, 100.0)
        return self

    def __exit__(self, *error: Any) -> None:
        self._line.__exit__(*error)

    def on_begin(self, now: float, earlier: float) -> None:
        """Begin at the moment ``now`` [s]; a run that continues took ``earlier`` seconds to it."""
        self.reached = now
        self._left.end(BEFORE_STEPS)
        self._slow.begin(now, earlier)
        for each in [each for each in self._left.expected if each <= now]:
            self._left.omit(each)
        self.folder.begun = self.folder.begun._replace(earlier=earlier)
        share = self._share(now)
        self._line.update(share, 100.0)
        if now > 0.0:
            commands.say(
                f"the run continues at t = {now:.5g} s, {share:.1f} % of the duration, which took {in_words(earlier)} of "
                "processor time"
            )

    def on_step(self, now: float, duration: float, row: dict[str, float] | None) -> None:
        """Note that the run has reached ``now`` [s], and now and then print the numbers of that moment, its ``row``
        (None: it is not an output)."""
        for each in [each for each in self._left.expected if each <= now]:
            self._left.end(each)
        self._slow.step(now)
        self.reached = now
        self._line.update(self._share(now), 100.0)
        if row is not None and self._is_due(now):
            commands.say(self._moment_in_words(now, row))

    def _share(self, now: float) -> float:
        return 100.0 * now / self.duration

    def _is_due(self, now: float) -> bool:
        part = self.run.part(now)
        is_end = now >= self.duration
        if not (is_end or part >= self._reported + PART_OF_LINE) or not self._due(end=is_end):
            return False
        self._reported = part
        return True

    def _moment_in_words(self, now: float, row: dict[str, float]) -> str:
        time_left = "" if now >= self.duration else self._left.in_words(FILES_SECONDS)
        speeds = {name: np.array([row[name]]) for name in ("entrainment_speed", "sliding_speed")}
        friction = f"U = {row['entrainment_speed']:.4g} m/s, f = {row['coefficient']:z.5f}"
        if not in_motion(speeds, self._fastest)[0]:
            friction = "at rest: no f"
        return (
            f"{self._share(now):.0f} % of the duration{time_left}: t = {now:.5g} of {self.duration:g} s, {friction}, "
            f"F_C = {row['contact_load']:.4g} N, F_H = {row['film_load']:.4g} N, "
            f"h_min = {row['min_film'] * 1e9:.4g} nm (step {row['steps']:.0f})"
        )

    def _speed_at(self, now: float) -> float:
        assert self.scene.transient is not None
        speed = self.scene.transient.speed
        return self.scene.motion.entrainment_speed if speed is None else speed.before(now)


def run_history(scene: Scene, arguments: Namespace) -> None:
    """Compute and write history.csv, history.png, fields.npz, surface.png, report.html, resolved.toml (with
    ``arguments.animation``: animation.gif) and, last, result.json to ``arguments.out``.

    The scene is checked and made ready before the folder is touched, and the results of an earlier run stay until those
    of this one are there. A run that fails or is interrupted writes what it has, and then raises `ConvergenceError` or
    `KeyboardInterrupt`; an interrupted one continues from where it was.
    """
    progress: HistoryProgress | None = None

    def kept() -> str:
        if progress is None:
            return ""
        if progress.reached > 0.0:
            return f"the state at t = {progress.reached:.5g} s is kept in {arguments.out}"
        return f"the state that an earlier run saved is kept in {arguments.out}" if progress.folder.continues else ""

    names = [*names_of_run("history"), *["animation.gif"] * arguments.animation]
    failure: LubfricError | None = None
    interrupts: list[KeyboardInterrupt] = []
    with commands.run_begun(scene, arguments, names, kept) as (folder, prepared, estimate):
        folder.continues = folder.unfinished.is_dir()
        if folder.continues:
            commands.say(f"the run continues from {folder.unfinished}")
        assert estimate.run is not None
        progress = HistoryProgress(scene, estimate.run, folder)
        with progress:
            result, _ = run_in_time(
                prepared,
                checkpoint=folder.unfinished,
                on_begin=progress.on_begin,
                on_step=progress.on_step,
                on_interrupt=interrupts.append,
            )
        try:
            raise_if_failed(result, accept=scene.numerics.accept)
        except (ConvergenceError, ValidityError) as error:
            failure = error
        folder.needed_by = CONTINUED_BY.get(result.report.status, "")
        _write(folder, scene, result, animation=arguments.animation)
        mean = asdict(result.average())
        lines: list[str] = []
        with folder.reporting("the answer was not reported"):
            lines = _answer_lines(scene, result, complete=failure is None)
        given = given_tables(arguments.scene)
        folder.complete(prepared, estimate, given, result, OF_MOMENT, lines=lines, mean=mean)
        for interrupt in interrupts:
            raise interrupt
    if failure:
        raise failure


def _answer_lines(scene: Scene, result: TransientResult, *, complete: bool) -> list[str]:
    """Return the answer of a run, the parts of its interval, what is not in it and what narrows it, a line each."""
    answer = history_answer(scene, result, complete=complete)
    if result.time.size < 2:
        return answer
    not_in = map(sentence, result.not_in)
    return [*answer, *budget_of_mean_in_words(result), *not_in, *history_notes(scene, result)]


def time_left_of_run(
    run: RunEstimate, *, clock: Callable[[], float] = time.monotonic, spent: Callable[[], float] = processor_time
) -> TimeLeft:
    """Return the time left of a ``run``: its parts are the work before the first step, and `PARTS_OF_COURSE` parts of
    the expected steps, each of which is known by its end [s]. ``clock``, ``spent``: as of `TimeLeft`."""
    ends = run.times_of_parts(PARTS_OF_COURSE)
    expected = {BEFORE_STEPS: run.start_seconds} | dict(zip(ends, run.seconds_between(ends)))
    return TimeLeft(expected, usual=USUAL_PART * run.seconds, clock=clock, spent=spent)


def _write(folder: commands.RunFolder, scene: Scene, result: TransientResult, *, animation: bool) -> None:
    """Write the table, the fields and the pictures of the run alone."""
    folder.add("history.csv", _table, result)
    fields = {"time": result.time, "x": result.x, "pressure": result.pressure, "film_thickness": result.film_thickness}
    folder.add("fields.npz", npz_bytes, fields)
    if result.time.size > 1:
        folder.draw("history.png", plot_history, result.columns, figures.plain_words(scene.name))
    if animation:
        folder.draw("animation.gif", animate, result, scene.bodies.half_width)


def _table(result: TransientResult) -> bytes:
    """Return history.csv. Where the surfaces are at rest, there is no f, and the friction force of the asperity
    contacts may have any value up to that of the first slip: these cells are empty."""
    moving = in_motion(result.columns).tolist()
    columns: dict[str, np.ndarray | list[Any]] = {heading(name): result.columns[name] for name in OF_MOMENT}
    for name in ("coefficient", "interval_low", "interval_high", "friction_force", "boundary_force"):
        values = result.columns[name].tolist()
        columns[heading(name)] = [value if moves else "" for value, moves in zip(values, moving)]
    if not np.isfinite(result.angle_of_rotation).any():
        del columns[heading("angle_of_rotation")]
    return table_bytes(columns | {"validity": [in_a_cell(violations) for violations in result.violations]})
