"""Times of the main job: import, one film, the paper's scene. Medians; run on a quiet machine.

python -m verification.campaigns.benchmarks.main_job
"""

import statistics
import subprocess
import sys
import time
from collections.abc import Callable

import numpy as np

import lubfric
from lubfric.models import prepare

from ...types import Keywords

PAPER: Keywords = dict(
    load_per_width=5.5 / 6e-3, radius=2e-3, e_prime=231e9, viscosity=0.36, pressure_viscosity_coefficient=25e-9
)


def median(work: Callable[[], object], repeats: int) -> float:
    work()
    times = []
    for _ in range(repeats):
        begun = time.perf_counter()
        work()
        times.append(time.perf_counter() - begun)
    return statistics.median(times)


def whole_process(code: str) -> float:
    return median(lambda: subprocess.run([sys.executable, "-c", code], check=True), 7)


def main() -> None:
    numpy = whole_process("import numpy")
    every_name = "import lubfric; [getattr(lubfric, n) for n in lubfric.__all__]"
    print(f"import lubfric above numpy        {1e3 * (whole_process('import lubfric, numpy') - numpy):8.1f} ms")
    print(f"every public name above numpy     {1e3 * (whole_process(every_name) - numpy):8.1f} ms")
    for speed in (1e-4, 1e-2, 1.0):
        film = lubfric.solve_ehl(entrainment_speed=speed, **PAPER)
        near = PAPER | {"load_per_width": 0.9 * PAPER["load_per_width"]}
        cold = median(lambda: lubfric.solve_ehl(entrainment_speed=speed, **PAPER), 21)
        warm = median(lambda: lubfric.solve_ehl(entrainment_speed=speed, start=film, **near), 21)
        print(f"EHL at 0.3 %, U = {speed:6g} m/s       {1e3 * cold:8.2f} ms cold, {1e3 * warm:.2f} ms warm")
    scene = lubfric.load_scene("paper")
    speeds = np.geomspace(1e-4, 1.0, 20)
    print(f"paper scene, preparation          {1e3 * median(lambda: prepare(scene), 5):8.1f} ms")
    for tolerance in (1e-2, 5e-3, 1e-3):
        tight = scene.with_(numerics={"tolerance": tolerance})
        taken = median(lambda: lubfric.stribeck(tight, speeds), 5)
        print(f"paper scene, 20 speeds, {100 * tolerance:4.1f} %    {taken:8.3f} s")


if __name__ == "__main__":
    main()
