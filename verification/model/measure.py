"""The same operating point by every model of load sharing and by one gap with one pressure."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import Any

import lubfric
from lubfric.scene.scene import Scene
from lubfric.sharing import Prepared

from .. import kept
from ..parts import the

WIDTH = 90e-6  # of the patch, both ways
LENGTH, SQ = 8e-6, 100e-9  # m, of the surfaces
REFERENCE = "deterministic"
METHODS = {
    REFERENCE: {"model": "deterministic", "grid": "given"},
    'Eq. (8) over "hertz"': {},
    'Eq. (8) over "box"': {},
    "hertz, scaled": {"film_deflection": "scaled"},
    "hertz, total": {"film_deflection": "total"},
    "one-way": {"closure": "one-way", "grid": "given"},
}
BOX = 'Eq. (8) over "box"'
OWN = {'Eq. (8) over "hertz"', BOX}  # the film is deflected by its own pressure
TOTAL_LEAST = 20.0  # N: below it the three deflections are the same within a point


@dataclass(frozen=True)
class Setting:
    """What is solved.

    It is one surface (its correlation length and Sq [m]) at one load [N] with one law of the fluid, at speeds [m/s]
    from the fastest down.
    """

    seed: int
    acf: str
    load: float
    fluid: str
    speeds: tuple[float, ...]
    cells: int
    length: float = LENGTH
    sq: float = SQ


@dataclass(frozen=True)
class Point:
    """One operating point by one method; told: what its result says of the error of its model. A failure has NaN and
    its words."""

    setting: Setting
    speed: float
    method: str
    coefficient: float
    contact_share: float
    mean_gap: float
    film_ratio: float
    seconds: float
    failure: str = ""
    told: float = math.nan


FLUIDS = {
    "Newtonian": {},
    "limiting stress": {
        "density_law": "dowson-higginson",
        "limiting_stress_coefficient": 0.09,
        "limiting_stress_offset": 2e6,
    },
}


def scene_of(setting: Setting, method: str) -> Scene:
    """The paper's cylinder with the surface, load and fluid of ``setting``."""
    base = lubfric.load_scene("paper").with_(
        bodies={"load": setting.load},
        lubricant=FLUIDS[setting.fluid],
        surface={"seed": setting.seed, "acf": setting.acf},
        contact={
            "shape": (setting.cells, setting.cells),
            "spacing": WIDTH / setting.cells,
            "region": "box" if method == BOX else "hertz",
        },
    )
    return base.with_(numerics=numerics_of(method))


def numerics_of(method: str) -> dict:
    """Keys of ``[numerics]`` that make ``method``."""
    own = {"film_deflection": "hydrodynamic"} if method in OWN else {}
    return dict(METHODS[method]) | own | {"accept": True}


def surface_of(setting: Setting):
    """A surface made on 256 cells and taken to those of the setting, so that all grids see one surface."""
    fine = lubfric.generate_surface(
        (256, 256), WIDTH / 256, sq=setting.sq, correlation_length=setting.length, acf=setting.acf, seed=setting.seed
    )
    return fine.resampled(shape=(setting.cells, setting.cells))


def all_points(
    settings: list[Setting],
    file: Path | None = None,
    methods=tuple(METHODS),
    prepared: Callable[[Setting, str], Prepared] | None = None,
) -> list[Point]:
    """Every speed of all ``settings`` by every one of ``methods``, each speed started from the one before. Those of a
    setting and method that are kept in ``file`` are not solved again. ``prepared``: the model of a setting by a method
    (default: with `scene_of` and `surface_of`)."""
    where = {
        f"{setting}; {method}; {METHODS[method]}": (setting, method)
        for setting in settings
        for method in methods
        if method != "hertz, total" or setting.load >= TOTAL_LEAST
    }
    surface = cache(surface_of)

    def generated(setting: Setting, method: str) -> Prepared:
        return lubfric.prepare(scene_of(setting, method), surface(setting))

    def solve(key: str) -> list[dict]:
        setting, method = where[key]
        return [asdict(p) for p in _sweep(setting, method, (prepared or generated)(setting, method))]

    found = zip(where.values(), kept.each(file, where, solve))
    return [_point(setting, row) for (setting, _), rows in found for row in rows]


def _point(setting: Setting, row: dict) -> Point:
    """A point as it was kept: what JSON has no word for comes back as NaN."""
    numbers: dict[str, Any] = {name: float("nan") if value is None else value for name, value in row.items()}
    return Point(**numbers | {"setting": setting})


def _sweep(setting: Setting, method: str, model: Prepared) -> list[Point]:
    found, start = [], None
    for speed in setting.speeds:
        begun = time.process_time()
        try:
            result = lubfric.friction(model, speed, start=start)
        except lubfric.LubfricError as error:
            start = None
            seconds, nan = time.process_time() - begun, float("nan")
            found.append(Point(setting, speed, method, nan, nan, nan, nan, seconds, f"{type(error).__name__}: {error}"))
            continue
        start = result if result.starts else None
        found.append(
            Point(
                setting,
                speed,
                method,
                result.coefficient,
                result.contact_load / setting.load,
                result.mean_gap,
                result.film_to_roughness_ratio,
                time.process_time() - begun,
                told=result.uncertainty.model_form,
            )
        )
    return found


def side_by_side(setting: Setting, speed: float):
    """The deterministic fields, and the load-sharing result with its own, at one speed."""
    surface = surface_of(setting)
    whole = lubfric.friction(lubfric.prepare(scene_of(setting, REFERENCE), surface), speed)
    shared_scene = scene_of(setting, 'Eq. (8) over "hertz"').with_(numerics={"grid": "given"})
    model = lubfric.prepare(shared_scene, surface)
    return the(whole.deterministic, "deterministic film").result, lubfric.friction(model, speed, fields=True), model
