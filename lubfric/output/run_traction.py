"""``lubfric run SCENE --ratios``: the traction curve of a scene, written to a folder."""

from __future__ import annotations

import time
from dataclasses import asdict
from pathlib import Path

import numpy as np

from .._base import plain, read_table, whole_file
from ..errors import ConvergenceError, InputError
from ..quantities import NUMBERS
from ..scene import LARGEST_RATIO, Scene
from ..sharing import prepare
from ..studies import curve_table, fingerprint, traction, uncertainty_columns
from .console import say, say_written
from .draw_curves import plot_traction
from .record import made_of
from .run_folder import run_folder, run_name
from .run_sweep import parse_speeds


def run_traction(scene: Scene, out: Path, ratios: str) -> int:
    """Solve, write traction.csv, traction.png and, last, result.json to ``out``, and say what does not hold."""
    begun, asked = time.perf_counter(), parse_speeds("--ratios", ratios, "(slide-roll ratio)", LARGEST_RATIO)
    say(f"{scene.name}: preparing the height map and the contact")
    prepared = prepare(scene)
    say(prepared.surface.describe())
    with run_folder(out, fingerprint(prepared, asked, "traction")) as folder:
        found = traction(prepared, asked, on_point=_progress, raise_on_failure=False)
        columns = {"ratio": found.ratio} | {name: found[name] for name in NUMBERS}
        folder.clear()
        folder.write("traction.csv", curve_table(found, columns))
        columns |= uncertainty_columns(found.uncertainty)
        if len(found.errors) < found.ratio.size:
            marked = columns | {"validity": found.told}
            folder.draw("traction.png", plot_traction, marked, _title(scene.name, found.speed), scene.bodies.load)
        record = made_of(scene, prepared.surface, sq=prepared.surface.sq) | {
            "seconds": time.perf_counter() - begun,
            "report": found.report.as_dict(),
            "validity": list(found.validity),
            "ratio": found.ratio,
            "columns": columns,
            "entries": [[asdict(entry) for entry in found.entries(i)] for i in range(found.ratio.size)],
        }
        folder.finish(plain(record))
    for text in found.validity:
        say(text)
    say_written(folder.written, out, begun)
    if found.errors:
        first = found.errors[min(found.errors)]
        raise ConvergenceError(
            f"{len(found.errors)} of {found.ratio.size} ratios have no answer; first: {first}", found.report
        )
    return 0


def plot_again(folder: Path) -> bool:
    """Draw traction.png again if there is a traction.csv; returns whether there was."""
    source = folder / "traction.csv"
    if not source.is_file():
        return False
    columns = read_table(source)
    load = columns["contact_load"] + columns["film_load"]
    good = np.isfinite(load)
    if not good.any():
        raise InputError(f"{source} holds no answer to draw; run 'lubfric run --ratios' again")
    title = _title(run_name(folder), columns["speed"][good][0])
    with whole_file(folder / "traction.png") as part:
        plot_traction(part, columns, title, float(load[good][0]))
    return True


def _title(name: str, speed: float) -> str:
    return f"{name}, U = {speed:g} m/s"


def _progress(done, total, ratio, outcome) -> None:
    failed = isinstance(outcome, Exception)
    text = f"failed: {outcome}" if failed else outcome.uncertainty.short(outcome.coefficient)
    say(f"[{done:>{len(str(total))}}/{total}] slide-roll ratio {ratio:<9.4g}: {text}")
