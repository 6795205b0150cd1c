"""Processor seconds against the standard error asked, and the error that was made."""

from __future__ import annotations

import numpy as np

from . import cases
from .measure import solve

ASKED = (0.05, 0.02, 0.01)


def run(trials: int, seed: int, truths: dict[float, float], tell) -> dict:
    """{case name: rows (asked, mean seconds, root mean square error of f)} on ``trials`` surfaces of each; ``truths``
    {speed [m/s]: f of an endless line}."""
    found = {}
    for case in cases.SPEEDS[1:]:
        truth = truths[case.speed]
        rows = []
        for asked in ASKED:
            made = [solve(case.scene(seed + 61_000 + k), case.speed, asked) for k in range(trials)]
            error = np.sqrt(np.mean([(m["f"] / truth - 1) ** 2 for m in made]))
            rows.append((asked, np.mean([m["seconds"] for m in made]), error))
        found[case.name] = np.array(rows)
        tell(f"{case.name}: " + ", ".join(f"{100 * a:g} % in {s:.2g} s" for a, s, _ in rows))
    return found
