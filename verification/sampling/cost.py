"""Processor seconds against the standard error asked, and the error that was made."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..check import TOLD, Check
from .cases import SPEEDS
from .measure import solve

ASKED = (0.05, 0.02, 0.01)


def run(trials: int, seed: int, truths: dict[float, float]) -> dict[str, np.ndarray]:
    """{case name: rows (asked, mean seconds, root mean square error of f)} on ``trials`` surfaces of each case.

    ``truths`` is {speed [m/s]: f of an endless line}.
    """
    found = {}
    for case in SPEEDS[1:]:
        rows = []
        for asked in ASKED:
            made = [solve(case.scene(seed + 61_000 + k), case.speed, asked) for k in range(trials)]
            error = np.sqrt(np.mean([(m["f"] / truths[case.speed] - 1) ** 2 for m in made]))
            rows.append((asked, np.mean([m["seconds"] for m in made]), error))
        found[case.name] = np.array(rows)
    return found


def checks(found: dict[str, np.ndarray]) -> Iterator[Check]:
    """A check for every error asked, with the error that was made."""
    for name, rows in found.items():
        for asked, _, error in rows:
            words = f"{name}: rms error of f, asked {100 * asked:g} %"
            yield Check(words, error, asked, 0.0, "plain balances of long patches", TOLD)
