"""Independent cases on all cores."""

from __future__ import annotations

import os
from concurrent.futures import ProcessPoolExecutor


def spread(function, cases, quick: bool) -> list:
    """``[function(*case) for case in cases]`` in as many processes as there are cores (one when
    ``quick``)."""
    cores = 1 if quick else os.cpu_count() or 1
    if cores == 1:
        return [function(*case) for case in cases]
    with ProcessPoolExecutor(cores) as pool:
        return list(pool.map(function, *zip(*cases)))
