"""The chart of the dry contact: error of the pressure against time, by method, tolerance, load, surface and
boundary."""

from collections.abc import Callable, Sequence
from functools import lru_cache, partial

import numpy as np

from lubfric import ConvergenceError, solve_contact
from lubfric.contact import half_space
from lubfric.paper import alternating, single_loop

from ...types import Keywords, PlainRow
from ..opponents import CONTACT
from .measure import interleaved, point

SPACING = 2e-6  # m, of 512 cells a side; other grids have the same width
SIGMA = 240e-9  # m, Sq
LENGTH = 34e-6  # m, at which the autocorrelation is 1/e
E_PRIME = 231e9  # Pa, E' of two steel bodies
DEFAULT = 1e-6  # tolerance of `solve_contact` that users get
LONG = 5.0  # CPU seconds: a method that took longer is not asked for a tighter tolerance
# The measurement of a panel.
MeasuredCase = Callable[[], list[PlainRow]]
BOUNDARIES = {"periodic": ("periodic", "periodic"), "periodic along y": ("free", "periodic"), "free": ("free", "free")}


def heights(n: int, acf: str) -> np.ndarray:
    """Return periodic Gaussian heights [m]; a smaller grid is every other point of the next larger one."""
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


def cases(*, quick: bool) -> dict[str, MeasuredCase]:
    """Return panels for surfaces and loads of a periodic contact, for the other boundaries at one load, and for
    grids."""
    n, loads = (64, (200e6,)) if quick else (256, (50e6, 200e6, 1000e6))
    tolerances = (1e-2, 1e-4, 1e-6) if quick else (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10)
    surfaces, repeats = (("gaussian",), 1) if quick else (("exponential", "gaussian"), 3)
    results: dict[str, MeasuredCase] = {}
    for acf in surfaces:
        for load in loads:
            name = f"{acf}, {load / 1e6:g} MPa, {n}²"
            results[name] = partial(panel, name, acf, n, load, "periodic", tolerances, repeats)
    for boundary in list(BOUNDARIES)[1:]:
        name = f"{boundary}, exponential, 200 MPa, {n}²"
        results[name] = partial(panel, name, "exponential", n, 200e6, boundary, tolerances[:5], repeats)
    sizes = (32, 64, 128) if quick else (128, 256, 512, 1024, 2048)
    return results | {f"grids, {acf}": partial(grids, acf, sizes) for acf in reversed(surfaces)}


def measured(case: MeasuredCase) -> list[PlainRow]:
    """Return the points of one case."""
    return case()


def methods(z: np.ndarray, pressure: float, boundary: str, mean_gap: float) -> dict[str, Callable[[float], np.ndarray]]:
    """Return {name: solve(tolerance) -> pressure}. The paper's methods are given the mean gap instead of the load."""
    kind = BOUNDARIES[boundary]
    spacing = 512 * SPACING / len(z)
    operator = half_space(z.shape, spacing, E_PRIME, kind)
    weight = np.ones(z.shape)
    gap0 = z.max() - z
    options: Keywords = dict(operator=operator, boundary=kind, raise_on_failure=False)
    by_gap: Keywords = options | {"weight": weight}

    def default(tolerance: float) -> np.ndarray:
        result = solve_contact(gap0, spacing, E_PRIME, mean_pressure=pressure, tolerance=tolerance, **options)
        return result.pressure

    def in_one_loop(tolerance: float) -> np.ndarray:
        settings: Keywords = {"tolerance": tolerance, "max_iterations": 600}
        return single_loop(z, mean_gap, spacing, E_PRIME, **settings, **by_gap).pressure

    def in_turns(tolerance: float) -> np.ndarray:
        return alternating(z, mean_gap, spacing, E_PRIME, tolerance=tolerance, **by_gap).pressure

    results: dict[str, Callable[[float], np.ndarray]] = {
        "lubfric": default,
        "paper, single loop": in_one_loop,
        "paper, alternating": in_turns,
    }
    if boundary == "periodic":
        for name in ("plain Polonsky-Keer", "aspher", "tamaas"):
            solver = CONTACT[name](z, spacing, E_PRIME)
            if solver is not None:
                results[name] = partial(solver, pressure)
    return results


def panel(
    label: str, acf: str, n: int, load: float, boundary: str, tolerances: Sequence[float], repeats: int
) -> list[PlainRow]:
    """Return every method at every tolerance against one tight solution."""
    z = heights(n, acf)
    values = []
    settings: Keywords = {"mean_pressure": load, "boundary": BOUNDARIES[boundary]}
    tight = solve_contact(z.max() - z, 512 * SPACING / n, E_PRIME, tolerance=1e-11, raise_on_failure=False, **settings)
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


def attempt(solve: Callable[[float], np.ndarray], tolerance: float) -> np.ndarray | None:
    """Return the pressure, or None where the method gives up."""
    try:
        return solve(tolerance)
    except (ConvergenceError, RuntimeError):
        return None


def grids(acf: str, sizes: Sequence[int]) -> list[PlainRow]:
    """Return contact area and mean gap of one surface on coarser grids against the finest, with a solver error of
    1e-6."""
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
