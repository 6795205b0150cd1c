"""A study of many points: points per second, what two processes gain, memory, disk.

    python benchmarks/study.py [--points 10000] [--workers 2] [--out FOLDER] [--docs docs]

Loads x viscosities x maps x speeds on maps of 64 x 64 cells. The study is run on WORKERS processes; every tenth of its
batches is run in this process too, and its processor time is set beside the processor time that the same batches took
there, so that a busy machine does not blur the comparison; idle is the share of the time in which a process held no
batch. Cut at any moment, the same command goes on from there. Prints one table and draws study.png into FOLDER.
"""

import os

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(name, "1")

import argparse
import json
import resource
import sys
import tempfile
import time
from collections import defaultdict
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))

import lubfric
from benchmarks import page
from lubfric.studies import run

FEW = 10  # every so many batches are run here too
solve = run.rows_of


def plan(points: int):
    """5 loads x 5 viscosities x 4 maps x speeds."""
    scene = lubfric.load_scene("paper").with_(
        contact={"shape": (64, 64), "spacing": 0.9e-6}, numerics={"sampling": "patch"}
    )
    vary = {
        "bodies.load": np.linspace(2.0, 6.0, 5),
        "lubricant.viscosity": np.geomspace(0.05, 0.4, 5),
        "surface.seed": [1, 2, 3, 4],
    }
    return lubfric.plan_study(scene, vary, np.geomspace(1e-3, 1.0, max(points // 100, 1)))


def timed(batch):
    """`rows_of`, with a line in times.jsonl: who, what, when, processor time, memory [MiB]."""
    began, used = time.time(), time.process_time()
    rows = list(solve(batch))
    told = {
        "process": os.getpid(),
        "batch": batch.name,
        "whole": not batch.known,
        "began": began,
        "ended": time.time(),
        "cpu": time.process_time() - used,
        "memory": int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize() / 2**20,
    }
    with (Path(batch.folder) / "times.jsonl").open("a") as file:
        file.write(json.dumps(told) + "\n")
    return rows


def idle(batches: list[dict]) -> float:
    """Share of the time between first and last batch in which a process held none."""
    by_process = defaultdict(list)
    for batch in batches:
        by_process[batch["process"]].append(batch)
    held = sum(batch["ended"] - batch["began"] for batch in batches)
    ends = [(min(p["began"] for p in own), max(p["ended"] for p in own)) for own in by_process.values()]
    first, last = min(b for b, _ in ends), max(e for _, e in ends)
    return 1 - held / ((last - first) * len(ends))


def draw(folder: Path, result) -> None:
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
    whole = plan(arguments.points)
    few = replace(whole, batches=whole.batches[::FEW])
    run.rows_of = timed
    lubfric.study(few, store=folder / "few")
    with ProcessPoolExecutor(arguments.workers) as executor:
        result = lubfric.study(whole, executor=executor, store=folder / "all")
    begun = time.perf_counter()
    again = lubfric.open_study(folder / "all")
    opened = time.perf_counter() - begun
    size = sum(path.stat().st_size for path in (folder / "all").rglob("*"))
    alone, batches = (
        [json.loads(line) for line in (folder / part / "times.jsonl").read_text().splitlines()]
        for part in ("few", "all")
    )
    batches.sort(key=lambda batch: batch["ended"])
    here = {b["batch"]: b["cpu"] for b in alone if b["whole"]}
    there = {b["batch"]: b["cpu"] for b in batches if b["whole"]}
    both = sorted(here.keys() & there.keys())
    ratio = sum(here[name] for name in both) / sum(there[name] for name in both)
    wall, used = batches[-1]["ended"] - min(b["began"] for b in batches), sum(b["cpu"] for b in batches)
    tenth = max(len(batches) // 10, 1)
    rows = [
        ("points", f"{whole.points}, {result.failed} failed, {again.missing} missing"),
        ("processes", str(len({b["process"] for b in batches}))),
        ("wall time", f"{wall:.1f} s, {whole.points / wall:.0f} points a second"),
        ("processor time", f"{1e3 * used / whole.points:.2f} ms a point: {used / wall:.2f} cores' worth were had"),
        ("processor time of the same batches, serial over there", f"{ratio:.1%} ({len(both)} batches)"),
        ("idle", f"{idle(batches):.1%} of the time of a process"),
        (
            "memory of a process",
            f"{np.median([p['memory'] for p in batches[:tenth]]):.0f} MiB in the first tenth, "
            f"{np.median([p['memory'] for p in batches[-tenth:]]):.0f} MiB in the last, "
            f"{max(p['memory'] for p in batches):.0f} MiB at most",
        ),
        ("store", f"{size / 1e6:.1f} MB, opened in {opened:.2f} s"),
    ]
    draw(folder, again)
    print("| what | measured |\n|---|---|")
    for name, value in rows:
        print(f"| {name} | {value} |")
    page.write("study-points", ("what", "measured"), rows, (parser, arguments))


if __name__ == "__main__":
    main()
