"""``python -m verification model``: what load sharing leaves out, measured against one gap with one pressure.

The same surfaces, loads and fluids are solved by Eq. (8) over the Hertz strip and over the box, by three deflections of
the film, by the one-way closure, and by ``numerics.model = "deterministic"``, which is the reference. The exit code is
1 when a point of the reference failed, or when the one-way closure is further off than it promises.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import lubfric
from lubfric.scene.scene import Scene

from ..check import AT_MOST, TOLD, Check, Item, Table
from ..frame import Command
from ..frame import main as run
from ..studies import Study

LEVELS = ("default", "quick", "full")
STUDIES = (
    Study("model-error", "verification.model:model_error", "Load sharing beside one gap, one pressure", LEVELS),
    Study("grids", "verification.model.grids:grids", "One gap, one pressure on ever smaller cells", LEVELS),
    Study("loads", "verification.model.loads:loads", "One gap, one pressure at heavy loads", LEVELS),
)
SPEEDS = (0.3, 0.1, 0.06, 0.03, 0.01, 0.003, 0.001)
HEAVY = (0.3, 0.1, 0.03, 0.01)
LIGHT_SURFACES = {"quick": 1, "default": 20, "full": 20}
HEAVY_SURFACES = {"quick": 1, "default": 4, "full": 8}
CELLS = {"quick": 48, "default": 64, "full": 96}
PROMISED = {0.003: 0.03, 0.01: 0.03, 0.03: 0.06, 0.06: 0.06}  # rms of f by the one-way closure
MOST_OVER = 1.25  # 1.0 was met
COLUMNS = (
    "load [N]", "fluid", "acf", "U [m/s]", "spots' share", "film/Sq", "model", "f: mean [%]", "rms [%]",
    "F_C/F_T: mean", "gap ratio", "s", "failed",
)  # fmt: skip


def main(argv: list[str]) -> int:
    """The command."""
    command = Command("model", __doc__, STUDIES, "out/model", LEVELS, add_options=_options, prepared=_kept)
    return run(command, argv)


def _options(parser: argparse.ArgumentParser) -> None:
    words = "every model on the measured map of this scene, in place of the generated surfaces of model-error"
    parser.add_argument("--map", metavar="SCENE", help=words)


def _kept(study: Study, options: argparse.Namespace) -> Study:
    """Every study keeps what it has solved in the folder of the report."""
    own: dict[str, Any] = {"folder": options.out / f"{study.name}-{options.level}"}
    if study.name == "model-error" and options.map:
        own["scene"] = lubfric.load_scene(options.map)
    return replace(study, options=own)


def model_error(level: str, folder: Path | None = None, scene: Scene | None = None) -> Iterator[Item]:
    """f, share of the contact and mean gap by every model, over surfaces, speeds and loads; kept in ``folder`` surface
    by surface. With a ``scene``: over speeds on its measured map."""
    from . import charts, held_out, measure, measured, summary

    if scene is not None:
        yield from measured.measured_map(scene, CELLS[level], SPEEDS, folder)
        return
    found = measure.all_points(settings(level), None if folder is None else folder / "points.jsonl")
    gathered = summary.deviations(found)
    yield Table("model-error", "Each model against the deterministic film", COLUMNS, summary.rows(gathered))
    for method in measure.METHODS:
        failed = sum(d.failures for d in gathered if d.method == method)
        kind = AT_MOST if method == measure.REFERENCE else TOLD
        yield Check(f"{method}: points that failed", failed, 0.0, 0.0, "the solver's own report", kind)
    light = [d for d in gathered if d.load < 10 and d.acf == "gaussian"]
    if level != "quick":
        for d in light:
            if d.method == "one-way" and d.speed in PROMISED:
                name = f"one-way at {d.speed:g} m/s, {d.surfaces} surfaces: rms of f"
                yield Check(name, d.rms, PROMISED[d.speed], 0.0, "deterministic film", AT_MOST)
    ratios = [d.rms / d.told for d in gathered if d.method in held_out.TELLING and d.surfaces > 1]
    if ratios:  # at the quick level each group has one surface
        name = "largest rms of f over uncertainty.model_form"
        yield Check(name, max(ratios), MOST_OVER, 0.0, "lubfric.sampling.model_form", AT_MOST)
    yield from held_out.held_out(level, None if folder is None else folder / "held-out.jsonl")
    yield charts.over_speed("light", light, "5.5 N, Newtonian")
    for load in sorted({d.load for d in gathered if d.load > 10}):
        mine = [d for d in gathered if d.load == load]
        yield charts.over_speed(f"load-{load:g}".replace(".", "-"), mine, f"{load:g} N, limiting stress 0.09 p")
    yield charts.against_time(light)
    first = settings(level)[0]
    whole, shared, model = measure.side_by_side(first, 0.01)
    yield charts.fields(whole, shared, model, model.scene.bodies.half_width)


def settings(level: str):
    """Surfaces at the light load with both autocorrelations, and fewer at heavy loads with a shear-limited fluid."""
    from .measure import Setting

    cells, light, heavy = CELLS[level], LIGHT_SURFACES[level], HEAVY_SURFACES[level]
    found = [Setting(seed, "gaussian", 5.5, "Newtonian", SPEEDS, cells) for seed in range(1, light + 1)]
    if level != "quick":
        found += [Setting(seed, "exponential", 5.5, "Newtonian", SPEEDS[1:], cells) for seed in range(1, heavy + 1)]
    loads = (110.0,) if level == "quick" else (27.5, 110.0)
    found += [
        Setting(seed, "gaussian", load, "limiting stress", HEAVY, cells)
        for load in loads
        for seed in range(1, heavy + 1)
    ]
    return found
