"""Cost growth: time and peak memory against the number of unknowns, with fitted exponents."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..check import Check
from .data import point

ROOT = Path(__file__).parents[2]
START = "import json, resource, sys, time\nimport numpy as np\n"
REPORT = (
    "\nprint(json.dumps(dict(seconds=times, work=work, size=size, memory=1024 * (resource.getrusage("
    "resource.RUSAGE_SELF).ru_maxrss - before))))"
)
BEFORE = "before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss\n"
CONTACT = (
    START
    + """
from lubfric import solve_contact
from lubfric.contact import half_space
from verification.charts.growth import rough
n = int(sys.argv[1])
z = rough(n)
solve_contact(-z[:32, :32], 2e-6, 231e9, mean_pressure=2e8)
"""
    + BEFORE
    + """
operator = half_space(z.shape, 2e-6, 231e9)
times = []
for _ in range(3 if n <= 1024 else 1):
    begun = time.process_time()
    r = solve_contact(-z, 2e-6, 231e9, mean_pressure=2e8, operator=operator)
    times.append(time.process_time() - begun)
work, size = r.report.evaluations, n * n"""
    + REPORT
)
FILM = (
    START
    + """
from lubfric import solve_ehl, solve_differential_deflection
from verification.cases import case_of
case, nodes = case_of(20, 5), int(sys.argv[1])
solve_differential_deflection(**case)
"""
    + BEFORE
    + """
times = []
for _ in range(5):
    begun = time.process_time()
    r = solve_differential_deflection(**case, nodes=nodes, tolerance=0.1, raise_on_failure=False)
    times.append(time.process_time() - begun)
work, size = r.report.iterations, nodes"""
    + REPORT
)
NEWTON = (
    START
    + """
from lubfric.film.grid import make_grid
from lubfric.film.newton import newton
from lubfric.film.ehl import problem_nodes
from lubfric.film.start import rupture_guess, warm_start
from verification.charts.growth import newton_problem
problem, state = newton_problem()


def solve(n):
    grid = make_grid(problem_nodes(problem, n, rupture_guess(problem)))
    return newton(grid, problem, *warm_start(grid, problem, state), 1e-6, 60)


solve(48)
"""
    + BEFORE
    + """
n = int(sys.argv[1])
times = []
for _ in range(5 if n < 1600 else 1):
    begun = time.process_time()
    solution = solve(n)
    times.append(time.process_time() - begun)
work, size = len(solution.history) - 1, n"""
    + REPORT
)
SWEEP = (
    START
    + """
import lubfric
from lubfric.sharing.prepared import prepare
model = prepare(lubfric.load_scene("paper").with_(
    numerics={"sampling": "patch"}, contact={"shape": (50, 50), "spacing": 1.8e-6}
))
lubfric.stribeck(model, [0.1])
"""
    + BEFORE
    + """
n = int(sys.argv[1])
begun = time.process_time()
r = lubfric.stribeck(model, np.geomspace(1e-4, 1.0, n))
times = [time.process_time() - begun]
work, size = n, n"""
    + REPORT
)


def rough(n: int) -> np.ndarray:
    """Heights [m] of the same statistics at any size, from noise that is cheap enough for 4096²."""
    k = np.hypot(np.fft.fftfreq(n)[:, None], np.fft.rfftfreq(n)) * 2 * np.pi * 17
    z = np.fft.irfft2(np.fft.rfft2(np.random.default_rng(0).standard_normal((n, n))) * (1 + k * k) ** -0.75, s=(n, n))
    return (z - z.mean()) * (240e-9 / z.std())


def newton_problem():
    """A contact (M = 20, L = 5) and a solution to start every grid from."""
    from lubfric import solve_ehl
    from lubfric.film import LineContact, Problem
    from lubfric.oil import Lubricant

    from ..cases import case_of

    case = case_of(20, 5)
    oil = Lubricant(case["viscosity"], case["pressure_viscosity_coefficient"], "roelands", "constant")
    problem = Problem(
        LineContact(case["load_per_width"], case["radius"], case["e_prime"], case["entrainment_speed"], oil)
    )
    return problem, solve_ehl(**case, tolerance=1e-2).state


def points(level: str) -> Iterator[Check]:
    """Each size is solved in a process of its own, so that the peak memory is that of this size alone."""
    quick = level == "quick"
    for label, code, sizes in (
        ("contact", CONTACT, (128, 256) if quick else (128, 256, 512, 1024, 2048, 4096)),
        (
            "EHL, Newton, one grid, warm",
            NEWTON,
            (48, 96) if quick else (48, 96, 192, 384, 768, 1536, 3072, 6144),
        ),
        (
            "EHL, differential deflection",
            FILM,
            (129, 257) if quick else (129, 257, 513, 1025, 2049, 4097, 8193),
        ),
        ("sweep, 50² contact", SWEEP, (1, 5) if quick else (1, 3, 10, 30, 100, 300, 1000)),
    ):
        for size in sizes:
            found = measured(code, size)
            seconds = np.quantile(found["seconds"], (0.5, 0.25, 0.75)).tolist()
            at = {"size": found["size"], "memory": max(found["memory"], 1), "work": found["work"]}
            yield replace(point(label, label, str(size), seconds[0], seconds, **at), unit="s", source="the clock")


def measured(code: str, size: int) -> dict:
    """Run ``code`` with the size as its argument."""
    done = subprocess.run(
        [sys.executable, "-c", code, str(size)], capture_output=True, text=True, cwd=ROOT, check=False
    )
    if done.returncode:
        raise RuntimeError(done.stderr[-2000:])
    return json.loads(done.stdout.splitlines()[-1])


def exponent(points: list[Check], quantity: str) -> float:
    """Least-squares slope of the logarithm of a quantity over that of the size, for the larger half of the sizes.

    ``quantity`` is "memory", "work" or "seconds".
    """
    pairs = sorted((p.number("size"), p.duration if quantity == "seconds" else p.number(quantity)) for p in points)
    pairs = [(size, value) for size, value in pairs if value > 0]
    pairs = pairs[len(pairs) // 2 - 1 :] if len(pairs) > 3 else pairs
    if len(pairs) < 2:
        return float("nan")
    size, value = np.log(np.array(pairs)).T
    return float(np.polyfit(size, value, 1)[0])
