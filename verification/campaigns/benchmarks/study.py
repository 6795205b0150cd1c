"""A study of many points: points per second, what two processes cost, memory, disk.

    python -m verification.campaigns.benchmarks.study [--points 10000] [--workers 2] [--out FOLDER] [--docs docs]

Loads x viscosities x maps x speeds on maps of 64 x 64 cells. The study runs on WORKERS processes. A tenth of its
curves also runs in this process, and both processor times are compared. After an interruption the same command
continues. It prints one table and draws study.png into FOLDER.
"""

import os

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(name, "1")

import argparse
import resource
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from itertools import product
from pathlib import Path

import numpy as np

import lubfric

from . import page

FEW = 10  # every so many curves are run here too


def plan(points: int) -> lubfric.StudyPlan:
    """Return 5 loads x 5 viscosities x 4 maps x speeds."""
    scene = lubfric.load_scene("paper").with_(
        contact={"shape": (64, 64), "spacing": 0.9e-6}, numerics={"model": "paper", "sampling": "patch"}
    )
    vary = {
        "bodies.load": np.linspace(2.0, 6.0, 5),
        "lubricant.viscosity": np.geomspace(0.05, 0.4, 5),
        "surface.seed": [1, 2, 3, 4],
    }
    return lubfric.plan_study(scene, vary, np.geomspace(1e-3, 1.0, max(points // 100, 1)))


def draw(folder: Path, result: lubfric.StudyResult) -> None:
    """Curves of all loads and viscosities on the first map, over viscosity x speed, from the Dataset."""
    import matplotlib.pyplot as plt

    data = result.to_xarray()
    figure, ax = plt.subplots(figsize=(7, 5))
    for i, load in enumerate(data["bodies.load"].values):
        for viscosity in data["lubricant.viscosity"].values:
            curve = data.coefficient.sel({"bodies.load": load, "lubricant.viscosity": viscosity, "surface.seed": 1})
            ax.semilogx(viscosity * data.speed, curve, color=f"C{i}", lw=0.8)
        ax.plot([], [], color=f"C{i}", label=f"{load:g} N")
    ax.set(xlabel="viscosity x speed (N/m)", ylabel="friction coefficient (-)", title=f"{result.status.size} points")
    ax.legend(frameon=False)
    figure.savefig(folder / "study.png", dpi=120)


def main() -> None:
    """Run and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--points", type=int, default=10_000)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--out", type=Path)
    page.add_option(parser)
    arguments = parser.parse_args()
    folder = arguments.out or Path(tempfile.mkdtemp())
    full_plan = plan(arguments.points)
    together = list(product(*(axis.values for axis in full_plan.axes)))[::FEW]
    keys = tuple(key for axis in full_plan.axes for key in axis.keys)
    few = lubfric.plan_study(full_plan.scene, {keys: [sum(row, ()) for row in together]}, full_plan.speeds)
    used = time.process_time()
    lubfric.study(few, store=folder / "few")
    here = (time.process_time() - used) / few.points
    begun = time.perf_counter()
    with ProcessPoolExecutor(arguments.workers) as executor:
        result = lubfric.study(full_plan, executor=executor, store=folder / "all")
    wall = time.perf_counter() - begun
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    there = (children.ru_utime + children.ru_stime) / full_plan.points
    begun = time.perf_counter()
    again = lubfric.open_study(folder / "all")
    opened = time.perf_counter() - begun
    size = sum(path.stat().st_size for path in (folder / "all").rglob("*"))
    rows = [
        (
            "points",
            f"{full_plan.points} on {arguments.workers} processes, {result.failed} failed, {again.missing} missing",
        ),
        ("wall time", f"{wall:.1f} s, {full_plan.points / wall:.0f} points a second"),
        (
            "processor time",
            f"{1e3 * there:.2f} ms a point: {there * full_plan.points / wall:.2f} cores' worth were had",
        ),
        ("processor time of a tenth of the curves, serial over there", f"{here / there:.1%}"),
        ("memory of a process", f"{children.ru_maxrss / 1024:.0f} MiB at most"),
        ("store", f"{size / 1e6:.1f} MB, opened in {opened:.2f} s"),
    ]
    draw(folder, again)
    print("| what | measured |\n|---|---|")
    for name, value in rows:
        print(f"| {name} | {value} |")
    page.write("study-points", ("what", "measured"), rows, (parser, arguments))


if __name__ == "__main__":
    main()
