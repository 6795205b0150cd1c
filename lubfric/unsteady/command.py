"""``lubfric run`` on a scene whose motion, load or lubricant changes in time."""

from __future__ import annotations

import csv
import json
import platform
import time
from pathlib import Path

import numpy as np

from .. import __version__
from ..errors import ConvergenceError
from ..model import prepare
from ..output import _plain, read_csv
from ..scene import Scene, scene_as_dict
from .checkpoint import STATE
from .plot import animate, plot_history
from .result import TransientResult
from .row import UNITS
from .run import transient

SAY_EVERY = 1.0  # s of wall time between two lines of progress


def run_history(scene: Scene, out: Path, animation: bool, say) -> int:
    """Compute and write history.csv, history.png, fields.npz, result.json (and animation.gif) to ``out``.

    An interrupted run goes on from ``out``/checkpoint. What a failed run has is written, then
    `ConvergenceError` raised."""
    out.mkdir(parents=True, exist_ok=True)
    begun = time.perf_counter()
    say(f"{scene.name}: preparing the height map and the contact")
    model = prepare(scene)
    say(model.surface.describe())
    folder = out / "checkpoint"
    if (folder / STATE).is_file():
        say(f"going on from {folder}")
    failure = None
    try:
        result = transient(model, checkpoint=folder, on_step=_progress(say))
    except ConvergenceError as error:
        if error.result is None:
            raise
        result, failure = error.result, error
    write_history(out / "history.csv", result)
    np.savez_compressed(
        out / "fields.npz",
        time=result.time,
        x=result.x,
        pressure=result.pressure,
        film_thickness=result.film_thickness,
    )
    _write_json(out / "result.json", scene, model, result, time.perf_counter() - begun)
    if result.time.size > 1:
        plot_history(out / "history.png", result.columns, scene.name)
    if animation:
        animate(out / "animation.gif", result, scene.bodies.half_width)
    say(f"wrote {', '.join(sorted(p.name for p in out.iterdir()))} to {out} in {time.perf_counter() - begun:.1f} s")
    if failure:
        raise failure
    return 0


def write_history(path: Path, result: TransientResult) -> None:
    """One row an output time, one column a quantity, the unit in the heading."""
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow([f"{name} [{unit}]" for name, unit in UNITS.items()])
        writer.writerows(zip(*(result.columns[name].tolist() for name in UNITS)))


def plot_again(folder: Path) -> bool:
    """Draw history.png again where there is a history.csv; says whether there was."""
    source = folder / "history.csv"
    if not source.is_file():
        return False
    plot_history(folder / "history.png", read_csv(source), folder.resolve().name)
    return True


def _progress(say):
    last = [0.0]

    def on_step(now, duration, row):
        if row is not None and (time.perf_counter() - last[0] > SAY_EVERY or now >= duration):
            last[0] = time.perf_counter()
            say(
                f"t = {now:.5g} of {duration:g} s: U = {row['entrainment_speed']:.4g} m/s, "
                f"f = {row['coefficient']:.5f}, "
                f"F_C = {row['contact_load']:.4g} N, F_H = {row['film_load']:.4g} N, "
                f"h_min = {row['min_film'] * 1e9:.4g} nm (step {row['steps']:.0f})"
            )

    return on_step


def _write_json(path: Path, scene: Scene, model, result: TransientResult, seconds: float) -> None:
    import scipy

    record = {
        "scene": scene_as_dict(scene),
        "surface": {
            "shape": model.surface.heights.shape,
            "spacing": model.surface.spacing,
            "sq": model.surface.sq,
            "notes": list(model.surface.notes),
        },
        "versions": {
            "lubfric": __version__,
            "numpy": np.__version__,
            "scipy": scipy.__version__,
            "python": platform.python_version(),
        },
        "seconds": seconds,
        "report": result.report.as_dict(),
    }
    path.write_text(json.dumps(_plain(record), indent=1, allow_nan=False))
