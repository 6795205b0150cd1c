"""What else the sampling states: pieces of a map, and every other number."""

import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np

import lubfric
from lubfric.quantities import ESTIMATED

from ...check import AT_LEAST, Check, Item, Table
from ...kept import Run
from ...types import Keywords, PlainRow
from ..hostile.soak_scenes import random_scene
from . import SEED
from .coverage import SHARED, chance, solve, within

MAP = (1600, 1600)  # cells of a map
CUTS = (2, 2)  # pieces along and across
MAPS = {"quick": 1, "default": 2, "full": 6}
PIECES = (0.85, 0.99)  # bounds of the coverage by pieces
ASKED = 0.02  # target standard error
GENERATED = ("sq", "correlation_length")  # keys that do not go with a file
SCENES = {"quick": 4, "default": 24, "full": 100}
TIGHT = 1e-4  # tolerance of the reference
FLOOR = 1e-3  # relative error of the reference that is granted
WITHIN = 0.95  # part of the values that is within its stated error, at least


def pieces(level: str, run: Run = Run(), seed: int = SEED) -> Iterator[Item]:
    """Count how often the interval of a quarter of a map contains the friction of the complete map."""
    maps = range(seed + 90_000, seed + 90_000 + MAPS[level])
    places = (None, *np.ndindex(CUTS))
    cases = {f"{number}, piece {place}": (number, place) for number in maps for place in places}
    rows = [row for _, row in run.solved(cases, piece)]
    covered = []
    for complete, *parts in np.array(rows).reshape(len(maps), len(places)).tolist():
        covered += [part["low"] <= complete["f"] <= part["high"] for part in parts]
    words = "pieces of a map: coverage"
    yield within(words, float(np.mean(covered)), len(covered), PIECES, "the whole map")


def piece(case: tuple[int, tuple[int, int] | None]) -> PlainRow:
    """Return a point on one piece of a map (None: all of it), which is written and read again as instrument files
    are."""
    seed, place = case
    keys: Keywords = {"sq": 100e-9, "correlation_length": 8e-6, "acf": "gaussian", "seed": seed}
    complete = lubfric.generate_surface(MAP, 0.45e-6, **keys)
    heights = complete.heights
    if place is not None:
        nx = heights.shape[0] // CUTS[0]
        ny = heights.shape[1] // CUTS[1]
        heights = heights[place[0] * nx : (place[0] + 1) * nx, place[1] * ny : (place[1] + 1) * ny]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "piece.npy"
        np.save(file, heights)
        named = {"file": str(file), "spacing": tuple(complete.spacing), "unit": "m"} | dict.fromkeys(GENERATED)
        return solve(SHARED.with_(surface=named, contact={"shape": None, "spacing": None}), 0.02, ASKED)


def quantities(level: str, run: Run = Run()) -> Iterator[Item]:
    """Compare every reported number of random scenes with the same number at 0.01 %: it has to be within its stated
    error."""
    values = [row for _, row in run.solved({str(k): k for k in range(SCENES[level])}, beside)]
    rows = []
    for name in ESTIMATED:
        stated = [row[name] for row in values if row and row[name] is not None]
        if stated:
            held = float(np.mean([off <= max(error, FLOOR) for off, error in stated]))
            median = float(np.median([error for _, error in stated]))
            rows.append(
                (f"`{name}`", f"{len(stated)} of {len(values)}", f"{100 * held:.0f} %", f"{100 * median:.2g} %")
            )
            words = f"{name}: within its stated error in {len(stated)} scenes"
            yield Check(
                words,
                held,
                expected=WITHIN,
                tolerance=chance(len(stated)),
                source="the same scene at 0.01 %",
                kind=AT_LEAST,
            )
    columns = ("quantity", "scenes that state an error", "within it", "median of it")
    yield Table("sampling-numbers", "Every quantity compared with its stated error", columns, rows)


def beside(number: int) -> PlainRow:
    """Return (relative deviation, stated error) by quantity of a random patch; None if none is stated, {} if
    refused."""
    scene = random_scene(np.random.default_rng((11, number))).with_(
        numerics={"model": "paper", "sampling": "patch", "tolerance": 0.01}
    )
    try:
        point = lubfric.friction(scene)
        tight = lubfric.friction(scene.with_(numerics={"tolerance": TIGHT}))
    except lubfric.LubfricError:
        return {}
    row: PlainRow = {}
    for name in ESTIMATED:
        value = getattr(point, name)
        reference = getattr(tight, name)
        error = getattr(point.errors, name)
        largest = max(abs(value), abs(reference), 1e-300)
        stated = error is not None and np.isfinite(error)
        row[name] = (abs(value - reference) / largest, error) if stated else None
    return row
