"""What the last digits of every number depend on in addition to its inputs: versions of the libraries, and how this
process computes with them."""

import hashlib
import platform
from functools import cache

import numpy as np
import scipy

from .._base import __version__

# Length of the vectors, and rows of the matrices, of the trial sums: long enough that BLAS splits them by its threads.
# A choice.
TRIAL_LENGTH = 40_000
ROWS = 256


@cache
def arithmetic() -> tuple[str, ...]:
    """Return the versions of lubfric, NumPy and SciPy, the kind of machine, and a hash of trial sums.

    BLAS adds in an order that depends on its kernel for the processor and on its number of threads, and elementary
    functions differ by processor. So f differs by some 1e-11 of it between such processes, and not at all between
    processes whose trial sums have equal bits.
    """
    return (__version__, np.__version__, scipy.__version__, platform.machine(), trial_sums())


def trial_sums() -> str:
    """Return a hash of the bits of sums, products, solutions and elementary functions of fixed numbers."""
    from scipy.linalg import lu_factor

    numbers = np.random.default_rng(0).standard_normal(TRIAL_LENGTH)
    matrix = numbers[: ROWS * 128].reshape(ROWS, 128)
    square = matrix @ matrix.T
    results = (
        np.array(numbers @ numbers),
        square,
        matrix @ numbers[:128],
        lu_factor(square + ROWS * np.eye(ROWS))[0],
        np.fft.rfft(numbers),
        np.exp(numbers),
        np.arcsinh(numbers),
    )
    digest = hashlib.sha256()
    for result in results:
        digest.update(np.ascontiguousarray(result).tobytes())
    return digest.hexdigest()[:16]
