"""``lubfric run`` on a scene whose motion, load or lubricant changes in time."""

from __future__ import annotations

import time
from pathlib import Path

from .._base import plain, read_table, table_bytes, whole_file
from ..errors import ConvergenceError, LubfricError, ValidityError
from ..scene import Scene
from ..sharing import in_a_cell, prepare
from ..studies import fingerprint
from ..time import STATE, UNITS, TransientResult, transient
from .console import Pace, keeping, say, say_written
from .plot_history import animate, plot_history
from .record import made_of, npz_bytes
from .run_folder import CHECKPOINT, RunFolder, run_folder, run_name


def run_history(scene: Scene, out: Path, animation: bool) -> int:
    """Compute and write history.csv, history.png, fields.npz (and animation.gif) and, last, result.json to ``out``.

    The scene is checked and made ready before ``out`` is touched, and the results of an earlier run stay until those of
    this one are there. An interrupted run continues from ``out``/checkpoint. A failed run writes what it has, and then
    raises `ConvergenceError`.
    """
    begun, reached = time.perf_counter(), [0.0]
    failure: LubfricError | None
    say(f"{scene.name}: preparing the height map and the contact")
    prepared = prepare(scene)
    say(prepared.surface.describe())

    def kept() -> str:
        return f"interrupted; the state at t = {reached[0]:.5g} s is kept in {out}: the same command goes on from there"

    with keeping(kept), run_folder(out, fingerprint(prepared)) as folder:
        checkpoint, failure = out / CHECKPOINT, None
        if (checkpoint / STATE).is_file():
            say(f"going on from {checkpoint}")
        try:
            result = transient(prepared, checkpoint=checkpoint, on_step=_progress(reached))
        except (ConvergenceError, ValidityError) as error:
            if error.result is None:
                raise
            result, failure = error.result, error
        for text in result.validity:
            say(text)
        _write(folder, scene, result, animation)
        folder.finish(_record(scene, prepared, result, time.perf_counter() - begun))
    say_written(folder.written, out, begun)
    if failure:
        raise failure
    return 0


def _write(folder: RunFolder, scene: Scene, result: TransientResult, animation: bool) -> None:
    """All but the result."""
    folder.clear()
    columns = {f"{name} [{unit}]": result.columns[name] for name, unit in UNITS.items()}
    told = {"validity": [in_a_cell(entries) for entries in result.entries]}
    folder.write("history.csv", table_bytes(columns | told))
    fields = {"time": result.time, "x": result.x, "pressure": result.pressure, "film_thickness": result.film_thickness}
    folder.write("fields.npz", npz_bytes(fields))
    if result.time.size > 1:
        folder.draw("history.png", plot_history, result.columns, scene.name)
    if animation:
        folder.make("animation.gif", animate, result, scene.bodies.half_width)


def plot_again(folder: Path) -> bool:
    """Draw history.png again if there is a history.csv; returns whether there was."""
    source = folder / "history.csv"
    if not source.is_file():
        return False
    columns = read_table(source)
    with whole_file(folder / "history.png") as part:
        plot_history(part, columns, run_name(folder))
    return True


def _progress(reached: list[float]):
    pace = Pace()

    def on_step(now, duration, row):
        reached[0] = now
        if row is not None and pace.due(now >= duration):
            say(
                f"t = {now:<8.5g} of {duration:g} s: U = {row['entrainment_speed']:<9.4g} m/s, f = "
                f"{row['coefficient']:<8.5f}, F_C = {row['contact_load']:<9.4g} N, F_H = {row['film_load']:<9.4g} N, "
                f"h_min = {row['min_film'] * 1e9:<6.4g} nm (step {row['steps']:.0f})"
            )

    return on_step


def _record(scene: Scene, prepared, result: TransientResult, seconds: float) -> dict:
    record = made_of(scene, prepared.surface, sq=prepared.surface.sq) | {
        "seconds": seconds,
        "report": result.report.as_dict(),
        "validity": list(result.validity),
    }
    return plain(record)
