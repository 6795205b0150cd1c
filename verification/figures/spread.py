"""Independent cases on all cores."""

from __future__ import annotations

import os
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

from ..parent import end_with_parent


def spread(function, cases, quick: bool) -> list:
    """``[function(*case) for case in cases]`` on a process for each core (one when ``quick``).

    The processes are fresh and have one thread each. With linear algebra on all cores in each of them they would fight
    for the cores.
    """
    cores = 1 if quick else os.cpu_count() or 1
    if cores == 1:
        return [function(*case) for case in cases]
    before = os.environ.get("OMP_NUM_THREADS")
    os.environ["OMP_NUM_THREADS"] = "1"
    try:
        with ProcessPoolExecutor(cores, mp_context=get_context("spawn"), initializer=end_with_parent) as pool:
            return list(pool.map(function, *zip(*cases)))
    finally:
        if before is None:
            del os.environ["OMP_NUM_THREADS"]
        else:
            os.environ["OMP_NUM_THREADS"] = before
