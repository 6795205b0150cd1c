"""A study of many points: points per second, what two processes gain, memory, disk.

    python benchmarks/study.py [--points 10000] [--workers 2] [--out FOLDER]

Loads x viscosities x maps x speeds on maps of 64 x 64 cells. The study is run on WORKERS processes; ten curves of it
are run in this process too, whose processor time a point is the serial reference, so that a busy machine does not blur
the comparison. Prints one table.
"""

import os

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(name, "1")

import argparse
import resource
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

import lubfric


def plan(points: int, curves: int | None = None):
    """5 loads x 5 viscosities x 4 maps x speeds; with ``curves``: only so many of them."""
    scene = lubfric.load_scene("paper").with_(
        contact={"shape": (64, 64), "spacing": 0.9e-6}, numerics={"sampling": "patch"}
    )
    vary = {
        "bodies.load": np.linspace(2.0, 6.0, 5),
        "lubricant.viscosity": np.geomspace(0.05, 0.4, 5),
        "surface.seed": [1, 2, 3, 4],
    }
    if curves:
        vary = {"surface.seed": [1, 2], "lubricant.viscosity": vary["lubricant.viscosity"][: curves // 2]}
    return lubfric.plan_study(scene, vary, np.geomspace(1e-3, 1.0, max(points // 100, 1)))


def cpu(who: int) -> float:
    """Processor seconds of this process or its children."""
    used = resource.getrusage(who)
    return used.ru_utime + used.ru_stime


def memory(who: int) -> float:
    """Largest resident memory so far [MiB]."""
    return resource.getrusage(who).ru_maxrss / 1024


def main() -> None:
    """Run and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--points", type=int, default=10_000)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--out", type=Path)
    arguments = parser.parse_args()
    folder = arguments.out or Path(tempfile.mkdtemp())
    few, whole = plan(arguments.points, 10), plan(arguments.points)
    begun = cpu(resource.RUSAGE_SELF)
    lubfric.study(few, store=folder / "few")
    serial = (cpu(resource.RUSAGE_SELF) - begun) / few.points
    began, own = time.perf_counter(), cpu(resource.RUSAGE_SELF)
    with ProcessPoolExecutor(arguments.workers) as executor:
        result = lubfric.study(whole, executor=executor, store=folder / "all")
    wall, own = time.perf_counter() - began, cpu(resource.RUSAGE_SELF) - own
    spread = cpu(resource.RUSAGE_CHILDREN) / whole.points
    begun = time.perf_counter()
    again = lubfric.open_study(folder / "all")
    opened = time.perf_counter() - begun
    size = sum(path.stat().st_size for path in (folder / "all").rglob("*"))
    rows = [
        ("points", f"{whole.points}, {result.failed} failed, {again.missing} missing"),
        ("processes", str(arguments.workers)),
        ("wall time", f"{wall:.1f} s, {whole.points / wall:.0f} points a second"),
        ("processor time a point, in the processes", f"{1e3 * spread:.2f} ms"),
        ("processor time a point, serial", f"{1e3 * serial:.2f} ms"),
        ("efficiency: serial over (processes + share of this one)", f"{serial / (spread + own / whole.points):.0%}"),
        ("largest memory of a process", f"{memory(resource.RUSAGE_CHILDREN):.0f} MiB"),
        ("largest memory of this one", f"{memory(resource.RUSAGE_SELF):.0f} MiB"),
        ("store", f"{size / 1e6:.1f} MB, opened in {opened:.2f} s"),
    ]
    print("| | |\n|---|---|")
    for name, value in rows:
        print(f"| {name} | {value} |")


if __name__ == "__main__":
    main()
