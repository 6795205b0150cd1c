"""Other people's contact solvers behind one signature, where they are installed (``pip install "lubfric[benchmark]"``).

Each factory returns ``solve(load, tolerance) -> pressure`` [Pa], or None where its package is missing. Tolerances mean
different things to each: compare them by one measured error, never by tolerance.
"""

import importlib.metadata
import os
from collections.abc import Callable

import numpy as np

from lubfric import solve_contact
from lubfric.contact.operator import half_space

from ..types import Keywords
from .polonsky_keer import polonsky_keer

# Packages of other people's solvers. A build of aspher needs the headers of Eigen, which PyPI has as cmeel-eigen:
# CMAKE_PREFIX_PATH is its folder cmeel.prefix then.
PEERS = ("tamaas", "aspher")
COARSEST = 48  # cells: the side of the grids of aspher is halved down to about this many

Solver = Callable[[float, float], np.ndarray]


def version(package: str) -> str:
    """Return installed version, or ""."""
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return ""


def peers() -> str:
    """Return the versions of other people's solvers, and which of them are missing, in one line."""
    return ", ".join(f"{name} {version(name) or 'not installed'}" for name in PEERS)


def tamaas_solver(
    heights: np.ndarray, spacing: float, e_prime: float, threads: int = 1, max_iterations: int = 20000
) -> Solver | None:
    """Return Polonsky-Keer-Rey of `tamaas`, pressure as its primal variable; its wheel always runs on one thread.

    The pressure is what it has after ``max_iterations``, converged or not.
    """
    try:
        import tamaas
    except ImportError:
        return None
    tamaas.initialize(threads)
    tamaas.set_log_level(tamaas.LogLevel.error)
    n = len(heights)
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [n * spacing] * 2, [n, n])
    model.E = e_prime / 2
    model.nu = 0.0

    def solve(load: float, tolerance: float) -> np.ndarray:
        model.traction[:] = 0.0
        primal = tamaas.PolonskyKeerRey.pressure
        solver = tamaas.PolonskyKeerRey(model, heights.copy(), tolerance, primal, primal)
        solver.max_iter = max_iterations
        solver.dump_freq = 10**9
        solver.solve(load)
        return np.array(model.traction).reshape(n, n)

    return solve


def aspher_solver(
    heights: np.ndarray,
    spacing: float,
    e_prime: float,
    threads: int = 1,
    precision: str = "float_then_double",
    engine: str = "fft",
) -> Solver | None:
    """Return nested grids of `aspher`, periodic: its fastest setting is float to double with the transform as
    preconditioner.

    Set OMP_NUM_THREADS before the process starts: OpenMP reads it once. ``heights`` must be square with an even side.
    """
    os.environ.setdefault("OMP_NUM_THREADS", str(threads))
    try:
        import aspher
    except ImportError:
        return None
    n = len(heights)
    coarsest = n
    while coarsest % 2 == 0 and coarsest > COARSEST:
        coarsest //= 2
    gap = heights.max() - heights

    settings = {"backend": "periodic", "precision": precision, "precond_engine": engine, "coarsest": coarsest}
    settings |= {"domain_size": n * spacing, "E_star": e_prime / 2}

    def solve(load: float, tolerance: float) -> np.ndarray:
        return np.array(aspher.solve_nested(n, gap, load, tol=tolerance, **settings).pressure).reshape(n, n)

    return solve


def lubfric_solver(heights: np.ndarray, spacing: float, e_prime: float, threads: int = 1) -> Solver:
    """Return the default of the library, its operator made once."""
    operator = half_space(heights.shape, spacing, e_prime, workers=threads)

    def solve(load: float, tolerance: float) -> np.ndarray:
        options: Keywords = {
            "mean_pressure": load,
            "tolerance": tolerance,
            "operator": operator,
            "raise_on_failure": False,
        }
        return solve_contact(heights.max() - heights, spacing, e_prime, **options).pressure

    return solve


def polonsky_keer_solver(heights: np.ndarray, spacing: float, e_prime: float, threads: int = 1) -> Solver:
    """Return plain Polonsky-Keer with the library's operator."""
    operator = half_space(heights.shape, spacing, e_prime, workers=threads)

    def solve(load: float, tolerance: float) -> np.ndarray:
        return polonsky_keer(heights.max() - heights, operator, load, tolerance)[0]

    return solve


CONTACT: dict[str, Callable[[np.ndarray, float, float], Solver | None]] = {
    "lubfric": lubfric_solver,
    "plain Polonsky-Keer": polonsky_keer_solver,
    "aspher": aspher_solver,
    "tamaas": tamaas_solver,
}
