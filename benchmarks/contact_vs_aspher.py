"""Dry contact against aspher and tamaas: time at one measured pressure error.

    OMP_NUM_THREADS=2 python benchmarks/contact_vs_aspher.py [--cells 816 2048] [--loads 50 200 1000] [--repeats 5]
        [--target 1e-5] [--bound 12]

A periodic surface (exponential ACF, 1/e length 34 um, sigma 240 nm, spacing 2 um). Error: relative L2 distance of the
pressure from a solution of lubfric at tolerance 1e-10, which tamaas at 1e-12 confirms. For each solver the loosest
tolerance of a decade ladder (two a decade) whose measured error is at most the target; repeats interleaved, medians
with quartiles; a solve of more than a minute is timed once. tamaas, whose solves take tens of minutes, is stopped after
``--bound`` times the time of lubfric and its error told: above the target, it is slower by more than that. Needs ``pip
install "lubfric[benchmark]"`` for the opponents; times lubfric alone without.
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
LONG = 60.0  # seconds: not repeated


def loosest(solve, load, reference, target, first):
    """(tolerance, error, seconds): loosest of the ladder, from ``first`` on, that meets the target, or the best of
    it."""
    best = (np.nan, np.inf, np.nan)
    for tolerance in LADDER:
        if tolerance > first * 1.01:
            continue
        error, seconds = measured(solve, load, tolerance, reference)
        if error < best[1]:
            best = (tolerance, error, seconds)
        if error <= target or tolerance < 1e-11:
            return best
    return best


def measured(solve, load, tolerance, reference):
    """(error, seconds) of one solve."""
    begun = time.perf_counter()
    pressure = solve(load, tolerance)
    seconds = time.perf_counter() - begun
    return float(np.linalg.norm(pressure - reference) / np.linalg.norm(reference)), seconds


def compare(solvers, load, reference, target, repeats, first):
    """Rows (name, tolerance, error, quartiles of seconds), repeats interleaved; ``first``, the tolerance that a solver
    begins with, is left one step looser than the one it found."""
    found = {name: loosest(solve, load, reference, target, first[name]) for name, solve in solvers.items()}
    seconds = {name: [f[2]] for name, f in found.items()}
    for _ in range(repeats):
        for name, solve in solvers.items():
            if found[name][2] < LONG:
                seconds[name].append(measured(solve, load, found[name][0], reference)[1])
    for name, f in found.items():
        first[name] = 10**0.5 * f[0]
    return [(name, *found[name][:2], *np.quantile(seconds[name][-repeats:], (0.5, 0.25, 0.75))) for name in solvers]


def stopped(heights, load, reference, seconds):
    """Row of tamaas after about ``seconds``: its iterations are counted from the time of twenty."""
    few = tamaas_solver(heights, SPACING, E_PRIME, max_iterations=20)
    if few is None:
        return []
    each = measured(few, load, 1e-14, reference)[1] / 20
    error, spent = measured(
        tamaas_solver(heights, SPACING, E_PRIME, max_iterations=int(seconds / each)), load, 1e-14, reference
    )
    return [("tamaas", np.nan, error, spent, spent, spent)]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=int, nargs="+", default=[816, 2048])
    parser.add_argument("--loads", type=float, nargs="+", default=[50, 200, 1000], help="MPa")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--target", type=float, default=1e-5)
    parser.add_argument("--bound", type=float, default=12.0, help="times lubfric's time, for tamaas (0: left out)")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    rows, ours, first = [], float("nan"), {}
    for cells in options.cells:
        heights = surface(cells)
        made = {"lubfric": lubfric_solver, "aspher": aspher_solver}
        solvers = {k: f(heights, SPACING, E_PRIME, options.threads) for k, f in made.items()}
        solvers = {k: s for k, s in solvers.items() if s is not None}
        for load in options.loads:
            reference = solvers["lubfric"](1e6 * load, 1e-10)
            begins = first.setdefault(load, {"lubfric": 1e-3, "aspher": 1e-2})
            table = compare(solvers, 1e6 * load, reference, options.target, options.repeats, begins)
            if options.bound:
                table += stopped(heights, 1e6 * load, reference, options.bound * table[0][3])
            for name, tolerance, error, median, low, high in table:
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
                        tolerance=tolerance if tolerance > 0 else None,
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
