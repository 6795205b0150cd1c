"""Measured points: how they are taken, told and read again."""

from __future__ import annotations

import json
import os
import platform
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TypeVar

import numpy as np

from lubfric._base import __version__

from ..check import TOLD, Check
from ..opponents import version
from ..report import environment

K = TypeVar("K")
V = TypeVar("V")
Quartiles = tuple[float, float, float]  # median, lower, upper, of processor seconds


def point(
    panel: str, method: str, setting: str, error: float, seconds: Sequence[float], **at: str | float | bool | None
) -> Check:
    """One setting of one method: its error against a tight solution, its time, and where it is drawn.

    ``at`` may say more: default (the setting that users get), apart (the error is that of the grid against a finer one,
    not that of the solver), size (unknowns), memory (peak bytes above the start), work (convolutions or Newton steps).
    """
    median, low, high = (float(s) for s in seconds)
    return Check(
        f"{panel}; {method}; {setting}",
        error,
        0.0,
        0.0,
        "a tighter solution",
        TOLD,
        seconds=median,
        at=at | {"panel": panel, "method": method, "setting": setting, "low": low, "high": high},
    )


def interleaved(calls: Mapping[K, Callable[[], V]], repeats: int) -> dict[K, tuple[V, Quartiles]]:
    """{name: (value, (median, lower, upper quartile) of processor seconds)}. The calls take turns in every repeat."""
    seconds: dict[K, list[float]] = {name: [] for name in calls}
    values: dict[K, V] = {}
    for _ in range(repeats):
        for name, call in calls.items():
            begun = time.process_time()
            values[name] = call()
            seconds[name].append(time.process_time() - begun)
    return {name: (values[name], _quartiles(taken)) for name, taken in seconds.items()}


def _quartiles(seconds: list[float]) -> Quartiles:
    low, median, high = np.quantile(seconds, (0.25, 0.5, 0.75))
    return float(median), float(low), float(high)


def machine() -> str:
    """One line for the head of a chart: processor, threads, how busy the machine is, versions, date."""
    found = environment()
    parts = [f"{name} {found[name]}" for name in ("python", "numpy", "scipy") if name in found]
    parts += [f"{name} {version(name)}" for name in ("tamaas", "aspher") if version(name)]
    return (
        f"{processor()}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}, "
        f"OMP_NUM_THREADS={os.environ.get('OMP_NUM_THREADS', 'unset')}; "
        f"{', '.join(parts)}, lubfric {__version__}; {time.strftime('%Y-%m-%d')}"
    )


def processor() -> str:
    """The name of the processor, as far as the system tells it."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    return next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), platform.machine())


def load(folder: Path, chart: str) -> list[Check]:
    """The points of one chart in the report.json of an earlier run."""
    return [Check.from_dict(c) for study in _studies(folder, chart) for c in study["checks"]]


def measured_on(folder: Path, chart: str) -> str:
    """The line that `machine` gave in an earlier run, "" where that run did not keep it."""
    tables = [table for study in _studies(folder, chart) for table in study.get("tables", ())]
    return next((t["rows"][0][0] for t in tables if t["name"] == f"{chart}_machine"), "")


def _studies(folder: Path, chart: str) -> list[dict]:
    studies = json.loads((folder / "report.json").read_text())["studies"]
    return [study for study in studies if study["name"] == chart]
