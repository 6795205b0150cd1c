"""Is this checkout slower than an earlier commit? Eleven jobs timed in pairs; exit code 1 where one takes 1.3 times.

    python -m verification.campaigns.benchmarks.speed_guard COMMIT [--pairs 5] [--limit 1.3] [--only NAME ...]

The commit is checked out into a folder of its own. Every job runs in a fresh process with one thread, once with this
checkout and once with the other in turns, the order swapped from pair to pair; it warms up once and then counts the
processor time, which other work on the machine does not stretch. Judged is the median over the pairs of the ratio. A
job that the earlier commit cannot do is said to be new.
"""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
BEGIN = """
import time, numpy as np, lubfric
def timed(job, repeat):
    job()
    begun = time.process_time()
    for _ in range(repeat):
        job()
    print((time.process_time() - begun) / repeat)
rng = np.random.default_rng(1)
paper, flat = lubfric.load_scene("paper"), lubfric.load_scene("flat")
long = paper
if hasattr(paper.numerics, "sampling"):  # the same work as in version 0.1
    paper = paper.with_(numerics={"sampling": "patch"})
small = flat.with_(contact={"shape": (96, 96), "spacing": 2e-6}, surface={"correlation_length": 8e-6, "sq": 1e-7})
film = dict(radius=0.01, e_prime=2.2e11, viscosity=0.0358, pressure_viscosity_coefficient=2.2e-8, entrainment_speed=1.0)
"""
JOBS = {  # name: (made ready, job, repetitions)
    "generate": ("", "lubfric.generate_surface((512, 512), 1e-6, sq=1e-7, correlation_length=8e-6, seed=1)", 5),
    "resample": (
        "s = lubfric.generate_surface((512, 512), 1e-6, sq=1e-7, correlation_length=8e-6, seed=1)",
        "s.cropped((500, 480)).level().resampled(spacing=1.5e-6)",
        5,
    ),
    "contact periodic": (
        "z = lubfric.generate_surface((256, 256), 1e-6, sq=1e-7, correlation_length=8e-6, seed=1).heights",
        "lubfric.solve_contact(z.max() - z, 1e-6, 2e11, mean_pressure=2e8)",
        2,
    ),
    "contact plastic": (
        "z = lubfric.generate_surface((128, 128), 1e-6, sq=1e-7, correlation_length=8e-6, seed=1).heights",
        "lubfric.solve_contact(z.max() - z, 1e-6, 2e11, mean_pressure=3e8, hardness=2e9)",
        3,
    ),
    "film light": ("", "lubfric.solve_ehl(load_per_width=1e4, **film)", 5),
    "film heavy": ("", "lubfric.solve_ehl(load_per_width=5e5, **film)", 3),
    "friction": ("m = lubfric.prepare(paper)", "lubfric.friction(m, 0.001)", 3),
    "sweep": ("m = lubfric.prepare(paper)", "lubfric.stribeck(m, np.geomspace(1e-4, 0.05, 6))", 1),
    "strips": ("m = lubfric.prepare(long)", "lubfric.friction(m, 0.01)", 2),
    "flat": ("", "lubfric.friction(small, 0.01)", 1),
    "transient": (
        "s = small.with_(transient=lubfric.Transient(1e-3, outputs=2), motion={'entrainment_speed': 0.05})",
        "lubfric.transient(s)",
        1,
    ),
}


class Failed(Exception):
    """A job that a checkout cannot do, and why."""


def seconds(checkout: Path, name: str) -> float:
    """Return processor time of one job with the package of ``checkout``."""
    ready, job, repeat = JOBS[name]
    environment = {**os.environ, "PYTHONPATH": str(checkout), "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    code = f"{BEGIN}\n{ready}\ntimed(lambda: {job}, {repeat})\n"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=checkout, env=environment, capture_output=True, text=True, check=False
    )
    if done.returncode:
        raise Failed(f"{name} fails in {checkout}: {done.stderr.strip().splitlines()[-1]}")
    return float(done.stdout)


def ratios(earlier: Path, name: str, pairs: int) -> tuple[list[float], float]:
    """Return time now over time before of each pair, and the median time now [s]."""
    values = []
    now = []
    for pair in range(pairs):
        order = (ROOT, earlier) if pair % 2 else (earlier, ROOT)
        times = {checkout: seconds(checkout, name) for checkout in order}
        values.append(times[ROOT] / times[earlier])
        now.append(times[ROOT])
    return values, statistics.median(now)


def main() -> int:
    """Return exit code 0: no job above the limit."""
    p = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    p.add_argument("commit", help="an earlier commit, tag or branch")
    p.add_argument("--pairs", type=int, default=5, help="of runs a job (default: %(default)s)")
    p.add_argument("--limit", type=float, default=1.3, help="largest median ratio (default: %(default)s)")
    p.add_argument("--only", nargs="+", choices=list(JOBS), default=list(JOBS), metavar="NAME")
    options = p.parse_args()
    slow = 0
    with tempfile.TemporaryDirectory() as folder:
        earlier = Path(folder) / "earlier"
        git = ["git", "-C", str(ROOT), "worktree"]
        subprocess.run([*git, "add", "-q", "--detach", str(earlier), options.commit], check=True)
        try:
            for name in options.only:
                seconds(ROOT, name)  # fails where it has to be said
                try:
                    result, now = ratios(earlier, name, options.pairs)
                except Failed:
                    print(f"{name:<18}new: {options.commit} cannot do it", flush=True)
                    continue
                median = statistics.median(result)
                slow += median > options.limit
                word = "SLOWER" if median > options.limit else "ok"
                spread = f"{min(result):.2f} to {max(result):.2f}"
                print(f"{name:<18}{now:8.3f} s  x {median:5.2f}  ({spread})  {word}", flush=True)
        finally:
            subprocess.run([*git, "remove", "--force", str(earlier)], check=True)
    return 1 if slow else 0


if __name__ == "__main__":
    sys.exit(main())
