"""Dry contact against aspher and tamaas: time at one measured pressure error.

    OMP_NUM_THREADS=2 python benchmarks/contact_vs_aspher.py [--cells 816 2048] [--loads 50 200 1000] [--repeats 5] [--target 1e-5]

A periodic surface (exponential ACF, 1/e length 34 um, sigma 240 nm, spacing 2 um). Error: relative L2 distance of the
pressure from a solution of lubfric at tolerance 1e-10, which tamaas at 1e-12 confirms. For each solver the loosest
tolerance of a decade ladder (two a decade) whose measured error is at most the target; repeats interleaved, medians
with quartiles. Needs ``pip install "lubfric[benchmark]"`` for the opponents; times lubfric alone without.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "2")
os.environ.setdefault("OMP_WAIT_POLICY", "passive")
sys.path.insert(0, str(Path(__file__).parents[1]))

import numpy as np

from benchmarks.contact_vs_tamaas import E_PRIME, SPACING, surface
from verification.opponents import aspher_solver, lubfric_solver, tamaas_solver

LADDER = [10 ** (-k / 2) for k in range(4, 25)]


def loosest(solve, load, reference, target, first):
    """(tolerance, error): loosest of the ladder, from ``first`` on, that meets the target, or the best of it."""
    best = (np.nan, np.inf)
    for tolerance in LADDER:
        if tolerance > first * 1.01:
            continue
        error = np.linalg.norm(solve(load, tolerance) - reference) / np.linalg.norm(reference)
        if error < best[1]:
            best = (tolerance, error)
        if error <= target or tolerance < 1e-11:
            return best
    return best


def compare(solvers, load, reference, target, repeats):
    """Rows (name, tolerance, error, quartiles of seconds), repeats interleaved."""
    first = {"lubfric": 1e-4, "aspher": 1e-3, "tamaas": 1e-4}
    found = {name: loosest(solve, load, reference, target, first[name]) for name, solve in solvers.items()}
    seconds = {name: [] for name in solvers}
    for repeat in range(repeats):
        for name, solve in solvers.items():
            if name == "tamaas" and repeat >= max(1, repeats // 3):
                continue  # minutes each; its spread is small against its distance
            begun = time.perf_counter()
            solve(load, found[name][0])
            seconds[name].append(time.perf_counter() - begun)
    return [(name, *found[name], *np.quantile(seconds[name], (0.5, 0.25, 0.75))) for name in solvers]


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--cells", type=int, nargs="+", default=[816, 2048])
    parser.add_argument("--loads", type=float, nargs="+", default=[50, 200, 1000], help="MPa")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--target", type=float, default=1e-5)
    parser.add_argument("--without", nargs="*", default=[], help="opponents to leave out")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    rows, ours = [], float("nan")
    for cells in options.cells:
        heights = surface(cells)
        made = {"lubfric": lubfric_solver, "aspher": aspher_solver, "tamaas": tamaas_solver}
        solvers = {
            k: f(heights, SPACING, E_PRIME, options.threads)
            for k, f in made.items()
            if k not in options.without
        }
        solvers = {k: s for k, s in solvers.items() if s is not None}
        for load in options.loads:
            reference = solvers["lubfric"](1e6 * load, 1e-10)
            for name, tolerance, error, median, low, high in compare(
                solvers, 1e6 * load, reference, options.target, options.repeats
            ):
                ours = median if name == "lubfric" else ours  # the first of every table
                print(
                    f"{cells:5d}²  {load:5g} MPa  {name:8s} tolerance {tolerance:7.1e}  error {error:7.1e}  "
                    f"{median:8.3f} s [{low:.3f}, {high:.3f}]  {median / ours:6.2f} x lubfric",
                    flush=True,
                )
                rows.append(
                    dict(
                        cells=cells,
                        load=load,
                        name=name,
                        tolerance=tolerance,
                        error=error,
                        median=median,
                        low=low,
                        high=high,
                    )
                )
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1))


if __name__ == "__main__":
    main()
