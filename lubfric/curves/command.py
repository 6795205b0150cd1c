"""``lubfric run SCENE --ratios``: the traction curve of a scene, written to a folder."""

from __future__ import annotations

import csv
import json
import time
from dataclasses import asdict
from pathlib import Path

import numpy as np

from .. import __version__
from ..errors import ConvergenceError
from ..model import prepare
from ..output import UNITS, _plain
from ..scene import scene_as_dict
from ..sweep import QUANTITIES
from .draw import plot_traction
from .traction import traction


def run_traction(scene, ratios, out: Path, say) -> int:
    """Solve, write traction.csv, result.json and traction.png to ``out``, and say what does not hold."""
    begun = time.perf_counter()
    model = prepare(scene)
    say(model.surface.describe())

    def progress(done, total, ratio, outcome):
        text = f"failed: {outcome}" if isinstance(outcome, Exception) else f"f = {outcome.coefficient:.5g}"
        say(f"[{done}/{total}] slide-roll ratio {ratio:.4g}: {text}")

    found = traction(model, ratios, on_point=progress, raise_on_failure=False)
    told = [" | ".join(entry.text for entry in found.entries(i)) for i in range(found.ratio.size)]
    out.mkdir(parents=True, exist_ok=True)
    with (out / "traction.csv").open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["ratio [-]", *(f"{name} [{UNITS.get(name, '-')}]" for name in QUANTITIES), "validity"])
        writer.writerows(zip(found.ratio, *(found[name] for name in QUANTITIES), told))
    record = {
        "scene": scene_as_dict(scene),
        "versions": {"lubfric": __version__, "numpy": np.__version__},
        "seconds": time.perf_counter() - begun,
        "report": found.report.as_dict(),
        "validity": list(found.validity),
        "ratio": found.ratio,
        "columns": found.columns,
        "entries": [[asdict(entry) for entry in found.entries(i)] for i in range(found.ratio.size)],
    }
    (out / "result.json").write_text(json.dumps(_plain(record), indent=1, allow_nan=False))
    if len(found.errors) < found.ratio.size:
        columns = {"ratio": found.ratio, "validity": told} | found.columns
        plot_traction(out / "traction.png", columns, f"{scene.name}, U = {found.speed:g} m/s", scene.bodies.load)
    for text in found.validity:
        say(text)
    say(f"wrote traction.csv, result.json, traction.png to {out} in {time.perf_counter() - begun:.1f} s")
    if found.errors:
        first = found.errors[min(found.errors)]
        raise ConvergenceError(
            f"{len(found.errors)} of {found.ratio.size} ratios have no answer; first: {first}", found.report
        )
    return 0
