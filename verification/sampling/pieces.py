"""A map cut into pieces: does the interval of a piece cover the friction of the whole map?"""

from __future__ import annotations

from pathlib import Path

import numpy as np

import lubfric

from .. import kept
from .measure import solve

CELLS, SPACING, CUTS, SPEED = 1600, 0.45e-6, 2, 0.02
ASKED = 0.02


def run(maps: int, seed: int, out: Path) -> list[dict]:
    """Rows of the pieces of ``maps`` generated maps, written and read again as instrument files are; maps kept in
    ``out`` are not solved again."""
    file = out / f"pieces-{seed}.jsonl"
    rows = kept.read(file)
    done = {row["map"] for row in rows}
    for k in range(maps):
        if k not in done:
            for row in pieces_of(k, seed, out):
                kept.append(file, row)
                rows.append(row)
    return [row for row in rows if row["map"] < maps]


def pieces_of(k: int, seed: int, out: Path) -> list[dict]:
    """The ``k``-th map as a whole and every piece of it."""
    whole = lubfric.generate_surface(
        (CELLS, CELLS), SPACING, sq=100e-9, correlation_length=8e-6, acf="gaussian", seed=seed + 90_000 + k
    ).heights
    truth = _solve(out / "whole.npy", whole)
    size = CELLS // CUTS
    parts = {(i, j): whole[i * size : (i + 1) * size, j * size : (j + 1) * size] for i, j in np.ndindex(CUTS, CUTS)}
    return [
        {**_solve(out / "piece.npy", heights), "whole": truth["f"], "map": k, "piece": list(place)}
        for place, heights in parts.items()
    ]


def _solve(file: Path, heights: np.ndarray) -> dict:
    np.save(file, heights)
    scene = lubfric.load_scene("paper").with_(
        surface={"file": str(file), "sq": None, "correlation_length": None, "spacing": SPACING, "unit": "m"},
        contact={"shape": None, "spacing": None},
    )
    return solve(scene, SPEED, ASKED)
