"""``lubfric run`` on a scene whose motion, load or lubricant changes in time."""

from argparse import Namespace
from dataclasses import asdict
from typing import Any

import numpy as np

from .._base import figures, table_bytes
from ..errors import ConvergenceError, LubfricError, ValidityError
from ..models.shared import in_a_cell
from ..quantities import OF_MOMENT, heading
from ..scene import Scene, given_tables
from ..studies import in_words
from ..time import RunEstimate, TransientResult, fastest_of_run, in_motion, raise_if_failed, run_in_time
from . import commands
from .describe import FILES_SECONDS
from .fields import npz_bytes
from .history_answer import history_answer
from .pictures import animate, plot_history
from .progress import ProgressLine
from .run_files import names_of_run
from .slow_run import SlowRun
from .time_left import TimeLeft

# Part of the expected steps of a run between two lines of its progress. A choice: some 25 lines.
PART_OF_LINE = 0.04

# What `TimeLeft` calls the work before the first step of a run.
BEFORE_STEPS = "before the first step"


def run_history(scene: Scene, arguments: Namespace) -> None:
    """Compute and write history.csv, history.png, fields.npz, surface.png, report.html, resolved.toml (with
    ``arguments.animation``: animation.gif) and, last, result.json to ``arguments.out``.

    The scene is checked and made ready before the folder is touched, and the results of an earlier run stay until those
    of this one are there. An interrupted run continues from where it was. A failed run writes what it has, and then
    raises `ConvergenceError`.
    """
    reached = 0.0
    continues = False
    reported = 0.0
    due = commands.paced()
    failure: LubfricError | None = None
    names = [*names_of_run("history"), *["animation.gif"] * arguments.animation]

    def on_step(now: float, duration: float, row: dict[str, float] | None) -> None:
        nonlocal reached, reported
        left.end(now)
        slow.step(now)
        reached = now
        part = run.part(now)
        share = 100.0 * now / duration
        shown.update(share, 100.0)
        is_end = now >= duration
        if row is None or not (is_end or part >= reported + PART_OF_LINE) or not due(end=is_end):
            return
        reported = part
        time_left = "" if is_end else left.in_words(FILES_SECONDS)
        head = f"{share:.0f} % of the duration{time_left}: t = {now:.5g} of {duration:g} s, "
        speeds = {name: np.array([row[name]]) for name in ("entrainment_speed", "sliding_speed")}
        friction = f"U = {row['entrainment_speed']:.4g} m/s, f = {row['coefficient']:z.5f}"
        if not in_motion(speeds, fastest)[0]:
            friction = "at rest: no f"
        commands.say(
            f"{head}{friction}, F_C = {row['contact_load']:.4g} N, F_H = {row['film_load']:.4g} N, "
            f"h_min = {row['min_film'] * 1e9:.4g} nm (step {row['steps']:.0f})"
        )

    def on_begin(now: float, earlier: float) -> None:
        nonlocal reached
        reached = now
        left.end(BEFORE_STEPS)
        slow.begin(now, earlier)
        for each in [each for each in left.expected if each <= now]:
            left.omit(each)
        folder.begun = folder.begun._replace(earlier=earlier)
        share = 100.0 * now / duration
        shown.update(share, 100.0)
        if now > 0.0:
            commands.say(
                f"the run continues at t = {now:.5g} s, {share:.1f} % of the duration, which took {in_words(earlier)} of "
                "processor time"
            )

    def speed_at(now: float) -> float:
        assert scene.transient is not None
        speed = scene.transient.speed
        return scene.motion.entrainment_speed if speed is None else speed.before(now)

    def kept() -> str:
        if reached == 0.0:
            return f"the state that an earlier run saved is kept in {arguments.out}" if continues else ""
        return f"the state at t = {reached:.5g} s is kept in {arguments.out}"

    assert scene.transient is not None
    duration = scene.transient.duration
    fastest = fastest_of_run(scene)
    begun = commands.run_begun(scene, arguments, names, kept)
    with begun as (folder, prepared, estimate):
        continues = folder.unfinished.is_dir()
        folder.continues = continues
        if continues:
            commands.say(f"the run continues from {folder.unfinished}")
        assert estimate.run is not None
        run = estimate.run
        left = _time_left(scene, run)
        slow = SlowRun(run.seconds, duration, speed_at)
        with ProgressLine("% of the duration", left, lambda: slow.text) as shown:
            if not continues:
                shown.update(0.0, 100.0)
            result, _ = run_in_time(prepared, checkpoint=folder.unfinished, on_begin=on_begin, on_step=on_step)
        try:
            raise_if_failed(result, accept=scene.numerics.accept)
        except (ConvergenceError, ValidityError) as error:
            failure = error
        _write(folder, scene, result, animation=arguments.animation)
        mean = asdict(result.average())
        folder.complete(prepared, estimate, given_tables(arguments.scene), result, OF_MOMENT, mean=mean)
        for line in history_answer(
            scene, result, complete=failure is None
        ):  # before a file that was not written is an error
            commands.say(line)
    if failure:
        raise failure


def _time_left(scene: Scene, run: RunEstimate) -> TimeLeft:
    """Return the time left of the ``run`` of a scene: its parts are the work before the first step, and the steps to
    each output time [s]."""
    assert scene.transient is not None
    times = scene.transient.output_times.tolist()
    ends = times if times[0] > 0 else times[1:]
    return TimeLeft({BEFORE_STEPS: run.start_seconds} | dict(zip(ends, run.seconds_between(ends))))


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
