"""Times and errors of `solve_ehl` on one thread: python -m verification.campaigns.benchmarks.ehl_times [--repeats 11]
[--docs docs]

The shortest processor times, cold and warm, at three tolerances, and the larger error of smallest and flow film against
a solution at tolerance 3e-5. A warm solve starts from a result at 3 % less load, as load sharing does.
"""

import argparse
import os
import time
from collections.abc import Callable
from functools import partial

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

from lubfric import EHLResult, solve_ehl

from ...types import Keywords, T
from . import page

ALPHA = 2.2e-8  # 1/Pa, pressure-viscosity coefficient of a mineral oil
VISCOSITY = 0.0358  # Pa s
RADIUS = 0.01  # m
E_PRIME = 2.2e11  # Pa, E' of two steel bodies
CASES = [
    (0.01, 5.0),
    (1.0, 5.0),
    (5.0, 5.0),
    (20.0, 5.0),
    (100.0, 5.0),
    (10.0, 10.0),
    (50.0, 10.0),
    (100.0, 20.0),
    (1000.0, 5.0),
    (1000.0, 20.0),
]
TOLERANCES = (1e-2, 3e-3, 1e-3)
COLUMNS = (
    "M, L",
    *(f"{100 * t:g} %: {what}" for t in TOLERANCES for what in ("cold / warm, ms", "error, cold / warm")),
)
OF_PAGE = [0, 3, 4]  # columns: the page has those of the default tolerance


def arguments(M: float, L: float) -> Keywords:
    """Return SI inputs with the Moes numbers M, L."""
    u1 = (L / (ALPHA * E_PRIME)) ** 4
    return {
        "load_per_width": M * u1**0.5 * E_PRIME * RADIUS,
        "radius": RADIUS,
        "e_prime": E_PRIME,
        "entrainment_speed": u1 * E_PRIME * RADIUS / (2 * VISCOSITY),
        "viscosity": VISCOSITY,
        "pressure_viscosity_coefficient": ALPHA,
    }


def shortest_ms(call: Callable[[], T], repeats: int) -> tuple[float, T]:
    """Return shortest processor time of ``call()`` [ms], the one that other jobs lengthen least, and its last value."""
    times = []
    for _ in range(repeats):
        begun = time.process_time()
        value = call()
        times.append(1e3 * (time.process_time() - begun))
    return min(times), value


def error(result: EHLResult, reference: EHLResult) -> float:
    """Return largest relative error of smallest and flow film."""
    return max(abs(result.min_film / reference.min_film - 1), abs(result.flow_film / reference.flow_film - 1))


def row(M: float, L: float, repeats: int) -> list[str]:
    """Return one contact at every tolerance."""
    case = arguments(M, L)
    cells = [f"{M:g}, {L:g}"]
    lighter = case | {"load_per_width": 0.97 * case["load_per_width"]}
    reference = solve_ehl(**case, tolerance=3e-5)
    for tolerance in TOLERANCES:
        start = solve_ehl(**lighter, tolerance=tolerance)
        cold_ms, cold = shortest_ms(partial(solve_ehl, **case, tolerance=tolerance), repeats)
        warm_ms, warm = shortest_ms(partial(solve_ehl, **case, tolerance=tolerance, start=start), repeats)
        errors = f"{error(cold, reference):.1e} / {error(warm, reference):.1e}"
        cells += [f"{cold_ms:.1f} / {warm_ms:.1f}", errors]
    return cells


def main() -> None:
    """Measure, and print what was measured."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeats", type=int, default=11)
    page.add_option(parser)
    options = parser.parse_args()
    rows = []
    for M, L in CASES:
        rows.append(row(M, L, options.repeats))
        print(" | ".join(rows[-1]), flush=True)
    shown = [[line[column] for column in OF_PAGE] for line in rows]
    columns = [COLUMNS[column] for column in OF_PAGE]
    page.write("film-times", columns, shown, (parser, options))


if __name__ == "__main__":
    main()
