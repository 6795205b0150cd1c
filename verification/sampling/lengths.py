"""Bias and scatter of one piece of surface against its length: what one patch leaves unsaid."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import lubfric

from ..check import TOLD, Check

LENGTHS = (90e-6, 180e-6, 360e-6, 720e-6, 1.44e-3)
SPEEDS = (0.01, 0.03)
CELL = 1.8e-6
Found = dict[float, tuple[np.ndarray, float]]


def run(trials: int, seed: int, truths: dict[float, float]) -> Found:
    """{speed: (rows of length [m], mean f, standard deviation, count; truth)}.

    Each length has ``trials`` patches on cells of 1.8 µm. ``truths`` is {speed [m/s]: f of an endless line}.
    """
    found: Found = {}
    for speed in SPEEDS:
        rows = []
        for length in LENGTHS:
            count = max(trials, int(trials * 360e-6 / length))
            f = [_patch(length, speed, seed + 50_000 + k) for k in range(count)]
            rows.append((length, np.mean(f), np.std(f, ddof=1), count))
        found[speed] = (np.array(rows), truths[speed])
    return found


def checks(found: Found) -> Iterator[Check]:
    """The bias of every length."""
    for speed, (rows, truth) in found.items():
        for length, mean, _, count in rows:
            words = f"{speed:g} m/s: bias of f of {count:.0f} patches of {1e3 * length:g} mm"
            yield Check(words, mean / truth - 1, 0.0, 0.0, "plain balances of long patches", TOLD)


def _patch(length: float, speed: float, seed: int) -> float:
    scene = lubfric.load_scene("paper").with_(
        surface={"seed": seed},
        contact={"shape": (50, 4 * round(length / (4 * CELL))), "spacing": CELL},
        numerics={"sampling": "patch", "grid": "given"},
    )
    return lubfric.friction(scene, speed).coefficient
