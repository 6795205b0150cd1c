"""Dry contact against tamaas: time at equal measured error, both judged by one evaluator.

    python -m verification.campaigns.benchmarks.contact_vs_tamaas [--cells 816] [--repeats 3] [--threads 2]

An 816 x 816 periodic surface (exponential ACF, 1/e length 34 um, sigma 240 nm, spacing 2 um) at 50,
200 and 1000 MPa. Error: relative L2 distance of the pressure from a solution at tolerance 1e-10.
The repeats of all solvers are interleaved. Without tamaas (``pip install tamaas``) only lubfric is timed.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import time

import numpy as np
from scipy import fft

from lubfric import solve_contact
from lubfric.contact import half_space

SPACING = 2e-6
SIGMA = 240e-9
LENGTH = 34e-6
E_PRIME = 231e9
LOADS = (50e6, 200e6, 1000e6)


def surface(n: int, seed: int = 0) -> np.ndarray:
    """Seeded periodic Gaussian heights [m] with an exponential autocorrelation."""
    x = fft.fftfreq(n) * n * SPACING
    acf = np.exp(-np.hypot(x[:, None], x) / LENGTH)
    amplitude = np.sqrt(np.maximum(fft.fft2(acf).real, 0.0))
    z = fft.ifft2(amplitude * fft.fft2(np.random.default_rng(seed).standard_normal((n, n)))).real
    z -= z.mean()
    return z * (SIGMA / z.std())


def ours(heights, threads: int):
    """pressure(load, tolerance) by lubfric."""
    operator = half_space(heights.shape, SPACING, E_PRIME, workers=threads)

    def solve(load, tolerance):
        return solve_contact(
            -heights, SPACING, E_PRIME, mean_pressure=load, tolerance=tolerance, operator=operator
        ).pressure

    return solve


def theirs(heights, threads: int):
    """pressure(load, tolerance) by tamaas' Polonsky-Keer-Rey solver, or None where it is not installed."""
    try:
        import tamaas
    except ImportError:
        return None
    tamaas.initialize(threads)
    tamaas.set_log_level(tamaas.LogLevel.error)
    n = len(heights)
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [n * SPACING] * 2, [n, n])
    model.E = E_PRIME / 2
    model.nu = 0.0

    def solve(load, tolerance):
        model.traction[:] = 0.0
        primal = tamaas.PolonskyKeerRey.pressure
        solver = tamaas.PolonskyKeerRey(model, heights.copy(), tolerance, primal, primal)
        solver.max_iter = 20000
        solver.dump_freq = 10**9
        solver.solve(load)
        return np.array(model.traction).reshape(n, n)

    return solve


def timed(solve, load, tolerance):
    """(seconds, pressure)."""
    begun = time.perf_counter()
    pressure = solve(load, tolerance)
    return time.perf_counter() - begun, pressure


def compare(solvers: dict, load: float, tolerances: dict, repeats: int, reference) -> dict:
    """Median seconds and relative pressure error of each solver, repeats interleaved."""
    seconds: dict[str, list[float]] = {name: [] for name in solvers}
    error = {}
    for _ in range(repeats):
        for name, solve in solvers.items():
            spent, pressure = timed(solve, load, tolerances[name])
            seconds[name].append(spent)
            error[name] = np.linalg.norm(pressure - reference) / np.linalg.norm(reference)
    return {name: (statistics.median(seconds[name]), error[name]) for name in solvers}


def matched(solve, load: float, reference, target: float, tolerance: float) -> float:
    """A tolerance of ``solve``, tightened by thirds from ``tolerance``, whose measured error is at most ``target``."""
    while np.linalg.norm(solve(load, tolerance) - reference) > target * np.linalg.norm(reference) and tolerance > 1e-13:
        tolerance /= 3
    return tolerance


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=int, default=816)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--threads", type=int, default=2)
    options = parser.parse_args()
    heights = surface(options.cells)
    solvers = {"lubfric": ours(heights, options.threads)}
    opponent = theirs(heights, options.threads)
    if opponent is None:
        print("tamaas is not installed: timing lubfric alone", file=sys.stderr)
    else:
        solvers["tamaas"] = opponent
    print(f"{options.cells} x {options.cells}, {options.threads} threads, medians of {options.repeats}")
    for load in LOADS:
        reference = solvers["lubfric"](load, 1e-10)
        tolerances = {"lubfric": 1e-6, "tamaas": 1e-6}
        if opponent is not None:  # tamaas at 1e-6 sets the error that lubfric has to reach
            theirs_error = float(np.linalg.norm(opponent(load, 1e-6) - reference) / np.linalg.norm(reference))
            tolerances["lubfric"] = matched(solvers["lubfric"], load, reference, theirs_error, 1e-6)
        table = compare(solvers, load, tolerances, options.repeats, reference)
        for name, (seconds, error) in table.items():
            print(
                f"{load / 1e6:6.0f} MPa  {name:8s} tolerance {tolerances[name]:.1e}  {seconds:8.3f} s  "
                f"pressure error {error:.1e}",
                end="",
            )
            print(f"  {seconds / table['lubfric'][0]:6.1f} x lubfric" if name != "lubfric" else "", flush=True)


if __name__ == "__main__":
    main()
