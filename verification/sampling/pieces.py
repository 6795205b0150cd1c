"""A map cut into pieces: does the interval of a piece cover the friction of the whole map?"""

from __future__ import annotations

import json
import tempfile
from pathlib import Path

import numpy as np

import lubfric

from .measure import solve

CELLS, SPACING, CUTS, SPEED = 1600, 0.45e-6, 2, 0.02
ASKED = 0.02


def run(maps: int, seed: int, out: Path, tell) -> list[dict]:
    """Rows of the pieces of ``maps`` generated maps, written and read again as instrument files are."""
    base = lubfric.load_scene("paper").with_(
        surface={"file": __file__, "sq": None, "correlation_length": None}, contact={"shape": None, "spacing": None}
    )
    rows = []
    for k in range(maps):
        whole = lubfric.generate_surface(
            (CELLS, CELLS), SPACING, sq=100e-9, correlation_length=8e-6, acf="gaussian", seed=seed + 90_000 + k
        )
        rows += cut(base, SPEED, whole, (CUTS, CUTS), f"map {k} of {seed}", out, tell)
    return rows


def measured(scene, speed: float, cuts: tuple[int, int], out: Path, tell) -> list[dict]:
    """Rows of the pieces of the measured map that ``scene`` names, cut into ``cuts`` along x and along y."""
    rough = scene.surface
    whole = lubfric.read_surface(rough.file, spacing=rough.spacing, unit=rough.unit, level=False)
    name = f"{Path(rough.file).stem} {cuts[0]} x {cuts[1]}, {speed:g} m per s"
    return cut(scene.with_(surface={"sq": None}), speed, whole, cuts, name, out, tell)


def cut(scene, speed: float, whole, cuts: tuple[int, int], name: str, out: Path, tell) -> list[dict]:
    """Friction of a surface and of its pieces, each kept in ``out`` when it is found and not solved again."""
    kept = out / f"pieces-{'-'.join(name.split())}.jsonl"
    rows = [json.loads(line) for line in kept.read_text().splitlines()] if kept.is_file() else []
    places: list[list[int]] = [[-1, -1], *([i, j] for i in range(cuts[0]) for j in range(cuts[1]))]
    for place in places[len(rows) :]:
        heights = whole.heights if place == places[0] else _piece(whole.heights, cuts, place)
        rows.append({"map": name, "piece": place, **_solve(scene, speed, heights, whole.spacing)})
        with kept.open("a") as stream:
            stream.write(json.dumps(rows[-1]) + "\n")
    truth, pieces = rows[0]["f"], rows[1:]
    tell(f"{name}: f = {truth:.5g} ; pieces " + ", ".join(f"{r['low']:.5g} to {r['high']:.5g}" for r in pieces))
    return [{**row, "whole": truth} for row in pieces]


def _piece(heights, cuts, place):
    nx, ny = heights.shape[0] // cuts[0], heights.shape[1] // cuts[1]
    i, j = place
    return heights[i * nx : (i + 1) * nx, j * ny : (j + 1) * ny]


def _solve(scene, speed: float, heights, spacing) -> dict:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "piece.npy"
        np.save(file, heights)
        named = scene.with_(surface={"file": str(file), "spacing": tuple(spacing), "unit": "m"})
        return solve(named, speed, ASKED)
