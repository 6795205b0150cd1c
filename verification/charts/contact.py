"""The chart of the dry contact: error of the pressure against time, by method, tolerance, load, surface and
boundary."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache, partial

import numpy as np

from lubfric import ConvergenceError, solve_contact
from lubfric.contact import half_space
from lubfric.paper import alternating, single_loop

from ..check import Check
from ..opponents import CONTACT
from .data import interleaved, point

SPACING, SIGMA, LENGTH, E_PRIME = 2e-6, 240e-9, 34e-6, 231e9
DEFAULT = 1e-6
LONG = 5.0  # CPU seconds: a method that took longer is not asked for a tighter tolerance
BOUNDARIES = {
    "periodic": ("periodic", "periodic"),
    "periodic along y": ("free", "periodic"),
    "free": ("free", "free"),
}
OWN = ("lubfric", "plain Polonsky-Keer", "paper, single loop", "paper, alternating")


def heights(n: int, acf: str, seed: int = 0) -> np.ndarray:
    """Periodic Gaussian heights [m]; a smaller grid is every other point of the next larger one."""
    z = _finest(acf, seed)
    step = len(z) // n
    return np.ascontiguousarray(z[::step, ::step])


@lru_cache(maxsize=2)
def _finest(acf: str, seed: int, finest: int = 2048) -> np.ndarray:
    x = np.fft.fftfreq(finest) * finest * SPACING * 512 / finest
    r = np.hypot(x[:, None], x) / LENGTH
    amplitude = np.sqrt(np.maximum(np.fft.fft2(np.exp(-r if acf == "exponential" else -r * r)).real, 0))
    z = np.fft.ifft2(amplitude * np.fft.fft2(np.random.default_rng(seed).standard_normal((finest, finest)))).real
    return (z - z.mean()) * (SIGMA / z.std())


def points(level: str) -> Iterator[Check]:
    """Panels for surfaces and loads where the contact is periodic, and for the other boundaries at one load."""
    quick = level == "quick"
    n = 64 if quick else 256
    tolerances = (1e-2, 1e-4, 1e-6) if quick else (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10)
    for acf in ("gaussian",) if quick else ("exponential", "gaussian"):
        z = heights(n, acf)
        for pressure in (200e6,) if quick else (50e6, 200e6, 1000e6):
            yield from panel(z, pressure, "periodic", f"{acf}, {pressure / 1e6:g} MPa, {n}²", tolerances, quick)
    for name in list(BOUNDARIES)[1:]:
        yield from panel(
            heights(64 if quick else 256, "exponential"),
            200e6,
            name,
            f"{name}, exponential, 200 MPa, {64 if quick else 256}²",
            tolerances[:5],
            quick,
        )
    yield from grids(quick)


def methods(z, pressure: float, boundary: str, mean_gap: float) -> dict:
    """{name: solve(tolerance) -> pressure}. The paper's methods are given the mean gap instead of the load."""
    kind = BOUNDARIES[boundary]
    spacing = 512 * SPACING / len(z)
    operator = half_space(z.shape, spacing, E_PRIME, kind)
    weight = np.ones(z.shape)
    options = dict(operator=operator, boundary=kind, raise_on_failure=False)
    gap0 = z.max() - z
    found = {
        "lubfric": lambda t: (
            solve_contact(gap0, spacing, E_PRIME, mean_pressure=pressure, tolerance=t, **options).pressure
        ),
        "paper, single loop": lambda t: (
            single_loop(
                z, mean_gap, spacing, E_PRIME, weight=weight, tolerance=t, max_iterations=600, **options
            ).pressure
        ),
        "paper, alternating": lambda t: (
            alternating(z, mean_gap, spacing, E_PRIME, weight=weight, tolerance=t, **options).pressure
        ),
    }
    if boundary == "periodic":
        for name in ("plain Polonsky-Keer", "aspher", "tamaas"):
            solver = CONTACT[name](z, spacing, E_PRIME)
            if solver is not None:
                found[name] = partial(solver, pressure)
    return found


def panel(z, pressure: float, boundary: str, label: str, tolerances, quick: bool) -> Iterator[Check]:
    """Every method at every tolerance against one tight solution."""
    spacing = 512 * SPACING / len(z)
    tight = solve_contact(
        z.max() - z,
        spacing,
        E_PRIME,
        mean_pressure=pressure,
        tolerance=1e-11,
        boundary=BOUNDARIES[boundary],
        raise_on_failure=False,
    )
    solvers = methods(z, pressure, boundary, tight.mean_gap)
    for tolerance in tolerances:
        calls = {name: partial(attempt, solve, tolerance) for name, solve in solvers.items()}
        for name, (p, seconds) in interleaved(calls, 1 if quick else 3).items():
            if seconds[0] > LONG:
                del solvers[name]
            if p is not None:
                error = float(np.linalg.norm(p - tight.pressure) / np.linalg.norm(tight.pressure))
                default = name == "lubfric" and tolerance == DEFAULT
                yield point(label, name, f"tolerance {tolerance:g}", error, seconds, size=z.size, default=default)


def attempt(solve, tolerance: float):
    """The pressure, or None where the method gives up."""
    try:
        return solve(tolerance)
    except (ConvergenceError, RuntimeError):
        return None


def grids(quick: bool) -> Iterator[Check]:
    """Error of coarser grids: contact area and mean gap of one surface against the finest grid, with a solver error of
    1e-6."""
    sizes = (32, 64, 128) if quick else (128, 256, 512, 1024, 2048)
    for acf in ("gaussian",) if quick else ("gaussian", "exponential"):
        solved = {}
        for n in sizes:
            z = heights(n, acf)
            call = {
                "lubfric": lambda z=z, n=n: solve_contact(z.max() - z, 512 * SPACING / n, E_PRIME, mean_pressure=200e6)
            }
            solved[n] = interleaved(call, 1)["lubfric"]
        finest = solved[sizes[-1]][0]
        for n in sizes[:-1]:
            result, seconds = solved[n]
            for what in ("contact_area_fraction", "mean_gap"):
                off = abs(getattr(result, what) / getattr(finest, what) - 1)
                method = f"{acf}, {what.replace('_fraction', '').replace('_', ' ')}"
                yield point("discretisation, 200 MPa", method, f"{n}²", off, seconds, apart=True, size=n * n)
