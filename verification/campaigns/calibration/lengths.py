"""Random contacts of the calibration on generated surfaces of half, once and twice their correlation length, solved by
the quick model: how f changes with it."""

import math
import time
from collections.abc import Iterator
from pathlib import Path

import lubfric

from ...types import PlainRow
from .. import table_file
from .case import Case
from .case import drawn as drawn_case
from .table import DIGITS, TABLES

LENGTHS = TABLES / "lengths.csv"

# Factors on the correlation lengths, the case itself first.
FACTORS = (1.0, 0.5, 2.0)

# Cells of the map in a correlation length, and in the Hertz half-width, at least; the quick model has longer ones.
CELLS_OF_LENGTH = 5.0
CELLS_OF_HALF_WIDTH = 4.0

# Counted work [s] of a solve, at most.
MOST_WORK = 40.0

COLUMNS = ("motion", "seed", "factor", "slip", "friction", "contact", "f", "seconds")


def scene_of(case: Case, factor: float) -> lubfric.Scene:
    """Return the scene of ``case`` by the quick model, on generated surfaces of so many times (``factor``) its
    correlation lengths, with the same seeds."""
    facts = case.facts
    lengths = (factor * facts["length_x"], factor * facts["length_y"])
    is_both = facts["rough"] == "both"
    rough = {"sq": facts["sq"] / math.sqrt(1 + is_both), "correlation_length": lengths, "acf": facts["acf"]}
    smooth = {"sq": 0.0, "correlation_length": lengths}
    spacing = (
        min(lengths[0] / CELLS_OF_LENGTH, case.scene.bodies.half_width / CELLS_OF_HALF_WIDTH),
        lengths[1] / CELLS_OF_LENGTH,
    )
    return case.scene.with_(
        surface=smooth if facts["rough"] == "upper" else rough | {"seed": 1},
        counterface=None if facts["rough"] == "lower" else rough | {"seed": 2 if is_both else 1},
        contact={"spacing": spacing, "shape": (160, 96)},
        numerics={"model": "quick", "heat": "off", "sampling": None, "max_work": MOST_WORK},
    )


def extend(motion: str, count: int, budget: float, file: Path = LENGTHS) -> Iterator[PlainRow]:
    """Solve those of the first so many (``count``) cases of a ``motion`` that the table in ``file`` has not, but for
    plateaus, as long as the time of this process is below ``budget`` [s], and append each that is solved."""
    known = {(row["motion"], int(row["seed"]), float(row["factor"])) for row in table_file.rows(file)}
    for seed in range(count):
        case = drawn_case(motion, seed)
        for factor in FACTORS:
            if (motion, seed, factor) in known or case.facts["lay"] == "plateau":
                continue
            begun = time.process_time()
            if begun > budget:
                return
            try:
                point = lubfric.friction(scene_of(case, factor), case.speed, raise_on_failure=False)
            except lubfric.LubfricError:  # too much work, or no map of this length
                break
            row = {
                "motion": motion,
                "seed": seed,
                "factor": factor,
                "slip": case.facts["slip"],
                "friction": case.facts["friction"],
                "contact": point.contact_load / case.scene.bodies.load,
                "f": point.coefficient,
                "seconds": time.process_time() - begun,
            }
            table_file.append(file, COLUMNS, row, DIGITS)
            yield row
