"""The deterministic film at heavy loads on ten surfaces.

The paper's cylinder at 27.5 and 110 N, and the bearing of the stability map at 1 GPa, each with a shear-limited
compressible oil, from 0.3 down to 0.001 m/s.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import numpy as np

import lubfric
from lubfric.deterministic import Start, layer, state_on
from lubfric.deterministic.problem import Problem
from lubfric.deterministic.result import DeterministicResult
from lubfric.deterministic.solve import solve_point

from .. import kept
from ..check import AT_MOST, Check, Item, Table
from ..stability.whole_map import bearing
from .measure import REFERENCE, Setting, scene_of, surface_of

CASES = {  # surfaces; those at 1 GPa; cells across
    "quick": (1, 0, 32),
    "default": (10, 10, 64),
    "full": (10, 10, 128),
}
SPEEDS = (0.3, 0.1, 0.03, 0.01, 0.003, 0.001)
GIGAPASCAL = 2.72e5  # N/m: 1 GPa in the middle of the bearing
SQ = 200e-9  # m, of its surfaces
KINDS = ("27.5 N", "110 N", "1 GPa")
MOST = {"27.5 N": 800, "110 N": 800, "1 GPa": 100}  # factorisations of a point, so that one that fails costs a minute
NOT_TRIED = "not tried: the speed before was not solved"
SECONDS = 10.0
COLUMNS = ("load", "surface", "U [m/s]", "f", "share of spots", "mean gap [nm]", "factorisations", "CPU s", "failure")


def loads(level: str, folder: Path | None = None) -> Iterator[Item]:
    """Every speed of every surface, started from the one before; kept in ``folder`` surface by surface."""
    light, heaviest, cells = CASES[level]
    counts = {kind: heaviest if kind == "1 GPa" else light for kind in KINDS}
    kinds = [kind for kind in KINDS if counts[kind]]
    keys = [f"{kind}, {seed}" for kind in kinds for seed in range(1, counts[kind] + 1)]
    file = None if folder is None else folder / "surfaces.jsonl"
    rows = [row for sweep in kept.each(file, keys, partial(swept, cells)) for row in sweep]
    yield Table("loads", f"The deterministic film at heavy loads, {cells} cells across", COLUMNS, rows)
    for kind in kinds:
        mine = [row for row in rows if row[0] == kind]
        asked = kind != "1 GPa"  # where that is not solved is shown
        failed = [f"{row[1]} at {row[2]:g} m/s" for row in mine if row[-1]]
        name = f"{kind}, {counts[kind]} surfaces: points of {len(mine)} that were not solved"
        yield Check(name, len(failed), 0, 0, "the solver's own report", AT_MOST, decisive=asked, note=", ".join(failed))
        slowest, within = max(row[-2] for row in mine), SECONDS if level == "full" else 6 * SECONDS
        note = f"median {np.median([row[-2] for row in mine]):.1f} s"
        yield Check(
            f"{kind}: slowest point", slowest, within, 0.0, "asked", AT_MOST, unit="s", note=note, decisive=asked
        )


def swept(cells: int, key: str) -> list[list]:
    """Rows of the table: the load and surface ``key`` at all speeds from the fastest down, while they are solved."""
    kind, seed = key.split(", ")
    lay = _laid(kind, int(seed), cells)
    rows: list[list] = []
    last: DeterministicResult | None = None
    for speed in SPEEDS:
        if rows and rows[-1][-1]:
            rows.append([kind, int(seed), speed, *[math.nan] * 4, 0.0, NOT_TRIED])
            continue
        problem = lay(speed)
        starts = [] if last is None else [Start(partial(state_on, problem, last), last.speed)]
        begun = time.process_time()
        try:
            last = solve_point(problem, starts=starts, most=MOST[kind])
            said = [last.coefficient, last.split.spots / last.load, 1e9 * last.mean_gap, last.report.iterations]
            failure = ""
        except lubfric.ConvergenceError as error:
            said, failure = [math.nan] * 4, str(error)
        rows.append([kind, int(seed), speed, *said, time.process_time() - begun, failure])
    return rows


def _laid(kind: str, seed: int, cells: int) -> Callable[[float], Problem]:
    if kind == "1 GPa":
        return lambda speed: bearing(SQ, GIGAPASCAL, speed, seed, cells)
    setting = Setting(seed, "gaussian", float(kind.split()[0]), "limiting stress", SPEEDS, cells)
    scene, surface = scene_of(setting, REFERENCE), surface_of(setting)
    return lambda speed: layer(scene, surface, speed)(surface.shape)
