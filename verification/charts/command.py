"""``python -m verification charts``: error against time, and cost against size, measured on this machine."""

from __future__ import annotations

import argparse
import importlib
import multiprocessing
import os
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from .data import Point, load, machine, save
from .draw import compact, growth, work_precision

CHARTS = {name: f"verification.charts.{name}" for name in ("contact", "film", "job", "growth")}


def main(argv: list[str]) -> int:
    """Exit code 0: every chart asked for was drawn."""
    options = parser().parse_args(argv)
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    os.environ.setdefault("OMP_WAIT_POLICY", "passive")
    for name in options.only or list(CHARTS):
        if options.redraw:
            where, points = load(options.out / f"{name}.json")
        else:
            begun = time.perf_counter()
            points, where = measured(name, options.level), machine()
            save(points, options.out, name)
            print(
                f"{name}: {len(points)} points in {time.perf_counter() - begun:.0f} s",
                file=sys.stderr,
                flush=True,
            )
        figure = growth(points, where) if name == "growth" else work_precision(f"performance-{name}", points, where)
        path = options.out / f"{figure.name}.png"
        path.write_bytes(compact(figure).data)
        print(path)
    return 0


def measured(name: str, level: str) -> list[Point]:
    """All points of one chart, from a new process: the number of threads is read once, when NumPy is loaded."""
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        return pool.submit(points_of, name, level).result()


def points_of(name: str, level: str) -> list[Point]:
    """All points of one chart, measured here."""
    return list(importlib.import_module(CHARTS[name]).points(level))


def parser() -> argparse.ArgumentParser:
    """The command line."""
    p = argparse.ArgumentParser("python -m verification charts", description=__doc__)
    level = p.add_mutually_exclusive_group()
    level.add_argument("--quick", dest="level", action="store_const", const="quick", help="within a minute")
    level.add_argument("--full", dest="level", action="store_const", const="full", help="every setting (default)")
    p.add_argument("--only", nargs="+", choices=list(CHARTS), metavar="CHART", help=f"of {', '.join(CHARTS)}")
    p.add_argument("--redraw", action="store_true", help="from the JSON files in the folder, without measuring")
    p.add_argument("--out", type=Path, default=Path("out/charts"), metavar="DIR")
    p.set_defaults(level="full")
    return p
