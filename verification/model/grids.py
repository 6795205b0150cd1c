"""The deterministic film on ever smaller cells: how much f still changes, with which order, and at what cost; and the
time of a Stribeck curve."""

from __future__ import annotations

import resource
import time
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np

import lubfric
from lubfric.deterministic import layer, solve_refined

from .. import kept
from ..check import AT_MOST, Check, Item, Table
from ..pace import paced
from .measure import REFERENCE, Setting, scene_of, surface_of

CASES = {"quick": (1, (32, 48, 64)), "default": (2, (64, 128, 256)), "full": (5, (128, 256, 512))}
SPEEDS = (0.03, 0.01, 0.003)
ALLOWED = {"quick": 0.05, "default": 0.01, "full": 0.005}
MEMORY = 6.0  # GB
CURVE = np.geomspace(1.0, 1e-3, 25)  # m/s
ACROSS = {"quick": 32, "default": 128, "full": 128}  # cells of the curve
SECONDS = 30.0


def grids(level: str, folder: Path | None = None) -> Iterator[Item]:
    """f at 5.5 N on three grids of cells half as large each time, from a cold start; kept in ``folder`` point by
    point."""
    count, cells = CASES[level]
    keys = [f"{speed} {seed}" for speed in SPEEDS for seed in range(1, count + 1)]
    rows = list(kept.each(None if folder is None else folder / "points.jsonl", keys, partial(refined, cells)))
    columns = (
        "U [m/s]", "surface", *(f"f {n}" for n in cells), "last change [%]", "order", "estimate [%]",
        *(f"spots {n}" for n in cells), *(f"CPU s {n}" for n in cells), "memory [GB]",
    )  # fmt: skip
    yield Table("grids", "The coefficient on three grids", columns, rows)
    for speed in SPEEDS:
        mine = [row for row in rows if row[0] == speed]
        worst = max(abs(row[5]) for row in mine) / 100
        name = f"{speed:g} m/s, {len(mine)} surfaces: largest change of f from {cells[1]} to {cells[2]} cells"
        yield Check(name, worst, ALLOWED[level], 0.0, "the finer grid", AT_MOST)
    yield curve(ACROSS[level])
    yield Check("memory", max(row[-1] for row in rows), MEMORY, 0.0, "of the process", AT_MOST, unit="GB")


def refined(cells, key: str) -> list:
    """A row of the table: speed and surface ``key`` on every one of the grids ``cells``."""
    speed, seed = key.split()
    setting = Setting(int(seed), "gaussian", 5.5, "Newtonian", SPEEDS, cells[-1])
    lay = layer(scene_of(setting, REFERENCE), surface_of(setting), float(speed))
    begun: list[float] = []

    def timed(shape):
        begun.append(time.process_time())
        return lay(shape)

    found = solve_refined(timed, tuple((n, n) for n in cells), tolerance=0.0, least=len(cells))
    begun.append(time.process_time())
    f = [one.coefficient for one in found.results]
    spots = [one.split.spots / one.load for one in found.results]
    order = np.log2(abs(f[1] - f[0]) / abs(f[2] - f[1]))
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e9
    return [
        float(speed), int(seed), *f, 100 * (f[1] / f[2] - 1), order, 100 * (found.error or 0.0), *spots,
        *np.diff(begun), memory,
    ]  # fmt: skip


def curve(cells: int) -> Check:
    """Processor time of 25 speeds of the scene `paper` in one process, with the half as many cells of the estimate."""
    setting = Setting(1, "gaussian", 5.5, "Newtonian", tuple(CURVE), cells)
    model = lubfric.prepare(scene_of(setting, REFERENCE), surface_of(setting))
    found, seconds = paced(lambda: lubfric.stribeck(model, CURVE))
    name = f"{found.coefficient.size} speeds on {cells} cells: processor time on the stated core"
    return Check(name, seconds, SECONDS, 0.0, "asked", AT_MOST, unit="s")
