"""The table: the first steps in time of random rolling contacts, on the cells of the deterministic model and on long
ones.

The contacts are random runs of verification.campaigns.estimates with other numbers.
"""

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

import lubfric
from lubfric.models.deterministic import (
    MovingEffort,
    RoughBody,
    StepFacts,
    bodies_of,
    cells_in_a_step,
    effort_of,
    solve_moving_strip,
    surface_and_map_coarsening,
    work_of_step_in_time,
)
from lubfric.models.quick import long_cells_in_motion

from ...types import PlainRow
from .. import table_file
from ..calibration.case import drawn as drawn_case
from ..calibration.solve import limited
from ..estimates.jobs import KINDS, drawn
from ..extending import solved_in_processes

TABLE = Path(__file__).parent / "table.csv"

# Number of the run of verification.campaigns.estimates that the first contact is: none of its table is as large, and
# from 10,000 on they are on patches.
FIRST = 4_992

# Slide-roll ratios of every second contact on long cells, as of traction curves [-].
SLIGHT = (0.005, 1.0)

# Steps in time that are solved, and the first of them that do not count: those of the start from rest.
STEPS = 16
OMITTED = 4

# Processor time of a contact on one of its grids, at most [s].
SECONDS = 12.0

# Factors within which the fit is shown [-].
WITHIN = (1.5, 2.0, 3.0)

# Digits of a number in the table.
DIGITS = 5

# Cells: those of verification.campaigns.calibration, of whose contacts the number is one, at its speed and at `SLOWER`
# times that; those of the deterministic model and long ones, on which it is a random run.
CELLS = ("case", "slow", "long", "strip")

# Speed of a slow contact over that of the same one of verification.campaigns.calibration [-]: its film is a fifth.
SLOWER = 0.1

# Numbers of the first contacts of calibration of each kind: usual ones, slight sliding, light ones, thin films.
CASES = (0, 1000, 2000, 3000)

FACTS = tuple(field.name for field in fields(StepFacts))
COLUMNS = (
    *("number", "cells", *FACTS, "length", "slip", "acf", "map"),
    *("cell", "nx", "ny", "rest", "work", "seconds", "failure"),
)


class MovingBodies(NamedTuple):
    """Rough bodies at a ``speed`` [m/s], and what the table says of them."""

    scene: lubfric.Scene
    bodies: Sequence[RoughBody]
    speed: float
    lengths: tuple[float, float]
    map_coarsening: tuple[int, int]
    effort: MovingEffort
    described: PlainRow


@dataclass(frozen=True)
class ContactOnCells:
    """The random contact ``number`` on ``cells`` (`CELLS`)."""

    number: int
    cells: str

    def row(self) -> PlainRow:
        """Return the row: the counted work [s] of the strip at rest, and the mean of that of its steps in time."""
        row: PlainRow = {"number": self.number, "cells": self.cells, "failure": ""}
        begun = time.process_time()
        try:
            with limited(SECONDS):
                moving = self.moving()
                row |= moving.described
                short = replace(moving.effort, discarded=0.0)
                strip = solve_moving_strip(
                    moving.scene,
                    moving.bodies,
                    moving.speed,
                    map_coarsening=moving.map_coarsening,
                    effort=short,
                    most_steps=STEPS,
                )
                (nx, ny) = strip.result.pressure.shape
                cell = strip.problem.spacing[0]
                sq = float(np.sum([body.surface.heights for body in moving.bodies], axis=0).std())
                step = float(strip.times[0])
                speeds = [body.speed for body in moving.bodies]
                facts = StepFacts.of(moving.scene, sq=sq, speed=moving.speed, lengths=moving.lengths, cell=cell)
                row |= {name: getattr(facts, name) for name in FACTS}
                row |= {
                    "length": moving.lengths[0] / moving.scene.bodies.half_width,
                    "cell": cell / moving.scene.bodies.half_width,
                    "moved": cells_in_a_step(moving.bodies, step, cell),
                    "apart": 0.5 * (max(speeds) - min(speeds)) * step / cell,
                    "nx": nx,
                    "ny": ny,
                    "rest": strip.rest.work,
                    "work": float(strip.series["work"][OMITTED:].mean()),
                }
        except (lubfric.LubfricError, FloatingPointError) as error:
            row["failure"] = f"{type(error).__name__}: {error}".replace("\n", " ")[:80]
        return row | {"seconds": time.process_time() - begun}

    def moving(self) -> MovingBodies:
        """Return its rough bodies on their cells."""
        if self.cells in ("case", "slow"):
            return self._case(SLOWER if self.cells == "slow" else 1.0)
        scene = drawn(FIRST + self.number * len(KINDS) + KINDS.index("rolling deterministic"), 0).scene
        if self.cells == "long" and self.number % 2:
            (low, high) = np.log(SLIGHT)
            part = np.random.default_rng([49, self.number]).random()
            scene = scene.with_(motion={"slide_roll_ratio": float(np.exp(low + part * (high - low)))})
        speed = scene.motion.entrainment_speed
        prepared = lubfric.prepare(scene)
        lengths = prepared.sample.correlation_lengths
        described = {"slip": scene.motion.slide_roll_ratio, "acf": scene.surface.acf}
        bodies: Sequence[RoughBody] = bodies_of(prepared, 0, speed)
        if self.cells == "long":
            long = long_cells_in_motion(scene, bodies, speed, lengths)
            return MovingBodies(scene, long.bodies, speed, lengths, long.map_coarsening, long.effort, described)
        map_coarsening = surface_and_map_coarsening(prepared, 0)[1]
        effort = effort_of(scene, bodies, speed, map_coarsening)
        return MovingBodies(scene, bodies, speed, lengths, map_coarsening, effort, described)

    def _case(self, slower: float) -> MovingBodies:
        """Return those of the contact of calibration at its speed times ``slower``."""
        case = drawn_case("rolling", CASES[self.number % len(CASES)] + self.number // len(CASES))
        speed = slower * case.speed
        bodies = [body._replace(speed=slower * body.speed) for body in case.bodies]
        lengths = (case.facts["length_x"], case.facts["length_y"])
        effort = effort_of(case.scene, bodies, speed)
        described = {"slip": case.facts["slip"], "acf": case.facts["acf"], "map": case.facts["lay"]}
        return MovingBodies(case.scene, bodies, speed, lengths, (1, 1), effort, described)


def extend(
    count: int, seconds: float, workers: int, file: Path = TABLE, cells: Sequence[str] = CELLS
) -> Iterator[PlainRow]:
    """Solve the first ``count`` contacts on each of ``cells`` that the table has not, in so many processes
    (``workers``), and append each as it ends; those not ready after so many ``seconds`` of elapsed time are left
    out."""
    known = {(int(row["number"]), row["cells"]) for row in table_file.rows(file)}
    left = [ContactOnCells(number, one) for number in range(count) for one in cells if (number, one) not in known]
    for row in solved_in_processes(left, seconds, workers):
        table_file.append(file, COLUMNS, row, DIGITS)
        yield row


def features_and_logs(file: Path = TABLE) -> tuple[np.ndarray, np.ndarray]:
    """Return the features (`StepFacts.features`) of the solved contacts, a row each, and ln of the work of their steps
    over `work_of_step_in_time`."""
    solved = [row for row in table_file.rows(file) if not row["failure"]]
    features = [StepFacts(**{name: float(row[name]) for name in FACTS}).features for row in solved]
    usual = [work_of_step_in_time(int(row["nx"]) * int(row["ny"])) for row in solved]
    return np.array(features), np.log([float(row["work"]) for row in solved]) - np.log(usual)


def fitted(file: Path = TABLE) -> list[float]:
    """Return the coefficients of the features by least squares."""
    (features, logs) = features_and_logs(file)
    coefficients, *_ = np.linalg.lstsq(features, logs)
    return [float(coefficient) for coefficient in coefficients]


def parts_within(file: Path = TABLE) -> dict[float, float]:
    """Return the parts of contacts within `WITHIN` of the fit to all other contacts."""
    (features, logs) = features_and_logs(file)
    inverse = np.linalg.inv(features.T @ features)
    own = np.einsum("ij,jk,ik->i", features, inverse, features)  # by which a residual is too small
    apart = np.abs(logs - features @ fitted(file)) / (1.0 - own)
    return {factor: float(np.mean(apart <= np.log(factor))) for factor in WITHIN}
