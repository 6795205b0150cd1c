"""The deterministic film on ever smaller cells and at heavy loads, every point alone."""

from __future__ import annotations

import resource
import time
from collections.abc import Iterator

import numpy as np

import lubfric
from lubfric.deterministic import solve_point

from ..check import AT_MOST, Check, Item, Table
from ..kept import Run
from ..pace import paced
from ..stability.whole_map import bearing
from .points import REFERENCE, Setting, prepared

GRIDS = {"quick": (1, (32, 48, 64)), "default": (2, (64, 128, 256)), "full": (5, (128, 256, 512))}
ALLOWED = {"quick": 0.05, "default": 0.01, "full": 0.005}  # change of f from the second grid to the third
MEMORY, SECONDS = 6.0, 30.0  # GB; of a curve of 25 speeds on 128 cells
LOADS = {"quick": (1, 0, 32), "default": (10, 10, 64), "full": (10, 10, 128)}  # surfaces; those at 1 GPa; cells across
SLOWEST = {"quick": 60.0, "default": 60.0, "full": 10.0}  # s of a point at heavy load
KINDS, GIGAPASCAL = {"27.5 N": 27.5, "110 N": 110.0, "1 GPa": 0.0}, 2.72e5  # N/m: 1 GPa in the middle of the bearing
MOST = 100  # factorisations of a point at 1 GPa, so that one that fails costs a minute


def grids(level: str, run: Run = Run()) -> Iterator[Item]:
    """f at 5.5 N on three grids, and the time of a Stribeck curve."""
    count, cells = GRIDS[level]
    cases = {
        f"{u} m/s, {n} cells, {k}": (u, n, k) for u in (0.03, 0.01, 0.003) for k in range(1, count + 1) for n in cells
    }
    rows = [row for _, row in run.solved(cases, on_cells)]
    f, seconds = np.array(rows)[:, :2].reshape(3, count, 3, 2).transpose(3, 0, 1, 2)
    memory = max(row[2] for row in rows)
    last = np.abs(f[..., 1] / f[..., 2] - 1)
    order = np.log(np.abs((f[..., 1] - f[..., 0]) / (f[..., 2] - f[..., 1]))) / np.log(cells[2] / cells[1])
    table = []
    for speed, change, slopes, times in zip((0.03, 0.01, 0.003), last, order, seconds[..., 2]):
        name = f"{speed:g} m/s, {count} surfaces: largest change of f from {cells[1]} to {cells[2]} cells"
        yield Check(name, change.max(), ALLOWED[level], 0.0, "the finer grid", AT_MOST)
        found = f"{100 * change.max():.2f} %", f"{slopes.min():.1f} to {slopes.max():.1f}", f"{np.median(times):.0f} s"
        table.append((f"{speed:g}", str(count), *found, f"{memory:.1f} GB"))
    columns: tuple[str, ...] = ("U (m/s)", "surfaces", f"largest change of f, {cells[1]} to {cells[2]}", "order")
    columns += (f"processor time at {cells[2]}, median", "memory")
    yield Table("refinement", "The coefficient on three grids", columns, table)
    model, speeds = prepared(Setting(1, 5.5, 32 if level == "quick" else 128), REFERENCE), np.geomspace(1.0, 1e-3, 25)
    _, taken = paced(lambda: lubfric.stribeck(model, speeds))
    yield Check("25 speeds: processor time on the stated core", taken, SECONDS, 0.0, "asked", AT_MOST, unit="s")
    yield Check("memory", memory, MEMORY, 0.0, "of the process", AT_MOST, unit="GB")


def on_cells(case: tuple[float, int, int]) -> list[float]:
    """f, processor seconds and peak memory [GB] of a speed on so many cells of a surface."""
    speed, seed, cells = case
    model = prepared(Setting(seed, 5.5, cells), REFERENCE)
    begun = time.process_time()
    f = lubfric.friction(model, speed).coefficient
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e9
    return [f, time.process_time() - begun, memory]


def loads(level: str, run: Run = Run()) -> Iterator[Item]:
    """Surfaces from 0.3 down to 0.001 m/s: the paper's cylinder at 27.5 and 110 N, and the bearing of the stability map
    at 1 GPa, each with a shear-limited compressible oil. Where the bearing is not solved is shown."""
    light, heaviest, cells = LOADS[level]
    counts = {kind: light if newton else heaviest for kind, newton in KINDS.items()}
    table = []
    for kind in (kind for kind, count in counts.items() if count):
        seeds, speeds = range(1, counts[kind] + 1), (0.3, 0.1, 0.03, 0.01, 0.003, 0.001)
        cases = {f"{kind}, {seed} at {u} m/s": (kind, seed, u, cells) for seed in seeds for u in speeds}
        rows = [row for _, row in run.solved(cases, at_load)]
        lost = [key.partition(", ")[2] for key, row in zip(cases, rows) if row["failure"]]
        seconds = [row["seconds"] for row in rows if not row["failure"]]
        name, asked = f"{kind}, {len(seeds)} surfaces", kind != "1 GPa"
        failed = f"{name}: points of {len(rows)} that were not solved"
        yield Check(failed, len(lost), 0, 0, "the solver's own report", AT_MOST, note=", ".join(lost), decisive=asked)
        slowest = max(row["seconds"] for row in rows)
        yield Check(f"{name}: slowest", slowest, SLOWEST[level], 0.0, "asked", AT_MOST, unit="s", decisive=asked)
        times = f"{np.median(seconds):.1f} s", f"{max(seconds):.1f} s"
        table.append((kind, str(len(seeds)), f"{len(seconds)} of {len(rows)}", *times, ", ".join(lost)))
    columns = ("load", "surfaces", "points solved", "median processor time", "longest", "not solved")
    yield Table("heavy-loads", f"The deterministic film at heavy loads, {cells} cells across", columns, table)


def at_load(case: tuple[str, int, float, int]) -> dict:
    """f, share of the spots, processor seconds and the failure, if any, of one point."""
    kind, seed, speed, cells = case
    begun = time.process_time()
    try:
        if kind == "1 GPa":
            found = solve_point(bearing(200e-9, GIGAPASCAL, speed, seed, cells), most=MOST)
            f, share = found.coefficient, found.split.spots / found.load
        else:
            point = lubfric.friction(prepared(Setting(seed, KINDS[kind], cells, True), REFERENCE), speed)
            f, share = point.coefficient, point.contact_load / KINDS[kind]
    except lubfric.ConvergenceError as error:
        return {"f": None, "share": None, "failure": str(error), "seconds": time.process_time() - begun}
    return {"f": f, "share": share, "failure": "", "seconds": time.process_time() - begun}
