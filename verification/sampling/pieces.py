"""A map cut into pieces: does the interval of a piece cover the friction of the whole map?"""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np

import lubfric

from .. import kept
from .measure import solve

CELLS, SPACING, CUTS, SPEED = 1600, 0.45e-6, (2, 2), 0.02
ASKED = 0.02
WHOLE = [-1, -1]


def run(maps: int, seed: int, out: Path) -> list[dict]:
    """Rows of the pieces of ``maps`` generated maps, written and read again as instrument files are."""
    flat = {"file": __file__, "sq": None, "correlation_length": None}  # the file of each piece takes its place
    base = lubfric.load_scene("paper").with_(surface=flat, contact={"shape": None, "spacing": None})
    rows = []
    for k in range(maps):
        whole = lubfric.generate_surface(
            (CELLS, CELLS), SPACING, sq=100e-9, correlation_length=8e-6, acf="gaussian", seed=seed + 90_000 + k
        )
        rows += cut(base, SPEED, whole, CUTS, f"map {k} of {seed}", out)
    return rows


def measured(scene, cuts: tuple[int, int], out: Path) -> list[dict]:
    """Rows of the pieces of the measured map that ``scene`` names, at its entrainment speed, cut into ``cuts`` along x
    and along y."""
    rough, speed = scene.surface, scene.motion.entrainment_speed
    whole = lubfric.read_surface(rough.file, spacing=rough.spacing, unit=rough.unit, level=False)
    name = f"{Path(rough.file).stem} {cuts[0]} by {cuts[1]} at {speed:g}"
    return cut(scene.with_(surface={"sq": None}), speed, whole, cuts, name, out)


def cut(scene, speed: float, whole, cuts: tuple[int, int], name: str, out: Path) -> list[dict]:
    """Friction of a surface and of its pieces. Each is kept in ``out`` when it is found, and not solved again."""
    file = out / f"pieces-{'-'.join(name.split())}.jsonl"
    rows = kept.begin(file)
    places = [WHOLE, *([i, j] for i in range(cuts[0]) for j in range(cuts[1]))]
    for place in places[len(rows) :]:
        heights = whole.heights if place == WHOLE else _piece(whole.heights, cuts, place)
        rows.append({"map": name, "piece": place, **_solve(scene, speed, heights, whole.spacing)})
        kept.append(file, rows[-1])
    return [{**row, "whole": rows[0]["f"]} for row in rows[1:]]


def _piece(heights: np.ndarray, cuts: tuple[int, int], place: list[int]) -> np.ndarray:
    nx, ny = heights.shape[0] // cuts[0], heights.shape[1] // cuts[1]
    return heights[place[0] * nx : (place[0] + 1) * nx, place[1] * ny : (place[1] + 1) * ny]


def _solve(scene, speed: float, heights: np.ndarray, spacing: tuple[float, float]) -> dict:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "piece.npy"
        np.save(file, heights)
        named = scene.with_(surface={"file": str(file), "spacing": tuple(spacing), "unit": "m"})
        return solve(named, speed, ASKED)
