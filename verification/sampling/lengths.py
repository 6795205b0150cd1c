"""Bias and scatter of one piece of surface against its length: what one patch leaves unsaid."""

from __future__ import annotations

import numpy as np

import lubfric

LENGTHS = (90e-6, 180e-6, 360e-6, 720e-6, 1.44e-3)
SPEEDS = (0.01, 0.03)
CELL = 1.8e-6


def run(trials: int, seed: int, truths: dict[float, float], tell) -> dict:
    """{speed: (lengths [m], mean f, standard deviation, truth)} of ``trials`` patches of each length, on cells of 1.8
    µm; ``truths`` {speed [m/s]: f of an endless line}."""
    found = {}
    for speed in SPEEDS:
        truth = truths[speed]
        rows = []
        for length in LENGTHS:
            f = [_patch(length, speed, seed + 50_000 + k) for k in range(max(trials, int(trials * 360e-6 / length)))]
            rows.append((length, np.mean(f), np.std(f, ddof=1), len(f)))
        found[speed] = (np.array(rows), truth)
        tell(f"{speed:g} m/s: bias {[f'{100 * (r[1] / truth - 1):+.1f} %' for r in rows]} of {LENGTHS} m")
    return found


def _patch(length: float, speed: float, seed: int) -> float:
    scene = lubfric.load_scene("paper").with_(
        surface={"seed": seed},
        contact={"shape": (50, 4 * round(length / (4 * CELL))), "spacing": CELL},
        numerics={"sampling": "patch", "grid": "given"},
    )
    return lubfric.friction(scene, speed).coefficient
