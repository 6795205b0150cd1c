"""Cost growth: time and peak memory against the number of unknowns, with fitted exponents."""

from __future__ import annotations

import resource
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np

import lubfric
from lubfric.contact.operator import half_space

from ..cases import case_of
from ..check import Check
from ..parent import end_with_parent
from .measure import point, quartiles

JOBS = {
    "contact": (128, 256, 512, 1024, 2048, 4096),
    "EHL, Newton": (10, 30, 100, 300, 1000, 3000, 10000),  # over 1: the tolerance asked
    "EHL, differential deflection": (129, 257, 513, 1025, 2049, 4097, 8193),
    "sweep, 50² contact": (1, 3, 10, 30, 100, 300, 1000),
}


def cases(quick: bool) -> dict[str, tuple[str, int]]:
    """Sizes of every job."""
    return {f"{job}, {size}": (job, size) for job, sizes in JOBS.items() for size in sizes[: 2 if quick else None]}


def measured(case: tuple[str, int]) -> list[dict]:
    """One size, solved in a process of its own, so that the peak memory is that of this size alone."""
    with ProcessPoolExecutor(1, mp_context=get_context("spawn"), initializer=end_with_parent) as pool:
        seconds, memory, work, size = pool.submit(alone, case).result()
    at = {"size": size, "memory": max(memory, 1), "work": work}
    return [point(case[0], case[0], str(case[1]), seconds[0], seconds, **at) | {"unit": "s", "source": "the clock"}]


def alone(case: tuple[str, int]) -> tuple:
    """(quartiles of processor seconds, bytes above the start, work, size), after a first small solve."""
    job, size = case
    make: dict[str, Callable] = {"contact": contact, "EHL, Newton": newton, "sweep, 50² contact": sweep}
    solve, repeats = make.get(job, differential)(size)
    before, times = _peak(), []
    for _ in range(repeats):
        begun = time.process_time()
        work, unknowns = solve()
        times.append(time.process_time() - begun)
    return quartiles(times), _peak() - before, work, unknowns


def _peak() -> int:
    return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def contact(n: int):
    """A dry contact on n x n cells."""
    k = np.hypot(np.fft.fftfreq(n)[:, None], np.fft.rfftfreq(n)) * 2 * np.pi * 17
    z = np.fft.irfft2(np.fft.rfft2(np.random.default_rng(0).standard_normal((n, n))) * (1 + k * k) ** -0.75, s=(n, n))
    z = (z - z.mean()) * (240e-9 / z.std())
    lubfric.solve_contact(-z[:32, :32], 2e-6, 231e9, mean_pressure=2e8)

    def solve():
        operator = half_space(z.shape, 2e-6, 231e9)
        result = lubfric.solve_contact(-z, 2e-6, 231e9, mean_pressure=2e8, operator=operator)
        return result.report.evaluations, n * n

    return solve, 3 if n <= 1024 else 1


def newton(one_over: int):
    """A film at M = 20 and L = 5 by the default, to a tolerance of 1/``one_over``."""
    case = case_of(20, 5)
    lubfric.solve_ehl(**case)

    def solve():
        film = lubfric.solve_ehl(**case, tolerance=1 / one_over)
        return film.report.iterations, film.x.size

    return solve, 5


def differential(nodes: int):
    """The same film by differential deflection."""
    case = case_of(20, 5)
    lubfric.solve_differential_deflection(**case)

    def solve():
        film = lubfric.solve_differential_deflection(**case, nodes=nodes, tolerance=0.1, raise_on_failure=False)
        return film.report.iterations, nodes

    return solve, 5


def sweep(count: int):
    """A Stribeck curve of so many speeds."""
    contact = {"shape": (50, 50), "spacing": 1.8e-6}
    scene = lubfric.load_scene("paper").with_(numerics={"sampling": "patch"}, contact=contact)
    model = lubfric.prepare(scene)
    lubfric.stribeck(model, [0.1])

    def solve():
        lubfric.stribeck(model, np.geomspace(1e-4, 1.0, count))
        return count, count

    return solve, 1


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
