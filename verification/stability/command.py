"""``python -m verification stability``: map where methods fail, and prove that the default ones say so."""

from __future__ import annotations

import argparse
import importlib
import multiprocessing
import os
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from ..hostile import command as bad_inputs
from ..hostile.case import GOOD
from .cell import FAILED, WRONG, Cell
from .draw import save, table

MAPS = {
    "film": "verification.stability.film_map",
    "contact": "verification.stability.contact_map",
    "sharing": "verification.stability.sharing_map",
}


def main(argv: list[str]) -> int:
    """Exit code: 0 no cell of a default method is silently wrong, none inside the promised range failed, and every bad
    input was refused in words; else 1."""
    options = parser().parse_args(argv)
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    begun = time.perf_counter()
    cells = run_maps(options.only or list(MAPS), options.level, options.workers)
    seconds = time.perf_counter() - begun
    print(table(cells))
    hostile = [] if options.only else list(bad_inputs.outcomes(options.seed, 0.1 if options.level == "quick" else 1.0))
    bad = [c for c in cells if c.default and (c.verdict == WRONG or c.verdict == FAILED and c.inside)]
    for c in bad:
        print(f"{c.verdict}: {c.map}, {c.panel}, x = {c.x:g}, y = {c.y:g}, {c.method}: {c.note} {c.error:.3g}")
    for path in save(cells, seconds, options.level, options.out):
        print(path)
    print(f"{len(cells)} cells in {seconds:.0f} s")
    if hostile:
        print(bad_inputs.table(hostile))
    return 1 if bad or any(o.verdict not in GOOD for o in hostile) else 0


def parser() -> argparse.ArgumentParser:
    """The command line."""
    p = argparse.ArgumentParser("python -m verification stability", description=__doc__)
    level = p.add_mutually_exclusive_group()
    level.add_argument("--quick", dest="level", action="store_const", const="quick", help="within a minute")
    level.add_argument("--full", dest="level", action="store_const", const="full", help="every cell (default)")
    p.add_argument("--only", nargs="+", choices=list(MAPS), metavar="MAP", help=f"of {', '.join(MAPS)}")
    p.add_argument("--workers", type=int, default=1, help="processes (default: 1)")
    p.add_argument("--out", type=Path, default=Path("out/stability"), metavar="DIR")
    p.add_argument("--seed", type=int, default=1, help="of the bad inputs (default: 1)")
    p.set_defaults(level="full")
    return p


def run_maps(names: list[str], level: str, workers: int = 1) -> list[Cell]:
    """Cells of the maps named, in their order."""
    fresh = multiprocessing.get_context("spawn")  # the number of BLAS threads is read once, when NumPy is loaded
    with ProcessPoolExecutor(workers, mp_context=fresh) as pool:
        return [cell for part in pool.map(run_map, names, [level] * len(names)) for cell in part]


def run_map(name: str, level: str) -> list[Cell]:
    """Every cell of one map."""
    cells = list(importlib.import_module(MAPS[name]).cells(level))
    print(f"{name}: {len(cells)} cells", file=sys.stderr, flush=True)
    return cells
