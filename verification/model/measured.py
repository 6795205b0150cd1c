"""Every model on the measured map of a scene, moving along each axis of its file."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np

import lubfric
from lubfric.scene.scene import Scene
from lubfric.sharing import Prepared

from .. import kept
from ..check import AT_LEAST, AT_MOST, Check, Item, Table
from . import summary
from .held_out import ONE, TELLING, told_ratios
from .measure import BOX, REFERENCE, WIDTH, Point, Setting, all_points, numerics_of

AXES = ("x", "y")
FILE = "measured-map.jsonl"


def measured_map(scene: Scene, cells: int, speeds: tuple[float, ...], folder: Path | None) -> Iterator[Item]:
    """Deviations of all models over ``speeds`` [m/s], and the points that the reference did not solve. The cells are as
    long as ``cells`` of them on 90 µm. Saved in ``folder``."""
    name = Path(scene.surface.file or "generated").stem
    load, motions = scene.bodies.load, [f"{name} along {axis}" for axis in AXES]
    settings = [Setting(0, motion, load, "that of the scene", speeds, cells) for motion in motions]
    found = all_points(settings, folder and folder / FILE, prepared=partial(_prepared, scene))
    gathered = summary.deviations(found)
    yield Table("measured-map", f"Each model against the deterministic film: {name}", *summary.table(gathered))
    failed = sum(d.failures for d in gathered if d.method == REFERENCE)
    yield Check("points of the deterministic film that failed", failed, 0.0, 0.0, "the solver's own report", AT_MOST)
    for method in TELLING:
        ratios = told_ratios(found, method)
        words = f"{method}: share of {ratios.size} points within model_form"
        yield Check(words, float(np.mean(ratios <= 1)), ONE, 0.0, "deterministic film", AT_LEAST)


def kept_points(folder: Path) -> list[Point]:
    """What `measured_map` has kept in ``folder``."""
    rows = [row for _, points in kept.read(folder / FILE) for row in points]
    return [Point(**row | {"setting": Setting(**row["setting"] | {"speeds": ()})}) for row in rows]


def _prepared(scene: Scene, setting: Setting, method: str) -> Prepared:
    """The model of the whole map, one patch of it, without a sampling of lines."""
    chosen = scene.with_(
        surface=replace(scene.surface, motion_axis=setting.acf[-1]),
        contact={"spacing": WIDTH / setting.cells, "region": "box" if method == BOX else "hertz"},
        numerics={"sampling": "patch"} | numerics_of(method),
    )
    return lubfric.prepare(chosen)
