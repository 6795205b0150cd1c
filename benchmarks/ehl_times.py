"""Times and errors of `solve_ehl`: python benchmarks/ehl_times.py [repeats]

Cold and warm medians on one BLAS thread against the error in smallest and flow film (reference: tolerance 3e-5), and
the time of `film_at`. A warm solve starts from a result at 3 % less load, as load sharing does.
"""

import os
import sys
import time

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import numpy as np

from lubfric import solve_ehl

ALPHA, VISCOSITY, RADIUS, E_PRIME = 2.2e-8, 0.0358, 0.01, 2.2e11
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


def arguments(M, L):
    """SI inputs with the Moes numbers M, L."""
    u1 = (L / (ALPHA * E_PRIME)) ** 4
    return {
        "load_per_width": M * u1**0.5 * E_PRIME * RADIUS,
        "radius": RADIUS,
        "e_prime": E_PRIME,
        "entrainment_speed": u1 * E_PRIME * RADIUS / (2 * VISCOSITY),
        "viscosity": VISCOSITY,
        "pressure_viscosity_coefficient": ALPHA,
    }


def median_ms(call, repeats):
    """Median wall time of ``call()`` [ms] and its last value."""
    times = []
    for _ in range(repeats):
        begun = time.perf_counter()
        value = call()
        times.append(1e3 * (time.perf_counter() - begun))
    return float(np.median(times)), value


def error(result, reference):
    """Largest relative error of smallest and flow film."""
    return max(abs(result.min_film / reference.min_film - 1), abs(result.flow_film / reference.flow_film - 1))


def main(repeats):
    print(
        f"{'M':>6} {'L':>4} {'tolerance':>9} {'cold ms':>8} {'warm ms':>8} {'error':>8} {'warm err':>8} "
        f"{'cells':>6} {'film_at 800 ms':>15}"
    )
    for M, L in CASES:
        case = arguments(M, L)
        reference = solve_ehl(**case, tolerance=3e-5)
        for tolerance in (1e-2, 3e-3, 1e-3, 1e-4):
            lighter = case | {"load_per_width": 0.97 * case["load_per_width"]}
            start = solve_ehl(**lighter, tolerance=tolerance)
            cold_ms, cold = median_ms(lambda case=case, t=tolerance: solve_ehl(**case, tolerance=t), repeats)
            warm_ms, warm = median_ms(
                lambda case=case, t=tolerance, s=start: solve_ehl(**case, tolerance=t, start=s), repeats
            )
            x = np.linspace(-20, 20, 800) * cold.half_width
            film_ms, _ = median_ms(lambda cold=cold, x=x: cold.film_at(x), repeats)
            print(
                f"{M:6g} {L:4g} {tolerance:9g} {cold_ms:8.2f} {warm_ms:8.2f} {error(cold, reference):8.1e} "
                f"{error(warm, reference):8.1e} {cold.state.pressure.size:6d} {film_ms:15.2f}"
            )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 11)
