"""Two versions of the library on the same dry contacts: CPU time at one measured pressure error.

    OMP_NUM_THREADS=1 python benchmarks/contact_before_after.py BEFORE [AFTER] [--only 816 line] [--repeats 5]
        [--target 1e-5] [--docs docs]

BEFORE and AFTER (default: the tree of this file) are folders that hold a ``lubfric`` package. Each is imported in a
process of its own; solves of the two are interleaved, one thread each. Error: relative L2 distance of the pressure
from a solution of BEFORE at tolerance 1e-10. For each version the loosest tolerance of a ladder (four a decade) whose
measured error is at most the target is timed: medians of processor seconds, and their ratio.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import os
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

import numpy as np

E_PRIME = 231e9
LADDER = [10 ** (-k / 4) for k in range(12, 37)]
LINE_LOAD, RADIUS = 917.0, 2e-3  # N/m, m
KEPT = {}  # one process keeps its problems, operators and reference pressures


def surface(kind: str, shape, spacing: float, length: float, sigma: float, seed: int = 0) -> np.ndarray:
    """Seeded periodic Gaussian heights [m]: exponential or Gaussian autocorrelation, or self-affine with H = 0.8."""
    kx, ky = (2 * np.pi * np.fft.fftfreq(n, spacing) for n in shape)
    k = np.hypot(kx[:, None], ky[: shape[1] // 2 + 1])
    power = {
        "exponential": (1 + (k * length) ** 2) ** -1.5,
        "gaussian": np.exp(-((k * length) ** 2) / 4),
        "self-affine": np.maximum(k * length, 2 * np.pi) ** -3.6,
    }[kind]
    white = np.random.default_rng(seed).standard_normal(shape)
    z = np.fft.irfft2(np.sqrt(power) * np.fft.rfft2(white), s=shape)
    z -= z.mean()
    return z * (sigma / z.std())


def cases() -> dict:
    """{name: (surface arguments, boundary, mean pressure [Pa], warm, hardness [Pa])}"""
    found = {}
    for n in (816, 2048, 256):
        for kind in ("exponential", "gaussian", "self-affine"):
            for load in (50, 200, 1000):
                found[f"{n} {kind} {load} MPa"] = (kind, (n, n), 2e-6, 34e-6, 240e-9), "periodic", load * 1e6, 0, None
    found["plastic 816 exponential 200 MPa"] = (*found["816 exponential 200 MPa"][:4], 3e9)
    found["free 400 exponential 50 MPa"] = ("exponential", (400, 400), 2e-6, 34e-6, 240e-9), "free", 50e6, 0, None
    for name, shape, step in (
        ("line", (200, 13312), 0.45e-6),
        ("coarse line", (50, 3200), 1.8e-6),
        ("patch", (200, 200), 0.45e-6),
    ):
        pressure = LINE_LOAD / (shape[0] * step)
        for kind in ("gaussian", "exponential"):
            for warm in (0, 1, 2):
                label = ("cold", "warm", "extrapolated")[warm]
                found[f"{name} {kind} {label}"] = (
                    (kind, shape, step, 8e-6, 100e-9),
                    ("free", "periodic"),
                    pressure,
                    warm,
                    None,
                )
    return found


def begin(tree: str) -> None:
    """Import ``lubfric`` from ``tree`` in this process."""
    sys.path.insert(0, tree)
    import lubfric

    assert Path(lubfric.__file__).resolve().is_relative_to(Path(tree).resolve()), lubfric.__file__


def _prepared(name: str):
    from lubfric import solve_contact
    from lubfric.contact import half_space

    made, boundary, pressure, warm, hardness = cases()[name]
    if made not in KEPT:
        KEPT.clear()
        gap0 = -surface(*made)
        nx, step = made[1][0], made[2]
        if boundary == ("free", "periodic"):
            x = (np.arange(nx) - 0.5 * (nx - 1)) * step
            gap0 += (x**2 / (2 * RADIUS))[:, None]
        KEPT[made] = gap0, half_space(gap0.shape, step, E_PRIME, boundary)
    gap0, operator = KEPT[made]
    options = {"operator": operator, "boundary": boundary, "hardness": hardness, "raise_on_failure": False}

    def solve(share, tolerance, start=None):
        return solve_contact(
            gap0, made[2], E_PRIME, mean_pressure=share * pressure, tolerance=tolerance, start=start, **options
        )

    if warm and name not in KEPT:
        near, far = (solve(share, 1e-5).pressure for share in (0.95, 0.9))
        KEPT[name] = near if warm == 1 else np.maximum(2 * near - far, 0.0)
    return lambda tolerance: solve(1.0, tolerance, KEPT.get(name))


def reference(name: str, file: str) -> None:
    """Save the pressure of a far tighter solve."""
    np.save(file, _prepared(name)(1e-10).pressure)


def measure(name: str, tolerance: float, file: str) -> tuple[float, float, int, float]:
    """Error, processor seconds, iterations and convolutions of one solve."""
    solve = _prepared(name)
    begun = time.process_time()
    result = solve(tolerance)
    seconds = time.process_time() - begun
    exact = np.load(file, mmap_mode="r")
    error = np.linalg.norm(result.pressure - exact) / np.linalg.norm(exact)
    return float(error), seconds, result.report.iterations, float(result.report.evaluations)


def loosest(pool, name, target, file):
    """Loosest tolerance of the ladder that meets the target, by bisection: errors fall with the tolerance."""
    low, high = 0, len(LADDER) - 1
    while low < high:
        middle = (low + high) // 2
        error = pool.submit(measure, name, LADDER[middle], file).result()[0]
        low, high = (low, middle) if error <= target else (middle + 1, high)
    return LADDER[low]


COLUMNS = ("case", "before: CPU s, convolutions", "after: CPU s, convolutions", "ratio")


def cells_of(rows) -> list[list[str]]:
    """The rows of the page."""
    lines = []
    for row in rows:
        (a, b), ((_, c), (_, d)) = row["seconds"], row["work"]
        lines.append([row["case"], f"{a:.3g}, {c:g}", f"{b:.3g}, {d:g}", f"{a / b:.1f}"])
    return lines


def main() -> None:
    """Compare; what writes the page is imported here, as the processes import each a library of their own."""
    sys.path.insert(0, str(Path(__file__).parents[1]))
    from benchmarks import page

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before")
    parser.add_argument("after", nargs="?", default=str(Path(__file__).parents[1]))
    parser.add_argument("--only", nargs="+", default=["816", "line", "patch"], help="cases whose name begins so")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--target", type=float, default=1e-5)
    parser.add_argument("--work", type=Path, default=Path("out/before_after"), help="folder for reference pressures")
    parser.add_argument("--json", type=Path)
    page.add_option(parser)
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    fresh, rows = multiprocessing.get_context("spawn"), []
    trees = [str(Path(t).resolve()) for t in (options.before, options.after)]
    pools = [ProcessPoolExecutor(1, fresh, initializer=begin, initargs=(tree,)) for tree in trees]
    for name in cases():
        if not name.startswith(tuple(options.only)):
            continue
        file = str(options.work / f"{name}.npy".replace(" ", "_"))
        if not os.path.exists(file):
            pools[0].submit(reference, name, file).result()
        tolerances = [loosest(pool, name, options.target, file) for pool in pools]
        found = [[], []]
        for _ in range(options.repeats):
            for pool, tolerance, kept in zip(pools, tolerances, found):
                kept.append(pool.submit(measure, name, tolerance, file).result())
        medians = [float(np.median([row[1] for row in kept])) for kept in found]
        text = "  ".join(
            f"{s:7.3f} s ({kept[-1][2]:3d} it, {kept[-1][3]:5.1f} conv, tol {t:.0e}, err {kept[-1][0]:.0e})"
            for s, kept, t in zip(medians, found, tolerances)
        )
        print(f"{name:36s} {text}  ratio {medians[0] / medians[1]:5.2f}", flush=True)
        work = [(kept[-1][2], round(kept[-1][3], 1)) for kept in found]
        rows.append(
            {
                "work": work,
                "case": name,
                "seconds": medians,
                "tolerances": tolerances,
                "errors": [k[-1][0] for k in found],
            }
        )
    page.write("contact-before", COLUMNS, cells_of(rows), (parser, options))
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1))


if __name__ == "__main__":
    main()
