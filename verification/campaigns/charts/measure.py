"""Measured points: how they are taken and where."""

import os
import platform
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TypeVar

import numpy as np

from ...check import REPORTED, Check
from ...frame import environment
from ...types import PlainRow
from ..opponents import peers

K = TypeVar("K")
V = TypeVar("V")
Quartiles = tuple[float, float, float]  # median, lower, upper, of processor seconds


def point(
    panel: str, method: str, setting: str, error: float, seconds: Sequence[float], **at: str | float | bool | None
) -> PlainRow:
    """Return one setting of one method, as a check in plain types: its error against a tight solution, its time, and
    where it is drawn.

    ``at`` may say more: default (the setting that users get), apart (the error is that of the grid against a finer one,
    not that of the solver), size (unknowns).
    """
    median, low, high = (float(s) for s in seconds)
    where = at | {"panel": panel, "method": method, "setting": setting, "seconds": median, "low": low, "high": high}
    name = f"{panel}; {method}; {setting}"
    return Check(
        name, error, expected=0.0, tolerance=0.0, source="a tighter solution", kind=REPORTED, seconds=median, at=where
    ).as_dict()


def interleaved(calls: Mapping[K, Callable[[], V]], repeats: int) -> dict[K, tuple[V, Quartiles]]:
    """Return {name: (value, (median, lower, upper quartile) of processor seconds)}. The calls take turns in every
    repeat."""
    seconds: dict[K, list[float]] = {name: [] for name in calls}
    values: dict[K, V] = {}
    for _ in range(repeats):
        for name, call in calls.items():
            begun = time.process_time()
            values[name] = call()
            seconds[name].append(time.process_time() - begun)
    return {name: (values[name], quartiles(taken)) for name, taken in seconds.items()}


def quartiles(seconds: list[float]) -> Quartiles:
    """Return median, lower and upper quartile."""
    low, median, high = np.quantile(seconds, (0.25, 0.5, 0.75))
    return float(median), float(low), float(high)


def machine(_: None = None) -> str:
    """Return one line for the head of a chart: processor, threads, how busy the machine is, versions, date."""
    values = environment()
    parts = [f"{name} {values[name]}" for name in ("python", "numpy", "scipy", "lubfric")]
    parts.append(peers())
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    processors = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    return (
        f"{(processors or [platform.machine()])[0]}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}, "
        f"OMP_NUM_THREADS={os.environ.get('OMP_NUM_THREADS', 'unset')}; {', '.join(parts)}; {time.strftime('%Y-%m-%d')}"
    )
