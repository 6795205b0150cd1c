"""Compare curves at chosen speeds with curves at 25 even speeds: points, processor time, largest error between speeds.

    python -m verification.campaigns.benchmarks.chosen_speeds [--strips] [--seed SEED] [--scenes COUNT] [--points
    POINTS]
        [--docs docs]

Random scenes (loads, viscosities, roughness, moduli of slip and hardness, seeds) on one patch, or, with --strips, on
strips of the surface at a sampling tolerance of 5 %. The error is the deviation of ``curve.at`` from a curve of 100
even speeds, solved to 0.2 %, and three speeds near the lift-off speed. The command prints one table.
"""

import os
from collections.abc import Callable, Iterator

from ...types import T

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(name, "1")

import argparse
import time

import numpy as np
from scipy.stats import qmc

import lubfric

from . import page

COLUMNS = ("scene", "speeds", "stated error", "largest error", "of 25 even speeds", "time over that of 25")


def scenes(count: int, *, strips: bool, sequence: int) -> Iterator[lubfric.Scene]:
    """``count`` scenes of the Sobol ``sequence`` of that number."""
    base = lubfric.load_scene("paper")
    numerics = {"sampling_tolerance": 0.05} if strips else {"sampling": "patch"}
    for seed, u in enumerate(qmc.Sobol(5, seed=sequence).random(count), start=100 * (sequence - 1) + 1):
        yield base.with_(
            bodies={"load": float(np.exp(np.interp(u[0], [0, 1], np.log([2, 20])))), "hardness": [None, 6e9][seed % 2]},
            lubricant={"viscosity": float(np.exp(np.interp(u[1], [0, 1], np.log([0.05, 1]))))},
            surface={
                "sq": float(np.exp(np.interp(u[2], [0, 1], np.log([5e-8, 3e-7])))),
                "correlation_length": float(np.interp(u[3], [0, 1], [5e-6, 9e-6])),
                "seed": seed,
            },
            motion={"slide_roll_ratio": float(np.interp(u[4], [0, 1], [0.05, 2.0]))},
            numerics=numerics,
        )


def timed(work: Callable[[], T]) -> tuple[T, float]:
    """Return (result, processor seconds)."""
    begun = time.process_time()
    return work(), time.process_time() - begun


def summary(rows: list[list[str]]) -> list[list[str]]:
    """Return the least, the median and the largest of every column but the first, in the words of the rows."""
    lines = []
    for name, *texts in list(zip(COLUMNS, *rows))[1:]:
        texts.sort(key=lambda text: float(text.rstrip("%")))
        lines.append([name, texts[0], texts[len(texts) // 2], texts[-1]])
    return lines


def main() -> None:
    """Run and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--strips", action="store_true")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scenes", type=int, default=16)
    parser.add_argument("--points", type=int, default=100)
    page.add_option(parser)
    arguments = parser.parse_args()
    print(" | ".join(COLUMNS))
    rows = []
    for number, scene in enumerate(scenes(arguments.scenes, strips=arguments.strips, sequence=arguments.seed), start=1):
        prepared = lubfric.prepare(scene)
        lubfric.stribeck(prepared, [0.1])  # whatever is imported at first is
        auto, spent = timed(lambda: lubfric.stribeck(prepared, "auto", raise_on_failure=False))
        even, usual = timed(
            lambda: lubfric.stribeck(prepared, np.geomspace(auto.speed[0], auto.speed[-1], 25), raise_on_failure=False)
        )
        speeds = np.geomspace(auto.speed[0], auto.speed[-1], arguments.points)
        if auto.lift_off:
            near = auto.lift_off * np.array([0.9, 0.98, 1.02])
            speeds = np.append(speeds, near[near < auto.speed[-1]])
        true = lubfric.stribeck(prepared, np.sort(speeds), tolerance=2e-3, raise_on_failure=False)
        good = np.isfinite(true.coefficient)
        curve_errors = [np.abs(c.at(true.speed[good]) / true.coefficient[good] - 1).max() for c in (auto, even)]
        errors = [f"{error:.2%}" for error in (auto.report.residual, *curve_errors)]
        rows.append([str(number), str(auto.speed.size), *errors, f"{spent / usual:.2f}"])
        print(" | ".join(rows[-1]), flush=True)
    page.write("chosen-speeds", ("of all scenes", "least", "median", "most"), summary(rows), (parser, arguments))


if __name__ == "__main__":
    main()
