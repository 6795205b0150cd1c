"""The chart of the dry contact: error of the pressure against time, by method, tolerance, load, surface and
boundary."""

from collections.abc import Callable
from functools import lru_cache, partial
from typing import Any

import numpy as np

from lubfric import ConvergenceError, solve_contact
from lubfric.contact import half_space
from lubfric.paper import alternating, single_loop

from ..opponents import CONTACT
from .measure import interleaved, point

SPACING = 2e-6
SIGMA = 240e-9
LENGTH = 34e-6
E_PRIME = 231e9
DEFAULT = 1e-6
LONG = 5.0  # CPU seconds: a method that took longer is not asked for a tighter tolerance
BOUNDARIES = {"periodic": ("periodic", "periodic"), "periodic along y": ("free", "periodic"), "free": ("free", "free")}


def heights(n: int, acf: str) -> np.ndarray:
    """Periodic Gaussian heights [m]; a smaller grid is every other point of the next larger one."""
    z = _finest(acf)
    step = len(z) // n
    return np.ascontiguousarray(z[::step, ::step])


@lru_cache(maxsize=2)
def _finest(acf: str, finest: int = 2048) -> np.ndarray:
    x = np.fft.fftfreq(finest) * finest * SPACING * 512 / finest
    r = np.hypot(x[:, None], x) / LENGTH
    amplitude = np.sqrt(np.maximum(np.fft.fft2(np.exp(-r if acf == "exponential" else -r * r)).real, 0))
    z = np.fft.ifft2(amplitude * np.fft.fft2(np.random.default_rng(0).standard_normal((finest, finest)))).real
    return (z - z.mean()) * (SIGMA / z.std())


def cases(*, quick: bool) -> dict[str, tuple]:
    """Panels for surfaces and loads of a periodic contact, for the other boundaries at one load, and for grids."""
    n, loads = (64, (200e6,)) if quick else (256, (50e6, 200e6, 1000e6))
    tolerances = (1e-2, 1e-4, 1e-6) if quick else (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10)
    surfaces, repeats = (("gaussian",), 1) if quick else (("exponential", "gaussian"), 3)
    results: dict[str, tuple] = {}
    for acf in surfaces:
        for load in loads:
            results[f"{acf}, {load / 1e6:g} MPa, {n}²"] = (acf, n, load, "periodic", tolerances, repeats)
    for name in list(BOUNDARIES)[1:]:
        results[f"{name}, exponential, 200 MPa, {n}²"] = ("exponential", n, 200e6, name, tolerances[:5], repeats)
    sizes = (32, 64, 128) if quick else (128, 256, 512, 1024, 2048)
    results |= {f"grids, {acf}": (acf, sizes) for acf in reversed(surfaces)}
    return {name: (name, *case) for name, case in results.items()}


def measured(case: tuple) -> list[dict]:
    """The points of one case."""
    return panel(*case) if len(case) > 3 else grids(*case[1:])


def methods(z: np.ndarray, pressure: float, boundary: str, mean_gap: float) -> dict:
    """{name: solve(tolerance) -> pressure}. The paper's methods are given the mean gap instead of the load."""
    kind = BOUNDARIES[boundary]
    spacing = 512 * SPACING / len(z)
    operator = half_space(z.shape, spacing, E_PRIME, kind)
    weight = np.ones(z.shape)
    gap0 = z.max() - z
    options: dict[str, Any] = dict(operator=operator, boundary=kind, raise_on_failure=False)
    by_gap: dict[str, Any] = options | {"weight": weight}

    def default(tolerance: float):
        result = solve_contact(gap0, spacing, E_PRIME, mean_pressure=pressure, tolerance=tolerance, **options)
        return result.pressure

    def in_one_loop(tolerance: float):
        asked: dict[str, Any] = {"tolerance": tolerance, "max_iterations": 600}
        return single_loop(z, mean_gap, spacing, E_PRIME, **asked, **by_gap).pressure

    def in_turns(tolerance: float):
        return alternating(z, mean_gap, spacing, E_PRIME, tolerance=tolerance, **by_gap).pressure

    results = {"lubfric": default, "paper, single loop": in_one_loop, "paper, alternating": in_turns}
    if boundary == "periodic":
        for name in ("plain Polonsky-Keer", "aspher", "tamaas"):
            solver = CONTACT[name](z, spacing, E_PRIME)
            if solver is not None:
                results[name] = partial(solver, pressure)
    return results


def panel(label: str, acf: str, n: int, load: float, boundary: str, tolerances: Any, repeats: int) -> list[dict]:
    """Every method at every tolerance against one tight solution."""
    z = heights(n, acf)
    values = []
    asked: dict[str, Any] = {"mean_pressure": load, "boundary": BOUNDARIES[boundary]}
    tight = solve_contact(z.max() - z, 512 * SPACING / n, E_PRIME, tolerance=1e-11, raise_on_failure=False, **asked)
    solvers = methods(z, load, boundary, tight.mean_gap)
    for tolerance in tolerances:
        calls = {name: partial(attempt, solve, tolerance) for name, solve in solvers.items()}
        for name, (p, seconds) in interleaved(calls, repeats).items():
            if seconds[0] > LONG:
                del solvers[name]
            if p is not None:
                error = float(np.linalg.norm(p - tight.pressure) / np.linalg.norm(tight.pressure))
                default = name == "lubfric" and tolerance == DEFAULT
                setting = f"tolerance {tolerance:g}"
                values.append(point(label, name, setting, error, seconds, size=z.size, default=default))
    return values


def attempt(solve: Callable[..., Any], tolerance: float):
    """The pressure, or None where the method gives up."""
    try:
        return solve(tolerance)
    except (ConvergenceError, RuntimeError):
        return None


def grids(acf: str, sizes: Any) -> list[dict]:
    """Contact area and mean gap of one surface on coarser grids against the finest, with a solver error of 1e-6."""
    solved = {}
    values = []
    for n in sizes:
        z = heights(n, acf)
        call = partial(solve_contact, z.max() - z, 512 * SPACING / n, E_PRIME, mean_pressure=200e6)
        solved[n] = interleaved({"": call}, 1)[""]
    finest = solved[sizes[-1]][0]
    for n in sizes[:-1]:
        result, seconds = solved[n]
        for what, name in (("contact_area_fraction", "contact area"), ("mean_gap", "mean gap")):
            off = abs(getattr(result, what) / getattr(finest, what) - 1)
            method = f"{acf}, {name}"
            values.append(point("discretisation, 200 MPa", method, f"{n}²", off, seconds, apart=True, size=n * n))
    return values
