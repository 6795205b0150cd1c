"""A map cut into pieces: does the interval of a piece cover the friction of the whole map?"""

from __future__ import annotations

import json
from pathlib import Path

import lubfric

CELLS, SPACING, CUTS, SPEED = 1600, 0.45e-6, 2, 0.02
ASKED = 0.02


def run(maps: int, seed: int, out: Path, tell) -> list[dict]:
    """Rows of the pieces of ``maps`` generated maps, written and read again as instrument files are."""
    import numpy as np

    rows = []
    for k in range(maps):
        whole = lubfric.generate_surface(
            (CELLS, CELLS), SPACING, sq=100e-9, correlation_length=8e-6, acf="gaussian", seed=seed + 90_000 + k
        ).heights
        np.save(out / "whole.npy", whole)
        truth = _solve(out / "whole.npy")
        size = CELLS // CUTS
        for i in range(CUTS):
            for j in range(CUTS):
                np.save(out / "piece.npy", whole[i * size : (i + 1) * size, j * size : (j + 1) * size])
                rows.append({**_solve(out / "piece.npy"), "whole": truth["f"], "map": k, "piece": [i, j]})
        tell(f"map {k}: f = {truth['f']:.5g} ; pieces {[round(r['f'], 5) for r in rows[-CUTS * CUTS :]]}")
    (out / f"pieces-{seed}.jsonl").write_text("\n".join(json.dumps(r) for r in rows) + "\n")
    return rows


def _solve(file: Path) -> dict:
    from .measure import solve

    scene = lubfric.load_scene("paper").with_(
        surface={"file": str(file), "sq": None, "correlation_length": None, "spacing": SPACING, "unit": "m"},
        contact={"shape": None, "spacing": None},
    )
    return solve(scene, SPEED, ASKED)
