"""The same operating point by every model of load sharing and by one gap with one pressure."""

import math
import time
from collections.abc import Iterable
from dataclasses import asdict, dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

import lubfric

from ..kept import Run

WIDTH = 90e-6  # of the patch, both ways
REFERENCE, HERTZ, BOX = "deterministic", 'Eq. (8) over "hertz"', 'Eq. (8) over "box"'
METHODS: dict[str, dict[str, Any]] = {
    REFERENCE: {"model": "deterministic", "grid": "given"},
    HERTZ: {"film_deflection": "hydrodynamic"},
    BOX: {"film_deflection": "hydrodynamic"},
    "hertz, scaled": {"film_deflection": "scaled"},
}
LIMITED = {"density_law": "dowson-higginson", "limiting_stress_coefficient": 0.09, "limiting_stress_offset": 2e6}


@dataclass(frozen=True)
class Setting:
    """One surface (seed, autocorrelation, correlation length and Sq [m]) at one load [N] with a Newtonian or a
    ``limited`` fluid, on so many cells; or the measured map of a ``scene``, moving along an ``axis`` of its file."""

    seed: int
    load: float
    cells: int
    limited: bool = False
    acf: str = "gaussian"
    length: float = 8e-6
    sq: float = 100e-9
    scene: str = ""
    axis: str = "x"


@dataclass(frozen=True)
class Point:
    """One operating point by one method, with the model error that it states. A failure has NaN and words."""

    setting: Setting
    speed: float
    method: str
    coefficient: float = math.nan
    share: float = math.nan
    seconds: float = 0.0
    stated: float = math.nan
    failure: str = ""


def scene_of(setting: Setting, method: str):
    """The paper's cylinder with the surface, load and fluid of ``setting``, or the scene that it names."""
    grid: dict = {"region": "box" if method == BOX else "hertz", "spacing": WIDTH / setting.cells}
    numerics = METHODS[method] | {"accept": True}
    if setting.scene:
        scene = lubfric.load_scene(setting.scene)
        rough = replace(scene.surface, motion_axis=setting.axis)
        return scene.with_(surface=rough, contact=grid, numerics={"sampling": "patch"} | numerics)
    return lubfric.load_scene("paper").with_(
        bodies={"load": setting.load},
        lubricant=LIMITED if setting.limited else {},
        surface={"seed": setting.seed, "acf": setting.acf},
        contact=grid | {"shape": (setting.cells, setting.cells)},
        numerics=numerics,
    )


def surface_of(setting: Setting):
    """A surface made on 256 cells and taken to those of the setting, so that all grids see one surface."""
    keys = {"sq": setting.sq, "correlation_length": setting.length, "acf": setting.acf, "seed": setting.seed}
    fine = lubfric.generate_surface((256, 256), WIDTH / 256, **keys)
    return fine.resampled(shape=(setting.cells, setting.cells))


@lru_cache(maxsize=2)
def prepared(setting: Setting, method: str):
    """The model of a setting by a method."""
    return lubfric.prepare(scene_of(setting, method), *([] if setting.scene else [surface_of(setting)]))


def solve(point: Point) -> dict:
    """The numbers of a point."""
    model = prepared(point.setting, point.method)
    begun = time.process_time()
    try:
        found = lubfric.friction(model, point.speed)
    except lubfric.LubfricError as error:
        return {"failure": f"{type(error).__name__}: {error}", "seconds": time.process_time() - begun}
    return {
        "coefficient": found.coefficient,
        "share": found.contact_load / model.scene.bodies.load,
        "seconds": time.process_time() - begun,
        "stated": found.uncertainty.model_form,
    }


def all_points(settings: Iterable[tuple[Setting, tuple[float, ...]]], run: Run, methods=tuple(METHODS)) -> list[Point]:
    """Every speed [m/s] of the settings by every one of ``methods``."""
    points = [Point(setting, speed, method) for setting, speeds in settings for method in methods for speed in speeds]
    cases = {f"{asdict(p.setting)}; {p.method}; {METHODS[p.method]}; {p.speed}": p for p in points}
    known = ((p, {name: v for name, v in row.items() if v is not None}) for p, row in run.solved(cases, solve))
    return [replace(point, **row) for point, row in known]


@dataclass(frozen=True)
class Deviation:
    """One method at one load [N], surface and speed [m/s] against the reference, over the surfaces: mean and rms of
    f/f_ref - 1, the rms error that its results state, the share of the spots in the load by the reference, the median
    of the seconds, the numbers of surfaces and of failures."""

    load: float
    kind: str
    speed: float
    method: str
    mean: float
    rms: float
    stated: float
    share: float
    seconds: float
    surfaces: int
    failures: int


def deviations(points: list[Point]) -> list[Deviation]:
    """One entry for each method, load, kind of surface and speed."""
    reference = {(p.setting, p.speed): p for p in points if p.method == REFERENCE}
    groups: dict[tuple, list[tuple[Point, Point]]] = {}
    for p in points:
        kind = f"along {p.setting.axis}" if p.setting.scene else p.setting.acf
        key = (p.setting.load, kind, p.speed, p.method)
        groups.setdefault(key, []).append((p, reference[p.setting, p.speed]))
    found = []
    for key, pairs in groups.items():
        good = [(p, r) for p, r in pairs if math.isfinite(p.coefficient + r.coefficient)]
        e = np.array([p.coefficient / r.coefficient - 1 for p, r in good] or [math.nan])
        stated, share = (
            [*values] or [math.nan] for values in ((p.stated for p, _ in good), (r.share for _, r in good))
        )
        means = float(e.mean()), float(np.sqrt(np.mean(e**2))), float(np.mean(stated)), float(np.mean(share))
        seconds = float(np.median([p.seconds for p, _ in pairs]))
        found.append(Deviation(*key, *means, seconds, len(good), len(pairs) - len(good)))
    return found


def table(found: list[Deviation]) -> tuple[list[str], list[list[str]]]:
    """Columns and rows: for each load, surface and speed the mean / rms [%] of the error of f by every method."""
    methods = [m for m in METHODS if m != REFERENCE and any(d.method == m for d in found)]
    rows = []
    for key in dict.fromkeys((d.load, d.kind, d.speed) for d in found):
        here = {d.method: d for d in found if (d.load, d.kind, d.speed) == key}
        reference = here[REFERENCE]
        name = f"{key[0]:g}" + ("" if key[1] == "gaussian" else f", {key[1]}")
        cells = [name, f"{key[2]:g}", f"{reference.share:.2f}", str(reference.surfaces)]
        rows.append(
            cells + [f"{100 * here[m].mean:+.1f} / {100 * here[m].rms:.1f}" if m in here else "" for m in methods]
        )
    return ["load (N)", "U (m/s)", "share of spots", "surfaces", *methods], rows


def cost(points: list[Point]) -> tuple[list[str], list[list[str]]]:
    """Columns and rows: the mean processor time of a point by every model, and points that were not solved."""
    base = np.mean([p.seconds for p in points if p.method == HERTZ])
    rows = []
    for method in dict.fromkeys(p.method for p in points):
        mine = [p for p in points if p.method == method]
        mean, failed = float(np.mean([p.seconds for p in mine])), sum(bool(p.failure) for p in mine)
        rows.append([method, str(len(mine)), f"{1e3 * mean:.0f} ms", f"{mean / base:.1f}", str(failed)])
    return ["model", "points", "mean processor time", f"over {HERTZ}", "not solved"], rows


def over_stated(points: list[Point]) -> np.ndarray:
    """|f/f_ref - 1| over what the result of Eq. (8) states, of the points that both solved."""
    reference = {(p.setting, p.speed): p.coefficient for p in points if p.method == REFERENCE}
    mine = [(p, reference[p.setting, p.speed]) for p in points if p.method == HERTZ]
    ratios = np.array([abs(p.coefficient / f - 1) / max(p.stated, 1e-3) for p, f in mine])
    return ratios[np.isfinite(ratios)]
