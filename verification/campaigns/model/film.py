"""The deterministic film on ever smaller cells, every point alone."""

import resource
import time
from collections.abc import Iterator

import numpy as np

import lubfric

from ...check import AT_MOST, Check, Item, Table
from ...kept import Run
from ...pace import paced

WIDTH = 90e-6  # m, of the patch
GRIDS = {"quick": (1, (32, 48, 64)), "default": (2, (64, 128, 256)), "full": (5, (128, 256, 512))}
ALLOWED = {"quick": 0.05, "default": 0.01, "full": 0.005}  # change of f from the second grid to the third
MEMORY = 6.0  # GB, allowed for a curve of 25 speeds on 128 cells
SECONDS = 30.0  # s of processor time, allowed for the same curve


def grids(level: str, run: Run = Run()) -> Iterator[Item]:
    """f at 5.5 N on three grids, and the time of a Stribeck curve."""
    count, cells = GRIDS[level]
    cases = {
        f"{u} m/s, {n} cells, {k}": (u, k, n) for u in (0.03, 0.01, 0.003) for k in range(1, count + 1) for n in cells
    }
    rows = [row for _, row in run.solved(cases, on_cells)]
    f, seconds = np.array(rows)[:, :2].reshape(3, count, 3, 2).transpose(3, 0, 1, 2)
    memory = max(row[2] for row in rows)
    last = np.abs(f[..., 1] / f[..., 2] - 1)
    order = np.log(np.abs((f[..., 1] - f[..., 0]) / (f[..., 2] - f[..., 1]))) / np.log(cells[2] / cells[1])
    table = []
    for speed, change, slopes, times in zip((0.03, 0.01, 0.003), last, order, seconds[..., 2]):
        name = f"{speed:g} m/s, {count} surfaces: largest change of f from {cells[1]} to {cells[2]} cells"
        yield Check(name, change.max(), expected=ALLOWED[level], tolerance=0.0, source="the finer grid", kind=AT_MOST)
        result = f"{100 * change.max():.2f} %", f"{slopes.min():.1f} to {slopes.max():.1f}", f"{np.median(times):.0f} s"
        table.append((f"{speed:g}", str(count), *result, f"{memory:.1f} GB"))
    columns: tuple[str, ...] = ("U (m/s)", "surfaces", f"largest change of f, {cells[1]} to {cells[2]}", "order")
    columns += (f"processor time at {cells[2]}, median", "memory")
    yield Table("refinement", "The coefficient on three grids", columns, table)
    model = patch(1, 32 if level == "quick" else 128)
    speeds = np.geomspace(1.0, 1e-3, 25)
    _, taken = paced(lambda: lubfric.stribeck(model, speeds))
    yield Check(
        "25 speeds: processor time on the stated core",
        taken,
        expected=SECONDS,
        tolerance=0.0,
        source="target",
        kind=AT_MOST,
        unit="s",
    )
    yield Check("memory", memory, expected=MEMORY, tolerance=0.0, source="of the process", kind=AT_MOST, unit="GB")


def patch(seed: int, cells: int) -> lubfric.Prepared:
    """Return one patch of the built-in surface made ready for the deterministic model, on so many cells each way."""
    fine = lubfric.generate_surface(
        (256, 256), WIDTH / 256, sq=1e-7, correlation_length=8e-6, acf="gaussian", seed=seed
    )
    numerics = {"model": "deterministic", "grid": "given", "sampling": "patch"}
    return lubfric.prepare(lubfric.load_scene("paper").with_(numerics=numerics), fine.resampled(shape=(cells, cells)))


def on_cells(case: tuple[float, int, int]) -> list[float]:
    """Return f, processor seconds and peak memory [GB] of a speed on so many cells of a surface."""
    speed, seed, cells = case
    model = patch(seed, cells)
    begun = time.process_time()
    f = lubfric.friction(model, speed).coefficient
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e9
    return [f, time.process_time() - begun, memory]
