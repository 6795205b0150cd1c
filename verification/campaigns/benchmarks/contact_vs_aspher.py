"""Dry contact against aspher and tamaas: processor time at one measured pressure error.

    python -m verification.campaigns.benchmarks.contact_vs_aspher [--surfaces exponential gaussian self-affine] [--cells
    816 2048]
        [--loads 50 200 1000] [--opponents aspher] [--repeats 3] [--target 1e-5] [--bound 0] [--kept FILE]
        [--json FILE] [--rows FILE ...] [--docs docs]

Periodic surfaces (exponential or Gaussian ACF, 1/e length 34 um, or self-affine with H = 0.8; sigma 240 nm, spacing 2
um). Error: relative L2 distance of the pressure from a solution of lubfric at tolerance 1e-10, which tamaas at 1e-12
confirms. For each solver the loosest tolerance of a ladder (two a decade) whose measured error is at most the target;
repeats interleaved on one thread each, medians of processor seconds with quartiles; a solve of more than a minute is
timed once. ``--kept``: a file that keeps those tolerances for a later run; ``--rows``: nothing is run, the table is
made of what earlier runs wrote by ``--json``. ``--opponents tamaas`` solves to the target by tamaas too, which takes
tens of minutes on the larger grids; with ``--bound`` it is stopped after so many times the time of lubfric instead (0:
left out) and its error reported: above the target, it is slower by more than that. Needs ``pip install
"lubfric[benchmark]"`` for the opponents; times lubfric alone without.
"""

from __future__ import annotations

import argparse
import json
import os
import time
from pathlib import Path

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(_name, "1")
os.environ.setdefault("OMP_WAIT_POLICY", "passive")

import numpy as np

from ...types import PlainRow
from ..opponents import CONTACT, Solver, tamaas_solver
from . import page
from .rough import E_PRIME, surface

LADDER = [10 ** (-k / 2) for k in range(4, 25)]
LONG = 60.0  # seconds: not repeated
SPACING = 2e-6  # m, of the cells
LENGTH = 34e-6  # m, at which the autocorrelation is 1/e
SIGMA = 240e-9  # m, Sq
FIRST = {"lubfric": 1e-3, "aspher": 1e-2, "tamaas": 1e-4}  # tolerances that the search begins with


# name, tolerance, error, and median, lower and upper quartile of the processor seconds
MeasuredRow = tuple[str, float, float, float, float, float]


def loosest(
    solve: Solver, load: float, reference: np.ndarray, target: float, first: float
) -> tuple[float, float, float]:
    """Return (tolerance, error, seconds): loosest of the ladder, from ``first`` on, that meets the target, or the best
    of it."""
    closest = (np.nan, np.inf, np.nan)
    for tolerance in LADDER:
        if tolerance > first * 1.01:
            continue
        error, seconds = measured(solve, load, tolerance, reference)
        if error < closest[1]:
            closest = (tolerance, error, seconds)
        if error <= target or tolerance < 1e-11:
            return closest
    return closest


def measured(solve: Solver, load: float, tolerance: float, reference: np.ndarray) -> tuple[float, float]:
    """Return (error, processor seconds) of one solve."""
    begun = time.process_time()
    pressure = solve(load, tolerance)
    seconds = time.process_time() - begun
    return float(np.linalg.norm(pressure - reference) / np.linalg.norm(reference)), seconds


def compare(
    solvers: dict[str, Solver], load: float, reference: np.ndarray, target: float, repeats: int, first: dict[str, float]
) -> list[MeasuredRow]:
    """Return rows (name, tolerance, error, median and quartiles of seconds), repeats interleaved; ``first``: the
    tolerances that the search begins with."""
    results = {name: loosest(solve, load, reference, target, first[name]) for name, solve in solvers.items()}
    seconds = {name: [f[2]] for name, f in results.items()}
    for _ in range(repeats):
        for name, solve in solvers.items():
            if results[name][2] < LONG:
                seconds[name].append(measured(solve, load, results[name][0], reference)[1])
    return [(name, *results[name][:2], *np.quantile(seconds[name][-repeats:], (0.5, 0.25, 0.75))) for name in solvers]


def stopped(heights: np.ndarray, load: float, reference: np.ndarray, seconds: float) -> list[MeasuredRow]:
    """Return row of tamaas after about ``seconds``: its iterations are counted from the time of twenty."""
    few = tamaas_solver(heights, SPACING, E_PRIME, max_iterations=20)
    if few is None:
        return []
    each = measured(few, load, 1e-14, reference)[1] / 20
    solver = tamaas_solver(heights, SPACING, E_PRIME, max_iterations=int(seconds / each))
    assert solver is not None  # as before
    error, spent = measured(solver, load, 1e-14, reference)
    return [("tamaas", np.nan, error, spent, spent, spent)]


def of_page(rows: list[PlainRow]) -> tuple[list[str], list[list[str]]]:
    """Return the table of the page: a row for each surface and grid, a column for each load."""
    loads = sorted({r["load"] for r in rows})
    lines = []
    for surface_and_cells in dict.fromkeys((r["surface"], r["cells"]) for r in rows):
        lines.append(["{}, {}²".format(*surface_and_cells)])
        for load in loads:
            here = [r for r in rows if (r["surface"], r["cells"], r["load"]) == (*surface_and_cells, load)]
            seconds = {r["name"]: r["median"] for r in here}
            ratio = f", {seconds['aspher'] / seconds['lubfric']:.1f}" if "aspher" in seconds else ""
            lines[-1].append(f"{seconds['lubfric']:.3g} s{ratio}" if seconds else "")
    return ["surface, grid", *(f"{load:g} MPa" for load in loads)], lines


def case_rows(
    kind: str,
    cells: int,
    load: float,
    solvers: dict[str, Solver],
    heights: np.ndarray,
    options: argparse.Namespace,
    kept: dict[str, dict[str, float]],
) -> list[PlainRow]:
    """Return the rows of one case, printed as they come."""
    reference = solvers["lubfric"](1e6 * load, 1e-10)
    label = f"{kind} {cells} {load:g}"
    table = compare(solvers, 1e6 * load, reference, options.target, options.repeats, FIRST | kept.get(label, {}))
    kept[label] = {name: tolerance for name, tolerance, *_ in table if name != "lubfric"}
    if options.bound:
        table += stopped(heights, 1e6 * load, reference, options.bound * table[0][3])
    rows = []
    for name, tolerance, error, median, low, high in table:
        print(
            f"{kind:12s} {cells:5d}²  {load:5g} MPa  {name:8s} tolerance {tolerance:7.1e}  error {error:7.1e}  "
            f"{median:8.3f} s [{low:.3f}, {high:.3f}]  {median / table[0][3]:6.2f} x lubfric",
            flush=True,
        )
        row = {"surface": kind, "cells": cells, "load": load, "name": name, "error": error}
        rows.append(row | {"tolerance": tolerance or None, "median": median, "low": low, "high": high})
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--surfaces", nargs="+", default=["exponential", "gaussian", "self-affine"])
    parser.add_argument("--cells", type=int, nargs="+", default=[816, 2048])
    parser.add_argument("--loads", type=float, nargs="+", default=[50, 200, 1000], help="MPa")
    parser.add_argument("--opponents", nargs="+", choices=("aspher", "tamaas"), default=["aspher"])
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--target", type=float, default=1e-5)
    parser.add_argument("--bound", type=float, default=0.0, help="times lubfric's time, for tamaas (0: without tamaas)")
    parser.add_argument("--kept", type=Path)
    parser.add_argument("--json", type=Path)
    parser.add_argument("--rows", type=Path, nargs="+", default=[])
    page.add_option(parser)
    options = parser.parse_args()
    if options.rows:
        rows = [row for path in options.rows for row in json.loads(path.read_text())]
        page.write("contact-aspher", *of_page(rows), (parser, options))
    else:
        run(parser, options)


def run(parser: argparse.ArgumentParser, options: argparse.Namespace) -> None:
    """Every case, its rows written as they come."""
    rows: list[PlainRow] = []
    kept = json.loads(options.kept.read_text()) if options.kept and options.kept.exists() else {}
    for cells in options.cells:
        for kind in options.surfaces:
            heights = surface(kind, (cells, cells), SPACING, LENGTH, SIGMA)
            made = {name: CONTACT[name](heights, SPACING, E_PRIME) for name in ("lubfric", *options.opponents)}
            solvers = {name: solve for name, solve in made.items() if solve is not None}
            for load in options.loads:
                rows += case_rows(kind, cells, load, solvers, heights, options, kept)
                for path, text in ((options.kept, kept), (options.json, rows)):
                    if path:
                        path.write_text(json.dumps(text, indent=1))
                page.write("contact-aspher", *of_page(rows), (parser, options))


if __name__ == "__main__":
    main()
