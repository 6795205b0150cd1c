"""Measured points: one record each, kept as CSV and JSON so that a chart can be drawn again."""

from __future__ import annotations

import csv
import json
import os
import platform
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass, fields
from pathlib import Path

import numpy as np

from ..opponents import version
from ..report import environment


@dataclass(frozen=True)
class Point:
    """One setting of one method.

    chart, panel, method: where it is drawn. setting: what was varied (a tolerance, a grid), in words.
    error: from the solver, against the tight solution on the same grid. discretisation: of that grid, against a finer
    one (NaN where it is not measured apart). seconds: median; low, high: quartiles. default: the setting users get.
    size: unknowns; memory: peak bytes above the start (NaN where not measured); work: convolutions or Newton steps.
    """

    chart: str
    panel: str
    method: str
    setting: str
    error: float
    seconds: float
    low: float
    high: float
    discretisation: float = float("nan")
    default: bool = False
    size: float = float("nan")
    memory: float = float("nan")
    work: float = float("nan")


def interleaved(calls: dict[str, Callable], repeats: int) -> dict[str, tuple[object, tuple[float, float, float]]]:
    """{name: (value, (median, lower, upper quartile) of seconds)}, the repeats of all calls taken in turn."""
    seconds, values = {name: [] for name in calls}, {}
    for _ in range(repeats):
        for name, call in calls.items():
            begun = time.perf_counter()
            values[name] = call()
            seconds[name].append(time.perf_counter() - begun)
    return {
        name: (values[name], tuple(float(q) for q in np.quantile(seconds[name], (0.5, 0.25, 0.75)))) for name in calls
    }


def machine() -> str:
    """One line for the foot of a chart: processor, threads, versions, date."""
    found = environment()
    parts = [f"{name} {found[name]}" for name in ("python", "numpy", "scipy") if name in found]
    parts += [f"{name} {version(name)}" for name in ("tamaas", "aspher") if version(name)]
    return (
        f"{processor()}, {os.cpu_count()} cores, OMP_NUM_THREADS={os.environ.get('OMP_NUM_THREADS', 'unset')}; "
        f"{', '.join(parts)}; {time.strftime('%Y-%m-%d')}"
    )


def processor() -> str:
    """The name of the processor, as far as the system tells it."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    return next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), platform.machine())


def save(points: list[Point], out: Path, name: str) -> None:
    """``name``.csv and ``name``.json in ``out``."""
    out.mkdir(parents=True, exist_ok=True)
    (out / f"{name}.json").write_text(
        json.dumps({"machine": machine(), "points": [asdict(p) for p in points]}, indent=1)
    )
    with open(out / f"{name}.csv", "w", newline="") as stream:
        writer = csv.writer(stream)
        writer.writerow([f.name for f in fields(Point)])
        writer.writerows([getattr(p, f.name) for f in fields(Point)] for p in points)


def load(path: Path) -> tuple[str, list[Point]]:
    """(machine, points) of a JSON file that `save` wrote."""
    found = json.loads(Path(path).read_text())
    return found["machine"], [Point(**p) for p in found["points"]]
